//! Names in a formula about a program: variables, and in the transition view also lines and the nodes of the net.

use crate::translate::{PlaceRole, System};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;
use petril_lang::semantics::{Kind, Role, VarId};
use petril_logic::{Bound, Name, ScanTime, Spot, Term, View, Vocabulary};
use petril_net::net::{PlaceId, TransitionId};

/// Vocabulary of a program in a view.
pub(super) struct InProgram<'a> {
    pub system: &'a System,
    pub view: View,
}

impl Vocabulary for InProgram<'_> {
    fn truth(&self, name: &Name<'_>) -> Result<Bound, Diagnostic> {
        if let Some(bit) = self.bit_of(name)? {
            return Ok(bit);
        }
        let variable = self.find(name)?;
        let found = self.system.program.variable(variable);
        if found.ty.is_bool() {
            return Ok(self.bit(variable));
        }
        let message = format!("`{}` is of type `{}`, where something true or false is needed", name.text, found.ty);
        let help = format!("compare it with something, like `{} != 0`", found.name);
        Err(Diagnostic::new(Code::RequirementTypes, name.span, message).help(help))
    }

    fn number(&self, name: &Name<'_>) -> Result<Term, Diagnostic> {
        if let Some(bit) = self.bit_of(name)? {
            return Ok(Term::Truth(Box::new(bit)));
        }
        let variable = self.find(name)?;
        Ok(self.number_of(variable))
    }

    fn enumerated(&self, value: &str, variable: &str) -> Option<i128> {
        let program = &self.system.program;
        let variable = program.named(variable).filter(|_| program.named(value).is_none())?;
        program.enumerated(variable, value)
    }

    fn control(&self, spot: Spot, span: Span) -> Result<Bound, Diagnostic> {
        let end = self.system.program.end();
        let role = match spot {
            Spot::Idle => PlaceRole::Idle,
            Spot::End => PlaceRole::Line(end),
            Spot::Line(line) => match line.checked_sub(1).filter(|&line| line < end) {
                Some(line) => PlaceRole::Line(line),
                None => {
                    let message = format!("the flat code has no line {line}");
                    let help = format!("its lines are 1 to {end}; `petril flat` prints them");
                    return Err(Diagnostic::new(Code::RequirementNameUnknown, span, message).help(help));
                }
            },
        };
        self.only_in_transition_view("where control is", span)?;
        Ok(Bound::Marked(self.system.place(role)))
    }

    fn place(&self, name: &Name<'_>) -> Result<PlaceId, Diagnostic> {
        self.only_in_transition_view("a place of the net", name.span)?;
        let net = &self.system.net;
        net.find_place(name.text).ok_or_else(|| {
            let message = format!("the net has no place `{}`", name.text);
            name.unknown(message, net.places().map(|place| place.name))
        })
    }

    fn transition(&self, name: &Name<'_>) -> Result<TransitionId, Diagnostic> {
        self.only_in_transition_view("a transition of the net", name.span)?;
        let net = &self.system.net;
        net.find_transition(name.text).ok_or_else(|| {
            let message = format!("the net has no transition `{}`", name.text);
            name.unknown(message, net.transitions().map(|transition| transition.name))
        })
    }

    fn scans(&self, span: Span) -> Result<ScanTime, Diagnostic> {
        if self.view == View::Scan {
            return Ok(ScanTime(self.system.program.cycle));
        }
        let message =
            "the requirement speaks of scans before or after, but a step of the transition view is one firing";
        Err(Diagnostic::new(Code::RequirementView, span, message).help("check it in the scan view"))
    }

    fn inputs(&self) -> Vec<Term> {
        self.numbers(Role::Input)
    }

    fn outputs(&self) -> Vec<Term> {
        self.numbers(Role::Output)
    }

    fn deadlock(&self, span: Span) -> Result<Bound, Diagnostic> {
        self.only_in_transition_view("a deadlock of the net", span)?;
        Ok(Bound::Deadlock)
    }
}

impl InProgram<'_> {
    fn numbers(&self, role: Role) -> Vec<Term> {
        self.system.program.with_role(role).map(|variable| self.number_of(variable)).collect()
    }

    /// Number held by a variable.
    fn number_of(&self, variable: VarId) -> Term {
        let ty = self.system.program.variable(variable).ty;
        if ty.is_bool() {
            return Term::Truth(Box::new(self.bit(variable)));
        }
        if self.view == View::Scan {
            return Term::Variable(variable, ty);
        }
        // In two's complement, the highest bit has a negative weight.
        let weight = |bit: u32| if ty.is_signed() && bit + 1 == ty.width { -(1_i128 << bit) } else { 1 << bit };
        let bits = (0..).zip(self.system.bits(variable));
        let places = bits.map(|(bit, [_, place])| (place, weight(bit))).collect();
        Term::Bits { variable, places }
    }

    /// Binds a bit of a variable, like `Status.3`, if the name is of that form.
    fn bit_of(&self, name: &Name<'_>) -> Result<Option<Bound>, Diagnostic> {
        let program = &self.system.program;
        let bit = name.text.rsplit_once('.').and_then(|(of, bit)| Some((of, bit.parse::<u32>().ok()?)));
        let Some((of, bit)) = bit else { return Ok(None) };
        let variable = self.find(&Name { text: of, ..*name })?;
        let found = program.variable(variable);
        let unfit = |message: String| Err(Diagnostic::new(Code::RequirementTypes, name.span, message));
        if found.ty.kind != Kind::Bits || found.ty.is_bool() {
            return unfit(format!("`{of}` is of type `{}`, which is not made of bits", found.ty));
        }
        if bit >= found.ty.width {
            return unfit(format!("`{of}` has no bit {bit}: its bits are 0 to {}", found.ty.width - 1));
        }
        Ok(Some(match self.view {
            // Bits that are never stored are 0.
            _ if bit >= found.bits => Bound::Truth(false),
            View::Scan => Bound::Bit(variable, bit),
            View::Transition => Bound::Marked(self.system.place(PlaceRole::Bit { variable, bit, value: true })),
        }))
    }

    /// Finds a variable by name.
    fn find(&self, name: &Name<'_>) -> Result<VarId, Diagnostic> {
        let program = &self.system.program;
        program.named(name.text).ok_or_else(|| {
            let message = format!("the program `{}` has no variable `{}`", program.name, name.text);
            name.unknown(message, program.declared().map(|id| program.variable(id).name.as_str()))
        })
    }

    /// Binds the atom that a `BOOL` is TRUE.
    fn bit(&self, variable: VarId) -> Bound {
        debug_assert!(self.system.program.variable(variable).role != Role::Buffer);
        match self.view {
            View::Scan => Bound::Variable(variable),
            View::Transition => Bound::Marked(self.system.place(PlaceRole::Bit { variable, bit: 0, value: true })),
        }
    }

    fn only_in_transition_view(&self, what: &str, span: Span) -> Result<(), Diagnostic> {
        if self.view == View::Transition {
            return Ok(());
        }
        let message = format!("the requirement speaks of {what}, but a state of the scan view is the end of a scan");
        let help = "check it with `--view transition`";
        Err(Diagnostic::new(Code::RequirementView, span, message).help(help))
    }
}

//! Formulas to bound formulas: what each name means in a view, and what is truth and what is number.

use super::bound::{Bound, Term};
use super::formula::{Expression, Formula, Temporal};
use crate::diagnostic::{Code, Diagnostic};
use crate::semantics::{Role, VarId};
use crate::source::Span;
use crate::translate::{PlaceRole, System};

/// What a state is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// The end of a scan; a step is one scan.
    Scan,
    /// A marking of the net; a step is one firing.
    Transition,
}

/// Binds the names of a formula.
///
/// # Errors
/// Every name that means nothing in this view, and every mixture of truth values and numbers.
pub fn bind(formula: &Formula, system: &System, view: View) -> Result<Bound, Vec<Diagnostic>> {
    let mut binder = Binder { system, view, errors: Vec::new() };
    let bound = binder.truth(formula);
    if binder.errors.is_empty() { Ok(bound) } else { Err(binder.errors) }
}

struct Binder<'a> {
    system: &'a System,
    view: View,
    errors: Vec<Diagnostic>,
}

impl Binder<'_> {
    /// Reports, and gives a formula to go on with.
    fn error(&mut self, diagnostic: Diagnostic) -> Bound {
        self.errors.push(diagnostic);
        Bound::Truth(false)
    }

    /// A formula that must be true or false.
    fn truth(&mut self, formula: &Formula) -> Bound {
        let mut two = |f: &Formula, g: &Formula| (Box::new(self.truth(f)), Box::new(self.truth(g)));
        match &formula.expression {
            Expression::Truth(value) => Bound::Truth(*value),
            Expression::Name(name) => self.variable(name, formula.span),
            Expression::AtLine(line) => self.at_line(*line, formula.span),
            Expression::AtIdle => self.control(PlaceRole::Idle, formula.span),
            Expression::AtEnd => self.control(PlaceRole::Line(self.system.program.end()), formula.span),
            Expression::Marked(name) => self.marked(name, formula.span),
            Expression::Enabled(name) => self.enabled(name, formula.span),
            Expression::Not(f) => Bound::Not(Box::new(self.truth(f))),
            Expression::And(f, g) => {
                let (f, g) = two(f, g);
                Bound::And(f, g)
            }
            Expression::Or(f, g) => {
                let (f, g) = two(f, g);
                Bound::Or(f, g)
            }
            Expression::Implies(f, g) => {
                let (f, g) = two(f, g);
                Bound::Implies(f, g)
            }
            Expression::Iff(f, g) => {
                let (f, g) = two(f, g);
                Bound::Iff(f, g)
            }
            Expression::Compare(comparison, left, right) => {
                let (left, right) = match (self.enumerated(left, right), self.enumerated(right, left)) {
                    (Some(left), _) => (left, self.number(right)),
                    (_, Some(right)) => (self.number(left), right),
                    _ => (self.number(left), self.number(right)),
                };
                if left.magnitude().is_none() || right.magnitude().is_none() {
                    let message = "the numbers in this comparison can become too large";
                    return self.error(Diagnostic::new(Code::RequirementTypes, formula.span, message));
                }
                Bound::Compare(*comparison, left, right)
            }
            Expression::Temporal(quantifier, temporal, f) => {
                let f = Box::new(self.truth(f));
                let constant = |value| Box::new(Bound::Truth(value));
                let quantifier = *quantifier;
                match temporal {
                    Temporal::Next => Bound::Next(quantifier, f),
                    Temporal::Finally => Bound::Until { quantifier, weak: false, hold: constant(true), release: f },
                    Temporal::Globally => Bound::Until { quantifier, weak: true, hold: f, release: constant(false) },
                }
            }
            Expression::Until { quantifier, weak, hold, release } => {
                let (hold, release) = two(hold, release);
                Bound::Until { quantifier: *quantifier, weak: *weak, hold, release }
            }
            Expression::Number(_) | Expression::Sum(..) | Expression::Difference(..) | Expression::Product(..) => {
                let message = "this is a number, where something true or false is needed";
                let help = match &formula.expression {
                    Expression::Number(0) => "write `FALSE`",
                    Expression::Number(1) => "write `TRUE`",
                    _ => "compare it with something, like `… = 1`",
                };
                self.error(Diagnostic::new(Code::RequirementTypes, formula.span, message).help(help))
            }
        }
    }

    /// A formula that must be a number; a truth value counts as 0 or 1.
    fn number(&mut self, formula: &Formula) -> Term {
        let mut two = |a: &Formula, b: &Formula| (Box::new(self.number(a)), Box::new(self.number(b)));
        match &formula.expression {
            Expression::Number(number) => Term::Number(*number),
            Expression::Sum(a, b) => {
                let (a, b) = two(a, b);
                Term::Sum(a, b)
            }
            Expression::Difference(a, b) => {
                let (a, b) = two(a, b);
                Term::Difference(a, b)
            }
            Expression::Product(a, b) => {
                let (a, b) = two(a, b);
                Term::Product(a, b)
            }
            Expression::Name(name) => match self.find(name, formula.span) {
                Ok(variable) => self.value(variable),
                Err(unknown) => Term::Truth(Box::new(unknown)),
            },
            _ => {
                let truth = self.truth(formula);
                if !truth.is_state_formula() {
                    let message = "a temporal formula is compared with or counted as a number";
                    let help = "the temporal operators bind more strongly than comparisons: put parentheses around what \
                                follows, like `AG (a = b)`";
                    self.error(Diagnostic::new(Code::RequirementTypes, formula.span, message).help(help));
                }
                Term::Truth(Box::new(truth))
            }
        }
    }

    /// A name that is no variable, but a value of the enumerated variable it is compared with.
    fn enumerated(&self, value: &Formula, variable: &Formula) -> Option<Term> {
        let (Expression::Name(value), Expression::Name(variable)) = (&value.expression, &variable.expression) else {
            return None;
        };
        let program = &self.system.program;
        let variable = program.find(variable).filter(|_| program.find(value).is_none())?;
        program.enumerated(variable, value).map(Term::Number)
    }

    /// A variable that must be a truth value.
    fn variable(&mut self, name: &str, span: Span) -> Bound {
        let variable = match self.find(name, span) {
            Ok(variable) => variable,
            Err(unknown) => return unknown,
        };
        let found = self.system.program.variable(variable);
        if found.ty.is_bool() {
            return self.bit(variable);
        }
        let message = format!("`{name}` is of type `{}`, where something true or false is needed", found.ty);
        let help = format!("compare it with something, like `{} != 0`", found.name);
        self.error(Diagnostic::new(Code::RequirementTypes, span, message).help(help))
    }

    /// The variable of a name, or what to go on with if there is none.
    fn find(&mut self, name: &str, span: Span) -> Result<VarId, Bound> {
        let program = &self.system.program;
        program.find(name).ok_or_else(|| {
            let message = format!("the program `{}` has no variable `{name}`", program.name);
            let names = program.declared().map(|id| program.variable(id).name.as_str());
            self.unknown(message, span, name, names)
        })
    }

    /// Whether a `BOOL` is TRUE.
    fn bit(&self, variable: VarId) -> Bound {
        debug_assert!(self.system.program.variable(variable).role != Role::Buffer);
        match self.view {
            View::Scan => Bound::Variable(variable),
            View::Transition => Bound::Marked(self.system.place(PlaceRole::Bit { variable, bit: 0, value: true })),
        }
    }

    /// The number a variable holds; a `BOOL` counts as 0 or 1.
    fn value(&self, variable: VarId) -> Term {
        let ty = self.system.program.variable(variable).ty;
        if ty.is_bool() {
            return Term::Truth(Box::new(self.bit(variable)));
        }
        if self.view == View::Scan {
            return Term::Variable(variable, ty);
        }
        // In two's complement, the highest bit of the type counts negatively.
        let weight = |bit: u32| if ty.is_signed() && bit + 1 == ty.width { -(1_i128 << bit) } else { 1 << bit };
        let bits = (0..).zip(self.system.bits(variable));
        let places = bits.map(|(bit, [_, place])| (place, weight(bit))).collect();
        Term::Bits { variable, places }
    }

    fn at_line(&mut self, line: usize, span: Span) -> Bound {
        let lines = self.system.program.end();
        match line.checked_sub(1).filter(|&line| line < lines) {
            Some(line) => self.control(PlaceRole::Line(line), span),
            None => {
                let message = format!("the flat code has no line {line}");
                let help = format!("its lines are 1 to {lines}; `petril flat` prints them");
                self.error(Diagnostic::new(Code::RequirementNameUnknown, span, message).help(help))
            }
        }
    }

    fn control(&mut self, role: PlaceRole, span: Span) -> Bound {
        match self.view {
            View::Transition => Bound::Marked(self.system.place(role)),
            View::Scan => self.only_in_transition_view("where control is", span),
        }
    }

    fn marked(&mut self, name: &str, span: Span) -> Bound {
        let system = self.system;
        let net = &system.net;
        match (self.view, net.find_place(name)) {
            (View::Scan, _) => self.only_in_transition_view("a place of the net", span),
            (View::Transition, Some(place)) => Bound::Marked(place),
            (View::Transition, None) => {
                let names = net.places().map(|place| place.name);
                let message = format!("the net has no place `{name}`");
                self.unknown(message, span, name, names)
            }
        }
    }

    fn enabled(&mut self, name: &str, span: Span) -> Bound {
        let system = self.system;
        let net = &system.net;
        match (self.view, net.find_transition(name)) {
            (View::Scan, _) => self.only_in_transition_view("a transition of the net", span),
            (View::Transition, Some(transition)) => Bound::Enabled(transition),
            (View::Transition, None) => {
                let names = net.transitions().map(|transition| transition.name);
                let message = format!("the net has no transition `{name}`");
                self.unknown(message, span, name, names)
            }
        }
    }

    /// Reports a name that means nothing, with the nearest of those that do.
    fn unknown<'n>(
        &mut self,
        message: String,
        span: Span,
        written: &str,
        names: impl Iterator<Item = &'n str>,
    ) -> Bound {
        let diagnostic = Diagnostic::new(Code::RequirementNameUnknown, span, message);
        self.error(diagnostic.suggest_at(self.errors.len(), written, names))
    }

    fn only_in_transition_view(&mut self, what: &str, span: Span) -> Bound {
        let message = format!("the requirement speaks of {what}, but a state of the scan view is the end of a scan");
        let help = "check it with `--view transition`";
        self.error(Diagnostic::new(Code::RequirementView, span, message).help(help))
    }
}

//! Proof check by decision diagrams: an independent confirmation of what holds from every state.

use fixedbitset::FixedBitSet;

use super::subject::{Claim, Form, Subject};
use crate::sif::{Diagram, Diagrams, Kind, SignalId};
use petril_lang::circuit::{Gate, ScanGates, Wire};

/// Upper bound on nodes of a diagram.
const MAX_NODES: usize = 1 << 14;

/// Upper bound on nodes of all diagrams built for one claim.
const MAX_WORK: usize = 1 << 21;

/// Whether a claim holds after a scan from any state, reachable or not; `None` if diagrams get too large.
pub(super) fn holds(subject: &Subject<'_>, gates: &ScanGates, claim: &Claim) -> Option<bool> {
    let mut opinion = Opinion::new(subject, gates, claim)?;
    let is = opinion.wire(gates.end[claim.variable.0][0])?;
    let signals = opinion.signals(claim)?;
    let wanted = signals.wanted;
    let mut bad = match claim.form {
        Form::Equal | Form::Latched => opinion.diagrams.xor(&is, &wanted)?,
        Form::NotWithout => opinion.diagrams.and(&is, &wanted.complement())?,
    };
    for &restriction in &claim.restrictions {
        if bad.is_empty() {
            return Some(true);
        }
        let allowed = &subject.specification.restrictions[restriction].allowed;
        let allowed = opinion.diagrams.formula(allowed, &|id| signals.values[id.0].clone())?;
        bad = opinion.diagrams.and(&bad, &allowed)?;
    }
    for (error, ..) in &gates.errors {
        if bad.is_empty() {
            return Some(true);
        }
        let error = opinion.wire(*error)?;
        bad = opinion.diagrams.and(&bad, &error.complement())?;
    }
    Some(bad.is_empty())
}

/// Diagrams of the specification's signals.
struct Signals {
    /// Value of each signal needed.
    values: Vec<Option<Diagram>>,
    /// Value of the claim's signal without delay.
    wanted: Diagram,
}

struct Opinion<'a> {
    subject: &'a Subject<'a>,
    gates: &'a ScanGates,
    /// Manager of the diagrams, over the inputs of the network by number, followed by the other free variables by
    /// signal.
    diagrams: Diagrams,
    nodes: Vec<Option<Diagram>>,
    work: usize,
}

impl<'a> Opinion<'a> {
    fn new(subject: &'a Subject<'a>, gates: &'a ScanGates, claim: &Claim) -> Option<Self> {
        // Variable order: as program and specification reach their inputs.
        let mut order = Vec::new();
        let mut seen = FixedBitSet::with_capacity(gates.first_gate() + gates.gates.len());
        let mut left: Vec<usize> = gates.errors.iter().map(|(wire, ..)| wire.node()).collect();
        left.extend(subject.inputs().map(|(_, variable)| gates.beginning[variable.0][0].node()));
        left.extend(
            subject
                .definitions
                .iter()
                .filter(|id| subject.is_delayed(**id))
                .filter_map(|id| subject.variables[id.0].map(|variable| gates.end[variable.0][0].node())),
        );
        left.push(gates.end[claim.variable.0][0].node());
        while let Some(node) = left.pop() {
            if node == 0 || seen.put(node) {
                continue;
            }
            match node.checked_sub(gates.first_gate()) {
                None => order.push(SignalId(node - 1)),
                Some(number) => {
                    let (Gate::And(a, b) | Gate::Xor(a, b)) = gates.gates[number];
                    left.extend([b.node(), a.node()]);
                }
            }
        }
        let free = subject.definitions.iter().filter(|id| subject.latch(**id).is_some()).chain(&subject.outside);
        order.extend(free.map(|id| SignalId(gates.inputs.len() + id.0)));
        let signals = gates.inputs.len() + subject.specification.signals.len();
        let diagrams = Diagrams::over(order, signals, MAX_NODES)?;
        Some(Self { subject, gates, diagrams, nodes: vec![None; seen.len()], work: 0 })
    }

    /// Free variable of a signal: its latch, or its value outside the program.
    fn free(&self, id: SignalId) -> Option<Diagram> {
        self.diagrams.signal(SignalId(self.gates.inputs.len() + id.0))
    }

    fn wire(&mut self, wire: Wire) -> Option<Diagram> {
        let mut left = vec![wire.node()];
        while let Some(&node) = left.last() {
            if self.nodes[node].is_some() {
                left.pop();
                continue;
            }
            let made = match node.checked_sub(self.gates.first_gate()) {
                None if node == 0 => Some(self.diagrams.constant(false)),
                None => Some(self.diagrams.signal(SignalId(node - 1))?),
                Some(number) => {
                    let gate = self.gates.gates[number];
                    let (Gate::And(a, b) | Gate::Xor(a, b)) = gate;
                    match (self.known(a), self.known(b)) {
                        (Some(a), Some(b)) if matches!(gate, Gate::And(..)) => Some(self.diagrams.and(&a, &b)?),
                        (Some(a), Some(b)) => Some(self.diagrams.xor(&a, &b)?),
                        _ => {
                            left.extend([b.node(), a.node()]);
                            None
                        }
                    }
                }
            };
            if let Some(made) = made {
                self.work += made.size();
                if self.work > MAX_WORK {
                    return None;
                }
                self.nodes[node] = Some(made);
                left.pop();
            }
        }
        self.known(wire)
    }

    fn known(&self, wire: Wire) -> Option<Diagram> {
        let known = self.nodes[wire.node()].as_ref()?;
        Some(if wire.is_complement() { known.complement() } else { known.clone() })
    }

    fn signals(&mut self, claim: &Claim) -> Option<Signals> {
        let subject = self.subject;
        let mut needed = FixedBitSet::with_capacity(subject.specification.signals.len());
        needed.insert(claim.signal.0);
        let add = |needed: &mut FixedBitSet, id: SignalId| needed.insert(id.0);
        for &restriction in &claim.restrictions {
            subject.specification.restrictions[restriction].allowed.each_signal(&mut |id| add(&mut needed, id));
        }
        for &id in subject.definitions.iter().rev() {
            if let (true, Kind::Defined { formula, latched, .. }) =
                (needed.contains(id.0), &subject.specification.signal(id).kind)
            {
                formula.each_signal(&mut |id| add(&mut needed, id));
                latched.iter().for_each(|reset| reset.each_signal(&mut |id| add(&mut needed, id)));
            }
        }
        let mut values = vec![None; subject.specification.signals.len()];
        for (id, variable) in subject.inputs().filter(|(id, _)| needed.contains(id.0)) {
            values[id.0] = Some(self.wire(self.gates.beginning[variable.0][0])?);
        }
        for &id in &subject.outside {
            values[id.0] = Some(self.free(id)?);
        }
        let mut wanted = None;
        for &id in subject.definitions.iter().filter(|id| needed.contains(id.0)) {
            let Kind::Defined { formula, latched, .. } = &subject.specification.signal(id).kind else { continue };
            let mut now = self.diagrams.formula(formula, &|id| values[id.0].clone())?;
            if let Some(reset) = latched {
                let reset = self.diagrams.formula(reset, &|id| values[id.0].clone())?;
                let kept = self.diagrams.and(&self.free(id)?, &reset.complement())?;
                now = self.diagrams.or(&now, &kept)?;
            }
            if id == claim.signal {
                wanted = Some(now.clone());
            }
            values[id.0] = match subject.variables[id.0].filter(|_| subject.is_delayed(id)) {
                Some(variable) => Some(self.wire(self.gates.end[variable.0][0])?),
                None => Some(now),
            };
        }
        Some(Signals { values, wanted: wanted? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sif::Specification;
    use petril_base::source::Source;
    use petril_lang::flat::{Tolerated, flatten};
    use petril_lang::semantics;
    use petril_lang::syntax;

    /// Answers for all claims about a program with inputs a, b, c and outputs y, z.
    fn opinions(text: &str, body: &str, tolerated: Tolerated) -> Vec<Option<bool>> {
        let program = format!(
            "PROGRAM p VAR_INPUT a, b, c : BOOL; END_VAR VAR_OUTPUT y, z : BOOL; END_VAR VAR n : INT; END_VAR\n{body}\nEND_PROGRAM"
        );
        let (unit, _) = syntax::parse(&Source::new("program", program.as_str()));
        let Some(program) = semantics::check(&unit, true).0 else { panic!("{program}") };
        let program = flatten(&program);
        let (specification, errors) = Specification::read(&[Source::new("test.sif", text)]);
        let Some(specification) = specification else { panic!("{errors:#?}") };
        let Ok(subject) = Subject::new(&specification, &program, tolerated, &[]) else { panic!("{text}") };
        let Ok(gates) = ScanGates::of(&program, tolerated) else { panic!("{body}") };
        subject.claims.iter().map(|claim| holds(&subject, &gates, claim)).collect()
    }

    fn function(output: &str, formal: &str) -> String {
        format!("function F {{ interface {{ input a; input b; input c; output y{output}; }} formal {{ {formal} }} }}")
    }

    fn opinion(text: &str, body: &str) -> Vec<Option<bool>> {
        opinions(text, body, Tolerated::default())
    }

    #[test]
    fn what_differs_somewhere_is_seen() {
        let (and, or) = ("LD a\nAND b\nST y", "LD a\nOR b\nST y");
        assert_eq!(opinion(&function("", "y = a & b;"), and), [Some(true)]);
        assert_eq!(opinion(&function("", "y = a & b;"), or), [Some(false)]);
        // OR is XOR where at most one is TRUE, whatever else is restricted before or after.
        for (restricted, expected) in [
            ("", false),
            ("restriction R: at most one of a, b;", true),
            ("restriction R: never c;", false),
            ("restriction R: never c; restriction S: at most one of a, b;", true),
            ("restriction R: at most one of a, b; restriction S: never c;", true),
            ("restriction R: never c; restriction S: never (a & c);", false),
        ] {
            assert_eq!(
                opinion(&function("", &format!("y = a xor b; {restricted}")), or),
                [Some(expected)],
                "{restricted}"
            );
        }
        // TRUE without reason, and FALSE too late.
        assert_eq!(opinion(&function(" delayed T#1s", "y = a & b;"), "LD a\nAND b\nAND c\nST y"), [Some(true)]);
        assert_eq!(opinion(&function(" delayed T#1s", "y = a & b;"), "LD a\nST y"), [Some(false)]);
        // An unreachable state has the latch set and the output FALSE.
        let latch = "LD c\nR y\nLD a\nAND b\nS y";
        assert_eq!(opinion(&function(" latched until c", "y = a & b;"), latch), [Some(false)]);
    }

    #[test]
    fn scans_that_fail_are_left_out_and_no_others() {
        let text = function("", "y = a & b;");
        // 6 / 1 is greater than 5, 6 / 2 is not, and 6 / 0 is an error, or 0.
        let dividing = "LD a\nBOOL_TO_INT\nST n\nLD b\nBOOL_TO_INT\nADD n\nST n\nLD 6\nDIV n\nGT 5\nNOT\nST y";
        let zero = Tolerated { overflow: false, division_by_zero: true };
        assert_eq!(opinion(&text, dividing), [Some(true)]);
        assert_eq!(opinions(&text, dividing, zero), [Some(false)]);
        // The program is wrong in scans without an error, too: those with c.
        let wrong = "LD c\nBOOL_TO_INT\nST n\nLD 6\nDIV n\nST n\nLD a\nOR b\nST y";
        assert_eq!(opinion(&text, wrong), [Some(false)]);
    }

    #[test]
    fn outputs_are_what_is_specified_of_them_unless_they_are_delayed() {
        let text = |delay: &str| {
            format!(
                "function F {{ interface {{ input a; output y{delay}; }} formal {{ y = a; }} }}
                 function G {{ interface {{ input b; input y; output z; }} formal {{ z = y & b; }} }}"
            )
        };
        let late = "LD a\nAND c\nST y\nLD a\nAND b\nST z";
        assert_eq!(opinion(&text(""), "LD a\nST y\nAND b\nST z"), [Some(true), Some(true)]);
        assert_eq!(opinion(&text(""), late), [Some(false), Some(true)]);
        assert_eq!(opinion(&text(" delayed T#1s"), late), [Some(true), Some(false)]);
        assert_eq!(opinion(&text(" delayed T#1s"), "LD a\nAND c\nST y\nAND b\nST z"), [Some(true), Some(true)]);
        // Inputs that the program does not have take any values the restrictions allow.
        let outside = "restriction R: always a -> elsewhere; restriction S: always elsewhere -> b; input elsewhere;";
        let text = outside.to_owned() + &function("", "y = a & b;");
        assert_eq!(opinion(&text, "LD a\nST y"), [Some(true)]);
        assert_eq!(opinion(&text.replace("elsewhere -> b", "elsewhere -> c"), "LD a\nST y"), [Some(false)]);
    }
}

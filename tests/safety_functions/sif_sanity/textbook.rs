//! The definitions, by trying every state: values of all inputs, and, for outputs that are latched or delayed, what is
//! remembered of the scan before and whether the time has passed.

use petril::sif::{Formula, Kind, Operator, Scope, SignalId, Specification};

/// A state of the whole specification.
#[derive(Clone)]
pub struct State {
    /// What others see.
    pub seen: Vec<bool>,
    /// What formulas say.
    pub formula: Vec<bool>,
    /// What resets say.
    pub reset: Vec<bool>,
    /// What is kept of the scan before, if it was TRUE then.
    was: Vec<bool>,
    /// Whether the time has passed.
    long: Vec<bool>,
}

/// One occurrence of a signal: in the formula or the reset of a signal, so many to its left.
pub type Occurrence = (SignalId, bool, usize);

pub struct Textbook<'s> {
    pub specification: &'s Specification,
    pub states: Vec<State>,
}

fn memory(specification: &Specification) -> Vec<SignalId> {
    let has = |id: &SignalId| match &specification.signal(*id).kind {
        Kind::Defined { latched, delayed, .. } => latched.is_some() || delayed.is_some(),
        Kind::Input { .. } => false,
    };
    (0..specification.signals.len()).map(SignalId).filter(has).collect()
}

impl<'s> Textbook<'s> {
    pub fn new(specification: &'s Specification) -> Self {
        let inputs: Vec<SignalId> = specification.inputs().collect();
        let memory = memory(specification);
        let mut states = Vec::new();
        let bits = inputs.len() + 2 * memory.len();
        for number in 0..1_u32 << bits {
            let bit = |at: usize| number >> at & 1 == 1;
            let mut values = vec![false; specification.signals.len()];
            inputs.iter().enumerate().for_each(|(at, input)| values[input.0] = bit(at));
            let (mut was, mut long) = (vec![false; values.len()], vec![false; values.len()]);
            for (at, id) in memory.iter().enumerate() {
                was[id.0] = bit(inputs.len() + 2 * at);
                long[id.0] = bit(inputs.len() + 2 * at + 1);
            }
            states.extend(computed(specification, &values, &was, &long, None));
        }
        Self { specification, states }
    }

    /// Whether a state is allowed by restrictions.
    pub fn keeps(&self, state: &State, restrictions: &[usize]) -> bool {
        restrictions.iter().all(|at| holds(&self.specification.restrictions[*at].allowed, &state.seen))
    }

    /// The restrictions that hold for a scope.
    pub fn of(&self, scope: Scope) -> Vec<usize> {
        let meets = |other: Scope| match (other, scope) {
            (Scope::System, _) => true,
            (Scope::Zone(zone), Scope::Function(function)) => self.specification.functions[function].zone == Some(zone),
            _ => other == scope,
        };
        let all = self.specification.restrictions.iter().enumerate();
        all.filter(|(_, restriction)| meets(restriction.scope)).map(|(at, _)| at).collect()
    }

    /// Whether there is a state in which restrictions are kept and this is so.
    pub fn can(&self, restrictions: &[usize], so: impl Fn(&State) -> bool) -> bool {
        self.states.iter().any(|state| self.keeps(state, restrictions) && so(state))
    }

    /// Whether these restrictions make something impossible, and none of them can be left out.
    pub fn is_core(&self, core: &[usize], so: impl Fn(&State) -> bool) -> bool {
        let without = |left_out: &usize| core.iter().copied().filter(|at| at != left_out).collect::<Vec<_>>();
        !self.can(core, &so) && core.iter().all(|at| self.can(&without(at), &so))
    }

    /// Whether some root of a function is otherwise in a state where an input is, or an occurrence is negated.
    pub fn differs(&self, state: &State, roots: &[SignalId], change: Change) -> bool {
        let mut values = state.seen.clone();
        if let Change::Input(input) = change {
            values[input.0] = !values[input.0];
        }
        let occurrence = match change {
            Change::Occurrence(occurrence) => Some(occurrence),
            Change::Input(_) => None,
        };
        let others = computed(self.specification, &values, &state.was, &state.long, occurrence);
        let is_other = |other: &State| {
            roots.iter().any(|root| {
                other.formula[root.0] != state.formula[root.0] || other.reset[root.0] != state.reset[root.0]
            })
        };
        others.iter().any(is_other)
    }

    /// The occurrences in the equations and resets of a function, each with its signal.
    pub fn occurrences(&self, function: usize) -> Vec<(Occurrence, SignalId)> {
        let mut all = Vec::new();
        for &of in &self.specification.functions[function].equations {
            let Kind::Defined { formula, latched, .. } = &self.specification.signal(of).kind else { continue };
            let mut at = 0;
            formula.each_signal(&mut |signal| {
                all.push(((of, false, at), signal));
                at += 1;
            });
            at = 0;
            if let Some(reset) = latched {
                reset.each_signal(&mut |signal| {
                    all.push(((of, true, at), signal));
                    at += 1;
                });
            }
        }
        all
    }

    /// The signals of a formula, with all that they are computed from, but not by way of resets.
    pub fn below(&self, formula: &Formula) -> Vec<SignalId> {
        let mut found: Vec<SignalId> = Vec::new();
        let mut left = formula.signals();
        while let Some(signal) = left.pop() {
            if !found.contains(&signal) {
                found.push(signal);
                left.extend(self.specification.definition(signal).map(Formula::signals).unwrap_or_default());
            }
        }
        found
    }

    /// The causes of an output: formulas, each with what has to be true beside it.
    pub fn causes(&self, function: usize, output: SignalId) -> Vec<(Formula, Vec<Formula>, Vec<usize>)> {
        let mut all = Vec::new();
        let shape = self.normal(function, self.specification.definition(output).unwrap(), true);
        list(&shape, &[], &[], &mut all);
        all
    }

    /// Negation normal form, auxiliary values written out.
    fn normal(&self, function: usize, formula: &Formula, is_true: bool) -> Normal {
        let whole = || Normal::Whole(if is_true { formula.clone() } else { Formula::Not(Box::new(formula.clone())) });
        match formula {
            Formula::Signal(id) => match &self.specification.signal(*id).kind {
                Kind::Defined { is_output: false, formula, function: of, .. } if *of == function => {
                    self.normal(function, formula, is_true)
                }
                _ => whole(),
            },
            Formula::Constant(_) => whole(),
            Formula::Not(inner) => self.normal(function, inner, !is_true),
            Formula::Gate(operator, operands) => {
                let of = |at: usize, is_true: bool| self.normal(function, &operands[at], is_true);
                let same = || (0..operands.len()).map(|at| of(at, is_true)).collect();
                match operator {
                    Operator::And if is_true => Normal::And(same()),
                    Operator::And => Normal::Or(same()),
                    Operator::Or if is_true => Normal::Or(same()),
                    Operator::Or => Normal::And(same()),
                    Operator::Implies if is_true => Normal::Or(vec![of(0, false), of(1, true)]),
                    Operator::Implies => Normal::And(vec![of(0, true), of(1, false)]),
                    Operator::Xor | Operator::Iff if operands.len() == 2 => {
                        let same = (*operator == Operator::Iff) == is_true;
                        Normal::Or(vec![
                            Normal::And(vec![of(0, true), of(1, same)]),
                            Normal::And(vec![of(0, false), of(1, !same)]),
                        ])
                    }
                    _ => whole(),
                }
            }
        }
    }
}

#[derive(Clone, Copy)]
pub enum Change {
    Input(SignalId),
    Occurrence(Occurrence),
}

enum Normal {
    Whole(Formula),
    And(Vec<Normal>),
    Or(Vec<Normal>),
}

impl Normal {
    fn formula(&self) -> Formula {
        let gate = |operator, of: &[Normal]| Formula::Gate(operator, of.iter().map(Normal::formula).collect());
        match self {
            Self::Whole(formula) => formula.clone(),
            Self::And(of) => gate(Operator::And, of),
            Self::Or(of) => gate(Operator::Or, of),
        }
    }
}

/// All operands of disjunctions, with the conjunctions they stand in and the causes around them.
fn list(normal: &Normal, beside: &[Formula], within: &[usize], all: &mut Vec<(Formula, Vec<Formula>, Vec<usize>)>) {
    match normal {
        Normal::Whole(_) => {}
        Normal::And(of) => {
            for (at, part) in of.iter().enumerate() {
                let others = of.iter().enumerate().filter(|(other, _)| *other != at).map(|(_, other)| other.formula());
                let beside: Vec<Formula> = beside.iter().cloned().chain(others).collect();
                list(part, &beside, within, all);
            }
        }
        Normal::Or(of) => {
            for cause in of {
                all.push((cause.formula(), beside.to_vec(), within.to_vec()));
                let within = [within, &[all.len() - 1]].concat();
                list(cause, beside, &within, all);
            }
        }
    }
}

pub fn holds(formula: &Formula, values: &[bool]) -> bool {
    match formula {
        Formula::Constant(value) => *value,
        Formula::Signal(signal) => values[signal.0],
        Formula::Not(inner) => !holds(inner, values),
        Formula::Gate(operator, operands) => {
            let operands: Vec<bool> = operands.iter().map(|operand| holds(operand, values)).collect();
            let ones = operands.iter().filter(|value| **value).count();
            match operator {
                Operator::And => ones == operands.len(),
                Operator::Or => ones > 0,
                Operator::Xor => ones % 2 == 1,
                Operator::Implies => !operands[0] || operands[1],
                Operator::Iff => operands[0] == operands[1],
                Operator::AtMostOne => ones <= 1,
                Operator::ExactlyOne => ones == 1,
            }
        }
    }
}

/// The states with these inputs and memories: none or several, if a reset depends on what it resets.
fn computed(
    specification: &Specification,
    inputs: &[bool],
    was: &[bool],
    long: &[bool],
    negated: Option<Occurrence>,
) -> Vec<State> {
    let memory = memory(specification);
    let mut states = Vec::new();
    for keeps in 0..1_u32 << memory.len() {
        let (mut seen, mut formula, mut reset) =
            (inputs.to_vec(), vec![false; inputs.len()], vec![false; inputs.len()]);
        let mut kept = vec![false; inputs.len()];
        memory.iter().enumerate().for_each(|(at, id)| kept[id.0] = keeps >> at & 1 == 1);
        for &id in &specification.order {
            let Kind::Defined { formula: of, latched, delayed, .. } = &specification.signal(id).kind else { continue };
            formula[id.0] = with_one_negated(of, &seen, negated.filter(|n| n.0 == id && !n.1));
            let set = formula[id.0] && (delayed.is_none() || long[id.0]);
            seen[id.0] = set || latched.is_some() && kept[id.0];
        }
        let mut is_so = true;
        for id in &memory {
            let Kind::Defined { latched, .. } = &specification.signal(*id).kind else { continue };
            match latched {
                Some(latched) => {
                    reset[id.0] = with_one_negated(latched, &seen, negated.filter(|n| n.0 == *id && n.1));
                    is_so &= kept[id.0] == (was[id.0] && !reset[id.0]);
                }
                None => is_so &= !kept[id.0],
            }
        }
        if is_so {
            states.push(State { seen, formula, reset, was: was.to_vec(), long: long.to_vec() });
        }
    }
    states
}

/// The value of a formula in which one occurrence is negated.
fn with_one_negated(formula: &Formula, seen: &[bool], negated: Option<Occurrence>) -> bool {
    let mut at = 0;
    let values = formula.map(&mut |signal| {
        at += 1;
        seen[signal.0] != negated.is_some_and(|negated| negated.2 + 1 == at)
    });
    let as_constants = constants(&values);
    holds(&as_constants, seen)
}

fn constants(formula: &Formula<bool>) -> Formula {
    match formula {
        Formula::Constant(value) | Formula::Signal(value) => Formula::Constant(*value),
        Formula::Not(inner) => Formula::Not(Box::new(constants(inner))),
        Formula::Gate(operator, operands) => Formula::Gate(*operator, operands.iter().map(constants).collect()),
    }
}

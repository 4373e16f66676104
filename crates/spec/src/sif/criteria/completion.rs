//! Values of the inputs that a function does not depend on: at rest, or as close to rest as restrictions allow.

use fixedbitset::FixedBitSet;

use super::super::cone::{Cone, Encoded, inputs_of};
use super::super::formula::SignalId;
use super::super::solver::{Answer, Literal};
use super::super::specification::{Restriction, Specification};
use super::limits::{Limits, Questions};

/// Completes valuations of the varied inputs to tests of all inputs.
pub struct Completion<'s> {
    cone: Cone<'s>,
    outside: Outside,
    questions: Questions,
    encoded: Encoded,
}

/// Inputs outside a cone that are TRUE.
enum Outside {
    Set(FixedBitSet),
    /// The restrictions on them contradict each other.
    Contradiction,
    /// The limits did not suffice to find them.
    Unknown,
}

impl<'s> Completion<'s> {
    /// Prepares the completion of tests of a function with this cone.
    pub fn new(cone: &Cone<'s>, function: usize, limits: &Limits) -> Self {
        let mut questions = Questions::new(limits);
        let encoded = cone.encode(&mut questions.solver);
        for restriction in &encoded.restrictions {
            questions.solver.require([*restriction]);
        }
        let outside = outside(cone, function, limits);
        Self { cone: cone.clone(), outside, questions, encoded }
    }

    /// Whether no test is possible because restrictions on other inputs contradict each other.
    pub fn contradicts(&self) -> bool {
        matches!(self.outside, Outside::Contradiction)
    }

    /// All inputs that are TRUE in a test with this valuation of the varied inputs; `None` if impossible or not found
    /// within the limits.
    pub fn complete(&mut self, varied: &FixedBitSet) -> Option<FixedBitSet> {
        let Outside::Set(outside) = &self.outside else { return None };
        let mut inputs = outside.clone();
        let specification = self.cone.specification;
        self.cone.inputs.iter().filter(|input| varied.contains(input.0)).for_each(|input| inputs.insert(input.0));
        if self.cone.restrictions.is_empty() {
            return Some(inputs);
        }
        let literals = &self.encoded.literals;
        let fixed = |input: &SignalId| {
            let literal = literals[input.0];
            if varied.contains(input.0) { literal } else { !literal }
        };
        let fixed: Vec<_> = self.cone.inputs.iter().map(fixed).collect();
        let wished: Vec<_> =
            self.cone.connected.iter().map(|input| at_rest(specification, &self.encoded, *input)).collect();
        let kept = self.questions.closest(&fixed, &wished)?;
        for (input, is_at_rest) in self.cone.connected.iter().zip(kept) {
            inputs.set(input.0, specification.rest(*input) == is_at_rest);
        }
        Some(inputs)
    }
}

/// Literal that is true when an input is at rest.
fn at_rest(specification: &Specification, encoded: &Encoded, input: SignalId) -> Literal {
    let literal = encoded.literals[input.0];
    if specification.rest(input) { literal } else { !literal }
}

fn outside(cone: &Cone<'_>, function: usize, limits: &Limits) -> Outside {
    let specification = cone.specification;
    let resting = specification.valuation(specification.inputs().filter(|input| specification.rest(*input)));
    let mut inputs = resting.clone();
    cone.all_inputs().for_each(|input| inputs.set(input.0, false));
    let is_inside =
        |restriction: &&Restriction| cone.restrictions.iter().any(|other| std::ptr::eq(*other, *restriction));
    let others: Vec<&Restriction> =
        specification.restrictions_of(function).filter(|restriction| !is_inside(restriction)).collect();
    let settled = specification.settled(&resting);
    if others.iter().all(|restriction| restriction.allowed.holds(|signal| settled.contains(signal.0))) {
        return Outside::Set(inputs);
    }
    let of: Vec<SignalId> =
        others.iter().flat_map(|restriction| inputs_of(specification, &restriction.allowed)).collect();
    let around = Cone::of(specification, &of, others);
    let mut questions = Questions::new(limits);
    let encoded = around.encode(&mut questions.solver);
    for restriction in &encoded.restrictions {
        questions.solver.require([*restriction]);
    }
    let wished: Vec<_> = around.inputs.iter().map(|input| at_rest(specification, &encoded, *input)).collect();
    if questions.ask(&[]) == Answer::Unsatisfiable {
        return Outside::Contradiction;
    }
    let Some(kept) = questions.closest(&[], &wished) else { return Outside::Unknown };
    for (input, is_at_rest) in around.inputs.iter().zip(kept) {
        inputs.set(input.0, specification.rest(*input) == is_at_rest);
    }
    Outside::Set(inputs)
}

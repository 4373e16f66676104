//! Random allowed valuations.

use fixedbitset::FixedBitSet;

use super::super::cone::Encoded;
use super::super::faults::Model;
use super::super::solver::{Answer, Literal};
use super::limits::{Limits, Questions};
use petril_check::simulate::Lots;

/// Upper bound on wishes dropped for one valuation.
const MAX_REPAIRS: usize = 200;

/// Random allowed valuations of all inputs of a cone; the seed is fixed. A valuation that violates restrictions is
/// repaired: a random wish of the unsatisfiable core is dropped until the rest is allowed.
pub fn sample(
    model: &Model<'_>,
    questions: &mut Questions,
    encoded: &Encoded,
    count: usize,
    limits: &Limits,
) -> Vec<FixedBitSet> {
    let mut lots = Lots::new(0);
    let inputs: Vec<_> = model.cone.all_inputs().collect();
    let mut found = Vec::new();
    for number in 0..count {
        // Few ones, as many as zeros, many ones: gates with many operands need skewed inputs.
        let quarters = [2, 1, 3, 2][number % 4];
        let wishes = inputs.iter().map(|input| (*input, lots.below(4) < quarters));
        let wishes: Vec<_> = wishes.collect();
        if model.cone.restrictions.is_empty() {
            let ones = wishes.iter().filter(|(_, value)| *value).map(|(input, _)| *input);
            found.push(model.specification.valuation(ones));
            continue;
        }
        let literal = |(input, value): &(super::super::formula::SignalId, bool)| {
            let literal = encoded.literals[input.0];
            if *value { literal } else { !literal }
        };
        let mut assumed: Vec<Literal> = wishes.iter().map(literal).collect();
        for _ in 0..MAX_REPAIRS {
            if (limits.stop)() {
                return found;
            }
            match questions.ask(&assumed) {
                Answer::Satisfiable => {
                    found.push(encoded.model(&model.cone, &questions.solver));
                    break;
                }
                Answer::Unsatisfiable => {
                    let core = questions.solver.core(&assumed);
                    let Some(given_up) = lots.one_of(&core).copied() else { return found };
                    assumed.retain(|literal| *literal != given_up);
                }
                Answer::Stopped => break,
            }
        }
    }
    found
}

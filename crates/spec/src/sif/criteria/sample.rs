//! Valuations by chance that can be.

use fixedbitset::FixedBitSet;

use super::super::cone::Encoded;
use super::super::faults::Model;
use super::super::solver::{Answer, Literal};
use super::limits::{Limits, Questions};
use petril_check::simulate::Lots;

/// Most wishes that are given up for one valuation, one after the other.
const MAX_REPAIRS: usize = 200;

/// So many valuations of all inputs of a cone that can be, by chance, the same every time. What restrictions do not allow is repaired:
/// of what is to blame, one thing by chance is given up, until the rest can be.
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
        // Few ones, as many as zeros, many ones: gates with many operands are rarely decided by halves.
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

//! Common factors of the weights around a place.
//!
//! If a number g divides every weight at a place that is not kept, then x tokens on it enable the same as x / g tokens
//! (rounded down) with all these weights divided by g.
//!
//! Keeps everything: only the tokens of the place change.
//!
//! Source: Thierry-Mieg 2020, "Structural reductions revisited"; it follows from the firing rule.

use super::Rule;
use super::draft::Draft;
use crate::structure::sparse::gcd;

pub fn apply(draft: &mut Draft, place: u32) -> bool {
    let around = draft.around(place);
    draft.spend(around.len() + 1);
    let weights = around.iter().flat_map(|&id| [draft.needs(id, place), draft.puts(id, place)]);
    let divisor = weights.fold(0, gcd);
    if divisor <= 1 || draft.place(place).is_kept {
        return false;
    }
    for id in around {
        let row = draft.transition(id);
        let (mut pre, mut post) = (row.pre.clone(), row.post.clone());
        let arcs = pre.iter_mut().chain(&mut post);
        arcs.filter(|arc| arc.0 == place).for_each(|arc| arc.1 /= divisor);
        draft.rewrite(id, pre, post);
    }
    draft.places[place as usize].tokens /= divisor;
    draft.count(Rule::Scaled, 1);
    true
}

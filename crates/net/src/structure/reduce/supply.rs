//! Places that can initially be filled with any number of tokens.
//!
//! A transition is enabled initially, takes no tokens without putting them back, and changes no kept place. So it can
//! fire any number of times first, and the places to which it adds tokens never lack any. They are removed, and so is
//! the transition.
//!
//! Keeps reachability. If deadlocks matter, [`super::alive`] comes first.
//!
//! Source: source transitions, Murata 1989; here by the monotony of the firing rule.

use super::draft::Draft;
use super::log::{Around, Step};
use super::{Property, Rule};

pub fn apply(draft: &mut Draft) {
    if draft.property != Property::Reachability {
        return;
    }
    for id in draft.transition_ids().collect::<Vec<u32>>() {
        let row = draft.transition(id);
        let never_takes = row
            .pre
            .iter()
            .all(|&(place, weight)| weight <= draft.place(place).tokens && weight <= draft.puts(id, place));
        if row.is_held || !never_takes || !draft.is_silent(id) {
            continue;
        }
        let filled: Vec<u32> = draft.effect(id).into_iter().map(|(place, _)| place).collect();
        if filled.is_empty() {
            continue;
        }
        let around = Around::of(draft, &filled);
        draft.spend(around.transitions.len());
        draft.log.step(Step::Supplied { transition: id, around });
        filled.iter().for_each(|&place| draft.remove_place(place));
        draft.remove_transition(id);
        draft.count(Rule::Supply, filled.len());
    }
}

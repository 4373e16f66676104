//! Places that can be filled at the beginning as much as one likes.
//!
//! A transition is enabled at the beginning, takes nothing for good, and changes no kept place. So before anything else happens, it
//! can fire as often as one likes, and the places it adds tokens to never run short. They go, and so does the transition.
//!
//! Keeps what is reachable. Where deadlocks matter, [`super::alive`] comes before it.
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

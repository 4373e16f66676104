//! A transition that needs nothing.
//!
//! It is always enabled, so no marking is dead. A transition without arcs is added that says so in the reduced net, too; for the
//! rest, what is reachable is all that matters.
//!
//! Keeps what is reachable, and deadlocks: there are none, before and after.

use super::draft::{Draft, Row};
use super::{Property, Rule};

pub fn apply(draft: &mut Draft) {
    if draft.property == Property::Deadlock && draft.transition_ids().any(|id| draft.transition(id).pre.is_empty()) {
        draft.log.word(&[]);
        let id = draft.add(Row::new(), Row::new());
        draft.transitions[id as usize].is_held = true;
        draft.property = Property::Reachability;
        draft.count(Rule::Alive, 1);
    }
}

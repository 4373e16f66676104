//! Transitions that are always enabled.
//!
//! A transition with an empty preset is always enabled, so no marking is dead. A transition without arcs is added so
//! that this holds in the reduced net too; for the rest, only reachability matters.
//!
//! Keeps reachability and deadlocks: there are none, before and after.

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

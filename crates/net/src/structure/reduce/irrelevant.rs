//! Slicing: removes transitions on which the kept places do not depend (cone of influence).
//!
//! A transition is relevant if it changes a kept place, or adds tokens to a place in the preset of a relevant
//! transition. Leave the firings of all other transitions out of a run: the places that the remaining ones need never
//! have fewer tokens than before, and the kept places change as before. So the others are removed.
//!
//! Keeps reachability; not deadlocks, since only removed transitions may be enabled in a marking.
//!
//! Source: slicing, Rakow 2012, "Safety slicing Petri nets"; removing transitions that only take tokens goes one step
//! further.

use super::draft::Draft;
use super::{Property, Rule};

pub fn apply(draft: &mut Draft) {
    if draft.property != Property::Reachability {
        return;
    }
    let mut matters: Vec<bool> = vec![false; draft.transitions.len()];
    let mut waiting: Vec<u32> = Vec::new();
    for id in draft.transition_ids() {
        if !draft.is_silent(id) || draft.transition(id).is_held {
            matters[id as usize] = true;
            waiting.push(id);
        }
    }
    let mut is_needed = vec![false; draft.places.len()];
    while let Some(id) = waiting.pop() {
        for &(place, _) in &draft.transition(id).pre {
            if std::mem::replace(&mut is_needed[place as usize], true) {
                continue;
            }
            for &producer in &draft.place(place).producers {
                if draft.puts(producer, place) > draft.needs(producer, place)
                    && !std::mem::replace(&mut matters[producer as usize], true)
                {
                    waiting.push(producer);
                }
            }
        }
    }
    draft.spend(draft.transitions.len());
    let others: Vec<u32> = draft.transition_ids().filter(|&id| !matters[id as usize]).collect();
    draft.count(Rule::Irrelevant, others.len());
    others.into_iter().for_each(|id| draft.remove_transition(id));
}

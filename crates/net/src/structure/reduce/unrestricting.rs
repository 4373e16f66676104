//! Redundant places: those that never disable a transition.
//!
//! No transition takes tokens from the place without putting them back, and initially there are as many as any
//! transition needs. So each transition that needs tokens of the place always has them. Examples are places that only
//! receive tokens, places whose tokens never change, and places without arcs. A place that is not kept is removed. A
//! kept place keeps counting, but no transition needs it any more.
//!
//! Keeps everything: the reachability graph is unchanged except for the tokens of a place that is not observed.
//!
//! Source: redundant places, Berthelot 1987, "Transformations and decompositions of nets".

use super::Rule;
use super::draft::{Draft, without};

pub fn apply(draft: &mut Draft, place: u32) -> bool {
    let row = draft.place(place);
    let consumers = row.consumers.clone();
    draft.spend(consumers.len() + 1);
    let is_free = consumers.iter().all(|&id| {
        let needs = draft.needs(id, place);
        needs <= row.tokens && draft.puts(id, place) >= needs
    });
    if !is_free || row.is_kept && consumers.is_empty() {
        return false;
    }
    draft.count(Rule::Unrestricting, 1);
    if !draft.place(place).is_kept {
        draft.remove_place(place);
        return true;
    }
    for id in consumers {
        let gain = draft.puts(id, place) - draft.needs(id, place);
        let row = draft.transition(id);
        let (pre, mut post) = (without(&row.pre, place), row.post.clone());
        post.iter_mut().filter(|arc| arc.0 == place).for_each(|arc| arc.1 = gain);
        post.retain(|&(_, weight)| weight > 0);
        draft.rewrite(id, pre, post);
    }
    true
}

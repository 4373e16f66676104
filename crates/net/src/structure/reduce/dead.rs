//! Dead transitions: those that can never fire.
//!
//! Suppose that a transition, once enabled, puts any number of tokens on the places to which it adds tokens. A
//! transition that cannot fire even then never fires. If all weights are 1, this finds the largest unmarked siphon.
//!
//! Keeps everything: the reachability graph is unchanged.
//!
//! Source: the greatest unmarked siphon, Murata 1989, "Petri nets: Properties, analysis and applications", section VI.

use super::Rule;
use super::draft::Draft;

pub fn apply(draft: &mut Draft) {
    // For each transition, the number of places of its preset that may lack tokens.
    let mut lacking: Vec<usize> = vec![0; draft.transitions.len()];
    let mut waiting: Vec<u32> = Vec::new();
    for id in draft.transition_ids() {
        let pre = &draft.transition(id).pre;
        lacking[id as usize] = pre.iter().filter(|&&(place, weight)| draft.place(place).tokens < weight).count();
        if lacking[id as usize] == 0 {
            waiting.push(id);
        }
    }
    let mut work = lacking.len();
    let mut can_grow = vec![false; draft.places.len()];
    while let Some(id) = waiting.pop() {
        for (place, change) in draft.effect(id) {
            if change < 0 || std::mem::replace(&mut can_grow[place as usize], true) {
                continue;
            }
            for &consumer in &draft.place(place).consumers {
                work += 1;
                if draft.place(place).tokens < draft.needs(consumer, place) {
                    lacking[consumer as usize] -= 1;
                    if lacking[consumer as usize] == 0 {
                        waiting.push(consumer);
                    }
                }
            }
        }
    }
    draft.spend(work);
    let dead: Vec<u32> = draft.transition_ids().filter(|&id| lacking[id as usize] > 0).collect();
    draft.count(Rule::Dead, dead.len());
    dead.into_iter().for_each(|id| draft.remove_transition(id));
}

//! Redundant transitions: those that others can replace.
//!
//! - *Dominated*: another transition has the same effect and needs no more tokens, so it can fire instead. Equal
//!   transitions are the simplest case. Keeps everything: the successors of every marking are the same.
//! - *Idle*: the transition has no effect. Keeps reachability. For deadlocks it is removed only if another transition
//!   needs no more tokens: otherwise it may be the only one enabled in a marking.
//! - *Composed*: two others, one after the other, have the same effect and need no more tokens. Keeps reachability and
//!   deadlocks: if the transition is enabled, so is the first of the two.
//!
//! Source: redundant transitions, Berthelot 1987; the second and third, Thierry-Mieg 2020, "Structural reductions revisited".

use super::draft::{Draft, effect, is_covered, sum};
use super::{Property, Rule};

/// Maximum number of transitions with which one is compared.
const COMPARED: usize = 64;

/// Removes dominated transitions.
pub fn dominated(draft: &mut Draft) {
    let needs = |id| (fingerprint(draft, id), draft.transition(id).pre.len(), id);
    let mut all: Vec<(u64, usize, u32)> = draft.transition_ids().map(needs).collect();
    all.sort_unstable();
    draft.spend(all.len());
    for group in all.chunk_by(|a, b| a.0 == b.0) {
        // Transitions that need the fewest tokens come first. Of equal ones the first is kept.
        let mut left: Vec<u32> = Vec::new();
        for &(_, _, id) in group {
            let row = draft.transition(id);
            let stands_in = |&other: &u32| {
                is_covered(&draft.transition(other).pre, &row.pre) && draft.effect(other) == draft.effect(id)
            };
            let compared = left.len().min(COMPARED) + 1;
            let is_dominated = !row.is_held && left.iter().take(COMPARED).any(stands_in);
            draft.spend(compared * (draft.transition(id).pre.len() + 1));
            if is_dominated {
                draft.remove_transition(id);
                draft.count(Rule::Dominated, 1);
            } else {
                left.push(id);
            }
        }
    }
}

/// Removes idle transitions.
pub fn idle(draft: &mut Draft) {
    if draft.property == Property::Paths {
        return;
    }
    let idle = draft.transition_ids().filter(|&id| draft.transition(id).pre == draft.transition(id).post);
    let idle: Vec<u32> = idle.filter(|&id| !draft.transition(id).is_held).collect();
    for id in idle {
        let row = draft.transition(id);
        let others = row.pre.iter().flat_map(|&(place, _)| &draft.place(place).consumers).take(COMPARED);
        let mut others = others.copied().filter(|&other| other != id);
        let needs_no_less = |other| is_covered(&draft.transition(other).pre, &row.pre);
        if draft.property == Property::Reachability || others.any(needs_no_less) {
            draft.remove_transition(id);
            draft.count(Rule::Idle, 1);
        }
        draft.spend(COMPARED);
    }
}

/// Removes transitions that two others replace.
pub fn composed(draft: &mut Draft) {
    if draft.property == Property::Paths {
        return;
    }
    let mut prints: Vec<(u64, u32)> = draft.transition_ids().map(|id| (fingerprint(draft, id), id)).collect();
    prints.sort_unstable();
    for id in draft.transition_ids().collect::<Vec<u32>>() {
        if draft.is_tired() {
            return;
        }
        if !draft.transition(id).is_held && is_composed(draft, &prints, id) {
            draft.remove_transition(id);
            draft.count(Rule::Composed, 1);
        }
    }
}

/// Whether two other transitions replace one.
fn is_composed(draft: &Draft, prints: &[(u64, u32)], id: u32) -> bool {
    let row = draft.transition(id);
    let (print, aim) = (fingerprint(draft, id), draft.effect(id));
    let firsts = row.pre.iter().flat_map(|&(place, _)| &draft.place(place).consumers).take(COMPARED);
    firsts.copied().filter(|&first| first != id).any(|first| {
        let one = draft.transition(first);
        draft.spend(row.pre.len());
        if !is_covered(&one.pre, &row.pre) {
            return false;
        }
        // The tokens after the first has fired, where the transition was enabled.
        let Some(there) = sum([&row.pre, &one.post].into_iter()) else { return false };
        let there = effect(&one.pre, &there).into_iter().map(|(place, tokens)| (place, tokens as u64)).collect();
        // The second has to do the rest.
        let rest = print.wrapping_sub(fingerprint(draft, first));
        let start = prints.partition_point(|&(print, _)| print < rest);
        let seconds = prints[start..].iter().take_while(|&&(print, _)| print == rest).take(COMPARED);
        seconds.map(|&(_, second)| second).filter(|&second| second != id && !draft.transition(second).is_gone).any(
            |second| {
                let two = draft.transition(second);
                let together = sum([&one.pre, &two.pre].into_iter()).zip(sum([&one.post, &two.post].into_iter()));
                is_covered(&two.pre, &there) && together.is_some_and(|(pre, post)| effect(&pre, &post) == aim)
            },
        )
    })
}

/// Hash of a transition's effect. Additive: the sum of two fingerprints is that of both firings together.
fn fingerprint(draft: &Draft, id: u32) -> u64 {
    let row = draft.transition(id);
    let weigh = |&(place, weight): &(u32, u64)| {
        // Any odd constants without a pattern will do.
        let mixed = (u64::from(place) + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        (mixed ^ mixed >> 29).wrapping_mul(0xBF58_476D_1CE4_E5B9).wrapping_mul(weight)
    };
    let sum = |row: &[(u32, u64)]| row.iter().map(weigh).fold(0, u64::wrapping_add);
    sum(&row.post).wrapping_sub(sum(&row.pre))
}

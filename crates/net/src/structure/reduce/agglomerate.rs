//! Agglomerations: transitions that put tokens on a place are fused with those that take them from there.
//!
//! Throughout, H are the transitions that put tokens on a place p, and F those that need tokens of p. No transition is
//! in both, p is not kept, and every f takes one token at a time, or every h puts one at a time. For each h and each
//! choice of f that uses up the tokens of h (or each f and each choice of h that supplies the tokens of f), a
//! transition is added that stands for these firings one after the other. Then p, H and F are removed. A run of the
//! reduced net, written out, is a run of the original. It remains to show that the original can do no more.
//!
//! **Post-agglomeration.** Each f needs one token of p and nothing else, and changes no kept place. Take a run. Let F
//! fire at its end until p is empty: kept places do not change. Each f can be moved forward to right after the h that
//! put its token, since f needs nothing else, and the tokens it puts are only there earlier. Initial tokens on p are
//! used up by F at once, if there is only one f. A dead marking has no token on p, so nothing fires at the end, and the
//! same transitions are enabled in both nets. Keeps reachability and deadlocks.
//!
//! **Free agglomeration.** Each h puts one token on p and nothing else, and changes no kept place; p is empty
//! initially. Take a run. Each h can be moved back to right before the f that takes its token: the tokens that h takes
//! only stay longer. An h whose token is never taken is left out. Keeps reachability.
//!
//! **Pre-agglomeration.** As free agglomeration; in addition each h needs tokens, and is the only transition that needs
//! tokens of these places. Suppose a marking of the original is dead, and leave out the firings of H whose token is
//! still on p. This makes no difference to other transitions. No f has all it needs apart from the tokens of p (or
//! these are too few, and H cannot fire again), so no transition that stands for both is enabled: the marking is dead
//! in the reduced net. Suppose a marking of the reduced net is dead, and let H fire as long as possible. This ends, and
//! then no f is enabled, or else the transition that stands for both would have been. Keeps reachability and deadlocks;
//! for deadlocks, lifting lets H fire at the end.
//!
//! Source: Berthelot 1987, "Transformations and decompositions of nets"; with weights and free agglomeration, Thierry-Mieg 2020,
//! "Structural reductions revisited".

use super::draft::{Draft, MANY, Row, sum, weight, without};
use super::log::{Around, Step};
use super::{Property, Rule};

/// Maximum number of further firings in a transition made by agglomeration.
const LONGEST: u64 = 8;

/// Maximum number of initial firings for one place.
const BEGUN: u64 = 256;

/// Number of new transitions that is always acceptable, even if fewer are removed.
const MOST: usize = 16;

/// A transition that replaces members of H and F; `word` lists the firings it stands for.
struct Made {
    pre: Row,
    post: Row,
    word: Vec<u32>,
}

/// Returns H and F of a place, if they are disjoint and not empty and the place is not kept.
fn sides(draft: &Draft, place: u32) -> Option<(Vec<u32>, Vec<u32>)> {
    let row = draft.place(place);
    let (before, after) = (&row.producers, &row.consumers);
    let is_apart = !before.iter().any(|id| after.binary_search(id).is_ok());
    (!row.is_kept && !before.is_empty() && !after.is_empty() && is_apart).then(|| (before.clone(), after.clone()))
}

/// Whether replacing `old` transitions by `new` ones is worthwhile.
fn is_worth(old: usize, new: usize) -> bool {
    new <= old.max(MOST)
}

/// Number of multisets of size `times` from `kinds` elements; `None` if `times` is above the limit.
fn choices(kinds: usize, times: u64) -> Option<usize> {
    if times > LONGEST {
        return None;
    }
    // Every intermediate product is a binomial coefficient, so the division is exact.
    (1..=times as usize).try_fold(1_usize, |ways, i| ways.checked_mul(kinds + i - 1).map(|product| product / i))
}

/// All multisets of size `times` from `kinds`.
fn chosen(kinds: &[u32], times: u64) -> Vec<Vec<u32>> {
    if times == 0 {
        return vec![Vec::new()];
    }
    let with = |(position, &kind): (usize, &u32)| {
        chosen(&kinds[position..], times - 1).into_iter().map(move |rest| [&[kind], &rest[..]].concat())
    };
    kinds.iter().enumerate().flat_map(with).collect()
}

/// Applies post-agglomeration at a place, if possible.
pub fn post(draft: &mut Draft, place: u32) -> bool {
    let Some((before, after)) = sides(draft, place) else { return false };
    draft.spend(before.len() + after.len());
    let is_local = |&id: &u32| draft.transition(id).pre == [(place, 1)] && draft.is_silent(id);
    let tokens = draft.place(place).tokens;
    if !after.iter().all(is_local) || tokens > 0 && (after.len() > 1 || tokens > BEGUN) {
        return false;
    }
    let Some(new) = before.iter().try_fold(0_usize, |sum, &id| {
        let sum = sum + choices(after.len(), draft.puts(id, place))?;
        is_worth(before.len() + after.len(), sum).then_some(sum)
    }) else {
        return false;
    };
    let mut made = Vec::with_capacity(new);
    for &id in &before {
        let row = draft.transition(id);
        for mut word in chosen(&after, weight(&row.post, place)) {
            let rest = without(&row.post, place);
            let rows = word.iter().map(|&id| &draft.transition(id).post).chain([&rest]);
            let Some(post) = sum(rows) else { return false };
            word.insert(0, id);
            made.push(Made { pre: row.pre.clone(), post, word });
        }
    }
    if tokens > 0 && !begin(draft, after[0], tokens) {
        return false;
    }
    replace(draft, place, &[before, after].concat(), made);
    draft.count(Rule::PostAgglomeration, 1);
    true
}

/// Fires a transition in the initial marking. Returns whether the numbers stay small enough.
fn begin(draft: &mut Draft, transition: u32, times: u64) -> bool {
    let post = draft.transition(transition).post.clone();
    let more = post.iter().map(|&(place, weight)| {
        let more = weight.checked_mul(times)?.checked_add(draft.place(place).tokens)?;
        (more < MANY).then_some((place, more))
    });
    let Some(more) = more.collect::<Option<Row>>() else { return false };
    more.into_iter().for_each(|(place, tokens)| draft.places[place as usize].tokens = tokens);
    draft.log.step(Step::Begun { transition, times });
    true
}

/// Applies pre-agglomeration or free agglomeration at a place, if possible.
pub fn pre(draft: &mut Draft, place: u32) -> bool {
    let Some((before, after)) = sides(draft, place) else { return false };
    draft.spend(before.len() + after.len());
    let is_local = |&id: &u32| draft.transition(id).post == [(place, 1)] && draft.is_silent(id);
    if draft.place(place).tokens > 0 || !before.iter().all(is_local) {
        return false;
    }
    let is_undisturbed = |&id: &u32| {
        let pre = &draft.transition(id).pre;
        !pre.is_empty() && pre.iter().all(|&(place, _)| draft.place(place).consumers == [id])
    };
    let rule = if before.iter().all(is_undisturbed) { Rule::PreAgglomeration } else { Rule::FreeAgglomeration };
    if !draft.allows(rule) || rule == Rule::FreeAgglomeration && draft.property != Property::Reachability {
        return false;
    }
    let Some(new) = after.iter().try_fold(0_usize, |sum, &id| {
        let sum = sum + choices(before.len(), draft.needs(id, place))?;
        is_worth(before.len() + after.len(), sum).then_some(sum)
    }) else {
        return false;
    };
    let mut made = Vec::with_capacity(new);
    for &id in &after {
        let row = draft.transition(id);
        for mut word in chosen(&before, weight(&row.pre, place)) {
            let rest = without(&row.pre, place);
            let rows = word.iter().map(|&id| &draft.transition(id).pre).chain([&rest]);
            let Some(pre) = sum(rows) else { return false };
            word.push(id);
            made.push(Made { pre, post: row.post.clone(), word });
        }
    }
    if draft.property == Property::Deadlock {
        let mut places: Vec<u32> =
            before.iter().flat_map(|&id| &draft.transition(id).pre).map(|&(place, _)| place).collect();
        places.sort_unstable();
        let around = Around::of(draft, &places);
        draft.spend(around.transitions.len());
        draft.log.step(Step::Finished { last: before.clone(), around });
    }
    replace(draft, place, &[before, after].concat(), made);
    draft.count(rule, 1);
    true
}

/// Replaces old transitions, and the place between them, by new transitions.
fn replace(draft: &mut Draft, place: u32, old: &[u32], new: Vec<Made>) {
    draft.remove_place(place);
    old.iter().for_each(|&id| draft.remove_transition(id));
    for Made { pre, post, word } in new {
        draft.spend(pre.len() + post.len());
        draft.log.word(&word);
        draft.add(pre, post);
    }
}

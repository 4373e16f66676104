//! Implicit places: those that have enough tokens whenever another place has.
//!
//! Two places p and q change in proportion: whenever p gains a tokens, q gains b. So the tokens of q follow from those
//! of p. If every transition that needs tokens of q has enough of them whenever it has those it needs of p, then q
//! never disables a transition, and is removed unless it is kept. Equal places are the simplest case.
//!
//! Keeps everything: markings are the same except for q.
//!
//! Source: redundant and implicit places, Berthelot 1987; parallel places, Murata 1989.

use std::hash::{Hash, Hasher};

use rustc_hash::FxHasher;

use super::Rule;
use super::draft::Draft;
use crate::structure::sparse::gcd;

/// Maximum number of proportional places with which one is compared.
const COMPARED: usize = 64;

/// Row of the incidence matrix of a place, divided by its greatest common divisor `scale`, as a hash.
struct Column {
    place: u32,
    hash: u64,
    scale: u64,
}

pub fn apply(draft: &mut Draft) {
    let mut columns: Vec<Column> = draft.place_ids().filter_map(|place| column(draft, place)).collect();
    columns.sort_unstable_by_key(|column| (column.hash, column.scale, column.place));
    draft.spend(columns.len());
    for group in columns.chunk_by(|a, b| a.hash == b.hash) {
        // Places with small weights are kept in preference.
        for (position, q) in group.iter().enumerate().rev() {
            let others = group.iter().enumerate().filter(|&(other, _)| other != position).take(COMPARED);
            let is_implied = |p: &Column| !draft.place(p.place).is_gone && implies(draft, p, q) == Some(true);
            if draft.is_tired() || draft.place(q.place).is_kept {
                continue;
            }
            let degree = draft.place(q.place).producers.len() + draft.place(q.place).consumers.len();
            let found = others.map(|(_, p)| p).any(is_implied);
            draft.spend(group.len().min(COMPARED) * degree);
            if found {
                draft.remove_place(q.place);
                draft.count(Rule::Implied, 1);
            }
        }
    }
}

fn column(draft: &Draft, place: u32) -> Option<Column> {
    let changes = || {
        let change = |id| i128::from(draft.puts(id, place)) - i128::from(draft.needs(id, place));
        draft.around(place).into_iter().map(move |id| (id, change(id))).filter(|&(_, change)| change != 0)
    };
    let scale = changes().fold(0, |divisor, (_, change)| gcd(divisor, change.unsigned_abs() as u64));
    if scale == 0 {
        return None;
    }
    let mut hasher = FxHasher::default();
    changes().for_each(|(id, change)| (id, change / i128::from(scale)).hash(&mut hasher));
    Some(Column { place, hash: hasher.finish(), scale })
}

/// Whether q has enough tokens whenever p has; `None` if numbers become too large.
fn implies(draft: &Draft, p: &Column, q: &Column) -> Option<bool> {
    let (a, b) = (i128::from(p.scale), i128::from(q.scale));
    let (on_p, on_q) = (draft.place(p.place), draft.place(q.place));
    let change = |id, place| i128::from(draft.puts(id, place)) - i128::from(draft.needs(id, place));
    let mut around = draft.around(p.place);
    around.extend(draft.around(q.place));
    for id in around {
        // Equal hashes do not mean equal columns.
        if change(id, p.place).checked_mul(b)? != change(id, q.place).checked_mul(a)? {
            return Some(false);
        }
    }
    for &id in &on_q.consumers {
        // After some firings there are tokens(p) + a k tokens on p and tokens(q) + b k on q, for some number k.
        let on_p = i128::from(draft.needs(id, p.place)) - i128::from(on_p.tokens);
        let on_q = i128::from(draft.needs(id, q.place)) - i128::from(on_q.tokens);
        let least = -(-on_p).div_euclid(a);
        if on_q > least.checked_mul(b)? {
            return Some(false);
        }
    }
    Some(true)
}

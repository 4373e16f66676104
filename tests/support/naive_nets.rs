//! A search of a place/transition net without any art, as a textbook has it.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use petril::explore::engine::{Arcs, Model};

/// Tokens of each place.
pub type Marking = Vec<u64>;

/// The reachability graph.
pub struct Naive {
    /// For each marking, its distance from the initial one.
    pub markings: BTreeMap<Marking, usize>,
    pub steps: BTreeSet<(Marking, usize, Marking)>,
}

/// The marking after a firing, if the transition is enabled.
pub fn fire(arcs: &Arcs, from: &Marking) -> Option<Marking> {
    let mut to = from.clone();
    for &(place, weight) in &arcs.pre {
        to[place as usize] = to[place as usize].checked_sub(weight)?;
    }
    arcs.post.iter().for_each(|&(place, weight)| to[place as usize] += weight);
    Some(to)
}

/// All that can be reached; nothing if it is more than `most` markings.
pub fn search(model: &Model, most: usize) -> Option<Naive> {
    let mut naive = Naive { markings: [(model.initial.clone(), 0)].into(), steps: BTreeSet::new() };
    let mut waiting = VecDeque::from([model.initial.clone()]);
    while let Some(from) = waiting.pop_front() {
        let distance = naive.markings[&from];
        for (transition, arcs) in model.transitions.iter().enumerate() {
            let Some(to) = fire(arcs, &from) else { continue };
            if !naive.markings.contains_key(&to) {
                naive.markings.insert(to.clone(), distance + 1);
                waiting.push_back(to.clone());
            }
            naive.steps.insert((from.clone(), transition, to));
        }
        if naive.markings.len() > most {
            return None;
        }
    }
    Some(naive)
}

impl Naive {
    /// The markings without successors.
    pub fn deadlocks(&self) -> Vec<&Marking> {
        let moving: BTreeSet<&Marking> = self.steps.iter().map(|(from, ..)| from).collect();
        self.markings.keys().filter(|marking| !moving.contains(marking)).collect()
    }

    /// The distance of the nearest marking with a property.
    pub fn nearest(&self, property: impl Fn(&Marking) -> bool) -> Option<usize> {
        let having = self.markings.iter().filter(|(marking, _)| property(marking));
        having.map(|(_, &distance)| distance).min()
    }
}

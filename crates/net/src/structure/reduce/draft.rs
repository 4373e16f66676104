//! A net that is being reduced: places and transitions can be removed, and transitions added.

use std::cell::Cell;
use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};

use super::log::Log;
use super::{Keep, Options, Property, Rule};
use crate::net::Net;

/// Preset or postset of a transition: places, ascending, with weights, none of them 0.
pub type Row = Vec<(u32, u64)>;

/// Upper bound (exclusive) on weights and tokens, so that sums of two fit in 64 bits.
pub const MANY: u64 = 1 << 62;

/// Number of arcs above which a place is a hub.
const HUB: usize = 256;

/// A place of a draft.
#[derive(Clone, Debug, Default)]
pub struct Place {
    pub tokens: u64,
    /// Whether the property observes the tokens of the place.
    pub is_kept: bool,
    pub is_gone: bool,
    /// Transitions with the place in their postset, ascending.
    pub producers: Vec<u32>,
    /// Transitions with the place in their preset, ascending.
    pub consumers: Vec<u32>,
}

/// A transition of a draft. A self-loop is an arc in both `pre` and `post`.
#[derive(Clone, Debug, Default)]
pub struct Transition {
    pub pre: Row,
    pub post: Row,
    pub is_gone: bool,
    /// Whether no rule may remove the transition.
    pub is_held: bool,
}

/// The net that the rules work on. A node keeps its number when others are removed; numbers are not reused.
pub struct Draft<'s> {
    pub places: Vec<Place>,
    pub transitions: Vec<Transition>,
    pub property: Property,
    /// Log of the steps, for lifting runs.
    pub log: Log,
    /// Number of applications of each rule, in the order of [`Rule::ALL`].
    pub applied: [usize; Rule::ALL.len()],
    /// Queue of places whose surroundings changed since local rules last looked at them.
    waiting: VecDeque<u32>,
    is_waiting: Vec<bool>,
    /// Hubs whose surroundings changed: local rules look at them once per round.
    hubs: Vec<u32>,
    rules: Vec<Rule>,
    work: Cell<u64>,
    /// Cancellation flag: once set, no more rules are applied.
    stopping: &'s AtomicBool,
}

impl<'s> Draft<'s> {
    /// Makes the draft of a net; `None` if numbers are too large.
    pub fn of(net: &Net, keep: &Keep, options: &Options, stopping: &'s AtomicBool) -> Option<Self> {
        let transitions: Vec<Transition> = net
            .transition_ids()
            .map(|id| Transition {
                pre: net.pre(id).map(|(place, weight)| (place.index() as u32, weight)).collect(),
                post: net.post(id).map(|(place, weight)| (place.index() as u32, weight)).collect(),
                ..Transition::default()
            })
            .collect();
        let mut places: Vec<Place> =
            net.places().map(|place| Place { tokens: place.tokens, ..Place::default() }).collect();
        for (id, transition) in transitions.iter().enumerate() {
            transition.pre.iter().for_each(|&(place, _)| places[place as usize].consumers.push(id as u32));
            transition.post.iter().for_each(|&(place, _)| places[place as usize].producers.push(id as u32));
        }
        let tested = keep.transitions.iter().flat_map(|&id| net.pre(id).map(|(place, _)| place));
        keep.places.iter().copied().chain(tested).for_each(|place| places[place.index()].is_kept = true);
        let mut numbers = transitions.iter().flat_map(|transition| transition.pre.iter().chain(&transition.post));
        let fits = numbers.all(|&(_, weight)| weight < MANY) && places.iter().all(|place| place.tokens < MANY);
        fits.then(|| Self {
            log: Log::new(transitions.len()),
            waiting: (0..places.len() as u32).collect(),
            is_waiting: vec![true; places.len()],
            hubs: Vec::new(),
            places,
            transitions,
            property: keep.property,
            applied: [0; Rule::ALL.len()],
            rules: options.rules.clone(),
            work: Cell::new(options.work),
            stopping,
        })
    }

    /// Whether a rule is enabled by the options.
    pub fn allows(&self, rule: Rule) -> bool {
        self.rules.contains(&rule)
    }

    /// Counts applications of a rule.
    pub fn count(&mut self, rule: Rule, times: usize) {
        self.applied[rule as usize] += times;
    }

    /// Subtracts work done from the budget.
    pub fn spend(&self, work: usize) {
        self.work.set(self.work.get().saturating_sub(work as u64));
    }

    /// Whether the budget is spent, or the reduction was cancelled.
    pub fn is_tired(&self) -> bool {
        self.work.get() == 0 || self.stopping.load(Ordering::Relaxed)
    }

    /// The places not removed.
    pub fn place_ids(&self) -> impl Iterator<Item = u32> {
        (0..self.places.len() as u32).filter(|&id| !self.place(id).is_gone)
    }

    /// The transitions not removed.
    pub fn transition_ids(&self) -> impl Iterator<Item = u32> {
        (0..self.transitions.len() as u32).filter(|&id| !self.transition(id).is_gone)
    }

    pub fn place(&self, id: u32) -> &Place {
        &self.places[id as usize]
    }

    pub fn transition(&self, id: u32) -> &Transition {
        &self.transitions[id as usize]
    }

    /// Number of tokens that a transition needs on a place.
    pub fn needs(&self, transition: u32, place: u32) -> u64 {
        weight(&self.transition(transition).pre, place)
    }

    /// Number of tokens that a transition puts on a place.
    pub fn puts(&self, transition: u32, place: u32) -> u64 {
        weight(&self.transition(transition).post, place)
    }

    /// Effect of a transition: the places that firing changes, each with the change.
    pub fn effect(&self, transition: u32) -> Vec<(u32, i128)> {
        let Transition { pre, post, .. } = self.transition(transition);
        effect(pre, post)
    }

    /// Whether no firing of a transition changes a kept place.
    pub fn is_silent(&self, transition: u32) -> bool {
        let row = self.transition(transition);
        let is_same =
            |&(place, weight): &(u32, u64)| !self.place(place).is_kept || weight == self.puts(transition, place);
        let comes = |&(place, _): &(u32, u64)| !self.place(place).is_kept || self.needs(transition, place) > 0;
        row.pre.iter().all(is_same) && row.post.iter().all(comes)
    }

    /// Transitions with an arc to or from a place, ascending, each once.
    pub fn around(&self, place: u32) -> Vec<u32> {
        let Place { producers, consumers, .. } = self.place(place);
        let mut around: Vec<u32> = producers.iter().chain(consumers).copied().collect();
        around.sort_unstable();
        around.dedup();
        around
    }

    /// Takes a place from the queue whose surroundings have changed since it was last taken.
    pub fn next_waiting(&mut self) -> Option<u32> {
        while let Some(place) = self.waiting.pop_front() {
            self.is_waiting[place as usize] = false;
            if !self.place(place).is_gone {
                return Some(place);
            }
        }
        None
    }

    /// Begins the next round: puts the waiting hubs into the queue.
    pub fn wake_hubs(&mut self) {
        self.waiting.extend(self.hubs.drain(..));
    }

    fn wake(&mut self, place: u32) {
        let Place { producers, consumers, .. } = &self.places[place as usize];
        let is_hub = producers.len() + consumers.len() > HUB;
        if !std::mem::replace(&mut self.is_waiting[place as usize], true) {
            if is_hub { self.hubs.push(place) } else { self.waiting.push_back(place) }
        }
    }

    fn wake_around(&mut self, transition: u32) {
        let row = &self.transitions[transition as usize];
        let around: Vec<u32> = row.pre.iter().chain(&row.post).map(|&(place, _)| place).collect();
        self.spend(around.len() + 1);
        around.into_iter().for_each(|place| self.wake(place));
    }

    /// Removes a transition.
    pub fn remove_transition(&mut self, transition: u32) {
        self.wake_around(transition);
        self.unlink(transition);
        self.transitions[transition as usize].is_gone = true;
    }

    /// Removes a place and the arcs to and from it.
    pub fn remove_place(&mut self, place: u32) {
        for transition in self.around(place) {
            let row = &mut self.transitions[transition as usize];
            row.pre.retain(|&(other, _)| other != place);
            row.post.retain(|&(other, _)| other != place);
            self.wake_around(transition);
        }
        self.places[place as usize] = Place { is_gone: true, ..Place::default() };
    }

    /// Adds a transition.
    pub fn add(&mut self, pre: Row, post: Row) -> u32 {
        let id = self.transitions.len() as u32;
        self.transitions.push(Transition { pre, post, ..Transition::default() });
        self.link(id);
        self.wake_around(id);
        id
    }

    /// Replaces the arcs of a transition.
    pub fn rewrite(&mut self, transition: u32, pre: Row, post: Row) {
        self.wake_around(transition);
        self.unlink(transition);
        let row = &mut self.transitions[transition as usize];
        (row.pre, row.post) = (pre, post);
        self.link(transition);
        self.wake_around(transition);
    }

    fn link(&mut self, transition: u32) {
        let Transition { pre, post, .. } = &self.transitions[transition as usize];
        pre.iter().for_each(|&(place, _)| enter(&mut self.places[place as usize].consumers, transition));
        post.iter().for_each(|&(place, _)| enter(&mut self.places[place as usize].producers, transition));
    }

    fn unlink(&mut self, transition: u32) {
        let Transition { pre, post, .. } = &self.transitions[transition as usize];
        pre.iter().for_each(|&(place, _)| leave(&mut self.places[place as usize].consumers, transition));
        post.iter().for_each(|&(place, _)| leave(&mut self.places[place as usize].producers, transition));
    }
}

fn enter(list: &mut Vec<u32>, id: u32) {
    if let Err(position) = list.binary_search(&id) {
        list.insert(position, id);
    }
}

fn leave(list: &mut Vec<u32>, id: u32) {
    if let Ok(position) = list.binary_search(&id) {
        list.remove(position);
    }
}

/// Weight of a place in a row, 0 if it is not there.
pub fn weight(row: &Row, place: u32) -> u64 {
    row.binary_search_by_key(&place, |&(place, _)| place).map_or(0, |position| row[position].1)
}

/// Effect of a firing with these arcs: the places changed, each with the change.
pub fn effect(pre: &Row, post: &Row) -> Vec<(u32, i128)> {
    let taken = pre.iter().map(|&(place, weight)| (place, weight, 0));
    let put = post.iter().map(|&(place, weight)| (place, 0, weight));
    let mut all: Vec<(u32, u64, u64)> = taken.chain(put).collect();
    all.sort_unstable();
    let mut effect: Vec<(u32, i128)> = Vec::with_capacity(all.len());
    for (place, taken, put) in all {
        let change = i128::from(put) - i128::from(taken);
        match effect.last_mut() {
            Some(last) if last.0 == place => last.1 += change,
            _ => effect.push((place, change)),
        }
    }
    effect.retain(|&(_, change)| change != 0);
    effect
}

/// Sum of rows; `None` if a number becomes too large.
pub fn sum<'r>(rows: impl Iterator<Item = &'r Row>) -> Option<Row> {
    let mut all: Row = rows.flatten().copied().collect();
    all.sort_unstable();
    let mut sum: Row = Vec::with_capacity(all.len());
    for (place, weight) in all {
        match sum.last_mut() {
            Some(last) if last.0 == place => last.1 = last.1.checked_add(weight).filter(|&weight| weight < MANY)?,
            _ => sum.push((place, weight)),
        }
    }
    Some(sum)
}

/// A row without a place.
pub fn without(row: &Row, place: u32) -> Row {
    row.iter().copied().filter(|&(other, _)| other != place).collect()
}

/// Whether each place of the first row is in the second with at least the same weight.
pub fn is_covered(row: &Row, by: &Row) -> bool {
    row.len() <= by.len() && row.iter().all(|&(place, needed)| weight(by, place) >= needed)
}

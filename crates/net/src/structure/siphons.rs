//! Minimal siphons and minimal traps.
//!
//! A siphon is a set of places such that every transition that puts tokens on one of them needs tokens of one of them:
//! once empty, it stays empty. A trap is a siphon of the net with arcs reversed: once marked, it stays marked. Weights
//! play no part.
//!
//! The search begins with a place and, as long as some transition can fill the set from outside, adds one of the places
//! of its preset, trying each in turn with those tried before excluded. So every minimal siphon is found exactly once.
//! Exclusion propagates: a transition whose inputs are all excluded excludes its outputs.

use fixedbitset::FixedBitSet;

use super::flow::Flow;
use crate::net::PlaceId;

/// Limits of the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SiphonLimits {
    /// Maximum number of sets found.
    pub count: usize,
    /// Maximum number of elementary steps, some nanoseconds each.
    pub steps: u64,
}

impl Default for SiphonLimits {
    /// Limits for about a second at most.
    fn default() -> Self {
        Self { count: 1000, steps: 100_000_000 }
    }
}

/// Divisor of the steps left that gives the share of the search from one place.
const SHARE: u64 = 8;

/// Result of a search for minimal siphons or traps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Siphons {
    /// Minimal siphons, or traps: places in ascending order. The sets are ordered by their smallest places.
    pub found: Vec<Vec<PlaceId>>,
    /// Whether `found` is complete. If not, a limit ended the search.
    pub all: bool,
}

/// Finds the minimal siphons of a net.
#[must_use]
pub fn minimal_siphons(flow: &Flow, limits: SiphonLimits) -> Siphons {
    let mut search = Search::new(flow, limits);
    let mut left = limits.steps;
    let mut all = true;
    for place in 0..flow.places() {
        // No place may take all steps from the others.
        let share = (left / SHARE).max(1);
        search.steps = share;
        all &= search.from(place as u32);
        left = left.saturating_sub(share - search.steps);
        if left == 0 || search.found.len() > limits.count {
            all = false;
            break;
        }
    }
    search.found.truncate(limits.count);
    Siphons { found: search.found, all }
}

/// Finds the minimal traps of a net.
#[must_use]
pub fn minimal_traps(flow: &Flow, limits: SiphonLimits) -> Siphons {
    minimal_siphons(&flow.reversed(), limits)
}

/// Decision on a place: whether it belongs to the set.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Belongs {
    Open,
    In,
    Out,
}

struct Search<'f> {
    flow: &'f Flow,
    limits: SiphonLimits,
    steps: u64,
    found: Vec<Vec<PlaceId>>,
    belongs: Vec<Belongs>,
    /// For each transition the number of its inputs that are not excluded; in `taken`, of those included.
    candidates: Vec<u32>,
    taken: Vec<u32>,
    /// Places in the order in which they were included or excluded.
    trail: Vec<u32>,
    /// Included places, in this order.
    members: Vec<u32>,
    /// Scratch memory of [`Self::holds_siphon`]: marks of places, and counts of transitions in `supports`.
    left: FixedBitSet,
    supports: Vec<u32>,
}

impl<'f> Search<'f> {
    fn new(flow: &'f Flow, limits: SiphonLimits) -> Self {
        let mut search = Self {
            flow,
            limits,
            steps: limits.steps,
            found: Vec::new(),
            belongs: vec![Belongs::Open; flow.places()],
            candidates: (0..flow.transitions()).map(|id| flow.inputs[id].len() as u32).collect(),
            taken: vec![0; flow.transitions()],
            trail: Vec::new(),
            members: Vec::new(),
            left: FixedBitSet::with_capacity(flow.places()),
            supports: vec![0; flow.transitions()],
        };
        // Places that a transition without inputs fills are in no siphon.
        for id in (0..flow.transitions()).filter(|&id| flow.inputs[id].is_empty()) {
            flow.outputs[id].iter().for_each(|&place| _ = search.shut_out(place));
        }
        search
    }

    fn is_over(&self) -> bool {
        self.steps == 0 || self.found.len() > self.limits.count
    }

    fn spend(&mut self, steps: usize) {
        self.steps = self.steps.saturating_sub(steps as u64);
    }

    /// Finds the minimal siphons with a place and without excluded ones; then excludes the place too. Returns false if
    /// a limit ended the search.
    fn from(&mut self, place: u32) -> bool {
        if self.belongs[place as usize] != Belongs::Open {
            return true;
        }
        let start = self.trail.len();
        // Places included by choice, each with the length of the trail before it.
        let mut choices: Vec<(u32, usize)> = Vec::new();
        self.take_in(place);
        let is_done = loop {
            if self.is_over() {
                break false;
            }
            if let Some(choice) = self.choice() {
                choices.push((choice, self.trail.len()));
                self.take_in(choice);
            } else if !self.is_over() && !self.turn(&mut choices) {
                break true;
            }
        };
        self.undo(start);
        self.shut_out(place);
        is_done
    }

    /// Backtracks to the last choice that can be made otherwise, and excludes its place. Returns false if there is
    /// none.
    fn turn(&mut self, choices: &mut Vec<(u32, usize)>) -> bool {
        while let Some((choice, trail)) = choices.pop() {
            self.undo(trail);
            if self.shut_out(choice) {
                return true;
            }
        }
        false
    }

    /// Chooses a place to include next. `None` if the set is a siphon, which is recorded if it is minimal, or can never
    /// become a minimal one.
    fn choice(&mut self) -> Option<u32> {
        let flow = self.flow;
        let mut scarcest: Option<u32> = None;
        let mut steps = 0;
        for &member in &self.members {
            let producers = &flow.producers[member as usize];
            steps += producers.len() + 1;
            for &id in producers.iter().filter(|&&id| self.taken[id as usize] == 0) {
                if scarcest.is_none_or(|best| self.candidates[id as usize] < self.candidates[best as usize]) {
                    scarcest = Some(id);
                }
            }
        }
        self.spend(steps);
        let Some(transition) = scarcest else {
            let is_minimal =
                (0..self.members.len()).all(|without| !self.is_over() && !self.holds_siphon(Some(without)));
            if is_minimal {
                let mut places: Vec<PlaceId> = self.members.iter().map(|&place| PlaceId::at(place as usize)).collect();
                places.sort_unstable();
                self.found.push(places);
            }
            return None;
        };
        if self.holds_siphon(None) {
            return None;
        }
        flow.inputs[transition as usize].iter().copied().find(|&place| self.belongs[place as usize] == Belongs::Open)
    }

    /// Whether the set, optionally without one of its members, contains a siphon.
    fn holds_siphon(&mut self, without: Option<usize>) -> bool {
        let flow = self.flow;
        let mut steps = 0;
        for (position, &member) in self.members.iter().enumerate() {
            let member = member as usize;
            self.left.set(member, Some(position) != without);
            flow.producers[member].iter().for_each(|&id| self.supports[id as usize] = self.taken[id as usize]);
            flow.consumers[member].iter().for_each(|&id| self.supports[id as usize] = self.taken[id as usize]);
            steps += flow.producers[member].len() + flow.consumers[member].len() + 1;
        }
        if let Some(&member) = without.and_then(|position| self.members.get(position)) {
            flow.consumers[member as usize].iter().for_each(|&id| self.supports[id as usize] -= 1);
        }
        let mut unsupported: Vec<u32> = self
            .members
            .iter()
            .flat_map(|&member| &flow.producers[member as usize])
            .copied()
            .filter(|&id| self.supports[id as usize] == 0)
            .collect();
        while let Some(id) = unsupported.pop() {
            steps += flow.outputs[id as usize].len();
            for place in flow.outputs[id as usize].iter().map(|&place| place as usize) {
                if self.left.contains(place) {
                    self.left.set(place, false);
                    for &consumer in &flow.consumers[place] {
                        self.supports[consumer as usize] -= 1;
                        if self.supports[consumer as usize] == 0 {
                            unsupported.push(consumer);
                        }
                    }
                }
            }
        }
        self.spend(steps);
        let mut holds = false;
        for &member in &self.members {
            holds |= self.left.contains(member as usize);
            self.left.set(member as usize, false);
        }
        holds
    }

    fn take_in(&mut self, place: u32) {
        self.belongs[place as usize] = Belongs::In;
        self.trail.push(place);
        self.members.push(place);
        self.flow.consumers[place as usize].iter().for_each(|&id| self.taken[id as usize] += 1);
    }

    /// Excludes a place, and every place that can then be filled without any input. Returns false if one of these is in
    /// the set.
    fn shut_out(&mut self, place: u32) -> bool {
        let flow = self.flow;
        let mut waiting = vec![place];
        while let Some(place) = waiting.pop() {
            match self.belongs[place as usize] {
                Belongs::In => return false,
                Belongs::Out => continue,
                Belongs::Open => self.belongs[place as usize] = Belongs::Out,
            }
            self.trail.push(place);
            let consumers = &flow.consumers[place as usize];
            self.spend(consumers.len() + 1);
            for id in consumers.iter().map(|&id| id as usize) {
                self.candidates[id] -= 1;
                if self.candidates[id] == 0 {
                    waiting.extend_from_slice(&flow.outputs[id]);
                }
            }
        }
        true
    }

    /// Undoes the decisions made since the trail had a length.
    fn undo(&mut self, trail: usize) {
        for place in self.trail.split_off(trail) {
            let counts = match self.belongs[place as usize] {
                Belongs::In => {
                    self.members.pop();
                    &mut self.taken
                }
                _ => &mut self.candidates,
            };
            let is_in = self.belongs[place as usize] == Belongs::In;
            for &id in &self.flow.consumers[place as usize] {
                let count = &mut counts[id as usize];
                *count = if is_in { *count - 1 } else { *count + 1 };
            }
            self.belongs[place as usize] = Belongs::Open;
        }
    }
}

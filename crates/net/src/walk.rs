//! Random walks through the markings of a net, without a record of visited markings: they quickly find many of the
//! markings of a large net, and never prove anything.

use rustc_hash::FxHashMap;

use super::engine::Model;
use super::goal::{Goal, Tokens};

/// Random walk: the current marking and its enabled transitions.
pub struct Walk<'a> {
    model: &'a Model,
    /// For each place the transitions that need its tokens, and how many.
    takers: Vec<Vec<(u32, u64)>>,
    marking: Vec<u64>,
    /// For each transition, the number of places that lack tokens it needs.
    lacking: Vec<u32>,
    /// The enabled transitions, and in `position` the place of each in this list.
    enabled: Vec<u32>,
    position: Vec<u32>,
    firings: Vec<u32>,
    /// State of the pseudo-random generator, which is seeded and so reproducible.
    random: u64,
}

/// Position of a transition that is not enabled.
const NOWHERE: u32 = u32::MAX;

/// Number of enabled transitions of which the best one is chosen.
const CHOICE: usize = 6;

impl<'a> Walk<'a> {
    /// Begins a walk in the initial marking; `None` if the net has several arcs between two nodes, or arcs to missing
    /// places.
    #[must_use]
    pub fn new(model: &'a Model, seed: u64) -> Option<Self> {
        let places = model.initial.len();
        let mut takers = vec![Vec::new(); places];
        for (arcs, transition) in model.transitions.iter().zip(0..) {
            for &(place, weight) in &arcs.pre {
                // Several arcs from one place would be counted in `lacking` several times.
                let list: &mut Vec<(u32, u64)> = takers.get_mut(place as usize)?;
                if list.last().is_some_and(|&(last, _)| last == transition) {
                    return None;
                }
                list.push((transition, weight));
            }
            arcs.post.iter().all(|&(place, _)| (place as usize) < places).then_some(())?;
        }
        let mut walk = Self {
            model,
            takers,
            marking: Vec::new(),
            lacking: Vec::new(),
            enabled: Vec::new(),
            position: Vec::new(),
            firings: Vec::new(),
            random: seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1,
        };
        walk.restart();
        Some(walk)
    }

    /// Returns to the initial marking.
    pub fn restart(&mut self) {
        self.marking.clone_from(&self.model.initial);
        self.firings.clear();
        self.enabled.clear();
        self.position = vec![NOWHERE; self.model.transitions.len()];
        self.lacking = vec![0; self.model.transitions.len()];
        for (list, &tokens) in self.takers.iter().zip(&self.marking) {
            let lacking = list.iter().filter(|&&(_, weight)| tokens < weight);
            lacking.for_each(|&(transition, _)| self.lacking[transition as usize] += 1);
        }
        for transition in 0..self.model.transitions.len() as u32 {
            if self.lacking[transition as usize] == 0 {
                self.enter(transition);
            }
        }
    }

    /// Firings since the initial marking.
    #[must_use]
    pub fn firings(&self) -> &[u32] {
        &self.firings
    }

    /// Fires a random enabled transition. Returns false if there is none, or tokens overflow; the walk must then be
    /// restarted.
    pub fn step(&mut self) -> bool {
        if self.enabled.is_empty() {
            return false;
        }
        let any = self.below(self.enabled.len());
        self.fire(self.enabled[any])
    }

    /// Fires the transition that leads nearest to a goal, of a few random enabled ones. Returns false as [`Self::step`]
    /// does.
    pub fn step_towards(&mut self, goal: &Goal) -> bool {
        let mut best: Option<(u64, u32)> = None;
        for _ in 0..CHOICE.min(self.enabled.len()) {
            let any = self.below(self.enabled.len());
            let transition = self.enabled[any];
            let distance = self.distance_after(transition, goal);
            if best.is_none_or(|(least, _)| distance < least) {
                best = Some((distance, transition));
            }
        }
        best.is_some_and(|(_, transition)| self.fire(transition))
    }

    fn distance_after(&mut self, transition: u32, goal: &Goal) -> u64 {
        let arcs = &self.model.transitions[transition as usize];
        arcs.pre.iter().for_each(|&(place, weight)| self.marking[place as usize] -= weight);
        arcs.post.iter().for_each(|&(place, weight)| {
            let tokens = &mut self.marking[place as usize];
            *tokens = tokens.wrapping_add(weight);
        });
        let distance = self.distance(goal);
        arcs.post.iter().for_each(|&(place, weight)| {
            let tokens = &mut self.marking[place as usize];
            *tokens = tokens.wrapping_sub(weight);
        });
        arcs.pre.iter().for_each(|&(place, weight)| self.marking[place as usize] += weight);
        distance
    }

    /// Heuristic distance to a goal.
    fn distance(&self, goal: &Goal) -> u64 {
        let needs = |transition: u32| {
            let pre = self.model.transitions[transition as usize].pre.iter();
            pre.map(|&(place, weight)| weight.saturating_sub(self.marking[place as usize]))
        };
        match goal {
            Goal::Truth(value) => u64::from(!value),
            Goal::AtLeast { terms, least } => {
                let sum = terms.iter().map(|&(place, factor)| i128::from(factor) * i128::from(self.tokens(place)));
                u64::try_from((least - sum.sum::<i128>()).max(0)).unwrap_or(u64::MAX >> 8)
            }
            Goal::Enabled(transition) => needs(*transition).fold(0, u64::saturating_add),
            Goal::Disabled(transition) => u64::from(needs(*transition).all(|lack| lack == 0)),
            // The set of enabled transitions is that of the previous marking.
            Goal::Dead => self.enabled.iter().filter(|&&t| needs(t).all(|lack| lack == 0)).count() as u64,
            Goal::Alive => 0,
            Goal::All(parts) => parts.iter().fold(0, |sum, part| sum.saturating_add(self.distance(part))),
            Goal::Any(parts) => parts.iter().map(|part| self.distance(part)).min().unwrap_or(1),
        }
    }

    fn fire(&mut self, transition: u32) -> bool {
        let model = self.model;
        let arcs = &model.transitions[transition as usize];
        for &(place, weight) in &arcs.pre {
            let tokens = self.marking[place as usize];
            self.set(place, tokens - weight);
        }
        for &(place, weight) in &arcs.post {
            let Some(tokens) = self.marking[place as usize].checked_add(weight) else { return false };
            self.set(place, tokens);
        }
        self.firings.push(transition);
        true
    }

    fn set(&mut self, place: u32, tokens: u64) {
        let before = std::mem::replace(&mut self.marking[place as usize], tokens);
        let list = std::mem::take(&mut self.takers[place as usize]);
        for &(transition, weight) in &list {
            let lacking = &mut self.lacking[transition as usize];
            if before < weight && weight <= tokens {
                *lacking -= 1;
                if *lacking == 0 {
                    self.enter(transition);
                }
            } else if tokens < weight && weight <= before {
                *lacking += 1;
                if *lacking == 1 {
                    self.leave(transition);
                }
            }
        }
        self.takers[place as usize] = list;
    }

    fn enter(&mut self, transition: u32) {
        self.position[transition as usize] = self.enabled.len() as u32;
        self.enabled.push(transition);
    }

    fn leave(&mut self, transition: u32) {
        let at = std::mem::replace(&mut self.position[transition as usize], NOWHERE);
        self.enabled.swap_remove(at as usize);
        if let Some(&moved) = self.enabled.get(at as usize) {
            self.position[moved as usize] = at;
        }
    }

    /// Random number below `end` (xorshift, Marsaglia 2003).
    fn below(&mut self, end: usize) -> usize {
        self.random ^= self.random << 13;
        self.random ^= self.random >> 7;
        self.random ^= self.random << 17;
        ((u128::from(self.random) * end as u128) >> 64) as usize
    }
}

impl Tokens for Walk<'_> {
    fn tokens(&self, place: u32) -> u64 {
        self.marking[place as usize]
    }

    fn is_enabled(&self, transition: u32) -> bool {
        self.lacking[transition as usize] == 0
    }

    fn is_dead(&self) -> bool {
        self.enabled.is_empty()
    }
}

/// Removes the firings between two equal markings from a firing sequence. Markings are compared by a hash, so the
/// result must be replayed to be certain.
#[must_use]
pub fn without_loops(model: &Model, firings: &[u32]) -> Vec<u32> {
    // Pseudo-random weights, so that sums do not collide (splitmix64, Steele and others 2014).
    let weight = |place: u32| {
        let mut mixed = (u64::from(place) + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        mixed = (mixed ^ mixed >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ mixed >> 31
    };
    let sum = |list: &[(u32, u64)]| {
        list.iter().fold(0_u64, |sum, &(place, tokens)| sum.wrapping_add(weight(place).wrapping_mul(tokens)))
    };
    let mut number = 0_u64;
    let mut numbers = vec![number];
    let mut seen: FxHashMap<u64, usize> = [(number, 0)].into_iter().collect();
    let mut kept: Vec<u32> = Vec::new();
    for &transition in firings {
        let arcs = &model.transitions[transition as usize];
        number = number.wrapping_add(sum(&arcs.post)).wrapping_sub(sum(&arcs.pre));
        if let Some(&at) = seen.get(&number) {
            numbers.drain(at + 1..).for_each(|number| _ = seen.remove(&number));
            kept.truncate(at);
        } else {
            kept.push(transition);
            seen.insert(number, kept.len());
            numbers.push(number);
        }
    }
    kept
}

//! Stubborn sets (Valmari 1989; for reachability goals Schmidt 1999): a closed set of transitions, one of which must
//! fire on every path to the goal and may as well fire first.
//!
//! Let σ be a shortest firing sequence from a marking m, where the goal is false, to the goal. The set computed here
//! contains a transition of σ: without the transitions that `seed` adds, the goal stays false. Let t be the first of
//! these in σ, after a prefix w. Then t is enabled in m: otherwise the set contains all transitions that add tokens to
//! a place that t lacks, and none of these is in w. And no transition of w needs tokens of the places where t loses
//! tokens, because all that do are in the set. So t can fire first, then w, and the sequence has the same length.
//! Enabled transitions outside of the set need not fire in m, and neither the goal nor the distance to it is lost. If
//! no transition of the set is enabled, the goal cannot be reached from m.

use super::model::Rule;
use super::packing::Packing;
use super::view::View;
use crate::Goal;

/// Stubborn sets for a goal.
pub(super) struct Stubborn<'a> {
    goal: &'a Goal,
    rules: &'a [Rule],
    /// For each place the transitions that need its tokens.
    takers: Vec<Vec<u32>>,
    /// For each place the transitions that increase its tokens.
    givers: Vec<Vec<u32>>,
    /// For each place the transitions that decrease its tokens.
    losers: Vec<Vec<u32>>,
}

/// Reusable memory.
#[derive(Default)]
pub(super) struct Scratch {
    /// The stubborn set, a bit for each transition.
    set: Vec<u64>,
    waiting: Vec<u32>,
    /// Number of transitions of the set that are enabled.
    enabled: u32,
    /// Places whose takers and, in `given`, whose givers the set contains.
    taken: Vec<bool>,
    given: Vec<bool>,
    marks: Vec<u32>,
}

impl<'a> Stubborn<'a> {
    pub(super) fn of(goal: &'a Goal, rules: &'a [Rule], places: usize) -> Self {
        let mut all = Self {
            goal,
            rules,
            takers: vec![Vec::new(); places],
            givers: vec![Vec::new(); places],
            losers: vec![Vec::new(); places],
        };
        for (rule, transition) in rules.iter().zip(0..) {
            for touch in rule {
                if touch.pre > 0 {
                    all.takers[touch.place].push(transition);
                }
                match touch.change() {
                    1.. => all.givers[touch.place].push(transition),
                    0 => {}
                    _ => all.losers[touch.place].push(transition),
                }
            }
        }
        all
    }

    /// Restricts `set`, the transitions enabled in a marking, to those in the stubborn set.
    pub(super) fn restrict(&self, packing: &Packing, words: &[u64], set: &mut [u64], scratch: &mut Scratch) {
        let enabled: u32 = set.iter().map(|word| word.count_ones()).sum();
        scratch.begin(set.len(), self.takers.len());
        self.close(&View { packing, words, enabled: set }, enabled, scratch);
        if scratch.enabled < enabled {
            set.iter_mut().zip(&scratch.set).for_each(|(word, stubborn)| *word &= stubborn);
        }
    }

    /// Computes the closure of the set, until it contains all enabled transitions.
    fn close(&self, marking: &View<'_>, enabled: u32, scratch: &mut Scratch) {
        self.seed(self.goal, marking, scratch);
        while let Some(transition) = scratch.waiting.pop() {
            if scratch.enabled == enabled {
                return;
            }
            if marking.is_enabled(transition as usize) {
                let loses = self.rules[transition as usize].iter().filter(|touch| touch.change() < 0);
                loses.for_each(|touch| self.add_takers(touch.place, marking, scratch));
            } else {
                self.add_what_enables(transition as usize, marking, scratch);
            }
        }
    }

    /// Adds transitions of which one fires on every path to a goal that is false in the marking.
    fn seed(&self, goal: &Goal, marking: &View<'_>, scratch: &mut Scratch) {
        match goal {
            // No transition fires in a dead marking.
            Goal::Truth(_) | Goal::Alive => {}
            Goal::AtLeast { terms, .. } => {
                let gains = |transition: u32| {
                    let rule = &self.rules[transition as usize];
                    let gain = |&(place, factor): &(u32, i64)| {
                        let touch = rule.iter().find(|touch| touch.place == place as usize)?;
                        Some(i128::from(factor) * i128::from(touch.change()))
                    };
                    terms.iter().filter_map(gain).sum::<i128>() > 0
                };
                for &(place, factor) in terms {
                    let helping = if factor > 0 { &self.givers } else { &self.losers };
                    let helping = helping[place as usize].iter().copied().filter(|&transition| gains(transition));
                    helping.for_each(|transition| scratch.add(transition, marking));
                }
            }
            Goal::Enabled(transition) => self.add_what_enables(*transition as usize, marking, scratch),
            Goal::Disabled(transition) => self.add_what_disables(*transition as usize, marking, scratch),
            // Every enabled transition has to be disabled.
            Goal::Dead => {
                let cheapest = marking.enabled().min_by_key(|&transition| {
                    let needed = self.rules[transition].iter().filter(|touch| touch.pre > 0);
                    needed.map(|touch| self.losers[touch.place].len()).sum::<usize>()
                });
                if let Some(transition) = cheapest {
                    self.add_what_disables(transition, marking, scratch);
                }
            }
            Goal::All(parts) => {
                if let Some(part) = parts.iter().find(|part| !part.holds(marking)) {
                    self.seed(part, marking, scratch);
                }
            }
            Goal::Any(parts) => parts.iter().for_each(|part| self.seed(part, marking, scratch)),
        }
    }

    fn add_takers(&self, place: usize, marking: &View<'_>, scratch: &mut Scratch) {
        if !std::mem::replace(&mut scratch.taken[place], true) {
            scratch.marks.push(place as u32);
            self.takers[place].iter().for_each(|&transition| scratch.add(transition, marking));
        }
    }

    /// For a transition that is not enabled, adds the transitions that increase the tokens of a place that lacks some.
    fn add_what_enables(&self, transition: usize, marking: &View<'_>, scratch: &mut Scratch) {
        let lacking = |place: usize, pre| marking.tokens(place) < pre;
        let lacking = self.rules[transition].iter().filter(|touch| lacking(touch.place, touch.pre));
        let cost = |place: usize| if scratch.given[place] { 0 } else { self.givers[place].len() };
        if let Some(place) = lacking.map(|touch| touch.place).min_by_key(|&place| cost(place))
            && !std::mem::replace(&mut scratch.given[place], true)
        {
            scratch.marks.push(place as u32);
            self.givers[place].iter().for_each(|&transition| scratch.add(transition, marking));
        }
    }

    /// For a transition that is enabled, adds the transitions that decrease the tokens of places it needs.
    fn add_what_disables(&self, transition: usize, marking: &View<'_>, scratch: &mut Scratch) {
        for touch in self.rules[transition].iter().filter(|touch| touch.pre > 0) {
            self.losers[touch.place].iter().for_each(|&transition| scratch.add(transition, marking));
        }
    }
}

impl Scratch {
    fn begin(&mut self, width: usize, places: usize) {
        self.taken.resize(places, false);
        self.given.resize(places, false);
        self.set.clear();
        self.set.resize(width, 0);
        self.waiting.clear();
        self.enabled = 0;
        for place in self.marks.drain(..) {
            self.taken[place as usize] = false;
            self.given[place as usize] = false;
        }
    }

    fn add(&mut self, transition: u32, marking: &View<'_>) {
        let (word, bit) = (&mut self.set[transition as usize / 64], 1 << (transition % 64));
        if *word & bit == 0 {
            *word |= bit;
            self.enabled += u32::from(marking.is_enabled(transition as usize));
            self.waiting.push(transition);
        }
    }
}

//! Transitions of which one must fire on every way to a goal, closed so that it may as well fire first (stubborn sets; Valmari
//! 1989, for goals Schmidt 1999).
//!
//! Let σ be a shortest way from a marking m to a goal that m does not have. The set computed here contains a transition of σ:
//! without the transitions that `seed` adds, the goal stays false. Let t be the first one in σ, after w. Then t is enabled in
//! m: otherwise the set contains everything that gives tokens to a place that t lacks, and w has nothing of the kind. And the
//! places where t loses tokens are read by no transition of w, because all that reads them is in the set. So t can fire first,
//! w after it, and the way is as long as before. What is enabled outside of the set need not fire in m, and neither the
//! goal nor the distance to it is lost. If nothing in the set is enabled, the goal cannot be reached from m.

use super::model::Rule;
use super::packing::Packing;
use super::view::View;
use crate::Goal;

/// The goal, and what transitions do to places.
pub(super) struct Stubborn<'a> {
    goal: &'a Goal,
    rules: &'a [Rule],
    /// For each place the transitions that need tokens there.
    takers: Vec<Vec<u32>>,
    /// For each place the transitions that leave more tokens there.
    givers: Vec<Vec<u32>>,
    /// For each place the transitions that leave fewer tokens there.
    losers: Vec<Vec<u32>>,
}

/// Memory used again and again.
#[derive(Default)]
pub(super) struct Scratch {
    /// The set, a bit for each transition.
    set: Vec<u64>,
    waiting: Vec<u32>,
    /// How many transitions of the set are enabled.
    enabled: u32,
    /// Which places' takers and givers the set contains.
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

    /// Leaves in `set`, the transitions enabled in a marking, those to be fired there.
    pub(super) fn restrict(&self, packing: &Packing, words: &[u64], set: &mut [u64], scratch: &mut Scratch) {
        let enabled: u32 = set.iter().map(|word| word.count_ones()).sum();
        scratch.begin(set.len(), self.takers.len());
        self.close(&View { packing, words, enabled: set }, enabled, scratch);
        if scratch.enabled < enabled {
            set.iter_mut().zip(&scratch.set).for_each(|(word, stubborn)| *word &= stubborn);
        }
    }

    /// Collects the set, unless it has all that is enabled.
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

    /// Adds transitions of which one fires on every way to a goal that the marking does not have.
    fn seed(&self, goal: &Goal, marking: &View<'_>, scratch: &mut Scratch) {
        match goal {
            // Nothing fires in a marking that is not alive.
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
            // Whatever is enabled has to be disabled.
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

    /// For a transition that is not enabled, what gives tokens to a place that lacks them.
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

    /// For a transition that is enabled, what takes tokens from the places it needs.
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

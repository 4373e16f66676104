//! Input of the engine: a place/transition net as numbers.

use std::collections::BTreeMap;

use crate::net::{Net, PlaceId};

/// A place/transition net with an initial marking. Places are positions in `initial`, transitions are positions in
/// `transitions`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Model {
    /// Number of tokens of each place in the initial marking.
    pub initial: Vec<u64>,
    /// Arcs of each transition.
    pub transitions: Vec<Arcs>,
}

/// Arcs of one transition. Several arcs to one place add up; arcs of weight 0 are ignored.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Arcs {
    /// Preset: places with the number of tokens that are required and taken.
    pub pre: Vec<(u32, u64)>,
    /// Postset: places with the number of tokens that are put.
    pub post: Vec<(u32, u64)>,
}

impl From<&Net> for Model {
    fn from(net: &Net) -> Self {
        let list = |arcs: &mut dyn Iterator<Item = (PlaceId, u64)>| -> Vec<(u32, u64)> {
            arcs.map(|(place, weight)| (place.index() as u32, weight)).collect()
        };
        let arcs = |id| Arcs { pre: list(&mut net.pre(id)), post: list(&mut net.post(id)) };
        Self {
            initial: net.places().map(|place| place.tokens).collect(),
            transitions: net.transition_ids().map(arcs).collect(),
        }
    }
}

/// Upper bound (exclusive) on tokens and weights, so that sums of two do not overflow.
pub(super) const MANY: u64 = 1 << 62;

/// Arcs of a transition at one place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Touch {
    pub(super) place: usize,
    pub(super) pre: u64,
    pub(super) post: u64,
}

impl Touch {
    /// Number of tokens gained; negative if tokens are lost.
    pub(super) fn change(self) -> i64 {
        self.post as i64 - self.pre as i64
    }
}

/// A transition as its places in ascending order, each once.
pub(super) type Rule = Vec<Touch>;

impl Model {
    /// Returns the transitions as rules, or the reason why the net cannot be explored.
    pub(super) fn rules(&self) -> Result<Vec<Rule>, String> {
        if self.initial.iter().any(|&tokens| tokens >= MANY) {
            return Err("an initial marking has 2^62 tokens or more on a place".to_owned());
        }
        self.transitions.iter().map(|arcs| self.rule(arcs)).collect()
    }

    fn rule(&self, arcs: &Arcs) -> Result<Rule, String> {
        let mut places: BTreeMap<u32, (u64, u64)> = BTreeMap::new();
        for &(place, weight) in &arcs.pre {
            let pre = &mut places.entry(place).or_default().0;
            *pre = pre.saturating_add(weight);
        }
        for &(place, weight) in &arcs.post {
            let post = &mut places.entry(place).or_default().1;
            *post = post.saturating_add(weight);
        }
        let mut rule = Vec::with_capacity(places.len());
        for (place, (pre, post)) in places {
            if place as usize >= self.initial.len() {
                return Err(format!("an arc leads to place {place}, which the net does not have"));
            }
            if pre >= MANY || post >= MANY {
                return Err("an arc has a weight of 2^62 or more".to_owned());
            }
            if pre > 0 || post > 0 {
                rule.push(Touch { place: place as usize, pre, post });
            }
        }
        Ok(rule)
    }
}

//! Goals: properties of a marking in the form needed for directed search, in negation normal form with linear
//! comparisons.

use super::engine::View;

/// Property of a marking that a search looks for. Places and transitions are numbers of a net.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Goal {
    /// Constant: true of every marking, or of none.
    Truth(bool),
    /// The weighted sum of the tokens of places is at least a number. Each place occurs once, with a factor other than
    /// 0.
    AtLeast {
        /// Places with their factors.
        terms: Vec<(u32, i64)>,
        /// Lower bound of the sum.
        least: i128,
    },
    /// The transition is enabled.
    Enabled(u32),
    /// The transition is not enabled.
    Disabled(u32),
    /// No transition is enabled.
    Dead,
    /// Some transition is enabled.
    Alive,
    /// Conjunction.
    All(Vec<Goal>),
    /// Disjunction.
    Any(Vec<Goal>),
}

/// A marking on which goals are evaluated.
pub trait Tokens {
    /// Number of tokens on a place.
    fn tokens(&self, place: u32) -> u64;
    /// Whether a transition is enabled.
    fn is_enabled(&self, transition: u32) -> bool;
    /// Whether no transition is enabled.
    fn is_dead(&self) -> bool;
}

impl Tokens for View<'_> {
    fn tokens(&self, place: u32) -> u64 {
        View::tokens(self, place as usize)
    }

    fn is_enabled(&self, transition: u32) -> bool {
        View::is_enabled(self, transition as usize)
    }

    fn is_dead(&self) -> bool {
        self.is_deadlock()
    }
}

impl Goal {
    /// Whether the goal holds in a marking.
    pub fn holds(&self, marking: &impl Tokens) -> bool {
        match self {
            Self::Truth(value) => *value,
            Self::AtLeast { terms, least } => sum(terms, marking) >= *least,
            Self::Enabled(transition) => marking.is_enabled(*transition),
            Self::Disabled(transition) => !marking.is_enabled(*transition),
            Self::Dead => marking.is_dead(),
            Self::Alive => !marking.is_dead(),
            Self::All(parts) => parts.iter().all(|part| part.holds(marking)),
            Self::Any(parts) => parts.iter().any(|part| part.holds(marking)),
        }
    }
}

/// Weighted sum of the tokens of places.
fn sum(terms: &[(u32, i64)], marking: &impl Tokens) -> i128 {
    terms.iter().map(|&(place, factor)| i128::from(factor) * i128::from(marking.tokens(place))).sum()
}

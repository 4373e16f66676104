//! A property of one marking, in the form that searches towards it need: negations only at the atoms, comparisons linear.

use super::engine::View;

/// A property of a marking. Places and transitions are numbers of a net.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Goal {
    /// Every marking has it, or none.
    Truth(bool),
    /// The tokens of places, multiplied by numbers, come to no less than a number. Each place occurs once, none with 0.
    AtLeast {
        /// Places and what their tokens are multiplied by.
        terms: Vec<(u32, i64)>,
        /// The number.
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
    /// All of these.
    All(Vec<Goal>),
    /// At least one of these.
    Any(Vec<Goal>),
}

/// What a goal asks of a marking.
pub trait Tokens {
    /// How many tokens a place has.
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
    /// Whether a marking has the property.
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

/// The weighted sum of the tokens of places.
fn sum(terms: &[(u32, i64)], marking: &impl Tokens) -> i128 {
    terms.iter().map(|&(place, factor)| i128::from(factor) * i128::from(marking.tokens(place))).sum()
}

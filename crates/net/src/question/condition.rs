//! State formulas compiled for evaluation in millions of states.

use super::linear::Linear;
use crate::net::TransitionId;
use petril_logic::{Bound, Comparison, Valuation};

/// A state formula with its terms as linear sums.
pub(super) enum Condition<'f> {
    Enabled(TransitionId),
    Not(Box<Self>),
    And(Box<Self>, Box<Self>),
    Or(Box<Self>, Box<Self>),
    /// Comparison of a linear sum with 0.
    Compare(Comparison, Linear),
    /// Formula that is evaluated as it is.
    Other(&'f Bound),
}

impl<'f> Condition<'f> {
    pub(super) fn of(formula: &'f Bound) -> Self {
        let of = |f| Box::new(Self::of(f));
        match formula {
            Bound::Enabled(transition) => Self::Enabled(*transition),
            Bound::Not(f) => Self::Not(of(f)),
            Bound::And(f, g) => Self::And(of(f), of(g)),
            Bound::Or(f, g) => Self::Or(of(f), of(g)),
            Bound::Implies(f, g) => Self::Or(Box::new(Self::Not(of(f))), of(g)),
            Bound::Compare(comparison, left, right) => Linear::difference(left, right)
                .map_or(Self::Other(formula), |difference| Self::Compare(*comparison, difference)),
            _ => Self::Other(formula),
        }
    }

    /// Evaluates the condition; `tokens` are the token counts of the state by place.
    pub(super) fn holds(&self, tokens: &[u64], state: &impl Valuation) -> bool {
        match self {
            Self::Enabled(transition) => state.is_enabled(*transition),
            Self::Not(f) => !f.holds(tokens, state),
            Self::And(f, g) => f.holds(tokens, state) && g.holds(tokens, state),
            Self::Or(f, g) => f.holds(tokens, state) || g.holds(tokens, state),
            Self::Compare(comparison, Linear { terms, number }) => {
                let term = |&(place, times): &(u32, i64)| i128::from(tokens[place as usize]) * i128::from(times);
                comparison.holds(terms.iter().map(term).sum::<i128>() + number, 0)
            }
            Self::Other(formula) => formula.holds_in(state) == Some(true),
        }
    }
}

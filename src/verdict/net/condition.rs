//! Formulas about one state, made ready to be evaluated in millions of them.

use crate::logic::{Bound, Comparison, Term, Valuation};
use crate::net::TransitionId;

/// A formula about one state, where sums are lists.
pub(super) enum Condition<'f> {
    Enabled(TransitionId),
    Not(Box<Self>),
    And(Box<Self>, Box<Self>),
    Or(Box<Self>, Box<Self>),
    /// Tokens of places, each so many times, and a number compare with 0.
    Compare(Comparison, Vec<(usize, i64)>, i128),
    /// As it is.
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
            Bound::Compare(comparison, left, right) => {
                let (mut terms, mut number) = (Vec::new(), 0);
                let is_sum = add(left, 1, &mut terms, &mut number) && add(right, -1, &mut terms, &mut number);
                if is_sum { Self::Compare(*comparison, terms, number) } else { Self::Other(formula) }
            }
            _ => Self::Other(formula),
        }
    }

    /// Whether it holds; `tokens` are those of the state, by place.
    pub(super) fn holds(&self, tokens: &[u64], state: &impl Valuation) -> bool {
        match self {
            Self::Enabled(transition) => state.is_enabled(*transition),
            Self::Not(f) => !f.holds(tokens, state),
            Self::And(f, g) => f.holds(tokens, state) && g.holds(tokens, state),
            Self::Or(f, g) => f.holds(tokens, state) || g.holds(tokens, state),
            Self::Compare(comparison, terms, number) => {
                let sum =
                    terms.iter().map(|&(place, times)| i128::from(tokens[place]) * i128::from(times)).sum::<i128>();
                comparison.holds(sum + number, 0)
            }
            Self::Other(formula) => formula.holds_in(state) == Some(true),
        }
    }
}

/// Adds a term, so many times, if it is a sum of tokens and small numbers.
fn add(term: &Term, times: i64, terms: &mut Vec<(usize, i64)>, number: &mut i128) -> bool {
    match term {
        Term::Number(n) if n.unsigned_abs() < 1 << 64 => {
            *number += n * i128::from(times);
            true
        }
        Term::Tokens(place) => {
            terms.push((place.index(), times));
            true
        }
        Term::Sum(a, b) => add(a, times, terms, number) && add(b, times, terms, number),
        Term::Difference(a, b) => add(a, times, terms, number) && add(b, -times, terms, number),
        _ => false,
    }
}

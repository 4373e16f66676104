//! Bound formulas: their atoms are variables, places and transitions.

use std::sync::Arc;

use super::formula::{Comparison, Quantifier};
use super::ltl::Path;
use super::past::Past;
use petril_base::{PlaceId, TransitionId};
use petril_base::{Type, VarId};

/// A bound formula over the states of one view. F and G are represented by untils: `F g = TRUE U g`, `G f = f W FALSE`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Bound {
    /// A constant.
    Truth(bool),
    /// The variable, of type `BOOL`, is TRUE.
    Variable(VarId),
    /// A bit of the variable, counted from 0, is 1.
    Bit(VarId, u32),
    /// The place is marked.
    Marked(PlaceId),
    /// The transition is enabled.
    Enabled(TransitionId),
    /// No transition is enabled.
    Deadlock,
    /// Comparison of two numbers.
    Compare(Comparison, Term, Term),
    /// Negation.
    Not(Box<Bound>),
    /// Conjunction.
    And(Box<Bound>, Box<Bound>),
    /// Disjunction.
    Or(Box<Bound>, Box<Bound>),
    /// Implication.
    Implies(Box<Bound>, Box<Bound>),
    /// Equivalence.
    Iff(Box<Bound>, Box<Bound>),
    /// AX or EX: true in the next state.
    Next(Quantifier, Box<Bound>),
    /// Until: AU, EU, AW or EW.
    Until {
        /// Path quantifier.
        quantifier: Quantifier,
        /// Whether the until is weak (W): `release` need not become true if `hold` is true for ever.
        weak: bool,
        /// Formula that must be true until `release` is.
        hold: Box<Bound>,
        /// Formula that ends the until.
        release: Box<Bound>,
    },
    /// LTL formula about all paths. Never a part of another formula.
    Ltl(Box<Path<Bound>>),
}

/// A term: a number that depends on the state.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Term {
    /// A constant.
    Number(i128),
    /// Value of a variable as a number.
    Variable(VarId, Type),
    /// Value of a variable in the transition view, where each of its bits is a place.
    Bits {
        /// The variable.
        variable: VarId,
        /// Places that are marked if a bit is 1, each with the weight of the bit.
        places: Vec<(PlaceId, i128)>,
    },
    /// Number of tokens on the place.
    Tokens(PlaceId),
    /// Term about the past; a truth value counts as 0 or 1.
    Past(Arc<Past>),
    /// 1 if the state formula is true, else 0.
    Truth(Box<Bound>),
    /// Sum.
    Sum(Box<Term>, Box<Term>),
    /// Difference.
    Difference(Box<Term>, Box<Term>),
    /// Product.
    Product(Box<Term>, Box<Term>),
}

/// Valuation of atoms and terms in a state.
pub trait Valuation {
    /// Value of a variable, as a bit pattern of its type.
    fn value(&self, variable: VarId) -> u64;
    /// Value of a term about the past. Never called on valuations without a past.
    fn past(&self, past: &Past) -> i128 {
        debug_assert!(false, "nothing is remembered here: {past:?}");
        0
    }
    /// Whether a place is marked. False by default, for states that are ends of scans.
    fn is_marked(&self, _: PlaceId) -> bool {
        false
    }
    /// Number of tokens on a place.
    fn tokens(&self, place: PlaceId) -> u64 {
        u64::from(self.is_marked(place))
    }
    /// Whether a transition is enabled. False by default, for states that are ends of scans.
    fn is_enabled(&self, _: TransitionId) -> bool {
        false
    }
    /// Whether no transition is enabled.
    fn is_deadlock(&self) -> bool {
        false
    }
}

impl Bound {
    /// Whether the formula is a state formula, without temporal operators.
    #[must_use]
    pub fn is_state_formula(&self) -> bool {
        match self {
            Self::Truth(_)
            | Self::Variable(_)
            | Self::Bit(..)
            | Self::Marked(_)
            | Self::Enabled(_)
            | Self::Deadlock
            | Self::Compare(..) => true,
            Self::Not(f) => f.is_state_formula(),
            Self::And(f, g) | Self::Or(f, g) | Self::Implies(f, g) | Self::Iff(f, g) => {
                f.is_state_formula() && g.is_state_formula()
            }
            Self::Next(..) | Self::Until { .. } | Self::Ltl(_) => false,
        }
    }

    /// Returns f if the formula is EF f.
    #[must_use]
    pub fn possibility(&self) -> Option<&Self> {
        match self {
            Self::Until { quantifier: Quantifier::Some, weak: false, hold, release } => {
                (**hold == Self::Truth(true)).then_some(release)
            }
            _ => None,
        }
    }

    /// Evaluates the formula in a state. `None` if the result depends on a temporal part.
    pub fn holds_in(&self, state: &impl Valuation) -> Option<bool> {
        Some(match self {
            Self::Truth(value) => *value,
            Self::Variable(variable) => state.value(*variable) == 1,
            Self::Bit(variable, bit) => state.value(*variable) >> bit & 1 == 1,
            Self::Marked(place) => state.is_marked(*place),
            Self::Enabled(transition) => state.is_enabled(*transition),
            Self::Deadlock => state.is_deadlock(),
            Self::Compare(comparison, left, right) => comparison.holds(left.value_in(state)?, right.value_in(state)?),
            Self::Not(f) => !f.holds_in(state)?,
            Self::And(f, g) => f.holds_in(state)? && g.holds_in(state)?,
            Self::Or(f, g) => f.holds_in(state)? || g.holds_in(state)?,
            Self::Implies(f, g) => !f.holds_in(state)? || g.holds_in(state)?,
            Self::Iff(f, g) => f.holds_in(state)? == g.holds_in(state)?,
            Self::Next(..) | Self::Until { .. } | Self::Ltl(_) => return None,
        })
    }
}

impl Term {
    /// Evaluates the term in a state. `None` if a part is temporal.
    pub fn value_in(&self, state: &impl Valuation) -> Option<i128> {
        Some(match self {
            Self::Number(number) => *number,
            Self::Variable(variable, ty) => ty.number(state.value(*variable)),
            Self::Bits { places, .. } => {
                places.iter().filter(|(place, _)| state.is_marked(*place)).map(|(_, weight)| weight).sum()
            }
            Self::Tokens(place) => i128::from(state.tokens(*place)),
            Self::Past(past) => state.past(past),
            Self::Truth(f) => i128::from(f.holds_in(state)?),
            Self::Sum(a, b) => a.value_in(state)? + b.value_in(state)?,
            Self::Difference(a, b) => a.value_in(state)? - b.value_in(state)?,
            Self::Product(a, b) => a.value_in(state)? * b.value_in(state)?,
        })
    }

    /// Upper bound on the absolute value; `None` if an `i128` has no room for one more operation on it.
    #[must_use]
    pub fn magnitude(&self) -> Option<u128> {
        let sum = match self {
            Self::Number(number) => Some(number.unsigned_abs()),
            Self::Variable(_, ty) => Some(ty.least().unsigned_abs().max(ty.greatest().unsigned_abs())),
            Self::Bits { places, .. } => Some(places.iter().map(|(_, weight)| weight.unsigned_abs()).sum()),
            Self::Tokens(_) => Some(u128::from(u64::MAX)),
            Self::Truth(_) => Some(1),
            Self::Past(past) => Some(past.magnitude()),
            Self::Sum(a, b) | Self::Difference(a, b) => a.magnitude()?.checked_add(b.magnitude()?),
            Self::Product(a, b) => a.magnitude()?.checked_mul(b.magnitude()?),
        };
        sum.filter(|&magnitude| magnitude < 1 << 126)
    }
}

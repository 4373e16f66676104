//! Formulas whose truth depends on how long a scan takes.

use super::formula::{Amount, Duration, Expression, Formula};
use super::parse::{Body, Requirement};

impl Requirement {
    /// Whether it speaks of times, so that its truth depends on how long a scan takes.
    #[must_use]
    pub fn speaks_of_time(&self) -> bool {
        matches!(&self.body, Body::Formula(formula) | Body::Possible(formula) if formula.speaks_of_time())
    }
}

impl Formula {
    /// Whether the formula speaks of times.
    #[must_use]
    pub fn speaks_of_time(&self) -> bool {
        let timed = |duration: &Duration| matches!(duration.amount, Amount::Milliseconds(_));
        match &self.expression {
            Expression::Held(f, duration) | Expression::Within(f, duration) => timed(duration) || f.speaks_of_time(),
            Expression::Response(f, g, duration) => timed(duration) || f.speaks_of_time() || g.speaks_of_time(),
            Expression::Not(f) | Expression::Temporal(_, _, f) => f.speaks_of_time(),
            Expression::And(f, g)
            | Expression::Or(f, g)
            | Expression::Implies(f, g)
            | Expression::Iff(f, g)
            | Expression::Compare(_, f, g)
            | Expression::Sum(f, g)
            | Expression::Difference(f, g)
            | Expression::Product(f, g)
            | Expression::Until { hold: f, release: g, .. } => f.speaks_of_time() || g.speaks_of_time(),
            Expression::Past(_, of) => of.iter().any(Self::speaks_of_time),
            Expression::Ltl(path) => path.atoms().into_iter().any(Self::speaks_of_time),
            _ => false,
        }
    }
}

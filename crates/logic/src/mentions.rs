//! Variables of a formula, and the numbers in it.

use std::collections::BTreeSet;

use super::bound::{Bound, Term};
use super::past::Past;
use petril_base::VarId;

/// Variables and numbers of a formula bound for the scan view.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Mentions {
    /// Variables of the formula.
    pub variables: BTreeSet<VarId>,
    /// Numbers in the formula.
    pub numbers: BTreeSet<i128>,
}

impl Bound {
    /// Collects the variables and numbers of the formula.
    #[must_use]
    pub fn mentions(&self) -> Mentions {
        let mut mentions = Mentions::default();
        mentions.add(self);
        mentions
    }
}

impl Mentions {
    fn add(&mut self, formula: &Bound) {
        match formula {
            Bound::Truth(_) | Bound::Marked(_) | Bound::Enabled(_) | Bound::Deadlock => {}
            Bound::Variable(variable) | Bound::Bit(variable, _) => _ = self.variables.insert(*variable),
            Bound::Compare(_, left, right) => [left, right].into_iter().for_each(|term| self.add_term(term)),
            Bound::Not(f) | Bound::Next(_, f) => self.add(f),
            Bound::And(f, g) | Bound::Or(f, g) | Bound::Implies(f, g) | Bound::Iff(f, g) => {
                [f, g].into_iter().for_each(|part| self.add(part));
            }
            Bound::Until { hold, release, .. } => [hold, release].into_iter().for_each(|part| self.add(part)),
            Bound::Ltl(path) => path.atoms().into_iter().for_each(|atom| self.add(atom)),
        }
    }

    fn add_term(&mut self, term: &Term) {
        match term {
            Term::Number(number) => _ = self.numbers.insert(*number),
            Term::Variable(variable, _) | Term::Bits { variable, .. } => _ = self.variables.insert(*variable),
            Term::Tokens(_) => {}
            Term::Past(past) => match &**past {
                Past::First => {}
                Past::Before(term) => self.add_term(term),
                Past::Since(f, g) => [f, g].into_iter().for_each(|part| self.add(part)),
                Past::Run { of, .. } => self.add(of),
            },
            Term::Truth(f) => self.add(f),
            Term::Sum(a, b) | Term::Difference(a, b) | Term::Product(a, b) => {
                [a, b].into_iter().for_each(|term| self.add_term(term));
            }
        }
    }
}

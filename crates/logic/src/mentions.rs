//! Variables of a formula, and the numbers in it.

use std::collections::BTreeSet;

use super::atoms::Atom;
use super::bound::Bound;
use petril_base::VarId;

/// Variables and numbers of a formula.
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
        self.for_each_atom(&mut |atom| match atom {
            Atom::Variable(variable) | Atom::Word(variable) => _ = mentions.variables.insert(variable),
            Atom::Number(number) => _ = mentions.numbers.insert(number),
            Atom::Place(_) | Atom::Enabled(_) | Atom::Deadlock | Atom::Past => {}
        });
        mentions
    }
}

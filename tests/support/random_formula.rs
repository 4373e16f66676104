//! Random formulas of CTL and LTL over given atoms.

use petril::logic::{Bound, Comparison, Path, Quantifier, Term};
use proptest::prelude::*;

/// A formula over these atoms; without X if `next` is false.
pub fn formula(atoms: Vec<Bound>, next: bool) -> impl Strategy<Value = Bound> {
    let atom = proptest::sample::select(atoms);
    let count = (atom.clone(), atom.clone(), -1..3_i128).prop_map(|(a, b, n)| {
        let truth = |a| Box::new(Term::Truth(Box::new(a)));
        Bound::Compare(Comparison::AtLeast, Term::Sum(truth(a), truth(b)), Term::Number(n))
    });
    let leaf = prop_oneof![6 => atom, 1 => count, 1 => any::<bool>().prop_map(Bound::Truth)];
    leaf.prop_recursive(4, 20, 2, move |inner| {
        let pair = || (inner.clone().prop_map(Box::new), inner.clone().prop_map(Box::new));
        let quantifier = || proptest::sample::select(vec![Quantifier::All, Quantifier::Some]);
        let until = (quantifier(), any::<bool>(), pair())
            .prop_map(|(quantifier, weak, (hold, release))| Bound::Until { quantifier, weak, hold, release });
        let step = (quantifier(), inner.clone().prop_map(Box::new))
            .prop_map(move |(quantifier, f)| if next { Bound::Next(quantifier, f) } else { Bound::Not(f) });
        prop_oneof![
            inner.clone().prop_map(|f| Bound::Not(Box::new(f))),
            pair().prop_map(|(f, g)| Bound::And(f, g)),
            pair().prop_map(|(f, g)| Bound::Or(f, g)),
            pair().prop_map(|(f, g)| Bound::Implies(f, g)),
            pair().prop_map(|(f, g)| Bound::Iff(f, g)),
            until,
            step,
        ]
    })
}

/// A formula of LTL over these atoms.
pub fn path(atoms: Vec<Bound>) -> impl Strategy<Value = Path<Bound>> {
    let leaf = prop_oneof![6 => proptest::sample::select(atoms), 1 => any::<bool>().prop_map(Bound::Truth)];
    leaf.prop_map(Path::State).prop_recursive(4, 12, 2, |inner| {
        let one = || inner.clone().prop_map(Box::new);
        let two = || (one(), one());
        prop_oneof![
            one().prop_map(Path::Not),
            one().prop_map(Path::Next),
            one().prop_map(Path::Finally),
            one().prop_map(Path::Globally),
            two().prop_map(|(f, g)| Path::And(f, g)),
            two().prop_map(|(f, g)| Path::Or(f, g)),
            two().prop_map(|(f, g)| Path::Implies(f, g)),
            two().prop_map(|(f, g)| Path::Iff(f, g)),
            two().prop_map(|(f, g)| Path::Until(f, g)),
            two().prop_map(|(f, g)| Path::WeakUntil(f, g)),
            two().prop_map(|(f, g)| Path::Release(f, g)),
        ]
    })
}

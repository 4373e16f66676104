//! Formulas as text: printing a bound formula and reading the text again gives the same formula, in both views.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

mod support;

use std::sync::LazyLock;

use petril::logic::{Bound, Comparison, Quantifier, Term, View};
use petril::semantics::Role;
use petril::translate::System;
use proptest::prelude::*;
use support::systems::{CYLINDER, EVERY_INSTRUCTION, system};

/// Names that are words of the formula language, buffers, a plant.
static SYSTEM: LazyLock<System> = LazyLock::new(|| system(EVERY_INSTRUCTION, &[CYLINDER]));

/// Everything a formula of a view can say of one state.
fn atoms(view: View) -> Vec<Bound> {
    match view {
        View::Scan => SYSTEM.program.declared().map(Bound::Variable).collect(),
        View::Transition => {
            let places = SYSTEM.net.place_ids().map(Bound::Marked);
            places.chain(SYSTEM.net.transition_ids().map(Bound::Enabled)).collect()
        }
    }
}

fn formula(view: View) -> impl Strategy<Value = Bound> {
    let leaf = prop_oneof![5 => proptest::sample::select(atoms(view)), 1 => any::<bool>().prop_map(Bound::Truth)];
    leaf.prop_recursive(6, 40, 3, |inner| {
        let quantifier = || proptest::sample::select(vec![Quantifier::All, Quantifier::Some]);
        let boxed = || inner.clone().prop_map(Box::new);
        let pair = || (boxed(), boxed());
        let constant = |value| Box::new(Bound::Truth(value));
        let signs = vec![
            Comparison::Equal,
            Comparison::Unequal,
            Comparison::Less,
            Comparison::AtMost,
            Comparison::Greater,
            Comparison::AtLeast,
        ];
        // A number is made of truth values; temporal formulas are none.
        let truth =
            inner.clone().prop_filter_map("temporal", |f| f.is_state_formula().then(|| Term::Truth(Box::new(f))));
        let number = prop_oneof![2 => truth, 1 => (-3..1000_i128).prop_map(Term::Number)];
        let term = number.prop_recursive(3, 6, 2, |inner| {
            let pair = || (inner.clone().prop_map(Box::new), inner.clone().prop_map(Box::new));
            prop_oneof![
                pair().prop_map(|(a, b)| Term::Sum(a, b)),
                pair().prop_map(|(a, b)| Term::Difference(a, b)),
                pair().prop_map(|(a, b)| Term::Product(a, b)),
            ]
        });
        prop_oneof![
            boxed().prop_map(Bound::Not),
            pair().prop_map(|(f, g)| Bound::And(f, g)),
            pair().prop_map(|(f, g)| Bound::Or(f, g)),
            pair().prop_map(|(f, g)| Bound::Implies(f, g)),
            pair().prop_map(|(f, g)| Bound::Iff(f, g)),
            (proptest::sample::select(signs), term.clone(), term).prop_map(|(sign, a, b)| Bound::Compare(sign, a, b)),
            (quantifier(), boxed()).prop_map(|(quantifier, f)| Bound::Next(quantifier, f)),
            (quantifier(), boxed()).prop_map(move |(quantifier, release)| {
                Bound::Until { quantifier, weak: false, hold: constant(true), release }
            }),
            (quantifier(), boxed()).prop_map(move |(quantifier, hold)| {
                Bound::Until { quantifier, weak: true, hold, release: constant(false) }
            }),
            (quantifier(), any::<bool>(), pair()).prop_map(|(quantifier, weak, (hold, release))| Bound::Until {
                quantifier,
                weak,
                hold,
                release
            }),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn of_the_scan_view_come_back(formula in formula(View::Scan)) {
        let text = formula.text(&SYSTEM);
        prop_assert_eq!(support::formula(&text, &SYSTEM, View::Scan), formula, "{}", text);
    }

    #[test]
    fn of_the_transition_view_come_back(formula in formula(View::Transition)) {
        let text = formula.text(&SYSTEM);
        prop_assert_eq!(support::formula(&text, &SYSTEM, View::Transition), formula, "{}", text);
    }
}

/// The text has no parentheses that are not needed.
#[test]
fn texts_are_as_one_would_write_them() {
    let texts = [
        "AG (q -> a & x)",
        "a & x & q",
        "a & (x & q)",
        "a | x & q",
        "(a | x) & q",
        "a -> x -> q",
        "(a -> x) -> q",
        "!a <-> x <-> q",
        "!(a & x)",
        "AG EF !q",
        "AG (a + x + q = 1)",
        "a - (x - q) <= -1",
        "(a + x) * 2 > 3",
        "(a = x) = q",
        "A [a U x | q]",
        "E [AG a W (EX q)]",
        "AF (a != x)",
        "!!a",
        "memory & TRUE",
    ];
    for text in texts {
        let printed = support::formula(text, &SYSTEM, View::Scan).text(&SYSTEM);
        assert_eq!(printed, text.replace("(EX q)", "EX q"));
    }
    let texts = [
        "AG (at line 3 -> !q)",
        "EF (at idle & at End)",
        "marked(\"CR=1\")",
        "AG enabled(\"block\")",
        "marked(\"x=0\")",
    ];
    for text in texts {
        assert_eq!(support::formula(text, &SYSTEM, View::Transition).text(&SYSTEM), text);
    }
}

/// A buffer has no name of its own in formulas: it is a place of the net.
#[test]
fn buffers_are_told_as_places() {
    let buffer = SYSTEM.program.with_role(Role::Buffer).next().unwrap();
    let name = &SYSTEM.program.variable(buffer).name;
    let text = format!("marked(\"{name}=1\")");
    assert_eq!(support::formula(&text, &SYSTEM, View::Transition).text(&SYSTEM), text);
}

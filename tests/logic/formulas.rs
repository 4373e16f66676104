//! Formulas as text: printing a bound formula and reading the text again gives the same formula, in both views
//! and for a net alone.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::sync::LazyLock;

use petril::logic::{Bound, Comparison, Nodes, Quantifier, Term, View, bind, bind_in_net, parse_formula};
use petril::semantics::Role;
use petril::source::Source;
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
            places.chain(SYSTEM.net.transition_ids().map(Bound::Enabled)).chain([Bound::Deadlock]).collect()
        }
    }
}

/// Everything a formula of a view can count in one state, besides truth values.
fn counts(view: View) -> Vec<Term> {
    match view {
        View::Scan => vec![Term::Number(7)],
        View::Transition => SYSTEM.net.place_ids().map(Term::Tokens).collect(),
    }
}

fn formula(view: View) -> impl Strategy<Value = Bound> {
    let leaf = prop_oneof![5 => proptest::sample::select(atoms(view)), 1 => any::<bool>().prop_map(Bound::Truth)];
    leaf.prop_recursive(6, 40, 3, move |inner| {
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
        let count = proptest::sample::select(counts(view));
        let number = prop_oneof![2 => truth, 1 => count, 1 => (-3..1000_i128).prop_map(Term::Number)];
        let term = number.prop_recursive(3, 6, 2, |inner| {
            let pair = || (inner.clone().prop_map(Box::new), inner.clone().prop_map(Box::new));
            prop_oneof![
                pair().prop_map(|(a, b)| Term::Sum(a, b)),
                pair().prop_map(|(a, b)| Term::Difference(a, b)),
                pair().prop_map(|(a, b)| Term::Product(a, b)),
            ]
        });
        let term = term.prop_filter("too large", |term| term.magnitude().is_some());
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
        let text = formula.text(&*SYSTEM);
        prop_assert_eq!(support::formula(&text, &SYSTEM, View::Scan), formula, "{}", text);
    }

    #[test]
    fn of_the_transition_view_come_back(formula in formula(View::Transition)) {
        let text = formula.text(&*SYSTEM);
        prop_assert_eq!(support::formula(&text, &SYSTEM, View::Transition), formula, "{}", text);
    }

    #[test]
    fn of_a_net_alone_come_back(formula in formula(View::Transition)) {
        let text = formula.text(&SYSTEM.net);
        prop_assert_eq!(in_net(&text), Ok(formula), "{}", text);
    }
}

/// The formula of a text about the net alone, or what is wrong with it.
fn in_net(text: &str) -> Result<Bound, Vec<String>> {
    let formula = parse_formula(&Source::new("formula", text)).unwrap_or_else(|e| panic!("{text}: {e:?}"));
    bind_in_net(&formula, &SYSTEM.net.nodes()).map_err(|errors| {
        errors.into_iter().map(|e| format!("{} {}; {}", e.code, e.message, e.help.join(""))).collect()
    })
}

#[test]
fn a_net_alone_has_places_and_transitions_only() {
    let errors = in_net("marked(\"x=2\") & enabled(\"blok\") -> q + tokens(\"nowhere\") = block | at line 1 & at End")
        .unwrap_err();
    assert_eq!(
        errors,
        [
            "E0502 the net has no place `x=2`; did you mean `x=0`?",
            "E0502 the net has no transition `blok`; did you mean `block`?",
            "E0505 the formula speaks of the variable `q`, but a net alone has no program; write `marked(\"…\")` or \
             `tokens(\"…\")` with a place, or `enabled(\"…\")` with a transition",
            "E0502 the net has no place `nowhere`; ",
            "E0505 the formula speaks of the variable `block`, but a net alone has no program; to speak of the \
             transition, write `enabled(\"block\")`",
            "E0505 the formula speaks of where control is, but a net alone has no program; ",
            "E0505 the formula speaks of where control is, but a net alone has no program; ",
        ]
    );
    let errors = in_net("AG idle").unwrap_err();
    assert!(errors[0].ends_with("to speak of the place, write `marked(\"idle\")` or `tokens(\"idle\")`"), "{errors:?}");
    let errors = in_net("tokens(\"idle\") * tokens(\"idle\") = 1 & AG tokens(\"idle\")").unwrap_err();
    assert_eq!(
        errors,
        [
            "E0503 the numbers in this comparison can become too large; ",
            "E0503 this is a number, where something true or false is needed; compare it with something, like `… = 1`",
        ]
    );
}

#[test]
fn tokens_and_deadlocks_are_not_seen_in_the_scan_view() {
    let text = "tokens(\"x=1\") = 1 -> at deadlock";
    let formula = parse_formula(&Source::new("formula", text)).unwrap();
    let errors = bind(&formula, &SYSTEM, View::Scan).unwrap_err();
    let said: Vec<_> = errors.iter().map(|e| (e.code.id(), e.message.as_str())).collect();
    let of = "but a state of the scan view is the end of a scan";
    assert_eq!(
        said,
        [
            ("E0505", format!("the requirement speaks of a place of the net, {of}").as_str()),
            ("E0505", format!("the requirement speaks of a deadlock of the net, {of}").as_str()),
        ]
    );
}

/// Names and ids may be each other's: what a text means depends on which of them it is read by.
#[test]
fn ids_are_not_names() {
    let net = &SYSTEM.net;
    let [zero, one] = ["x=0", "x=1"].map(|name| net.find_place(name).unwrap());
    let nodes = Nodes::by_id([("x=1", zero), ("alias", zero), ("b", one)], []);
    let bound = |text: &str| {
        let formula = parse_formula(&Source::new("formula", text)).unwrap();
        bind_in_net(&formula, &nodes).map_err(|errors| errors[0].message.clone())
    };
    assert_eq!(bound("marked(\"x=1\")"), Ok(Bound::Marked(zero)));
    assert_eq!(bound("marked(\"alias\")"), Ok(Bound::Marked(zero)));
    assert_eq!(bound("marked(\"b\")"), Ok(Bound::Marked(one)));
    assert_eq!(bound("marked(\"x=0\")"), Err("the net has no place with the id `x=0`".to_owned()));
    assert_eq!(bound("enabled(\"b\")"), Err("the net has no transition with the id `b`".to_owned()));
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
        let printed = support::formula(text, &SYSTEM, View::Scan).text(&*SYSTEM);
        assert_eq!(printed, text.replace("(EX q)", "EX q"));
    }
    let texts = [
        "AG (at line 3 -> !q)",
        "EF (at idle & at End)",
        "marked(\"CR=1\")",
        "AG enabled(\"block\")",
        "marked(\"x=0\")",
        "tokens(\"x=0\") + tokens(\"x=1\") = 1",
        "AG !at deadlock",
    ];
    for text in texts {
        assert_eq!(support::formula(text, &SYSTEM, View::Transition).text(&*SYSTEM), text);
    }
}

/// A buffer has no name of its own in formulas: it is a place of the net.
#[test]
fn buffers_are_told_as_places() {
    let buffer = SYSTEM.program.with_role(Role::Buffer).next().unwrap();
    let name = &SYSTEM.program.variable(buffer).name;
    let text = format!("marked(\"{name}=1\")");
    assert_eq!(support::formula(&text, &SYSTEM, View::Transition).text(&*SYSTEM), text);
}

//! One value for all that nothing tells apart: the verdicts are those of trying every value.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::flat::FlatProgram;
use petril::logic::{Demand, Requirement, View, bind_requirement, parse_requirement, representatives};
use petril::source::Source;
use petril::translate::{Domains, Plant, System};
use petril::verdict::{Options, Trace, check};
use proptest::prelude::*;
use support::assembler::assemble;

const INPUTS: &str = "in k SINT\nin u USINT\nvar m SINT\nout p BOOL\nout q BOOL";

fn bound(system: &System, texts: &[String]) -> Vec<(Requirement, Demand)> {
    let one = |text: &String| {
        let requirement = parse_requirement(text, &Source::new("formula", text.as_str())).unwrap();
        let bound = bind_requirement(&requirement, system, View::Scan).unwrap_or_else(|e| panic!("{text}: {e:#?}"));
        (requirement, bound)
    };
    texts.iter().map(one).collect()
}

/// The representatives that are found for a program and formulas.
fn found(program: &FlatProgram, texts: &[String]) -> Domains {
    let system = System::new(program.clone(), Plant::default());
    let requirements = bound(&system, texts);
    representatives(&system, &requirements.iter().filter_map(|(_, demand)| demand.formula()).collect::<Vec<_>>())
}

/// Name, verdict and length of the trace of each requirement, and the values of the outputs on it.
fn answers(program: &FlatProgram, domains: Domains, texts: &[String]) -> Vec<String> {
    let system = System::with_domains(program.clone(), Plant::default(), domains);
    let report = check(&system, &bound(&system, texts), &Options::default(), &mut |_| None);
    let scans = |trace: &Trace| match trace {
        Trace::Scans(trace) => trace.scans.len(),
        Trace::Firings(trace) => trace.firings.len(),
    };
    let text = |answer: &petril::verdict::Answer| {
        let length = answer.outcome.witness().map(|witness| scans(&witness.trace));
        format!("{} {:?} {length:?}", answer.name, answer.outcome.verdict())
    };
    report.answers.iter().chain(&report.checks).map(text).collect()
}

/// The values found for an input, as numbers.
fn values(program: &FlatProgram, texts: &[&str], input: &str) -> Option<Vec<i128>> {
    let texts: Vec<String> = texts.iter().map(|&text| text.to_owned()).collect();
    let domain = found(program, &texts).remove(&program.find(input).unwrap())?;
    Some(domain.ranges().iter().flat_map(|&(from, to)| from..=to).collect())
}

#[test]
fn intervals_are_those_that_comparisons_make() {
    let program = assemble(INPUTS, "LD k\nGT 10\nST p\nLD SINT#-3\nGT k\nST q");
    // k > 10, and -3 > k.
    assert_eq!(values(&program, &[], "k"), Some(vec![-4, 0, 11]));
    assert_eq!(values(&program, &["AG (k = 5 -> !p)"], "k"), Some(vec![-4, 0, 5, 6, 11]));
    assert_eq!(values(&program, &["AG (2 * 20 >= k)"], "k"), Some(vec![-4, 0, 11, 41]));
    // Along paths and of scans before, too.
    for text in ["LTL G (k = 5 -> !p)", "AG (pre(k) = 5 -> !p)", "AG (once(k = 5) -> !p)", "AG ((k = 5) since p)"] {
        assert_eq!(values(&program, &[text], "k"), Some(vec![-4, 0, 5, 6, 11]), "{text}");
    }
    for text in ["LTL F (p & k + 1 = 5)", "AG (p since k + 1 = 5)", "AG ((k + 1 = 5) since p)"] {
        assert_eq!(values(&program, &[text], "k"), None, "{text}");
    }
    assert_eq!(values(&program, &["AG (k < 500)"], "k"), Some(vec![-4, 0, 11]), "no value of the type");
    assert_eq!(values(&program, &[], "u"), Some(vec![0]), "it is not used");
}

#[test]
fn what_is_more_than_a_comparison_needs_every_value() {
    let every =
        |code: &str, texts: &[&str]| assert_eq!(values(&assemble(INPUTS, code), texts, "k"), None, "{code} {texts:?}");
    every("LD k\nST m", &[]);
    every("LD k\nADD 1\nGT 3\nST p", &[]);
    every("LD m\nGT k\nST p", &[]);
    every("LD k\nGT m\nST p", &[]);
    every("LD k\nTO INT\nGT 3\nST p", &[]);
    every("LD k\nJMP 3\nGT 3\nST p", &[]);
    every("LD k\nSUBRANGE 0..5", &[]);
    // The line is also come to with m as current result.
    every("LD m\nJMP 4\nLD SINT#3\nGT k\nST p", &[]);
    every("LD k\nGT 3\nST p", &["AG (k = m)"]);
    every("LD k\nGT 3\nST p", &["AG (k + 1 > 3)"]);
    every("LD k\nGT 3\nST p", &["AG (3 > k - k)"]);
}

/// Pieces of a program: comparisons of both inputs, with and without memory.
fn piece() -> impl Strategy<Value = String> {
    let comparison = || proptest::sample::select(vec!["GT", "GE", "EQ", "NE", "LE", "LT"]);
    let target =
        || proptest::sample::select(vec!["ST p", "ST q", "S p", "R q", "AND q\nST p", "XOR p\nST p", "OR p\nST q"]);
    prop_oneof![
        3 => (comparison(), -128..128_i32, target()).prop_map(|(f, n, t)| format!("LD k\n{f} {n}\n{t}")),
        2 => (comparison(), -128..128_i32, target()).prop_map(|(f, n, t)| format!("LD SINT#{n}\n{f} k\n{t}")),
        1 => (comparison(), 0..256_i32, target()).prop_map(|(f, n, t)| format!("LD u\n{f} {n}\n{t}")),
        1 => (comparison(), -2..4_i32).prop_map(|(f, n)| format!("LD m\nADD 1\nMOD 3\nST m\n{f} {n}\nST p")),
    ]
}

fn atom() -> impl Strategy<Value = String> {
    let comparison = || proptest::sample::select(vec![">", ">=", "=", "!=", "<=", "<"]);
    prop_oneof![
        2 => proptest::sample::select(vec!["p", "q", "m = 1", "p + q = 1"]).prop_map(str::to_owned),
        2 => (comparison(), -130..130_i32).prop_map(|(f, n)| format!("k {f} {n}")),
        1 => (comparison(), -130..130_i32).prop_map(|(f, n)| format!("{n} {f} k")),
    ]
}

fn requirement() -> impl Strategy<Value = String> {
    let shape = proptest::sample::select(vec![
        "AG (a -> b)",
        "EF (a & b)",
        "AG (a -> AX b)",
        "AG (a -> AF b)",
        "A [a W b]",
        "E [a U b]",
        "AG EF a",
        "EG (a | b)",
    ]);
    (shape, atom(), atom()).prop_map(|(shape, a, b)| {
        shape
            .chars()
            .map(|c| match c {
                'a' => format!("({a})"),
                'b' => format!("({b})"),
                c => c.to_string(),
            })
            .collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn verdicts_are_those_of_every_value(
        pieces in proptest::collection::vec(piece(), 1..5),
        texts in proptest::collection::vec(requirement(), 3),
    ) {
        let program = assemble(INPUTS, &pieces.join("\n"));
        let mut few = found(&program, &texts);
        let [k, u] = ["k", "u"].map(|name| program.find(name).unwrap());
        prop_assert!(few.contains_key(&k) && few.contains_key(&u));
        // Every value of one and few of the other is enough to try.
        let reduced = answers(&program, few.clone(), &texts);
        few.remove(&k);
        prop_assert_eq!(reduced, answers(&program, few, &texts));
    }
}

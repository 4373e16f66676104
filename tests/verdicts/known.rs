//! What is known of random programs is told as it was found, and known of nothing else.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::logic::{
    Bound, Demand, Requirement, View, bind_fairness, bind_requirement, parse_fairness, parse_requirement,
};
use petril::semantics::{Role, VarId};
use petril::source::Source;
use petril::translate::System;
use petril::verdict::{Known, Options, Report, check, check_knowing, fingerprint};
use proptest::prelude::*;
use support::{random_formula, random_program};

/// Requirements that look back, or are about single runs, for the scan view.
const BACK: [&str; 6] = [
    "AG (rising(q0) -> i0)",
    "AG (m0 -> once(i1))",
    "AG !held(i0, 2 scans)",
    "EF (q0 & pre(q1))",
    "LTL G (i0 -> F q0)",
    "LTL G F m0 -> G F (q0 | q1)",
];

/// Which runs count.
const FAIR: &str = "if again and again i2 then again and again !i2";

/// Requirements on markings.
const STEPS: [&str; 6] = [
    "AG (at End -> (q0 -> i0))",
    "EF (q0 & q1)",
    "AG EF m0",
    "AF at End",
    "EX (m1 <-> m2)",
    "AG (at idle -> EF at End)",
];

fn requirement(name: &str, text: &str, system: &System, view: View) -> (Requirement, Demand) {
    let requirement = parse_requirement(name, &Source::new("r", text)).unwrap();
    let demand = bind_requirement(&requirement, system, view).unwrap();
    (requirement, demand)
}

/// Random formulas and some that look back, or some on markings.
fn requirements(system: &System, formulas: &[Bound], view: View) -> Vec<(Requirement, Demand)> {
    let asked = |name: &str, texts: &[&str]| -> Vec<(Requirement, Demand)> {
        texts.iter().enumerate().map(|(i, text)| requirement(&format!("{name}{i}"), text, system, view)).collect()
    };
    if view == View::Transition {
        return asked("s", &STEPS);
    }
    let random = formulas.iter().enumerate().map(|(i, formula)| {
        let (named, _) = requirement(&format!("f{i}"), "AG TRUE", system, view);
        (named, Demand::Formula(formula.clone()))
    });
    random.chain(asked("b", &BACK)).collect()
}

/// A report without what says that it is known.
fn told(mut report: Report) -> String {
    report.exploration.recalled = false;
    report.answers.iter_mut().chain(&mut report.checks).for_each(|answer| answer.recalled = false);
    format!("{report:#?}")
}

fn atoms() -> Vec<Bound> {
    (0..8).map(|variable| Bound::Variable(VarId(variable))).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, ..ProptestConfig::default() })]

    #[test]
    fn what_is_known_is_told_as_it_was_found(
        text in random_program::text(8),
        device in proptest::option::of(random_program::device()),
        formulas in proptest::collection::vec(random_formula::formula(atoms(), true), 4),
        first in 0..4_usize,
        transitions in any::<bool>(),
        fair in any::<bool>(),
    ) {
        let system = random_program::system(support::program(&text), device.as_ref());
        let view = if transitions { View::Transition } else { View::Scan };
        let assumed = parse_fairness(&Source::new("fairness", FAIR)).unwrap();
        let fairness = if fair { vec![bind_fairness(&assumed, &system, view).unwrap()] } else { vec![] };
        let options = Options { view, fairness, ..Options::default() };
        let all = requirements(&system, &formulas, view);
        let plain = told(check(&system, &all, &options, &mut |_| None));

        // Some first, then all, then all again.
        let (_, known) = check_knowing(&system, &all[..first], &options, None, &mut |_| None);
        let keep = |known: &Known| -> Known { serde_json::from_str(&serde_json::to_string(known).unwrap()).unwrap() };
        let known = keep(&known.unwrap());
        let (report, more) = check_knowing(&system, &all, &options, Some(&known), &mut |_| None);
        let is_disputed = plain.contains("error in Petril");
        prop_assert!(!is_disputed, "{}", plain);
        prop_assert_eq!(told(report), plain.clone());
        if let Some(more) = more {
            let mut searched = false;
            let (report, none) = check_knowing(&system, &all, &options, Some(&keep(&more)), &mut |_| {
                searched = true;
                None
            });
            // A run cannot show everything; what it does not show is found anew.
            let is_whole = report.answers.iter().all(|answer| answer.recalled);
            prop_assert_eq!(is_whole, !searched);
            prop_assert_eq!(is_whole, none.is_none());
            prop_assert_eq!(told(report), plain);
        }
    }

    /// Programs, devices, domains and options that differ have different fingerprints, and texts that differ in nothing but their layout
    /// the same.
    #[test]
    fn a_fingerprint_is_that_of_one_meaning(
        text in random_program::text(6),
        other in random_program::text(6),
        device in random_program::device(),
    ) {
        let of = |text: &str, options: &Options| fingerprint(&random_program::system(support::program(text), None), options);
        let options = Options::default();
        let print = of(&text, &options);
        prop_assert_eq!(&print, &of(&text.replace('\n', "\n\n  "), &options));
        let code = |text: &str| {
            let program = support::program(text);
            let code = program.code.iter().map(|line| format!("{:?}", line.instruction));
            let variables = program.variables.iter().map(|variable| format!("{} {}", variable.name, variable.initial));
            code.chain(variables).collect::<Vec<_>>()
        };
        prop_assert_eq!(code(&text) == code(&other), print == of(&other, &options));
        let with_device = random_program::system(support::program(&text), Some(&device));
        prop_assert_ne!(&print, &fingerprint(&with_device, &options));
        let mut system = random_program::system(support::program(&text), None);
        let input = system.program.with_role(Role::Input).next().unwrap();
        system.program.variables[input.0].initial ^= 1;
        prop_assert_ne!(&print, &fingerprint(&system, &options));
        let mut tolerant = options.clone();
        tolerant.tolerated.overflow = true;
        let mut short = options.clone();
        short.budget.states -= 1;
        let steps = Options { view: View::Transition, ..options };
        for options in [tolerant, short, steps] {
            prop_assert_ne!(&print, &of(&text, &options));
        }
    }
}

#[test]
fn what_a_watcher_ended_is_not_known() {
    let text = "PROGRAM p\nVAR_INPUT i0 : BOOL; END_VAR\nVAR_OUTPUT q0 : BOOL; END_VAR\nLD i0\nST q0\nEND_PROGRAM\n";
    let system = random_program::system(support::program(text), None);
    let asked = [requirement("r", "AG (q0 -> i0)", &system, View::Scan)];
    let (_, known) =
        check_knowing(&system, &asked, &Options::default(), None, &mut |_| Some("the time is up".to_owned()));
    assert!(known.is_none());
    let (report, known) = check_knowing(&system, &asked, &Options::default(), None, &mut |_| None);
    assert!(known.is_some() && !report.answers[0].recalled);
}

//! Nothing that is told on a part of the states is untrue of all of them: random programs, looked at as far as a limit or a watcher
//! allows, against the whole.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::explore::{Budget, Stop};
use petril::flat::Tolerated;
use petril::logic::{
    Assertion, Assumption, Bound, Demand, Origin, Requirement, View, bind_assumption, bind_fairness, bind_requirement,
    parse_fairness, parse_requirement, parse_requirements,
};
use petril::semantics::VarId;
use petril::source::Source;
use petril::translate::System;
use petril::verdict::{Answer, Options, Outcome, Report, Verdict, check};
use proptest::prelude::*;
use support::{formula, random_formula, random_program};

/// Requirements beside random ones: about the past, about runs, and some whose premise may never come.
const SCANS: [&str; 9] = [
    "AG (rising(q0) -> i0)",
    "AG (m0 -> once(i1))",
    "EF (q0 & pre(q1))",
    "LTL G (i0 -> F q0)",
    "LTL G F m0 -> G F (q0 | q1)",
    "LTL F (m1 & X q1)",
    "AG (q0 & m1 & !i1 -> AX (q1 -> AX q0))",
    "AG EF q0",
    "every_line_reachable()",
];

const FIRINGS: [&str; 5] =
    ["AG (at End -> (q0 -> i0))", "EF (q0 & q1)", "AG EF m0", "AF at End", "LTL G F at End -> G F (q0 | !q0)"];

const FAIR: [&str; 3] = ["again and again q0", "if again and again i2 then again and again !i2", "released(i0)"];

const ASSUMED: [&str; 3] = ["pre(q0) -> i1", "!(i0 & i1)", "i2 -> pre(m0)"];

fn requirement(text: &str, system: &System, view: View) -> (Requirement, Demand) {
    let requirement = parse_requirement("r", &Source::new("r", text)).unwrap_or_else(|e| panic!("{text}: {e:?}"));
    let demand = bind_requirement(&requirement, system, view).unwrap_or_else(|e| panic!("{text}: {e:?}"));
    (requirement, demand)
}

fn assumption(text: &str, system: &System) -> Assumption {
    let (file, errors) = parse_requirements(&Source::new("r", format!("assume: {text};")));
    assert!(errors.is_empty(), "{errors:?}");
    bind_assumption(&file.assumptions[0], system, View::Scan).unwrap_or_else(|e| panic!("{text}: {e:?}"))
}

/// The text with a counter before its first line, which overflows after some scans and sets `m0` two scans before.
fn counting(text: &str, from: i32) -> String {
    let (head, body) = text.split_once("l0: ").unwrap();
    format!("{head}VAR n : SINT := {from}; END_VAR\nLD n\nADD 1\nST n\nGE 126\nS m0\nl0: {body}")
}

/// What is told on a part and is not so of the whole.
fn untrue(part: &Report, whole: &Report) -> Vec<String> {
    let mut untrue = Vec::new();
    let told = |report: &Report| -> Vec<Answer> { report.answers.iter().chain(&report.checks).cloned().collect() };
    for (part, whole) in told(part).iter().zip(told(whole)) {
        let verdict = part.outcome.verdict();
        let differs = verdict != Verdict::Unknown && verdict != whole.outcome.verdict();
        let vacuity = |outcome: &Outcome| match outcome {
            Outcome::Holds { vacuous, .. } => vacuous.clone(),
            _ => None,
        };
        let is_vacuous = vacuity(&part.outcome).is_some() && vacuity(&part.outcome) != vacuity(&whole.outcome);
        if differs || is_vacuous || part.name != whole.name {
            untrue.push(format!("{}: {:?} of the part, {:?} of the whole", part.formula, part.outcome, whole.outcome));
        }
    }
    untrue.extend(part.remarks.iter().filter(|remark| !whole.remarks.contains(remark)).map(|it| format!("{it:?}")));
    if let (Some(part), Some(whole)) = (&part.coverage, &whole.coverage)
        && part.never_executed.is_some()
        && part.never_executed != whole.never_executed
    {
        untrue.push(format!("{:?} are never executed, of all {:?}", part.never_executed, whole.never_executed));
    }
    if part.exploration.complete && (part.exploration.stop != Stop::Complete || !whole.exploration.complete) {
        untrue.push("the exploration is complete".to_owned());
    }
    untrue
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, ..ProptestConfig::default() })]

    #[test]
    fn what_is_told_on_a_part_is_true_of_all(
        text in random_program::text(6),
        device in proptest::option::weighted(0.3, random_program::device()),
        count in proptest::option::of(118..127),
        formulas in proptest::collection::vec(random_formula::formula((0..8).map(|id| Bound::Variable(VarId(id))).collect(), true), 4),
        (fair, assumed) in (proptest::option::of(0..FAIR.len()), proptest::option::weighted(0.3, 0..ASSUMED.len())),
        asserted in proptest::option::of((any::<prop::sample::Index>(), prop::sample::select(vec!["q0 | !m1", "!(m0 & q1)", "i0 | m2 | !q0"]))),
        (transitions, wraps) in (prop::bool::weighted(0.2), any::<bool>()),
        limits in proptest::collection::vec(1..100_u64, 2),
        calls in proptest::collection::vec(0..12_usize, 2),
    ) {
        let text = match count {
            Some(from) if text.contains("l0: ") => counting(&text, from),
            _ => text,
        };
        let system = random_program::system(support::program(&text), device.as_ref());
        let view = if transitions { View::Transition } else { View::Scan };
        let texts: &[&str] = if transitions { &FIRINGS } else { &SCANS };
        let mut asked: Vec<_> = texts.iter().map(|text| requirement(text, &system, view)).collect();
        if !transitions {
            let named = asked[0].0.clone();
            asked.extend(formulas.into_iter().map(|formula| (named.clone(), Demand::Formula(formula))));
        }
        let fairness = fair.map(|fair| bind_fairness(&parse_fairness(&Source::new("f", FAIR[fair])).unwrap(), &system, view).unwrap());
        let lines = system.program.end();
        let assertion = asserted.filter(|_| lines > 0).map(|(at, said)| Assertion {
            name: "a".to_owned(),
            sentence: None,
            text: said.to_owned(),
            origin: Origin::default(),
            formula: formula(said, &system, view),
            lines: vec![at.index(lines)],
        });
        let options = Options {
            view,
            fairness: fairness.into_iter().collect(),
            tolerated: Tolerated { overflow: wraps, division_by_zero: false },
            assumptions: assumed.filter(|_| !transitions).map(|assumed| assumption(ASSUMED[assumed], &system)).into_iter().collect(),
            assertions: assertion.into_iter().collect(),
            ..Options::default()
        };
        let whole = check(&system, &asked, &options, &mut |_| None);
        let is_disputed = format!("{whole:?}").contains("error in Petril");
        prop_assert!(!is_disputed, "{}\n{:#?}", text, whole);
        for limit in limits {
            let budget = Budget { states: limit, ..Budget::default() };
            let part = check(&system, &asked, &Options { budget, ..options.clone() }, &mut |_| None);
            let untrue = untrue(&part, &whole);
            prop_assert!(untrue.is_empty(), "{} states\n{}\n{:#?}", limit, text, untrue);
        }
        for limit in calls {
            let mut calls = 0;
            let part = check(&system, &asked, &options, &mut |_| {
                calls += 1;
                (calls > limit).then(|| "the time is up".to_owned())
            });
            let untrue = untrue(&part, &whole);
            prop_assert!(untrue.is_empty(), "{} calls\n{}\n{:#?}", limit, text, untrue);
        }
    }
}

/// What comes after a scan that fails is not known, so neither is whether the assumptions leave inputs there. `n` is 0 in the scan
/// before, so that an assumption on what follows would leave none.
#[test]
fn what_fails_leaves_open_whether_assumptions_leave_inputs() {
    let text = "PROGRAM p VAR_INPUT i : BOOL; END_VAR VAR n : INT := 1; z : INT; END_VAR VAR_OUTPUT q : BOOL; END_VAR
LD i
ST q
LD z
ST n
LD 6
DIV n
END_PROGRAM";
    let system = random_program::system(support::program(text), None);
    let checked = |division_by_zero: bool| {
        let tolerated = Tolerated { overflow: true, division_by_zero };
        let assumptions = vec![assumption("pre(n) > 0", &system)];
        let report = check(&system, &[], &Options { tolerated, assumptions, ..Options::default() }, &mut |_| None);
        let told: Vec<_> =
            report.checks.iter().map(|check| (check.name.clone(), check.outcome.verdict().word())).collect();
        told
    };
    let told = |checks: &[(&str, &'static str)]| -> Vec<(String, &'static str)> {
        checks.iter().map(|&(name, word)| (name.to_owned(), word)).collect()
    };
    // Every first scan divides by 0. If that is no error, no second scan may begin.
    let fails = [("scan-ends", "holds"), ("division-by-zero", "violated"), ("assumptions", "unknown")];
    assert_eq!(checked(false), told(&fails));
    assert_eq!(checked(true), told(&[("scan-ends", "holds"), ("assumptions", "violated")]));
}

/// The check of assumptions by hand: they leave inputs, none for the first scan, or none that is known of yet.
#[test]
fn assumptions_are_checked() {
    let text = "PROGRAM p VAR_INPUT i : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR\nLD i\nST q\nEND_PROGRAM";
    let system = random_program::system(support::program(text), None);
    let checked = |assumed: &str, calls: usize| {
        let options = Options { assumptions: vec![assumption(assumed, &system)], ..Options::default() };
        let mut left = calls;
        let report = check(&system, &[], &options, &mut |_| {
            let is_over = left == 0;
            left = left.saturating_sub(1);
            is_over.then(|| "the time is up".to_owned())
        });
        let check = report.checks.iter().find(|check| check.name == "assumptions").unwrap();
        match &check.outcome {
            Outcome::Unknown(reason) => format!("unknown: {reason}"),
            outcome => outcome.verdict().word().to_owned(),
        }
    };
    assert_eq!(checked("!i", 100), "holds");
    assert_eq!(checked("pre(q) -> i", 100), "holds");
    let nothing = "unknown: the assumptions allow no inputs for the first scan, so nothing was explored";
    assert_eq!(checked("i & !i", 100), nothing);
    // Both first scans are found, and what comes after them is not.
    assert_eq!(checked("!pre(q)", 0), "unknown: the time is up; the states explored are no dead ends");
    assert_eq!(checked("!pre(q)", 100), "violated");
}

/// A state whose steps are not known is no end of a run: `q` is FALSE after the first scan, and TRUE after all others.
#[test]
fn a_state_that_was_not_expanded_is_no_end() {
    let text = "PROGRAM p VAR m : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR\nLD m\nST q\nLD TRUE\nST m\nEND_PROGRAM";
    let system = random_program::system(support::program(text), None);
    for (formula, whole) in [("EG !q", Verdict::Violated), ("AF q", Verdict::Holds), ("LTL F q", Verdict::Holds)] {
        let asked = [requirement(formula, &system, View::Scan)];
        let verdict = |limit: Option<&str>| {
            let report = check(&system, &asked, &Options::default(), &mut |_| limit.map(str::to_owned));
            report.answers[0].outcome.verdict()
        };
        assert_eq!(verdict(None), whole, "{formula}");
        assert_eq!(verdict(Some("the time is up")), Verdict::Unknown, "{formula}");
    }
}

/// After the first scan without `In` nothing is counted any more, and soon all of that is known; after one with it, 7 scans are needed.
#[test]
fn what_one_beginning_excludes_another_may_reach() {
    let text =
        "PROGRAM p VAR_INPUT In : BOOL; END_VAR VAR Started, On : BOOL; N : INT; END_VAR VAR_OUTPUT q : BOOL; END_VAR
        LD Started\nJMPC run\nLD In\nST On\nLD TRUE\nST Started
        run: LD On\nST q\nJMPCN done\nLD N\nADD 1\nMOD 8\nST N
        done: LD TRUE\nEND_PROGRAM";
    let system = System::new(support::program(text), petril::translate::Plant::default());
    let asked = [requirement("reachability(N = 7)", &system, View::Scan)];
    let verdict = |states: u64| {
        let options = Options { budget: Budget { states, ..Budget::default() }, ..Options::default() };
        check(&system, &asked, &options, &mut |_| None).answers[0].outcome.verdict()
    };
    assert_eq!(verdict(100), Verdict::Holds);
    for states in 1..8 {
        assert_eq!(verdict(states), Verdict::Unknown, "{states} states");
    }
}

//! Fairness assumptions, from text to verdict, worked out by hand.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::explore::Budget;
use petril::flat::Tolerated;
use petril::logic::{
    Bound, FairnessAssumption, View, always_scanning, bind_fairness, bind_requirement, parse_fairness,
    parse_requirement,
};
use petril::semantics::VarId;
use petril::source::Source;
use petril::translate::System;
use petril::verdict::{Independence, Options, Outcome, Report, Trace, Verdict, check};
use proptest::prelude::*;
use support::systems::system;
use support::{random_formula, random_program};

/// A latch: `on` sets q, `off` resets it.
const LATCH: &str = "PROGRAM latch
VAR_INPUT on, off : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR
LD on
OR q
ANDN off
ST q
END_PROGRAM";

/// Two buttons.
const BUTTONS: &str = "net buttons
pl {on=0} (1)
pl {on=1}
tr press {on=0} -> {on=1}
tr let_go {on=1} -> {on=0}
pl {off=0} (1)
pl {off=1}
tr stop {off=0} -> {off=1}
tr unstop {off=1} -> {off=0}
";

fn assumed(system: &System, view: View, texts: &[&str]) -> Vec<FairnessAssumption> {
    let read =
        |text: &&str| parse_fairness(&Source::new("fairness", *text)).unwrap_or_else(|e| panic!("{text}: {e:?}"));
    texts
        .iter()
        .map(|text| bind_fairness(&read(text), system, view).unwrap_or_else(|e| panic!("{text}: {e:?}")))
        .collect()
}

fn judged(system: &System, view: View, fairness: &[FairnessAssumption], formula: &str) -> Report {
    let requirement = parse_requirement("r", &Source::new("formula", formula)).unwrap();
    let demand = bind_requirement(&requirement, system, view).unwrap_or_else(|e| panic!("{formula}: {e:?}"));
    let options = Options { view, fairness: fairness.to_vec(), ..Options::default() };
    check(system, &[(requirement, demand)], &options, &mut |_| None)
}

fn outcome(program: &str, plants: &[&str], fairness: &[&str], formula: &str) -> Outcome {
    let system = system(program, plants);
    let fairness = assumed(&system, View::Scan, fairness);
    judged(&system, View::Scan, &fairness, formula).answers[0].outcome.clone()
}

fn verdict(program: &str, plants: &[&str], fairness: &[&str], formula: &str) -> Verdict {
    outcome(program, plants, fairness, formula).verdict()
}

#[test]
fn what_must_come_in_the_end_needs_an_assumption() {
    for formula in ["AG (q -> AF !q)", "LTL G (q -> F !q)"] {
        let verdict = |fairness: &[&str]| verdict(LATCH, &[], fairness, formula);
        assert_eq!(verdict(&[]), Verdict::Violated);
        assert_eq!(verdict(&["again and again off"]), Verdict::Holds);
        assert_eq!(verdict(&["pressed(off)"]), Verdict::Holds);
        assert_eq!(verdict(&["pressed(on, off)"]), Verdict::Holds);
        assert_eq!(verdict(&["released(off)"]), Verdict::Violated);
        assert_eq!(verdict(&["released(on)"]), Verdict::Violated);
        // Whoever sees the light again and again switches it off again and again.
        assert_eq!(verdict(&["if again and again q then again and again off"]), Verdict::Holds);
        // Whoever presses `on` again and again does; but one may press once.
        assert_eq!(verdict(&["if again and again on then again and again off"]), Verdict::Violated);
        assert_eq!(verdict(&["if again and again on then again and again off", "pressed(on)"]), Verdict::Holds);
    }
}

/// What comes again and again may look back, and the loop must close in what is remembered.
#[test]
fn edges_may_come_again_and_again() {
    for formula in ["AG (q -> AF !q)", "AG (rising(q) -> AF !q)", "LTL G (rising(q) -> F falling(q))"] {
        let verdict = |fairness: &[&str]| verdict(LATCH, &[], fairness, formula);
        assert_eq!(verdict(&["again and again rising(off)"]), Verdict::Holds, "{formula}");
        assert_eq!(verdict(&["again and again falling(on)"]), Verdict::Violated, "{formula}");
        assert_eq!(
            verdict(&["if again and again rising(on) then again and again off"]),
            Verdict::Violated,
            "{formula}"
        );
    }
}

#[test]
fn a_lasso_meets_every_assumption_in_its_loop() {
    let Outcome::Violated(witness, _) = outcome(LATCH, &[], &["released(on)", "pressed(on)"], "AG (q -> AF !q)") else {
        panic!("it is violated");
    };
    let Trace::Scans(trace) = witness.trace else { panic!("it is a run of scans") };
    let start = trace.loop_start.unwrap();
    let on: Vec<u64> = trace.scans[start + 1..].iter().map(|scan| scan.inputs[0].1).collect();
    assert!(on.contains(&0) && on.contains(&1), "{on:?}");
    assert_eq!(trace.scans.len(), 3, "two scans, of which the first comes again");
}

/// Pressing `on` and `off` by turns keeps the promise and never presses both.
#[test]
fn promises_are_kept_in_the_loop() {
    let promise = "if again and again on then again and again off";
    for formula in ["AF (on & off)", "LTL F (on & off)"] {
        let Outcome::Violated(witness, _) = outcome(LATCH, &[], &[promise, "pressed(on)"], formula) else {
            panic!("{formula}");
        };
        let Trace::Scans(trace) = witness.trace else { panic!("{formula}") };
        let behind = &trace.scans[trace.loop_start.unwrap() + 1..];
        let mut inputs: Vec<[u64; 2]> = behind.iter().map(|scan| [scan.inputs[0].1, scan.inputs[1].1]).collect();
        inputs.sort_unstable();
        assert_eq!(inputs, [[0, 1], [1, 0]], "{formula}");
        // Without `on` nothing is promised: the shortest loop is a scan that comes again.
        let Outcome::Violated(witness, _) = outcome(LATCH, &[], &[promise], formula) else { panic!("{formula}") };
        let Trace::Scans(trace) = witness.trace else { panic!("{formula}") };
        assert_eq!((trace.scans.len(), trace.loop_start), (2, Some(0)), "{formula}");
    }
}

/// A plant that turns on one of two inputs for ever, once the first scan is over.
#[test]
fn assumptions_that_exclude_each_other_are_named_if_they_are_one() {
    let program =
        "PROGRAM p VAR_INPUT on, off : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR\nLD TRUE\nST q\nEND_PROGRAM";
    let either = "net either
pl {on=0} (1)
pl {on=1}
pl {off=0} (1)
pl {off=1}
pl free (1)
tr a {on=0} free {q=1}?1 -> {on=1}
tr b {off=0} free {q=1}?1 -> {off=1}
";
    let reason = |fairness: &[&str]| match outcome(program, &[either], fairness, "AG q") {
        Outcome::Unknown(reason) => reason,
        other => panic!("{fairness:?}: {other:?}"),
    };
    for possible in [["pressed(on)", "released(off)"], ["pressed(off)", "released(on)"]] {
        assert_eq!(verdict(program, &[either], &possible, "AG q"), Verdict::Holds);
    }
    let named = reason(&["pressed(on, off)"]);
    assert!(named.starts_with("no run meets the fairness assumption that ") && named.contains("on, off"), "{named}");
    assert_eq!(reason(&["pressed(on)", "pressed(off)"]), "no run meets the fairness assumptions");
    assert_eq!(reason(&["released(on, off)", "pressed(on)", "pressed(off)"]), "no run meets the fairness assumptions");
}

/// What holds of inputs alone tests the plant, unless it holds because of what was assumed.
#[test]
fn what_an_assumption_makes_true_is_not_independent_of_it() {
    let system = system(LATCH, &[]);
    let independent = |fairness: &[&str], formula: &str| {
        let fairness = assumed(&system, View::Scan, fairness);
        let answer = judged(&system, View::Scan, &fairness, formula).answers.swap_remove(0);
        assert_eq!(answer.outcome.verdict(), Verdict::Holds, "{formula}");
        answer.independent
    };
    let again = ["again and again off"];
    assert_eq!(independent(&[], "AG EX on"), Some(Independence::OfTheProgram));
    assert_eq!(independent(&again, "AG EX on"), None);
    assert_eq!(independent(&again, "AF off"), None);
    assert_eq!(independent(&[], "AG (q | !q)"), Some(Independence::OfEverything));
    assert_eq!(independent(&again, "AG (q | !q)"), Some(Independence::OfEverything));
    assert_eq!(independent(&again, "AG (q -> !off)"), None);
}

#[test]
fn nothing_holds_only_because_no_run_counts() {
    let reason = |fairness: &[&str], formula: &str| match outcome(LATCH, &[], fairness, formula) {
        Outcome::Unknown(reason) => reason,
        other => panic!("{fairness:?}, {formula}: {other:?}"),
    };
    for formula in ["AG q", "EF q", "AF q", "LTL G q", "!EF q"] {
        assert_eq!(
            reason(&["again and again on & !on"], formula),
            "no run meets the fairness assumption that `on & !on` is true again and again"
        );
        let several = ["again and again q", "if again and again q then again and again q & !q", "released(on)"];
        assert_eq!(reason(&several, formula), "no run meets the fairness assumptions");
    }
    // A latch that cannot be reset: no run counts that begins with setting it.
    let stuck = "PROGRAM p VAR_INPUT on : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR
LD on
OR q
ST q
END_PROGRAM";
    let begun = |formula| match outcome(stuck, &[], &["again and again !q"], formula) {
        Outcome::Unknown(reason) => reason,
        other => panic!("{formula}: {other:?}"),
    };
    let expected = "no run that begins with some of the first scans meets the fairness assumption that `!q` is true again and again";
    assert_eq!(begun("AG !q"), expected);
    assert_eq!(begun("LTL G !q"), expected);
    // A run that counts breaks this one.
    assert_eq!(verdict(stuck, &[], &["again and again !q"], "AF q"), Verdict::Violated);
}

#[test]
fn what_no_run_that_counts_goes_through_is_told() {
    let text = "PROGRAM p VAR_INPUT on : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR VAR first : BOOL := TRUE; END_VAR
LD on
ANDN first
OR q
ST q
LD FALSE
ST first
END_PROGRAM";
    // After the first scan q is FALSE, with `on` or without; then there is one more state with q and `on`, and one without `on`.
    let system = system(text, &[]);
    let report = judged(&system, View::Scan, &assumed(&system, View::Scan, &["again and again !q"]), "AG !q");
    assert_eq!(report.answers[0].outcome.verdict(), Verdict::Holds);
    assert_eq!(
        report.assumptions[2..],
        [
            "`!q` is true again and again",
            "runs through 2 of the 4 states are left out: from there no run meets the fairness assumptions"
        ]
    );
}

#[test]
fn a_plant_that_does_not_stand_still() {
    let verdict = |fairness: &[&str], formula: &str| verdict(LATCH, &[BUTTONS], fairness, formula);
    assert_eq!(verdict(&[], "AF on"), Verdict::Violated);
    assert_eq!(verdict(&["plant"], "AF on"), Verdict::Holds);
    assert_eq!(verdict(&["plant"], "AG (q -> AF !q)"), Verdict::Holds);
    assert_eq!(verdict(&["plant"], "LTL G F on & G F !on & G F off & G F !off"), Verdict::Holds);
    assert_eq!(verdict(&["plant"], "AF q"), Verdict::Violated, "both may always be pressed together");
}

/// A device is unable to move where an output keeps it from moving.
#[test]
fn a_plant_may_wait_for_the_program() {
    let program = "PROGRAM p VAR_INPUT up, go : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR
LD go
ST q
END_PROGRAM";
    let lift = "net lift
pl {up=0} (1)
pl {up=1}
tr rise {up=0} {q=1}?1 -> {up=1}
";
    let verdict = |fairness: &[&str], formula: &str| verdict(program, &[lift], fairness, formula);
    assert_eq!(verdict(&["plant"], "AF up"), Verdict::Violated, "q may be off again and again");
    assert_eq!(verdict(&["plant", "again and again q"], "AF up"), Verdict::Violated);
    assert_eq!(verdict(&["plant"], "AG A [q W !q | up]"), Verdict::Holds);
    // Standing still while q stays on is what is left out.
    assert_eq!(verdict(&[], "!EG (q & !up)"), Verdict::Violated);
    assert_eq!(verdict(&["plant"], "!EG (q & !up)"), Verdict::Holds);
}

/// A transition that changes nothing is no move, so a device with no other one does not move.
#[test]
fn a_loop_of_a_plant_is_no_move() {
    let device = "net device
pl {on=0} (1)
tr stay {on=0} -> {on=0}
";
    let system = system(LATCH, &[device]);
    let text = parse_fairness(&Source::new("fairness", "plant")).unwrap();
    let errors = bind_fairness(&text, &system, View::Scan).unwrap_err();
    assert_eq!(errors[0].message, "there is no plant that moves");
}

/// In the transition view, the run on which the plant moves for ever and the PLC never scans again is left out by what
/// `--fair` assumes, which is one assumption among others.
#[test]
fn the_transition_view_has_the_same_assumptions() {
    let system = system(LATCH, &[BUTTONS]);
    let view = View::Transition;
    let verdict = |fairness: &[FairnessAssumption], formula: &str| {
        judged(&system, view, fairness, formula).answers[0].outcome.verdict()
    };
    let scanning = vec![always_scanning(&system)];
    assert_eq!(verdict(&[], "AF at End"), Verdict::Violated);
    assert_eq!(verdict(&scanning, "AF at End"), Verdict::Holds);
    assert_eq!(verdict(&scanning, "LTL G F at End"), Verdict::Holds);
    let plant = assumed(&system, view, &["plant"]);
    assert_eq!(verdict(&plant, "AF marked(\"buttons.on=1\")"), Verdict::Holds);
    assert_eq!(verdict(&plant, "AF at End"), Verdict::Holds, "the program must see it move");
    let off = assumed(&system, view, &["pressed(off)"]);
    assert_eq!(
        verdict(&off, "AG (q -> AF !q)"),
        Verdict::Holds,
        "a PLC that stands still for ever does not read `off`"
    );
    assert_eq!(verdict(&plant, "AG (q -> AF !q)"), Verdict::Holds);
}

/// Two scans are all there are: in the third a number does not fit its type. So no run is known on which q comes again and again,
/// and what holds on all runs that count holds on none.
#[test]
fn nothing_holds_on_a_part_of_the_states_before_a_run_that_counts_is_known() {
    let text = "PROGRAM p VAR n : SINT := 126; END_VAR VAR_OUTPUT q : BOOL; END_VAR
LD n
ADD 1
ST n
LD FALSE
ST q
END_PROGRAM";
    let system = system(text, &[]);
    let fairness = assumed(&system, View::Scan, &["again and again q"]);
    let verdict = |formula: &str, states: u64, overflow: bool| {
        let requirement = parse_requirement("r", &Source::new("formula", formula)).unwrap();
        let demand = bind_requirement(&requirement, &system, View::Scan).unwrap();
        let tolerated = Tolerated { overflow, ..Tolerated::default() };
        let budget = Budget { states, ..Budget::default() };
        let options = Options { fairness: fairness.clone(), tolerated, budget, ..Options::default() };
        check(&system, &[(requirement, demand)], &options, &mut |_| None).answers[0].outcome.verdict()
    };
    for formula in ["LTL X !q", "LTL !q", "LTL TRUE", "AX !q", "!q", "TRUE", "!EX q"] {
        assert_eq!(verdict(formula, 3, true), Verdict::Unknown, "{formula}, on three states");
        assert_eq!(verdict(formula, u64::MAX, false), Verdict::Unknown, "{formula}, before an error");
        assert_eq!(verdict(formula, u64::MAX, true), Verdict::Unknown, "{formula}, on all states");
    }
}

/// Formulas of CTL and of LTL over the variables of random programs.
fn formula() -> impl Strategy<Value = Bound> {
    let atoms = || (0..8).map(|v| Bound::Variable(VarId(v))).collect::<Vec<Bound>>();
    let path = random_formula::path(atoms()).prop_map(|path| Bound::Ltl(Box::new(path)));
    prop_oneof![random_formula::formula(atoms(), true), path]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Whatever the search finds, the replay on the net agrees with, constraint by constraint.
    #[test]
    fn the_replay_never_refutes_the_search(
        text in random_program::text(5),
        device in proptest::option::of(random_program::device()),
        formulas in proptest::collection::vec(formula(), 4),
        fairness in proptest::sample::subsequence(
            vec![
                "released(i0)",
                "pressed(i1)",
                "again and again rising(i2)",
                "if again and again q0 then again and again !q1",
                "if again and again m0 then again and again pre(q0) & i2",
                "plant",
            ],
            0..4,
        ),
    ) {
        let system = random_program::system(support::program(&text), device.as_ref());
        let read = |text: &&str| parse_fairness(&Source::new("fairness", *text)).unwrap();
        let fairness: Vec<_> =
            fairness.iter().filter_map(|text| bind_fairness(&read(text), &system, View::Scan).ok()).collect();
        let requirement = parse_requirement("r", &Source::new("formula", "TRUE")).unwrap();
        let asked: Vec<_> = formulas.into_iter().map(|formula| (requirement.clone(), formula.into())).collect();
        let options = Options { fairness, ..Options::default() };
        for answer in check(&system, &asked, &options, &mut |_| None).answers {
            if let Outcome::Unknown(reason) = answer.outcome {
                prop_assert!(!reason.contains("refutes"), "{}", reason);
            }
        }
    }
}

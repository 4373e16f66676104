//! What a requirement that holds says of a program: whether its premises occur, an example of that, and whether it depends on the
//! program at all; and what of the program was executed and asked about.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::explore::{Budget, Graph, ScanSpace, explore};
use petril::logic::{Bound, Dag, Quantifier, Requirement, ScanValuation, label, parse_requirement, premises};
use petril::semantics::VarId;
use petril::source::Source;
use petril::translate::System;
use petril::verdict::{Coverage, Independence, Options, Outcome, Trace, Vacuity, Witness, check};
use petril::witness::ScanTrace;
use proptest::prelude::*;
use support::reports::{answer, report, values};
use support::systems::{HANDS, TWO_HAND_SWITCH, system};
use support::{random_formula, random_program};

/// `t` is TRUE at the ends of scans 1, 3, 5, …; `late` from scan 2 on.
const CLOCK: &str =
    "PROGRAM clock VAR_INPUT a : BOOL; END_VAR VAR_OUTPUT t, late, spare : BOOL; END_VAR VAR m : BOOL; END_VAR
    LD m\nST late\nLD TRUE\nST m\nLDN t\nST t\nEND_PROGRAM";

/// What is known of the one requirement, which holds: the vacuity, and the example.
fn holding(system: &System, formula: &str) -> (Option<Vacuity>, Option<Witness>) {
    let report = report(system, &format!("requirement r: {formula};"));
    match answer(&report, "r").outcome.clone() {
        Outcome::Holds { vacuous, example, .. } => (vacuous, example),
        other => panic!("{formula}: {other:?}"),
    }
}

fn scans(witness: &Witness) -> &ScanTrace {
    match &witness.trace {
        Trace::Scans(trace) => trace,
        Trace::Firings(_) => panic!("it is told in firings"),
    }
}

/// An example as the values of some variables after each scan, and what is said of it.
fn example(system: &System, formula: &str, names: &[&str]) -> (Vec<String>, Vec<String>) {
    let (vacuous, example) = holding(system, formula);
    assert_eq!(vacuous, None, "{formula}");
    let example = example.unwrap_or_else(|| panic!("{formula} has an example"));
    let notes = example.notes.iter().map(|note| note.sentence(petril::logic::View::Scan)).collect();
    (values(system, scans(&example), names), notes)
}

#[test]
fn an_example_goes_through_every_premise() {
    let starter = system(include_str!("../../examples/latching-starter.il"), &[]);
    let (run, notes) = example(&starter, "AG (Motor -> AX (Stop & Overload -> Motor))", &["Motor", "Stop", "Overload"]);
    assert_eq!(run, ["111", "111"]);
    assert_eq!(notes, ["after scan 1: `Motor` is true", "after scan 2: `Stop & Overload` is true"]);
    let (run, _) = example(&starter, "AG (Start & Stop & Overload -> Motor)", &["Motor"]);
    assert_eq!(run, ["1"]);
    // The conclusion is reached, too.
    let clock = system(CLOCK, &[]);
    let (run, notes) = example(&clock, "AG (late -> AF t)", &["late", "t"]);
    assert_eq!(run, ["01", "10", "11"]);
    assert_eq!(notes, ["after scan 2: `late` is true", "after scan 3: `t` is true"]);
    let (run, _) = example(&clock, "AG (t -> AX !t)", &["t"]);
    assert_eq!(run, ["1", "0"]);
    // Before the end of a wait.
    let (run, _) = example(&clock, "A [(t -> !late) W late]", &["t", "late"]);
    assert_eq!(run, ["10"]);
}

#[test]
fn a_premise_that_comes_at_the_wrong_time() {
    let clock = system(CLOCK, &[]);
    let vacuous = |formula| holding(&clock, formula).0;
    assert_eq!(vacuous("AG (t & late & !t -> FALSE)"), Some(Vacuity::Nowhere("t & late & !t".to_owned())));
    assert_eq!(vacuous("AG (t -> AX (t -> spare))"), Some(Vacuity::NotThere("t".to_owned())));
    assert_eq!(vacuous("AG (t -> AX AX (t -> late))"), None);
    assert_eq!(vacuous("late -> spare"), Some(Vacuity::NotThere("late".to_owned())), "in the first scan");
    assert_eq!(vacuous("A [(late -> spare) W late]"), Some(Vacuity::NotThere("late".to_owned())), "before it");
    assert_eq!(vacuous("AG (t -> t) & AG (late -> AX (!late -> t))"), Some(Vacuity::NotThere("!late".to_owned())));
    assert!(holding(&clock, "AG (t -> AX (t -> spare))").1.is_none(), "there is nothing to show");
}

#[test]
fn what_holds_whatever_the_program_does() {
    let hands = system(TWO_HAND_SWITCH, &[HANDS]);
    let independent = |system: &System, formula: &str| {
        let report = report(system, &format!("requirement r: {formula};"));
        answer(&report, "r").independent
    };
    assert_eq!(independent(&hands, "AG (S1 + O1 = 1)"), Some(Independence::OfTheProgram));
    assert_eq!(independent(&hands, "AG (Output | !Output)"), Some(Independence::OfEverything));
    assert_eq!(independent(&hands, "AG ((Output -> S1) | Output)"), Some(Independence::OfEverything));
    assert_eq!(independent(&hands, "AG (Output -> S1 & S2)"), None);
    assert_eq!(independent(&hands, "AG S1"), None, "it does not hold");
    // These contactors do what the program says.
    let plant = include_str!("../../nets/reversing-motor.net");
    let motor = system(include_str!("../../examples/reversing-motor.il"), &[plant]);
    assert_eq!(independent(&motor, "AG !(Closed_F & Closed_R)"), None);
}

#[test]
fn coverage_counts_lines_and_what_is_asked() {
    let text = "PROGRAM p VAR_INPUT a, b : BOOL; END_VAR VAR_OUTPUT q, r, s : BOOL; END_VAR
        LD a\nANDN a\nJMPC never\nLD a\nST q\nJMP done\nnever: LD TRUE\nST r\ndone:\nEND_PROGRAM";
    let system = system(text, &[]);
    let report = report(&system, "requirement x: AG (q -> a);");
    let id = |name| system.program.find(name).unwrap();
    let expected = Coverage {
        lines: 8,
        never_executed: Some(vec![6, 7]),
        never_read: vec![id("b")],
        never_written: vec![id("s")],
        unasked: vec![id("r"), id("s")],
    };
    assert_eq!(report.coverage, Some(expected));
}

#[test]
fn what_is_assumed_of_plants_and_timers_is_told() {
    let text = "PROGRAM p VAR_INPUT a, b : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR\nLD a\nAND b\nST q\nEND_PROGRAM";
    // A device that gives a value, one that gives none, and one that neither gives a value nor moves.
    let plant = "net n
pl {a=0} (1)
pl {a=1}
tr press {a=0} -> {a=1}
pl dark (1)
pl light
pl gone
tr shine dark {q=1}?1 -> light
tr back gone -> dark
pl still (1)
";
    let cold = "the PLC starts cold: every variable has its initial value";
    let moves = "moves any number of times between two scans, or not at all";
    let told = report(&system(text, &[plant]), "requirement x: AG (q -> a);").assumptions;
    let expected = [
        cold.to_owned(),
        format!("`n.1` gives a its value and {moves}"),
        format!("`n.2` {moves}"),
        "`n.back` never fires: nothing enables it".to_owned(),
        "b may have any value in any scan".to_owned(),
    ];
    assert_eq!(told, expected);

    let timed = |preset: &str| {
        let text = format!(
            "PROGRAM p VAR_INPUT a : BOOL; END_VAR VAR t : TON; d, e : TIME := T#100ms; END_VAR VAR_OUTPUT q : BOOL; END_VAR
             {preset}\nST d\nCAL t(IN := a, PT := d)\nLD t.Q\nST q\nEND_PROGRAM"
        );
        report(&system(&text, &[]), "requirement x: AG (q -> a);").assumptions
    };
    let any = "a may have any value in any scan";
    let clock = "a scan begins every 20 ms; during a scan the clock stands still";
    let preset = "a timer's preset time does not grow while the timer runs and is not called";
    assert_eq!(timed("LD T#200ms"), [cold, any, clock]);
    assert_eq!(timed("LD T#300ms\nSUB e")[..2], [cold, any]);
    assert!(timed("LD T#300ms\nSUB e").ends_with(&[clock.to_owned(), preset.to_owned()]));
}

/// The formula with something else for the conclusion of this implication.
fn with_conclusion(formula: &Bound, premise: &Bound, conclusion: &Bound) -> Bound {
    let of = |f: &Bound| Box::new(with_conclusion(f, premise, conclusion));
    match formula {
        Bound::Implies(f, _) if std::ptr::eq(&raw const **f, premise) => {
            Bound::Implies(f.clone(), Box::new(conclusion.clone()))
        }
        Bound::Implies(f, g) => Bound::Implies(f.clone(), of(g)),
        Bound::And(f, g) => Bound::And(of(f), of(g)),
        Bound::Next(quantifier, f) => Bound::Next(*quantifier, of(f)),
        Bound::Until { quantifier, weak, hold, release } => {
            Bound::Until { quantifier: *quantifier, weak: *weak, hold: of(hold), release: of(release) }
        }
        other => other.clone(),
    }
}

/// Whether a formula holds in every initial state, and in one of them.
fn truth(space: &ScanSpace<'_>, graph: &Graph, formula: &Bound) -> (bool, bool) {
    let mut dag = Dag::default();
    let node = dag.add(formula, false);
    let holds = |f: &Bound, id: u32| f.holds_in(&ScanValuation(space, graph.state(id))).unwrap();
    let labels = label(graph, &dag, &holds, None);
    let mut initial = graph.initial().iter().map(|&state| labels.of(node).contains(state as usize));
    (initial.clone().all(|holds| holds), initial.any(|holds| holds))
}

/// Implications within each other and under operators of time.
fn formula() -> impl Strategy<Value = Bound> {
    let variable = || (0..8_usize).prop_map(|v| Bound::Variable(VarId(v)));
    let atom = || prop_oneof![variable(), variable().prop_map(|f| Bound::Not(Box::new(f)))];
    let both = (atom(), atom()).prop_map(|(f, g)| Bound::And(Box::new(f), Box::new(g)));
    let premise = prop_oneof![1 => atom(), 1 => both];
    atom().prop_recursive(4, 12, 2, move |inner| {
        let quantifier = || prop_oneof![3 => Just(Quantifier::All), 1 => Just(Quantifier::Some)];
        let pair = || (inner.clone().prop_map(Box::new), inner.clone().prop_map(Box::new));
        let until = (quantifier(), any::<bool>(), pair())
            .prop_map(|(quantifier, weak, (hold, release))| Bound::Until { quantifier, weak, hold, release });
        let globally = (quantifier(), inner.clone()).prop_map(|(quantifier, f)| {
            let (hold, release) = (Box::new(f), Box::new(Bound::Truth(false)));
            Bound::Until { quantifier, weak: true, hold, release }
        });
        prop_oneof![
            4 => (premise.clone(), inner.clone()).prop_map(|(f, g)| Bound::Implies(Box::new(f), Box::new(g))),
            2 => (quantifier(), inner.clone()).prop_map(|(quantifier, f)| Bound::Next(quantifier, Box::new(f))),
            3 => globally,
            1 => until,
            1 => pair().prop_map(|(f, g)| Bound::And(f, g)),
        ]
    })
}

fn requirement() -> Requirement {
    parse_requirement("r", &Source::new("r", "TRUE")).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    /// Where no way leads to a premise, nothing depends on what follows from it.
    #[test]
    fn what_follows_from_a_premise_that_never_comes_makes_no_difference(
        text in random_program::text(5),
        device in proptest::option::of(random_program::device()),
        formula in prop_oneof![3 => formula(), 1 => random_formula::formula((0..8).map(|v| Bound::Variable(VarId(v))).collect(), true)],
    ) {
        let system = random_program::system(support::program(&text), device.as_ref());
        let space = ScanSpace::new(&system);
        let graph = explore(&space, Budget::default(), &mut |_| None);
        if graph.is_complete() {
            let own = truth(&space, &graph, &formula);
            let mut never = None;
            for premise in premises(&formula) {
                if !truth(&space, &graph, &premise.rests()[0]).1 {
                    never = never.or(Some(premise.formula.text(&system)));
                    for other in [Bound::Truth(false), Bound::Truth(true), Bound::Not(Box::new(premise.conclusion.clone()))] {
                        let changed = with_conclusion(&formula, premise.formula, &other);
                        prop_assert_eq!(truth(&space, &graph, &changed), own, "{}", changed.text(&system));
                    }
                }
            }
            // The report says the same, and shows an example of all others.
            let report = check(&system, &[(requirement(), formula.clone().into())], &Options::default(), &mut |_| None);
            if let Outcome::Holds { vacuous, example, .. } = &report.answers[0].outcome {
                prop_assert!(own.0);
                prop_assert_eq!(vacuous.as_ref().map(|vacuity| vacuity.premise().to_owned()), never.clone());
                prop_assert_eq!(example.is_some(), never.is_none() && !premises(&formula).is_empty());
            } else {
                prop_assert!(!own.0, "{:?}", report.answers[0].outcome);
            }
        }
    }
}

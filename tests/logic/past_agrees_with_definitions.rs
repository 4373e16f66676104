//! What formulas say of earlier scans, and what assumptions leave out: random programs are run on all inputs for some scans, and the
//! formulas are evaluated on these runs by their definitions. The shortest run that breaks `AG f` must be as long as the one shown.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::flat::FlatProgram;
use petril::interpret::Machine;
use petril::logic::{View, bind_assumption, bind_requirement, parse_requirements};
use petril::semantics::{Role, VarId};
use petril::source::Source;
use petril::translate::{Plant, System};
use petril::verdict::{Options, Outcome, Trace, check};
use proptest::prelude::*;
use support::random_program;

const NAMES: [&str; 8] = ["i0", "i1", "i2", "m0", "m1", "m2", "q0", "q1"];

/// Runs are this long at most.
const SCANS: usize = 3;

#[derive(Clone, Debug)]
enum F {
    Atom(usize),
    First,
    Not(Box<F>),
    And(Box<F>, Box<F>),
    Or(Box<F>, Box<F>),
    Equal(Box<F>, Box<F>),
    Pre(Box<F>),
    Rising(Box<F>),
    Falling(Box<F>),
    Changed(Box<F>),
    Once(Box<F>),
    SoFar(Box<F>),
    Since(Box<F>, Box<F>),
    Held(Box<F>, usize),
    HeldForNoTime(Box<F>),
    WithinNone(Box<F>),
}

impl F {
    fn text(&self) -> String {
        match self {
            F::Atom(i) => NAMES[*i].to_owned(),
            F::First => "at first scan".to_owned(),
            F::Not(f) => format!("!({})", f.text()),
            F::And(f, g) => format!("({} & {})", f.text(), g.text()),
            F::Or(f, g) => format!("({} | {})", f.text(), g.text()),
            F::Equal(f, g) => format!("(({}) + 1 = 1 + ({}))", f.text(), g.text()),
            F::Pre(f) => format!("pre({})", f.text()),
            F::Rising(f) => format!("rising({})", f.text()),
            F::Falling(f) => format!("falling({})", f.text()),
            F::Changed(f) => format!("changed({})", f.text()),
            F::Once(f) => format!("once({})", f.text()),
            F::SoFar(f) => format!("so_far({})", f.text()),
            F::Since(f, g) => format!("({} since {})", f.text(), g.text()),
            F::Held(f, n) => format!("held({}, {n} scans)", f.text()),
            F::HeldForNoTime(f) => format!("held({}, T#0ms)", f.text()),
            F::WithinNone(f) => format!("({} within 0 scans)", f.text()),
        }
    }

    /// Whether it holds at a position of a run; position 0 is power-on.
    fn at(&self, run: &[Vec<bool>], at: usize) -> bool {
        let before = |f: &F| f.at(run, at.saturating_sub(1));
        match self {
            F::Atom(i) => run[at][*i],
            F::First => at == 1,
            F::Not(f) => !f.at(run, at),
            F::And(f, g) => f.at(run, at) && g.at(run, at),
            F::Or(f, g) => f.at(run, at) || g.at(run, at),
            F::Equal(f, g) => f.at(run, at) == g.at(run, at),
            F::Pre(f) => before(f),
            F::Rising(f) => f.at(run, at) && !before(f),
            F::Falling(f) => !f.at(run, at) && before(f),
            F::Changed(f) => f.at(run, at) != before(f),
            F::Once(f) => (1..=at).any(|i| f.at(run, i)),
            F::SoFar(f) => (1..=at).all(|i| f.at(run, i)),
            F::Since(f, g) => (1..=at).any(|i| g.at(run, i) && (i + 1..=at).all(|j| f.at(run, j))),
            F::HeldForNoTime(f) => at > 0 && f.at(run, at),
            F::WithinNone(f) => f.at(run, at),
            F::Held(f, n) => at > *n && (at - n..=at).all(|i| f.at(run, i)),
        }
    }
}

fn formula(depth: u32) -> impl Strategy<Value = F> {
    let leaf = prop_oneof![8 => (0..NAMES.len()).prop_map(F::Atom), 1 => Just(F::First)];
    leaf.prop_recursive(depth, 12, 2, |inner| {
        let one = || inner.clone().prop_map(Box::new);
        prop_oneof![
            one().prop_map(F::Not),
            (one(), one()).prop_map(|(f, g)| F::And(f, g)),
            (one(), one()).prop_map(|(f, g)| F::Or(f, g)),
            (one(), one()).prop_map(|(f, g)| F::Equal(f, g)),
            one().prop_map(F::Pre),
            one().prop_map(F::Rising),
            one().prop_map(F::Falling),
            one().prop_map(F::Changed),
            one().prop_map(F::Once),
            one().prop_map(F::SoFar),
            (one(), one()).prop_map(|(f, g)| F::Since(f, g)),
            (one(), 0..3_usize).prop_map(|(f, n)| F::Held(f, n)),
            one().prop_map(F::HeldForNoTime),
            one().prop_map(F::WithinNone),
        ]
    })
}

/// Something about the inputs of a scan and everything at the end of the one before.
fn assumption() -> impl Strategy<Value = F> {
    let now = (0..3_usize).prop_map(F::Atom);
    let before = (0..NAMES.len()).prop_map(|i| F::Pre(Box::new(F::Atom(i))));
    let edge = (0..3_usize).prop_map(|i| F::Rising(Box::new(F::Atom(i))));
    prop_oneof![3 => now, 2 => before, 1 => edge].prop_recursive(2, 6, 2, |inner| {
        let one = || inner.clone().prop_map(Box::new);
        prop_oneof![
            one().prop_map(F::Not),
            (one(), one()).prop_map(|(f, g)| F::Or(f, g)),
            (one(), one()).prop_map(|(f, g)| F::Equal(f, g)),
        ]
    })
}

fn values(program: &FlatProgram, machine: &Machine<'_>) -> Vec<bool> {
    NAMES.iter().map(|name| machine.value(program.find(name).unwrap()) == 1).collect()
}

/// The scans of the shortest run that breaks `f` at its end, if one of at most [`SCANS`] does; `None` if a scan never ends.
fn shortest(program: &FlatProgram, f: &F, assumed: &F) -> Option<Option<usize>> {
    let inputs: Vec<VarId> = program.with_role(Role::Input).collect();
    let machine = Machine::new(program);
    let mut runs = vec![(machine.clone(), vec![values(program, &machine)])];
    for scan in 1..=SCANS {
        let mut next = Vec::new();
        for (machine, run) in &runs {
            for choice in 0..1_u32 << inputs.len() {
                let mut machine = machine.clone();
                inputs.iter().enumerate().for_each(|(i, &input)| machine.set(input, u64::from(choice >> i & 1)));
                machine.scan().ok()?;
                let mut run = run.clone();
                run.push(values(program, &machine));
                if !assumed.at(&run, scan) {
                    continue;
                }
                if !f.at(&run, scan) {
                    return Some(Some(scan));
                }
                next.push((machine, run));
            }
        }
        runs = next;
    }
    Some(None)
}

fn agree(text: &str, f: &F, assumed: &F) -> Result<(), TestCaseError> {
    let system = System::new(support::program(text), Plant::default());
    let Some(expected) = shortest(&system.program, f, assumed) else { return Ok(()) };
    let source = Source::new("r", format!("assume a: {};\nrequirement r: AG ({});", assumed.text(), f.text()));
    let (file, errors) = parse_requirements(&source);
    prop_assert!(errors.is_empty(), "{}: {errors:?}", source.text());
    let assumption = bind_assumption(&file.assumptions[0], &system, View::Scan).unwrap();
    let demand = bind_requirement(&file.requirements[0], &system, View::Scan).unwrap();
    let options = Options { assumptions: vec![assumption], ..Options::default() };
    let report = check(&system, &[(file.requirements[0].clone(), demand)], &options, &mut |_| None);
    let found = match &report.answers[0].outcome {
        Outcome::Violated(witness, _) => match &witness.trace {
            Trace::Scans(trace) => Some(trace.scans.len()),
            Trace::Firings(_) => None,
        },
        Outcome::Holds { .. } => None,
        Outcome::Unknown(reason) => {
            prop_assert!(!reason.contains("error in Petril"), "{reason}");
            prop_assert!(
                expected.is_none() || reason.contains("does not end"),
                "{}: {reason}, where {expected:?} scans break it",
                source.text()
            );
            return Ok(());
        }
    };
    prop_assert_eq!(found.filter(|&scans| scans <= SCANS), expected, "{}\n{}", text, source.text());
    Ok(())
}

/// An assumption that is none.
fn anything() -> F {
    let input = Box::new(F::Atom(0));
    F::Or(input.clone(), Box::new(F::Not(input)))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn shortest_runs_are_those_of_the_definitions(text in random_program::text(6), f in formula(4)) {
        agree(&text, &f, &anything())?;
    }

    #[test]
    fn what_is_assumed_leaves_out_what_it_should(text in random_program::text(6), f in formula(2), a in assumption()) {
        agree(&text, &f, &a)?;
    }
}

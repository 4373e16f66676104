//! What is told of a requirement that is broken: the instruction that wrote the value, the inputs that matter, and the words; on
//! programs where they can be read off, and on random ones, where every other run is tried.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use petril::explore::{ScanSpace, ScanState};
use petril::logic::{
    Bound, Comparison, Dag, Past, Quantifier, Requirement, Term, Valuation, View, bind_assumption, bind_requirement,
    parse_requirement, parse_requirements,
};
use petril::semantics::{Role, VarId};
use petril::source::Source;
use petril::translate::System;
use petril::verdict::{Change, Options, Outcome, Repair, Report, Trace, Why, check};
use petril::witness::ScanTrace;
use proptest::prelude::*;
use support::reports::{answer, report};
use support::systems::{CYLINDER, HANDS, TWO_HAND_SWITCH, system};
use support::{random_formula, random_program};

fn why<'r>(report: &'r Report, name: &str) -> &'r Why {
    match &answer(report, name).outcome {
        Outcome::Violated(_, Some(why)) => why,
        other => panic!("{name}: {other:?}"),
    }
}

/// Who wrote what: "Motor = 1 in scan 2 by ST Motor".
fn writers(system: &System, why: &Why) -> Vec<String> {
    let program = &system.program;
    let one = |writer: &petril::verdict::Writer| {
        let (name, words) =
            (&program.variable(writer.variable).name, program.text(program.code[writer.line].instruction));
        let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
        format!("{name} = {} in scan {} by {words}", writer.value, writer.scan + 1)
    };
    why.writers.iter().map(one).collect()
}

/// Changes of inputs: "Start = 1 in scan 2".
fn told(system: &System, changes: &[Change]) -> Vec<String> {
    let name = |id: VarId| &system.program.variable(id).name;
    changes.iter().map(|change| format!("{} = {} in scan {}", name(change.input), change.to, change.scan + 1)).collect()
}

/// The smallest sets of changes, the first one first.
fn repairs(system: &System, why: &Why) -> Vec<Vec<String>> {
    let repair = why.repair.as_ref().unwrap_or_else(|| panic!("{:?}", why.unrepaired));
    std::iter::once(&repair.changes).chain(&repair.others).map(|changes| told(system, changes)).collect()
}

fn example(program: &str, plant: &str) -> (System, Report) {
    let read = |path: String| fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap();
    let system = system(&read(format!("examples/{program}.il")), &[&read(format!("nets/{plant}.net"))]);
    let report = report(&system, &read(format!("examples/{plant}.req")));
    (system, report)
}

/// Start pressed in scan 1, let go in scan 2, while the motor holds itself in. Any of the three inputs of scan 2 would have been
/// enough, and not pressing Start at all.
#[test]
fn a_starter_that_holds_itself_in() {
    let system = system(include_str!("../../examples/latching-starter.il"), &[]);
    let report = report(&system, "requirement r: AG (Motor -> Start);");
    let why = why(&report, "r");
    assert_eq!(why.wanted, ["After scan 2 `Motor` is TRUE, so `Start` had to be TRUE, but it is FALSE"]);
    assert_eq!(writers(&system, why), ["Motor = 1 in scan 2 by ST Motor"]);
    let sets = ["Start = 1 in scan 2", "Stop = 0 in scan 2", "Overload = 0 in scan 2", "Start = 0 in scan 1"];
    assert_eq!(repairs(&system, why), sets.map(|set| vec![set.to_owned()]));
    assert!(why.repair.as_ref().unwrap().is_smallest);
}

/// The motor runs for ever unless somebody stops it, in a scan that comes again and again. Stopping it in the first scan would not
/// help: Start is pressed in every scan that follows.
#[test]
fn a_loop_is_repaired_where_it_goes_round() {
    let system = system(include_str!("../../examples/latching-starter.il"), &[]);
    let report = report(&system, "requirement r: AG (Motor -> AF !Motor);");
    let why = why(&report, "r");
    assert_eq!(why.wanted, ["After scan 1 `Motor` is TRUE, so `Motor` had to become FALSE, but it never does"]);
    assert_eq!(repairs(&system, why), [["Stop = 0 in scan 2"], ["Overload = 0 in scan 2"]]);
}

/// One hand is pressed in scan 1, the other in scan 2. A hand is both of its contacts. Both hands in scan 1 are another premise; a hand
/// fewer in either scan is none at all.
#[test]
fn a_hand_that_came_late() {
    let (system, report) = example("two-hand-switch", "two-hand-switch");
    let why = why(&report, "synchronous");
    let so = "After scan 1 `S1 & !S2 | !S1 & S2` is TRUE, so after scan 2 `Output` had to be FALSE, but it is TRUE";
    assert_eq!(why.wanted, [so]);
    assert_eq!(writers(&system, why), ["Output = 1 in scan 2 by S Output"]);
    let sets = [
        ["S1 = 0 in scan 2", "O1 = 1 in scan 2"],
        ["S2 = 0 in scan 2", "O2 = 1 in scan 2"],
        ["S1 = 1 in scan 1", "O1 = 0 in scan 1"],
        ["S2 = 0 in scan 1", "O2 = 1 in scan 1"],
    ];
    assert_eq!(repairs(&system, why), sets);
    assert!(why.repair.as_ref().unwrap().is_smallest);
}

/// The inlet is opened in scan 2, and nobody writes it afterwards: a set that does not act is none.
#[test]
fn a_valve_that_was_opened_long_ago() {
    let (system, report) = example("tank-broken", "tank");
    let why = why(&report, "closes");
    assert_eq!(why.wanted, ["After scan 6 `Level >= 70` is TRUE, so `Inlet` had to be FALSE, but it is TRUE"]);
    assert_eq!(writers(&system, why), ["Inlet = 1 in scan 2 by S Inlet"]);
    assert_eq!(repairs(&system, why), [["Level = 70 in scan 6"]], "it is 80; at 70 the program closes the inlet");
}

/// A number that comes from a counter; the end of a comparison is told with its value.
#[test]
fn a_pallet_with_too_many_bottles() {
    let (system, report) = example("bottle-counter-broken", "bottle-counter");
    let why = why(&report, "load");
    assert_eq!(why.wanted, ["After scan 14 `Bottles <= 240` had to hold, but `Bottles` is 248"]);
    assert_eq!(writers(&system, why), ["Bottles = 248 in scan 14 by ST Bottles"]);
    assert_eq!(why.repair.as_ref().unwrap().changes.len(), 1);
}

/// What was before is told with the value it had, and who wrote it then.
#[test]
fn what_looks_back() {
    let system = system(include_str!("../../examples/latching-starter.il"), &[]);
    let report = report(
        &system,
        "requirement r: AG (falling(Start) -> !Motor); requirement s: AG held(Motor -> Start, 1 scan);
        requirement t: AG (pre(Motor) <-> Motor);",
    );
    let edge = why(&report, "r");
    assert_eq!(edge.wanted.len(), 1);
    assert!(edge.wanted[0].ends_with("so `Motor` had to be FALSE, but it is TRUE"), "{:?}", edge.wanted);
    let sets = ["Start = 1 in scan 2", "Stop = 0 in scan 2", "Overload = 0 in scan 2", "Start = 0 in scan 1"];
    assert_eq!(repairs(&system, edge), sets.map(|set| vec![set.to_owned()]));
    let same = why(&report, "t");
    let so = "After scan 1 `pre(Motor) <-> Motor` had to hold, but `Motor` was FALSE and `Motor` is TRUE";
    assert_eq!(same.wanted, [so]);
    assert_eq!(writers(&system, same), ["Motor = 1 in scan 1 by ST Motor"]);
}

/// An assumption leaves out the values that would have been the first ones.
#[test]
fn what_is_assumed_not_to_happen_is_not_proposed() {
    let system = system(include_str!("../../examples/latching-starter.il"), &[]);
    let source = Source::new("r", "assume: Stop & Overload; requirement r: AG (Motor -> Start);");
    let (file, errors) = parse_requirements(&source);
    assert!(errors.is_empty());
    let demand = bind_requirement(&file.requirements[0], &system, View::Scan).unwrap();
    let assumptions = vec![bind_assumption(&file.assumptions[0], &system, View::Scan).unwrap()];
    let options = Options { assumptions, ..Options::default() };
    let report = check(&system, &[(file.requirements[0].clone(), demand)], &options, &mut |_| None);
    let why = why(&report, "r");
    assert_eq!(repairs(&system, why), [["Start = 1 in scan 2"], ["Start = 0 in scan 1"]]);
}

#[test]
fn what_nobody_writes_has_its_initial_value() {
    let text = "PROGRAM p VAR_INPUT a : BOOL; END_VAR VAR lamp : BOOL := TRUE; END_VAR VAR_OUTPUT q : BOOL; END_VAR
        LD a\nAND lamp\nST q\nEND_PROGRAM";
    let system = system(text, &[]);
    let report = report(&system, "requirement r: AG !lamp; requirement s: AG (q -> !lamp);");
    let lamp = system.program.find("lamp").unwrap();
    let first = why(&report, "r");
    assert_eq!((first.unwritten.as_slice(), first.writers.len()), ([lamp].as_slice(), 0));
    assert!(first.repair.is_none(), "no input matters");
    let second = why(&report, "s");
    assert_eq!(
        (second.unwritten.as_slice(), writers(&system, second)),
        ([lamp].as_slice(), vec!["q = 1 in scan 1 by ST q".to_owned()])
    );
    assert_eq!(repairs(&system, second), [["a = 0 in scan 1"]]);
}

/// Two inputs that must both change, since each alone is enough to switch on.
#[test]
fn a_pair_of_inputs() {
    let text = "PROGRAM p VAR_INPUT a, b : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR VAR m : BOOL; END_VAR
        LD a\nAND b\nS m\nLD m\nAND( a\nOR b\n)\nST q\nEND_PROGRAM";
    let system = system(text, &[]);
    let report = report(&system, "requirement r: AG (m & q -> AX (!q | !b));");
    let why = why(&report, "r");
    let repair = why.repair.as_ref().unwrap();
    assert_eq!((repair.changes.len(), repair.is_smallest), (1, true));
    let two = support::reports::report(&system, "requirement r: AG (m -> !q);");
    assert_eq!(support::reports::counterexample(&two, "r").scans.len(), 1);
}

/// The plant's transitions need the output; the run without them is not one of the system.
#[test]
fn what_the_plant_cannot_do_is_not_proposed() {
    let text = "PROGRAM p VAR_INPUT a, x : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR LD TRUE\nST q\nEND_PROGRAM";
    let system = system(text, &[CYLINDER]);
    let report = report(&system, "requirement r: AG !x;");
    let why = why(&report, "r");
    // Without x in the last scan, the cylinder is on its way, or where it began: two inputs differ then.
    assert_eq!(repairs(&system, why), [["x = 0 in scan 2"]]);
    assert_eq!(writers(&system, why), Vec::<String>::new(), "an input is not written");
}

#[test]
fn what_one_run_cannot_show_has_no_inputs_that_matter() {
    let system = system(TWO_HAND_SWITCH, &[HANDS]);
    let report =
        report(&system, "requirement r: EF (Output & !S1); requirement s: AG (Step_2 -> EF (Step_2 & S1 & Output));");
    let never = why(&report, "r");
    let so = "After scan 1 it had to be possible that `Output & !S1` becomes TRUE, but it is not, whatever happens";
    assert_eq!(never.wanted, [so]);
    assert!(never.repair.is_none() && never.unrepaired.is_some());
    // The premise could have been avoided.
    let later = why(&report, "s");
    let repair = later.repair.as_ref().unwrap();
    assert_eq!((repair.changes.len(), repair.is_smallest), (2, false));
}

/// Runs of a system by trying everything: the states that some inputs, scan after scan, lead to.
struct Everything<'s> {
    space: &'s ScanSpace<'s>,
    inputs: Vec<VarId>,
}

impl Everything<'_> {
    /// The states after the scans from a state that read these inputs.
    fn after(&self, from: &ScanState, inputs: &[u64]) -> Vec<Vec<u64>> {
        let mut found = BTreeSet::new();
        self.space.scans(from, &mut |run| {
            let fits = self.inputs.iter().zip(inputs).all(|(&input, &value)| run.machine.value(input) == value);
            if let (true, Ok(end)) = (fits, run.end) {
                found.insert(end.to_vec());
            }
        });
        found.into_iter().collect()
    }

    /// A run that reads these inputs, if the system has one. What it breaks does not depend on the plant's markings.
    fn run(&self, from: &ScanState, inputs: &[Vec<u64>]) -> Option<Vec<Vec<u64>>> {
        let Some((first, rest)) = inputs.split_first() else { return Some(Vec::new()) };
        self.after(from, first).into_iter().find_map(|state| {
            let mut run = vec![state.clone()];
            run.extend(self.run(&self.space.unpack(&state), rest)?);
            Some(run)
        })
    }

    /// The run with inputs of which those from `start` on are repeated, as a lasso; only without a plant.
    fn lasso(&self, inputs: &[Vec<u64>], start: usize) -> Option<(Vec<Vec<u64>>, usize)> {
        let mut states: Vec<Vec<u64>> = Vec::new();
        let mut state = self.space.power_on();
        let mut phases: Vec<(usize, Vec<u64>)> = Vec::new();
        let mut phase = 0;
        loop {
            let end = self.after(&state, &inputs[phase]).pop()?;
            // Often enough for what is remembered to have settled.
            let known = |(_, known): &(usize, &(usize, Vec<u64>))| **known == (phase, end.clone());
            let knots: Vec<usize> = phases.iter().enumerate().filter(known).map(|(at, _)| at).collect();
            if let (5.., Some(&knot)) = (knots.len(), knots.last()) {
                return Some((states, knot));
            }
            phases.push((phase, end.clone()));
            state = self.space.unpack(&end);
            states.push(end);
            phase = if phase + 1 < inputs.len() { phase + 1 } else { start };
        }
    }
}

/// A run as the textbook sees it: its states, and where the last one steps back to.
struct Run<'s> {
    space: &'s ScanSpace<'s>,
    states: Vec<Vec<u64>>,
    back: Option<usize>,
}

impl Run<'_> {
    fn onward(&self, from: usize) -> Vec<usize> {
        let mut positions: Vec<usize> = (from..self.states.len()).collect();
        positions.extend(self.back.into_iter().flat_map(|back| back..from.max(back)));
        positions
    }

    /// Whether the run shows that a formula has this value at a position, whatever comes after its end.
    fn shows(&self, formula: &Bound, value: bool, at: usize) -> bool {
        let of = |f: &Bound, value| self.shows(f, value, at);
        match formula {
            _ if formula.is_state_formula() => formula.holds_in(&Moment { run: self, at: Some(at) }).unwrap() == value,
            Bound::Not(f) => of(f, !value),
            Bound::And(f, g) if value => of(f, true) && of(g, true),
            Bound::And(f, g) => of(f, false) || of(g, false),
            Bound::Or(f, g) if value => of(f, true) || of(g, true),
            Bound::Or(f, g) => of(f, false) && of(g, false),
            Bound::Implies(f, g) if value => of(f, false) || of(g, true),
            Bound::Implies(f, g) => of(f, true) && of(g, false),
            Bound::Iff(f, g) => (of(f, true) && of(g, value)) || (of(f, false) && of(g, !value)),
            Bound::Next(quantifier, f) => {
                assert_eq!(*quantifier == Quantifier::Some, value, "one run shows it");
                let next = if at + 1 < self.states.len() { Some(at + 1) } else { self.back };
                next.is_some_and(|next| self.shows(f, value, next))
            }
            Bound::Until { quantifier, weak, hold, release } => {
                assert_eq!(*quantifier == Quantifier::Some, value, "one run shows it");
                let way = self.onward(at);
                let for_ever = self.back.is_some();
                if value {
                    let first = way.iter().position(|&at| self.shows(release, true, at));
                    let kept = |way: &[usize]| way.iter().all(|&at| self.shows(hold, true, at));
                    first.is_some_and(|first| kept(&way[..first])) || (*weak && for_ever && kept(&way))
                } else {
                    let end = way.iter().position(|&at| self.shows(hold, false, at) && self.shows(release, false, at));
                    let never = |way: &[usize]| way.iter().all(|&at| self.shows(release, false, at));
                    end.is_some_and(|end| never(&way[..end])) || (!*weak && for_ever && never(&way))
                }
            }
            _ => unreachable!("scan states have no places"),
        }
    }
}

/// A position of a run; none is power-on. The past is looked up by going back.
struct Moment<'r, 's> {
    run: &'r Run<'s>,
    at: Option<usize>,
}

impl Moment<'_, '_> {
    fn before(&self) -> Self {
        Self { run: self.run, at: self.at.and_then(|at| at.checked_sub(1)) }
    }
}

impl Valuation for Moment<'_, '_> {
    fn value(&self, variable: VarId) -> u64 {
        let space = self.run.space;
        match self.at {
            Some(at) => space.value(&self.run.states[at], variable),
            None => space.system().program.variable(variable).initial,
        }
    }

    fn past(&self, past: &Past) -> i128 {
        let Some(at) = self.at else { return 0 };
        let holds = |formula: &Bound, at| formula.holds_in(&Moment { run: self.run, at: Some(at) }).unwrap();
        match past {
            Past::First => i128::from(at == 0),
            Past::Before(Term::Truth(formula)) => i128::from(formula.holds_in(&self.before()).unwrap()),
            Past::Before(_) => unreachable!("the programs have truth values only"),
            Past::Since(f, g) => {
                let since = (0..=at).rev().find(|&then| holds(g, then));
                i128::from(since.is_some_and(|then| (then + 1..=at).all(|at| holds(f, at))))
            }
            Past::Run { of, most } => {
                let run = (0..=at).rev().take_while(|&at| holds(of, at)).count();
                i128::try_from(run).unwrap().min(i128::from(*most))
            }
        }
    }
}

/// The smallest number of inputs whose change makes a run that does not show the formula false, by trying all.
fn smallest_by_trying(space: &ScanSpace<'_>, trace: &ScanTrace, formula: &Bound) -> Option<usize> {
    let inputs: Vec<VarId> = space.system().program.with_role(Role::Input).collect();
    let everything = Everything { space, inputs: inputs.clone() };
    let cells: Vec<u64> = trace.scans.iter().flat_map(|scan| scan.inputs.iter().map(|&(_, value)| value)).collect();
    let mut smallest = None;
    for mask in 0..1_u64 << cells.len() {
        let size = mask.count_ones() as usize;
        if smallest.is_some_and(|smallest| smallest <= size) {
            continue;
        }
        let changed: Vec<u64> = cells.iter().enumerate().map(|(i, value)| value ^ (mask >> i & 1)).collect();
        let scans: Vec<Vec<u64>> = changed.chunks(inputs.len()).map(<[u64]>::to_vec).collect();
        let run = match trace.loop_start {
            None => everything.run(&space.power_on(), &scans).map(|states| Run { space, states, back: None }),
            Some(start) => {
                everything.lasso(&scans, start + 1).map(|(states, back)| Run { space, states, back: Some(back) })
            }
        };
        if run.is_some_and(|run| !run.shows(formula, false, 0)) {
            smallest = Some(size);
        }
    }
    smallest
}

/// Formulas as people write them, and some as they do not.
fn formula() -> impl Strategy<Value = Bound> {
    let atom = || {
        let variable = (0..8_usize, any::<bool>()).prop_map(|(v, not)| {
            let atom = Bound::Variable(VarId(v));
            if not { Bound::Not(Box::new(atom)) } else { atom }
        });
        let pair = (variable.clone(), variable.clone(), any::<bool>());
        let pair = pair
            .prop_map(|(f, g, and)| if and { Bound::And(f.into(), g.into()) } else { Bound::Or(f.into(), g.into()) });
        let past = (variable.clone(), variable.clone(), 0..4).prop_map(|(f, g, kind)| {
            let (past, least) = match kind {
                0 => (Past::First, 1),
                1 => (Past::Before(Term::Truth(Box::new(f))), 1),
                2 => (Past::Since(f, g), 1),
                _ => (Past::Run { of: f, most: 2 }, 2),
            };
            Bound::Compare(Comparison::AtLeast, Term::Past(Arc::new(past)), Term::Number(least))
        });
        prop_oneof![4 => variable, 2 => pair, 1 => past]
    };
    let until = |weak, hold: Bound, release: Bound| Bound::Until {
        quantifier: Quantifier::All,
        weak,
        hold: Box::new(hold),
        release: Box::new(release),
    };
    let implies = |f: Bound, g: Bound| Bound::Implies(Box::new(f), Box::new(g));
    let next = |f: Bound| Bound::Next(Quantifier::All, Box::new(f));
    let shapes = (0..6, atom(), atom(), atom()).prop_map(move |(shape, a, b, c)| {
        let globally = |f| until(true, f, Bound::Truth(false));
        match shape {
            0 => globally(implies(a, b)),
            1 => globally(implies(a, next(b))),
            2 => globally(implies(a, next(implies(b, c)))),
            3 => globally(implies(a, until(true, b, c))),
            4 => globally(implies(a, until(false, Bound::Truth(true), b))),
            _ => until(true, a, b),
        }
    });
    let any = random_formula::formula((0..8).map(|v| Bound::Variable(VarId(v))).collect(), true);
    prop_oneof![4 => shapes, 1 => any]
}

/// A requirement with a formula that is bound already.
fn requirement() -> Requirement {
    parse_requirement("r", &Source::new("r", "TRUE")).unwrap()
}

/// The repair of a formula that some run breaks, with the run.
fn broken(system: &System, formula: &Bound) -> Option<(ScanTrace, Why)> {
    let options = Options { view: View::Scan, ..Options::default() };
    let mut report = check(system, &[(requirement(), formula.clone().into())], &options, &mut |_| None);
    match report.answers.remove(0).outcome {
        Outcome::Violated(witness, why) => match witness.trace {
            Trace::Scans(trace) => Some((trace, why.unwrap())),
            Trace::Firings(_) => panic!("it is told in firings"),
        },
        _ => None,
    }
}

/// Every set of changes, made to the trace, with all of them and with some of them only.
fn check_parts(
    space: &ScanSpace<'_>,
    trace: &ScanTrace,
    formula: &Bound,
    repair: &Repair,
) -> Result<(), TestCaseError> {
    let inputs: Vec<VarId> = space.system().program.with_role(Role::Input).collect();
    let everything = Everything { space, inputs };
    for changes in std::iter::once(&repair.changes).chain(&repair.others) {
        for part in 0..1_u32 << changes.len() {
            let mut scans: Vec<Vec<u64>> =
                trace.scans.iter().map(|scan| scan.inputs.iter().map(|&(_, value)| value).collect()).collect();
            for (_, change) in changes.iter().enumerate().filter(|(i, _)| part >> i & 1 == 1) {
                let cell = &mut scans[change.scan][change.input.0];
                prop_assert_eq!(*cell, change.from);
                *cell = change.to;
            }
            let run = match trace.loop_start {
                None => everything.run(&space.power_on(), &scans).map(|states| Run { space, states, back: None }),
                Some(start) => {
                    everything.lasso(&scans, start + 1).map(|(states, back)| Run { space, states, back: Some(back) })
                }
            };
            let all = part + 1 == 1 << changes.len();
            let breaks = run.map(|run| run.shows(formula, false, 0));
            prop_assert!(if all { breaks == Some(false) } else { breaks != Some(false) }, "{changes:?}, part {part:b}");
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    /// The set is as small as any, is enough, and no part of it is.
    #[test]
    fn inputs_that_matter_are_as_few_as_can_be(
        text in random_program::text(4),
        device in proptest::option::of(random_program::device()),
        formula in formula(),
    ) {
        let system = random_program::system(support::program(&text), device.as_ref());
        let mut dag = Dag::default();
        let negation = dag.add(&formula, true);
        if !dag.is_universal(negation)
            && let Some((trace, why)) = broken(&system, &formula)
            && trace.scans.len() <= 3
            && (trace.loop_start.is_none() || system.plant.components.is_empty())
        {
            let space = ScanSpace::new(&system);
            let smallest = smallest_by_trying(&space, &trace, &formula);
            match &why.repair {
                Some(repair) => {
                    prop_assert!(repair.is_smallest || repair.changes.len() > 4, "{:?}", repair);
                    if repair.is_smallest {
                        prop_assert_eq!(Some(repair.changes.len()), smallest);
                    }
                    check_parts(&space, &trace, &formula, repair)?;
                }
                // What several runs show together is not shown by the run as it is.
                None => prop_assert!(
                    smallest.is_none_or(|smallest| smallest == 0 || smallest > 4),
                    "{:?} {:?}",
                    smallest,
                    why.unrepaired
                ),
            }
            prop_assert!(!why.wanted.is_empty());
        }
    }
}

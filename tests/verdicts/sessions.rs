//! Runs under somebody's hands: however one goes through them, forward or back, they are the same, and the net and the
//! interpreter agree with each other.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::flat::Tolerated;
use petril::logic::View;
use petril::net::Marking;
use petril::semantics::VarId;
use petril::simulate::{Breakpoint, Chance, Plan, Session, Stopped, Watch, condition};
use petril::source::Source;
use petril::translate::{Plant, System};
use petril::witness::{Recalled, ScanTrace, replay_scans};
use proptest::prelude::*;
use support::agreement::programs;
use support::random_flat::Choices;
use support::runs::{TOLERATED, by_chance};
use support::systems::system;
use support::{random_program, random_wide_program};

/// The plans of a run.
fn plans(trace: &ScanTrace) -> Vec<Plan> {
    trace.scans.iter().map(|scan| Plan { moves: scan.moves.clone(), inputs: scan.inputs.clone() }).collect()
}

/// Everything a session shows.
fn shown(session: &Session<'_>) -> (usize, Option<usize>, Vec<u64>, Marking) {
    let memory = session.system().program.declared().map(|id| session.value(id)).collect();
    (session.scans().len(), session.line(), memory, session.replay().marking().clone())
}

/// By scans, lines and firings, forward and back, a session goes through the run of a seed.
fn goes_through(system: &System, seed: u64, scans: usize) -> Result<(), TestCaseError> {
    let trace = by_chance(system, seed, scans);
    prop_assert_eq!(replay_scans(system, &trace, |_, _| Ok(())), Ok(()));
    let begin = || Session::new(system, TOLERATED, plans(&trace));
    let total = trace.scans.len();

    let mut by_scan = begin();
    for _ in 0..total {
        by_scan.step_scan().unwrap();
    }
    prop_assert_eq!(by_scan.scans(), &trace.scans[..]);

    let mut by_firing = begin();
    let mut seen = vec![shown(&by_firing)];
    while by_firing.scans().len() < total {
        by_firing.step_transition().unwrap();
        seen.push(shown(&by_firing));
    }
    for (ours, other) in by_firing.scans().iter().zip(&trace.scans) {
        prop_assert_eq!(&ours.inputs, &other.inputs);
        let declared = |scan: &petril::witness::Scan| -> Vec<u64> {
            system.program.declared().map(|id| scan.end.as_ref().unwrap().memory[id.0]).collect()
        };
        prop_assert_eq!(declared(ours), declared(other));
    }
    for expected in seen.iter().rev().skip(1).take(200) {
        by_firing.back_transition().unwrap();
        prop_assert_eq!(&shown(&by_firing), expected);
    }

    let mut by_line = begin();
    let mut seen = vec![shown(&by_line)];
    while by_line.scans().len() < total {
        by_line.step_line().unwrap();
        seen.push(shown(&by_line));
    }
    for expected in seen.iter().rev().skip(1).take(100) {
        by_line.back_line().unwrap();
        prop_assert_eq!(&shown(&by_line), expected);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(programs(60)))]

    #[test]
    fn of_truth_values_with_a_plant(
        text in random_program::text(8),
        device in proptest::option::of(random_program::device()),
        seed: u64,
    ) {
        let system = random_program::system(support::program(&text), device.as_ref());
        goes_through(&system, seed, 5)?;
    }

    #[test]
    fn over_the_whole_language(numbers in proptest::collection::vec(any::<u32>(), 0..200), seed: u64) {
        let program = support::program(&random_wide_program::text(&mut Choices::new(&numbers)));
        goes_through(&System::new(program, Plant::default()), seed, 2)?;
    }
}

/// Random programs make scans, most of them: otherwise the above says little.
#[test]
fn many_programs_come_far() {
    let mut generator = 1_u64;
    let mut next = || {
        // Knuth's MMIX.
        generator = generator.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (generator >> 32) as u32
    };
    let scans = (0..100).map(|seed| {
        let numbers: Vec<u32> = (0..200).map(|_| next()).collect();
        let program = support::program(&random_wide_program::text(&mut Choices::new(&numbers)));
        by_chance(&System::new(program, Plant::default()), seed, 2).scans.len()
    });
    let scans: usize = scans.sum();
    assert!(scans > 100, "{scans} of 200");
}

const SWITCH: &str = "PROGRAM p VAR_INPUT i, j : BOOL; k : SINT; END_VAR VAR_OUTPUT q : BOOL; n : SINT; END_VAR\n\
                      LD i\nAND j\nST q\nLD n\nADD k\nST n\nEND_PROGRAM";

fn names(system: &System, names: &[&str]) -> Vec<VarId> {
    names.iter().map(|name| system.program.find(name).unwrap()).collect()
}

#[test]
fn inputs_stay_until_they_are_changed_and_a_change_begins_another_future() {
    let system = system(SWITCH, &[]);
    let [i, j, k, n] = names(&system, &["i", "j", "k", "n"])[..] else { panic!() };
    let mut session = Session::new(&system, Tolerated::default(), vec![]);
    session.toggle(i).unwrap();
    session.set(k, 5).unwrap();
    for expected in [5, 10, 15] {
        session.step_scan().unwrap();
        assert_eq!((session.value(i), session.value(j), session.value(n)), (1, 0, expected));
    }
    assert!(session.is_changed(n) && !session.is_changed(i));
    session.back_scan().unwrap();
    session.back_scan().unwrap();
    assert_eq!((session.value(n), session.planned()), (5, 3));
    session.toggle(i).unwrap();
    assert_eq!(session.planned(), 2);
    session.step_scan().unwrap();
    assert_eq!((session.value(i), session.value(n)), (0, 10));

    session.step_line().unwrap();
    assert_eq!((session.line(), session.toggle(i)), (Some(0), Err(Stopped::UnderWay)));
    session.step_scan().unwrap();
    assert_eq!(session.set(n, 0), Err(Stopped::NoInput));
    for _ in 0..3 {
        session.back_scan().unwrap();
    }
    assert_eq!(session.back_scan(), Err(Stopped::PowerOn));
    assert_eq!(session.back_line(), Err(Stopped::PowerOn));
    assert_eq!(session.value(n), 0);
}

#[test]
fn the_current_result_is_shown_after_every_line() {
    let system = system(SWITCH, &[]);
    let [i, j, k] = names(&system, &["i", "j", "k"])[..] else { panic!() };
    let mut session = Session::new(&system, Tolerated::default(), vec![]);
    session.toggle(i).unwrap();
    session.toggle(j).unwrap();
    session.set(k, 0xFD).unwrap();
    let mut told = Vec::new();
    loop {
        session.step_line().unwrap();
        let Some(line) = session.line() else { break };
        let (ty, result) = session.result().unwrap();
        told.push((line, ty.number(result)));
    }
    assert_eq!(told, [(0, 0), (1, 1), (2, 1), (3, 1), (4, 0), (5, -3), (6, -3)]);
    assert_eq!(session.scans().len(), 1);
}

#[test]
fn the_plant_does_what_it_can_and_inputs_follow() {
    let plant = "net button\npl {i=0} (1)\npl {i=1}\ntr press {i=0} -> {i=1}\ntr let_go {i=1} -> {i=0}\n";
    let system = system(SWITCH, &[plant]);
    let i = system.program.find("i").unwrap();
    let mut session = Session::new(&system, Tolerated::default(), vec![]);
    assert_eq!(session.toggle(i), Err(Stopped::Driven));
    let [press] = session.choices()[..] else { panic!() };
    session.act(press).unwrap();
    let [let_go] = session.choices()[..] else { panic!() };
    assert!(matches!(session.act(press), Err(Stopped::Plant(_))));
    assert_eq!((session.value(i), session.next_inputs()[0]), (0, (i, 1)));
    // Its firing is the first of the scan, and can be seen.
    session.step_transition().unwrap();
    assert_eq!((session.value(i), session.line(), session.choices().len()), (0, None, 0));
    session.step_scan().unwrap();
    assert_eq!((session.value(i), session.choices()), (1, vec![let_go]));
    session.back_scan().unwrap();
    session.take_back();
    session.step_scan().unwrap();
    assert_eq!(session.value(i), 0);
}

#[test]
fn runs_stop_at_conditions_and_at_lines() {
    let system = system(SWITCH, &[]);
    let [k, n] = names(&system, &["k", "n"])[..] else { panic!() };
    let breakpoint = |text: &str| Breakpoint::read(&Source::new("condition", text), &system);
    let mut session = Session::new(&system, Tolerated { overflow: true, division_by_zero: false }, vec![]);
    session.set(k, 3).unwrap();
    assert_eq!(session.run_until(&breakpoint("n > 10").unwrap(), 100, None), Ok(true));
    assert_eq!((session.scans().len(), session.value(n)), (4, 12));
    assert_eq!(session.run_until(&breakpoint("at line 6 & n > 15").unwrap(), 1000, None), Ok(true));
    assert_eq!((session.scans().len(), session.line(), session.value(n)), (6, Some(5), 18));
    assert_eq!(session.run_until(&breakpoint("q").unwrap(), 10, None), Ok(false));
    assert_eq!(session.run_until(&breakpoint("q").unwrap(), 1000, Some(&mut Chance::new(&system, 1))), Ok(true));
    for wrong in ["AG q", "nothing", "n", "at line 99", "q &"] {
        assert!(breakpoint(wrong).is_err(), "{wrong}");
    }
}

/// What a condition knows of scans before is what the definitions say, scan after scan, and stepping back forgets it.
#[test]
fn conditions_look_back() {
    let system = system(SWITCH, &[]);
    let trace = by_chance(&system, 11, 60);
    let texts = [
        "rising(i)",
        "falling(q)",
        "pre(n) < n",
        "changed(k)",
        "once(i & j)",
        "so_far(!q)",
        "(i since j)",
        "held(i, 3 scans)",
        "pre(pre(i)) & !i",
        "rising(once(q))",
        "at first scan",
    ];
    let mut met = 0;
    for text in texts {
        let condition = condition(&Source::new("condition", text), &system, View::Scan).unwrap();
        let power_on = petril::explore::ScanState::power_on(&system).memory;
        let (mut watch, mut recalled) = (Watch::new(&condition, &power_on), Recalled::new(power_on.clone()));
        let mut first = None;
        for (position, scan) in trace.scans.iter().enumerate() {
            let memory = &scan.end.as_ref().unwrap().memory;
            recalled.push(memory.clone());
            let seen = watch.see(memory);
            assert_eq!(Some(seen), recalled.holds(&condition), "{text} in scan {}", position + 1);
            first = first.or(seen.then_some(position + 1));
            met += usize::from(seen);
        }
        let mut session = Session::new(&system, TOLERATED, plans(&trace));
        let reached = session.run_until(&Breakpoint::Scans(condition), trace.scans.len(), None);
        assert_eq!(reached, Ok(first.is_some()), "{text}");
        assert_eq!(first.unwrap_or(60), session.scans().len(), "{text}");
    }
    assert!((100..500).contains(&met), "{met}");
}

#[test]
fn a_run_does_not_go_on_behind_a_failure() {
    let system = system(SWITCH, &[]);
    let [k, n] = names(&system, &["k", "n"])[..] else { panic!() };
    let mut session = Session::new(&system, Tolerated::default(), vec![]);
    session.set(k, 100).unwrap();
    for _ in 0..2 {
        session.step_scan().unwrap();
    }
    assert_eq!((session.value(n), session.failure().is_some()), (0xC8, true));
    assert!(matches!(session.step_scan(), Err(Stopped::Failed(_))));
    assert!(matches!(session.step_line(), Err(Stopped::Failed(_))));
    session.back_scan().unwrap();
    // What the failing scan leaves meets no condition.
    let overflown = Breakpoint::read(&Source::new("condition", "n < 0"), &system).unwrap();
    assert!(matches!(session.run_until(&overflown, 10, None), Err(Stopped::Failed(_))));
    session.back_scan().unwrap();
    session.set(k, 0).unwrap();
    session.step_scan().unwrap();
    assert_eq!((session.value(n), session.failure()), (100, None));

    let endless =
        support::systems::system("PROGRAM p VAR_INPUT i : BOOL; END_VAR\non: LD i\nJMPC on\nEND_PROGRAM", &[]);
    let mut session = Session::new(&endless, Tolerated::default(), vec![]);
    session.toggle(VarId(0)).unwrap();
    assert!(matches!(session.step_scan(), Err(Stopped::Failed(_))));
    assert_eq!(session.scans().len(), 0);
    for _ in 0..5 {
        session.step_line().unwrap();
    }
    assert_eq!(session.line(), Some(0));
    session.back_line().unwrap();
    assert_eq!(session.line(), Some(1));
}

#[test]
fn chance_is_the_same_for_the_same_seed_and_comes_to_the_interesting_values() {
    let text = "PROGRAM p VAR_INPUT level : INT; END_VAR VAR_OUTPUT exact, high : BOOL; END_VAR\n\
                LD level\nEQ 1234\nST exact\nLD level\nGT 20000\nST high\nEND_PROGRAM";
    let system = system(text, &[]);
    let trace = by_chance(&system, 42, 200);
    assert_eq!(trace, by_chance(&system, 42, 200));
    assert_ne!(trace, by_chance(&system, 43, 200));
    let level = |scan: usize| system.program.variable(VarId(0)).ty.number(trace.scans[scan].inputs[0].1);
    let values: std::collections::BTreeSet<i128> = (0..200).map(level).collect();
    for interesting in [-32768, -1, 0, 1, 1233, 1234, 1235, 20000, 20001, 32767] {
        assert!(values.contains(&interesting), "{interesting}: {values:?}");
    }
    // A seed means the same run for ever: these are written down.
    assert_eq!((0..8).map(level).collect::<Vec<_>>(), [0, 0, 0, 0, 0, 20000, 20000, 20001]);
}

/// Nobody fills this tank by uniform chance: from every level, what takes water is as likely as what brings it, and it leaks.
#[test]
fn a_plant_comes_everywhere_by_chance() {
    let mut net = "net tank\npl {k=0} (1)\n".to_owned();
    for level in 1..=20 {
        net += &format!("tr up{level} {{k={}}} {{q=0}}?1 -> {{k={level}}}\n", level - 1);
        net += &format!("tr down{level} {{k={level}}} -> {{k={}}}\n", level - 1);
        net += &format!("tr leak{level} {{k={level}}} -> {{k=0}}\n");
    }
    let text = "PROGRAM p VAR_INPUT k : SINT; END_VAR VAR_OUTPUT q : BOOL; END_VAR\nLD k\nGT 18\nST q\nEND_PROGRAM";
    let system = system(text, &[&net]);
    let trace = by_chance(&system, 5, 400);
    assert_eq!(replay_scans(&system, &trace, |_, _| Ok(())), Ok(()));
    let levels: std::collections::BTreeSet<u64> = trace.scans.iter().map(|scan| scan.inputs[0].1).collect();
    assert_eq!(levels, (0..=20).collect(), "each level at some time");
    let quiet = trace.scans.iter().filter(|scan| scan.moves.is_empty()).count();
    assert!((50..350).contains(&quiet), "at times nothing happens: {quiet}");
}

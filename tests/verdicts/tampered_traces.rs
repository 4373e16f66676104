//! The replay refuses every trace that is not a run of the system. A witness is worth only as much as that.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::explore::{Budget, Failure, Markings, ScanSpace, explore};
use petril::flat::Hazard;
use petril::interpret::Fault;
use petril::net::TransitionId;
use petril::translate::{Plant, System, TransitionRole};
use petril::witness::{Disagreement, FiringTrace, ScanTrace, firing_trace, replay_firings, replay_scans, scan_trace};
use proptest::prelude::*;
use proptest::sample::Index;
use support::assembler::assemble;
use support::random_program;
use support::reports::{counterexample, report};
use support::systems::{HANDS, TWO_HAND_SWITCH, system};

const REQUIREMENTS: &str = include_str!("../../examples/two-hand-switch.req");
const BROKEN: &str = include_str!("../../examples/two-hand-switch-broken.il");

fn replayed(system: &System, trace: &ScanTrace) -> Result<(), String> {
    replay_scans(system, trace, |_, _| Ok(())).map_err(|Disagreement(why)| why)
}

/// The trace with one change is refused, for this reason.
fn refused(system: &System, trace: &ScanTrace, why: &str, change: impl Fn(&mut ScanTrace)) {
    let mut tampered = trace.clone();
    change(&mut tampered);
    assert_ne!(&tampered, trace, "{why}");
    let reason = replayed(system, &tampered).expect_err(why);
    assert!(reason.contains(why), "{reason}, not {why}");
}

#[test]
fn every_piece_of_a_scan_trace_counts() {
    let system = system(BROKEN, &[HANDS]);
    let report = report(&system, REQUIREMENTS);
    let trace = counterexample(&report, "no_restart");
    assert_eq!(replayed(&system, trace), Ok(()));
    let refuse = |why: &str, change: &dyn Fn(&mut ScanTrace)| refused(&system, trace, why, change);
    let id = |name: &str| system.program.find(name).unwrap();

    // An input the plant did not give.
    refuse("in scan 2: 0 transitions are enabled", &|trace| trace.scans[1].inputs[0].1 ^= 1);
    refuse("in scan 1", &|trace| _ = trace.scans[0].inputs.pop());
    refuse("in scan 3", &|trace| trace.scans[2].inputs.reverse());
    // A state the program does not leave.
    for (scan, name) in [(0, "Output"), (1, "Step_2"), (2, "S1")] {
        let why = format!("in scan {}: the search has another value of `{name}`", scan + 1);
        refuse(&why, &|trace| trace.scans[scan].end.as_mut().unwrap().memory[id(name).0] ^= 1);
    }
    refuse("in scan 2: the search has another marking of `hands.1`", &|trace| {
        trace.scans[1].end.as_mut().unwrap().plant[0] ^= 1;
    });
    // Moves the plant does not make.
    refuse("in scan 1", &|trace| trace.scans[0].moves.clear());
    refuse("in scan 2", &|trace| _ = trace.scans[1].moves.pop());
    refuse("in scan 3: 0 transitions are enabled", &|trace| {
        let again = trace.scans[2].moves[0];
        trace.scans[2].moves.push(again);
    });
    refuse("in scan 2: 0 transitions are enabled", &|trace| trace.scans[1].moves[0].transition ^= 1);
    // Scans that are missing, that are swapped, that do not end.
    refuse("in scan 1", &|trace| _ = trace.scans.remove(0));
    refuse("in scan 2", &|trace| trace.scans.swap(1, 2));
    refuse("in scan 3: it ends", &|trace| trace.scans[2].end = None);
    // A lasso that is none.
    refuse("the lasso does not close", &|trace| trace.loop_start = Some(1));
    refuse("the lasso does not close", &|trace| trace.loop_start = Some(2));
    refuse("the lasso does not close", &|trace| trace.loop_start = Some(7));
}

#[test]
fn a_scan_that_never_ends_cannot_be_claimed_to_end() {
    let text =
        "PROGRAM p VAR_INPUT a : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR\non: LD a\nST q\nJMPC on\nEND_PROGRAM";
    let system = system(text, &[]);
    let space = ScanSpace::new(&system);
    let endless = scan_trace(&space, &[], None, Some(Failure::Scan(Fault::Endless)));
    assert_eq!(replayed(&system, &endless), Ok(()));
    refused(&system, &endless, "in scan 1: it never ends", |trace| {
        trace.scans[0].end = Some(space.power_on());
    });
    refused(&system, &endless, "in scan 1: it ends", |trace| trace.scans[0].inputs[0].1 = 0);
}

#[test]
fn an_error_cannot_be_claimed_where_there_is_none() {
    let program = assemble("in d SINT\nvar c SINT 120", "LD c\nADD d\nST c\nLD SINT#7\nDIV d\nST c");
    let system = System::new(program, Plant::default());
    let space = ScanSpace::new(&system);
    let by_zero = scan_trace(&space, &[], None, Some(Failure::Hazard(4, Hazard::DivisionByZero)));
    assert_eq!(replayed(&system, &by_zero), Ok(()));
    assert_eq!(by_zero.scans[0].inputs[0].1, 0);
    let why = "in scan 1: it does not meet this hazard";
    refused(&system, &by_zero, why, |trace| trace.scans[0].hazard = Some((1, Hazard::DivisionByZero)));
    refused(&system, &by_zero, why, |trace| trace.scans[0].hazard = Some((4, Hazard::Overflow)));
    refused(&system, &by_zero, why, |trace| trace.scans[0].inputs[0].1 = 1);
}

#[test]
fn what_is_said_of_the_states_is_asked_at_each() {
    let system = system(BROKEN, &[HANDS]);
    let report = report(&system, REQUIREMENTS);
    let trace = counterexample(&report, "no_restart");
    let mut asked = Vec::new();
    let result = replay_scans(&system, trace, |position, _| {
        asked.push(position);
        if position == 1 { Err(Disagreement("no".to_owned())) } else { Ok(()) }
    });
    assert_eq!((result, asked), (Err(Disagreement("in scan 2: no".to_owned())), vec![0, 1]));
}

/// The firings of a run of the switch through the first scan.
fn firings(system: &System) -> FiringTrace {
    let markings = Markings::explored(&system.net, Budget::default(), &mut |_| None);
    let graph = markings.graph();
    let path = graph.path_to(graph.len() as u32 - 1);
    let states: Vec<&[u64]> = path.iter().map(|&id| graph.state(id)).collect();
    firing_trace(&markings, &states, None)
}

#[test]
fn every_firing_counts() {
    let system = system(TWO_HAND_SWITCH, &[HANDS]);
    let trace = firings(&system);
    let replayed = |trace: &FiringTrace| replay_firings(&system, trace, |_, _| Ok(()));
    assert_eq!(replayed(&trace), Ok(()));
    // All firings of a scan hang on each other; the plant's last moves do not.
    for position in 0..trace.firings.len() - 1 {
        let mut without = trace.clone();
        let dropped = without.firings.remove(position);
        let is_plant = |id: TransitionId| matches!(system.transitions[id.index()], TransitionRole::Plant { .. });
        assert!(replayed(&without).is_err() || is_plant(dropped), "without firing {position}");
    }
    for loop_start in 1..trace.firings.len() {
        let lasso = FiringTrace { loop_start: Some(loop_start), ..trace.clone() };
        assert_eq!(replayed(&lasso), Err(Disagreement("the lasso does not close".to_owned())));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// On random programs: a run is replayed, and refused with one bit of an input or of a state flipped.
    #[test]
    fn a_flipped_bit_is_noticed(
        text in random_program::text(6),
        device in proptest::option::of(random_program::device()),
        goal in any::<Index>(),
        scan in any::<Index>(),
        bit in any::<Index>(),
        of_input in any::<bool>(),
    ) {
        let system = random_program::system(support::program(&text), device.as_ref());
        let space = ScanSpace::new(&system);
        let graph = explore(&space, Budget::default(), &mut |_| None);
        prop_assume!(!graph.is_empty());
        let path = graph.path_to(goal.index(graph.len()) as u32);
        let states: Vec<&[u64]> = path.iter().map(|&id| graph.state(id)).collect();
        let mut trace = scan_trace(&space, &states, None, None);
        prop_assert_eq!(replayed(&system, &trace), Ok(()));
        let scan = scan.index(trace.scans.len());
        let scan = &mut trace.scans[scan];
        if of_input {
            scan.inputs[bit.index(3)].1 ^= 1;
        } else {
            let declared: Vec<_> = system.program.declared().collect();
            scan.end.as_mut().unwrap().memory[bit.get(&declared).0] ^= 1;
        }
        prop_assert!(replayed(&system, &trace).is_err());
    }
}

//! Every example, with the verdict on every requirement. What they should be can be read off the machines; where one is
//! violated, the length of the shortest run was worked out by hand.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use petril::flat::Hazard;
use petril::translate::System;
use petril::verdict::{Outcome, Report, Trace, Verdict};
use petril::witness::ScanTrace;
use support::forms::EXAMPLES;
use support::reports::{counterexample, report, values, verdicts};
use support::systems::system;

fn read(path: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

fn checked(program: &str, plant: &str) -> (System, Report) {
    let system = system(&read(&format!("examples/{program}.il")), &[&read(&format!("nets/{plant}.net"))]);
    let report = report(&system, &read(&format!("examples/{plant}.req")));
    (system, report)
}

fn violated(report: &Report) -> Vec<&str> {
    verdicts(report).into_iter().filter(|(_, verdict)| *verdict == "violated").map(|(name, _)| name).collect()
}

/// The numbers a variable holds at the ends of the scans of a trace.
fn numbers(system: &System, trace: &ScanTrace, name: &str) -> Vec<i128> {
    let id = system.program.find(name).unwrap();
    let ty = system.program.variable(id).ty;
    trace.scans.iter().map(|scan| ty.number(scan.end.as_ref().unwrap().memory[id.0])).collect()
}

#[test]
fn every_example_is_listed() {
    let files = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples")).unwrap();
    let paths = files.map(|file| file.unwrap().path()).filter(|path| path.extension().is_some_and(|end| end == "il"));
    let found = paths.map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned());
    // What belongs to a specification of safety functions has no plant.
    let found: BTreeSet<String> = found.filter(|name| !name.starts_with("beam-interlock")).collect();
    assert_eq!(found, EXAMPLES.iter().map(|(name, _)| (*name).to_owned()).collect());
}

/// Nothing is undecided, every scan ends, nothing overflows, and no requirement holds for the want of a case. Two of the
/// broken machines are otherwise: one overflows, and one lacks the states that a requirement is about.
#[test]
fn every_requirement_is_decided_and_says_something() {
    let otherwise = ["bottle-counter-broken", "emergency-stop-broken"];
    for (program, plant) in EXAMPLES.into_iter().filter(|(program, _)| !otherwise.contains(program)) {
        let (_, report) = checked(program, plant);
        assert!(report.exploration.complete);
        assert_eq!(report.checks.iter().map(|check| check.outcome.verdict()).max(), Some(Verdict::Holds), "{program}");
        for answer in &report.answers {
            let vacuous = matches!(&answer.outcome, Outcome::Holds { vacuous: Some(_), .. });
            assert!(!vacuous && answer.outcome.verdict() != Verdict::Unknown, "{program}: {}", answer.name);
        }
    }
}

#[test]
fn machines_that_are_right_keep_what_they_promise() {
    let machines = [
        ("bottle-counter", 9, 527),
        ("drill-station", 8, 0),
        ("emergency-stop", 12, 56),
        ("latching-starter", 8, 0),
        ("reversing-motor", 7, 0),
        ("star-delta", 11, 255),
        ("tank", 10, 560),
        ("two-hand-control", 12, 23),
    ];
    for (program, requirements, states) in machines {
        let (_, report) = checked(program, program);
        assert_eq!((violated(&report), report.answers.len()), (vec![], requirements), "{program}");
        assert!(states == 0 || report.exploration.states == states, "{program}: {}", report.exploration.states);
    }
}

#[test]
fn two_hand_switches_break_only_what_they_must() {
    let (_, report) = checked("two-hand-switch", "two-hand-switch");
    assert_eq!(violated(&report), ["synchronous"]);
    let (_, report) = checked("two-hand-switch-broken", "two-hand-switch");
    assert_eq!(violated(&report), ["no_restart", "synchronous"]);
}

/// A contactor that was closed in one scan needs: a scan that drives it, one in which it closes and is switched off, one that
/// drives the other although it has not opened yet, one in which the other closes.
#[test]
fn the_broken_reversing_motor_makes_a_short_circuit_in_four_scans() {
    let (system, report) = checked("reversing-motor-broken", "reversing-motor");
    assert_eq!(violated(&report), ["no_short_circuit", "waits_for_opening"]);
    let names = ["Drive_F", "Drive_R", "Closed_F", "Closed_R"];
    let short_circuit = values(&system, counterexample(&report, "no_short_circuit"), &names);
    assert_eq!(short_circuit.len(), 4);
    assert_eq!(&short_circuit[3][2..], "11");
    let early = values(&system, counterexample(&report, "waits_for_opening"), &names);
    assert_eq!(early.len(), 3);
    assert!(["1001", "0110"].contains(&early[2].as_str()), "{early:?}");
}

/// The belt stands in the first scan; then a tray comes in every second scan at best. Five trays of 40 are 200. With seven
/// trays 240 is passed the first time: 248 = 2 * 24 + 5 * 40 still fits, 264 = 24 + 6 * 40 does not.
#[test]
fn the_broken_bottle_counter_overflows_with_the_seventh_tray() {
    let (system, report) = checked("bottle-counter-broken", "bottle-counter");
    assert_eq!(violated(&report), ["load", "full_pallets"]);
    let bottles = |trace| numbers(&system, trace, "Bottles");
    let load = bottles(counterexample(&report, "load"));
    assert_eq!((load.len(), load[13]), (14, 248));
    let full = bottles(counterexample(&report, "full_pallets"));
    assert_eq!((full.len(), full[9]), (10, 200));
    let overflow = report.checks.iter().find(|check| check.name == "overflow").unwrap();
    let Some(Trace::Scans(run)) = overflow.outcome.witness().map(|witness| &witness.trace) else {
        panic!("{overflow:?}")
    };
    assert_eq!((run.scans.len(), run.scans[13].hazard.map(|(_, hazard)| hazard)), (14, Some(Hazard::Overflow)));
    assert_eq!(*bottles(run).last().unwrap(), 8, "264 - 256");
    // What comes after the overflow is not known.
    let unknown = report.answers.iter().filter(|answer| answer.outcome.verdict() == Verdict::Unknown);
    assert_eq!((unknown.count(), report.answers.len()), (7, 9));
}

/// From 30, where the inlet opens, to 80 there are five steps, and the tank gets leave for one after each scan. The last two
/// are made between the same two scans.
#[test]
fn the_broken_tank_misses_a_level_in_six_scans() {
    let (system, report) = checked("tank-broken", "tank");
    assert_eq!(violated(&report), ["closes"]);
    let level = numbers(&system, counterexample(&report, "closes"), "Level");
    assert_eq!((level.len(), level[4], level[5]), (6, 60, 80));
    assert_eq!(report.exploration.states, 640);
}

/// Activated with no hand on a button, both pressed, one released, the same pressed again.
#[test]
fn the_broken_two_hand_control_works_with_one_hand_in_four_scans() {
    let (system, report) = checked("two-hand-control-broken", "two-hand-control");
    assert_eq!(violated(&report), ["no_restart", "locks"]);
    let run = counterexample(&report, "no_restart");
    assert_eq!(numbers(&system, run, "Close"), [0, 1, 0, 1]);
    let codes = numbers(&system, run, "Code");
    assert!([0x8808, 0x880A].contains(&codes[2]), "{codes:X?}");
    assert_eq!([codes[0], codes[1], codes[3]], [0x8001, 0x8000, 0x8000]);
    assert_eq!(report.exploration.states, 20);
}

/// Activated in one scan, on in the next, though Reset was TRUE in both.
#[test]
fn the_broken_emergency_stop_takes_a_jammed_button_for_a_reset() {
    let (system, report) = checked("emergency-stop-broken", "emergency-stop");
    assert_eq!(violated(&report), ["reset_edge", "unlocking", "start_bridge", "both_errors"]);
    let lengths = ["reset_edge", "unlocking", "start_bridge"].map(|name| counterexample(&report, name).scans.len());
    assert_eq!(lengths, [2, 2, 4]);
    let run = counterexample(&report, "reset_edge");
    assert_eq!(values(&system, run, &["Acknowledge", "Release"]), ["10", "11"]);
    let vacuous = |outcome: &Outcome| matches!(outcome, Outcome::Holds { vacuous: Some(_), .. });
    let empty: Vec<&str> = report.answers.iter().filter(|a| vacuous(&a.outcome)).map(|a| a.name.as_str()).collect();
    assert_eq!(empty, ["jammed"], "it has no state for that");
    assert_eq!(report.exploration.states, 52);
}

/// Start in the first scan, star closed in the second; 1 s later, in scan 22, it is switched off, 100 ms later, in scan 24,
/// delta is driven, and closed in scan 25. Star is still closed.
#[test]
fn the_broken_star_delta_starter_makes_a_short_circuit_in_25_scans() {
    let (system, report) = checked("star-delta-broken", "star-delta");
    assert_eq!(violated(&report), ["no_short_circuit", "stuck_star"]);
    let run = counterexample(&report, "no_short_circuit");
    let contactors = values(&system, run, &["Star", "Delta", "Star_Closed", "Delta_Closed"]);
    assert_eq!(contactors.len(), 25);
    assert_eq!(contactors[0], "1000");
    assert!(contactors[1..21].iter().all(|scan| scan == "1010"), "{contactors:?}");
    assert_eq!(contactors[21..], ["0010", "0010", "0110", "0111"]);
    assert_eq!(numbers(&system, run, "Star_Time.ET")[20..22], [950, 1000]);
    assert_eq!(counterexample(&report, "stuck_star").scans.len(), 24);
    assert_eq!(report.exploration.states, 432);
}

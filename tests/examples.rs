//! Every example, with the verdict on every requirement. What they should be can be read off the machines; where one is
//! violated, the length of the shortest run was worked out by hand.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

mod support;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use petril::translate::System;
use petril::verdict::{Outcome, Report, Verdict};
use support::reports::{counterexample, report, values, verdicts};
use support::systems::system;

/// Examples and the nets they are checked with.
const EXAMPLES: [(&str, &str); 6] = [
    ("drill-station", "drill-station"),
    ("latching-starter", "latching-starter"),
    ("reversing-motor", "reversing-motor"),
    ("reversing-motor-broken", "reversing-motor"),
    ("two-hand-switch", "two-hand-switch"),
    ("two-hand-switch-broken", "two-hand-switch"),
];

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

#[test]
fn every_example_is_listed() {
    let files = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples")).unwrap();
    let paths = files.map(|file| file.unwrap().path()).filter(|path| path.extension().is_some_and(|end| end == "il"));
    let found: BTreeSet<String> = paths.map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned()).collect();
    assert_eq!(found, EXAMPLES.iter().map(|(name, _)| (*name).to_owned()).collect());
}

/// Nothing is undecided, every scan ends, and no requirement holds for the want of a case.
#[test]
fn every_requirement_is_decided_and_says_something() {
    for (program, plant) in EXAMPLES {
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
    for (program, requirements) in [("drill-station", 8), ("latching-starter", 8), ("reversing-motor", 7)] {
        let (_, report) = checked(program, program);
        assert_eq!((violated(&report), report.answers.len()), (vec![], requirements), "{program}");
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

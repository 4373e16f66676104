//! What is known is printed at once, and long work gives signs of life.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::Mutex;

use petril::explore::Progress;
use petril::logic::{Demand, Requirement, View, bind_requirement, parse_requirement};
use petril::source::Source;
use petril::translate::{Plant, System};
use petril::verdict::{News, Options, check, check_aloud, check_knowing, check_knowing_aloud};
use support::process::run;
use support::program;

const PROGRAM: &str = "\
PROGRAM p
VAR_INPUT a, b : BOOL; END_VAR
VAR_OUTPUT q : BOOL; END_VAR
VAR m : BOOL; END_VAR
    LD a
    OR m
    ST m
    AND b
    ST q
END_PROGRAM
";

/// Twenty requirements, some of which remember, so that they are judged in several groups.
fn requirements(system: &System) -> Vec<(Requirement, Demand)> {
    let formulas = ["AG !q", "AG (q -> m)", "EF q", "AG (rising(q) -> b)", "AG (q -> AX q)"];
    let bound = |i: usize| {
        let requirement = parse_requirement(&format!("r{i}"), &Source::new("r", formulas[i % 5])).unwrap();
        let demand = bind_requirement(&requirement, system, View::Scan).unwrap();
        (requirement, demand)
    };
    (0..20).map(bound).collect()
}

/// What is heard is what the report says, in its order, after what was explored.
#[test]
fn what_is_told_is_what_is_reported() {
    let system = System::new(program(PROGRAM), Plant::default());
    let asked = requirements(&system);
    let options = Options::default();
    let watch = &mut |_: &Progress| None;
    let expected = check(&system, &asked, &options, watch);
    let heard = Mutex::new(Vec::new());
    let tell = |news: News<'_>| {
        heard.lock().unwrap().push(match news {
            News::Explored(report) => {
                assert!(report.answers.is_empty());
                format!("{:?} {:?}", report.exploration, report.assumptions)
            }
            News::Answered(position, answer) => format!("{position} {answer:?}"),
        });
    };
    let mut texts = vec![format!("{:?} {:?}", expected.exploration, expected.assumptions)];
    texts.extend(expected.answers.iter().enumerate().map(|(position, answer)| format!("{position} {answer:?}")));
    let report = check_aloud(&system, &asked, &options, watch, Some(&tell));
    assert_eq!(*heard.lock().unwrap(), texts);
    assert_eq!(format!("{report:?}"), format!("{expected:?}"));

    // What is known already, of three formulas, comes at its place.
    let (_, known) = check_knowing(&system, &asked[5..8], &options, None, watch);
    heard.lock().unwrap().clear();
    let (report, _) = check_knowing_aloud(&system, &asked, &options, known.as_ref(), watch, Some(&tell));
    let mut texts = vec![format!("{:?} {:?}", report.exploration, report.assumptions)];
    texts.extend(report.answers.iter().enumerate().map(|(position, answer)| format!("{position} {answer:?}")));
    assert_eq!(*heard.lock().unwrap(), texts);
    assert!(
        report.answers.iter().any(|answer| answer.recalled) && report.answers.iter().any(|answer| !answer.recalled)
    );
}

fn command(folder: &Path, more: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_petril"));
    command.args(["check", "count.il", "-r", "AG !q"]).args(more).current_dir(folder);
    command
}

/// A program with many states: the sum of many inputs.
fn many_states(folder: &Path) {
    let text = "PROGRAM count\nVAR_INPUT a : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\nVAR n, m : INT; END_VAR\n\
        LD a\nJMPC up\nLD n\nADD 1\nST n\nJMP done\nup:\nLD m\nADD 1\nST m\ndone:\nLD FALSE\nST q\nEND_PROGRAM\n";
    fs::write(folder.join("count.il"), text).unwrap();
}

/// A pipe hears that work goes on; a short run is silent, and so is one that is told to be.
#[test]
fn a_pipe_gets_a_sign_of_life() {
    let folder = tempfile::tempdir().unwrap();
    many_states(folder.path());
    let run_with = |pause: &str, states: &str| {
        let mut command = command(folder.path(), &["--max-states", states]);
        command.env("PETRIL_PROGRESS", pause);
        run(command)
    };
    let told = run_with("0.02", "60000");
    let lines: Vec<&str> = told.stderr.lines().collect();
    assert!(lines.iter().any(|line| line.contains(" states, ")), "{}\n{}", told.stderr, told.stdout);
    for line in lines {
        let rest = line.strip_prefix("petril: ").unwrap_or_else(|| panic!("{line}"));
        let (seconds, rest) = rest.split_once(" s").unwrap_or_else(|| panic!("{line}"));
        assert!(seconds.parse::<u64>().is_ok(), "{line}");
        assert!(rest.starts_with(", ") && rest.len() > 2, "{line}");
    }
    assert_eq!(run_with("0", "60000").stderr, "");
    assert_eq!(run_with("", "100").stderr, "");
}

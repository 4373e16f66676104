//! Long runs are told shortly: stretches in which only clocks and counters go on are folded, by hand-made runs and at the command line.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use petril::explore::ScanState;
use petril::flat::{FlatProgram, Hazard};
use petril::semantics::VarId;
use petril::witness::{Fold, Moved, Piece, PlantMove, Scan, ScanTrace, fold};
use support::assembler::assemble;
use support::process::{Run, petril};

/// A run of a program without instructions whose memory is given by scan, from 1.
fn run(program: &FlatProgram, scans: u64, memory: impl Fn(u64) -> Vec<u64>) -> ScanTrace {
    let scan = |position| {
        let memory: Vec<u64> = memory(position);
        let input = |id: VarId| (id, memory[id.0]);
        let inputs = program.with_role(petril::semantics::Role::Input).map(input).collect();
        Scan { moves: Vec::new(), inputs, end: Some(ScanState { plant: Vec::new(), memory }), hazard: None }
    };
    ScanTrace { scans: (1..=scans).map(scan).collect(), loop_start: None }
}

fn folded(program: &FlatProgram, trace: &ScanTrace, kept: &[usize]) -> Vec<Piece> {
    let shown: Vec<VarId> = program.declared().collect();
    fold(program, trace, &shown, &kept.iter().copied().collect())
}

/// The pieces in short: scans from 1, stretches as `first-last`.
fn short(pieces: &[Piece]) -> String {
    let texts = pieces.iter().map(|piece| match piece {
        Piece::Scan(scan) => format!("{}", scan + 1),
        Piece::Fold(fold) => format!("{}-{}", fold.first + 1, fold.last + 1),
    });
    texts.collect::<Vec<_>>().join(" ")
}

fn folds(pieces: &[Piece]) -> Vec<&Fold> {
    pieces.iter().filter_map(|piece| if let Piece::Fold(fold) = piece { Some(fold) } else { None }).collect()
}

/// Every scan is shown, or in one stretch, in order.
fn assert_whole(pieces: &[Piece], trace: &ScanTrace) {
    let all = pieces.iter().flat_map(|piece| match piece {
        Piece::Scan(scan) => *scan..=*scan,
        Piece::Fold(fold) => fold.first..=fold.last,
    });
    assert_eq!(all.collect::<Vec<_>>(), (0..trace.scans.len()).collect::<Vec<_>>());
}

#[test]
fn a_counter_and_a_clock_are_folded_and_the_ends_are_shown() {
    let program = assemble("in start BOOL\nvar ET TIME\nvar n INT\nout q BOOL", "");
    // The clock stands in scan 1 and then goes on by 20 ms a scan; the output comes in scan 500.
    let trace = run(&program, 500, |scan| vec![1, (scan - 1) * 20, scan, u64::from(scan == 500)]);
    let pieces = folded(&program, &trace, &[]);
    // In scan 1 the clock makes no step, in scan 2 one of 20 ms, in all others the same.
    assert_eq!(short(&pieces), "1 2 3-499 500");
    assert_whole(&pieces, &trace);
    let fold = folds(&pieces)[0];
    let moved = |variable, from, to| Moved { variable: VarId(variable), from, to };
    assert_eq!(fold.moved, [moved(1, 20, 9960), moved(2, 2, 499)]);
    assert_eq!((fold.scans(), fold.period, fold.turns.len()), (497, 1, 0));
    assert_eq!(fold.title(), "497 scans");
    assert_eq!(fold.movements(&program, "→"), ["ET T#20ms → T#9s960ms", "n 2 → 499"]);
}

#[test]
fn counters_may_go_down_below_zero_and_a_wrap_is_shown() {
    let program = assemble("in a BOOL\nvar n SINT 100", "");
    // 99 … -128, then 127 …: the pattern of an 8-bit number.
    let trace = run(&program, 250, |scan| vec![0, (100_u64.wrapping_sub(scan)) & 0xFF]);
    let pieces = folded(&program, &trace, &[]);
    // -128 is reached after scan 228; scan 229 wraps, and scan 230 makes another step than that.
    assert_eq!(short(&pieces), "1 2-228 229 230 231-249 250");
    let movements: Vec<Vec<String>> = folds(&pieces).iter().map(|fold| fold.movements(&program, "->")).collect();
    assert_eq!(movements, [["n 99 -> -128"], ["n 126 -> 107"]]);
}

#[test]
fn an_input_that_changes_breaks_a_stretch() {
    let program = assemble("in a BOOL\nin level INT\nvar n INT", "");
    let trace = run(&program, 40, |scan| vec![u64::from(scan == 20), 7, scan]);
    assert_eq!(short(&folded(&program, &trace, &[])), "1 2-19 20 21 22-39 40");
    // A number that is read is no counter, however even its steps are.
    let trace = run(&program, 40, |scan| vec![0, scan, scan]);
    assert_eq!(folds(&folded(&program, &trace, &[])).len(), 0);
    // Nor is one that makes another step.
    let trace = run(&program, 40, |scan| vec![0, 0, if scan < 20 { scan } else { scan + 5 }]);
    assert_eq!(short(&folded(&program, &trace, &[])), "1 2-19 20 21 22-39 40");
}

#[test]
fn what_the_plant_does_and_an_error_break_a_stretch() {
    let program = assemble("in a BOOL\nvar n INT", "");
    let mut trace = run(&program, 40, |scan| vec![0, scan]);
    trace.scans[19].moves.push(PlantMove { component: 0, transition: 0 });
    assert_eq!(short(&folded(&program, &trace, &[])), "1 2-19 20 21 22-39 40");
    let mut trace = run(&program, 40, |scan| vec![0, scan]);
    trace.scans[24].hazard = Some((0, Hazard::Overflow));
    assert_eq!(short(&folded(&program, &trace, &[])), "1 2-24 25 26-39 40");
}

#[test]
fn scans_that_are_spoken_of_are_shown() {
    let program = assemble("in a BOOL\nvar n INT", "");
    let mut trace = run(&program, 60, |scan| vec![0, scan]);
    let pieces = folded(&program, &trace, &[30]);
    assert_eq!(short(&pieces), "1 2-30 31 32-59 60");
    assert_whole(&pieces, &trace);
    // A lasso's first scan too, and no stretch goes beyond it.
    trace.loop_start = Some(9);
    assert_eq!(short(&folded(&program, &trace, &[])), "1 2-9 10 11-59 60");
}

#[test]
fn short_stretches_and_hidden_variables() {
    let program = assemble("in a BOOL\nvar n INT\nvar hidden BOOL", "");
    // Of 9 scans 7 could be hidden: too few.
    let trace = run(&program, 9, |scan| vec![0, scan, 0]);
    assert_eq!(folds(&folded(&program, &trace, &[])).len(), 0);
    let trace = run(&program, 10, |scan| vec![0, scan, 0]);
    assert_eq!(short(&folded(&program, &trace, &[])), "1 2-9 10");
    // A variable that is not shown breaks nothing.
    let trace = run(&program, 40, |scan| vec![0, scan, u64::from(scan * scan % 7 == 2)]);
    assert_eq!(folds(&folded(&program, &trace, &[])).len(), 0);
    let shown = [VarId(0), VarId(1)];
    assert_eq!(short(&fold(&program, &trace, &shown, &BTreeSet::new())), "1 2-39 40");
}

#[test]
fn values_in_turn_are_told() {
    let program = assemble("in pulse BOOL\nvar n INT\nout lamp BOOL", "");
    // 1 0 1 0 …; the counter counts each rising edge; a lamp takes four scans.
    let trace = run(&program, 60, |scan| vec![scan % 2, scan.div_ceil(2), u64::from(scan % 4 == 0)]);
    let pieces = folded(&program, &trace, &[]);
    assert_eq!(short(&pieces), "1 2 3 4 5-59 60");
    let fold = folds(&pieces)[0];
    assert_eq!(fold.title(), "55 scans, every 4 alike");
    assert_eq!(fold.movements(&program, "→"), ["n 2 → 30", "pulse 1, 0, 1, 0 in turn", "lamp 0, 0, 0, 1 in turn"]);
    assert_whole(&pieces, &trace);
}

/// A timer of 500 ms that comes after 26 scans of 20 ms, a counter beside it, and a requirement that both break.
const PROGRAM: &str = "\
PROGRAM long
VAR_INPUT start : BOOL; END_VAR
VAR_OUTPUT q : BOOL; END_VAR
VAR t : TON; n : SINT; END_VAR
    LD  start
    JMPC on
    LD  0
    ST  n
    JMP call
on:
    LD  n
    ADD 1
    ST  n
call:
    CAL t(IN := start, PT := T#500ms)
    LD  t.Q
    ST  q
END_PROGRAM
";

fn check(folder: &Path, more: &[&str]) -> Run {
    fs::write(folder.join("long.il"), PROGRAM).unwrap();
    petril(folder, &[&["check", "long.il", "--ascii", "--overflow", "wrap", "-r", "AG !q"], more].concat())
}

/// The rows of the first table of scans in a text.
fn table(text: &str) -> Vec<String> {
    let lines = text.lines().skip_while(|line| !line.trim_start().starts_with("scan |"));
    lines.take_while(|line| !line.trim().is_empty()).map(|line| line.trim().to_owned()).collect()
}

#[test]
fn a_timer_at_the_command_line() {
    let folder = tempfile::tempdir().unwrap();
    let run = check(folder.path(), &[]);
    assert_eq!(run.code, 1, "{}", run.stderr);
    // The clock begins to run in scan 1 and is 20 ms in scan 2; after scan 26, 25 steps later, it has reached 500 ms.
    let expected = "\
scan | start | t.IN     t.PT t.Q        t.ET   n | q
-----+-------+--------------------------------------+---
   1 |    *1 |   *1 *T#500ms   0        T#0ms  *1 |  0
   2 |     1 |    1  T#500ms   0      *T#20ms  *2 |  0
... 23 scans: t.ET T#20ms -> T#480ms, n 2 -> 25 ...
  26 |    !1 |    1  T#500ms  *1    *T#500ms *26 | *1";
    let squeezed = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ").replace('-', "");
    let rows: Vec<String> = table(&run.stdout).iter().map(|row| squeezed(row)).collect();
    let expected: Vec<String> = expected.lines().map(squeezed).collect();
    // The rule between head and rows is as wide as they are.
    assert_eq!(rows[2..], expected[2..], "{}", run.stdout);
    assert_eq!(rows[0], expected[0], "{}", run.stdout);
}

#[test]
fn columns_are_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let heads = |more: &[&str]| {
        let run = check(folder.path(), more);
        assert_eq!(run.code, 1, "{}", run.stderr);
        table(&run.stdout)[0].split_whitespace().filter(|word| *word != "|").map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(heads(&["--show", "n,q"]), ["scan", "n", "q"]);
    assert_eq!(heads(&["--show", "T.?", "--show", "START"]), ["scan", "start", "t.Q"], "in any case of letters");
    let all = ["scan", "q", "start", "t.IN", "t.PT", "t.Q", "t.ET", "t.RUNNING", "t.CLOCK", "n"];
    let mut found = heads(&["--show", "all"]);
    assert_eq!(found.len(), all.len());
    found.sort();
    let mut all: Vec<String> = all.map(str::to_owned).into();
    all.sort();
    assert_eq!(found, all);
    assert_eq!(table(&check(folder.path(), &["--every-scan", "--show", "n"]).stdout).len(), 2 + 26);
    let run = check(folder.path(), &["--show", "t.R"]);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""));
    assert!(run.stderr.contains("--show: no variable of the program is called `t.R`"), "{}", run.stderr);
}

/// What a requirement speaks of is shown even where it is local to an instance, and stands first in a wide table.
#[test]
fn what_a_requirement_speaks_of_comes_first() {
    let folder = tempfile::tempdir().unwrap();
    let program = PROGRAM.replace("n : SINT;", "n, m, k : SINT; a, b : BOOL;");
    fs::write(folder.path().join("wide.il"), program).unwrap();
    let run = petril(folder.path(), &["check", "wide.il", "--overflow", "wrap", "-r", "AG !(t.RUNNING & n = 20)"]);
    assert_eq!(run.code, 1, "{}", run.stderr);
    assert!(table(&run.stdout)[0].starts_with("scan | start t.RUNNING   n | "), "{}", run.stdout);
    assert!(!run.stdout.contains("t.CLOCK"), "{}", run.stdout);
}

/// Wide tables are split where the terminal ends, with the stretches in each part.
#[test]
fn a_narrow_terminal_is_kept_to() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("long.il"), PROGRAM).unwrap();
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_petril"));
    command.args(["check", "long.il", "--ascii", "--details", "--overflow", "wrap", "-r", "AG !q"]);
    let output = command.current_dir(folder.path()).env("COLUMNS", "44").output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let lines = text.lines().skip_while(|line| !line.contains("scan |"));
    let lines: Vec<&str> = lines.take_while(|line| !line.contains("line by line")).collect();
    let widest = lines.iter().max_by_key(|line| line.chars().count()).unwrap();
    assert!(widest.chars().count() <= 44, "{widest}");
    assert!(lines.len() < 60, "the diagram is folded, too: {text}");
}

/// Programs are given everything; forms for people are folded.
#[test]
fn json_keeps_every_scan_and_junit_is_folded() {
    let folder = tempfile::tempdir().unwrap();
    let run = check(folder.path(), &["--json", "--junit", "r.xml", "--csv", "r.csv", "--trace-csv", "runs"]);
    let report: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
    let scans = report["requirements"][0]["trace"]["scans"].as_array().unwrap();
    assert_eq!(scans.len(), 26);
    assert!(scans.iter().all(|scan| scan["memory"]["t.CLOCK"].is_number()), "{scans:#?}");
    let junit = fs::read_to_string(folder.path().join("r.xml")).unwrap();
    assert!(junit.contains("… 23 scans: t.ET T#20ms → T#480ms, n 2 → 25 …"), "{junit}");
    let inputs = fs::read_to_string(folder.path().join("runs/AG !q.csv".replace([' ', '!'], "_")));
    let inputs = inputs.or_else(|_| {
        let file = fs::read_dir(folder.path().join("runs")).unwrap().next().unwrap().unwrap().path();
        fs::read_to_string(file)
    });
    assert_eq!(inputs.unwrap().lines().count(), 1 + 26, "what is simulated again is whole");
}

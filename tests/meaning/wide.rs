//! Programs with numbers in the scan view, against figures worked out by hand. They are flat code, whatever the front end
//! can read.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::exchange::{Checked, Provenance, json};
use petril::flat::{FlatProgram, Hazard, Tolerated};
use petril::logic::{
    View, bind, bind_domain, bind_requirement, parse_domain, parse_formula, parse_requirement, parse_requirements,
};
use petril::source::Source;
use petril::translate::{Domains, Plant, System};
use petril::verdict::{Answer, Options, Outcome, Report, Trace, check};
use petril::witness::{ScanTrace, line_by_line, scan_table};
use support::assembler::assemble;

const WRAP: Tolerated = Tolerated { overflow: true, division_by_zero: false };

/// A system whose free inputs have these domains.
fn system(program: FlatProgram, domains: &[&str]) -> System {
    let mut bound = Domains::new();
    for text in domains {
        let domain = parse_domain(&Source::new("domain", *text)).unwrap();
        bind_domain(&domain, &program, &Plant::default(), &mut bound).unwrap();
    }
    System::with_domains(program, Plant::default(), bound)
}

/// The report on some formulas, named r1, r2, ….
fn report(system: &System, formulas: &[&str], tolerated: Tolerated) -> Report {
    let text: String = (1..).zip(formulas).map(|(i, formula)| format!("requirement r{i}: {formula};\n")).collect();
    let (file, errors) = parse_requirements(&Source::new("requirements", text));
    assert!(errors.is_empty() || formulas.is_empty(), "{errors:#?}");
    let bound = file.requirements.into_iter().map(|requirement| {
        let bound = bind_requirement(&requirement, system, View::Scan).unwrap_or_else(|e| panic!("{e:#?}"));
        (requirement, bound)
    });
    check(system, &bound.collect::<Vec<_>>(), &Options { tolerated, ..Options::default() }, &mut |_| None)
}

/// The verdicts, each in one word: first the checks' that are made without asking, then the requirements'.
fn verdicts(report: &Report) -> Vec<String> {
    let word = |answer: &Answer| format!("{} {}", answer.name, answer.outcome.verdict().word());
    report.checks.iter().chain(&report.answers).map(word).collect()
}

fn trace<'r>(report: &'r Report, name: &str) -> &'r ScanTrace {
    let answer = report.checks.iter().chain(&report.answers).find(|answer| answer.name == name).unwrap();
    match answer.outcome.witness().map(|witness| &witness.trace) {
        Some(Trace::Scans(trace)) => trace,
        _ => panic!("{answer:?}"),
    }
}

/// The values of a variable at the ends of the scans of a trace.
fn values(system: &System, trace: &ScanTrace, name: &str) -> Vec<i128> {
    let id = system.program.find(name).unwrap();
    let ty = system.program.variable(id).ty;
    trace.scans.iter().map(|scan| ty.number(scan.end.as_ref().unwrap().memory[id.0])).collect()
}

fn reason<'r>(report: &'r Report, name: &str) -> &'r str {
    match &report.checks.iter().chain(&report.answers).find(|answer| answer.name == name).unwrap().outcome {
        Outcome::Unknown(reason) => reason,
        other => panic!("{other:?}"),
    }
}

/// Starts at 250 and counts: 251, …, 255 are five states, and the sixth scan overflows.
fn counter() -> System {
    system(assemble("var c USINT 250", "LD c\nADD 1\nST c"), &[])
}

#[test]
fn an_overflow_ends_what_is_known() {
    let system = counter();
    let report = report(&system, &["AG (c >= 251)", "EF (c = 255)", "AG (c < 255)"], Tolerated::default());
    assert_eq!((report.exploration.states, report.exploration.depth), (5, 5));
    assert!(!report.exploration.complete);
    assert_eq!(verdicts(&report), ["scan-ends holds", "overflow violated", "r1 unknown", "r2 holds", "r3 violated"]);
    let run = trace(&report, "overflow");
    assert_eq!(run.scans.len(), 6);
    assert_eq!(run.scans[5].hazard, Some((1, Hazard::Overflow)), "in the second line");
    assert_eq!(values(&system, run, "c"), [251, 252, 253, 254, 255, 0]);
    assert_eq!(trace(&report, "r3").scans.len(), 5);
    assert!(reason(&report, "r1").contains("`--overflow wrap`"), "{}", reason(&report, "r1"));
}

#[test]
fn a_tolerated_overflow_is_an_assumption() {
    let system = counter();
    let report = report(&system, &["AG (c >= 251)", "AG AF (c = 0)"], WRAP);
    assert_eq!((report.exploration.states, report.exploration.depth), (256, 256));
    assert_eq!(verdicts(&report), ["scan-ends holds", "r1 violated", "r2 holds"]);
    assert_eq!(values(&system, trace(&report, "r1"), "c"), [251, 252, 253, 254, 255, 0]);
    assert!(report.assumptions.contains(&"numbers that do not fit their type wrap around".to_owned()));
}

#[test]
fn inputs_have_the_values_of_their_domains() {
    let program = || assemble("in k INT\nin b BOOL\nout twice INT", "LD k\nADD k\nST twice");
    let small = system(program(), &["K: 7, -3..-2, INT#7"]);
    let formulas = [
        "AG (twice = k + k)",
        "AG (k != 0 & k != -1 & k <= 7)",
        "AG (twice = 14 | twice < -2)",
        "EF (k = -3 & b)",
        "AG (k > -3)",
        "AG (twice * k = 18 -> k = -3)",
        "AG (b + k != -1)",
    ];
    let small_report = report(&small, &formulas, Tolerated::default());
    // 7, -3, -2 with b or without.
    assert_eq!(small_report.exploration.states, 6);
    assert_eq!(
        verdicts(&small_report),
        [
            "scan-ends holds",
            "overflow holds",
            "r1 holds",
            "r2 holds",
            "r3 holds",
            "r4 holds",
            "r5 violated",
            "r6 holds",
            "r7 violated"
        ]
    );
    assert_eq!(values(&small, trace(&small_report, "r7"), "k"), [-2]);
    assert!(small_report.assumptions.contains(&"k may have any of 3 values in any scan: -3..-2, 7".to_owned()));
    assert!(small_report.assumptions.contains(&"b may have any value in any scan".to_owned()));
    let all = system(program(), &[]);
    let all_report = report(&all, &["AG (twice = 2 * k)"], WRAP);
    // 2^16 values of k, two of b; 16384 is the first whose double does not fit.
    assert_eq!(all_report.exploration.states, 1 << 17);
    assert_eq!(verdicts(&all_report), ["scan-ends holds", "r1 violated"]);
    assert_eq!(values(&all, trace(&all_report, "r1"), "k"), [16384]);
}

#[test]
fn too_many_values_of_inputs_are_not_tried() {
    let program = || assemble("in level DINT\nin on BOOL\nout high BOOL", "LD level\nGT 100\nAND on\nST high");
    let all = report(&system(program(), &[]), &["AG (high -> level > 100)"], Tolerated::default());
    assert_eq!(verdicts(&all), ["scan-ends unknown", "r1 unknown"]);
    for part in ["`level` (4294967296 values)", "`--domain 'level: 0..100'`"] {
        assert!(reason(&all, "r1").contains(part), "{}", reason(&all, "r1"));
    }
    let some = report(&system(program(), &["level: 99..102"]), &["AG (high -> level > 100)"], Tolerated::default());
    assert_eq!(some.exploration.states, 8);
    assert_eq!(verdicts(&some), ["scan-ends holds", "r1 holds"]);
}

#[test]
fn divisors_indices_and_subranges_are_checked() {
    let program = assemble(
        "in d INT\nout q INT\nvar s INT",
        "LD INT#100\nDIV d\nST q\nLD d\nSUBRANGE -2..2\nST s\nINDEX 0..3\nST s",
    );
    let system = system(program, &["d: -1..3"]);
    let strict = report(&system, &[], Tolerated::default());
    // 100 / -1 fits. 0 divides; 3 leaves the subrange, which comes before its index; -1 is no index.
    let expected =
        ["scan-ends holds", "overflow unknown", "division-by-zero violated", "index violated", "subrange violated"];
    assert_eq!(verdicts(&strict), expected);
    let met = |name| (trace(&strict, name).scans[0].inputs[0].1, trace(&strict, name).scans[0].hazard);
    assert_eq!(met("division-by-zero"), (0, Some((1, Hazard::DivisionByZero))));
    assert_eq!(met("index"), (0xFFFF, Some((6, Hazard::Index))));
    assert_eq!(met("subrange"), (3, Some((4, Hazard::Subrange))));
    assert_eq!(strict.exploration.states, 2, "d = 1 and d = 2");
    let zero = Tolerated { division_by_zero: true, ..Tolerated::default() };
    let lenient = report(&system, &["AG (d = 0 -> q != 0)"], zero);
    assert_eq!(lenient.exploration.states, 3);
    assert!(lenient.assumptions.contains(&"a division by zero gives 0".to_owned()));
    assert_eq!(values(&system, trace(&lenient, "r1"), "q"), [0]);
}

#[test]
fn an_error_comes_before_a_loop_without_end() {
    let program = assemble("in d INT\nout q INT", "LD INT#1\nDIV d\nST q\nJMP 3");
    let report = report(&system(program, &["d: 0"]), &[], Tolerated::default());
    assert_eq!(report.checks[2].name, "division-by-zero");
    assert_eq!(report.checks[2].outcome.verdict().word(), "violated");
    let run = trace(&report, "division-by-zero");
    assert_eq!((run.scans.len(), run.scans[0].end.is_none()), (1, true));
}

#[test]
fn every_width_has_its_place_in_a_state() {
    let program = assemble(
        "in b BOOL\nvar big ULINT -1\nvar small LINT -9223372036854775808\nout t TIME\nout w WORD",
        "LD t\nSUB t\nADD 1500\nST t\nLD WORD#16#8001\nST w\nLD b\nJMPCN 13\n\
         LD ULINT#16#FFFF_FFFF_FFFF_FFFE\nST big\nLD LINT#-9223372036854775807\nST small",
    );
    let system = system(program, &[]);
    let formulas = [
        // 2^64 - 1 - 2^63 and 2^64 - 2 - (2^63 - 1)
        "AG (big + small = 9223372036854775807)",
        "AG (b -> big = 16#FFFF_FFFF_FFFF_FFFE & small > -9223372036854775808)",
        "AG (t = T#1s500ms & t < T#2s & t = 1500)",
        "AG (w = 16#8001 & w = 32769 & w > 0)",
        "AG (!b -> big = 16#FFFF_FFFF_FFFF_FFFF)",
    ];
    let report = report(&system, &formulas, Tolerated::default());
    assert_eq!((report.exploration.states, report.exploration.depth), (3, 2), "set, never set, or set before");
    assert_eq!(
        verdicts(&report),
        ["scan-ends holds", "overflow holds", "r1 holds", "r2 holds", "r3 holds", "r4 holds", "r5 violated"]
    );
    let run = trace(&report, "r5");
    assert_eq!(values(&system, run, "small"), [-9_223_372_036_854_775_807; 2]);
    let table = scan_table(&system, run).to_string();
    let last = table.lines().last().unwrap();
    let expected = "   2 | *0 |  18446744073709551614  -9223372036854775807 |  T#1s500ms  16#8001";
    assert_eq!(last, expected, "{table}");
}

#[test]
fn reports_for_programs_have_numbers() {
    let program = assemble(
        "in k SINT\nvar low LINT -9223372036854775808\nvar c USINT 254\nout t TIME 20\nout big ULINT -1",
        "LD c\nADD 1\nST c\nLD low\nST low\nLD t\nST t\nLD big\nST big",
    );
    let system = system(program, &["k: -2"]);
    let report = report(&system, &[], Tolerated::default());
    let source = Source::new("p.il", "");
    let document = json::report(
        &Checked { system: &system, source: &source, report: &report, provenance: &Provenance::default() },
        false,
    );
    let check = &document["checks"][1];
    assert_eq!((check["name"].as_str(), check["verdict"].as_str()), (Some("overflow"), Some("violated")));
    let scans = &check["trace"]["scans"];
    // 255 is the last number; the second scan goes beyond it.
    assert_eq!(scans[0]["memory"]["c"], 255);
    assert_eq!(scans[0].get("hazard"), None);
    assert_eq!((&scans[1]["hazard"]["kind"], &scans[1]["hazard"]["line"]), (&"overflow".into(), &2.into()));
    assert_eq!(scans[1]["inputs"]["k"], -2);
    assert_eq!(scans[0]["memory"]["low"], i64::MIN);
    assert_eq!(scans[0]["outputs"]["t"], 20, "milliseconds");
    assert_eq!(scans[0]["outputs"]["big"], u64::MAX);
    assert_eq!(document["inputs"], serde_json::json!([{ "name": "k", "values": 1 }]));
    let table = scan_table(&system, trace(&report, "overflow")).to_string();
    assert!(table.contains(" -2 ") && table.contains("T#20ms"), "{table}");
}

#[test]
fn an_error_is_told_in_its_line() {
    let system = counter();
    let report = report(&system, &[], Tolerated::default());
    let run = trace(&report, "overflow");
    let lines = line_by_line(&system, run, 5, &Source::new("p.il", "text")).to_string();
    let rows: Vec<Vec<&str>> = lines.lines().skip(2).map(|row| row.split('|').map(str::trim).collect()).collect();
    let told: Vec<&str> = rows.iter().map(|row| row[1]).collect();
    assert_eq!(rows.len(), 3);
    assert_eq!(told, ["255", "0 overflow", "0 c = 0"]);
    let Outcome::Violated(witness, _) = &report.checks[1].outcome else { panic!("{:?}", report.checks[1]) };
    assert_eq!(witness.notes[0].text, "a number did not fit its type in line 2 of the flat code (`ADD 1`)");
}

/// In the transition view the bits of a number are places, and so are hazards.
#[test]
fn the_transition_view_knows_numbers() {
    let program = assemble("in k SINT\nvar c SINT 126\nout high BOOL", "LD c\nADD k\nST c\nGT 100\nST high");
    let system = system(program, &["k: 0..1"]);
    let formulas = [
        "AG (c >= 126 | c = -128 | c <= -127)",
        "EF (c = -128)",
        "AG (at End -> (high <-> c > 100))",
        "AG (k + 1 <= 1)",
    ];
    let answers = formulas.map(|text| {
        let requirement = parse_requirement(text, &Source::new("formula", text)).unwrap();
        let bound = bind_requirement(&requirement, &system, View::Transition).unwrap();
        (requirement, bound)
    });
    let options = Options { view: View::Transition, ..Options::default() };
    let report = check(&system, &answers, &options, &mut |_| None);
    let words: Vec<_> =
        report.checks.iter().chain(&report.answers).map(|answer| answer.outcome.verdict().word()).collect();
    // From -128 on, c comes back to 126 in the end.
    assert_eq!(words, ["holds", "violated", "violated", "holds", "holds", "violated"]);
    assert_eq!(bind_text(&system, "AG (C < 2)"), "AG (c < 2)");
}

fn bind_text(system: &System, text: &str) -> String {
    let formula = parse_formula(&Source::new("formula", text)).unwrap();
    bind(&formula, system, View::Transition).unwrap().text(system)
}

#[test]
fn an_integer_is_no_truth_value() {
    let system = counter();
    let bound = |text: &str| {
        let formula = parse_formula(&Source::new("formula", text)).unwrap();
        bind(&formula, &system, View::Scan).map_err(|errors| (errors[0].code.id(), errors[0].help.join("")))
    };
    let expected = Err(("E0503", "compare it with something, like `c != 0`".to_owned()));
    assert_eq!(bound("AG c"), expected);
    assert_eq!(bound("AG (C & TRUE)"), expected);
    assert!(bound("AG (c + 1 = c * 2)").is_ok());
}

//! Runs from reports, made again: every counterexample of the examples is the same run, and a report in which any one value
//! is another one is refused.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::fs;

use petril::exchange::recorded::{Recorded, recorded};
use petril::exchange::{Checked, Provenance, json};
use petril::explore::ScanState;
use petril::flat::{FlatProgram, Tolerated};
use petril::simulate::scan;
use petril::source::Source;
use petril::translate::{Plant, System};
use petril::verdict::Report;
use petril::witness::Scan;
use serde_json::{Value, json};
use support::reports::report;
use support::systems::system;

/// The report as programs read it.
fn document(system: &System, report: &Report) -> Value {
    let source = Source::new("p", "");
    json::report(&Checked { system, source: &source, report, provenance: &Provenance::default() }, false)
}

/// The run, made again; or where it differs.
fn again(system: &System, run: &Recorded) -> Result<Vec<Scan>, String> {
    let mut state = ScanState::power_on(system);
    let mut scans = Vec::new();
    for position in 0..run.plans.len() {
        let made = scan(system, Tolerated::default(), &state, &run.plan(position));
        let (made, _) = made.map_err(|impossible| impossible.to_string())?;
        if let Some(difference) = run.difference(&system.program, position, &made) {
            return Err(difference);
        }
        if let Some(end) = &made.end {
            state = end.clone();
        }
        scans.push(made);
    }
    Ok(scans)
}

/// The declared variables at the end of each scan.
fn values(program: &FlatProgram, scans: &[Scan]) -> Vec<Option<Vec<u64>>> {
    let value = |scan: &Scan| Some(program.declared().map(|id| scan.end.as_ref().unwrap().memory[id.0]).collect());
    scans.iter().map(|scan| scan.end.as_ref().and_then(|_| value(scan))).collect()
}

#[test]
fn every_run_of_the_examples() {
    let mut runs = 0;
    for (program, plant) in [
        ("two-hand-switch", Some("two-hand-switch")),
        ("two-hand-switch-broken", Some("two-hand-switch")),
        ("bottle-counter-broken", Some("bottle-counter")),
        ("tank-broken", Some("tank")),
        ("star-delta-broken", Some("star-delta")),
        ("emergency-stop-broken", None),
    ] {
        let text = fs::read_to_string(format!("examples/{program}.il")).unwrap();
        let requirements = fs::read_to_string(format!("examples/{}.req", program.trim_end_matches("-broken"))).unwrap();
        let plants = plant.map(|plant| fs::read_to_string(format!("nets/{plant}.net")).unwrap());
        let plants: Vec<&str> = plants.iter().map(String::as_str).collect();
        let system = system(&text, &plants);
        let report = report(&system, &requirements);
        let document = document(&system, &report);
        let alone = System::new(system.program.clone(), Plant::default());
        for answer in report.answers.iter().chain(&report.checks) {
            let Some(witness) = answer.outcome.witness() else { continue };
            let petril::verdict::Trace::Scans(trace) = &witness.trace else { panic!() };
            for system in [&system, &alone] {
                let run = recorded(&document, Some(&answer.name.to_uppercase()), system).unwrap();
                assert_eq!(
                    (run.loop_start, &run.notes),
                    (trace.loop_start, &witness.notes),
                    "{program} {}",
                    answer.name
                );
                let made = again(system, &run).unwrap();
                assert_eq!(values(&system.program, &made), values(&system.program, &trace.scans), "{}", answer.name);
                runs += 1;
            }
        }
    }
    assert!(runs > 30, "{runs}");
}

const COUNTER: &str = "PROGRAM p VAR_INPUT i : BOOL; END_VAR VAR m : BOOL; END_VAR VAR_OUTPUT n : SINT; END_VAR\n\
                       LD i\nST m\nJMPCN on\nLD n\nGE 5\nJMPC on\n\
                       LD n\nADD 1\nST n\non: LD n\nEND_PROGRAM";

fn counted() -> (System, Value) {
    let system = system(COUNTER, &[]);
    let document = document(&system, &report(&system, "requirement few: AG (n < 3); requirement ok: AG (m <-> i);"));
    (system, document)
}

/// Changes one thing in the trace of the first requirement.
fn tampered(document: &Value, change: impl FnOnce(&mut Value)) -> Value {
    let mut document = document.clone();
    change(&mut document["requirements"][0]["trace"]);
    document
}

#[test]
fn another_run_is_refused_with_scan_and_variable() {
    let (system, document) = counted();
    let run = recorded(&document, None, &system).unwrap();
    assert_eq!((run.requirement.as_str(), run.plans.len()), ("few", 3));
    let refused = |change: fn(&mut Value)| {
        let document = tampered(&document, change);
        recorded(&document, None, &system).and_then(|run| again(&system, &run).map(|_| ())).unwrap_err()
    };
    let other = ": the report is about another program or plant, or was made with other options";
    let says = |what: &str| format!("{what}{other}");
    assert_eq!(
        refused(|trace| trace["scans"][1]["outputs"]["n"] = json!(7)),
        says("in scan 2, `n` becomes 2, and 7 in the report")
    );
    assert_eq!(
        refused(|trace| trace["scans"][0]["memory"]["m"] = json!(false)),
        says("in scan 1, `m` becomes 1, and 0 in the report")
    );
    assert_eq!(
        refused(|trace| trace["scans"][2]["inputs"]["i"] = json!(false)),
        says("in scan 3, `m` becomes 0, and 1 in the report")
    );
    assert_eq!(refused(|trace| trace["scans"][2]["ends"] = json!(false)), says("in scan 3, the program ends"));
    assert_eq!(
        refused(|trace| trace["scans"][1]["inputs"]["i"] = json!(3)),
        "in scan 2 of the report, `i` is 3, which is no value of type `BOOL`"
    );
    assert_eq!(
        refused(|trace| trace["scans"][1]["outputs"]["n"] = json!(300)),
        "in scan 2 of the report, `n` is 300, which is no value of type `SINT`"
    );
    assert_eq!(
        refused(|trace| trace["scans"][1]["inputs"]["j"] = json!(true)),
        "in scan 2 of the report, there is `j` among the inputs, which `p` has not there"
    );
    assert_eq!(
        refused(|trace| _ = trace["scans"][0]["memory"].as_object_mut().unwrap().remove("m")),
        "in scan 1 of the report, there is no `m` among the memory"
    );
    assert_eq!(refused(|trace| trace["loop_start"] = json!(3)), "the report has no scan behind scan 3");
    assert_eq!(
        refused(|trace| trace["kind"] = json!("firings")),
        "the report has no run of scans: nothing in it is violated, or it was made with `--view transition`"
    );
}

/// Each value of each scan, replaced by others: the report is refused, and nothing worse happens.
#[test]
fn any_other_value_is_refused() {
    let (system, document) = counted();
    let others = [
        json!(null),
        json!(true),
        json!(false),
        json!(0),
        json!(1),
        json!(-1),
        json!(300),
        json!(1.5),
        json!("x"),
        json!([]),
        json!([3]),
        json!({}),
        json!({ "i": true }),
    ];
    let mut tried = 0;
    for scan in 0..3 {
        let own = &document["requirements"][0]["trace"]["scans"][scan];
        for path in ["", "/inputs", "/inputs/i", "/memory", "/memory/m", "/outputs", "/outputs/n", "/ends", "/plant"] {
            for other in &others {
                let now = own.pointer(path).unwrap();
                // Without a plant, what it did is told only.
                if now == other || (path == "/plant" && other.is_array()) {
                    continue;
                }
                let document =
                    tampered(&document, |trace| *trace["scans"][scan].pointer_mut(path).unwrap() = other.clone());
                let made = recorded(&document, None, &system).and_then(|run| again(&system, &run).map(drop));
                assert!(made.is_err(), "scan {scan} {path} {other}");
                tried += 1;
            }
        }
    }
    assert!(tried > 300, "{tried}");
}

/// A requirement that holds has an example at most, which is a run, too.
#[test]
fn an_example_is_made_again() {
    let (system, document) = counted();
    let mut held = document.clone();
    held["requirements"][1]["example"] = document["requirements"][0]["trace"].clone();
    assert_eq!(recorded(&held, Some("ok"), &system).unwrap().plans.len(), 3);
}

#[test]
fn what_is_no_report_is_refused() {
    let (system, document) = counted();
    let refused = |document: &Value, name: Option<&str>| recorded(document, name, &system).unwrap_err();
    let no_report = "this is no report of `petril check --json`, or one without requirements";
    for nothing in [json!(null), json!(3), json!([1]), json!({}), json!({ "requirements": 5 })] {
        assert_eq!(refused(&nothing, None), no_report);
    }
    assert_eq!(refused(&document, Some("ok")), "the report has no run of `ok`, which is `holds`");
    assert!(refused(&document, Some("no")).starts_with("the report has no requirement `no`; it has few, ok, "));
    let firings = tampered(&document, |trace| trace["kind"] = json!("firings"));
    assert_eq!(
        refused(&firings, Some("few")),
        "the run of `few` is one of firings: make the report with `--view scan`"
    );
}

/// A plant must be able to do what the report says, and to give the inputs what it says.
#[test]
fn another_plant_is_refused() {
    let net = |name: &str| format!("net button\npl {{i=0}} (1)\npl {{i=1}}\ntr {name} {{i=0}} -> {{i=1}}\n");
    let own = system(COUNTER, &[&net("press")]);
    let document = document(&own, &report(&own, "requirement never: AG !m;"));
    let run = recorded(&document, None, &own).unwrap();
    assert_eq!(again(&own, &run).unwrap().len(), 1);
    let other = system(COUNTER, &[&net("push")]);
    let problem = recorded(&document, None, &other).unwrap_err();
    assert_eq!(problem, "in scan 1 of the report, the plant does \"button.press\", which it cannot");
    let idle = tampered(&document, |trace| trace["scans"][0]["plant"] = json!([]));
    let problem = again(&own, &recorded(&idle, None, &own).unwrap()).unwrap_err();
    assert!(problem.starts_with("in scan 1, `i` becomes 0, and 1 in the report"), "{problem}");
    let twice = tampered(&document, |trace| trace["scans"][0]["plant"] = json!(["button.press", "button.press"]));
    let problem = again(&own, &recorded(&twice, None, &own).unwrap()).unwrap_err();
    assert_eq!(problem, "the plant cannot do `button.press` now");
}

/// A lasso goes round for ever.
#[test]
fn a_loop_goes_on() {
    let text = "PROGRAM p VAR_INPUT i : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR\nLD i\nST q\nEND_PROGRAM";
    let system = system(text, &[]);
    let document = document(&system, &report(&system, "requirement r: AF AG q;"));
    let run = recorded(&document, None, &system).unwrap();
    let start = run.loop_start.unwrap();
    let around = run.plans.len() - 1 - start;
    for position in run.plans.len()..run.plans.len() + 7 {
        assert_eq!(run.plan(position), run.plan(position - around));
    }
}

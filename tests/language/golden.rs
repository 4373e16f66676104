//! Programs of others, with facts that others computed. They are not part of this project: `PETRIL_DATA` names the folder
//! that holds them, with the programs in `golden/` and `il/`. Without it there is nothing to test here.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use serde_json::Value;
use support::process::{Run, petril};

/// The programs in a folder of the data, in order; `None` without data.
fn programs(folder: &str) -> Option<Vec<PathBuf>> {
    let Some(data) = env::var_os("PETRIL_DATA") else {
        eprintln!("PETRIL_DATA is not set: nothing is tested");
        return None;
    };
    let files = fs::read_dir(Path::new(&data).join(folder)).unwrap().map(|file| file.unwrap().path());
    let mut programs: Vec<PathBuf> = files.filter(|path| path.extension().is_some_and(|end| end == "il")).collect();
    assert!(!programs.is_empty(), "no programs in {folder}");
    programs.sort();
    Some(programs)
}

/// Runs `petril` beside the program.
fn run(program: &Path, verb: &str, arguments: &[&str]) -> Run {
    let name = program.file_name().unwrap().to_str().unwrap();
    petril(program.parent().unwrap(), &[&[verb, name], arguments].concat())
}

/// Whether a program is accepted; if not, it is refused with a place.
fn is_accepted(program: &Path) -> bool {
    let run = run(program, "flat", &[]);
    let lines: Vec<&str> = run.stderr.lines().collect();
    let place = |line: &str| line.trim_start().strip_prefix("--> ").is_some_and(|place| place.split(':').count() >= 3);
    let errors = lines.windows(2).filter(|pair| pair[0].starts_with("error[") && place(pair[1])).count();
    match run.code {
        0 => assert_eq!(errors, 0, "{}\n{}", program.display(), run.stderr),
        2 => assert!(errors > 0, "{}\n{}", program.display(), run.stderr),
        code => panic!("{} ends with {code}\n{}", program.display(), run.stderr),
    }
    run.code == 0
}

/// The golden programs that are accepted, by name.
fn accepted() -> Vec<(String, PathBuf)> {
    let accepted: Vec<PathBuf> =
        programs("golden").unwrap_or_default().into_iter().filter(|p| is_accepted(p)).collect();
    let named = accepted.into_iter().map(|path| (path.file_stem().unwrap().to_str().unwrap().to_owned(), path));
    named.collect()
}

/// The rows of a table, each a value by the name of its column in upper case.
fn table(text: &str) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let head: Vec<String> = reader.headers().unwrap().iter().map(str::to_uppercase).collect();
    let row = |record: csv::StringRecord| head.iter().cloned().zip(record.iter().map(str::to_owned)).collect();
    reader.records().map(|record| row(record.unwrap())).collect()
}

#[test]
fn golden_programs_are_accepted() {
    for program in programs("golden").unwrap_or_default() {
        assert!(is_accepted(&program), "{}", program.display());
    }
}

#[test]
fn traces_are_those_of_the_reference_compiler() {
    for (name, path) in accepted() {
        let inputs = format!("{name}.inputs.csv");
        let run = run(&path, "simulate", &["--inputs", &inputs, "--overflow", "wrap", "--format", "csv"]);
        assert_eq!(run.code, 0, "{}", run.stderr);
        let simulated = table(&run.stdout);
        let trace = table(&fs::read_to_string(path.with_extension("trace.csv")).unwrap());
        let scans: Vec<_> = trace.iter().filter(|row| row["CYCLE"] != "INIT").collect();
        assert_eq!((simulated.len(), scans.len()), (200, 200), "{name}");
        for (simulated, expected) in simulated.iter().zip(scans) {
            // Edge memories and the inside of timers are left out of the expected traces.
            let shown = |key: &String| expected.contains_key(key);
            let simulated: BTreeMap<_, _> = simulated.iter().filter(|(key, _)| shown(key)).collect();
            assert_eq!(simulated, expected.iter().collect(), "{name}, scan {}", expected["CYCLE"]);
        }
    }
}

#[test]
fn facts_are_those_of_the_independent_checker() {
    for (name, path) in accepted() {
        // Programs with timers have a trace only.
        let Ok(facts) = fs::read_to_string(path.with_extension("facts.json")) else { continue };
        let facts: Value = serde_json::from_str(&facts).unwrap();
        let domains: Vec<String> = facts["inputs"].as_object().unwrap().iter().filter_map(domain).collect();
        let properties = facts["properties"].as_array().unwrap();
        let formulas = properties.iter().flat_map(|property| ["-r", property["formula"].as_str().unwrap()]);
        let mut options = vec!["--json", "--overflow", "wrap"];
        options.extend(domains.iter().flat_map(|domain| ["--domain", domain]));
        options.extend(formulas);
        let run = run(&path, "check", &options);
        let report: Value = serde_json::from_str(&run.stdout).unwrap_or_else(|e| panic!("{name}: {e}\n{}", run.stderr));
        assert_eq!(report["exploration"]["states"], facts["end_of_scan_states"], "{name}");
        assert_eq!(report["exploration"]["depth"], facts["depth"], "{name}");
        let answers = report["requirements"].as_array().unwrap();
        assert_eq!(answers.len(), properties.len());
        let some_fail = properties.iter().any(|property| property["holds"] == false);
        assert_eq!(run.code, i32::from(some_fail), "{name}");
        for (answer, property) in answers.iter().zip(properties) {
            agrees(answer, property, &name);
        }
    }
}

/// The domain of an input, as the command line has it; `None` for a `BOOL`.
fn domain((name, domain): (&String, &Value)) -> Option<String> {
    let values: Vec<String> = domain["values"].as_array()?.iter().map(ToString::to_string).collect();
    Some(format!("{name}: {}", values.join(", ")))
}

fn agrees(answer: &Value, property: &Value, name: &str) {
    let formula = property["formula"].as_str().unwrap();
    let holds = property["holds"].as_bool().unwrap();
    assert_eq!(answer["verdict"], if holds { "holds" } else { "violated" }, "{name}: {formula}");
    let scans = answer["trace"]["scans"].as_array().map(Vec::len);
    for length in ["shortest_counterexample_scans", "shortest_witness_scans"] {
        if let Some(expected) = property[length].as_u64() {
            assert_eq!(scans, Some(expected as usize), "{name}: {formula}");
        }
    }
    if property["antecedent_reachable"] == false {
        assert_eq!(answer["vacuous"], true, "{name}: {formula}");
    } else {
        assert_eq!(answer["vacuous"], false, "{name}: {formula}");
    }
}

#[test]
fn every_program_is_accepted_or_refused_with_a_place() {
    let programs = programs("il").unwrap_or_default().into_iter().chain(programs("golden").unwrap_or_default());
    let (mut accepted, mut refused) = (0, 0);
    for program in programs {
        if is_accepted(&program) { accepted += 1 } else { refused += 1 }
    }
    eprintln!("{accepted} accepted, {refused} refused");
}

/// The files below a folder that are projects of PLCopen, in order.
fn projects(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "xml") {
                let text = String::from_utf8_lossy(&fs::read(&path).unwrap()).into_owned();
                if text.contains("<project ") {
                    found.push(path);
                }
            }
        }
    }
    found.sort();
    found
}

#[test]
fn every_project_is_accepted_or_refused_with_a_place() {
    let archive = env::var_os("PETRIL_DATA").map(|data| Path::new(&data).join("plcopen/projects.tar.xz"));
    let Some(archive) = archive.filter(|archive| archive.exists()) else {
        eprintln!("there are no projects: nothing is tested");
        return;
    };
    let folder = tempfile::TempDir::new().unwrap();
    let tar = Command::new("tar").arg("xJf").arg(&archive).arg("-C").arg(folder.path()).status();
    if !tar.is_ok_and(|status| status.success()) {
        eprintln!("the projects cannot be unpacked: nothing is tested");
        return;
    }
    let projects = projects(folder.path());
    assert!(!projects.is_empty());
    let accepted = projects.iter().filter(|project| is_accepted(project)).count();
    eprintln!("{accepted} of {} projects accepted", projects.len());
    // One of them shows the same block in each of the five languages.
    let first_steps = projects.iter().find(|path| path.ends_with("first_steps/plc.xml")).unwrap();
    let run = run(first_steps, "flat", &["--pou", "CounterIL"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert_eq!(run.stdout.lines().count(), 8, "{}", run.stdout);
}

//! Faults turned on one at a time, and the tests that come to them.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::Chosen;
use crate::find::Fault;
use crate::process::{self, Ended, Test};

#[derive(Clone, Serialize, Deserialize)]
pub struct Outcome {
    pub fault: u32,
    /// `caught`, `timed out` or `survived`.
    pub outcome: String,
    /// The test that noticed the fault.
    pub by: String,
    /// Tests that were run, and that come to the fault.
    pub tried: usize,
    pub reaching: usize,
    pub seconds: f64,
}

pub fn table(copy: &Path) -> (Vec<Fault>, BTreeSet<u32>) {
    let read = |name: &str| fs::read(copy.join(name)).unwrap_or_else(|error| panic!("{name}: {error}: plant first"));
    let faults = serde_json::from_slice(&read("faults.json")).expect("a table of faults");
    (faults, serde_json::from_slice(&read("unviable.json")).expect("a list of numbers"))
}

/// What is known of each fault: the last line about it.
pub fn outcomes(copy: &Path) -> BTreeMap<u32, Outcome> {
    let names = fs::read_dir(copy).expect("a copy").filter_map(Result::ok).map(|entry| entry.path());
    let of_results =
        |path: &std::path::PathBuf| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("results"));
    let mut paths: Vec<_> = names.filter(of_results).collect();
    paths.sort();
    let mut known = BTreeMap::new();
    for path in paths {
        for line in fs::read_to_string(path).expect("results").lines() {
            let outcome: Outcome = serde_json::from_str(line).expect("an outcome in each line");
            // What was noticed once stays noticed, and of two looks the longer one counts.
            let is_more = |old: &Outcome| {
                old.outcome == "survived" && (outcome.outcome != "survived" || outcome.tried >= old.tried)
            };
            if known.get(&outcome.fault).is_none_or(is_more) {
                known.insert(outcome.fault, outcome);
            }
        }
    }
    known
}

pub fn run(copy: &Path, chosen: &Chosen) {
    let (faults, unviable) = table(copy);
    let mut tests: Vec<Test> =
        serde_json::from_slice(&fs::read(copy.join("tests.json")).expect("measure first")).expect("tests");
    let is_chosen =
        |test: &Test| chosen.tests.is_empty() || chosen.tests.iter().any(|part| test.full_name().contains(part));
    tests.retain(is_chosen);
    let known = outcomes(copy);
    let (part, parts) = chosen.shard.split_once('/').expect("a part and a number of parts");
    let (part, parts): (usize, usize) = (part.parse().expect("a number"), parts.parse().expect("a number"));
    let mut results =
        OpenOptions::new().append(true).create(true).open(copy.join(format!("results-{part}.jsonl"))).expect("results");

    let is_open = |fault: &&Fault| match known.get(&fault.number) {
        _ if unviable.contains(&fault.number) => false,
        _ if !chosen.faults.is_empty() => chosen.faults.contains(&fault.number),
        Some(outcome) => chosen.again && outcome.outcome == "survived",
        None => true,
    };
    let rank = |fault: &Fault| match chosen.files.as_slice() {
        [] => Some(0),
        files => files.iter().position(|file| fault.file.starts_with(file.as_str())),
    };
    let mut open: Vec<_> = faults.iter().filter(is_open).filter_map(|fault| Some((rank(fault)?, fault))).collect();
    open.sort_by_key(|&(rank, fault)| (rank, fault.number));
    let open: Vec<_> = open.into_iter().map(|(_, fault)| fault).skip(part).step_by(parts).collect();

    let mut reaching: HashMap<u32, Vec<usize>> = HashMap::new();
    for (i, test) in tests.iter().enumerate() {
        for &fault in &test.reached {
            reaching.entry(fault).or_default().push(i);
        }
    }
    // Tests that noticed faults of a file are asked first about the next one.
    let mut merits: HashMap<(&str, String), f64> = HashMap::new();
    let files: HashMap<u32, &str> = faults.iter().map(|fault| (fault.number, fault.file.as_str())).collect();
    for outcome in known.values().filter(|outcome| outcome.outcome == "caught") {
        *merits.entry((files[&outcome.fault], outcome.by.clone())).or_default() += 1.0;
    }
    for (i, fault) in open.iter().enumerate() {
        let mut coming = reaching.get(&fault.number).cloned().unwrap_or_default();
        let cost = |test: &usize| {
            let merit = merits.get(&(fault.file.as_str(), tests[*test].full_name())).copied().unwrap_or(0.0);
            (tests[*test].seconds + 0.02) / (1.0 + merit)
        };
        coming.sort_by(|one, other| cost(one).total_cmp(&cost(other)));
        let mut outcome = Outcome {
            fault: fault.number,
            outcome: "survived".to_owned(),
            by: String::new(),
            tried: 0,
            reaching: coming.len(),
            seconds: 0.0,
        };
        for at in coming {
            let test = &tests[at];
            if outcome.seconds + test.seconds > chosen.budget {
                continue;
            }
            let (ended, seconds) =
                process::run(copy, test, ("PETRIL_FAULT", &fault.number.to_string()), (test.seconds * 5.0).max(5.0));
            (outcome.tried, outcome.seconds) = (outcome.tried + 1, outcome.seconds + seconds);
            if ended != Ended::Passed {
                outcome.outcome = if ended == Ended::Failed { "caught" } else { "timed out" }.to_owned();
                outcome.by = test.full_name();
                *merits.entry((&fault.file, test.full_name())).or_default() += 1.0;
                break;
            }
        }
        writeln!(results, "{}", serde_json::to_string(&outcome).expect("plain data")).expect("results can be written");
        let Fault { number, file, line, kind, original, replacement, .. } = fault;
        println!(
            "{}/{} {number} {file}:{line} {kind} `{original}` -> `{replacement}`: {} {} ({}/{} tests, {:.1} s)",
            i + 1,
            open.len(),
            outcome.outcome,
            outcome.by,
            outcome.tried,
            outcome.reaching,
            outcome.seconds
        );
    }
}

//! Reports of systems for tests.

use petril::logic::{View, bind_requirement, parse_requirements};
use petril::source::Source;
use petril::translate::System;
use petril::verdict::{Answer, Options, Outcome, Report, Trace, check};
use petril::witness::ScanTrace;

/// The report on a requirement file that must be right, in the scan view.
pub fn report(system: &System, requirements: &str) -> Report {
    let source = Source::new("requirements", requirements);
    let (file, errors) = parse_requirements(&source);
    assert!(errors.is_empty(), "{errors:#?}");
    let bound = file.requirements.into_iter().map(|requirement| {
        let bound = bind_requirement(&requirement, system, View::Scan).unwrap_or_else(|e| panic!("{e:#?}"));
        (requirement, bound)
    });
    let bound: Vec<_> = bound.collect();
    check(system, &bound, &Options::default(), &mut |_| None)
}

/// Each requirement by name, with its verdict in one word.
pub fn verdicts(report: &Report) -> Vec<(&str, &str)> {
    report.answers.iter().map(|answer| (answer.name.as_str(), answer.outcome.verdict().word())).collect()
}

/// The answer to a requirement.
pub fn answer<'r>(report: &'r Report, name: &str) -> &'r Answer {
    report.answers.iter().find(|answer| answer.name == name).unwrap_or_else(|| panic!("no requirement {name}"))
}

/// The counterexample of a requirement that is violated.
pub fn counterexample<'r>(report: &'r Report, name: &str) -> &'r ScanTrace {
    match &answer(report, name).outcome {
        Outcome::Violated(witness, _) => match &witness.trace {
            Trace::Scans(trace) => trace,
            Trace::Firings(_) => panic!("{name} is told in firings"),
        },
        other => panic!("{name}: {other:?}"),
    }
}

/// A trace with a row for each scan: the values of these variables at its end, 0 or 1.
pub fn values(system: &System, trace: &ScanTrace, names: &[&str]) -> Vec<String> {
    let ids: Vec<_> = names.iter().map(|name| system.program.find(name).unwrap_or_else(|| panic!("{name}"))).collect();
    let row = |memory: &[u64]| ids.iter().map(|id| if memory[id.0] == 1 { '1' } else { '0' }).collect();
    trace.scans.iter().map(|scan| row(&scan.end.as_ref().expect("the scan ends").memory)).collect()
}

/// The plant's moves before each scan, by name.
pub fn moves<'s>(system: &'s System, trace: &ScanTrace) -> Vec<Vec<&'s str>> {
    let name =
        |m: &petril::witness::PlantMove| system.plant.components[m.component].transitions[m.transition].name.as_str();
    trace.scans.iter().map(|scan| scan.moves.iter().map(name).collect()).collect()
}

//! `petril check`: requirements on a program.

use std::process::ExitCode;
use std::time::Instant;

use petril::exchange::{Checked, json};
use petril::logic::{
    self, Assertion, Assumption, Demand, FairnessAssumption, Requirement, always_scanning, bind_fairness,
    representatives,
};
use petril::translate::System;
use petril::verdict::{Options, Verdict, check};

use super::args::{Check, View};
use super::console::Console;
use super::input::Program;
use super::progress::Watcher;
use super::requirements::{Asked, Bound};
use super::{Failure, Outcome, forms, input, report};

pub fn run(arguments: &Check, console: &Console) -> Outcome {
    let view = match arguments.view {
        View::Scan => logic::View::Scan,
        View::Transition => logic::View::Transition,
    };
    if arguments.fair && view == logic::View::Scan {
        let message = "--fair is for `--view transition`: in the scan view the PLC always scans again";
        return Err(Failure::Message(message.to_owned()));
    }
    let source = input::source(&arguments.program, input::MAX_TEXT, console)?;
    let mut asked = Asked::read(arguments, console)?;
    asked.read_comments(&source);
    let mut reading = arguments.meaning.reading.clone();
    reading.scan_time = reading.scan_time.or(asked.scan_time());
    let mut plants = arguments.plant.clone();
    plants.extend(asked.plants());
    let (Program { flat: program, source }, plant) = input::parts_of(source, &plants, &reading, console)?;
    let domains = asked.domains(&program, &plant);
    let mut system = System::with_domains(program, plant, domains);
    let Bound { requirements, assumptions, assertions, fairness_texts, mut fairness } =
        asked.bind(&system, view, console)?;
    if view == logic::View::Scan {
        system = with_representatives(system, &requirements, &assumptions, &assertions, &fairness);
        // The nodes of its net, of which these may speak, are numbered anew.
        fairness = fairness_texts.iter().filter_map(|text| bind_fairness(text, &system, view).ok()).collect();
    }
    if arguments.fair {
        fairness.push(always_scanning(&system));
    }
    let started = Instant::now();
    let watcher = Watcher::new(&arguments.limits)?;
    let options = Options {
        view,
        fairness,
        budget: arguments.limits.budget(),
        tolerated: arguments.meaning.tolerated(),
        assumptions,
        assertions,
    };
    let result = check(&system, &requirements, &options, &mut |progress| watcher.watch(progress));
    watcher.finish();
    let checked = Checked { system: &system, source: &source, report: &result };
    forms::write(&arguments.forms, &checked, started)?;
    if arguments.json {
        console.print_json(json::report(&checked, arguments.by_line || arguments.details))?;
    } else {
        let text = report::Text { system: &system, source: &source, arguments, console };
        console.print(&text.report(&result))?;
    }
    Ok(match result.verdict() {
        Verdict::Holds => ExitCode::SUCCESS,
        Verdict::Violated => ExitCode::from(1),
        Verdict::Unknown => ExitCode::from(3),
    })
}

/// The system in which values that nothing tells apart are tried once. The formulas stay bound: variables keep their numbers.
fn with_representatives(
    system: System,
    asked: &[(Requirement, Demand)],
    assumptions: &[Assumption],
    assertions: &[Assertion],
    fairness: &[FairnessAssumption],
) -> System {
    let asked = asked.iter().filter_map(|(_, demand)| demand.formula());
    let assumed = assumptions.iter().map(|assumption| &assumption.formula);
    let asserted = assertions.iter().map(|assertion| &assertion.formula);
    let fairness = fairness.iter().flat_map(FairnessAssumption::formulas);
    let formulas: Vec<_> = asked.chain(assumed).chain(asserted).chain(fairness).collect();
    let mut found = representatives(&system, &formulas);
    if found.is_empty() {
        return system;
    }
    let System { program, plant, mut domains, .. } = system;
    domains.append(&mut found);
    System::with_domains(program, plant, domains)
}

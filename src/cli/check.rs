//! `petril check`: checks a program against requirements.

use std::ffi::OsString;
use std::fmt::Debug;
use std::fs;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use petril::exchange::{Checked, Provenance, json};
use petril::explore::Progress;
use petril::logic::{
    self, Assertion, Assumption, Demand, FairnessAssumption, Requirement, always_scanning, bind_fairness,
    representatives,
};
use petril::source::Source;
use petril::translate::System;
use petril::verdict::{News, Options, Report, Tell, Verdict, check_aloud, check_knowing_aloud, fingerprint};

use super::args::{Check, View};
use super::cache::Cache;
use super::console::Console;
use super::input::Program;
use super::progress::Watcher;
use super::report::Printed;
use super::requirements::{Asked, Bound};
use super::{Failure, Outcome, forms, input, phase, project, show, watch};

/// Checked program with its report.
pub struct Done {
    pub system: System,
    pub source: Source,
    pub report: Report,
    pub provenance: Provenance,
    pub started: Instant,
}

impl Done {
    /// The report with its subject, for output.
    pub fn told(&self) -> Checked<'_> {
        let Self { system, source, report, provenance, .. } = self;
        Checked { system, source, report, provenance }
    }
}

/// Runs the verb; `given` are the options on the command line, as typed.
pub fn run(arguments: &Check, given: &[OsString], console: &Console) -> Outcome {
    let once = || match &arguments.program {
        Some(program) => alone(arguments, program, console),
        None => project::run(arguments, given, console),
    };
    if arguments.watch { watch::run(console, &once) } else { once() }
}

/// Checks a single program.
fn alone(arguments: &Check, program: &Path, console: &Console) -> Outcome {
    let watcher = Watcher::new(&arguments.limits)?;
    let cache = if arguments.no_cache { None } else { Cache::open(None, console) };
    let printed = (!arguments.json).then(|| Printed::new(arguments, console, &watcher));
    let done = checked(arguments, program, cache.as_ref(), console, &watcher, printed.as_ref())?;
    forms::write(&arguments.forms, &done.told(), done.started)?;
    match printed {
        Some(printed) => printed.rest(&done)?,
        None => drop(console.print_json(json::report(&done.told(), arguments.by_line || arguments.details))?),
    }
    Ok(code(done.report.verdict()))
}

/// Adds the warnings about the inputs to a report, and the assumptions that follow from them.
pub fn add_warnings(report: &mut Report, console: &Console) {
    let warnings = console.warnings();
    report.assumptions.extend(warnings.iter().filter_map(|(code, _, message)| input::assumed(code, message)));
    report.warnings =
        warnings.into_iter().map(|(code, place, message)| format!("{place}: {code}: {message}")).collect();
}

/// Exit code of a verdict.
pub fn code(verdict: Verdict) -> ExitCode {
    match verdict {
        Verdict::Holds => ExitCode::SUCCESS,
        Verdict::Violated => ExitCode::from(1),
        Verdict::Unknown => ExitCode::from(3),
    }
}

/// Reads a program and its requirements, and checks them. With `printed`, results are printed as they become known.
pub fn checked(
    arguments: &Check,
    program: &Path,
    cache: Option<&Cache>,
    console: &Console,
    watcher: &Watcher,
    printed: Option<&Printed<'_>>,
) -> Result<Done, Failure> {
    let view = match arguments.view {
        View::Scan => logic::View::Scan,
        View::Transition => logic::View::Transition,
    };
    if arguments.fair && view == logic::View::Scan {
        let message = "--fair is for `--view transition`: in the scan view the PLC always scans again";
        return Err(Failure::Message(message.to_owned()));
    }
    let source = input::source(program, input::MAX_TEXT, console)?;
    let mut asked = Asked::read(arguments, console)?;
    asked.read_comments(&source);
    let mut reading = arguments.meaning.reading.clone();
    reading.scan_time = reading.scan_time.or(asked.scan_time());
    let mut plants = arguments.plant.clone();
    // A plant named by a requirement file may also be given on the command line.
    for named in asked.plants() {
        if !plants.iter().any(|known| is_one_file(known, &named)) {
            plants.push(named);
        }
    }
    let (Program { flat: program, source }, plant) = input::parts_of(source, &plants, &reading, console)?;
    show::refuse_unknown(&program, &arguments.show)?;
    let domains = asked.domains(&program, &plant);
    phase::begin("composing the net");
    let mut system = System::with_domains(program, plant, domains);
    let Bound { requirements, assumptions, assertions, fairness_texts, mut fairness } =
        asked.bind(&system, view, console)?;
    if view == logic::View::Scan {
        system = with_representatives(system, &requirements, &assumptions, &assertions, &fairness);
        // The net is new, so formulas about its nodes are bound again.
        fairness = fairness_texts.iter().filter_map(|text| bind_fairness(text, &system, view).ok()).collect();
    }
    if arguments.fair {
        fairness.push(always_scanning(&system));
    }
    forms::refuse(&arguments.forms)?;
    let options = Options {
        view,
        fairness,
        budget: arguments.limits.budget(),
        tolerated: arguments.meaning.tolerated(),
        assumptions,
        assertions,
    };
    phase::begin_asking("exploring");
    let started = Instant::now();
    let mut watch = |progress: &Progress| watcher.watch(progress);
    let tell = |news: News<'_>| {
        if let Some(printed) = printed {
            printed.hear(&system, &source, news);
        }
    };
    let tell: Option<Tell<'_>> = printed.is_some().then_some(&tell);
    let mut report = match cache.map(|cache| (cache, fingerprint(&system, &options))) {
        Some((cache, fingerprint)) => {
            let known = cache.recall(&fingerprint);
            let (report, now) = check_knowing_aloud(&system, &requirements, &options, known.as_ref(), &mut watch, tell);
            now.iter().for_each(|now| cache.keep(&fingerprint, now));
            report
        }
        None => check_aloud(&system, &requirements, &options, &mut watch, tell),
    };
    watcher.finish();
    add_warnings(&mut report, console);
    console.has_options(&options_of(arguments));
    Ok(Done { system, source, report, provenance: console.provenance(), started })
}

/// Options that an answer depends on. Files are covered by hashes of their contents.
fn options_of(arguments: &Check) -> impl Debug {
    let Check { requirement, domain, fairness, view, fair, meaning, limits, .. } = arguments;
    (requirement, domain, fairness, view, fair, meaning, limits.max_states, limits.max_memory, limits.timeout)
}

/// Whether two paths lead to the same file.
fn is_one_file(one: &Path, other: &Path) -> bool {
    matches!((fs::canonicalize(one), fs::canonicalize(other)), (Ok(one), Ok(other)) if one == other)
}

/// Replaces input domains by representatives: one value for each class of values that nothing distinguishes. The
/// formulas stay bound, since variables keep their numbers.
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

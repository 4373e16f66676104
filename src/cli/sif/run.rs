//! `petril sif run`: runs tests of safety functions on the interpreter.

use std::collections::BTreeSet;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Instant;

use petril::exchange::sif::{Ran, Sheets, brief, html, json, junit, reasons, results_csv};
use petril::flat::{FlatProgram, Tolerated};
use petril::printable::line;
use petril::sif::proof::{self, Options, Subject, prove};
use petril::sif::{Ending, Fate, Hunt, Mutant, Runner, Specification, Start, hunt, mutants};
use petril::verdict::Verdict;
use petril::witness::{Column, Table};

use super::args::SifRun;
use super::{Read, planned, specification, unbound};
use crate::cli::console::{Colour, Console};
use crate::cli::input::{Program, program};
use crate::cli::report::counted;
use crate::cli::{Outcome, SUCCESS, forms, guard, output, phase, progress};

/// Maximum number of listed tests or mutants.
const MAX_TOLD: usize = 40;

pub fn run(arguments: &SifRun, console: &Console) -> Outcome {
    let started = Instant::now();
    let Read { specification, sources } = specification(&arguments.specification, console)?;
    let Program { flat, source } = program(&arguments.program, &arguments.meaning.reading, console)?;
    output::refuse([&arguments.html, &arguments.junit, &arguments.csv].into_iter().flatten())?;
    let functions = planned::functions(&arguments.function, &specification)?;
    let limits = planned::limits();
    phase::begin_asking("choosing tests");
    let plans = match &arguments.tests {
        Some(path) => planned::read(path, &specification, &functions, &limits, console)?,
        None => planned::made(&specification, &functions, arguments.criterion, &limits),
    };
    let start = if arguments.continued { Start::Continued } else { Start::PowerOn };
    let runner = Runner::new(&specification, &flat, arguments.meaning.tolerated(), start, &plans);
    let runner = runner.map_err(|found| unbound(&found, &sources, console))?;
    phase::begin_asking("running tests");
    let results = runner.run(&plans);
    let is_passed = results.iter().flat_map(|run| &run.tests).all(|test| test.ending == Ending::Passed);
    if arguments.mutants && !is_passed {
        console.message("note: faults of a program that does not pass its tests are not looked for\n");
    }
    let found = (arguments.mutants && is_passed).then(|| {
        let tolerated = arguments.meaning.tolerated();
        let tested: Vec<usize> = plans.iter().map(|plan| plan.function).collect();
        let decide = |program: &FlatProgram| decide(&specification, program, tolerated, &tested);
        phase::begin_asking("looking for faults");
        let mutants = mutants(&flat, &source);
        let bar = progress::steps(mutants.len(), "faults");
        let found = hunt(&runner, &plans, mutants, &decide, &|| {
            bar.inc(1);
            guard::is_asked()
        });
        bar.finish_and_clear();
        found
    });
    // Mutants not tried are counted in the report.
    let is_stopped = guard::is_asked();
    let is_told = arguments.json || arguments.html.is_some();
    let excluded = if is_told { planned::left_out(&specification, &plans, &limits) } else { Vec::new() };
    let origin = arguments.tests.as_ref().map(|path| path.display().to_string());
    let ran = Ran { runner: &runner, source: &source, results: &results, hunt: found.as_ref() };
    let sheets = Sheets {
        specification: &specification,
        sources: &sources,
        plans: &plans,
        origin: origin.as_deref(),
        excluded: &excluded,
        run: Some(ran),
        provenance: &console.provenance(),
    };
    if let Some(file) = &arguments.html {
        output::write_text(file, &html::write(&sheets))?;
    }
    if let Some(file) = &arguments.junit {
        output::write_text(file, &junit::write(&sheets, &ran, forms::stamp(started)))?;
    }
    if let Some(file) = &arguments.csv {
        output::write_text(file, &results_csv::write(&sheets, &ran))?;
    }
    if arguments.json {
        console.print_json(json::document(&sheets))?;
    } else {
        console.print_report(&text(&sheets, &ran, console), sheets.provenance, false)?;
    }
    Ok(match is_passed {
        true if is_stopped => ExitCode::from(3),
        true => SUCCESS,
        false => ExitCode::from(1),
    })
}

/// Fate of a mutant that passes all tests, by proof against the specification.
fn decide(specification: &Specification, program: &FlatProgram, tolerated: Tolerated, functions: &[usize]) -> Fate {
    if guard::is_asked() {
        return Fate::Undecided("the work was stopped".to_owned());
    }
    let options = Options { scans: 4, conflicts: 20_000, stop: Arc::new(guard::is_asked), ..Options::default() };
    // Signals were resolved for the original program already.
    let Ok(subject) = Subject::new(specification, program, tolerated, functions) else {
        return Fate::Undecided("a restriction speaks of what the program does not have".to_owned());
    };
    let proof = prove(&subject, &options);
    match proof.verdict() {
        Verdict::Holds => Fate::Equivalent,
        Verdict::Violated => Fate::Missed,
        Verdict::Unknown => {
            let why = proof.answers.iter().find_map(|answer| match &answer.outcome {
                proof::Outcome::Unknown(why) => Some(why.clone()),
                _ => None,
            });
            let failing = proof.unknown_failures.first().map(|(_, why)| why.clone());
            Fate::Undecided(why.or(failing).unwrap_or_default())
        }
    }
}

/// Text report.
fn text(sheets: &Sheets<'_>, ran: &Ran<'_>, console: &Console) -> String {
    let by = match (sheets.origin, sheets.plans.first()) {
        (Some(file), _) => format!("from {}", line(file)),
        (None, Some(plan)) => format!("by `{}`", plan.criterion.name()),
        (None, None) => String::new(),
    };
    let how = match ran.runner.start() {
        Start::PowerOn => "each from power-on",
        Start::Continued => "one after another without a restart",
    };
    let (name, file) = (&ran.program().name, line(ran.source.name()));
    let mut out = format!("program `{name}` from {file}: tests {by}, {how}\n\n");
    if sheets.plans.len() <= MAX_TOLD {
        out += &summary(sheets, ran).within(console.output_width());
    }
    out += &failures(sheets, ran, console.output_width());
    out += &notes(sheets, ran);
    let [passed, failed, errors] = ran.counts();
    let tests = format!("{} of {}", counted(sheets.tests(), "test"), counted(sheets.plans.len(), "function"));
    out += &match (failed, errors) {
        (0, 0) => format!("\n{tests}: {}\n", console.paint("all passed", Colour::Good)),
        _ => {
            let not = console.paint(&format!("{failed} failed"), Colour::Bad);
            format!("\n{tests}: {passed} passed, {not}, {}\n", counted(errors, "error"))
        }
    };
    out + &ran.hunt.map(|hunt| told(hunt, ran)).unwrap_or_default()
}

/// Table of results, a row per function.
fn summary(sheets: &Sheets<'_>, ran: &Ran<'_>) -> Table {
    let heads = ["tests", "passed", "failed", "errors"].map(Column::right).to_vec();
    let mut table = Table::new(vec![vec![Column::left("function")], heads]);
    for (plan, run) in sheets.plans.iter().zip(ran.results) {
        let count = |word| run.tests.iter().filter(|test| test.ending.word() == word).count();
        let counts = [run.tests.len(), count("passed"), count("failed"), count("error")];
        let name = sheets.specification.functions[plan.function].name.clone();
        table.row(&std::iter::once(name).chain(counts.map(|count| count.to_string())).collect::<Vec<_>>());
    }
    table
}

/// Table of the tests not passed.
fn failures(sheets: &Sheets<'_>, ran: &Ran<'_>, width: usize) -> String {
    let columns = [Column::left("not passed"), Column::left("why"), Column::left("inputs")];
    let mut table = Table::new(columns.into_iter().map(|column| vec![column]).collect());
    let mut count = 0;
    for (plan, run) in sheets.plans.iter().zip(ran.results) {
        let tests = plan.tests.iter().zip(&run.tests).enumerate();
        for (number, (test, made)) in tests.filter(|(_, (_, made))| made.ending.word() != "passed") {
            count += 1;
            if count <= MAX_TOLD {
                let name = &sheets.specification.functions[plan.function].name;
                let why = reasons(sheets, ran, made).join("; ");
                table.row(&[format!("{name} test {}", number + 1), why, brief(sheets, test)]);
            }
        }
    }
    match count {
        0 => String::new(),
        1..=MAX_TOLD => format!("\n{}", table.within(width)),
        _ => format!("\n{}… and {} more\n", table.within(width), count - MAX_TOLD),
    }
}

/// Notes on inputs without a signal, and on outputs absent from the program.
fn notes(sheets: &Sheets<'_>, ran: &Ran<'_>) -> String {
    let mut out = String::new();
    let unset: Vec<&str> = ran.runner.unset().map(|id| ran.program().variable(id).name.as_str()).collect();
    if !unset.is_empty() {
        let names = unset.iter().take(MAX_TOLD).map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
        out += &format!("\nnote: no signal stands for these inputs, which keep their initial values: {names}\n");
    }
    let absent: BTreeSet<_> = ran.results.iter().flat_map(|run| run.absent.iter().copied()).collect();
    if !absent.is_empty() {
        let names = absent.iter().take(MAX_TOLD).map(|id| format!("`{}`", sheets.specification.name(*id)));
        let names = names.collect::<Vec<_>>().join(", ");
        out += &format!("\nnote: the program does not have these outputs, which are not compared: {names}\n");
    }
    out
}

/// Table of mutants by fate, and list of those not found.
fn told(hunt: &Hunt, ran: &Ran<'_>) -> String {
    let heads = ["faults", "found", "equivalent", "missed", "not decided"].map(Column::right).to_vec();
    let mut table = Table::new(vec![vec![Column::left("fault of the program")], heads]);
    let mut row = |name: &str, counts: [usize; 5]| {
        table.row(&std::iter::once(name.to_owned()).chain(counts.map(|count| count.to_string())).collect::<Vec<_>>());
    };
    let of = |class: &str| hunt.counts(Some(class));
    Mutant::CLASSES.iter().filter(|class| of(class)[0] > 0).for_each(|class| row(class, of(class)));
    row("all", hunt.counts(None));
    let mut out = format!("\n{table}");
    let left: Vec<_> =
        hunt.mutants.iter().filter(|(_, fate)| !matches!(fate, Fate::Found(..) | Fate::Equivalent)).collect();
    for (mutant, fate) in left.iter().take(MAX_TOLD) {
        let at = ran.source.line_of(ran.program().code[mutant.line].span.start);
        let why = match fate {
            Fate::Undecided(why) => format!("not decided: {why}"),
            _ => "missed".to_owned(),
        };
        out += &format!("{}: {} ({why})\n", line(&format!("{}:{at}", ran.source.name())), line(&mutant.fault));
    }
    if left.len() > MAX_TOLD {
        out += &format!("… and {} more\n", left.len() - MAX_TOLD);
    }
    out
}

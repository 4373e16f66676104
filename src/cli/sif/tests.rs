//! `petril sif tests`: generated or given tests, and their fault coverage.

use std::process::ExitCode;

use petril::exchange::sif::{Sheets, html, json, plan_csv};
use petril::printable::line;
use petril::sif::{Criterion, Limits, Plan, Specification, Study};
use petril::witness::{Column, Table};
use rayon::prelude::*;

use super::args::SifTests;
use super::{Read, planned, specification, valuations};
use crate::cli::console::Console;
use crate::cli::report::counted;
use crate::cli::{Outcome, SUCCESS, output, phase};

/// Maximum number of functions whose tests are printed; above it, only counts.
const MAX_SHOWN: usize = 5;

/// Maximum number of listed faults.
const MAX_TOLD: usize = 100;

pub fn run(arguments: &SifTests, console: &Console) -> Outcome {
    let Read { specification, sources } = specification(&arguments.specification, console)?;
    output::refuse([&arguments.html, &arguments.csv].into_iter().flatten())?;
    let functions = planned::functions(&arguments.function, &specification)?;
    let limits = Limits { tests: arguments.limit, ..planned::limits() };
    phase::begin_asking("choosing tests");
    if arguments.compare {
        let table = compared(&specification, &functions, &limits).within(console.output_width());
        return console.print_report(&table, &console.provenance(), false);
    }
    let plans = match &arguments.tests {
        Some(path) => planned::read(path, &specification, &functions, &limits, console)?,
        None => planned::made(&specification, &functions, arguments.criterion, &limits),
    };
    let origin = arguments.tests.as_ref().map(|path| path.display().to_string());
    let is_told = arguments.json || arguments.html.is_some();
    let excluded = if is_told { planned::left_out(&specification, &plans, &limits) } else { Vec::new() };
    let sheets = Sheets {
        specification: &specification,
        sources: &sources,
        plans: &plans,
        origin: origin.as_deref(),
        excluded: &excluded,
        run: None,
        provenance: &console.provenance(),
    };
    if let Some(file) = &arguments.html {
        output::write_text(file, &html::write(&sheets))?;
    }
    if let Some(file) = &arguments.csv {
        output::write_text(file, &plan_csv::write(&sheets))?;
    }
    if arguments.json {
        console.print_json(json::document(&sheets))?;
    } else if plans.len() <= MAX_SHOWN {
        let texts: Vec<String> = plans.iter().map(|plan| text(&sheets, plan, console)).collect();
        console.print_report(&texts.join("\n"), sheets.provenance, false)?;
    } else {
        let hint = "\nthe tests of one function: --function NAME\n";
        let table = figures(&specification, &plans).within(console.output_width());
        console.print_report(&(table + hint), sheets.provenance, false)?;
    }
    let is_all = plans.iter().all(|plan| plan.incomplete.is_none());
    Ok(if is_all { SUCCESS } else { ExitCode::from(3) })
}

/// Report of the tests of a function.
fn text(sheets: &Sheets<'_>, plan: &Plan, console: &Console) -> String {
    let specification = sheets.specification;
    let function = &specification.functions[plan.function];
    let title = function.title.as_ref().map(|title| format!(" \"{}\"", line(title))).unwrap_or_default();
    let tests = counted(plan.tests.len(), "test");
    let how = match (sheets.origin, plan.is_smallest && plan.criterion != Criterion::All) {
        (Some(file), _) => format!("from {}", line(file)),
        (None, true) if matches!(plan.criterion, Criterion::Faults | Criterion::Pairs) => {
            format!("by `{}`, and no fewer would do", plan.criterion.name())
        }
        _ => format!("by `{}`", plan.criterion.name()),
    };
    let mut out = format!("{}{title}: {tests} {how}\n", function.name);
    if let Some(reason) = &plan.incomplete {
        out += &format!("not all: {reason}\n");
    }
    if !plan.cubes.is_empty() {
        out += &format!(
            "\nsome of what these valuations are, as cubes\n{}",
            valuations::cubes(specification, &plan.cubes)
        );
    }
    if !plan.tests.is_empty() {
        out += &format!("\n{}", listed(specification, plan).within(console.output_width()));
    }
    out += &purposes(plan);
    if !plan.notes.is_empty() {
        out += &format!("\n{}\n", plan.notes.join("\n"));
    }
    if !plan.coverage.classes.is_empty() {
        out += &format!("\n{}", classes(plan).within(console.output_width()));
    }
    out + &missed(specification, plan)
}

/// Table of the tests.
fn listed(specification: &Specification, plan: &Plan) -> Table {
    let values: Vec<_> = plan.tests.iter().map(|test| &test.values).collect();
    let inputs = valuations::columns(specification, &plan.varied, &values);
    let outputs = plan.touched.iter().map(|output| Column::right(specification.name(*output))).collect();
    let mut table = valuations::table(specification, &inputs, vec![outputs]);
    for (number, test) in plan.tests.iter().enumerate() {
        let mut cells = vec![(number + 1).to_string()];
        cells.extend(valuations::cells(specification, &inputs, &test.values));
        cells.extend(plan.touched.iter().map(|output| valuations::bit(test.values.contains(output.0))));
        table.row(&cells);
    }
    table
}

/// Purposes of the tests, where known.
fn purposes(plan: &Plan) -> String {
    let mut out = String::new();
    for (number, test) in plan.tests.iter().enumerate() {
        for (position, purpose) in test.purpose.iter().enumerate() {
            let number = if position == 0 { (number + 1).to_string() } else { String::new() };
            out += &format!("{number:>4}   {purpose}\n");
        }
    }
    if out.is_empty() { out } else { format!("\n{out}") }
}

/// Fault counts: all, equivalent, undecided and killed.
#[derive(Clone, Copy, Default)]
struct Figures {
    faults: usize,
    equivalent: usize,
    undecided: usize,
    killed: usize,
}

impl Figures {
    const HEADS: [&str; 5] = ["faults", "never seen", "undecided", "found", "missed"];

    fn of(plan: &Plan) -> Self {
        plan.coverage.classes.iter().fold(Self::default(), |sum, class| {
            sum.plus(Self {
                faults: class.faults,
                equivalent: class.equivalent,
                undecided: class.undecided,
                killed: class.killed,
            })
        })
    }

    fn plus(self, other: Self) -> Self {
        Self {
            faults: self.faults + other.faults,
            equivalent: self.equivalent + other.equivalent,
            undecided: self.undecided + other.undecided,
            killed: self.killed + other.killed,
        }
    }

    fn cells(self) -> impl Iterator<Item = String> {
        let missed = self.faults - self.equivalent - self.undecided - self.killed;
        [self.faults, self.equivalent, self.undecided, self.killed, missed].map(|count| count.to_string()).into_iter()
    }
}

/// Table of fault classes with a total.
fn classes(plan: &Plan) -> Table {
    let mut table = Table::new(vec![vec![Column::left("class of faults")], Figures::HEADS.map(Column::right).to_vec()]);
    for class in plan.coverage.classes.iter().filter(|class| class.faults > 0) {
        let figures = Figures {
            faults: class.faults,
            equivalent: class.equivalent,
            undecided: class.undecided,
            killed: class.killed,
        };
        table.row(&std::iter::once(class.class.to_owned()).chain(figures.cells()).collect::<Vec<_>>());
    }
    table.row(&std::iter::once("all".to_owned()).chain(Figures::of(plan).cells()).collect::<Vec<_>>());
    table
}

/// Faults not found, grouped by reason.
fn missed(specification: &Specification, plan: &Plan) -> String {
    let mut reasons: Vec<&str> = Vec::new();
    for missed in &plan.coverage.missed {
        if !reasons.contains(&missed.why.as_str()) {
            reasons.push(&missed.why);
        }
    }
    let mut out = String::new();
    let mut left = MAX_TOLD;
    for reason in reasons {
        let of: Vec<_> = plan.coverage.missed.iter().filter(|missed| missed.why == reason).collect();
        out += &format!("\nmissed: {} — {reason}\n", counted(of.len(), "fault"));
        for missed in of.iter().take(left) {
            let by = plan.varied.iter().map(|input| valuations::bit(missed.shown_by.contains(input.0)));
            let by: String = by.collect();
            let shown = if plan.varied.len() <= 24 { format!("; seen with {by}") } else { String::new() };
            out += &format!("  {}: {}{shown}\n", missed.class, missed.fault);
        }
        if of.len() > left {
            out += &format!("  … and {} more\n", of.len() - left);
        }
        left = left.saturating_sub(of.len());
    }
    if !out.is_empty() && plan.varied.len() <= 24 {
        let names: Vec<&str> = plan.varied.iter().map(|input| specification.name(*input)).collect();
        out += &format!("\nthe digits are {}\n", names.join(", "));
    }
    out
}

/// Table of counts, a row per function.
fn figures(specification: &Specification, plans: &[Plan]) -> Table {
    let mut heads = vec![Column::right("tests")];
    heads.extend(Figures::HEADS.map(Column::right));
    let mut table = Table::new(vec![vec![Column::left("function")], heads, vec![Column::left("not all")]]);
    let (mut tests, mut all) = (0, Figures::default());
    for plan in plans {
        let figures = Figures::of(plan);
        (tests, all) = (tests + plan.tests.len(), all.plus(figures));
        let mut cells = vec![specification.functions[plan.function].name.clone(), plan.tests.len().to_string()];
        cells.extend(figures.cells());
        cells.push(plan.incomplete.clone().unwrap_or_default());
        table.row(&cells);
    }
    let mut cells = vec!["all".to_owned(), tests.to_string()];
    cells.extend(all.cells());
    cells.push(String::new());
    table.row(&cells);
    table
}

/// Table of criteria over all functions.
fn compared(specification: &Specification, functions: &[usize], limits: &Limits) -> Table {
    let made: Vec<Vec<Plan>> = functions
        .par_iter()
        .map(|&function| {
            let mut study = Study::new(specification, function, limits);
            Criterion::ALL.into_iter().map(|criterion| study.plan(criterion)).collect()
        })
        .collect();
    let mut heads = vec![Column::right("tests")];
    heads.extend(Figures::HEADS.map(Column::right));
    let last = vec![Column::right("functions"), Column::right("without list")];
    let mut table = Table::new(vec![vec![Column::left("criterion")], heads, last]);
    for (position, criterion) in Criterion::ALL.into_iter().enumerate() {
        let plans = || made.iter().map(|plans| &plans[position]);
        let (listed, open): (Vec<&Plan>, Vec<&Plan>) =
            plans().partition(|plan| plan.incomplete.is_none() || !plan.tests.is_empty());
        let tests: usize = listed.iter().map(|plan| plan.tests.len()).sum();
        let figures = listed.iter().fold(Figures::default(), |sum, plan| sum.plus(Figures::of(plan)));
        let mut cells = vec![criterion.name().to_owned(), tests.to_string()];
        cells.extend(figures.cells());
        cells.extend([listed.len().to_string(), open.len().to_string()]);
        table.row(&cells);
    }
    table
}

//! `petril simulate`: a program scan by scan.

use std::process::ExitCode;

use petril::flat::{FlatProgram, Hazard};
use petril::interpret::{Fault, Machine};
use petril::semantics::VarId;
use petril::source::Source;
use petril::witness::{Column, Table};

use super::args::{Format, Simulate};
use super::console::Console;
use super::input::Program;
use super::{Failure, Outcome, SUCCESS, input, input_table};

/// Scans simulated if neither inputs nor a number is given.
const DEFAULT_SCANS: usize = 10;

/// Tables of inputs may have this many bytes.
const MAX_INPUTS: u64 = 1 << 30;

pub fn run(arguments: &Simulate, console: &Console) -> Outcome {
    let Program { flat: program, source } = input::program(&arguments.program, &arguments.meaning.reading, console)?;
    let rows = match &arguments.inputs {
        None => Vec::new(),
        Some(path) => {
            let source = input::source(path, MAX_INPUTS, console)?;
            input_table::read(&source, &program).map_err(|diagnostics| {
                console.diagnostics(&diagnostics, &source);
                Failure::Reported
            })?
        }
    };
    let scans = arguments.scans.unwrap_or(if arguments.inputs.is_some() { rows.len() } else { DEFAULT_SCANS });
    let mut machine = Machine::new(&program);
    let mut states: Vec<Vec<u64>> = Vec::new();
    let mut stopped = None;
    for scan in 0..scans {
        if let Some(row) = rows.get(scan) {
            row.iter().for_each(|&(input, value)| machine.set(input, value));
        }
        machine.scan().map_err(|fault| {
            Failure::Message(match fault {
                Fault::Endless => format!("scan {} never ends: it repeats a state", scan + 1),
                Fault::TooLong => format!("scan {} takes too many instructions to wait for its end", scan + 1),
            })
        })?;
        states.push(program.declared().map(|id| machine.value(id)).collect());
        stopped = arguments.meaning.tolerated().first_error(machine.hazards());
        if stopped.is_some() {
            break;
        }
    }
    console.print(&match arguments.format {
        Format::Csv => csv(&program, &states),
        Format::Table => table(&program, &states).to_string(),
    })?;
    Ok(match stopped {
        Some(error) => {
            console.error(&explain(error, states.len(), &program, &source));
            ExitCode::from(1)
        }
        None => SUCCESS,
    })
}

/// What went wrong in a scan, where, and how to go on.
fn explain((line, hazard): (usize, Hazard), scan: usize, program: &FlatProgram, source: &Source) -> String {
    let (what, help) = match hazard {
        Hazard::Overflow => ("a number does not fit its type", "; with `--overflow wrap`, the simulation goes on"),
        Hazard::DivisionByZero => ("a number is divided by 0", "; with `--div0 zero`, the simulation goes on"),
        Hazard::Index => ("an index is outside its array", ""),
        Hazard::Subrange => ("a value is outside the subrange of its variable", ""),
    };
    let from = source.line_of(program.code[line].span.start);
    format!("in scan {scan}, {what} ({}:{from}: {}){help}", source.name(), source.line_text(from).trim())
}

/// A row a scan: its number, then the declared variables.
fn rows(
    program: &FlatProgram,
    states: &[Vec<u64>],
    text: impl Fn(VarId, u64) -> String,
) -> impl Iterator<Item = Vec<String>> {
    states.iter().enumerate().map(move |(scan, state)| {
        let values = program.declared().zip(state).map(|(id, &value)| text(id, value));
        std::iter::once((scan + 1).to_string()).chain(values).collect()
    })
}

fn csv(program: &FlatProgram, states: &[Vec<u64>]) -> String {
    let names = program.declared().map(|id| program.variable(id).name.clone());
    let head: Vec<String> = std::iter::once("cycle".to_owned()).chain(names).collect();
    let rows = rows(program, states, |id, value| program.variable(id).ty.number(value).to_string());
    // The name of an element of an array with several dimensions has a comma.
    let cell = |cell: String| if cell.contains(',') { format!("\"{cell}\"") } else { cell };
    let line = |row: Vec<String>| row.into_iter().map(cell).collect::<Vec<_>>().join(",") + "\n";
    std::iter::once(head).chain(rows).map(line).collect()
}

fn table(program: &FlatProgram, states: &[Vec<u64>]) -> Table {
    let names = program.declared().map(|id| Column::right(&program.variable(id).name)).collect();
    let mut table = Table::new(vec![vec![Column::right("scan")], names]);
    rows(program, states, |id, value| program.value_text(id, value)).for_each(|row| table.row(row));
    table
}

//! `petril simulate`: a program scan by scan.

use std::collections::BTreeSet;

use petril::diagnostic::{Code, Diagnostic};
use petril::flat::FlatProgram;
use petril::interpret::{Fault, Machine};
use petril::semantics::{Role, VarId};
use petril::source::{Source, Span};
use petril::syntax::ast::key;
use petril::witness::{Column, Table};

use super::args::{Format, Simulate};
use super::console::Console;
use super::{Failure, Outcome, input};

/// Scans simulated if neither inputs nor a number is given.
const DEFAULT_SCANS: usize = 10;

/// Tables of inputs may have this many bytes.
const MAX_INPUTS: u64 = 1 << 30;

pub fn run(arguments: &Simulate, console: &Console) -> Outcome {
    let program = input::program(&arguments.program, arguments.pou.as_deref(), console)?.flat;
    let rows = match &arguments.inputs {
        None => Vec::new(),
        Some(path) => {
            let source = input::source(path, MAX_INPUTS, console)?;
            inputs(&source, &program).map_err(|diagnostics| {
                console.diagnostics(&diagnostics, &source);
                Failure::Reported
            })?
        }
    };
    let scans = arguments.scans.unwrap_or(if arguments.inputs.is_some() { rows.len() } else { DEFAULT_SCANS });
    let mut machine = Machine::new(&program);
    let mut states = Vec::with_capacity(scans);
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
    }
    console.print(&match arguments.format {
        Format::Csv => csv(&program, &states),
        Format::Table => table(&program, &states).to_string(),
    })
}

/// The rows of a table of inputs: the values each sets.
fn inputs(source: &Source, program: &FlatProgram) -> Result<Vec<Vec<(VarId, u64)>>, Vec<Diagnostic>> {
    let mut errors = Vec::new();
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(source.text().as_bytes());
    // The reader gives no columns, so a diagnostic points at the whole line.
    let line = |position: Option<&csv::Position>| {
        let start = position.map_or(0, |position| position.byte() as usize);
        let length = source.text().get(start..).and_then(|rest| rest.lines().next()).map_or(0, str::len);
        Span::new(start, start + length)
    };
    let head = match reader.headers() {
        Ok(head) => head.clone(),
        Err(error) => return Err(vec![malformed(&error, Span::default())]),
    };
    if head.is_empty() {
        let empty = Diagnostic::new(Code::InputTable, Span::default(), "this table of inputs is empty");
        return Err(vec![empty.help("write the names of the inputs in the first row, then one row for each scan")]);
    }
    let known = || program.with_role(Role::Input);
    let mut names = BTreeSet::new();
    for twice in head.iter().filter(|name| !names.insert(key(name))) {
        let message = format!("two columns are named `{twice}`");
        errors.push(Diagnostic::new(Code::InputTable, line(head.position()), message).help("remove one of them"));
    }
    let columns: Vec<Option<VarId>> = (head.iter())
        .map(|name| {
            let input = known().find(|&id| program.variable(id).name.eq_ignore_ascii_case(name));
            if input.is_none() {
                let message = match program.find(name) {
                    Some(_) => format!("`{name}` is no input of the program `{}`", program.name),
                    None => format!("the program `{}` has no input `{name}`", program.name),
                };
                let names = known().map(|id| program.variable(id).name.as_str());
                errors.push(Diagnostic::new(Code::InputTable, line(head.position()), message).suggest_at(
                    errors.len(),
                    name,
                    names,
                ));
            }
            input
        })
        .collect();
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = match record {
            Ok(record) => record,
            Err(error) => {
                errors.push(malformed(&error, line(error.position())));
                continue;
            }
        };
        let mut row = Vec::new();
        for (input, cell) in columns.iter().zip(&record) {
            match (input, truth(cell)) {
                (Some(input), Some(value)) => row.push((*input, value)),
                (None, _) => {}
                (Some(_), None) => {
                    let message = format!("`{cell}` is no value of type `BOOL`");
                    errors
                        .push(Diagnostic::new(Code::InputTable, line(record.position()), message).help("write 0 or 1"));
                }
            }
        }
        rows.push(row);
    }
    if errors.is_empty() { Ok(rows) } else { Err(errors) }
}

/// A row that is none.
fn malformed(error: &csv::Error, span: Span) -> Diagnostic {
    let csv::ErrorKind::UnequalLengths { expected_len, len, .. } = error.kind() else {
        return Diagnostic::new(Code::InputTable, span, error.to_string());
    };
    let message =
        format!("this row has another number of values ({len}) than the first row has names ({expected_len})");
    Diagnostic::new(Code::InputTable, span, message).help("give each input one value, separated by commas")
}

fn truth(cell: &str) -> Option<u64> {
    match cell {
        "0" => Some(0),
        "1" => Some(1),
        _ if cell.eq_ignore_ascii_case("FALSE") => Some(0),
        _ if cell.eq_ignore_ascii_case("TRUE") => Some(1),
        _ => None,
    }
}

/// A row a scan: its number, then the declared variables.
fn rows(states: &[Vec<u64>]) -> impl Iterator<Item = Vec<String>> {
    states.iter().enumerate().map(|(scan, state)| {
        let values = state.iter().map(|&value| value.to_string());
        std::iter::once((scan + 1).to_string()).chain(values).collect()
    })
}

fn csv(program: &FlatProgram, states: &[Vec<u64>]) -> String {
    let names = program.declared().map(|id| program.variable(id).name.clone());
    let head: Vec<String> = std::iter::once("cycle".to_owned()).chain(names).collect();
    std::iter::once(head).chain(rows(states)).map(|row| row.join(",") + "\n").collect()
}

fn table(program: &FlatProgram, states: &[Vec<u64>]) -> Table {
    let names = program.declared().map(|id| Column::right(&program.variable(id).name)).collect();
    let mut table = Table::new(vec![vec![Column::right("scan")], names]);
    rows(states).for_each(|row| table.row(row));
    table
}

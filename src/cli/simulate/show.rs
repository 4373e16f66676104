//! Output of a simulated run.

use petril::exchange::vcd;
use petril::explore::Failure;
use petril::flat::{FlatProgram, Hazard};
use petril::interpret::Fault;
use petril::semantics::VarId;
use petril::source::Source;
use petril::translate::System;
use petril::witness::{Column, ScanTrace, Table};

use crate::cli::args::Format;

/// Completed scans in the requested format.
pub fn text(system: &System, trace: &ScanTrace, format: Format, title: &str, width: usize) -> String {
    match format {
        Format::Csv => csv(&system.program, trace),
        Format::Vcd => vcd::write(system, trace, title),
        Format::Table => table(system, trace).within(width),
    }
}

/// Failure of the last scan with its position and a remedy.
pub fn explain(failure: Failure, scan: usize, program: &FlatProgram, source: &Source) -> String {
    let (line, hazard) = match failure {
        Failure::Hazard(line, hazard) => (line, hazard),
        Failure::Scan(Fault::TooLong) => return format!("scan {scan} takes too many instructions to wait for its end"),
        Failure::Scan(Fault::Endless) | Failure::NotSafe(_) => {
            return format!("scan {scan} never ends: it repeats a state");
        }
    };
    let (what, help) = match hazard {
        Hazard::Overflow => ("a number does not fit its type", "; with `--overflow wrap`, the simulation goes on"),
        Hazard::DivisionByZero => ("a number is divided by 0", "; with `--div0 zero`, the simulation goes on"),
        Hazard::Index => ("an index is outside its array", ""),
        Hazard::Subrange => ("a value is outside the subrange of its variable", ""),
    };
    let from = source.line_of(program.code[line].span.start);
    format!("in scan {scan}, {what} ({}:{from}: {}){help}", source.name(), source.line_text(from).trim())
}

/// Rows of the completed scans: number and declared variables.
fn rows(
    program: &FlatProgram,
    trace: &ScanTrace,
    text: impl Fn(VarId, u64) -> String,
) -> impl Iterator<Item = Vec<String>> {
    let ended = trace.scans.iter().filter_map(|scan| scan.end.as_ref());
    ended.enumerate().map(move |(position, end)| {
        let values = program.declared().map(|id| text(id, end.memory[id.0]));
        std::iter::once((position + 1).to_string()).chain(values).collect()
    })
}

fn csv(program: &FlatProgram, trace: &ScanTrace) -> String {
    let names = program.declared().map(|id| program.variable(id).name.clone());
    let head: Vec<String> = std::iter::once("cycle".to_owned()).chain(names).collect();
    let rows = rows(program, trace, |id, value| program.variable(id).ty.number(value).to_string());
    // Names of elements of multidimensional arrays contain commas.
    let cell = |cell: String| if cell.contains(',') { format!("\"{cell}\"") } else { cell };
    let line = |row: Vec<String>| row.into_iter().map(cell).collect::<Vec<_>>().join(",") + "\n";
    std::iter::once(head).chain(rows).map(line).collect()
}

/// Table of the declared variables and of the plant's moves, if there is a plant.
fn table(system: &System, trace: &ScanTrace) -> Table {
    let program = &system.program;
    let names = program.declared().map(|id| Column::right(&program.variable(id).name)).collect();
    let has_plant = !system.plant.components.is_empty();
    let plant = if has_plant { vec![Column::left("plant, before the scan")] } else { Vec::new() };
    let mut table = Table::new(vec![vec![Column::right("scan")], names, plant]);
    for (mut row, scan) in rows(program, trace, |id, value| program.value_text(id, value)).zip(&trace.scans) {
        row.extend(has_plant.then(|| scan.done(system)));
        table.row(&row);
    }
    table
}

//! Tests as a table (CSV): one row per test, with the inputs to set and the outputs to expect; also read back, possibly
//! edited.
//!
//! The first columns are `test`, `function`, `criterion` and `purpose`; each further column is a signal. Inputs without
//! column are at rest. Where an output has no value, the specification determines the expected one.

use fixedbitset::FixedBitSet;

use super::Sheets;
use crate::exchange::table::{self, uncovered};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::{Source, Span};
use petril_lang::syntax::ast::key;
use petril_spec::sif::{Coverage, Criterion, Kind, Plan, SignalId, Specification, Test};

/// Columns that are not signals.
const COLUMNS: [&str; 4] = ["test", "function", "criterion", "purpose"];

/// Writes the tests of all plans.
#[must_use]
pub fn write(sheets: &Sheets<'_>) -> String {
    let specification = sheets.specification;
    let (mut varied, mut touched) = (specification.valuation([]), specification.valuation([]));
    for plan in sheets.plans {
        plan.varied.iter().for_each(|input| varied.insert(input.0));
        plan.touched.iter().for_each(|output| touched.insert(output.0));
        for test in &plan.tests {
            let off = |input: &SignalId| test.values.contains(input.0) != specification.rest(*input);
            specification.inputs().filter(off).for_each(|input| varied.insert(input.0));
        }
    }
    let inputs: Vec<SignalId> = specification.inputs().filter(|input| varied.contains(input.0)).collect();
    let outputs: Vec<SignalId> = specification.outputs().filter(|output| touched.contains(output.0)).collect();
    let names = inputs.iter().chain(&outputs).map(|&signal| specification.name(signal).to_owned());
    let head: Vec<String> = COLUMNS.map(str::to_owned).into_iter().chain(names).collect();
    let rows = sheets.plans.iter().flat_map(|plan| {
        let (inputs, outputs) = (&inputs, &outputs);
        plan.tests.iter().enumerate().map(move |(number, test)| {
            let value = |signal: &SignalId| u8::from(test.values.contains(signal.0)).to_string();
            let expected =
                |output: &SignalId| if plan.touched.contains(output) { value(output) } else { String::new() };
            let function = specification.functions[plan.function].name.clone();
            let criterion = if sheets.origin.is_some() { "" } else { plan.criterion.name() };
            let mut row = vec![(number + 1).to_string(), function, criterion.to_owned(), test.purpose.join("; ")];
            row.extend(inputs.iter().map(value));
            row.extend(outputs.iter().map(expected));
            row
        })
    });
    table::write(std::iter::once(head).chain(rows))
}

/// Meaning of a column.
#[derive(Clone, Copy)]
enum Column {
    Fixed(usize),
    Signal(SignalId),
    Unknown,
}

/// Reads tests. Values are separated by commas, semicolons or tabs, as in the first row.
///
/// # Errors
/// Unknown columns, unknown functions, invalid values.
pub fn read(source: &Source, specification: &Specification) -> Result<Vec<Plan>, Vec<Diagnostic>> {
    let mut errors = Vec::new();
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .delimiter(separator(source.text()))
        .from_reader(source.text().as_bytes());
    let line = |position: Option<&csv::Position>| {
        let start = position.map_or(0, |position| position.byte() as usize);
        let length = source.text().get(start..).and_then(|rest| rest.lines().next()).map_or(0, str::len);
        Span::new(start, start + length)
    };
    let malformed = |error: &csv::Error| {
        let span = line(error.position());
        let csv::ErrorKind::UnequalLengths { expected_len, len, .. } = error.kind() else {
            return Diagnostic::new(Code::InputTable, span, error.to_string());
        };
        let message = format!("this row has {len} values, the first one {expected_len}");
        Diagnostic::new(Code::InputTable, span, message).help("give each column one value")
    };
    let head = match reader.headers() {
        Ok(head) if head.is_empty() => {
            let empty = Diagnostic::new(Code::InputTable, Span::default(), "this table of tests is empty");
            return Err(vec![empty.help("`petril sif tests --csv FILE` writes one")]);
        }
        Ok(head) => head.clone(),
        Err(error) => return Err(vec![malformed(&error)]),
    };
    let columns = columns(&head, line(head.position()), specification, &mut errors);
    let mut plans: Vec<Plan> = Vec::new();
    for record in reader.records() {
        let record = match record {
            Ok(record) => record,
            Err(error) => {
                errors.push(malformed(&error));
                continue;
            }
        };
        let span = line(record.position());
        match row(&record, &columns, span, specification) {
            Ok((function, criterion, test, outputs)) => {
                let found = plans.iter().position(|plan| plan.function == function);
                let position = found.unwrap_or_else(|| {
                    plans.push(empty(specification, function, criterion, &columns));
                    plans.len() - 1
                });
                let touched = &mut plans[position].touched;
                outputs.into_iter().for_each(|output| {
                    if !touched.contains(&output) {
                        touched.push(output);
                    }
                });
                plans[position].tests.push(test);
            }
            Err(diagnostic) => errors.push(diagnostic),
        }
    }
    if errors.is_empty() { Ok(plans) } else { Err(errors) }
}

/// Separator of values: the candidate that occurs most often in the first line.
pub fn separator(text: &str) -> u8 {
    let first = text.lines().next().unwrap_or_default();
    let count = |sign: u8| first.bytes().filter(|byte| *byte == sign).count();
    [b',', b';', b'\t'].into_iter().rev().max_by_key(|sign| count(*sign)).unwrap_or(b',')
}

fn empty(specification: &Specification, function: usize, criterion: Criterion, columns: &[Column]) -> Plan {
    let inputs = columns.iter().filter_map(|column| match column {
        Column::Signal(signal) if specification.definition(*signal).is_none() => Some(*signal),
        _ => None,
    });
    let touched = specification.functions[function].outputs.clone();
    Plan {
        function,
        criterion,
        varied: inputs.collect(),
        touched,
        tests: Vec::new(),
        incomplete: None,
        notes: Vec::new(),
        is_smallest: false,
        cubes: Vec::new(),
        coverage: Coverage::default(),
    }
}

fn columns(
    head: &csv::StringRecord,
    span: Span,
    specification: &Specification,
    errors: &mut Vec<Diagnostic>,
) -> Vec<Column> {
    let mut fixed = [false; 4];
    let mut seen = FixedBitSet::with_capacity(specification.signals.len());
    let is_known = |id: &SignalId| match &specification.signal(*id).kind {
        Kind::Input { .. } => true,
        Kind::Defined { is_output, .. } => *is_output,
    };
    let known: Vec<SignalId> = (0..specification.signals.len()).map(SignalId).filter(is_known).collect();
    let mut column = |name: &str| {
        let own = COLUMNS.iter().position(|column| *column == name).filter(|at| !fixed[*at]);
        if let Some(at) = own {
            fixed[at] = true;
            return Column::Fixed(at);
        }
        let signal = known.iter().copied().find(|id| key(specification.name(*id)) == key(name));
        let Some(signal) = signal else {
            let names = known.iter().map(|id| specification.name(*id)).chain(COLUMNS);
            let message = format!("there is no input or output `{name}`");
            errors.push(Diagnostic::new(Code::InputTable, span, message).suggest_at(errors.len(), name, names));
            return Column::Unknown;
        };
        if seen.put(signal.0) {
            let message = format!("two columns are named `{name}`");
            errors.push(Diagnostic::new(Code::InputTable, span, message).help("remove one of them"));
        }
        Column::Signal(signal)
    };
    head.iter().map(&mut column).collect()
}

type Row = (usize, Criterion, Test, Vec<SignalId>);

/// A test, with the outputs for which the row has a value.
fn row(
    record: &csv::StringRecord,
    columns: &[Column],
    span: Span,
    specification: &Specification,
) -> Result<Row, Diagnostic> {
    let problem = |message: String, help: &str| Diagnostic::new(Code::InputTable, span, message).help(help);
    let mut function = Some(0).filter(|_| specification.functions.len() == 1);
    let mut criterion = Criterion::All;
    let mut purpose = Vec::new();
    let mut values = specification.valuation(specification.inputs().filter(|input| specification.rest(*input)));
    let mut expected: Vec<(SignalId, bool)> = Vec::new();
    for (column, cell) in columns.iter().zip(record) {
        match column {
            Column::Fixed(1) => {
                let position = specification.functions.iter().position(|own| own.name.eq_ignore_ascii_case(cell));
                let names = specification.functions.iter().map(|function| function.name.as_str());
                function = Some(position.ok_or_else(|| {
                    Diagnostic::new(Code::InputTable, span, format!("there is no function `{cell}`"))
                        .suggest(cell, names)
                })?);
            }
            Column::Fixed(2) => {
                criterion = Criterion::ALL.into_iter().find(|one| one.name() == cell).unwrap_or(criterion);
            }
            Column::Fixed(3) if !cell.is_empty() => purpose = uncovered(cell).split("; ").map(str::to_owned).collect(),
            Column::Fixed(_) | Column::Unknown => {}
            Column::Signal(signal) => {
                let is_input = specification.definition(*signal).is_none();
                let value = match cell {
                    "1" => true,
                    "0" => false,
                    _ if cell.eq_ignore_ascii_case("TRUE") => true,
                    _ if cell.eq_ignore_ascii_case("FALSE") => false,
                    "" => continue,
                    _ => {
                        return Err(problem(
                            format!("`{cell}` is no value of `{}`", specification.name(*signal)),
                            "write 0 or 1",
                        ));
                    }
                };
                if is_input { values.set(signal.0, value) } else { expected.push((*signal, value)) }
            }
        }
    }
    let Some(function) = function else {
        return Err(problem("nothing says which function this tests".to_owned(), "add a column `function`"));
    };
    let mut values = specification.settled(&values);
    expected.iter().for_each(|&(output, value)| values.set(output.0, value));
    let outputs = expected.into_iter().map(|(output, _)| output).collect();
    Ok((function, criterion, Test { values, purpose }, outputs))
}

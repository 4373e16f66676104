//! Tables of inputs (CSV): names in the first row, then one row of values per scan.

use std::collections::BTreeSet;

use petril::diagnostic::{Code, Diagnostic};
use petril::flat::{FlatProgram, Restriction};
use petril::logic;
use petril::semantics::{Role, VarId};
use petril::source::{Source, Span};
use petril::syntax::ast::key;

/// Reads a table of inputs: the values set by each row.
pub fn read(source: &Source, program: &FlatProgram) -> Result<Vec<Vec<(VarId, u64)>>, Vec<Diagnostic>> {
    let mut errors = Vec::new();
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(source.text().as_bytes());
    // The CSV reader reports no columns, so a diagnostic points at the whole line.
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
            let Some(input) = *input else { continue };
            match value(program, input, cell) {
                Some(value) => row.push((input, value)),
                None => {
                    let message = format!("`{cell}` is no value of type `{}`", program.variable(input).ty);
                    let problem = Diagnostic::new(Code::InputTable, line(record.position()), message);
                    errors.push(problem.help(values(program, input)));
                }
            }
        }
        rows.push(row);
    }
    if errors.is_empty() { Ok(rows) } else { Err(errors) }
}

/// Diagnostic of a malformed row.
fn malformed(error: &csv::Error, span: Span) -> Diagnostic {
    let csv::ErrorKind::UnequalLengths { expected_len, len, .. } = error.kind() else {
        return Diagnostic::new(Code::InputTable, span, error.to_string());
    };
    let message =
        format!("this row has another number of values ({len}) than the first row has names ({expected_len})");
    Diagnostic::new(Code::InputTable, span, message).help("give each input one value, separated by commas")
}

/// Help on valid values of an input.
pub fn values(program: &FlatProgram, input: VarId) -> String {
    let (least, greatest) = program.range(input);
    match program.restrictions.get(&input) {
        _ if program.variable(input).ty.is_bool() => "write 0 or 1".to_owned(),
        Some(Restriction::Enumeration(names)) => format!("write one of {}", names.join(", ")),
        _ => format!("write a number from {least} to {greatest}"),
    }
}

/// Parses a value of an input: TRUE, FALSE, a name, or a number; times are in milliseconds or literals.
pub fn value(program: &FlatProgram, input: VarId, text: &str) -> Option<u64> {
    let ty = program.variable(input).ty;
    let (least, greatest) = program.range(input);
    let number = match text {
        _ if ty.is_bool() && text.eq_ignore_ascii_case("FALSE") => Some(0),
        _ if ty.is_bool() && text.eq_ignore_ascii_case("TRUE") => Some(1),
        _ => program.enumerated(input, text).or_else(|| logic::number(text).ok()),
    };
    number.filter(|number| (least..=greatest).contains(number)).map(|number| ty.pattern(number))
}

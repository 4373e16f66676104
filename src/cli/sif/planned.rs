//! The tests of some functions: made by a criterion, or read from a table.

use std::path::Path;

use petril::exchange::sif::plan_csv;
use petril::sif::{self, Criterion, Excluded, Limits, Plan, Specification};

use crate::cli::Failure;
use crate::cli::console::Console;
use crate::cli::input::{MAX_TEXT, source};

/// The positions of functions by their names; all of them if none is named.
pub fn functions(names: &[String], specification: &Specification) -> Result<Vec<usize>, Failure> {
    let known = || specification.functions.iter();
    if names.is_empty() {
        return Ok((0..specification.functions.len()).collect());
    }
    let found = names.iter().map(|name| {
        let position = known().position(|function| function.name.eq_ignore_ascii_case(name));
        position.ok_or_else(|| {
            let names: Vec<&str> = known().map(|function| function.name.as_str()).take(20).collect();
            Failure::Message(format!("there is no function `{name}`; there are {}", names.join(", ")))
        })
    });
    found.collect()
}

/// The tests that a criterion chooses.
pub fn made(specification: &Specification, functions: &[usize], criterion: Criterion) -> Vec<Plan> {
    let limits = Limits::default();
    functions.iter().map(|&function| sif::plan(specification, function, criterion, &limits)).collect()
}

/// What is left out.
pub fn excluded(specification: &Specification, functions: &[usize]) -> Vec<Excluded> {
    let limits = Limits::default();
    functions.iter().map(|&function| sif::excluded(specification, function, &limits)).collect()
}

/// The tests of a table, of these functions.
pub fn read(
    path: &Path,
    specification: &Specification,
    functions: &[usize],
    console: &Console,
) -> Result<Vec<Plan>, Failure> {
    let source = source(path, MAX_TEXT, console)?;
    let plans = plan_csv::read(&source, specification).map_err(|diagnostics| {
        console.diagnostics(&diagnostics, &source);
        Failure::Reported
    })?;
    let plans: Vec<Plan> = plans.into_iter().filter(|plan| functions.contains(&plan.function)).collect();
    if plans.is_empty() {
        return Err(Failure::Message(format!("`{}` has no test of these functions", path.display())));
    }
    Ok(plans)
}

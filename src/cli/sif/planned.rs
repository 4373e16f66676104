//! The tests of some functions: made by a criterion, or read from a table.

use std::path::Path;
use std::sync::Arc;

use petril::diagnostic::nearest;
use petril::exchange::sif::plan_csv;
use petril::printable::line;
use petril::sif::{Criterion, Excluded, Limits, Plan, Specification, coverage_of, excluded, plan};
use rayon::prelude::*;

use crate::cli::console::Console;
use crate::cli::input::{MAX_TEXT, source};
use crate::cli::{Failure, guard, shown};

/// The positions of functions by their names; all of them if none is named.
pub fn functions(names: &[String], specification: &Specification) -> Result<Vec<usize>, Failure> {
    let known = || specification.functions.iter();
    if names.is_empty() {
        return Ok((0..specification.functions.len()).collect());
    }
    let found = names.iter().map(|name| {
        let position = known().position(|function| function.name.eq_ignore_ascii_case(name));
        position.ok_or_else(|| {
            let near = nearest(name, known().map(|function| function.name.as_str()));
            let near = near.map(|near| format!("; did you mean `{near}`?")).unwrap_or_default();
            Failure::Message(line(&format!("the specification has no function `{name}`{near}")))
        })
    });
    found.collect()
}

/// The tests that a criterion chooses.
pub fn made(specification: &Specification, functions: &[usize], criterion: Criterion, limits: &Limits) -> Vec<Plan> {
    functions.par_iter().map(|&function| plan(specification, function, criterion, limits)).collect()
}

/// What is left out of these plans.
pub fn left_out(specification: &Specification, plans: &[Plan], limits: &Limits) -> Vec<Excluded> {
    plans.par_iter().map(|plan| excluded(specification, plan.function, limits)).collect()
}

/// The usual limits, until somebody interrupts the work.
pub fn limits() -> Limits {
    Limits { stop: Arc::new(guard::is_asked), ..Limits::default() }
}

/// The tests of a table, of these functions, with the faults that they find.
pub fn read(
    path: &Path,
    specification: &Specification,
    functions: &[usize],
    limits: &Limits,
    console: &Console,
) -> Result<Vec<Plan>, Failure> {
    let source = source(path, MAX_TEXT, console)?;
    let plans = plan_csv::read(&source, specification).map_err(|diagnostics| {
        console.diagnostics(&diagnostics, &source);
        Failure::Reported
    })?;
    let mut plans: Vec<Plan> = plans.into_iter().filter(|plan| functions.contains(&plan.function)).collect();
    plans.par_iter_mut().for_each(|plan| {
        let tests: Vec<_> = plan.tests.iter().map(|test| test.values.clone()).collect();
        plan.coverage = coverage_of(specification, plan.function, &tests, limits);
    });
    if plans.is_empty() {
        return Err(Failure::Message(format!("`{}` has no test of these functions", shown(path))));
    }
    Ok(plans)
}

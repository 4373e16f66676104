//! `petril sif excluded`: triggering valuations excluded by restrictions.

use std::process::ExitCode;

use fixedbitset::FixedBitSet;
use petril::sif::{self, Excluded, Limits, Specification, about};
use petril::witness::{Column, Table};

use super::args::SifExcluded;
use super::{planned, specification, valuations};
use crate::cli::console::Console;
use crate::cli::{Outcome, SUCCESS, phase};

pub fn run(arguments: &SifExcluded, console: &Console) -> Outcome {
    let read = specification(&arguments.specification, console)?;
    let functions = planned::functions(&arguments.function, &read.specification)?;
    let limits = Limits { tests: arguments.limit, ..planned::limits() };
    phase::begin_asking("counting valuations");
    let (mut texts, mut is_counted) = (Vec::new(), true);
    for function in functions {
        let excluded = sif::excluded(&read.specification, function, &limits);
        is_counted &= excluded.excluded.is_some();
        texts.push(text(&read.specification, function, &excluded, console.output_width()));
    }
    console.print_report(&texts.join("\n"), &console.provenance(), false)?;
    Ok(if is_counted { SUCCESS } else { ExitCode::from(3) })
}

/// Excluded valuations of a function.
fn text(specification: &Specification, function: usize, excluded: &Excluded, width: usize) -> String {
    let name = &specification.functions[function].name;
    let (Some(triggering), Some(count)) = (&excluded.triggering, &excluded.excluded) else {
        return format!("{name}: {} valuations, too many to tell which are excluded\n", about(&excluded.valuations));
    };
    let (all, triggering, count) = (about(&excluded.valuations), about(triggering), about(count));
    let mut out =
        format!("{name}: of {all} valuations, {triggering} make an output TRUE; {count} of these are excluded\n");
    if excluded.by_restriction.is_empty() {
        return out;
    }
    let heads = ["excludes", "and no other does"].map(Column::right).to_vec();
    let mut table = Table::new(vec![vec![Column::left("restriction")], heads, vec![Column::left("which says")]]);
    for (position, its, only) in &excluded.by_restriction {
        let restriction = &specification.restrictions[*position];
        table.row(&[restriction.name.clone(), about(its), about(only), restriction.text.clone()]);
    }
    out += &format!("\n{}\n", table.within(width));
    match &excluded.listed {
        Some(listed) => out + &each(specification, excluded, listed).within(width),
        None => out + "some of these, as cubes\n" + &valuations::cubes(specification, &excluded.cubes),
    }
}

/// Table of the excluded valuations with the restrictions that exclude them.
fn each(specification: &Specification, excluded: &Excluded, listed: &[(FixedBitSet, Vec<usize>)]) -> Table {
    let inputs = if excluded.varied.len() <= 24 { excluded.varied.as_slice() } else { &[] };
    let mut table = valuations::table(specification, inputs, vec![vec![Column::left("excluded by")]]);
    for (number, (valuation, by)) in listed.iter().enumerate() {
        // Inputs that do not vary are shown at rest.
        let mut whole = specification.valuation(specification.inputs().filter(|input| specification.rest(*input)));
        excluded.varied.iter().for_each(|input| whole.set(input.0, valuation.contains(input.0)));
        let names: Vec<&str> = by.iter().map(|at| specification.restrictions[*at].name.as_str()).collect();
        let mut cells = vec![(number + 1).to_string()];
        cells.extend(valuations::cells(specification, inputs, &whole));
        cells.push(names.join(", "));
        table.row(&cells);
    }
    table
}

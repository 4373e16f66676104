//! Valuations of inputs as text.

use fixedbitset::FixedBitSet;
use petril::sif::{Cube, SignalId, Specification};
use petril::witness::{Column, Table};

/// Maximum number of inputs with a column each.
const MAX_COLUMNS: usize = 24;

/// Inputs with a column: those that vary and those not at rest; none if there are too many.
pub fn columns(specification: &Specification, varied: &[SignalId], valuations: &[&FixedBitSet]) -> Vec<SignalId> {
    let is_off =
        |input: &SignalId| valuations.iter().any(|valuation| valuation.contains(input.0) != specification.rest(*input));
    let others = specification.inputs().filter(|input| !varied.contains(input)).filter(is_off);
    let columns: Vec<SignalId> = varied.iter().copied().chain(others).collect();
    if columns.len() > MAX_COLUMNS { Vec::new() } else { columns }
}

/// Table with a number and inputs as its first columns, followed by `further`.
pub fn table(specification: &Specification, inputs: &[SignalId], further: Vec<Vec<Column>>) -> Table {
    let mut heads: Vec<Column> = inputs.iter().map(|input| Column::right(specification.name(*input))).collect();
    if heads.is_empty() {
        heads.push(Column::left("inputs that are not at rest"));
    }
    let mut groups = vec![vec![Column::right("test")], heads];
    groups.extend(further);
    Table::new(groups)
}

/// Cells of a valuation: one per input, or a single one listing all inputs not at rest.
pub fn cells(specification: &Specification, inputs: &[SignalId], valuation: &FixedBitSet) -> Vec<String> {
    if inputs.is_empty() {
        let off = specification.inputs().filter(|input| valuation.contains(input.0) != specification.rest(*input));
        let text: Vec<String> = off.map(|input| literal(specification, input, valuation.contains(input.0))).collect();
        return vec![if text.is_empty() { "all at rest".to_owned() } else { text.join(" ") }];
    }
    inputs.iter().map(|input| bit(valuation.contains(input.0))).collect()
}

/// Bit as 0 or 1.
pub fn bit(value: bool) -> String {
    u8::from(value).to_string()
}

/// List of cubes, one per line.
pub fn cubes(specification: &Specification, cubes: &[Cube]) -> String {
    let line = |cube: &Cube| {
        let ones = cube.ones.iter().map(|input| literal(specification, *input, true));
        let all: Vec<String> =
            ones.chain(cube.zeros.iter().map(|input| literal(specification, *input, false))).collect();
        format!("  {}\n", if all.is_empty() { "all".to_owned() } else { all.join(" ") })
    };
    cubes.iter().map(line).collect()
}

/// Literal: the input, or `!` and the input.
fn literal(specification: &Specification, input: SignalId, value: bool) -> String {
    format!("{}{}", if value { "" } else { "!" }, specification.name(input))
}

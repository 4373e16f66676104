//! Valuations of inputs in lines of a terminal.

use fixedbitset::FixedBitSet;
use petril::sif::{Cube, SignalId, Specification};
use petril::witness::{Column, Table};

/// Most inputs that have a column each.
const MAX_COLUMNS: usize = 24;

/// Which inputs have a column: those that vary, and those that are not at rest; none if they are too many.
pub fn columns(specification: &Specification, varied: &[SignalId], valuations: &[&FixedBitSet]) -> Vec<SignalId> {
    let is_off =
        |input: &SignalId| valuations.iter().any(|valuation| valuation.contains(input.0) != specification.rest(*input));
    let others = specification.inputs().filter(|input| !varied.contains(input)).filter(is_off);
    let columns: Vec<SignalId> = varied.iter().copied().chain(others).collect();
    if columns.len() > MAX_COLUMNS { Vec::new() } else { columns }
}

/// A table whose rows begin with a number and inputs, and end with further columns.
pub fn table(specification: &Specification, inputs: &[SignalId], further: Vec<Vec<Column>>) -> Table {
    let mut heads: Vec<Column> = inputs.iter().map(|input| Column::right(specification.name(*input))).collect();
    if heads.is_empty() {
        heads.push(Column::left("inputs that are not at rest"));
    }
    let mut groups = vec![vec![Column::right("test")], heads];
    groups.extend(further);
    Table::new(groups)
}

/// The cells of a valuation: one for each column, or one for all inputs that are not at rest.
pub fn cells(specification: &Specification, inputs: &[SignalId], valuation: &FixedBitSet) -> Vec<String> {
    if inputs.is_empty() {
        let off = specification.inputs().filter(|input| valuation.contains(input.0) != specification.rest(*input));
        let text: Vec<String> = off.map(|input| literal(specification, input, valuation.contains(input.0))).collect();
        return vec![if text.is_empty() { "all at rest".to_owned() } else { text.join(" ") }];
    }
    inputs.iter().map(|input| bit(valuation.contains(input.0))).collect()
}

/// 0 or 1.
pub fn bit(value: bool) -> String {
    u8::from(value).to_string()
}

/// Cubes, one on each line.
pub fn cubes(specification: &Specification, cubes: &[Cube]) -> String {
    let line = |cube: &Cube| {
        let ones = cube.ones.iter().map(|input| literal(specification, *input, true));
        let all: Vec<String> =
            ones.chain(cube.zeros.iter().map(|input| literal(specification, *input, false))).collect();
        format!("  {}\n", if all.is_empty() { "all".to_owned() } else { all.join(" ") })
    };
    cubes.iter().map(line).collect()
}

/// An input that is TRUE, or `!` and an input that is FALSE.
fn literal(specification: &Specification, input: SignalId, value: bool) -> String {
    format!("{}{}", if value { "" } else { "!" }, specification.name(input))
}

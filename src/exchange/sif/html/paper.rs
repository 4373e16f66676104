//! Formulas for people: parentheses wherever two operators meet, and a line for each operand of a long one.

use crate::sif::{Formula, Operator, Specification};

/// A formula is broken into lines if it is longer.
const MAX_LINE: usize = 72;

/// An equation.
pub fn equation(specification: &Specification, name: &str, formula: &Formula) -> String {
    let line = text(specification, formula, false);
    let Formula::Gate(operator, operands) = formula else { return format!("{name} = {line}") };
    if name.chars().count() + line.chars().count() <= MAX_LINE || is_among(*operator) {
        return format!("{name} = {line}");
    }
    let lines: Vec<String> = operands.iter().map(|operand| text(specification, operand, true)).collect();
    format!("{name} =\n    {}", lines.join(&format!("\n  {} ", operator.symbol())))
}

/// A formula on one line, in parentheses if it has an operator and stands within another one.
fn text(specification: &Specification, formula: &Formula, is_within: bool) -> String {
    match formula {
        Formula::Constant(value) => if *value { "TRUE" } else { "FALSE" }.to_owned(),
        Formula::Signal(signal) => specification.name(*signal).to_owned(),
        Formula::Not(inner) => format!("!{}", text(specification, inner, true)),
        Formula::Gate(operator, operands) => {
            let is_among = is_among(*operator);
            let inner: Vec<String> = operands.iter().map(|operand| text(specification, operand, !is_among)).collect();
            match (is_among, is_within) {
                (true, _) => format!("{} ({})", operator.symbol(), inner.join(", ")),
                (false, true) => format!("({})", inner.join(&format!(" {} ", operator.symbol()))),
                (false, false) => inner.join(&format!(" {} ", operator.symbol())),
            }
        }
    }
}

fn is_among(operator: Operator) -> bool {
    matches!(operator, Operator::AtMostOne | Operator::ExactlyOne)
}

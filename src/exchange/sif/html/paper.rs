//! Formulas for print: parentheses wherever two operators meet, and a line for each operand of a long one.

use petril_spec::sif::{Formula, Operator, SignalId, Specification};

/// Length in characters beyond which a formula is broken into lines.
const MAX_LINE: usize = 72;

/// Text of an equation.
///
/// Auxiliary values of its own function are shown without `prefix`.
pub fn equation(specification: &Specification, prefix: &str, name: &str, formula: &Formula) -> String {
    let short = |signal: SignalId| {
        let name = specification.name(signal);
        name.strip_prefix(prefix).unwrap_or(name)
    };
    let name = name.strip_prefix(prefix).unwrap_or(name);
    let line = text(&short, formula, false);
    let Formula::Gate(operator, operands) = formula else { return format!("{name} = {line}") };
    if name.chars().count() + line.chars().count() <= MAX_LINE || is_among(*operator) {
        return format!("{name} = {line}");
    }
    let lines: Vec<String> = operands.iter().map(|operand| text(&short, operand, true)).collect();
    format!("{name} =\n    {}", lines.join(&format!("\n  {} ", operator.symbol())))
}

/// A formula on one line, in parentheses if it has an operator and is an operand.
fn text<'n>(name: &impl Fn(SignalId) -> &'n str, formula: &Formula, is_within: bool) -> String {
    match formula {
        Formula::Constant(value) => if *value { "TRUE" } else { "FALSE" }.to_owned(),
        Formula::Signal(signal) => name(*signal).to_owned(),
        Formula::Not(inner) => format!("!{}", text(name, inner, true)),
        Formula::Gate(operator, operands) => {
            let is_among = is_among(*operator);
            let inner: Vec<String> = operands.iter().map(|operand| text(name, operand, !is_among)).collect();
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

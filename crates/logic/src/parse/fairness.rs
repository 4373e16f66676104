//! Parser of fairness assumptions, like `again and again !start`.

use pest::Parser;
use pest::iterators::Pair;

use super::{RequirementParser, Rule, checked_formula, diagnostic, name_of, one_line, span};
use crate::fairness::{FairnessText, Recurrence};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::{Source, Span};

/// Help text with the forms of a line.
pub(super) const LIKE_LINE: &str = "write it like `fair released \"what it says\": again and again !start;`, `fair: if again \
                                    and again coil then again and again contact;`, `fair: released(start, reset);` or \
                                    `fair: plant;`";

/// Parses a text that is one fairness assumption, like `again and again !start`.
///
/// # Errors
/// The syntax error.
pub fn parse_fairness(source: &Source) -> Result<FairnessText, Diagnostic> {
    let text = source.text();
    let pairs = RequirementParser::parse(Rule::lone_fairness, text).map_err(|error| {
        let diagnostic = diagnostic(&error, text, 0);
        let help = "an assumption is like `again and again !start`, `if again and again coil then again and again contact`, \
                    `released(start, reset)` or `plant`";
        if diagnostic.help.is_empty() { diagnostic.help(help) } else { diagnostic }
    })?;
    match pairs.flatten().find(|pair| pair.as_rule() == Rule::fairness) {
        Some(pair) => fairness(pair),
        None => Err(Diagnostic::new(Code::RequirementSyntax, Span::default(), "there is no assumption")),
    }
}

/// Converts a pair of the rule `fair_line`.
pub(super) fn fair_line(pair: Pair<'_, Rule>) -> Result<FairnessText, Diagnostic> {
    let (mut name, mut sentence, mut says) = (None, None, None);
    let line = span(&pair);
    for piece in pair.into_inner() {
        match piece.as_rule() {
            Rule::identifier => name = Some(piece.as_str().to_owned()),
            Rule::sentence => sentence = Some(piece.as_str().trim_matches('"').to_owned()),
            Rule::fairness => says = Some(fairness(piece)?),
            _ => {}
        }
    }
    let says = says.ok_or_else(|| Diagnostic::new(Code::RequirementSyntax, line, "this line assumes nothing"))?;
    Ok(FairnessText { name, sentence, ..says })
}

/// Converts a pair of the rule `fairness`.
fn fairness(pair: Pair<'_, Rule>) -> Result<FairnessText, Diagnostic> {
    let (span, text) = (span(&pair), one_line(pair.as_str()));
    let (mut formulas, mut names, mut value) = (Vec::new(), Vec::new(), false);
    for piece in pair.into_inner().flat_map(Pair::into_inner) {
        match piece.as_rule() {
            Rule::formula => formulas.push(checked_formula(piece)?),
            Rule::input_value => value = piece.as_str().eq_ignore_ascii_case("pressed"),
            Rule::name => names.push((name_of(&piece), super::span(&piece))),
            _ => {}
        }
    }
    let mut formulas = formulas.into_iter();
    let recurrence = match (formulas.next(), formulas.next()) {
        (Some(premise), Some(goal)) => Recurrence::Strong { premise, goal },
        (Some(goal), None) => Recurrence::Weak(goal),
        _ if names.is_empty() => Recurrence::Plant,
        _ => Recurrence::Inputs { value, names },
    };
    Ok(FairnessText { name: None, sentence: None, recurrence, text, span })
}

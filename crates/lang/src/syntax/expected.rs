//! Syntax errors of IL as diagnostics: the expected tokens in the words of the language instead of rule names.

use pest::Parser;
use pest::error::Error;

use super::parse::{IlParser, Rule};
use petril_base::diagnostic::{self, Code, Diagnostic};
use petril_base::source::Span;

/// Parses a piece of text again by the rule that should have read it, and says why that fails. `start` is the piece's
/// offset in the whole text.
pub fn explain(rule: Rule, text: &str, start: usize) -> Diagnostic {
    match IlParser::parse(rule, text) {
        Err(error) => diagnostic(&error, text, start),
        Ok(_) => Diagnostic::new(Code::Syntax, Span::new(start, start + text.len()), "this cannot stand here"),
    }
}

/// Converts a pest error to a diagnostic.
pub fn diagnostic(error: &Error<Rule>, text: &str, start: usize) -> Diagnostic {
    let diagnostic = diagnostic::expected(error, (text, start), Code::Syntax, "the end of the line", name);
    diagnostic::plain_letters(diagnostic, (text, start))
}

fn name(rule: Rule) -> Option<&'static str> {
    Some(match rule {
        Rule::EOI | Rule::eol => "the end of the line",
        Rule::identifier | Rule::declared => "a name",
        Rule::operand | Rule::constant | Rule::variable | Rule::symbolic_variable => "an operand",
        Rule::operator | Rule::expr_operator | Rule::instruction => "an instruction",
        Rule::label => "a label",
        Rule::type_spec
        | Rule::type_name
        | Rule::other_type
        | Rule::array
        | Rule::structure
        | Rule::enumeration
        | Rule::subrange => "a type",
        Rule::initial | Rule::initial_list | Rule::initial_structure => "an initial value",
        Rule::colon => "`:`",
        Rule::assign => "`:=`",
        Rule::semicolon => "`;`",
        Rule::declaration => "a declaration like `a : BOOL;`",
        Rule::argument | Rule::arguments | Rule::named | Rule::negated_output => "a parameter",
        Rule::range => "a range like `0..9`",
        Rule::type_declaration => "a type like `Level : INT (0..100);`",
        _ => return None,
    })
}

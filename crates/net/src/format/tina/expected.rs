//! Descriptions of what the grammar expected, in terms of the format.

use pest::Parser;
use pest::error::Error;

use super::read::{Rule, TinaParser};
use super::write;
use petril_base::diagnostic::{self, Code, Diagnostic};
use petril_base::source::Span;

/// Words that a line can begin with.
const WORDS: [&str; 3] = ["net", "pl", "tr"];

/// Explains why a line cannot be parsed. `start` is its offset in the whole text.
pub fn explain(line: &str, start: usize) -> Diagnostic {
    let diagnostic = match TinaParser::parse(Rule::lone_line, line) {
        Err(error) => diagnostic(&error, line, start),
        Ok(_) => Diagnostic::new(Code::NetSyntax, Span::new(start, start + line.len()), "this cannot stand here"),
    };
    let at = diagnostic.span().start - start;
    let (before, rest) = line.split_at_checked(at).unwrap_or((line, ""));
    let word = line.split_whitespace().next().unwrap_or_default();
    if before.trim().is_empty() {
        return diagnostic
            .suggest(word, WORDS)
            .help("a line is `net NAME`, `pl PLACE (1)` or `tr NAME PLACES -> PLACES`");
    }
    let here = rest.split_whitespace().next().unwrap_or_default();
    if write::WORDS.contains(&here) {
        return diagnostic.help(format!("`{here}` begins a declaration; a node of this name is written `{{{here}}}`"));
    }
    if rest.starts_with('{') {
        return diagnostic
            .help("a name in braces ends with `}`; a brace or backslash inside it is written `\\{`, `\\}`, `\\\\`");
    }
    if rest.starts_with(['?', '!']) {
        return diagnostic.help("only arcs to a transition can test: write the test before `->`");
    }
    let glued = before.ends_with(|c: char| c.is_ascii_alphanumeric() || c == '_' || c == '\'');
    if glued && !rest.is_empty() || rest.starts_with(|c: char| c.is_alphanumeric() && !c.is_ascii()) {
        return diagnostic.help("put a name with other characters than letters, digits, `_` and `'` in braces");
    }
    match word {
        "pl" => diagnostic.help("write a place as `pl NAME (1)`, and its arcs in the lines of the transitions"),
        "tr" => diagnostic.help("write a transition as `tr NAME PLACES -> PLACES` on one line"),
        _ => diagnostic,
    }
}

/// Converts a pest error.
pub fn diagnostic(error: &Error<Rule>, text: &str, start: usize) -> Diagnostic {
    diagnostic::expected(error, (text, start), Code::NetSyntax, "the end of the line", name)
}

/// Names of the rules that users know. Labels, intervals and weights are rare, so they are not listed as expected.
fn name(rule: Rule) -> Option<&'static str> {
    Some(match rule {
        Rule::EOI | Rule::eol => "the end of the line",
        Rule::lone_line => "`net`, `pl` or `tr`",
        Rule::bare | Rule::braced | Rule::input | Rule::output => "a name",
        Rule::number => "a number",
        Rule::marking => "a marking like `(1)`",
        Rule::arrow => "`->`",
        _ => return None,
    })
}

//! Syntax errors as diagnostics: the expected tokens in the words of the language instead of rule names.

use pest::RuleType;
use pest::error::{Error, ErrorVariant, InputLocation};

use super::{Code, Diagnostic};
use crate::source::Span;

/// Converts a grammar's error on a piece of text to a diagnostic.
///
/// `start` is the piece's offset in the whole text, `end` the name of its end in messages, and `name` that of a rule;
/// rules without a name are not listed.
pub fn expected<R: RuleType>(
    error: &Error<R>,
    (text, start): (&str, usize),
    code: Code,
    end: &str,
    name: impl Fn(R) -> Option<&'static str>,
) -> Diagnostic {
    let at = match error.location {
        InputLocation::Pos(at) | InputLocation::Span((at, _)) => at.min(text.len()),
    };
    // The end of the text is where its last word ends.
    let at = if text[at..].trim().is_empty() { at.min(text.trim_end().len()) } else { at };
    // Blanks that the grammar does not know are not part of a token.
    let blanks = text[at..].find(|c: char| c == '\n' || !c.is_whitespace()).unwrap_or(0);
    let at = at + blanks;
    let token = first_token(&text[at..]);
    let span = Span::new(start + at, start + at + token.len());
    let found = if token.is_empty() { end.to_owned() } else { format!("`{token}`") };
    let ErrorVariant::ParsingError { positives, .. } = &error.variant else {
        // The depth of the parser is limited, so that no text overflows the program's stack.
        return Diagnostic::new(code, Span::new(start + at, start + at), "what stands here is nested too deeply");
    };
    let mut names: Vec<&str> = Vec::new();
    for name in positives.iter().filter_map(|&rule| name(rule)) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let message = match names.split_last() {
        None => format!("{found} cannot stand here"),
        Some((last, [])) => format!("expected {last}, found {found}"),
        Some((last, others)) => format!("expected {} or {last}, found {found}", others.join(", ")),
    };
    Diagnostic::new(code, span, message)
}

/// Reports a letter with an accent as what is wrong, not the end of a name before it; for languages whose names are
/// made of plain letters.
pub fn plain_letters(diagnostic: Diagnostic, (text, start): (&str, usize)) -> Diagnostic {
    let at = diagnostic.span().start - start;
    match text[at..].chars().next() {
        Some(c) if c.is_alphabetic() && !c.is_ascii() => {
            let span = Span::new(start + at, start + at + c.len_utf8());
            let message = format!("the letter `{c}` cannot be part of a name");
            Diagnostic::new(diagnostic.code, span, message).help("names are made of the letters A to Z, digits and `_`")
        }
        _ => diagnostic,
    }
}

/// First token of a text: a word or a few signs; empty if only white space is left.
fn first_token(text: &str) -> &str {
    let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == '.' || c == '#';
    let end = match text.chars().next() {
        Some(c) if c.is_whitespace() => text.find('\n').filter(|_| !text.trim().is_empty()).map(|_| 0),
        Some(c) if is_word(c) => text.find(|c| !is_word(c)),
        Some(c) if "()[]{};,\"'".contains(c) => Some(1),
        Some(_) => text.find(|c: char| is_word(c) || c.is_whitespace() || "()[]{};,\"'".contains(c)),
        None => None,
    };
    text[..end.unwrap_or(text.len())].trim()
}

#[cfg(test)]
mod tests {
    use super::first_token;

    #[test]
    fn tokens_are_words_or_signs() {
        let cases = [("MAX(T#1s", "MAX"), ("-> b", "->"), ("))", ")"), ("x.y#1 z", "x.y#1"), ("", ""), (" \n", "")];
        for (text, token) in cases {
            assert_eq!(first_token(text), token, "{text:?}");
        }
    }
}

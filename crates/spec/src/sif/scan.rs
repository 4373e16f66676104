//! Checks before a file is parsed: unclosed texts and comments, and parentheses nested too deep.

use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

/// Upper bound on nested parentheses, and on consecutive implications, so that recursion over formulas stays within the
/// stack.
pub(super) const MAX_DEPTH: usize = 100;

/// Position of the innermost unclosed `{`, if any; an error if the file cannot be read at all.
pub(super) fn scan(text: &str) -> Result<Option<usize>, Diagnostic> {
    let bytes = text.as_bytes();
    let error = |at: usize, length: usize, message: String, help: &str| {
        Err(Diagnostic::new(Code::SifSyntax, Span::new(at, at + length), message).help(help))
    };
    let (mut at, mut depth) = (0, 0_usize);
    let mut open = Vec::new();
    // A text that contains the ends of a statement and a line has probably lost its quotation mark.
    let mut doubtful = None;
    while at < bytes.len() {
        let rest = &text[at..];
        match bytes[at] {
            b'"' => {
                let Some(length) = rest[1..].find('"') else {
                    let at = doubtful.unwrap_or(at);
                    return error(at, 1, "this text is never closed".to_owned(), "close it with `\"`");
                };
                if doubtful.is_none() && loses_its_end(&rest[1..=length]) {
                    doubtful = Some(at);
                }
                at += length + 2;
                continue;
            }
            b'/' if rest.starts_with("//") => {
                at += rest.find(['\n', '\r']).unwrap_or(rest.len());
                continue;
            }
            b'(' if rest.starts_with("(*") => {
                let Some(length) = rest[2..].find("*)") else {
                    return error(at, 2, "this comment is never closed".to_owned(), "close it with `*)`");
                };
                at += length + 4;
                continue;
            }
            b'{' => {
                open.push(at);
                depth += 1;
            }
            b'}' => {
                open.pop();
                depth = depth.saturating_sub(1);
            }
            b'(' => depth += 1,
            b')' => depth = depth.saturating_sub(1),
            // At most a zone, a function and a section are open.
            b';' => depth = depth.min(3),
            _ => {}
        }
        if depth > MAX_DEPTH {
            let message = format!("parentheses are nested more than {MAX_DEPTH} deep");
            return error(at, 1, message, "give the inner parts names of their own, by equations");
        }
        at += rest.chars().next().map_or(1, char::len_utf8);
    }
    Ok(open.pop())
}

/// Whether a line of a text, not the last one, ends with `;`, `{` or `}`.
fn loses_its_end(text: &str) -> bool {
    text.lines().rev().skip(1).any(|line| line.trim_end().ends_with([';', '{', '}']))
}

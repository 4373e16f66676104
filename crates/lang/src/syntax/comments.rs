//! Comments (B.1.5): replaced by blanks, so that the grammar need not know them.
//!
//! `(* … *)` nests, as in every tool of the field; `//` runs to the line end. A comment that spans lines does not end
//! an instruction, so the line ends inside it become blanks too. Byte offsets do not change.

use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

/// Comment, from its opening to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Comment {
    span: Span,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// `(* … *)`
    Block,
    /// `(* …` up to the end of the text.
    Unclosed,
    /// `// …`
    ToLineEnd,
}

/// Iterator over the comments of a text.
fn scan(text: &str) -> impl Iterator<Item = Comment> {
    let bytes = text.as_bytes();
    let mut at = 0;
    std::iter::from_fn(move || {
        while at < bytes.len() {
            let start = at;
            let kind;
            (at, kind) = match &bytes[at..] {
                [b'(', b'*', ..] => match block_end(bytes, at) {
                    Some(end) => (end, Some(Kind::Block)),
                    None => (bytes.len(), Some(Kind::Unclosed)),
                },
                [b'/', b'/', ..] => (line_end(bytes, at), Some(Kind::ToLineEnd)),
                // Text in quotes has no comments; it ends with its line at the latest.
                [quote @ (b'\'' | b'"'), rest @ ..] => {
                    let stop = rest.iter().position(|b| b == quote || *b == b'\n').unwrap_or(rest.len());
                    ((at + stop + 2).min(bytes.len()), None)
                }
                _ => (at + 1, None),
            };
            if let Some(kind) = kind {
                return Some(Comment { span: Span::new(start, at), kind });
            }
        }
        None
    })
}

/// Replaces every comment by as many blanks and reports a comment that is never closed. `start` is the text's offset in
/// its file.
pub fn blank(text: &str, start: usize) -> (String, Option<Diagnostic>) {
    let mut blanked = text.as_bytes().to_vec();
    let mut unclosed = None;
    for Comment { span, kind } in scan(text) {
        blanked[span.range()].fill(b' ');
        if kind == Kind::Unclosed {
            let help = if openings(text, span).next().is_some() {
                "close it with `*)`; comments nest, so each `(*` inside it needs its own"
            } else {
                "close it with `*)`"
            };
            let opening = Span::new(start + span.start, start + span.start + 2);
            let message = "this comment is never closed";
            unclosed = Some(Diagnostic::new(Code::CommentNotClosed, opening, message).help(help));
        }
    }
    (String::from_utf8_lossy(&blanked).into_owned(), unclosed)
}

/// Comments of a text that edition 2, to the letter, does not allow.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Comments {
    /// `// …`
    pub to_line_end: Vec<Span>,
    /// Openings of comments inside comments.
    pub nested: Vec<Span>,
}

/// Finds the comments of a text that edition 2, to the letter, does not allow.
#[must_use]
pub fn comments(text: &str) -> Comments {
    let mut found = Comments::default();
    for Comment { span, kind } in scan(text) {
        match kind {
            Kind::ToLineEnd => found.to_line_end.push(span),
            Kind::Block | Kind::Unclosed => found.nested.extend(openings(text, span)),
        }
    }
    found
}

/// Requirements in comments that begin with `(*@` or `//@`, each in its place: a text of the same length, the rest of
/// which is blank. `None` if there is no such comment, or the text is XML.
#[must_use]
pub fn requirements_in_comments(text: &str) -> Option<String> {
    if text.trim_start_matches('\u{feff}').trim_start().starts_with('<') {
        return None;
    }
    let inside = |Comment { span, kind }: Comment| {
        let start = span.start + 3;
        let end = span.end - if kind == Kind::Block { 2 } else { 0 };
        (text.as_bytes().get(span.start + 2) == Some(&b'@') && start <= end).then_some(start..end)
    };
    let mut found = scan(text).filter_map(inside).peekable();
    found.peek()?;
    let mut bytes: Vec<u8> = text.bytes().map(|b| if b == b'\n' || b == b'\r' { b } else { b' ' }).collect();
    found.for_each(|range| bytes[range.clone()].copy_from_slice(&text.as_bytes()[range]));
    Some(String::from_utf8_lossy(&bytes).into_owned())
}

/// Openings of comments inside a comment.
fn openings(text: &str, comment: Span) -> impl Iterator<Item = Span> {
    let inside = comment.start + 2;
    let pairs = text.as_bytes()[inside..comment.end].windows(2).enumerate();
    pairs.filter(|(_, pair)| *pair == b"(*").map(move |(i, _)| Span::new(inside + i, inside + i + 2))
}

fn block_end(bytes: &[u8], start: usize) -> Option<usize> {
    let mut depth = 0_usize;
    let mut at = start;
    while at + 1 < bytes.len() {
        match (bytes[at], bytes[at + 1]) {
            (b'(', b'*') => depth += 1,
            (b'*', b')') => depth -= 1,
            _ => {
                at += 1;
                continue;
            }
        }
        at += 2;
        if depth == 0 {
            return Some(at);
        }
    }
    None
}

fn line_end(bytes: &[u8], start: usize) -> usize {
    bytes[start..].iter().position(|b| b"\r\n".contains(b)).map_or(bytes.len(), |n| start + n)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn blanked(text: &str) -> String {
        let (out, error) = blank(text, 0);
        assert!(error.is_none(), "{error:?}");
        out
    }

    #[test]
    fn comments_become_blanks_of_the_same_length() {
        assert_eq!(blanked("LD a (* ä *) // x\nST b"), format!("LD a{:14}\nST b", ""));
        assert_eq!(blanked("(* (* in *) out *)x"), "                  x");
        assert_eq!(blanked("a(*\n*)b"), "a     b");
        assert_eq!(blanked("(*)*)x"), "     x", "the star of `(*` does not close it");
        assert_eq!(blanked("LD a // last"), "LD a        ");
        assert_eq!(blanked("// a\rb // c\r\n"), "    \rb     \r\n");
    }

    #[test]
    fn quotes_hide_comment_marks() {
        assert_eq!(blanked("a := '(*'; (* x *)"), "a := '(*';        ");
        assert_eq!(blanked("it's\n(* x *)"), "it's\n       ");
    }

    #[test]
    fn an_open_comment_is_reported_where_it_opens() {
        let (text, error) = blank("LD a\n(* (* *) ST b", 0);
        assert_eq!(text, "LD a\n             ");
        assert_eq!(error.map(|d| (d.code, d.span())), Some((Code::CommentNotClosed, Span::new(5, 7))));
    }
}

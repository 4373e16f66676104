//! Comments (B.1.5): blanked, so that the grammar need not know them.
//!
//! `(* … *)` nests, as every tool of the field allows; `//` runs to the line end. A comment that spans lines does not
//! end an instruction, so the line ends inside it become blanks too. Byte offsets stay as they are.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;

/// The text with every comment replaced by as many blanks, and a diagnostic for a comment that is never closed. `start` is
/// the text's offset in its file.
pub fn blank(text: &str, start: usize) -> (String, Option<Diagnostic>) {
    let bytes = text.as_bytes();
    let mut blanked = bytes.to_vec();
    let mut unclosed = None;
    let mut at = 0;
    while at < bytes.len() {
        let end = match &bytes[at..] {
            [b'(', b'*', ..] => block_end(bytes, at).unwrap_or_else(|| {
                let span = Span::new(start + at, start + at + 2);
                let holds_another = bytes[at + 2..].windows(2).any(|pair| pair == b"(*");
                let help = if holds_another {
                    "close it with `*)`; comments nest, so each `(*` inside it needs its own"
                } else {
                    "close it with `*)`"
                };
                let message = "this comment is never closed";
                unclosed = Some(Diagnostic::new(Code::CommentNotClosed, span, message).help(help));
                bytes.len()
            }),
            [b'/', b'/', ..] => line_end(bytes, at),
            // Text in quotes holds no comments; it ends with its line at the latest.
            [quote @ (b'\'' | b'"'), rest @ ..] => {
                let stop = rest.iter().position(|b| b == quote || *b == b'\n').unwrap_or(rest.len());
                at += (stop + 2).min(bytes.len() - at);
                continue;
            }
            _ => {
                at += 1;
                continue;
            }
        };
        blanked[at..end].fill(b' ');
        at = end;
    }
    (String::from_utf8_lossy(&blanked).into_owned(), unclosed)
}

/// The comments of a text that the letter of edition 2 does not allow.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Comments {
    /// `// …`
    pub to_line_end: Vec<Span>,
    /// The openings of comments inside comments.
    pub nested: Vec<Span>,
}

/// Looks for them.
#[must_use]
pub fn comments(text: &str) -> Comments {
    let bytes = text.as_bytes();
    let mut found = Comments::default();
    let mut at = 0;
    while at < bytes.len() {
        at = match &bytes[at..] {
            [b'(', b'*', ..] => {
                let end = block_end(bytes, at).unwrap_or(bytes.len());
                let inner = bytes[at + 2..end].windows(2).enumerate().filter(|(_, pair)| *pair == b"(*");
                found.nested.extend(inner.map(|(i, _)| Span::new(at + 2 + i, at + 4 + i)));
                end
            }
            [b'/', b'/', ..] => {
                let end = line_end(bytes, at);
                found.to_line_end.push(Span::new(at, end));
                end
            }
            [quote @ (b'\'' | b'"'), rest @ ..] => {
                let stop = rest.iter().position(|b| b == quote || *b == b'\n').unwrap_or(rest.len());
                at + (stop + 2).min(bytes.len() - at)
            }
            _ => at + 1,
        };
    }
    found
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

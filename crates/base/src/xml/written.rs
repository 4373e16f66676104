//! Escaping of text for XML: a reader of the document gets the same characters back, and every character is visible in
//! it.

use std::fmt::Write as _;

use super::attributes::is_character;
use crate::printable::{is_printable, line};

/// Escapes text for the content of an element or the value of an attribute: markup and characters that are not
/// printable become references. Characters that XML cannot hold are written as in printed text, like `\u{1b}`.
pub fn written(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&apos;"),
            c if is_printable(c) => out.push(c),
            c if is_character(c) => _ = write!(out, "&#x{:X};", u32::from(c)),
            c => out.push_str(&line(c.encode_utf8(&mut [0; 4]))),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_come_back() {
        for c in (0..0x11_0000).filter_map(char::from_u32).filter(|&c| is_character(c)) {
            let text = written(&format!("a{c}b"));
            assert!(text.chars().all(is_printable));
            assert_eq!(super::super::attributes::resolved(&text), format!("a{c}b"));
        }
        assert_eq!(written("a\u{1b}[0m\u{fffe}"), "a\\u{1b}[0m\\u{fffe}");
    }
}

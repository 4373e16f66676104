//! Texts as they are written into XML: whoever reads the document gets the same characters back, whoever looks at it sees them.

use std::fmt::Write as _;

use super::attributes::is_character;
use crate::printable::{is_printable, line};

/// The content of an element, or the value of an attribute in quotes: what is markup or not printable is a reference. What XML
/// cannot hold at all is written as people see it elsewhere, like `\u{1b}`.
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

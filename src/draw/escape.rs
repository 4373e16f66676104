//! Names as XML can hold them.

/// A text with every character that XML cannot hold, or would change, replaced.
pub fn printable(text: &str) -> String {
    let odd = |c: char| c.is_control() || matches!(c, '\u{FFFE}' | '\u{FFFF}');
    text.chars().map(|c| if odd(c) { char::REPLACEMENT_CHARACTER } else { c }).collect()
}

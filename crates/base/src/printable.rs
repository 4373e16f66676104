//! Text from outside, made safe to print: nothing in it can begin a line, move a cursor, change a colour, hide or
//! reorder.
//!
//! Names, sentences and file names come from files that anybody may have written. All text for people goes through
//! [`line()`] or [`lines()`]; each format adds its own escapes. Text for programs keeps every character, escaped as its
//! format says ([`json()`]).

use std::borrow::Cow;
use std::fmt::Write as _;

/// Whether a character shows as itself, where it stands: not a control character, a change of the direction of text
/// (Boucher and Anderson, *Trojan Source*, 2021), an invisible character, a line end, for private use or unassigned.
#[must_use]
pub fn is_printable(c: char) -> bool {
    !c.is_control()
        && !matches!(
            c,
            '\u{AD}'
                | '\u{34F}'
                | '\u{600}'..='\u{605}'
                | '\u{61C}'
                | '\u{6DD}'
                | '\u{70F}'
                | '\u{115F}'..='\u{1160}'
                | '\u{17B4}'..='\u{17B5}'
                | '\u{180B}'..='\u{180F}'
                | '\u{200B}'..='\u{200F}'
                | '\u{2028}'..='\u{202E}'
                | '\u{2060}'..='\u{206F}'
                | '\u{3164}'
                | '\u{FDD0}'..='\u{FDEF}'
                | '\u{FEFF}'
                | '\u{FFA0}'
                | '\u{FFF0}'..='\u{FFFB}'
                | '\u{FFFE}'..='\u{FFFF}'
                | '\u{E000}'..='\u{F8FF}'
                | '\u{1D173}'..='\u{1D17A}'
                | '\u{E0000}'..='\u{10FFFF}'
        )
}

/// Text on one line: a tab becomes a blank, any other character that is not printable its number, like `\u{1b}`.
#[must_use]
pub fn line(text: &str) -> String {
    escaped(text, |_| false).into_owned()
}

/// Text on its own lines: line feeds and tabs stay, every other character that is not printable becomes its number.
#[must_use]
pub fn lines(text: &str) -> Cow<'_, str> {
    escaped(text, |c| matches!(c, '\n' | '\t'))
}

fn escaped(text: &str, stays: impl Fn(char) -> bool) -> Cow<'_, str> {
    if text.chars().all(|c| is_printable(c) || stays(c)) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        match c {
            c if is_printable(c) || stays(c) => out.push(c),
            '\t' => out.push(' '),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            c => _ = write!(out, "\\u{{{:x}}}", u32::from(c)),
        }
    }
    Cow::Owned(out)
}

/// JSON document in which characters that are not printable are escaped in ASCII (RFC 8259, section 7): parsing it
/// gives the same strings. Line feeds stand between values only, and stay.
#[must_use]
pub fn json(document: &str) -> Cow<'_, str> {
    if document.chars().all(|c| is_printable(c) || c == '\n') {
        return Cow::Borrowed(document);
    }
    let mut out = String::with_capacity(document.len() + 16);
    for c in document.chars() {
        if is_printable(c) || c == '\n' {
            out.push(c);
        } else {
            c.encode_utf16(&mut [0; 2]).iter().for_each(|unit| _ = write!(out, "\\u{unit:04x}"));
        }
    }
    Cow::Owned(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_shows_as_itself_stays() {
        for text in ["", "plain name_1", "Größe ≤ 3 · 圧力 · ±½", "a\\n", "`S1=0`", "😀", "العربية"]
        {
            assert_eq!(line(text), text);
        }
    }

    #[test]
    fn the_rest_is_seen() {
        let table = [
            ("a\nb\rc\td", "a\\nb\\rc d", "a\nb\\rc\td"),
            ("\u{1b}[32mHOLDS", "\\u{1b}[32mHOLDS", "\\u{1b}[32mHOLDS"),
            ("\u{202e}x\u{2066}", "\\u{202e}x\\u{2066}", "\\u{202e}x\\u{2066}"),
            ("\u{9b}2J\u{7f}\u{0}", "\\u{9b}2J\\u{7f}\\u{0}", "\\u{9b}2J\\u{7f}\\u{0}"),
            ("a\u{2028}b\u{85}c", "a\\u{2028}b\\u{85}c", "a\\u{2028}b\\u{85}c"),
            ("\u{feff}\u{200b}\u{e0041}", "\\u{feff}\\u{200b}\\u{e0041}", "\\u{feff}\\u{200b}\\u{e0041}"),
        ];
        for (text, one, several) in table {
            assert_eq!((line(text).as_str(), lines(text).as_ref()), (one, several));
        }
    }

    #[test]
    fn documents_keep_their_strings() {
        for c in (0..0x11_0000).filter_map(char::from_u32) {
            let value = serde_json::json!({ "a": c.to_string() });
            let text = serde_json::to_string_pretty(&value).unwrap();
            let safe = json(&text);
            assert!(safe.chars().all(|c| is_printable(c) || c == '\n'));
            assert_eq!(serde_json::from_str::<serde_json::Value>(&safe).unwrap(), value);
            assert!(line(&c.to_string()).chars().all(is_printable));
        }
    }
}

//! Reversible escaping of names for formats with fewer characters.
//!
//! A character that cannot be part of a name is written `_x`, its code in hexadecimal, `_`; so is the first letter of a
//! reserved word. `_` itself is escaped before an `x`, so that every `_x` begins an escape. `_x_` is empty: it stands
//! for the empty name, and distinguishes two nodes of the same name.
//!
//! `S1=0` becomes `S1_x3D_0`, and `a_x` becomes `a_x5F_x`.

use std::fmt::Write as _;

/// Characters and reserved words of a format's names.
#[derive(Clone, Copy)]
pub struct Alphabet {
    /// Whether a character is allowed in a name. `_`, `x` and hexadecimal digits always are.
    pub allows: fn(char) -> bool,
    /// Whether a character is allowed at the beginning of a name. `_` always is.
    pub begins: fn(char) -> bool,
    /// Whether a name is reserved.
    pub is_reserved: fn(&str) -> bool,
}

/// Escapes a name. Different names stay different.
pub fn escaped(name: &str, alphabet: Alphabet) -> String {
    let mut text = String::with_capacity(name.len());
    let is_reserved = (alphabet.is_reserved)(name);
    let mut chars = name.chars().peekable();
    let mut is_first = true;
    while let Some(c) = chars.next() {
        let fits = (alphabet.allows)(c) && !(is_first && (is_reserved || !(alphabet.begins)(c)));
        if fits && !(c == '_' && chars.peek() == Some(&'x')) {
            text.push(c);
        } else {
            let _ = write!(text, "_x{:X}_", u32::from(c));
        }
        is_first = false;
    }
    if text.is_empty() { APART.to_owned() } else { text }
}

/// Suffix without meaning in an escaped name.
pub const APART: &str = "_x_";

/// Original of an escaped name; `None` if the text is not one.
#[must_use]
pub fn unescaped(text: &str) -> Option<String> {
    let mut name = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, escape)) = rest.split_once("_x") {
        // An escape ends with a `_` that does not begin another.
        let (number, behind) = escape.split_once('_')?;
        name += before;
        if !number.is_empty() {
            name.push(char::from_u32(u32::from_str_radix(number, 16).ok()?)?);
        }
        rest = behind;
    }
    name += rest;
    Some(name)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const WORDS: Alphabet = Alphabet {
        allows: |c| c.is_ascii_alphanumeric() || c == '_',
        begins: |c| c.is_ascii_alphabetic(),
        is_reserved: |name| ["a", "AF"].contains(&name),
    };

    #[test]
    fn escapes_are_as_described() {
        let table = [
            ("S1=0", "S1_x3D_0"),
            ("a_x", "a_x5F_x"),
            ("a_xx41_", "a_x5F_xx41_"),
            ("__x", "_x5F__x5F_x"),
            ("AF", "_x41_F"),
            ("a", "_x61_"),
            ("1", "_x31_"),
            ("_", "_x5F_"),
            ("😀", "_x1F600_"),
            ("", "_x_"),
            ("plain_Name2", "plain_Name2"),
        ];
        for (name, text) in table {
            assert_eq!(escaped(name, WORDS), text);
            assert_eq!(unescaped(text).as_deref(), Some(name));
            assert_eq!(unescaped(&format!("{text}{APART}")).as_deref(), Some(name));
        }
        for text in ["_x", "_x41", "_xG_", "_xD800_"] {
            assert_eq!(unescaped(text), None, "{text}");
        }
    }

    proptest! {
        #[test]
        fn what_is_escaped_can_be_had_back(name in "([ax_X0-9A-F=é\\[]|_x|\\PC){0,8}") {
            let text = escaped(&name, WORDS);
            prop_assert!(text.chars().all(WORDS.allows), "{}", text);
            prop_assert!(text.starts_with('_') || text.starts_with(WORDS.begins), "{}", text);
            prop_assert!(!(WORDS.is_reserved)(&text), "{}", text);
            prop_assert_eq!(unescaped(&text), Some(name));
        }
    }
}

//! Attributes of a start tag, and references in texts.

use std::borrow::Cow;

/// Attribute as it is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Attribute<'s> {
    pub name: &'s str,
    /// Text between the quotation marks, its references unresolved.
    pub value: &'s str,
    /// Offset of the value in bytes, counted from where the attributes begin.
    pub offset: usize,
}

/// Error: its offset in bytes, counted from the start of the text read, and its message.
pub type Wrong = (usize, String);

/// Iterator over the attributes after the name in a start tag; ends after the first error.
pub struct Attributes<'s> {
    text: &'s str,
    at: usize,
}

impl<'s> Attributes<'s> {
    pub fn of(text: &'s str) -> Self {
        Self { text, at: 0 }
    }

    fn skip_blanks(&mut self) {
        let rest = &self.text[self.at..];
        self.at = self.text.len() - rest.trim_start_matches(is_blank).len();
    }

    fn wrong<T>(&mut self, at: usize, what: &str) -> Option<Result<T, Wrong>> {
        self.at = self.text.len();
        Some(Err((at, what.to_owned())))
    }
}

impl<'s> Iterator for Attributes<'s> {
    type Item = Result<Attribute<'s>, Wrong>;

    fn next(&mut self) -> Option<Self::Item> {
        let before = self.at;
        self.skip_blanks();
        let start = self.at;
        let rest = &self.text[start..];
        if rest.is_empty() {
            return None;
        }
        let name = &rest[..rest.find(|c| c == '=' || is_blank(c)).unwrap_or(rest.len())];
        if start == before || !is_name(name) {
            return self.wrong(start, "expected a blank, an attribute or the end of the tag");
        }
        self.at += name.len();
        self.skip_blanks();
        if !self.text[self.at..].starts_with('=') {
            return self.wrong(self.at, "an attribute has no value");
        }
        self.at += 1;
        self.skip_blanks();
        let Some(quote @ ('"' | '\'')) = self.text[self.at..].chars().next() else {
            return self.wrong(self.at, "a value of an attribute is not in quotation marks");
        };
        let offset = self.at + 1;
        let Some(length) = self.text[offset..].find(quote) else {
            return self.wrong(self.at, "a value of an attribute has no closing quotation mark");
        };
        let value = &self.text[offset..offset + length];
        self.at = offset + length + 1;
        if let Some(bracket) = value.find('<') {
            return self.wrong(offset + bracket, "a value of an attribute holds `<`");
        }
        Some(Ok(Attribute { name, value, offset }))
    }
}

/// First invalid reference in a text, as an offset and a message.
pub fn unknown_reference(text: &str) -> Option<Wrong> {
    for (at, _) in text.match_indices('&') {
        let rest = &text[at + 1..];
        match rest.find(';') {
            Some(end) if character(&rest[..end]).is_some() => {}
            Some(end) if is_name(&rest[..end]) => {
                return Some((at, format!("unknown entity reference '{}'", short(&rest[..end]))));
            }
            _ => return Some((at, DANGLING.to_owned())),
        }
    }
    None
}

/// Message for an ampersand that does not begin a reference.
pub const DANGLING: &str = "`&` begins no reference; the character itself is written `&amp;`";

/// Normalised value of an attribute: references resolved, white space as spaces (XML 1.0, section 3.3.3).
pub fn resolved(value: &str) -> Cow<'_, str> {
    if !value.contains(['&', '\n', '\t', '\r']) {
        return Cow::Borrowed(value);
    }
    let value = value.replace("\r\n", " ").replace(['\n', '\t', '\r'], " ");
    let mut text = String::with_capacity(value.len());
    let mut pieces = value.split('&');
    text += pieces.next().unwrap_or_default();
    for piece in pieces {
        let (reference, rest) = piece.split_once(';').unwrap_or(("", piece));
        text.extend(character(reference));
        text += rest;
    }
    Cow::Owned(text)
}

/// Character that a reference, written without `&` and `;`, stands for.
pub fn character(reference: &str) -> Option<char> {
    let number = |digits: &str, radix| {
        let is_number = !digits.is_empty() && digits.chars().all(|c| c.is_digit(radix));
        let code = is_number.then(|| u32::from_str_radix(digits, radix).ok()).flatten()?;
        char::from_u32(code).filter(|&c| is_character(c))
    };
    match reference {
        "lt" => Some('<'),
        "gt" => Some('>'),
        "amp" => Some('&'),
        "apos" => Some('\''),
        "quot" => Some('"'),
        _ => match reference.strip_prefix('#')?.strip_prefix('x') {
            Some(digits) => number(digits, 16),
            None => number(&reference[1..], 10),
        },
    }
}

/// Whether XML can hold a character.
pub fn is_character(c: char) -> bool {
    matches!(c, '\t' | '\n' | '\r' | ' '..='\u{FFFD}' | '\u{10000}'..)
}

/// Whether a text is a name, with or without a prefix. All characters beyond ASCII are accepted.
pub fn is_name(text: &str) -> bool {
    let is_part = |part: &str| {
        let mut chars = part.chars();
        chars.next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_' || !c.is_ascii())
            && chars.all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.') || !c.is_ascii())
    };
    match text.split_once(':') {
        Some((prefix, name)) => is_part(prefix) && is_part(name),
        None => is_part(text),
    }
}

/// Whether a character is white space in XML.
pub fn is_blank(c: char) -> bool {
    matches!(c, ' ' | '\t' | '\n' | '\r')
}

/// The beginning of a name, for messages.
pub fn short(name: &str) -> &str {
    name.char_indices().nth(40).map_or(name, |(end, _)| &name[..end])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(text: &str) -> Result<Vec<(&str, &str)>, Wrong> {
        Attributes::of(text).map(|attribute| attribute.map(|a| (a.name, a.value))).collect()
    }

    #[test]
    fn attributes_are_what_the_standard_says() {
        assert_eq!(all(" a='1'\n\tb = \"'\" x:c='' "), Ok(vec![("a", "1"), ("b", "'"), ("x:c", "")]));
        let wrong = [
            ("a='1'", 0),
            (" a='1'b='2'", 6),
            (" a", 2),
            (" a b='1'", 3),
            (" a=1", 3),
            (" a='1", 3),
            (" a='x<y'", 5),
            (" 1='x'", 1),
            (" a:='x'", 1),
            (" a==", 3),
            (" ä='x' ö", 10),
        ];
        for (text, at) in wrong {
            assert_eq!(all(text).map_err(|(at, _)| at), Err(at), "{text}");
        }
    }

    #[test]
    fn references_are_characters_or_nothing() {
        assert_eq!(resolved("a&lt;&#65;&#x42;\r\n&amp;lt;"), "a<AB &lt;");
        assert_eq!(resolved("plain"), "plain");
        for bad in ["&", "&;", "&x;", "&#0;", "&#x;", "&#xD800;", "&#99999999;", "&#-1;", "&#x+1;", "& amp;", "a&lt"] {
            assert!(unknown_reference(bad).is_some(), "{bad}");
        }
        assert_eq!(unknown_reference("&lt;&#9;&quot;"), None);
    }
}

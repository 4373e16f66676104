//! Characters that a piece of XML stands for, each at the offset where it is written.

use std::ops::Range;

use roxmltree::Node;

/// Elements of XHTML that stand on lines of their own.
const LINES: [&str; 8] = ["p", "br", "div", "li", "ol", "pre", "tr", "ul"];

/// Replaces markup by blanks of the same length in bytes, with a line end for the tags of paragraphs; a reference
/// becomes its character and blanks. The XML is well-formed.
pub fn plain(xml: &str) -> String {
    let mut out = String::with_capacity(xml.len());
    let mut rest = xml;
    while let Some(at) = rest.find(['<', '&']) {
        push(&mut out, &rest[..at]);
        rest = &rest[at..];
        let (length, stands_for) = markup(rest);
        let (markup, behind) = rest.split_at(length);
        match stands_for {
            Markup::Characters(from, to) => {
                out += &" ".repeat(from);
                push(&mut out, &markup[from..to]);
                out += &" ".repeat(markup.len() - to);
            }
            Markup::Line => out += &format!("\n{}", " ".repeat(markup.len() - 1)),
            Markup::Nothing => out += &" ".repeat(markup.len()),
            // The operator `&N` stays in one piece.
            Markup::Character('&') => out += &format!("{}&", " ".repeat(markup.len() - 1)),
            Markup::Character(c) => {
                let length = out.len() + markup.len();
                push(&mut out, c.encode_utf8(&mut [0; 4]));
                out += &" ".repeat(length.saturating_sub(out.len()));
            }
        }
        rest = behind;
    }
    push(&mut out, rest);
    out
}

enum Markup {
    /// CDATA section: offsets in it where its characters begin and end.
    Characters(usize, usize),
    Line,
    Nothing,
    Character(char),
}

/// Markup at the beginning of a text: its length in bytes and what it stands for.
fn markup(xml: &str) -> (usize, Markup) {
    let until = |end: &str| xml.find(end).map_or(xml.len(), |at| at + end.len());
    if let Some(section) = xml.strip_prefix("<![CDATA[") {
        let from = xml.len() - section.len();
        let to = xml.find("]]>").unwrap_or(xml.len());
        return (until("]]>"), Markup::Characters(from, to));
    }
    if xml.starts_with("<!--") {
        return (until("-->"), Markup::Nothing);
    }
    if xml.starts_with("<?") {
        return (until("?>"), Markup::Nothing);
    }
    if let Some(inner) = xml.strip_prefix('<') {
        let name = inner.trim_start_matches('/').split([' ', '\t', '\r', '\n', '/', '>']).next().unwrap_or_default();
        let name = name.rsplit(':').next().unwrap_or_default();
        return (tag_end(xml), if LINES.contains(&name) { Markup::Line } else { Markup::Nothing });
    }
    let reference = &xml[..until(";")];
    let code = reference[1..].trim_end_matches(';');
    let character = match code {
        "lt" => Some('<'),
        "gt" => Some('>'),
        "amp" => Some('&'),
        "apos" => Some('\''),
        "quot" => Some('"'),
        _ => {
            let number = code.strip_prefix('#').unwrap_or_default();
            let number = match number.strip_prefix('x') {
                Some(hexadecimal) => u32::from_str_radix(hexadecimal, 16),
                None => number.parse(),
            };
            number.ok().and_then(char::from_u32)
        }
    };
    (reference.len(), character.map_or(Markup::Nothing, Markup::Character))
}

/// Offset of the end of a tag; `>` may stand in the values of its attributes.
fn tag_end(xml: &str) -> usize {
    let mut quote = None;
    for (at, c) in xml.char_indices() {
        match quote {
            None if c == '>' => return at + 1,
            None if c == '"' || c == '\'' => quote = Some(c),
            Some(open) if open == c => quote = None,
            _ => {}
        }
    }
    xml.len()
}

/// Appends text, with `?` for control characters: the language has none, and they mark pieces.
fn push(out: &mut String, text: &str) {
    out.extend(text.chars().map(|c| if c.is_ascii_control() && !"\t\r\n".contains(c) { '?' } else { c }));
}

/// Bytes between an element's tags; `None` if it has no end tag.
pub fn content(node: Node<'_, '_>, text: &str) -> Option<Range<usize>> {
    let whole = node.range();
    let xml = text.get(whole.clone())?;
    let start = tag_end(xml);
    let end = xml.rfind("</").filter(|&end| end >= start && !xml[..start].ends_with("/>"))?;
    Some(whole.start + start..whole.start + end)
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn every_character_stays_where_it_is() {
        let cases = [
            ("LD a", "LD a"),
            ("<p>LD a</p>", "\n  LD a\n   "),
            ("<x:p q='>'>LD a<br/>ST b", "\n          LD a\n    ST b"),
            ("LD <b>a</b>", "LD    a    "),
            ("<![CDATA[a<b&lt;]]>x", "         a<b&lt;   x"),
            ("a&#10;b&#xE4;&lt;", "a\n    bä    <   "),
            ("&amp;N x", "    &N x"),
            ("a<!-- <p> -->b<? c ?>", "a            b       "),
            ("Q=&gt;x", "Q=>   x"),
        ];
        for (xml, expected) in cases {
            assert_eq!(plain(xml), expected, "{xml}");
            assert_eq!(plain(xml).len(), xml.len(), "{xml}");
        }
    }
}

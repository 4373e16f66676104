//! XML as a stream: one event after another, in no more memory than the text takes.
//!
//! quick-xml cuts the text into tags and the text between them. Whatever else makes a document well-formed is checked
//! here: names, attributes, prefixes, references, and that there is one root element with everything in it.

use std::borrow::Cow;

use quick_xml::Reader;
use quick_xml::errors::{Error, IllFormedError, SyntaxError};
use quick_xml::events::Event as Token;
use rustc_hash::FxHashMap;

use super::attributes::{
    Attributes, DANGLING, character, is_blank, is_character, is_name, resolved, short, unknown_reference,
};
use super::{document_type, ill_formed};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::{ShortSpan, Source, Span};

/// Event of a document.
#[derive(Debug)]
pub enum Event<'s> {
    /// Start of an element.
    Start(Element<'s>),
    /// End of the innermost open element.
    End,
    /// A piece of text, its references resolved. Comments and processing instructions stand between pieces.
    Text(Piece<'s>),
}

/// Start tag of an element.
#[derive(Clone, Debug)]
pub struct Element<'s> {
    /// Name of the element, without prefix.
    pub name: &'s str,
    /// Namespace that the prefix is bound to; empty if there is none.
    pub namespace: &'s str,
    /// Span from `<` to the end of the name.
    pub span: Span,
    attributes: &'s str,
}

/// A piece of text and its span.
#[derive(Clone, Debug)]
pub struct Piece<'s> {
    /// The text, with entities resolved.
    pub text: Cow<'s, str>,
    /// Place in the source.
    pub span: Span,
}

impl<'s> Element<'s> {
    /// Value of an attribute, without outer blanks; the span is that of all text in quotation marks.
    pub fn attribute(&self, name: &str) -> Option<Piece<'s>> {
        let found = Attributes::of(self.attributes).flatten().find(|attribute| attribute.name == name)?;
        let start = self.span.end + found.offset;
        let text = trimmed(resolved(found.value));
        Some(Piece { text, span: Span::new(start, start + found.value.len()) })
    }
}

/// Value of an attribute, by the span that [`Element::attribute`] gave.
pub fn attribute_at(source: &Source, span: Span) -> Cow<'_, str> {
    trimmed(resolved(source.slice(span)))
}

fn trimmed(text: Cow<'_, str>) -> Cow<'_, str> {
    match text {
        Cow::Borrowed(text) => Cow::Borrowed(text.trim()),
        Cow::Owned(text) => Cow::Owned(text.trim().to_owned()),
    }
}

/// Reader of the events of a document. Nothing is to be read after an error.
pub struct Stream<'s> {
    source: &'s Source,
    code: Code,
    format: &'static str,
    reader: Reader<&'s [u8]>,
    /// Offset of the text given to `reader`: after a byte order mark.
    start: usize,
    /// Number of open elements.
    depth: usize,
    has_root: bool,
    says_latin_1: bool,
    prefixes: Prefixes<'s>,
}

impl<'s> Stream<'s> {
    /// Opens the stream of a text; `format` is the name of the expected format in messages.
    pub fn of(source: &'s Source, code: Code, format: &'static str) -> Result<Self, Diagnostic> {
        let text = source.text();
        if text.len() > ShortSpan::MAX_TEXT {
            return Err(Diagnostic::new(Code::FileTooLarge, Span::default(), "this file has more than 4 GiB"));
        }
        let start = if text.starts_with('\u{FEFF}') { '\u{FEFF}'.len_utf8() } else { 0 };
        let mut reader = Reader::from_str(&text[start..]);
        let config = reader.config_mut();
        config.check_comments = true;
        config.expand_empty_elements = true;
        let prefixes = Prefixes::default();
        let stream =
            Self { source, code, format, reader, start, depth: 0, has_root: false, says_latin_1: false, prefixes };
        // The characters that XML excludes are few and rare: all are looked for at once.
        let odd = |&(_, c): &(usize, char)| !is_character(c);
        let may_be_odd = |b: u8| (b < b' ' && !matches!(b, b'\t' | b'\n' | b'\r')) || b == 0xEF;
        match text.bytes().any(may_be_odd).then(|| text.char_indices().find(odd)).flatten() {
            Some((at, c)) => Err(stream.ill_formed(at, &format!("a non-XML character {c:?} found"))),
            None => Ok(stream),
        }
    }

    fn ill_formed(&self, at: usize, what: &str) -> Diagnostic {
        let text = self.source.text();
        let mut at = at.min(text.trim_end().len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        ill_formed(at, self.code, what)
    }

    fn position(&self) -> usize {
        self.start + self.reader.buffer_position() as usize
    }

    /// Next child of the current element, past any text; `None` at the end of the element.
    pub fn child(&mut self) -> Result<Option<Element<'s>>, Diagnostic> {
        loop {
            match self.event()? {
                Some(Event::Start(element)) => return Ok(Some(element)),
                Some(Event::Text(_)) => {}
                Some(Event::End) | None => return Ok(None),
            }
        }
    }

    /// The next event; `None` at the end of the document.
    pub fn event(&mut self) -> Result<Option<Event<'s>>, Diagnostic> {
        loop {
            let from = self.position();
            let token = self.reader.read_event().map_err(|error| self.refused(&error))?;
            let span = Span::new(from, self.position());
            match token {
                Token::Start(tag) | Token::Empty(tag) => return self.begin(span, tag.name().0.len()).map(Some),
                Token::End(_) => {
                    self.depth -= 1;
                    self.prefixes.leave(self.depth);
                    return Ok(Some(Event::End));
                }
                Token::Text(_) => {
                    let text = self.source.slice(span);
                    if self.depth == 0 {
                        self.outside(text, span.start)?;
                    } else if let Some(at) = text.find("]]>") {
                        return Err(self.ill_formed(from + at, "']]>' is not allowed inside a character data"));
                    } else {
                        return Ok(Some(Event::Text(Piece { text: with_line_feeds(text), span })));
                    }
                }
                Token::CData(_) if self.depth > 0 => {
                    let brackets = |length: usize| ("<![CDATA[".len(), length - "]]>".len());
                    let (start, end) = brackets(span.end - span.start);
                    let span = Span::new(span.start + start, span.start + end);
                    return Ok(Some(Event::Text(Piece { text: with_line_feeds(self.source.slice(span)), span })));
                }
                Token::GeneralRef(_) if self.depth > 0 => {
                    let text = self.source.slice(span);
                    if let Some((at, what)) = unknown_reference(text) {
                        return Err(self.ill_formed(from + at, &what));
                    }
                    let text = character(&text[1..text.len() - 1]).map(String::from).unwrap_or_default();
                    return Ok(Some(Event::Text(Piece { text: Cow::Owned(text), span })));
                }
                Token::CData(_) | Token::GeneralRef(_) => self.outside(self.source.slice(span), span.start)?,
                Token::Decl(_) => self.declaration(span)?,
                Token::DocType(_) => return Err(document_type(from, self.code, self.format)),
                Token::Comment(_) | Token::PI(_) => {}
                Token::Eof if self.depth > 0 => {
                    return Err(self.ill_formed(usize::MAX, "the root node was opened but never closed"));
                }
                Token::Eof if !self.has_root => {
                    return Err(self.ill_formed(usize::MAX, "the document does not have a root node"));
                }
                Token::Eof => return Ok(None),
            }
        }
    }

    /// Skips to the end of the innermost open element.
    pub fn skip(&mut self) -> Result<(), Diagnostic> {
        let outside = self.depth - 1;
        while self.depth > outside {
            self.event()?;
        }
        Ok(())
    }

    /// Reads the text content of the innermost open element to its end: without comments and child elements, without
    /// outer blanks. The span of an empty content is that of the tag.
    pub fn content(&mut self, element: &Element<'s>) -> Result<Piece<'s>, Diagnostic> {
        let mut content: Option<Piece<'s>> = None;
        loop {
            match self.event()? {
                Some(Event::Start(_)) => self.skip()?,
                Some(Event::Text(piece)) => {
                    content = match content {
                        // Blanks at the beginning do not count.
                        None if piece.text.trim().is_empty() => None,
                        None => Some(piece),
                        Some(mut all) => {
                            if !piece.text.trim().is_empty() {
                                all.span = all.span.to(piece.span);
                            }
                            all.text.to_mut().push_str(&piece.text);
                            Some(all)
                        }
                    };
                }
                Some(Event::End) | None => break,
            }
        }
        let Some(Piece { text, span }) = content else {
            return Ok(Piece { text: Cow::Borrowed(""), span: element.span });
        };
        let written = self.source.slice(span);
        let start = span.start + written.len() - written.trim_start().len();
        Ok(Piece { text: trimmed(text), span: Span::new(start, start + written.trim().len()) })
    }

    fn begin(&mut self, tag: Span, name: usize) -> Result<Event<'s>, Diagnostic> {
        if self.depth == 0 && self.has_root {
            return Err(self.ill_formed(tag.start, "a second element stands behind the root node"));
        }
        if !self.has_root && !self.source.is_utf8() && !self.says_latin_1 {
            let at = self.source.text().find(|c: char| !c.is_ascii()).unwrap_or(0);
            let help = "save it as UTF-8, or let its first line say `encoding=\"ISO-8859-1\"` if that is what it is";
            return Err(self.ill_formed(at, "this letter is not written in UTF-8").help(help));
        }
        let text = self.source.slice(tag);
        let name = &text[1..=name];
        if !is_name(name) {
            return Err(self.ill_formed(tag.start, "a tag has no name"));
        }
        let span = Span::new(tag.start, tag.start + 1 + name.len());
        let rest = &text[1 + name.len()..text.len() - 1];
        let attributes = rest.strip_suffix('/').unwrap_or(rest);
        let mut names = Vec::new();
        for attribute in Attributes::of(attributes) {
            let attribute = attribute.map_err(|(at, what)| self.ill_formed(span.end + at, &what))?;
            if let Some((at, what)) = unknown_reference(attribute.value) {
                return Err(self.ill_formed(span.end + attribute.offset + at, &what));
            }
            names.push(attribute.name);
            self.prefixes.declare(attribute.name, attribute.value, self.depth);
        }
        let unknown =
            |prefix: &str| self.ill_formed(tag.start, &format!("an unknown namespace prefix '{}'", short(prefix)));
        for prefix in names.iter().filter_map(|name| Some(name.split_once(':')?.0)) {
            if prefix != "xmlns" && self.prefixes.find(prefix).is_none() {
                return Err(unknown(prefix));
            }
        }
        names.sort_unstable();
        if let Some(twice) = names.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(self.ill_formed(tag.start, &format!("attribute '{}' is already defined", short(twice[0]))));
        }
        let (prefix, name) = name.split_once(':').unwrap_or(("", name));
        let namespace = self.prefixes.find(prefix).ok_or_else(|| unknown(prefix))?;
        self.has_root = true;
        self.depth += 1;
        Ok(Event::Start(Element { name, namespace, span, attributes }))
    }

    /// Checks that outside the root node there are blanks only.
    fn outside(&self, text: &str, start: usize) -> Result<(), Diagnostic> {
        match text.find(|c| !is_blank(c)) {
            Some(at) => Err(self.ill_formed(start + at, "text stands outside the root node")),
            None => Ok(()),
        }
    }

    /// Checks the XML declaration and the encoding it names.
    fn declaration(&mut self, span: Span) -> Result<(), Diagnostic> {
        if span.start != self.start {
            return Err(self.ill_formed(span.start, "the XML declaration does not stand at the beginning"));
        }
        let start = span.start + "<?xml".len();
        let attributes = self.source.slice(Span::new(start, span.end - "?>".len()));
        for attribute in Attributes::of(attributes) {
            let attribute = attribute.map_err(|(at, what)| self.ill_formed(start + at, &what))?;
            let is = |names: &[&str]| names.iter().any(|name| attribute.value.eq_ignore_ascii_case(name));
            if attribute.name != "encoding" || is(&["UTF-8", "UTF8", "US-ASCII", "ASCII"]) {
                continue;
            }
            self.says_latin_1 = is(&["ISO-8859-1", "ISO8859-1", "LATIN1", "LATIN-1"]);
            if !self.says_latin_1 {
                let value = Span::new(start + attribute.offset, start + attribute.offset + attribute.value.len());
                let message = format!("this file says that it is written in `{}`", short(attribute.value));
                return Err(Diagnostic::new(self.code, value, message).help("save it as UTF-8"));
            }
        }
        Ok(())
    }

    /// Diagnostic for an error of quick-xml.
    fn refused(&self, error: &Error) -> Diagnostic {
        let at = self.start + self.reader.error_position() as usize;
        let unclosed = |what: &str| {
            self.ill_formed(usize::MAX, &format!("{what} is never closed")).also(Span::new(at, at), "it begins here")
        };
        match error {
            Error::Syntax(SyntaxError::UnclosedDoctype) | Error::IllFormed(IllFormedError::MissingDoctypeName) => {
                // A declaration without a name is reported at its end.
                let text = self.source.text();
                let start = text[..(at + 2).min(text.len())].rfind("<!").unwrap_or(at);
                document_type(start, self.code, self.format)
            }
            Error::Syntax(SyntaxError::InvalidBangMarkup) => self.ill_formed(at, "`<!` begins nothing that is known"),
            Error::Syntax(SyntaxError::UnclosedComment) => unclosed("a comment"),
            Error::Syntax(SyntaxError::UnclosedCData) => unclosed("a CDATA section"),
            Error::Syntax(SyntaxError::UnclosedPI | SyntaxError::UnclosedXmlDecl) => {
                unclosed("a processing instruction")
            }
            Error::Syntax(_) => unclosed("a tag"),
            Error::IllFormed(IllFormedError::MismatchedEndTag { expected, found }) => {
                self.ill_formed(at, &format!("expected '{}' tag, not '{}'", short(expected), short(found)))
            }
            Error::IllFormed(IllFormedError::UnmatchedEndTag(_)) => self.ill_formed(at, "unexpected close tag"),
            Error::IllFormed(IllFormedError::UnclosedReference) => self.ill_formed(at, DANGLING),
            Error::IllFormed(IllFormedError::DoubleHyphenInComment) => self.ill_formed(at, "a comment holds `--`"),
            error => self.ill_formed(at, &error.to_string()),
        }
    }
}

/// Text with line feeds as line ends (XML 1.0, section 2.11).
fn with_line_feeds(text: &str) -> Cow<'_, str> {
    if text.contains('\r') { Cow::Owned(text.replace("\r\n", "\n").replace('\r', "\n")) } else { Cow::Borrowed(text) }
}

/// Namespaces bound to prefixes; the empty prefix stands for the default namespace.
#[derive(Default)]
struct Prefixes<'s> {
    bound: FxHashMap<&'s str, Vec<&'s str>>,
    /// Prefixes bound by open elements, each with the depth of its element.
    declared: Vec<(usize, &'s str)>,
}

impl<'s> Prefixes<'s> {
    fn declare(&mut self, attribute: &'s str, value: &'s str, depth: usize) {
        let prefix = match attribute.strip_prefix("xmlns") {
            Some("") => "",
            Some(rest) if rest.starts_with(':') => &rest[1..],
            _ => return,
        };
        self.bound.entry(prefix).or_default().push(value);
        self.declared.push((depth, prefix));
    }

    fn leave(&mut self, depth: usize) {
        while let Some(&(_, prefix)) = self.declared.last().filter(|(at, _)| *at >= depth) {
            self.declared.pop();
            self.bound.get_mut(prefix).map(Vec::pop);
        }
    }

    fn find(&self, prefix: &str) -> Option<&'s str> {
        match self.bound.get(prefix).and_then(|values| values.last()) {
            Some(namespace) => Some(namespace),
            None => ["", "xml"].contains(&prefix).then_some(""),
        }
    }
}

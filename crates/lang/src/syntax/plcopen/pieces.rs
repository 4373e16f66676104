//! Texts in a project that the grammar reads: instruction lists and initial values.
//!
//! The pieces are parsed all at once, from a text as long as the file that holds nothing else: each piece stands at its
//! own offset, so that its spans are right, between two marks in the place of the markup around it.

use std::collections::BTreeMap;
use std::ops::Range;

use pest::Parser;
use roxmltree::Node;

use super::characters::{content, plain};
use crate::syntax::ast::{Instruction, Operation};
use crate::syntax::consume::{self, Piece};
use crate::syntax::parse::{IlParser, Rule};
use crate::syntax::{comments, expected, nesting};
use petril_base::diagnostic::Diagnostic;
use petril_base::source::Span;
use petril_base::xml::{attribute, tag};

/// Mark before an instruction list. Marks are characters that cannot stand in XML; the grammar knows them.
const BODY: u8 = 1;
const VALUE: u8 = 2;
const END: u8 = 3;

/// Syntax trees of the pieces, by their offsets.
pub struct Pieces(BTreeMap<usize, Piece>);

impl Pieces {
    /// Parses every instruction list and initial value below an element.
    pub fn of(root: Node<'_, '_>, text: &str) -> (Self, Vec<Diagnostic>) {
        let mut gathered = Gathered { text, out: vec![b'.'; text.len()], end: 0, unread: BTreeMap::new() };
        for node in root.descendants().filter(Node::is_element) {
            match tag(node) {
                "IL" => gathered.body(node),
                "simpleValue" => gathered.value(node),
                _ => {}
            }
        }
        let unread = gathered.unread;
        let text = String::from_utf8_lossy(&gathered.out);
        let mut pieces = match IlParser::parse(Rule::pieces, &text) {
            Ok(mut pairs) => pairs.next().map(consume::pieces).unwrap_or_default(),
            // The grammar accepts any text, so the error is a limit of the parser itself.
            Err(error) => return (Self(BTreeMap::new()), vec![expected::diagnostic(&error, &text, 0)]),
        };
        for (start, diagnostic) in unread {
            // An open comment hides what follows, and everything hidden would be missing: only its opening is reported.
            let span = diagnostic.span();
            let body = vec![Instruction { label: None, operation: Some(Operation::Broken), span }];
            pieces.insert(start, Piece { body, diagnostics: vec![diagnostic], ..Piece::default() });
        }
        (Self(pieces), Vec::new())
    }

    /// Takes out the piece that begins at an offset; `None` the second time.
    pub fn take(&mut self, start: usize) -> Option<Piece> {
        self.0.remove(&start)
    }
}

/// Text of all pieces, under construction.
struct Gathered<'a> {
    text: &'a str,
    out: Vec<u8>,
    /// Offset of the end of the last piece.
    end: usize,
    /// Diagnostics of lists that are not parsed, by the offset where the list begins.
    unread: BTreeMap<usize, Diagnostic>,
}

impl Gathered<'_> {
    fn body(&mut self, node: Node<'_, '_>) {
        let Some(range) = content(node, self.text).filter(|range| range.start > self.end) else { return };
        let (list, unclosed) = comments::blank(&plain(&self.text[range.clone()]), range.start);
        let too_deep = nesting::too_deep(&list, range.start);
        let list = if too_deep.is_some() { " ".repeat(list.len()) } else { list };
        if let Some(unread) = unclosed.or(too_deep) {
            self.unread.insert(range.start, unread);
        }
        // A line end before the mark ends the last instruction; an end tag has room for both.
        self.put(BODY, range.clone(), &list);
        self.out[range.end..range.end + 2].copy_from_slice(&[b'\n', END]);
        self.end = range.end + 2;
    }

    fn value(&mut self, node: Node<'_, '_>) {
        let Some(Span { start, end }) = attribute(node, "value").map(|value| value.span) else { return };
        let is_quote = |at: usize| self.text.as_bytes().get(at).is_some_and(|b| b"'\"".contains(b));
        let Some(value) = self.text.get(start..end) else { return };
        if start > self.end && is_quote(start - 1) && is_quote(end) && !value.trim().is_empty() {
            self.put(VALUE, start..end, &plain(value));
            // A text in quotes that does not end goes no further than a line end.
            self.out[end..end + 2].copy_from_slice(&[END, b'\n']);
            self.end = end + 2;
        }
    }

    fn put(&mut self, mark: u8, range: Range<usize>, piece: &str) {
        self.out[range.start - 1] = mark;
        if piece.len() == range.len() {
            self.out[range].copy_from_slice(piece.as_bytes());
        }
    }
}

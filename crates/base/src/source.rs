//! A source text with its name, and byte spans into it.

use std::ops::Range;
use std::sync::OnceLock;

/// Span of a source text in byte offsets, the end exclusive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// Offset of the first byte.
    pub start: usize,
    /// Offset after the last byte.
    pub end: usize,
}

impl Span {
    /// The span of the bytes `start..end`.
    #[must_use]
    pub fn new(start: usize, end: usize) -> Self {
        Self { start, end }
    }

    /// The smallest span that covers both.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        Self::new(self.start.min(other.start), self.end.max(other.end))
    }

    /// The span as a range of byte offsets.
    #[must_use]
    pub fn range(self) -> Range<usize> {
        self.start..self.end
    }
}

/// Span in half the memory, for documents that have millions; only for texts of less than 4 GiB.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ShortSpan {
    start: u32,
    end: u32,
}

impl ShortSpan {
    /// Length in bytes of the longest text that such spans can address.
    pub const MAX_TEXT: usize = u32::MAX as usize;
}

impl From<Span> for ShortSpan {
    fn from(span: Span) -> Self {
        Self { start: span.start as u32, end: span.end as u32 }
    }
}

impl From<ShortSpan> for Span {
    fn from(span: ShortSpan) -> Self {
        Self::new(span.start as usize, span.end as usize)
    }
}

/// Source text with its name in messages and the starts of its lines.
///
/// Line starts are computed once, so that finding a line and column is a binary search.
#[derive(Clone, Debug)]
pub struct Source {
    name: String,
    text: String,
    line_starts: Vec<usize>,
    /// Number of characters before each [`BLOCK`] of bytes, counted on first use.
    characters: OnceLock<Vec<usize>>,
    is_utf8: bool,
}

/// Bytes in a block of the character counts: a line may be as long as a file.
const BLOCK: usize = 1024;

/// Error for bytes that are not text: they hold a NUL byte.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotText {
    /// Offset of the NUL byte.
    pub offset: usize,
    /// The bytes, given back.
    pub bytes: Vec<u8>,
}

impl Source {
    /// A source from a text that is already in memory.
    #[must_use]
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        let text = text.into();
        let after_newline = text.bytes().enumerate().filter(|&(_, b)| b == b'\n').map(|(i, _)| i + 1);
        let line_starts = std::iter::once(0).chain(after_newline).collect();
        Self { name: name.into(), text, line_starts, characters: OnceLock::new(), is_utf8: true }
    }

    /// A source from the bytes of a file: UTF-8 with or without a byte order mark, else ISO 8859-1, which is what the
    /// engineering tools of the 1990s wrote and which reads any bytes. A carriage return without a line feed, the line end
    /// of old Macintosh files, becomes a line feed.
    ///
    /// # Errors
    /// [`NotText`] if the bytes hold a NUL, so are not text in either encoding.
    pub fn decode(name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Result<Self, NotText> {
        let mut bytes = bytes.into();
        if let Some(offset) = bytes.iter().position(|&b| b == 0) {
            return Err(NotText { offset, bytes });
        }
        if bytes.starts_with(b"\xEF\xBB\xBF") {
            bytes.drain(..3);
        }
        // A file of UTF-8 is not copied: it may be large.
        let (text, is_utf8) = match String::from_utf8(bytes) {
            Ok(text) => (text, true),
            Err(error) => (error.into_bytes().into_iter().map(char::from).collect(), false),
        };
        Ok(Self { is_utf8, ..Self::new(name, unify_line_ends(text)) })
    }

    /// Whether the file was UTF-8, not ISO 8859-1.
    #[must_use]
    pub fn is_utf8(&self) -> bool {
        self.is_utf8
    }

    /// Name of the text in messages, usually the path as the user gave it.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The whole text.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The text under a span.
    #[must_use]
    pub fn slice(&self, span: Span) -> &str {
        &self.text[span.range()]
    }

    /// Line and column of a byte offset, both counted from 1, the column in characters.
    #[must_use]
    pub fn line_column(&self, offset: usize) -> (usize, usize) {
        let line = self.line_of(offset);
        let column = self.characters_before(offset) - self.characters_before(self.line_starts[line - 1]) + 1;
        (line, column)
    }

    /// The number of characters that begin before a byte offset.
    fn characters_before(&self, offset: usize) -> usize {
        // Only the first byte of a character is not of the form 10xxxxxx.
        let count = |bytes: &[u8]| bytes.iter().filter(|&&byte| byte >> 6 != 0b10).count();
        let blocks = self.characters.get_or_init(|| {
            let counts = self.text.as_bytes().chunks(BLOCK).map(count);
            let sums = counts.scan(0, |sum, count| Some(std::mem::replace(sum, *sum + count)));
            sums.collect()
        });
        let block = offset / BLOCK;
        match blocks.get(block) {
            Some(before) => before + count(&self.text.as_bytes()[block * BLOCK..offset]),
            // The end of a text whose last block is full, or which is empty.
            None => blocks.last().map_or(0, |before| before + count(&self.text.as_bytes()[(block - 1) * BLOCK..])),
        }
    }

    /// Line of a byte offset, counted from 1.
    #[must_use]
    pub fn line_of(&self, offset: usize) -> usize {
        self.line_starts.partition_point(|&start| start <= offset)
    }

    /// The lines `first..=last` (from 1) as one span, line ends included.
    #[must_use]
    pub fn lines(&self, first: usize, last: usize) -> Span {
        let end = self.line_starts.get(last).copied().unwrap_or(self.text.len());
        Span::new(self.line_starts[first - 1], end)
    }

    /// The text of a line (from 1) without its line end and outer blanks.
    #[must_use]
    pub fn line_text(&self, line: usize) -> &str {
        self.slice(self.lines(line, line)).trim()
    }
}

fn unify_line_ends(text: String) -> String {
    let is_alone = |at: usize| text.as_bytes().get(at + 1) != Some(&b'\n');
    if !text.match_indices('\r').any(|(at, _)| is_alone(at)) {
        return text;
    }
    let mut rest = text.chars().peekable();
    let next = || rest.next().map(|c| if c == '\r' && rest.peek() != Some(&'\n') { '\n' } else { c });
    std::iter::from_fn(next).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_columns_count_from_one_in_characters() {
        let source = Source::new("x", "ab\nä=1\r\n\nz");
        assert_eq!(source.line_column(0), (1, 1));
        assert_eq!(source.line_column(2), (1, 3), "the line end belongs to its line");
        assert_eq!(source.line_column(5), (2, 2), "ä is one column, two bytes");
        assert_eq!(source.line_column(11), (4, 2), "the end of the text");
        assert_eq!(source.line_text(2), "ä=1");
    }

    #[test]
    fn columns_of_long_lines_are_counted_as_those_of_short_ones() {
        for text in
            ["ä".repeat(2 * BLOCK), "a".repeat(2 * BLOCK), format!("{}\n{}", "aö€".repeat(BLOCK), "€x".repeat(BLOCK))]
        {
            let source = Source::new("x", text.as_str());
            for (offset, _) in text.char_indices().chain([(text.len(), ' ')]) {
                let start = text[..offset].rfind('\n').map_or(0, |at| at + 1);
                assert_eq!(source.line_column(offset).1, text[start..offset].chars().count() + 1);
            }
        }
        assert_eq!(Source::new("x", "").line_column(0), (1, 1));
    }

    #[test]
    fn bytes_are_utf8_or_latin1_but_never_binary() {
        let utf8 = Source::decode("x", "\u{feff}Tür".as_bytes()).unwrap();
        assert_eq!(utf8.text(), "Tür", "the byte order mark goes");
        let latin1 = Source::decode("x", b"T\xFCr").unwrap();
        assert_eq!(latin1.text(), "Tür");
        assert!(utf8.is_utf8() && !latin1.is_utf8());
        assert_eq!(Source::decode("x", b"ab\0c").unwrap_err().offset, 2);
    }

    #[test]
    fn a_line_ends_in_any_of_the_three_ways() {
        let source = Source::decode("x", b"a\rb\r\nc\nd\r\r").unwrap();
        let lines: Vec<&str> = (1..=6).map(|line| source.line_text(line)).collect();
        assert_eq!(lines, ["a", "b", "c", "d", "", ""]);
        assert_eq!(source.line_column(5), (3, 1), "bytes stay where they were");
    }
}

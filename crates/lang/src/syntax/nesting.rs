//! Nesting depth of declarations, and of lists in the calls of lists: counted before parsing, since the parser follows
//! every level with a call of its own.

use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

/// Maximum nesting depth of arrays, structures and initial values. Real programs stay below five.
const MAX_DEPTH: usize = 100;

/// Maximum nesting depth of lists that compute inputs of calls.
const MAX_LISTS: usize = 20;

/// Open constructs at a place of the text.
#[derive(Default)]
struct Nesting {
    /// Whether a block of declarations is open.
    declares: bool,
    structures: usize,
    /// Number of `ARRAY` since the last `;`.
    arrays: usize,
    /// Number of open `(` and `[`.
    brackets: usize,
    /// For each open `(` after a `:=`, the number of open brackets including it.
    lists: Vec<usize>,
    /// Whether a `:=` has just been read.
    assigns: bool,
}

impl Nesting {
    fn depth(&self) -> usize {
        self.structures + self.arrays + self.brackets
    }

    fn open(&mut self) {
        self.brackets += 1;
        if self.assigns {
            self.lists.push(self.brackets);
        }
    }

    fn close(&mut self) {
        self.brackets = self.brackets.saturating_sub(1);
        self.lists.retain(|&brackets| brackets <= self.brackets);
    }

    fn word(&mut self, word: &str) {
        let is = |other: &str| word.eq_ignore_ascii_case(other);
        let begins = word.get(..3).is_some_and(|start| start.eq_ignore_ascii_case("VAR")) || is("TYPE");
        let begins_unit = is("PROGRAM") || is("FUNCTION") || is("FUNCTION_BLOCK");
        if is("STRUCT") {
            self.structures += 1;
        } else if is("END_STRUCT") {
            self.structures = self.structures.saturating_sub(1);
            self.end_declaration();
        } else if is("ARRAY") {
            self.arrays += 1;
        } else if begins && !self.declares {
            *self = Self { declares: true, ..Self::default() };
        } else if is("END_VAR") || is("END_TYPE") || begins_unit {
            *self = Self::default();
        }
    }

    fn end_declaration(&mut self) {
        (self.arrays, self.brackets) = (0, 0);
        self.lists.clear();
    }
}

/// Reports the first place of a text where declarations or lists are nested too deeply. The text has no comments and
/// begins at offset `start`.
pub fn too_deep(text: &str, start: usize) -> Option<Diagnostic> {
    let bytes = text.as_bytes();
    let is_word = |b: &u8| b.is_ascii_alphanumeric() || *b == b'_';
    let mut nesting = Nesting::default();
    let mut at = 0;
    while at < bytes.len() {
        let length = match bytes[at] {
            quote @ (b'\'' | b'"') => {
                let rest = &bytes[at + 1..];
                rest.iter().position(|&b| b == quote || b == b'\n').unwrap_or(rest.len()) + 2
            }
            b if is_word(&b) => bytes[at..].iter().take_while(|b| is_word(b)).count(),
            _ => 1,
        };
        match bytes[at] {
            b'(' | b'[' => nesting.open(),
            b')' | b']' => nesting.close(),
            b';' => nesting.end_declaration(),
            b if is_word(&b) => nesting.word(&text[at..at + length]),
            _ => {}
        }
        if nesting.declares && nesting.depth() > MAX_DEPTH {
            let message = format!("this declaration is nested more than {MAX_DEPTH} deep");
            let help = "declare its parts as types of their own, and no deeper than they have to be";
            return Some(
                Diagnostic::new(Code::DeclarationTooDeep, Span::new(start + at, start + at + length), message)
                    .help(help),
            );
        }
        if !nesting.declares && nesting.lists.len() > MAX_LISTS {
            let message = format!("lists in calls are nested more than {MAX_LISTS} deep");
            let help = "store an intermediate result in a variable instead";
            return Some(
                Diagnostic::new(Code::ParenthesisTooDeep, Span::new(start + at, start + at + length), message)
                    .help(help),
            );
        }
        nesting.assigns = match bytes[at] {
            b'=' => at > 0 && bytes[at - 1] == b':',
            // Every blank of the grammar is one of these characters.
            b => nesting.assigns && (b.is_ascii_whitespace() || b == 0x0B || !b.is_ascii()),
        };
        at += length;
    }
    None
}

#[cfg(test)]
mod tests {
    use petril_base::diagnostic::Diagnostic;

    fn too_deep(text: &str) -> Option<Diagnostic> {
        super::too_deep(text, 0)
    }

    #[test]
    fn a_hundred_levels_are_enough() {
        let arrays = |n: usize| format!("VAR a : {}INT; END_VAR", "ARRAY [0..0] OF ".repeat(n));
        let lists = |n: usize| format!("VAR a : A := {}1{}; END_VAR", "[".repeat(n), "]".repeat(n));
        let structures =
            |n: usize| format!("TYPE a : {}x : INT;{} END_TYPE", "STRUCT a : ".repeat(n), " END_STRUCT;".repeat(n));
        // The brackets of the innermost array are one level more.
        assert!(too_deep(&arrays(99)).is_none());
        assert_eq!(too_deep(&arrays(100)).map(|d| d.span().start), Some("VAR a : ".len() + 99 * 16 + 6));
        assert!(too_deep(&lists(100)).is_none());
        assert_eq!(too_deep(&lists(101)).map(|d| d.span().start), Some("VAR a : A := ".len() + 100));
        assert!(too_deep(&structures(100)).is_none());
        assert_eq!(too_deep(&structures(101)).map(|d| d.span().start), Some("TYPE a : ".len() + 100 * 11));
    }

    #[test]
    fn what_stands_beside_each_other_is_not_nested() {
        assert!(too_deep(&format!("VAR {} END_VAR", "a : ARRAY [0..1] OF INT := [(1)];\n".repeat(1000))).is_none());
        assert!(too_deep(&format!("TYPE {} END_TYPE", "a : STRUCT b : INT; END_STRUCT;\n".repeat(1000))).is_none());
        assert!(too_deep(&"VAR a : STRUCT END_VAR PROGRAM p LD ( (".repeat(1000)).is_none());
    }

    #[test]
    fn twenty_lists_in_each_other_are_enough() {
        let lists = |n: usize| format!("PROGRAM p\n{}LD a\n{}", "f(x := (\n".repeat(n), ")\n)\n".repeat(n));
        assert!(too_deep(&lists(20)).is_none());
        assert_eq!(too_deep(&lists(21)).map(|d| d.span().start), Some("PROGRAM p\n".len() + 20 * 9 + 7));
        assert!(too_deep(&format!("PROGRAM p\n{}", "f(x := (\nLD a\n),\ny := (\nLD a\n))\n".repeat(100))).is_none());
    }

    #[test]
    fn instructions_and_quotes_do_not_count() {
        assert!(too_deep(&format!("PROGRAM p VAR a : BOOL; END_VAR LD a\n{}", "AND(\n".repeat(1000))).is_none());
        assert!(too_deep(&format!("VAR a : STRING := '{}'; END_VAR", "(".repeat(1000))).is_none());
        assert!(too_deep("VAR ä : [ü'").is_none());
    }
}

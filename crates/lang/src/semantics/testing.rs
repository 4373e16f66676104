//! Helpers of the rules' tests.

use super::check;
use crate::syntax::parse;
use petril_base::diagnostic::Code;
use petril_base::source::Source;

/// Program with inputs `i`, `j`, memory `m`, output `q`, constant `k`; the body begins in line 2.
pub fn program(body: &str) -> String {
    format!(
        "PROGRAM p VAR_INPUT i, j : BOOL; END_VAR VAR m : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR \
         VAR CONSTANT k : BOOL := TRUE; END_VAR\n{body}\nEND_PROGRAM"
    )
}

/// Lines where a text is reported with this code.
pub fn lines(code: Code, text: &str) -> Vec<usize> {
    let source = Source::new("test", text);
    let (unit, mut diagnostics) = parse(&source);
    diagnostics.extend(check(&unit, true).1);
    diagnostics.iter().filter(|d| d.code == code).map(|d| source.line_of(d.span().start)).collect()
}

/// Diagnostics of a text, in the order of the text: codes and lines.
pub fn findings(text: &str) -> Vec<(Code, usize)> {
    let source = Source::new("test", text);
    let (unit, mut diagnostics) = parse(&source);
    let clean = diagnostics.is_empty();
    diagnostics.extend(check(&unit, clean).1);
    diagnostics.iter().map(|d| (d.code, source.line_of(d.span().start))).collect()
}

//! Assertions: formulas that must hold whenever control reaches an instruction.

use super::bind::bind;
use super::recalled::looks_back_one_scan;
use crate::translate::{PlaceRole, System};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_lang::syntax::without_comments;
use petril_logic::{AssertionText, Origin};
use petril_logic::{Bound, Quantifier, View};

/// A bound assertion of a program.
#[derive(Clone, Debug)]
pub struct Assertion {
    /// Name.
    pub name: String,
    /// Description by the author.
    pub sentence: Option<String>,
    /// Formula as written.
    pub text: String,
    /// Position as file, line and column.
    pub origin: Origin,
    /// Bound formula.
    pub formula: Bound,
    /// Lines of flat code, from 0, before which the formula is checked: one for each call of the unit.
    pub lines: Vec<usize>,
}

/// Binds an assertion in the source text of the program.
///
/// # Errors
/// No instruction follows the assertion, or its formula is not about one moment of a scan.
pub fn bind_assertion(
    assertion: &AssertionText,
    program: &str,
    system: &System,
    view: View,
) -> Result<Assertion, Vec<Diagnostic>> {
    let unfit = |message: &str, help: &str| {
        Err(vec![Diagnostic::new(Code::AssertionUnfit, assertion.span, message).help(help)])
    };
    let formula = bind(&assertion.formula, system, view)?;
    if !formula.is_state_formula() {
        return unfit("an assertion cannot look ahead", "it is about the moment before an instruction");
    }
    if !looks_back_one_scan(&formula) {
        return unfit(
            "an assertion can look back one scan only",
            "`pre(x)` is what x was at the end of the scan before",
        );
    }
    let lines = lines_behind(assertion.span.end, program, system);
    if lines.is_empty() {
        let help = "put it before an instruction; what is so at the end of a scan is a requirement: `AG (…)`";
        return unfit("no instruction of the program follows this assertion", help);
    }
    let AssertionText { name, sentence, text, origin, .. } = assertion.clone();
    let name = name.unwrap_or_else(|| format!("assert_{}", origin.line));
    Ok(Assertion { name, sentence, text, origin, formula, lines })
}

/// First lines of flat code of the next instruction after an offset, if it is in the same unit.
fn lines_behind(offset: usize, program: &str, system: &System) -> Vec<usize> {
    let code = &system.program.code;
    let Some(start) = code.iter().map(|line| line.span.start).filter(|&start| start >= offset).min() else {
        return Vec::new();
    };
    let between = without_comments(program).get(offset..start).unwrap_or_default().to_ascii_uppercase();
    if ["END_PROGRAM", "END_FUNCTION"].iter().any(|end| between.contains(end)) {
        return Vec::new();
    }
    let begins = |line: usize| {
        let of_it = |line: usize| code[line].span.start == start;
        of_it(line) && (line == 0 || !of_it(line - 1))
    };
    (0..code.len()).filter(|&line| begins(line)).collect()
}

impl Assertion {
    /// Returns the assertion as a formula of the transition view.
    #[must_use]
    pub fn as_formula(&self, system: &System) -> Bound {
        let at = |line: &usize| Bound::Marked(system.place(PlaceRole::Line(*line)));
        let somewhere = self.lines.iter().map(at).reduce(|f, g| Bound::Or(Box::new(f), Box::new(g)));
        let there = Box::new(somewhere.unwrap_or(Bound::Truth(false)));
        Bound::Until {
            quantifier: Quantifier::All,
            weak: true,
            hold: Box::new(Bound::Implies(there, Box::new(self.formula.clone()))),
            release: Box::new(Bound::Truth(false)),
        }
    }
}

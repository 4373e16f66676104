//! Warnings about formulas with a part outside of every temporal operator, which is about the first state only.

use super::formula::{Expression, Formula};
use super::ltl::Path;
use super::parse::{Body, Requirement};
use super::view::View;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

/// A part of a formula that is about the first state only.
struct Outside {
    span: Span,
    /// Whether the whole formula is about the first state only.
    whole: bool,
}

impl Formula {
    /// Makes a warning if the formula, or a part of it, is about the first state only; `text` is the formula as
    /// written. There is no warning if the formula contains `at first scan`.
    #[must_use]
    pub fn doubt(&self, text: &str, view: View) -> Option<Diagnostic> {
        let Outside { span, whole } = self.outside()?;
        let what = if whole { "this formula" } else { "this part of the formula" };
        let message = format!("{what} speaks of {} only", first(view));
        let meant = match view {
            View::Scan => "; if the first scan is meant, say so: `at first scan -> (…)`",
            View::Transition => "",
        };
        let help = format!("{}{meant}", always(text, whole, view));
        Some(Diagnostic::new(Code::FormulaOfBeginning, span, message).help(help))
    }

    /// First part that is about the first state only.
    fn outside(&self) -> Option<Outside> {
        let (mut parts, mut looks_ahead) = (Vec::new(), false);
        of_formula(self, &mut parts, &mut looks_ahead);
        let is_meant = parts.iter().any(|part| matches!(part.expression, Expression::FirstScan));
        let first = parts.first().filter(|_| !is_meant)?;
        Some(Outside { span: if looks_ahead { first.span } else { self.span }, whole: !looks_ahead })
    }
}

impl Requirement {
    /// Makes a warning if the requirement, or a part of it, is about the first state only. Patterns are exempt.
    #[must_use]
    pub fn doubt(&self, view: View) -> Option<Diagnostic> {
        self.formula()?.doubt(&self.text, view)
    }

    /// Text of the warning for a report, on one line.
    #[must_use]
    pub fn remark(&self, view: View) -> Option<String> {
        let Outside { whole, .. } = self.formula()?.outside()?;
        let what = if whole { "it speaks" } else { "a part of it speaks" };
        Some(format!("{what} of {} only; {}", first(view), always(&self.text, whole, view)))
    }

    /// The formula, if the requirement is not a pattern.
    fn formula(&self) -> Option<&Formula> {
        match &self.body {
            Body::Formula(formula) if self.words.is_none() => Some(formula),
            _ => None,
        }
    }
}

/// Advice how to require the formula in every state.
fn always(text: &str, whole: bool, view: View) -> String {
    let states = match view {
        View::Scan => "for every scan, write",
        View::Transition => "for every marking, write",
    };
    match text.strip_prefix("LTL ") {
        Some(path) if whole => format!("{states} `LTL G ({})`", path.trim()),
        Some(_) => format!("{states} all of it under one `LTL G (…)`"),
        None if whole => format!("{states} `AG ({text})`"),
        None => format!("{states} all of it under one `AG (…)`"),
    }
}

fn first(view: View) -> &'static str {
    match view {
        View::Scan => "the end of the first scan",
        View::Transition => "the initial marking",
    }
}

/// Collects the parts of a formula outside of temporal operators, and sets `looks_ahead` if it has such operators.
fn of_formula<'f>(formula: &'f Formula, parts: &mut Vec<&'f Formula>, looks_ahead: &mut bool) {
    match &formula.expression {
        Expression::Not(f) => of_formula(f, parts, looks_ahead),
        Expression::And(f, g) | Expression::Or(f, g) | Expression::Implies(f, g) | Expression::Iff(f, g) => {
            of_formula(f, parts, looks_ahead);
            of_formula(g, parts, looks_ahead);
        }
        Expression::Temporal(..) | Expression::Until { .. } | Expression::Within(..) | Expression::Response(..) => {
            *looks_ahead = true;
        }
        Expression::Ltl(path) => of_path(path, parts, looks_ahead),
        Expression::Truth(_) => {}
        _ => parts.push(formula),
    }
}

fn of_path<'f>(path: &'f Path<Formula>, parts: &mut Vec<&'f Formula>, looks_ahead: &mut bool) {
    match path {
        Path::State(formula) => of_formula(formula, parts, looks_ahead),
        Path::Not(f) => of_path(f, parts, looks_ahead),
        Path::And(f, g) | Path::Or(f, g) | Path::Implies(f, g) | Path::Iff(f, g) => {
            of_path(f, parts, looks_ahead);
            of_path(g, parts, looks_ahead);
        }
        _ => *looks_ahead = true,
    }
}

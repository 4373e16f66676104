//! Requirements that speak of the beginning of a run only: something in them stands outside every temporal operator.

use super::bind::View;
use super::formula::{Expression, Formula};
use super::ltl::Path;
use super::parse::{Body, Requirement};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;

/// A part of a requirement that is about the first state alone.
struct Outside {
    span: Span,
    /// Whether nothing of the requirement is about later states.
    whole: bool,
}

impl Requirement {
    /// A warning that all of this, or a part of it, is about the first state alone.
    #[must_use]
    pub fn doubt(&self, view: View) -> Option<Diagnostic> {
        let Outside { span, whole } = self.outside()?;
        let what = if whole { "this requirement" } else { "this part of the requirement" };
        let message = format!("{what} speaks of {} only", first(view));
        let meant = match view {
            View::Scan => "; if the first scan is meant, say so: `at first scan -> (…)`",
            View::Transition => "",
        };
        Some(
            Diagnostic::new(Code::RequirementOfBeginning, span, message).help(format!("{}{meant}", self.always(whole))),
        )
    }

    /// The same for a report, on one line.
    #[must_use]
    pub fn remark(&self, view: View) -> Option<String> {
        let Outside { whole, .. } = self.outside()?;
        let what = if whole { "it speaks" } else { "a part of it speaks" };
        Some(format!("{what} of {} only; {}", first(view), self.always(whole)))
    }

    /// How to say it of every state.
    fn always(&self, whole: bool) -> String {
        let states = "for every scan, write";
        match self.text.strip_prefix("LTL ") {
            Some(path) if whole => format!("{states} `LTL G ({})`", path.trim()),
            Some(_) => format!("{states} all of it under one `LTL G (…)`"),
            None if whole => format!("{states} `AG ({})`", self.text),
            None => format!("{states} all of it under one `AG (…)`"),
        }
    }

    /// The first part that is about the first state alone. Patterns say what they are about, and so does `at first scan`.
    fn outside(&self) -> Option<Outside> {
        let Body::Formula(formula) = &self.body else { return None };
        let (mut parts, mut looks_ahead) = (Vec::new(), false);
        of_formula(formula, &mut parts, &mut looks_ahead);
        let is_meant =
            self.words.is_some() || parts.iter().any(|part| matches!(part.expression, Expression::FirstScan));
        let first = parts.first().filter(|_| !is_meant)?;
        Some(Outside { span: if looks_ahead { first.span } else { formula.span }, whole: !looks_ahead })
    }
}

fn first(view: View) -> &'static str {
    match view {
        View::Scan => "the end of the first scan",
        View::Transition => "the initial marking",
    }
}

/// Collects the parts of a formula that no temporal operator stands before, and notes whether it has such operators.
fn of_formula<'f>(formula: &'f Formula, parts: &mut Vec<&'f Formula>, looks_ahead: &mut bool) {
    match &formula.expression {
        Expression::Not(f) => of_formula(f, parts, looks_ahead),
        Expression::And(f, g) | Expression::Or(f, g) | Expression::Implies(f, g) | Expression::Iff(f, g) => {
            of_formula(f, parts, looks_ahead);
            of_formula(g, parts, looks_ahead);
        }
        Expression::Temporal(..) | Expression::Until { .. } | Expression::Within(..) | Expression::Response(..) => {
            *looks_ahead = true
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

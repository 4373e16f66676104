//! Binding: formulas to bound formulas, with truth values and numbers distinguished. A vocabulary gives names their
//! meaning: that of a program in one of its views, or that of a net alone.

use std::sync::Arc;

use super::bound::{Bound, Term};
use super::formula::{Amount, Comparison, Duration, Expression, Formula, Past as Operator, Quantifier, Temporal};
use super::ltl::Path;
use super::parse::of_ctl;
use super::past::Past;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;
use petril_base::{PlaceId, TransitionId};

mod nodes;
mod scans;

pub use nodes::{Nodes, bind_in_net};

/// Binds the names of a formula by what a vocabulary says.
///
/// # Errors
/// Every name that means nothing there, and every mixture of truth values and numbers.
pub fn bind_names(formula: &Formula, vocabulary: &dyn Vocabulary) -> Result<Bound, Vec<Diagnostic>> {
    let mut binder = Binder { vocabulary, errors: Vec::new() };
    let bound = binder.truth(formula);
    if binder.errors.is_empty() { Ok(bound) } else { Err(binder.errors) }
}

/// Meaning of the names in formulas.
pub trait Vocabulary {
    /// Binds a name that must be a truth value.
    fn truth(&self, name: &Name<'_>) -> Result<Bound, Diagnostic>;
    /// Binds a name that must be a number; a truth value counts as 0 or 1.
    fn number(&self, name: &Name<'_>) -> Result<Term, Diagnostic>;
    /// Binds a name that is a value of the enumerated variable with which it is compared.
    fn enumerated(&self, value: &str, variable: &str) -> Option<i128>;
    /// Binds a position of control.
    fn control(&self, spot: Spot, span: Span) -> Result<Bound, Diagnostic>;
    /// Binds a place of the net.
    fn place(&self, name: &Name<'_>) -> Result<PlaceId, Diagnostic>;
    /// Binds a transition of the net.
    fn transition(&self, name: &Name<'_>) -> Result<TransitionId, Diagnostic>;
    /// Returns the scan time if states are ends of scans, so that formulas can refer to other scans; otherwise the
    /// error.
    fn scans(&self, span: Span) -> Result<ScanTime, Diagnostic>;
    /// The inputs of the program as numbers.
    fn inputs(&self) -> Vec<Term>;
    /// The outputs of the program as numbers.
    fn outputs(&self) -> Vec<Term>;
    /// Binds the atom that no transition is enabled.
    fn deadlock(&self, span: Span) -> Result<Bound, Diagnostic>;
}

/// A name as it is written.
#[derive(Clone, Copy)]
pub struct Name<'f> {
    /// The name.
    pub text: &'f str,
    /// Where it stands.
    pub span: Span,
    /// Number of errors in the formula before the name.
    pub errors: usize,
}

impl Name<'_> {
    /// The error that it means nothing, with the nearest of the names that do.
    #[must_use]
    pub fn unknown<'n>(&self, message: String, names: impl Iterator<Item = &'n str>) -> Diagnostic {
        let diagnostic = Diagnostic::new(Code::RequirementNameUnknown, self.span, message);
        diagnostic.suggest_at(self.errors, self.text, names)
    }
}

/// The time from one scan to the next, in milliseconds.
#[derive(Clone, Copy)]
pub struct ScanTime(pub u64);

/// A position of control; lines are counted from 1.
#[derive(Clone, Copy)]
pub enum Spot {
    /// A line of flat code.
    Line(usize),
    /// Before the first line: the program waits for its next scan.
    Idle,
    /// After the last line.
    End,
}

struct Binder<'v> {
    vocabulary: &'v dyn Vocabulary,
    errors: Vec<Diagnostic>,
}

impl Binder<'_> {
    /// Records an error, and returns a formula to continue with.
    fn error(&mut self, diagnostic: Diagnostic) -> Bound {
        self.errors.push(diagnostic);
        Bound::Truth(false)
    }

    /// Returns a bound formula, or records the error.
    fn bound(&mut self, result: Result<Bound, Diagnostic>) -> Bound {
        result.unwrap_or_else(|diagnostic| self.error(diagnostic))
    }

    fn name<'f>(&self, text: &'f str, span: Span) -> Name<'f> {
        Name { text, span, errors: self.errors.len() }
    }

    /// Binds a formula that must be a truth value.
    fn truth(&mut self, formula: &Formula) -> Bound {
        let (vocabulary, span) = (self.vocabulary, formula.span);
        let mut two = |f: &Formula, g: &Formula| (Box::new(self.truth(f)), Box::new(self.truth(g)));
        match &formula.expression {
            Expression::Truth(value) => Bound::Truth(*value),
            Expression::Name(name) => self.bound(vocabulary.truth(&self.name(name, span))),
            Expression::AtLine(line) => self.bound(vocabulary.control(Spot::Line(*line), span)),
            Expression::AtIdle => self.bound(vocabulary.control(Spot::Idle, span)),
            Expression::AtEnd => self.bound(vocabulary.control(Spot::End, span)),
            Expression::Deadlock => self.bound(vocabulary.deadlock(span)),
            Expression::Marked(name) => self.bound(vocabulary.place(&self.name(name, span)).map(Bound::Marked)),
            Expression::Enabled(name) => self.bound(vocabulary.transition(&self.name(name, span)).map(Bound::Enabled)),
            Expression::Not(f) => Bound::Not(Box::new(self.truth(f))),
            Expression::And(f, g) => {
                let (f, g) = two(f, g);
                Bound::And(f, g)
            }
            Expression::Or(f, g) => {
                let (f, g) = two(f, g);
                Bound::Or(f, g)
            }
            Expression::Implies(f, g) => {
                let (f, g) = two(f, g);
                Bound::Implies(f, g)
            }
            Expression::Iff(f, g) => {
                let (f, g) = two(f, g);
                Bound::Iff(f, g)
            }
            Expression::Compare(comparison, left, right) => {
                let (left, right) = match (self.enumerated(left, right), self.enumerated(right, left)) {
                    (Some(left), _) => (left, self.number(right)),
                    (_, Some(right)) => (self.number(left), right),
                    _ => (self.number(left), self.number(right)),
                };
                if left.magnitude().is_none() || right.magnitude().is_none() {
                    let message = "the numbers in this comparison can become too large";
                    return self.error(Diagnostic::new(Code::RequirementTypes, span, message));
                }
                Bound::Compare(*comparison, left, right)
            }
            Expression::Temporal(quantifier, temporal, f) => {
                let f = Box::new(self.truth(f));
                let constant = |value| Box::new(Bound::Truth(value));
                let quantifier = *quantifier;
                match temporal {
                    Temporal::Next => Bound::Next(quantifier, f),
                    Temporal::Finally => Bound::Until { quantifier, weak: false, hold: constant(true), release: f },
                    Temporal::Globally => Bound::Until { quantifier, weak: true, hold: f, release: constant(false) },
                }
            }
            Expression::Until { quantifier, weak, hold, release } => {
                let (hold, release) = two(hold, release);
                Bound::Until { quantifier: *quantifier, weak: *weak, hold, release }
            }
            Expression::FirstScan
            | Expression::InputChanges
            | Expression::OutputChanges
            | Expression::Past(..)
            | Expression::Held(..)
            | Expression::Within(..)
            | Expression::Response(..) => self.about_scans(formula),
            Expression::Ltl(path) => self.on_paths(path),
            Expression::Number(_)
            | Expression::Tokens(_)
            | Expression::Sum(..)
            | Expression::Difference(..)
            | Expression::Product(..) => {
                let message = "this is a number, where something true or false is needed";
                let help = match &formula.expression {
                    Expression::Number(0) => "write `FALSE`",
                    Expression::Number(1) => "write `TRUE`",
                    _ => "compare it with something, like `… = 1`",
                };
                self.error(Diagnostic::new(Code::RequirementTypes, span, message).help(help))
            }
        }
    }

    fn on_paths(&mut self, path: &Path<Formula>) -> Bound {
        Bound::Ltl(Box::new(path.map(&mut |f| self.atom(f))))
    }

    /// Binds an atom of a path formula, which must be a state formula.
    fn atom(&mut self, formula: &Formula) -> Bound {
        let atom = self.truth(formula);
        if atom.is_state_formula() {
            return atom;
        }
        self.error(of_ctl(formula.span))
    }

    /// Binds a formula that must be a number; a truth value counts as 0 or 1.
    fn number(&mut self, formula: &Formula) -> Term {
        let (vocabulary, span) = (self.vocabulary, formula.span);
        let mut two = |a: &Formula, b: &Formula| (Box::new(self.number(a)), Box::new(self.number(b)));
        match &formula.expression {
            Expression::Number(number) => Term::Number(*number),
            Expression::Sum(a, b) => {
                let (a, b) = two(a, b);
                Term::Sum(a, b)
            }
            Expression::Difference(a, b) => {
                let (a, b) = two(a, b);
                Term::Difference(a, b)
            }
            Expression::Product(a, b) => {
                let (a, b) = two(a, b);
                Term::Product(a, b)
            }
            Expression::Name(name) => self.term(vocabulary.number(&self.name(name, span))),
            Expression::Tokens(name) => self.term(vocabulary.place(&self.name(name, span)).map(Term::Tokens)),
            Expression::Past(Operator::Pre, of) => self.before(&of[0], span),
            _ => {
                let truth = self.truth(formula);
                if !truth.is_state_formula() {
                    let message = "a temporal formula is compared with or counted as a number";
                    let help = "the temporal operators bind more strongly than comparisons: put parentheses around what \
                                follows, like `AG (a = b)`";
                    self.error(Diagnostic::new(Code::RequirementTypes, span, message).help(help));
                }
                Term::Truth(Box::new(truth))
            }
        }
    }

    /// Returns a bound term, or records the error.
    fn term(&mut self, result: Result<Term, Diagnostic>) -> Term {
        result.unwrap_or_else(|diagnostic| Term::Truth(Box::new(self.error(diagnostic))))
    }

    /// Binds a name that is not a variable, but a value of the enumerated variable with which it is compared.
    fn enumerated(&self, value: &Formula, variable: &Formula) -> Option<Term> {
        match (&value.expression, &variable.expression) {
            (Expression::Name(value), Expression::Name(variable)) => {
                self.vocabulary.enumerated(value, variable).map(Term::Number)
            }
            _ => None,
        }
    }
}

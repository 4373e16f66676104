//! Binding of formulas about other scans, earlier or later.

use super::*;

/// Maximum nesting of the formula for `f within n scans`.
const MOST_WITHIN: u64 = 200;

/// Maximum number of scans of a response that is expressed by nested formulas; above it, the scans without response are
/// counted.
const FEW: u64 = 20;

/// Maximum number of scans in a formula.
const MOST_SCANS: u64 = 1 << 30;

impl Binder<'_> {
    /// Binds a formula that is meaningful only if states are ends of scans.
    pub(super) fn about_scans(&mut self, formula: &Formula) -> Bound {
        let span = formula.span;
        let time = match self.vocabulary.scans(span) {
            Ok(time) => time,
            Err(diagnostic) => return self.error(diagnostic),
        };
        match &formula.expression {
            Expression::FirstScan => is_true(Past::First),
            Expression::InputChanges => any_changes(self.vocabulary.inputs()),
            Expression::OutputChanges => any_changes(self.vocabulary.outputs()),
            Expression::Past(operator, of) => self.looking_back(*operator, of, span),
            Expression::Held(f, duration) => {
                let f = self.state_formula(f);
                let n = self.scans(duration, time, MOST_SCANS, true);
                held(f, n)
            }
            Expression::Within(f, duration) => {
                let f = self.truth(f);
                let n = self.scans(duration, time, MOST_WITHIN, false);
                within(&f, n)
            }
            Expression::Response(a, b, duration) => {
                let n = self.scans(duration, time, MOST_SCANS, false);
                if n <= FEW {
                    let (a, b) = (self.truth(a), self.truth(b));
                    return globally(Bound::Implies(Box::new(a), Box::new(within(&b, n))));
                }
                let (a, b) = (self.state_formula(a), self.state_formula(b));
                let not_b = Bound::Not(Box::new(b));
                let begins = Bound::And(Box::new(a), Box::new(not_b.clone()));
                // a has been true without b, and b has not been true since.
                globally(Bound::Not(Box::new(held(is_true(Past::Since(not_b, begins)), n))))
            }
            _ => Bound::Truth(false),
        }
    }

    fn looking_back(&mut self, operator: Operator, of: &[Formula], span: Span) -> Bound {
        let not = |f: Bound| Bound::Not(Box::new(f));
        let and = |f: Bound, g: Bound| Bound::And(Box::new(f), Box::new(g));
        if operator == Operator::Changed {
            let (now, before) = (self.number(&of[0]), self.before(&of[0], span));
            return Bound::Compare(Comparison::Unequal, now, before);
        }
        let f = self.state_formula(&of[0]);
        let before = |f: &Bound| is_true(Past::Before(Term::Truth(Box::new(f.clone()))));
        match operator {
            Operator::Pre => before(&f),
            Operator::Rising => and(f.clone(), not(before(&f))),
            Operator::Falling => and(not(f.clone()), before(&f)),
            Operator::Once => is_true(Past::Since(Bound::Truth(true), f)),
            Operator::SoFar => not(is_true(Past::Since(Bound::Truth(true), not(f)))),
            Operator::Since | Operator::Changed => {
                let g = self.state_formula(&of[of.len() - 1]);
                is_true(Past::Since(f, g))
            }
        }
    }

    /// Binds the value of a number at the end of the previous scan.
    pub(super) fn before(&mut self, of: &Formula, span: Span) -> Term {
        if let Err(diagnostic) = self.vocabulary.scans(span) {
            return Term::Truth(Box::new(self.error(diagnostic)));
        }
        let term = self.number(of);
        if term.magnitude().is_none_or(|magnitude| magnitude > i64::MAX.unsigned_abs().into()) {
            let message = "the number in this `pre` can become too large";
            let error = self.error(Diagnostic::new(Code::RequirementTypes, of.span, message));
            return Term::Truth(Box::new(error));
        }
        Term::Past(Arc::new(Past::Before(term)))
    }

    /// Binds a formula that must not look ahead.
    fn state_formula(&mut self, formula: &Formula) -> Bound {
        let bound = self.truth(formula);
        if bound.is_state_formula() {
            return bound;
        }
        let message = "this looks back, and so cannot be about a formula that looks ahead";
        let help = "put the temporal operator outside, like `AG (pre(a) -> b)`";
        self.error(Diagnostic::new(Code::RequirementTypes, formula.span, message).help(help))
    }

    /// Number of scans in a duration: rounded up if `filled`, otherwise down.
    fn scans(&mut self, duration: &Duration, ScanTime(time): ScanTime, most: u64, filled: bool) -> u64 {
        let scans = match duration.amount {
            Amount::Scans(scans) => u64::from(scans),
            Amount::Milliseconds(ms) if filled => ms.div_ceil(time),
            Amount::Milliseconds(ms) => ms / time,
        };
        if scans <= most {
            return scans;
        }
        let message = format!("this takes {scans} scans, more than the {most} that are possible here");
        let help = "`response(a, b, t)` can wait longer than `AG (a -> b within t)`; or say with `scan time` that scans take longer";
        self.error(Diagnostic::new(Code::RequirementTypes, duration.span, message).help(help));
        0
    }
}

/// Some number is not what it was at the end of the scan before.
fn any_changes(numbers: Vec<Term>) -> Bound {
    let changes = numbers.into_iter().map(|term| {
        let before = Term::Past(Arc::new(Past::Before(term.clone())));
        Bound::Compare(Comparison::Unequal, term, before)
    });
    changes.reduce(|f, g| Bound::Or(Box::new(f), Box::new(g))).unwrap_or(Bound::Truth(false))
}

fn globally(f: Bound) -> Bound {
    let (hold, release) = (Box::new(f), Box::new(Bound::Truth(false)));
    Bound::Until { quantifier: Quantifier::All, weak: true, hold, release }
}

/// Atom that a term about the past is true.
fn is_true(past: Past) -> Bound {
    Bound::Compare(Comparison::Unequal, Term::Past(Arc::new(past)), Term::Number(0))
}

/// Atom that a formula is true at the end of this scan and of the `n` scans before it. Power-on is not the end of a
/// scan, so the atom is false there even for `n` = 0.
fn held(f: Bound, n: u64) -> Bound {
    let most = u32::try_from(n + 1).unwrap_or(u32::MAX);
    let run = Term::Past(Arc::new(Past::Run { of: f, most }));
    Bound::Compare(Comparison::AtLeast, run, Term::Number(most.into()))
}

/// Formula `f | AX (f | AX …)`: f is true now or within `n` scans.
fn within(f: &Bound, n: u64) -> Bound {
    (0..n).fold(f.clone(), |later, _| {
        Bound::Or(Box::new(f.clone()), Box::new(Bound::Next(Quantifier::All, Box::new(later))))
    })
}

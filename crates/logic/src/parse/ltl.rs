//! Parser of LTL formulas: `LTL G (a -> F b)`.

use std::sync::LazyLock;

use pest::iterators::{Pair, Pairs};
use pest::pratt_parser::{Assoc, Op, PrattParser};

use super::{Rule, formula, hole, joined, missing, part, primary, span, unambiguous};
use crate::formula::{Expression, Formula, Past, Quantifier, Temporal};
use crate::ltl::Path;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

/// An LTL formula with its span.
struct Part {
    path: Path<Formula>,
    span: Span,
}

/// Converts a pair of the rule `ltl`.
pub(super) fn whole(pair: Pair<'_, Rule>) -> Result<Formula, Diagnostic> {
    let span = span(&pair);
    match pair.into_inner().find(|piece| piece.as_rule() == Rule::path) {
        Some(piece) => Ok(Formula { expression: Expression::Ltl(Box::new(path(piece.into_inner())?.path)), span }),
        None => Err(Diagnostic::new(Code::RequirementSyntax, span, "expected a formula after `LTL`")),
    }
}

/// Converts a pair of the rule `path` without `LTL` before it. One operator G, F, X, U or W on state formulas becomes
/// the CTL formula with `A` before it, as `G p` becomes `AG p`; anything else is LTL.
///
/// # Errors
/// A part about the first scan only, beside one about later scans: `G a & b`.
pub(super) fn bare(pair: Pair<'_, Rule>) -> Result<Formula, Diagnostic> {
    let span = span(&pair);
    let path = path(pair.into_inner())?.path;
    if let Path::And(f, g) | Path::Or(f, g) | Path::Implies(f, g) | Path::Iff(f, g) = &path
        && matches!((&**f, &**g), (Path::State(_), _) | (_, Path::State(_)))
    {
        let message = "one side of this is about the first scan only, the other about later ones";
        let help = "put parentheses around all that is asked of every scan, like `G (a -> F b)`; \
                    write `LTL` before it if it is meant as it stands";
        return Err(Diagnostic::new(Code::RequirementSyntax, span, message).help(help));
    }
    let expression = of_states(&path).unwrap_or_else(|| Expression::Ltl(Box::new(path)));
    Ok(Formula { expression, span })
}

/// CTL formula equivalent to one LTL operator on state formulas.
fn of_states(path: &Path<Formula>) -> Option<Expression> {
    let state = |path: &Path<Formula>| match path {
        Path::State(formula) => Some(Box::new(formula.clone())),
        _ => None,
    };
    let all = |temporal, f| Some(Expression::Temporal(Quantifier::All, temporal, state(f)?));
    let until = |weak, hold, release| {
        let (hold, release) = (state(hold)?, state(release)?);
        Some(Expression::Until { quantifier: Quantifier::All, weak, hold, release })
    };
    match path {
        Path::Next(f) => all(Temporal::Next, f),
        Path::Finally(f) => all(Temporal::Finally, f),
        Path::Globally(f) => all(Temporal::Globally, f),
        Path::Until(f, g) => until(false, f, g),
        Path::WeakUntil(f, g) => until(true, f, g),
        _ => None,
    }
}

/// Priorities of operators; those of state formulas are the same as in CTL.
static PRATT: LazyLock<PrattParser<Rule>> = LazyLock::new(|| {
    comparisons!(connectives!(Rule).op(Op::infix(Rule::path_until, Assoc::Right)), Rule)
        .op(Op::prefix(Rule::not) | Op::prefix(Rule::path_prefix) | Op::prefix(Rule::temporal))
});

fn path(pairs: Pairs<'_, Rule>) -> Result<Part, Diagnostic> {
    unambiguous(pairs.clone())?;
    PRATT
        .map_primary(|pair| match pair.as_rule() {
            Rule::path_group => group(&pair),
            _ => primary(pair).map(of_state),
        })
        .map_prefix(|operator, operand| prefixed(&operator, operand?))
        .map_infix(|left, operator, right| infixed(left?, &operator, right?))
        .parse(pairs)
}

/// Converts a group: `(f)` or `(f since g)`.
fn group(pair: &Pair<'_, Rule>) -> Result<Part, Diagnostic> {
    if let Some(hole) = hole(pair) {
        return Err(hole);
    }
    let whole = span(pair);
    let Some(inner) = part(pair, Rule::path) else { return Err(missing(whole)) };
    let inner = path(inner.into_inner())?;
    match (part(pair, Rule::formula), inner.path) {
        (None, path) => Ok(Part { path, ..inner }),
        (Some(after), Path::State(held)) => {
            let since = vec![held, formula(after.into_inner())?];
            Ok(of_state(Formula { expression: Expression::Past(Past::Since, since), span: whole }))
        }
        (Some(_), _) => {
            let message = "what was so since something else must be a formula about one state";
            Err(Diagnostic::new(Code::LtlUnfit, inner.span, message))
        }
    }
}

/// Makes the error that an LTL formula contains a CTL formula.
pub(crate) fn of_ctl(span: Span) -> Diagnostic {
    let message = "a formula of LTL is about one path, so AG, EF and their like cannot stand in it";
    Diagnostic::new(Code::LtlUnfit, span, message).help("write G, F, X, U, W and R in it: `LTL G (a -> F b)`")
}

fn of_state(formula: Formula) -> Part {
    Part { span: formula.span, path: Path::State(formula) }
}

fn prefixed(operator: &Pair<'_, Rule>, operand: Part) -> Result<Part, Diagnostic> {
    let span = span(operator).to(operand.span);
    let path = match (operator.as_rule(), operator.as_str(), operand.path) {
        (Rule::path_prefix, "X", path) => Path::Next(Box::new(path)),
        (Rule::path_prefix, "F", path) => Path::Finally(Box::new(path)),
        (Rule::path_prefix, _, path) => Path::Globally(Box::new(path)),
        (Rule::temporal, ..) => return Err(of_ctl(span)),
        (_, _, Path::State(formula)) => Path::State(Formula { expression: Expression::Not(Box::new(formula)), span }),
        (_, _, path) => Path::Not(Box::new(path)),
    };
    Ok(Part { path, span })
}

fn infixed(left: Part, operator: &Pair<'_, Rule>, right: Part) -> Result<Part, Diagnostic> {
    let all = left.span.to(right.span);
    let (left, right) = match (operator.as_rule(), left.path, right.path) {
        (rule, Path::State(left), Path::State(right)) if rule != Rule::path_until => {
            return Ok(of_state(joined(left, rule, right)));
        }
        (_, left, right) => (Box::new(left), Box::new(right)),
    };
    let path = match (operator.as_rule(), operator.as_str()) {
        (Rule::path_until, "U") => Path::Until(left, right),
        (Rule::path_until, "W") => Path::WeakUntil(left, right),
        (Rule::path_until, _) => Path::Release(left, right),
        (Rule::iff, _) => Path::Iff(left, right),
        (Rule::implies, _) => Path::Implies(left, right),
        (Rule::or, _) => Path::Or(left, right),
        (Rule::and, _) => Path::And(left, right),
        (Rule::xor, _) => Path::Not(Box::new(Path::Iff(left, right))),
        _ => {
            let message = "a formula about a path is compared with or counted as a number";
            let help =
                "X, F and G bind more strongly than comparisons: put parentheses around what follows, like `G (a = b)`";
            return Err(Diagnostic::new(Code::RequirementTypes, all, message).help(help));
        }
    };
    Ok(Part { path, span: all })
}

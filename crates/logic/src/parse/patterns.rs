//! Requirement patterns: their short forms and sentences, and the formulas they stand for.
//!
//! The first eleven are those of PLCverif. They are about the ends of scans; the beginning of a scan is expressed by
//! `pre(…)`.

use pest::iterators::Pair;

use super::{Rule, checked_formula, duration, one_line, part, span};
use crate::formula::{Amount, Comparison, Duration, Expression, Formula, Past, Quantifier, Temporal};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

/// Content of a requirement.
#[derive(Clone, Debug)]
pub enum Body {
    /// Formula that must be true.
    Formula(Formula),
    /// Formula that some run from power-on must make true.
    Possible(Formula),
    /// Every line must be executed in some scan.
    EveryLine,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pattern {
    Implication,
    Invariant,
    Forbidden,
    DuringCycle,
    BetweenCycles,
    Reachability,
    Repeatability,
    LeadsTo,
    LeadsToTrigger,
    LeadsToEarlier,
    TimedTrigger,
    MutualExclusion,
    Response,
    ChangesOnlyIf,
    StableOutputs,
    EveryLine,
}

use Pattern::*;

/// All patterns with the grammar rule of the sentence, the short form, and the sentence.
const PATTERNS: [(Pattern, Rule, &str, &str); 16] = [
    (
        Implication,
        Rule::said_implication,
        "implication(a, b)",
        "If {0} is true at the end of a scan, {1} is true at the end of the same scan.",
    ),
    (Invariant, Rule::said_invariant, "invariant(a)", "{0} is true at the end of every scan."),
    (Forbidden, Rule::said_forbidden, "forbidden(a)", "{0} is true at the end of no scan."),
    (
        DuringCycle,
        Rule::said_during,
        "statechange_duringcycle(a, b)",
        "If {0} is true at the beginning of a scan, {1} is true at the end of the same scan.",
    ),
    (
        BetweenCycles,
        Rule::said_between,
        "statechange_betweencycles(a, b, c)",
        "If {0} is true at the end of a scan, and {1} at the end of the next, {2} is true at the end of the next, too.",
    ),
    (Reachability, Rule::said_reachability, "reachability(a)", "It is possible that {0} is true at the end of a scan."),
    (
        Repeatability,
        Rule::said_repeatability,
        "repeatability(a)",
        "At any time it is possible that {0} is true at the end of a later scan.",
    ),
    (
        LeadsTo,
        Rule::said_leadsto,
        "leadsto(a, b)",
        "If {0} is true at the end of a scan, {1} was true at the end of an earlier scan.",
    ),
    (
        LeadsToTrigger,
        Rule::said_leadsto_trigger,
        "leadsto_trigger(a, b, c)",
        "If {0} is true at the end of a scan, there was a change from {1} to {2} at the end of an earlier scan.",
    ),
    (
        LeadsToEarlier,
        Rule::said_leadsto_earlier,
        "leadsto_earlier(a, b)",
        "If {0} is true at the end of a scan, {1} was true at the beginning of this scan or of an earlier one.",
    ),
    (
        TimedTrigger,
        Rule::said_timed,
        "timed_trigger(a, t, b)",
        "If {0} is true at the end of a scan and stays so for {1}, {2} is true then.",
    ),
    (
        MutualExclusion,
        Rule::said_exclusion,
        "mutual_exclusion(a, b, …)",
        "At most one of {*} is true at the end of a scan.",
    ),
    (
        Response,
        Rule::said_response,
        "response(a, b, t)",
        "If {0} is true at the end of a scan, {1} is true within {2}.",
    ),
    (
        ChangesOnlyIf,
        Rule::said_changes,
        "changes_only_if(y, x)",
        "{0} changes only in a scan in which {1} is true at the end.",
    ),
    (StableOutputs, Rule::said_stable, "stable_outputs()", "No output changes unless an input does."),
    (EveryLine, Rule::said_lines, "every_line_reachable()", "Some scan comes to every line of the program."),
];

/// Names of the short forms.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    PATTERNS.iter().filter_map(|(_, _, short, _)| short.split('(').next())
}

/// Argument of a pattern.
enum Part {
    Formula(Formula, String),
    Duration(Duration, String),
}

impl Part {
    fn text(&self) -> String {
        match self {
            Self::Formula(_, text) => format!("`{text}`"),
            Self::Duration(_, text) => text.clone(),
        }
    }
}

/// Converts a pair of the rule `body`; returns also the sentence of the pattern, if it is one.
pub(super) fn body(pair: Pair<'_, Rule>) -> Result<(Body, Option<String>), Diagnostic> {
    let (text, place) = (pair.as_str(), span(&pair));
    let Some(inner) = pair.into_inner().next() else {
        return Err(Diagnostic::new(Code::RequirementSyntax, place, "there is no formula"));
    };
    let (found, parts) = match inner.as_rule() {
        Rule::throughout => {
            let pattern = if part(&inner, Rule::never_word).is_some() { Forbidden } else { Invariant };
            (PATTERNS.iter().find(|(known, ..)| *known == pattern), parts(inner)?)
        }
        Rule::short => {
            let name = text.split('(').next().unwrap_or_default().trim().replace('-', "_").to_ascii_lowercase();
            let name = name.strip_prefix("pattern_").unwrap_or(&name);
            let known = PATTERNS
                .iter()
                .find(|(_, _, short, _)| short.split('(').next().is_some_and(|short| short.eq_ignore_ascii_case(name)));
            (known, parts(inner)?)
        }
        Rule::spoken => {
            let Some(said) = inner.into_inner().next() else {
                return Err(Diagnostic::new(Code::RequirementSyntax, place, "there is no sentence"));
            };
            let rule = said.as_rule();
            (PATTERNS.iter().find(|(_, known, ..)| *known == rule), parts(said)?)
        }
        _ => {
            if let Some(arrow) = inner.clone().into_inner().find(|part| part.as_str() == "-->") {
                let message = "`-->` is an implication in PLCverif and \"leads to\" in UPPAAL";
                let help = "write `AG (a -> b)` for the one, and `AG (a -> AF b)` for the other";
                return Err(Diagnostic::new(Code::RequirementSyntax, span(&arrow), message).help(help));
            }
            return Ok((Body::Formula(checked_formula(inner)?), None));
        }
    };
    let Some(&(pattern, _, short, words)) = found else {
        return Err(Diagnostic::new(Code::RequirementSyntax, place, "there is no such pattern"));
    };
    let words = in_words(words, &parts);
    let misfit = || {
        let message = "this pattern needs other arguments";
        Diagnostic::new(Code::RequirementSyntax, place, message).help(format!("write it like `{short}`"))
    };
    Ok((made_of(pattern, parts, place).ok_or_else(misfit)?, Some(words)))
}

fn parts(pair: Pair<'_, Rule>) -> Result<Vec<Part>, Diagnostic> {
    let mut parts = Vec::new();
    for piece in pair.into_inner() {
        let piece = if piece.as_rule() == Rule::argument { piece.into_inner().next() } else { Some(piece) };
        let Some(piece) = piece else { continue };
        match piece.as_rule() {
            Rule::formula | Rule::list_item => {
                let text = one_line(set_off(&piece));
                parts.push(Part::Formula(checked_formula(piece)?, text));
            }
            Rule::duration => {
                let text = one_line(piece.as_str());
                parts.push(Part::Duration(duration(&piece)?, text));
            }
            // "… is false" follows the formula that it negates.
            Rule::false_word => {
                if let Some(Part::Formula(formula, text)) = parts.pop() {
                    let (expression, span) = (Expression::Not(Box::new(formula.clone())), formula.span);
                    let is_name = matches!(formula.expression, Expression::Name(_));
                    let text = if is_name { format!("!{text}") } else { format!("!({text})") };
                    parts.push(Part::Formula(Formula { expression, span }, text));
                }
            }
            _ => {}
        }
    }
    Ok(parts)
}

/// Text of a part, without enclosing braces.
fn set_off<'i>(part: &Pair<'i, Rule>) -> &'i str {
    let mut inner = part.clone().into_inner();
    match (inner.next(), inner.next()) {
        (Some(group), None) if group.as_rule() == Rule::group && group.as_str().starts_with('{') => {
            group.clone().into_inner().next().map_or(group.as_str(), |inside| set_off(&inside))
        }
        _ => part.as_str(),
    }
}

fn in_words(template: &str, parts: &[Part]) -> String {
    let all = parts.iter().map(Part::text).collect::<Vec<_>>().join(", ");
    let filled = parts.iter().enumerate().map(|(i, part)| (format!("{{{i}}}"), part.text()));
    let mut words = template.replace("{*}", &all);
    for (hole, text) in filled {
        words = words.replace(&hole, &text);
    }
    words
}

/// Makes the formula of a pattern; `None` if the arguments do not fit.
fn made_of(pattern: Pattern, parts: Vec<Part>, span: Span) -> Option<Body> {
    let make = Maker(span);
    let mut formulas = Vec::new();
    let mut durations = Vec::new();
    let count = parts.len();
    for (position, part) in parts.into_iter().enumerate() {
        match part {
            Part::Formula(formula, _) => formulas.push(formula),
            // A pattern has at most one duration.
            Part::Duration(duration, _) => durations.push((position, duration)),
        }
    }
    if matches!(pattern, TimedTrigger | Response) && durations.is_empty() {
        // `response(a, b, 3)`
        let position = if pattern == TimedTrigger { 1 } else { 2 };
        if let Some(Formula { expression: Expression::Number(scans), span }) = formulas.get(position) {
            durations.push((position, Duration { amount: Amount::Scans(u32::try_from(*scans).ok()?), span: *span }));
            formulas.remove(position);
        }
    }
    let duration = match durations.as_slice() {
        [] => None,
        &[(position, duration)] => Some((position, duration)),
        _ => return None,
    };
    if !matches!(pattern, TimedTrigger | Response) && duration.is_some() {
        return None;
    }
    let mut formulas = formulas.into_iter();
    let mut next = || formulas.next();
    let formula = match pattern {
        Implication if count == 2 => make.always(make.implies(next()?, next()?)),
        Invariant if count == 1 => make.always(next()?),
        Forbidden if count == 1 => make.always(make.not(next()?)),
        DuringCycle if count == 2 => make.always(make.implies(make.pre(next()?), next()?)),
        BetweenCycles if count == 3 => {
            let (a, then) = (next()?, make.implies(next()?, next()?));
            make.always(make.implies(a, make.temporal(Quantifier::All, Temporal::Next, then)))
        }
        Reachability if count == 1 => {
            return Some(Body::Possible(make.temporal(Quantifier::Some, Temporal::Finally, next()?)));
        }
        Repeatability if count == 1 => make.always(make.temporal(Quantifier::Some, Temporal::Finally, next()?)),
        LeadsTo if count == 2 => {
            let (a, b) = (next()?, next()?);
            make.never_before(b, a)
        }
        LeadsToTrigger if count == 3 => {
            let (a, b, c) = (next()?, next()?, next()?);
            make.never_before(make.and(make.pre(b), c), a)
        }
        LeadsToEarlier if count == 2 => {
            let (a, b) = (next()?, make.pre(next()?));
            make.never_before(b.clone(), make.and(a, make.not(b)))
        }
        TimedTrigger if count == 3 => {
            let (_, time) = duration.filter(|(position, _)| *position == 1)?;
            let held = make.of(Expression::Held(Box::new(next()?), time));
            make.always(make.implies(held, next()?))
        }
        MutualExclusion if count >= 2 => {
            let sum =
                std::iter::from_fn(next).reduce(|sum, one| make.of(Expression::Sum(Box::new(sum), Box::new(one))))?;
            let one = Box::new(make.of(Expression::Number(1)));
            make.always(make.of(Expression::Compare(Comparison::AtMost, Box::new(sum), one)))
        }
        Response if count == 3 => {
            let (_, time) = duration.filter(|(position, _)| *position == 2)?;
            make.of(Expression::Response(Box::new(next()?), Box::new(next()?), time))
        }
        ChangesOnlyIf if count == 2 => {
            let changed = make.of(Expression::Past(Past::Changed, vec![next()?]));
            make.always(make.not_at_first(make.implies(changed, next()?)))
        }
        StableOutputs if count == 0 => {
            let changes = make.implies(make.of(Expression::OutputChanges), make.of(Expression::InputChanges));
            make.always(make.not_at_first(changes))
        }
        EveryLine if count == 0 => return Some(Body::EveryLine),
        _ => return None,
    };
    Some(Body::Formula(formula))
}

/// Makes formulas with the span of the pattern.
struct Maker(Span);

impl Maker {
    fn of(&self, expression: Expression) -> Formula {
        Formula { expression, span: self.0 }
    }

    fn not(&self, f: Formula) -> Formula {
        self.of(Expression::Not(Box::new(f)))
    }

    fn and(&self, f: Formula, g: Formula) -> Formula {
        self.of(Expression::And(Box::new(f), Box::new(g)))
    }

    fn implies(&self, f: Formula, g: Formula) -> Formula {
        self.of(Expression::Implies(Box::new(f), Box::new(g)))
    }

    fn pre(&self, f: Formula) -> Formula {
        self.of(Expression::Past(Past::Pre, vec![f]))
    }

    /// Excludes the first scan, which has no previous scan to compare with.
    fn not_at_first(&self, f: Formula) -> Formula {
        let first = self.of(Expression::FirstScan);
        self.of(Expression::Or(Box::new(first), Box::new(f)))
    }

    fn temporal(&self, quantifier: Quantifier, temporal: Temporal, f: Formula) -> Formula {
        self.of(Expression::Temporal(quantifier, temporal, Box::new(f)))
    }

    fn always(&self, f: Formula) -> Formula {
        self.temporal(Quantifier::All, Temporal::Globally, f)
    }

    /// Formula `!E [!b U a]`: a is never true before b.
    fn never_before(&self, b: Formula, a: Formula) -> Formula {
        let (hold, release) = (Box::new(self.not(b)), Box::new(a));
        self.not(self.of(Expression::Until { quantifier: Quantifier::Some, weak: false, hold, release }))
    }
}

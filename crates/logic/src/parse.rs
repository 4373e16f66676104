//! Parser of formulas and requirement files: text to [`Formula`].

use std::sync::LazyLock;

use pest::Parser;
use pest::error::Error;
use pest::iterators::{Pair, Pairs};
use pest::pratt_parser::{Assoc, Op, PrattParser};
use pest_derive::Parser;
use serde::{Deserialize, Serialize};

use super::domain::DomainText;
use super::fairness::FairnessText;
use super::formula::{Amount, Comparison, Duration, Expression, Formula, Past, Quantifier, Temporal};
use super::literal;
use petril_base::diagnostic::{self, Code, Diagnostic};
use petril_base::source::{Source, Span};

#[macro_use]
mod priorities;

mod fairness;
mod file;
mod ltl;
mod patterns;

pub use fairness::parse_fairness;
pub use file::{AssertionText, AssumptionText, PlantText, RequirementFile, parse_domain, parse_requirements};
pub(super) use ltl::of_ctl;
pub use patterns::Body;

#[derive(Parser)]
#[grammar = "../../grammar/expression.pest"]
#[grammar = "../../grammar/requirement.pest"]
struct RequirementParser;

/// Maximum number of parts of a formula. Formulas written by hand have tens; the limit bounds the stack of recursive
/// functions.
const MAX_PARTS: usize = 1000;

/// A requirement as written, not yet bound.
#[derive(Clone, Debug)]
pub struct Requirement {
    /// Name, unique among the requirements checked together.
    pub name: String,
    /// Description by the author.
    pub sentence: Option<String>,
    /// Sentence of the pattern, if the requirement is one.
    pub words: Option<String>,
    /// Tags by the author: `safety: SF1`, `severity: high`.
    pub tags: Vec<Tag>,
    /// Content of the requirement.
    pub body: Body,
    /// Content as written, on one line.
    pub text: String,
    /// Span of the name, or of the formula if there is none.
    pub span: Span,
    /// Position as file, line and column.
    pub origin: Origin,
}

/// Tag of a requirement, with or without a value: `severity: high`, `startup`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tag {
    /// Name of the tag.
    pub name: String,
    /// Value of the tag, if there is one.
    pub value: Option<String>,
}

/// Position as file, line and column.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Origin {
    /// Name of the file, or of what the text came from.
    pub file: String,
    /// Line, counted from 1.
    pub line: usize,
    /// Column, counted from 1.
    pub column: usize,
}

impl Origin {
    /// Start of a span in a source.
    #[must_use]
    pub fn of(span: Span, source: &Source) -> Self {
        let (line, column) = source.line_column(span.start);
        Self { file: source.name().to_owned(), line, column }
    }
}

/// Parses a text that is one formula, pattern or sentence, as the requirement with a name.
///
/// # Errors
/// The syntax error.
pub fn parse_requirement(name: &str, source: &Source) -> Result<Requirement, Diagnostic> {
    let pair = lone(source, Rule::lone_body, Rule::body)?;
    let (span, text) = (span(&pair), one_line(pair.as_str()));
    let (body, words) = patterns::body(pair)?;
    let origin = Origin::of(span, source);
    Ok(Requirement { name: name.to_owned(), sentence: None, words, tags: Vec::new(), body, text, span, origin })
}

/// Parses a text that is one formula.
///
/// # Errors
/// The syntax error.
pub fn parse_formula(source: &Source) -> Result<Formula, Diagnostic> {
    checked_formula(lone(source, Rule::lone_formula, Rule::formula)?)
}

/// Parses a text by the rule `whole`, and returns the first pair of the rule `part`.
fn lone(source: &Source, whole: Rule, part: Rule) -> Result<Pair<'_, Rule>, Diagnostic> {
    let text = source.text();
    let pairs = RequirementParser::parse(whole, text).map_err(|error| {
        let diagnostic = diagnostic(&error, text, 0);
        let first = text.trim_start().split(|letter: char| !letter.is_alphanumeric()).next();
        let help = match first {
            Some("LTL") if whole == Rule::lone_formula => "this must be a formula of CTL, like `AG (a & !b -> AF c)`",
            Some("G" | "F" | "X") if whole == Rule::lone_formula => "this must be about one state, or a formula of CTL",
            Some("LTL" | "G" | "F" | "X") if whole != Rule::lone_formula => {
                "a formula of LTL is like `LTL G (a & !b -> F c)`"
            }
            Some(word) if whole == Rule::lone_body && word.eq_ignore_ascii_case("if") => {
                "a sentence is like `If a is true at the end of the PLC cycle, then b should always be true at the end of the \
                 same cycle.`"
            }
            _ => "a formula is like `AG (a & !b -> c)`",
        };
        if diagnostic.help.is_empty() { diagnostic.help(help) } else { diagnostic }
    })?;
    let mut parts = pairs.flatten().filter(|pair| pair.as_rule() == part);
    parts.next().ok_or_else(|| Diagnostic::new(Code::RequirementSyntax, Span::default(), "there is no formula"))
}

/// Converts a pair of the rule `formula`, `list_item`, `ltl` or `path` to a formula, unless it is too large.
fn checked_formula(pair: Pair<'_, Rule>) -> Result<Formula, Diagnostic> {
    if pair.clone().into_inner().flatten().take(MAX_PARTS + 1).count() > MAX_PARTS {
        let message = format!("this formula has more than {MAX_PARTS} parts");
        let help = "split it into several requirements";
        return Err(Diagnostic::new(Code::RequirementSyntax, span(&pair), message).help(help));
    }
    match pair.as_rule() {
        Rule::ltl => ltl::whole(pair),
        Rule::path => ltl::bare(pair),
        _ => formula(pair.into_inner()),
    }
}

static PRATT: LazyLock<PrattParser<Rule>> = LazyLock::new(|| {
    comparisons!(connectives!(Rule).op(Op::postfix(Rule::within)), Rule)
        .op(Op::prefix(Rule::not) | Op::prefix(Rule::temporal))
});

fn formula(pairs: Pairs<'_, Rule>) -> Result<Formula, Diagnostic> {
    unambiguous(pairs.clone())?;
    PRATT
        .map_primary(primary)
        .map_prefix(|operator, operand| {
            let operand = operand?;
            let span = span(&operator).to(operand.span);
            let operand = Box::new(operand);
            let expression = match (operator.as_rule(), operator.as_str().as_bytes()) {
                (Rule::temporal, &[quantifier, temporal]) => {
                    Expression::Temporal(self::quantifier(quantifier), self::temporal(temporal), operand)
                }
                _ => Expression::Not(operand),
            };
            Ok(Formula { expression, span })
        })
        .map_infix(|left, operator, right| Ok(joined(left?, operator.as_rule(), right?)))
        .map_postfix(|operand, within| {
            let operand = operand?;
            let whole = operand.span.to(span(&within));
            let duration = part(&within, Rule::duration).map_or_else(|| Err(missing(whole)), |d| duration(&d))?;
            Ok(Formula { expression: Expression::Within(Box::new(operand), duration), span: whole })
        })
        .parse(pairs)
}

/// Rejects chained comparisons and unsupported operators among the parts of a formula.
fn unambiguous(mut pairs: Pairs<'_, Rule>) -> Result<(), Diagnostic> {
    if let Some(operator) = pairs.clone().find(|part| part.as_rule() == Rule::unfit) {
        let message = format!("there is no operator `{}` in formulas", operator.as_str());
        let help = match operator.as_str() {
            "**" => "write the product: `a * a`",
            _ => "formulas add, subtract and multiply: for `a / 2 = b` write `2 * b <= a & a < 2 * b + 2`",
        };
        return Err(Diagnostic::new(Code::RequirementSyntax, span(&operator), message).help(help));
    }
    let second = chained!(
        pairs, Rule: equal | unequal | less | at_most | greater | at_least; iff | implies | or | xor | and | path_until
    );
    match second {
        None => Ok(()),
        Some(second) => Err(two_comparisons(Code::RequirementSyntax, second)),
    }
}

/// Makes the error that a comparison follows another one.
pub fn two_comparisons(code: Code, second: Span) -> Diagnostic {
    Diagnostic::new(code, second, "two comparisons follow each other")
        .help("write `a = b & b = c`, or put one of them in parentheses: `(a = b) = c` compares the truth of `a = b` with `c`")
}

/// Combines two formulas by an infix operator.
fn joined(left: Formula, operator: Rule, right: Formula) -> Formula {
    let span = left.span.to(right.span);
    let (left, right) = (Box::new(left), Box::new(right));
    let compare = |comparison, left, right| Expression::Compare(comparison, left, right);
    let expression = match operator {
        Rule::iff => Expression::Iff(left, right),
        Rule::implies => Expression::Implies(left, right),
        Rule::or => Expression::Or(left, right),
        Rule::and => Expression::And(left, right),
        Rule::xor => Expression::Not(Box::new(Formula { expression: Expression::Iff(left, right), span })),
        Rule::plus => Expression::Sum(left, right),
        Rule::minus => Expression::Difference(left, right),
        Rule::times => Expression::Product(left, right),
        Rule::unequal => compare(Comparison::Unequal, left, right),
        Rule::less => compare(Comparison::Less, left, right),
        Rule::at_most => compare(Comparison::AtMost, left, right),
        Rule::greater => compare(Comparison::Greater, left, right),
        Rule::at_least => compare(Comparison::AtLeast, left, right),
        _ => compare(Comparison::Equal, left, right),
    };
    Formula { expression, span }
}

/// Finds the first part of a pair that is of a rule.
fn part<'i>(pair: &Pair<'i, Rule>, rule: Rule) -> Option<Pair<'i, Rule>> {
    pair.clone().into_inner().find(|part| part.as_rule() == rule)
}

fn missing(span: Span) -> Diagnostic {
    Diagnostic::new(Code::RequirementSyntax, span, "something is missing here")
}

/// Parses a duration: `3 scans`, `T#500ms`, `500ms`.
fn duration(pair: &Pair<'_, Rule>) -> Result<Duration, Diagnostic> {
    let span = span(pair);
    let text = pair.as_str();
    let unfit = |message: String| {
        Diagnostic::new(Code::RequirementSyntax, span, message).help("write it like `3 scans` or `T#1s500ms`")
    };
    let amount = match part(pair, Rule::scans).and_then(|scans| part(&scans, Rule::count)) {
        Some(count) => Amount::Scans(count.as_str().parse().map_err(|_| unfit("this number is too large".to_owned()))?),
        None => {
            let number =
                literal::number(&literal::time(&text.split_whitespace().collect::<String>())).map_err(unfit)?;
            Amount::Milliseconds(u64::try_from(number).map_err(|_| unfit("this is no time from now on".to_owned()))?)
        }
    };
    Ok(Duration { amount, span })
}

fn primary(pair: Pair<'_, Rule>) -> Result<Formula, Diagnostic> {
    let span = span(&pair);
    let text = pair.as_str();
    let too_large = || {
        Diagnostic::new(Code::RequirementSyntax, span, "this number is too large").help("numbers have up to 64 bits")
    };
    let expression = match pair.as_rule() {
        Rule::group => {
            if let Some(hole) = hole(&pair) {
                return Err(hole);
            }
            let parts: Vec<_> = pair.into_inner().filter(|part| part.as_rule() == Rule::formula).collect();
            let mut parts = parts.into_iter().map(|part| formula(part.into_inner())).collect::<Result<Vec<_>, _>>()?;
            match parts.len() {
                1 => return Ok(parts.remove(0)),
                _ => Expression::Past(Past::Since, parts),
            }
        }
        Rule::among => among(pair)?,
        Rule::call => call(pair)?,
        Rule::held => {
            let (of, time) = (part(&pair, Rule::formula), part(&pair, Rule::duration));
            let (Some(of), Some(time)) = (of, time) else { return Err(missing(span)) };
            Expression::Held(Box::new(formula(of.into_inner())?), duration(&time)?)
        }
        Rule::real => {
            let message = format!("`{text}` is a real number, and formulas have none");
            let help = "programs with variables of type `REAL` are refused; compare others with whole numbers";
            return Err(Diagnostic::new(Code::RequirementSyntax, span, message).help(help));
        }
        Rule::number if is_truth(text) => Expression::Truth(constant(&pair)? == 1),
        Rule::number => Expression::Number(constant(&pair)?),
        Rule::truth => Expression::Truth(text.eq_ignore_ascii_case("TRUE")),
        Rule::until => return until(pair),
        Rule::position => match pair.into_inner().last() {
            Some(line) if line.as_rule() == Rule::line => {
                Expression::AtLine(line.as_str().parse().map_err(|_| too_large())?)
            }
            Some(spot) if spot.as_str().eq_ignore_ascii_case("idle") => Expression::AtIdle,
            Some(spot) if spot.as_str().eq_ignore_ascii_case("deadlock") => Expression::Deadlock,
            Some(spot) if spot.as_str().to_ascii_lowercase().starts_with("first") => Expression::FirstScan,
            _ => Expression::AtEnd,
        },
        rule @ (Rule::marked | Rule::tokens | Rule::enabled) => {
            let quoted = pair.into_inner().next().map(|p| p.as_str().trim_matches('"').to_owned()).unwrap_or_default();
            match rule {
                Rule::marked => Expression::Marked(quoted),
                Rule::tokens => Expression::Tokens(quoted),
                _ => Expression::Enabled(quoted),
            }
        }
        _ => Expression::Name(name_of(&pair)),
    };
    Ok(Formula { expression, span })
}

/// Makes the error that a placeholder of a pattern, like `{1}`, was not replaced.
fn hole(group: &Pair<'_, Rule>) -> Option<Diagnostic> {
    let inside = group.as_str().strip_prefix('{')?.strip_suffix('}')?.trim();
    let is_hole = !inside.is_empty() && inside.bytes().all(|byte| byte.is_ascii_digit());
    is_hole.then(|| {
        let message = format!("`{{{inside}}}` is a place of a pattern, and nothing is put into it");
        let help = "write the formula itself there, or use the short form: `implication(a, b)`";
        Diagnostic::new(Code::RequirementSyntax, span(group), message).help(help)
    })
}

/// Parses a count of true formulas, like `exactly one of (a, b)`.
fn among(pair: Pair<'_, Rule>) -> Result<Expression, Diagnostic> {
    let place = span(&pair);
    let (mut comparison, mut sum) = (Comparison::Equal, None);
    for piece in pair.into_inner() {
        match piece.as_rule() {
            Rule::at_most_one => comparison = Comparison::AtMost,
            Rule::at_least_one => comparison = Comparison::AtLeast,
            Rule::list_item => {
                let one = formula(piece.into_inner())?;
                sum = Some(match sum {
                    None => one,
                    Some(sum) => joined(sum, Rule::plus, one),
                });
            }
            _ => {}
        }
    }
    let one = Formula { expression: Expression::Number(1), span: place };
    Ok(Expression::Compare(comparison, Box::new(sum.ok_or_else(|| missing(place))?), Box::new(one)))
}

/// Parses a past operator, like `pre(f)` or `since(f, g)`.
fn call(pair: Pair<'_, Rule>) -> Result<Expression, Diagnostic> {
    let place = span(&pair);
    let mut parts = pair.into_inner();
    let Some(called) = parts.next() else { return Err(missing(place)) };
    let name = called.as_str();
    if ["always", "never"].iter().any(|word| name.eq_ignore_ascii_case(word)) {
        let message = format!("`{name}` speaks of all that follows");
        let help =
            format!("put parentheses around all of it, `{name} (a -> b)`, or write `AG (a) & b` if that is meant");
        return Err(Diagnostic::new(Code::RequirementSyntax, span(&called), message).help(help));
    }
    let Some(past) = Past::ALL.into_iter().find(|past| past.name().eq_ignore_ascii_case(name)) else {
        let names = Past::ALL.iter().map(|past| past.name()).chain(["held"]).chain(patterns::names());
        let message = format!("there is no operator `{name}`");
        return Err(Diagnostic::new(Code::RequirementSyntax, span(&called), message).suggest(name, names));
    };
    let arguments = parts.filter(|part| part.as_rule() == Rule::formula).map(|part| formula(part.into_inner()));
    let arguments = arguments.collect::<Result<Vec<_>, _>>()?;
    if arguments.len() != past.arity() {
        let like = if past.arity() == 2 { "(p, q)" } else { "(p)" };
        let message = format!("`{}` takes another number of arguments", past.name());
        let help = format!("write it like `{}{like}`", past.name());
        return Err(Diagnostic::new(Code::RequirementSyntax, place, message).help(help));
    }
    Ok(Expression::Past(past, arguments))
}

/// Name of a variable as flat code spells it: `a[1,2]`.
fn name_of(pair: &Pair<'_, Rule>) -> String {
    pair.as_str().split_whitespace().collect()
}

/// Value of a literal.
fn constant(pair: &Pair<'_, Rule>) -> Result<i128, Diagnostic> {
    let text = pair.as_str();
    if pair.as_rule() == Rule::truth {
        return Ok(i128::from(text.eq_ignore_ascii_case("TRUE")));
    }
    literal::number(text).map_err(|message| {
        let help = "numbers have up to 64 bits, like `-5`, `16#FF`, `INT#-5` or `T#1s500ms`";
        Diagnostic::new(Code::RequirementSyntax, span(pair), message).help(help)
    })
}

/// Whether a literal is of type `BOOL`, like `BOOL#1`.
fn is_truth(literal: &str) -> bool {
    literal.split_once('#').is_some_and(|(ty, _)| ty.eq_ignore_ascii_case("BOOL"))
}

fn until(pair: Pair<'_, Rule>) -> Result<Formula, Diagnostic> {
    let span = span(&pair);
    let (mut all, mut weak, mut formulas) = (Quantifier::All, false, Vec::new());
    for piece in pair.into_inner() {
        match piece.as_rule() {
            Rule::quantifier => all = quantifier(piece.as_str().as_bytes()[0]),
            Rule::until_operator => weak = piece.as_str() == "W",
            Rule::close_until => {}
            _ => formulas.push(formula(piece.into_inner())?),
        }
    }
    match <[Formula; 2]>::try_from(formulas) {
        Ok([hold, release]) => {
            let (hold, release) = (Box::new(hold), Box::new(release));
            Ok(Formula { expression: Expression::Until { quantifier: all, weak, hold, release }, span })
        }
        Err(_) => Err(Diagnostic::new(Code::RequirementSyntax, span, "expected `A [f U g]`")),
    }
}

fn quantifier(letter: u8) -> Quantifier {
    if letter == b'A' { Quantifier::All } else { Quantifier::Some }
}

fn temporal(letter: u8) -> Temporal {
    match letter {
        b'X' => Temporal::Next,
        b'F' => Temporal::Finally,
        _ => Temporal::Globally,
    }
}

fn span(pair: &Pair<'_, Rule>) -> Span {
    let start = pair.as_span().start();
    Span::new(start, start + pair.as_str().trim_end().len())
}

/// Text with every run of white space replaced by one blank.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn diagnostic(error: &Error<Rule>, text: &str, start: usize) -> Diagnostic {
    let diagnostic = diagnostic::expected(error, (text, start), Code::RequirementSyntax, "the end", name);
    let at = diagnostic.span().start - start;
    if text[at..].starts_with("(*") {
        let span = Span::new(start + at, start + at + 2);
        return Diagnostic::new(Code::RequirementSyntax, span, "this comment is never closed")
            .help("close it with `*)`");
    }
    diagnostic::plain_letters(diagnostic, (text, start))
}

fn name(rule: Rule) -> Option<&'static str> {
    Some(match rule {
        Rule::EOI => "the end",
        Rule::keyword => "`requirement`",
        Rule::domain_word => "`domain`",
        Rule::assume_word => "`assume`",
        Rule::plant_word | Rule::fair_plant => "`plant`",
        Rule::scan_word => "`scan time`",
        Rule::assert_word => "`assert`",
        Rule::duration | Rule::scans | Rule::spaced | Rule::time | Rule::count => "a time or a number of scans",
        Rule::word | Rule::tag => "a word",
        Rule::fair_word => "`fair`",
        Rule::again => "`again and again`",
        Rule::if_word => "`if`",
        Rule::then => "`then`",
        Rule::input_value => "`released` or `pressed`",
        Rule::fairness | Rule::fair_weak | Rule::fair_strong | Rule::fair_inputs => "an assumption",
        Rule::range | Rule::based => "a number",
        Rule::identifier => "a name",
        Rule::sentence | Rule::quoted => "a text in quotes",
        Rule::colon => "`:`",
        Rule::semicolon => "`;`",
        Rule::formula
        | Rule::ltl
        | Rule::lone_formula
        | Rule::path
        | Rule::name
        | Rule::group
        | Rule::path_group
        | Rule::list_item
        | Rule::among
        | Rule::number => "a formula",
        Rule::and | Rule::implies | Rule::equal | Rule::plus | Rule::path_until => "an operator",
        Rule::close_brace => "`}`",
        Rule::until_operator => "`U` or `W`",
        Rule::close_group => "`)`",
        Rule::close_until => "`]`",
        Rule::line => "a line number",
        Rule::spot => "`line`, `idle`, `End`, `deadlock` or `first scan`",
        _ => return None,
    })
}

#[cfg(test)]
mod tests;

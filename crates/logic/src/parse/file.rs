//! Parser of requirement files and of single domains.

use std::collections::BTreeMap;

use pest::Parser;
use pest::iterators::Pair;

use super::fairness::{self, fair_line};
use super::{
    DomainText, FairnessText, Formula, Origin, Requirement, RequirementParser, Rule, Tag, checked_formula, constant,
    diagnostic, missing, name_of, one_line, part, patterns, span,
};
use crate::literal;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::key;
use petril_base::source::{Source, Span};

/// Content of a requirement file.
#[derive(Clone, Debug, Default)]
pub struct RequirementFile {
    /// Requirements in the order of the file.
    pub requirements: Vec<Requirement>,
    /// Domains of free inputs.
    pub domains: Vec<DomainText>,
    /// Assumptions about inputs.
    pub assumptions: Vec<AssumptionText>,
    /// Files of plants.
    pub plants: Vec<PlantText>,
    /// Time from one scan to the next in milliseconds, with its span.
    pub scan_time: Option<(u64, Span)>,
    /// Assertions at lines of a program.
    pub assertions: Vec<AssertionText>,
    /// Fairness assumptions.
    pub fairness: Vec<FairnessText>,
}

/// An assumption about the inputs of each scan as written, not yet bound.
#[derive(Clone, Debug)]
pub struct AssumptionText {
    /// Name, if there is one.
    pub name: Option<String>,
    /// Description by the author.
    pub sentence: Option<String>,
    /// Formula that is assumed.
    pub formula: Formula,
    /// Formula as written, on one line.
    pub text: String,
    /// Position in the text.
    pub span: Span,
}

/// An assertion before an instruction as written, not yet bound.
#[derive(Clone, Debug)]
pub struct AssertionText {
    /// Name, if there is one.
    pub name: Option<String>,
    /// Description by the author.
    pub sentence: Option<String>,
    /// Formula that is asserted.
    pub formula: Formula,
    /// Formula as written, on one line.
    pub text: String,
    /// Position in the text.
    pub span: Span,
    /// Position as file, line and column.
    pub origin: Origin,
}

/// Reference to the file of a plant.
#[derive(Clone, Debug)]
pub struct PlantText {
    /// Path as written, relative to the folder of the requirement file.
    pub path: String,
    /// Position in the text.
    pub span: Span,
}

/// Parses a text that is one domain, like `level: 0..100`.
///
/// # Errors
/// The syntax error.
pub fn parse_domain(source: &Source) -> Result<DomainText, Diagnostic> {
    let text = source.text();
    let pairs = RequirementParser::parse(Rule::lone_domain, text).map_err(|error| {
        let diagnostic = diagnostic(&error, text, 0);
        if diagnostic.help.is_empty() {
            diagnostic.help("a domain is like `level: 0..100` or `k: 0, 3, 7`")
        } else {
            diagnostic
        }
    })?;
    match pairs.flatten().find(|pair| pair.as_rule() == Rule::domain) {
        Some(pair) => domain(pair),
        None => Err(Diagnostic::new(Code::RequirementSyntax, Span::default(), "there is no domain")),
    }
}

/// Parses a requirement file; returns what could be read, and every error.
#[must_use]
pub fn parse_requirements(source: &Source) -> (RequirementFile, Vec<Diagnostic>) {
    let text = source.text();
    let mut file = RequirementFile::default();
    let mut diagnostics = Vec::new();
    let mut names: BTreeMap<String, Span> = BTreeMap::new();
    let pairs = match RequirementParser::parse(Rule::file, text) {
        Ok(pairs) => pairs.flat_map(Pair::into_inner),
        Err(error) => return (file, vec![diagnostic(&error, text, 0)]),
    };
    for pair in pairs {
        match pair.as_rule() {
            Rule::requirement => match requirement(pair, source) {
                Ok(requirement) => {
                    let first = *names.entry(key(&requirement.name)).or_insert(requirement.span);
                    if first != requirement.span {
                        let message = format!("there are two requirements named `{}`", requirement.name);
                        diagnostics.push(
                            Diagnostic::new(Code::RequirementNameTwice, requirement.span, message)
                                .also(first, "the first is here")
                                .help("give each a name of its own"),
                        );
                    }
                    file.requirements.push(requirement);
                }
                Err(error) => diagnostics.push(error),
            },
            Rule::domain_line => match pair.into_inner().find(|pair| pair.as_rule() == Rule::domain).map(domain) {
                Some(Ok(domain)) => file.domains.push(domain),
                Some(Err(error)) => diagnostics.push(error),
                None => {}
            },
            Rule::assume_line => match said(&pair) {
                Ok((name, sentence, formula, text)) => {
                    let span = span(&pair);
                    file.assumptions.push(AssumptionText { name, sentence, formula, text, span });
                }
                Err(error) => diagnostics.push(error),
            },
            Rule::assert_line => match said(&pair) {
                Ok((name, sentence, formula, text)) => {
                    let span = span(&pair);
                    let origin = Origin::of(span, source);
                    file.assertions.push(AssertionText { name, sentence, formula, text, span, origin });
                }
                Err(error) => diagnostics.push(error),
            },
            Rule::fair_line => match fair_line(pair) {
                Ok(fairness) => file.fairness.push(fairness),
                Err(error) => diagnostics.push(error),
            },
            Rule::plant_line => {
                if let Some(path) = part(&pair, Rule::sentence) {
                    let span = span(&path);
                    file.plants.push(PlantText { path: path.as_str().trim_matches('"').to_owned(), span });
                }
            }
            Rule::scan_time_line => match scan_time(&pair) {
                Ok(time) if file.scan_time.is_none() => file.scan_time = Some((time, span(&pair))),
                Ok(_) => {
                    let message = "the scan time is given twice";
                    diagnostics.push(Diagnostic::new(Code::RequirementSyntax, span(&pair), message));
                }
                Err(error) => diagnostics.push(error),
            },
            Rule::bad => diagnostics.push(explain(&pair)),
            _ => {}
        }
    }
    if file.is_empty() && diagnostics.is_empty() {
        let message = "this file holds no requirement";
        let help = "write one like `requirement name \"what it says\": AG (a -> b);`";
        diagnostics.push(Diagnostic::new(Code::RequirementSyntax, Span::default(), message).help(help));
    }
    (file, diagnostics)
}

impl RequirementFile {
    /// Whether the file has no content.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        let assumed = self.domains.is_empty() && self.assumptions.is_empty() && self.plants.is_empty();
        let assumed = assumed && self.fairness.is_empty();
        self.requirements.is_empty() && self.assertions.is_empty() && assumed && self.scan_time.is_none()
    }
}

fn requirement(pair: Pair<'_, Rule>, source: &Source) -> Result<Requirement, Diagnostic> {
    let place = span(&pair);
    let (mut name, mut sentence, mut tags) = ((String::new(), place), None, Vec::new());
    let mut asked = None;
    for piece in pair.into_inner() {
        match piece.as_rule() {
            Rule::identifier => name = (piece.as_str().to_owned(), span(&piece)),
            Rule::sentence => sentence = Some(unquoted(&piece)),
            Rule::tags => tags.extend(piece.into_inner().filter(|tag| tag.as_rule() == Rule::tag).map(tag)),
            Rule::body => asked = Some((one_line(piece.as_str()), patterns::body(piece)?)),
            _ => {}
        }
    }
    let (name, span) = name;
    let Some((text, (body, words))) = asked else { return Err(missing(place)) };
    Ok(Requirement { name, sentence, words, tags, body, text, span, origin: Origin::of(span, source) })
}

fn unquoted(pair: &Pair<'_, Rule>) -> String {
    pair.as_str().trim_matches('"').to_owned()
}

/// Converts a tag: `severity: high`, `startup`, `norm: "EN 574"`.
fn tag(pair: Pair<'_, Rule>) -> Tag {
    let mut words = pair.into_inner().filter(|piece| piece.as_rule() != Rule::colon).map(|piece| unquoted(&piece));
    Tag { name: words.next().unwrap_or_default(), value: words.next() }
}

/// Parts of an assumption or assertion: name, description, formula, and the formula's text.
type Said = (Option<String>, Option<String>, Formula, String);

fn said(pair: &Pair<'_, Rule>) -> Result<Said, Diagnostic> {
    let Some(formula) = part(pair, Rule::formula) else { return Err(missing(span(pair))) };
    let name = part(pair, Rule::identifier).map(|name| name.as_str().to_owned());
    let text = one_line(formula.as_str());
    Ok((name, part(pair, Rule::sentence).as_ref().map(unquoted), checked_formula(formula)?, text))
}

fn scan_time(pair: &Pair<'_, Rule>) -> Result<u64, Diagnostic> {
    let Some(time) = part(pair, Rule::time) else { return Err(missing(span(pair))) };
    let number = literal::number(&literal::time(time.as_str()));
    number.ok().and_then(|ms| u32::try_from(ms).ok()).filter(|&ms| ms > 0).map(u64::from).ok_or_else(|| {
        let message = format!("`{}` is no time above 0", time.as_str());
        Diagnostic::new(Code::RequirementSyntax, span(&time), message).help("write it like `T#20ms`")
    })
}

fn domain(pair: Pair<'_, Rule>) -> Result<DomainText, Diagnostic> {
    let mut text = DomainText { name: String::new(), span: span(&pair), ranges: Vec::new() };
    for piece in pair.into_inner() {
        match piece.as_rule() {
            Rule::name => (text.name, text.span) = (name_of(&piece), span(&piece)),
            Rule::range => {
                let place = span(&piece);
                let bounds: Result<Vec<i128>, Diagnostic> = piece.into_inner().map(|bound| constant(&bound)).collect();
                match *bounds?.as_slice() {
                    [only] => text.ranges.push((only, only, place)),
                    [from, to, ..] => text.ranges.push((from, to, place)),
                    [] => {}
                }
            }
            _ => {}
        }
    }
    Ok(text)
}

/// Parses a piece that is not an item as one, to explain the error.
fn explain(pair: &Pair<'_, Rule>) -> Diagnostic {
    let (text, start) = (pair.as_str(), pair.as_span().start());
    let begins = |word: &str| text.get(..word.len()).is_some_and(|head| head.eq_ignore_ascii_case(word));
    let items = [
        ("domain", Rule::lone_domain_line, "write it like `domain level: 0..100;`"),
        ("assume", Rule::lone_assume_line, "write it like `assume name \"what it says\": !(S1 & O1);`"),
        ("fair", Rule::lone_fair_line, fairness::LIKE_LINE),
        ("plant", Rule::lone_plant_line, "write it like `plant \"hands.net\";`"),
        ("scan", Rule::lone_scan_line, "write it like `scan time T#20ms;`"),
        ("assert", Rule::lone_assert_line, "write it like `assert name \"what it says\": a -> b;`"),
    ];
    let item = items.into_iter().find(|(word, ..)| begins(word));
    let (rule, help) = item.map_or(
        (Rule::lone_requirement, "write it like `requirement name \"what it says\": AG (a -> b);`"),
        |(_, rule, help)| (rule, help),
    );
    match RequirementParser::parse(rule, text) {
        Err(error) => {
            let diagnostic = diagnostic(&error, text, start);
            if diagnostic.help.is_empty() { diagnostic.help(help) } else { diagnostic }
        }
        Ok(_) => Diagnostic::new(Code::RequirementSyntax, span(pair), "this cannot stand here").help(help),
    }
}

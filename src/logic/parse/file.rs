//! Requirement files and single domains: what stands around formulas.

use std::collections::BTreeMap;

use pest::Parser;
use pest::iterators::Pair;

use super::{
    DomainText, Origin, Requirement, RequirementParser, Rule, checked_formula, constant, diagnostic, name_of, one_line,
    span,
};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::{Source, Span};
use crate::syntax::ast::key;

/// What a requirement file says.
#[derive(Clone, Debug, Default)]
pub struct RequirementFile {
    /// The requirements in their order.
    pub requirements: Vec<Requirement>,
    /// What free inputs can be.
    pub domains: Vec<DomainText>,
}

/// Reads a text that says what one input can be, like `level: 0..100`.
///
/// # Errors
/// What keeps the text from saying so.
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

/// Reads a requirement file: what can be read, and every error.
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
            Rule::bad => diagnostics.push(explain(&pair)),
            _ => {}
        }
    }
    if file.requirements.is_empty() && file.domains.is_empty() && diagnostics.is_empty() {
        let message = "this file holds no requirement";
        let help = "write one like `requirement name \"what it says\": AG (a -> b);`";
        diagnostics.push(Diagnostic::new(Code::RequirementSyntax, Span::default(), message).help(help));
    }
    (file, diagnostics)
}

fn requirement(pair: Pair<'_, Rule>, source: &Source) -> Result<Requirement, Diagnostic> {
    let fallback = span(&pair);
    let (mut name, mut sentence, mut formula) = ((String::new(), fallback), None, None);
    for piece in pair.into_inner() {
        match piece.as_rule() {
            Rule::identifier => name = (piece.as_str().to_owned(), span(&piece)),
            Rule::sentence => sentence = Some(piece.as_str().trim_matches('"').to_owned()),
            Rule::formula => formula = Some((one_line(piece.as_str()), checked_formula(piece)?)),
            _ => {}
        }
    }
    let (name, span) = name;
    match formula {
        Some((text, formula)) => {
            let origin = Origin::of(span, source);
            Ok(Requirement { name, sentence, words: None, tags: Vec::new(), formula, text, span, origin })
        }
        None => Err(Diagnostic::new(Code::RequirementSyntax, span, "this requirement has no formula")),
    }
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

/// Reads a piece that is no requirement as one, to say why it is none.
fn explain(pair: &Pair<'_, Rule>) -> Diagnostic {
    let (text, start) = (pair.as_str(), pair.as_span().start());
    let (rule, help) = match text.get(..6) {
        Some(word) if word.eq_ignore_ascii_case("domain") => {
            (Rule::lone_domain_line, "write it like `domain level: 0..100;`")
        }
        _ => (Rule::lone_requirement, "write it like `requirement name \"what it says\": AG (a -> b);`"),
    };
    match RequirementParser::parse(rule, text) {
        Err(error) => {
            let diagnostic = diagnostic(&error, text, start);
            if diagnostic.help.is_empty() { diagnostic.help(help) } else { diagnostic }
        }
        Ok(_) => Diagnostic::new(Code::RequirementSyntax, span(pair), "this cannot stand here").help(help),
    }
}

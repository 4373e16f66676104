//! Parser of specification files, with error recovery: text to [`Written`].

use std::sync::LazyLock;

use pest::Parser;
use pest::error::Error;
use pest::iterators::{Pair, Pairs};
use pest::pratt_parser::{Assoc, Op, PrattParser};
use pest_derive::Parser;

use super::formula::{Formula, Operator};
use super::scan::{MAX_DEPTH, scan};
use super::written::{Name, Written, WrittenBinding, WrittenFunction, WrittenInput, WrittenOutput, WrittenRestriction};
use petril_base::diagnostic::{self, Code, Diagnostic};
use petril_base::source::{Source, Span};
use petril_logic::number;
use petril_logic::two_comparisons;
use petril_logic::{chained, connectives};

#[derive(Parser)]
#[grammar = "../../grammar/expression.pest"]
#[grammar = "../../grammar/sif.pest"]
struct SifParser;

/// Parses a file.
pub(super) fn parse(source: &Source) -> (Written, Vec<Diagnostic>) {
    let text = source.text();
    let mut reader = Reader { written: Written::default(), diagnostics: Vec::new() };
    let open = match scan(text) {
        Ok(open) => open,
        Err(unreadable) => return (reader.written, vec![unreadable]),
    };
    match SifParser::parse(Rule::file, text) {
        Ok(pairs) => reader.items(pairs.flat_map(Pair::into_inner), None, text),
        Err(error) => reader.diagnostics.push(match open {
            Some(at) => {
                let diagnostic = Diagnostic::new(Code::SifSyntax, Span::new(at, at + 1), "this `{` is never closed");
                diagnostic.help("close it with `}`, or what stands within it")
            }
            None => explained(&error, text, 0),
        }),
    }
    (reader.written, reader.diagnostics)
}

/// Conversion of parse results.
struct Reader {
    written: Written,
    diagnostics: Vec<Diagnostic>,
}

impl Reader {
    /// Converts the items of a file or a zone.
    fn items<'i>(&mut self, pairs: impl Iterator<Item = Pair<'i, Rule>>, zone: Option<usize>, text: &str) {
        for pair in pairs {
            match pair.as_rule() {
                Rule::system => {
                    if let Some(title) = part(&pair, Rule::text) {
                        self.written.titles.push(Name { text: unquoted(&title), span: span(&title) });
                    }
                }
                Rule::zone => {
                    let Some(name) = part(&pair, Rule::name) else { continue };
                    self.written.zones.push((named(&name), part(&pair, Rule::text).as_ref().map(unquoted)));
                    self.items(pair.into_inner(), Some(self.written.zones.len() - 1), text);
                }
                Rule::input => self.input(&pair, None),
                Rule::restriction => self.restriction(&pair, zone, None),
                Rule::function => self.function(pair, zone, text),
                Rule::bad => self.bad(&pair, &[Rule::function, Rule::input, Rule::restriction, Rule::system], text),
                _ => {}
            }
        }
    }

    fn function(&mut self, pair: Pair<'_, Rule>, zone: Option<usize>, text: &str) {
        let Some(name) = part(&pair, Rule::name) else { return };
        let title = part(&pair, Rule::text).as_ref().map(unquoted);
        let (informal, outputs, equations) = (Vec::new(), Vec::new(), Vec::new());
        let function = WrittenFunction { name: named(&name), title, zone, informal, outputs, equations };
        self.written.functions.push(function);
        let here = self.written.functions.len() - 1;
        for section in pair.into_inner() {
            let rule = section.as_rule();
            if rule == Rule::bad {
                self.bad(&section, &[Rule::interface, Rule::informal, Rule::formal], text);
                continue;
            }
            if !matches!(rule, Rule::informal | Rule::interface | Rule::formal) {
                continue;
            }
            for member in section.into_inner() {
                match (member.as_rule(), rule) {
                    (Rule::remark, _) => {
                        let mut words = member.into_inner().filter(|part| part.as_rule() != Rule::colon);
                        let word = words.next().map(|word| word.as_str().to_owned()).unwrap_or_default();
                        let said = words.next().as_ref().map(unquoted).unwrap_or_default();
                        self.written.functions[here].informal.push((word, said));
                    }
                    (Rule::input, _) => self.input(&member, Some(here)),
                    (Rule::output, _) => self.output(&member, here),
                    (Rule::equation, _) => {
                        let (name, formula) = (part(&member, Rule::name), part(&member, Rule::formula));
                        if let (Some(name), Some(formula)) = (name, formula)
                            && let Some(formula) = self.formula(formula)
                        {
                            self.written.functions[here].equations.push((named(&name), formula));
                        }
                    }
                    (Rule::restriction, _) => self.restriction(&member, zone, Some(here)),
                    (Rule::bad, Rule::informal) => self.bad(&member, &[Rule::remark], text),
                    (Rule::bad, Rule::interface) => self.bad(&member, &[Rule::input, Rule::output], text),
                    (Rule::bad, _) => self.bad(&member, &[Rule::equation, Rule::restriction], text),
                    _ => {}
                }
            }
        }
    }

    fn input(&mut self, pair: &Pair<'_, Rule>, function: Option<usize>) {
        let Some(name) = part(pair, Rule::name) else { return };
        let rest = part(pair, Rule::normally).and_then(|normally| part(&normally, Rule::truth));
        let rest = rest.map(|truth| is_true(&truth));
        let description = part(pair, Rule::text).as_ref().map(unquoted);
        let binding = self.binding(pair);
        self.once(pair, &[Rule::normally]);
        self.written.inputs.push(WrittenInput { name: named(&name), description, binding, rest, function });
    }

    fn output(&mut self, pair: &Pair<'_, Rule>, function: usize) {
        let Some(name) = part(pair, Rule::name) else { return };
        let latched = part(pair, Rule::latched).and_then(|latched| part(&latched, Rule::formula));
        let latched = latched.and_then(|formula| self.formula(formula));
        let mut delayed = None;
        if let Some(duration) = part(pair, Rule::delayed).and_then(|delayed| part(&delayed, Rule::duration)) {
            delayed = number(duration.as_str()).ok().and_then(|time| u32::try_from(time).ok()).filter(|time| *time > 0);
            if delayed.is_none() {
                let message = format!("`{}` is no time above 0", duration.as_str());
                let help = "write it like `T#500ms`";
                self.diagnostics.push(Diagnostic::new(Code::SifSyntax, span(&duration), message).help(help));
            }
        }
        let description = part(pair, Rule::text).as_ref().map(unquoted);
        let binding = self.binding(pair);
        self.once(pair, &[Rule::latched]);
        self.once(pair, &[Rule::delayed]);
        let output = WrittenOutput { name: named(&name), description, binding, latched, delayed };
        self.written.functions[function].outputs.push(output);
    }

    /// Binding of a signal to the program.
    fn binding(&mut self, pair: &Pair<'_, Rule>) -> Option<WrittenBinding> {
        self.once(pair, &[Rule::at, Rule::is]);
        let at = part(pair, Rule::at).and_then(|at| part(&at, Rule::address)).as_ref().map(named);
        let is = part(pair, Rule::is).and_then(|is| part(&is, Rule::variable)).as_ref().map(named);
        is.map(WrittenBinding::Variable).or(at.map(WrittenBinding::Address))
    }

    /// Reports a second occurrence of declaration parts that may occur once.
    fn once(&mut self, pair: &Pair<'_, Rule>, rules: &[Rule]) {
        let mut parts = pair.clone().into_inner().filter(|part| rules.contains(&part.as_rule()));
        if let (Some(first), Some(second)) = (parts.next(), parts.next()) {
            let what = if rules == [Rule::at, Rule::is] { "where it is in the program" } else { "this" };
            let message = format!("a declaration says {what} once");
            let diagnostic = Diagnostic::new(Code::SifSyntax, span(&second), message);
            self.diagnostics.push(diagnostic.also(span(&first), "it is said here already").help("leave one out"));
        }
    }

    fn restriction(&mut self, pair: &Pair<'_, Rule>, zone: Option<usize>, function: Option<usize>) {
        let (Some(name), Some(body)) = (part(pair, Rule::name), part(pair, Rule::body)) else { return };
        let text = one_line(body.as_str());
        let sentence = part(pair, Rule::text).as_ref().map(unquoted);
        let is_never = part(&body, Rule::never_word).is_some();
        let is_plain = !is_never && part(&body, Rule::always_word).is_none();
        let allowed = match (part(&body, Rule::spoken), part(&body, Rule::formula)) {
            (Some(spoken), _) => self.among(spoken),
            (None, Some(formula)) => {
                let place = span(&formula);
                let is_spoken = formula.clone().into_inner().all(|part| part.as_rule() == Rule::among);
                let formula = self.formula(formula);
                let is_rule = matches!(formula, Some(Formula::Gate(Operator::Implies | Operator::Iff, _)));
                let says_itself = is_spoken || is_rule;
                if is_plain && !says_itself && formula.is_some() {
                    let message =
                        format!("restriction `{}` does not say whether this is never or always so", name.as_str());
                    self.diagnostics.push(
                        Diagnostic::new(Code::SifPolarity, place, message)
                            .help("put `never` before what cannot be, like a restriction formula, or `always` before what has to be"),
                    );
                }
                formula
            }
            _ => None,
        };
        if let Some(allowed) = allowed {
            let allowed = if is_never { allowed.negated() } else { allowed };
            let name = named(&name);
            self.written.restrictions.push(WrittenRestriction { name, sentence, zone, function, allowed, text });
        }
    }

    /// Converts a pair of the rule `formula`; `None`, with a diagnostic, if it is too large.
    fn formula(&mut self, pair: Pair<'_, Rule>) -> Option<Formula<Name>> {
        let is_chained = |p: &Pair<'_, Rule>| matches!(p.as_rule(), Rule::implies | Rule::iff);
        let chained = |pair: &Pair<'_, Rule>| pair.clone().into_inner().filter(is_chained).count();
        let all = std::iter::once(pair.clone()).chain(pair.clone().into_inner().flatten());
        let mut all = all.filter(|p| matches!(p.as_rule(), Rule::formula | Rule::list_item));
        let second =
            |p: Pair<'_, Rule>| chained!(p.into_inner(), Rule: equal | unequal; iff | implies | or | xor | and);
        if let Some(second) = all.clone().find_map(second) {
            self.diagnostics.push(two_comparisons(Code::SifSyntax, second));
            return None;
        }
        if let Some(chain) = all.find(|p| chained(p) > MAX_DEPTH) {
            let message = format!("more than {MAX_DEPTH} implications follow each other");
            self.diagnostics.push(Diagnostic::new(Code::SifSyntax, span(&chain), message));
            return None;
        }
        Some(formula(pair.into_inner()))
    }

    fn among(&mut self, pair: Pair<'_, Rule>) -> Option<Formula<Name>> {
        let word = pair.clone().into_inner().next()?;
        let parts = pair.into_inner().filter(|part| part.as_rule() == Rule::list_item);
        let parts: Option<Vec<_>> = parts.collect::<Vec<_>>().into_iter().map(|part| self.formula(part)).collect();
        Some(among(&word, parts?))
    }

    /// Explains why a piece cannot be parsed.
    fn bad(&mut self, pair: &Pair<'_, Rule>, rules: &[Rule], text: &str) {
        let start = pair.as_span().start();
        // An unclosed block reaches to the end of the file, and the error may be far after its beginning.
        let rest = &text[start..];
        let begins = |word: &str| {
            let head = rest.get(..word.len()).is_some_and(|head| head.eq_ignore_ascii_case(word));
            head && !rest[word.len()..].starts_with(|c: char| c.is_alphanumeric() || c == '_')
        };
        let words = [
            ("zone", Rule::zone),
            ("function", Rule::function),
            ("informal", Rule::informal),
            ("interface", Rule::interface),
            ("formal", Rule::formal),
            ("input", Rule::input),
            ("output", Rule::output),
            ("restriction", Rule::restriction),
            ("system", Rule::system),
        ];
        let rule = words.iter().find(|(word, _)| begins(word)).map_or(rules[0], |(_, rule)| *rule);
        let help = like(rule);
        let diagnostic = match SifParser::parse(rule, rest) {
            Err(error) => {
                let diagnostic = explained(&error, rest, start);
                if diagnostic.help.is_empty() { diagnostic.help(help) } else { diagnostic }
            }
            Ok(_) => {
                let place = Span::new(start, start + pair.as_str().split_whitespace().next().map_or(0, str::len));
                Diagnostic::new(Code::SifSyntax, place, "this cannot stand here").help(like(rules[0]))
            }
        };
        // Follow-up errors at the same place are suppressed.
        if self.diagnostics.last().is_none_or(|last| last.span() != diagnostic.span()) {
            self.diagnostics.push(diagnostic);
        }
    }
}

/// Example of what a rule accepts.
fn like(rule: Rule) -> &'static str {
    match rule {
        Rule::zone => "a zone is like `zone PS \"what it is\" { … }`",
        Rule::function => "a function is like `function F1 \"what it is for\" { interface { … } formal { … } }`",
        Rule::informal | Rule::remark => "write it like `informal { hazard: \"radiation\"; sil: 3; }`",
        Rule::interface => "a function holds the sections `informal { … }`, `interface { … }` and `formal { … }`",
        Rule::formal => "write it like `formal { F1 = door & !key; }`",
        Rule::input => "an input is like `input DOOR \"what it is\" at %IX0.0;`",
        Rule::output => "an output is like `output F1 \"what it is\" at %QX0.0;`",
        Rule::restriction => {
            "a restriction is like `restriction R1: never a & b;` or `restriction R1: at most one of a, b;`"
        }
        Rule::system => "write it like `system \"what it is called\";`",
        _ => "an equation is like `F1 = (a | b) & !c;`",
    }
}

static PRATT: LazyLock<PrattParser<Rule>> = LazyLock::new(|| {
    let left = |rule| Op::infix(rule, Assoc::Left);
    connectives!(Rule).op(left(Rule::equal) | left(Rule::unequal)).op(Op::prefix(Rule::negations))
});

/// Formula under construction, and whether it is closed (in parentheses), so that it takes no further operand.
type Part = (Formula<Name>, bool);

fn formula(pairs: Pairs<'_, Rule>) -> Formula<Name> {
    let parsed = PRATT
        .map_primary(|pair| (primary(pair), true))
        .map_prefix(|negations, (inner, _)| {
            let is_odd = negations.into_inner().count() % 2 == 1;
            (if is_odd { Formula::Not(Box::new(inner)) } else { inner }, true)
        })
        .map_infix(|left, operator, right| joined(left, operator.as_rule(), right.0))
        .parse(pairs);
    parsed.0
}

/// Joins two formulas by an operator; `a & b & c` becomes one conjunction of three.
fn joined((left, is_closed): Part, operator: Rule, right: Formula<Name>) -> Part {
    let operator = match operator {
        Rule::and => Operator::And,
        Rule::or => Operator::Or,
        Rule::xor | Rule::unequal => Operator::Xor,
        Rule::implies => Operator::Implies,
        _ => Operator::Iff,
    };
    let grows = matches!(operator, Operator::And | Operator::Or | Operator::Xor);
    let operands = match left {
        Formula::Gate(same, mut operands) if grows && !is_closed && same == operator => {
            operands.push(right);
            operands
        }
        left => vec![left, right],
    };
    (Formula::Gate(operator, operands), false)
}

fn primary(pair: Pair<'_, Rule>) -> Formula<Name> {
    match pair.as_rule() {
        Rule::truth => Formula::Constant(is_true(&pair)),
        Rule::group => match part(&pair, Rule::formula) {
            Some(inner) => formula(inner.into_inner()),
            None => Formula::Constant(false),
        },
        Rule::among => {
            let word = pair.clone().into_inner().next();
            let parts = pair.into_inner().filter(|part| part.as_rule() == Rule::list_item);
            let parts = parts.map(|part| formula(part.into_inner())).collect();
            word.map_or(Formula::Constant(false), |word| among(&word, parts))
        }
        _ => Formula::Signal(named(&pair)),
    }
}

/// At most, at least, or exactly one of the parts. At least one of a single part is that part.
fn among(word: &Pair<'_, Rule>, mut parts: Vec<Formula<Name>>) -> Formula<Name> {
    match word.as_rule() {
        Rule::at_most_one => Formula::Gate(Operator::AtMostOne, parts),
        Rule::exactly_one => Formula::Gate(Operator::ExactlyOne, parts),
        _ if parts.len() == 1 => parts.remove(0),
        _ => Formula::Gate(Operator::Or, parts),
    }
}

fn is_true(truth: &Pair<'_, Rule>) -> bool {
    matches!(truth.as_str().as_bytes().first(), Some(b'1' | b't' | b'T'))
}

/// The first inner pair of a rule.
fn part<'i>(pair: &Pair<'i, Rule>, rule: Rule) -> Option<Pair<'i, Rule>> {
    pair.clone().into_inner().find(|part| part.as_rule() == rule)
}

fn named(pair: &Pair<'_, Rule>) -> Name {
    Name { text: pair.as_str().split_whitespace().collect(), span: span(pair) }
}

fn unquoted(pair: &Pair<'_, Rule>) -> String {
    one_line(pair.as_str().trim_matches('"'))
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn span(pair: &Pair<'_, Rule>) -> Span {
    let start = pair.as_span().start();
    Span::new(start, start + pair.as_str().trim_end().len())
}

fn explained(error: &Error<Rule>, text: &str, start: usize) -> Diagnostic {
    diagnostic::expected(error, (text, start), Code::SifSyntax, "the end", name)
}

/// Name of a rule in messages about what was expected.
fn name(rule: Rule) -> Option<&'static str> {
    Some(match rule {
        Rule::EOI => "the end",
        Rule::name | Rule::ident => "a name",
        Rule::text => "a text in quotes",
        Rule::semicolon => "`;`",
        Rule::colon => "`:`",
        Rule::equals => "`=`",
        Rule::open => "`{`",
        Rule::close => "`}`",
        Rule::close_group => "`)`",
        Rule::formula
        | Rule::list_item
        | Rule::group
        | Rule::among
        | Rule::truth
        | Rule::negations
        | Rule::body
        | Rule::spoken => "a formula",
        Rule::and | Rule::or | Rule::xor | Rule::implies | Rule::iff | Rule::equal | Rule::unequal => "an operator",
        Rule::never_word => "`never`",
        Rule::always_word => "`always`",
        Rule::at | Rule::at_word => "`at`",
        Rule::is | Rule::is_word => "`is`",
        Rule::normally | Rule::normally_word => "`normally`",
        Rule::latched | Rule::latched_word => "`latched until`",
        Rule::delayed | Rule::delayed_word => "`delayed`",
        Rule::address => "an address like `%IX0.0`",
        Rule::variable => "the name of a variable",
        Rule::duration => "a time like `T#500ms`",
        Rule::key | Rule::remark => "a word",
        Rule::input | Rule::input_word => "`input`",
        Rule::output | Rule::output_word => "`output`",
        Rule::restriction | Rule::restriction_word => "`restriction`",
        Rule::function | Rule::function_word => "`function`",
        Rule::zone | Rule::zone_word => "`zone`",
        Rule::system | Rule::system_word => "`system`",
        Rule::informal | Rule::informal_word => "`informal`",
        Rule::interface | Rule::interface_word => "`interface`",
        Rule::formal | Rule::formal_word => "`formal`",
        Rule::equation => "an equation",
        _ => return None,
    })
}

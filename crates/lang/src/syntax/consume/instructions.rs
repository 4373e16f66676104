//! Instruction lists: instructions from the pieces that the grammar reads, with the two ends of each parenthesis
//! paired.

use pest::iterators::Pair;

use super::declarations::var_block;
use super::operands::{argument, operand, path};
use super::{first_word, name, span};
use crate::syntax::ast::{
    Argument, Arguments, Condition, Instruction, Name, Operand, Operation, Operator, VarBlock, Verb,
};
use crate::syntax::expected;
use crate::syntax::parse::Rule;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

/// Maximum nesting depth of parentheses. Real programs stay below ten; the limit keeps recursion over the tree within
/// its stack.
const MAX_DEPTH: usize = 200;

/// Consumes a pair of the rule `body`: its instructions, and declaration blocks that stand between them.
pub fn body(pair: Pair<'_, Rule>, diagnostics: &mut Vec<Diagnostic>) -> (Vec<Instruction>, Vec<VarBlock>) {
    let mut list = ListBuilder::default();
    let mut blocks = Vec::new();
    for piece in pair.into_inner() {
        match piece.as_rule() {
            Rule::instruction => list.instruction(piece, diagnostics),
            Rule::bad_line => list.bad_line(&piece, diagnostics),
            Rule::var_block => {
                let block = var_block(piece, diagnostics);
                let message = format!("a `{}` block stands behind an instruction", block.kind);
                diagnostics.push(
                    Diagnostic::new(Code::Syntax, block.span, message).help("move it before the first instruction"),
                );
                blocks.push(block);
            }
            _ => {}
        }
    }
    (list.finish(diagnostics), blocks)
}

/// Parenthesis that is still open.
struct Open {
    label: Option<Name>,
    operator: Operator,
    first: Option<Operand>,
    span: Span,
    /// Instructions before the parenthesis, on its level.
    outer: Vec<Instruction>,
}

/// Builder of a list with an explicit stack, so that nesting costs no recursion.
#[derive(Default)]
struct ListBuilder {
    current: Vec<Instruction>,
    open: Vec<Open>,
    /// Number of open parentheses beyond [`MAX_DEPTH`]; these are counted, not kept.
    too_deep: usize,
}

impl ListBuilder {
    fn instruction(&mut self, pair: Pair<'_, Rule>, diagnostics: &mut Vec<Diagnostic>) {
        let whole = span(&pair);
        let mut label = None;
        let mut operation = None;
        for piece in pair.into_inner() {
            match piece.as_rule() {
                Rule::label => label = piece.into_inner().next().map(|p| name(&p)),
                Rule::parenthesis => return self.open(label, piece, whole, diagnostics),
                Rule::parenthesis_end => {
                    if label.is_some() {
                        self.push(label.take(), None, whole);
                    }
                    return self.close(span(&piece), diagnostics);
                }
                _ => operation = Some(self::operation(piece)),
            }
        }
        self.push(label, operation, whole);
    }

    fn push(&mut self, label: Option<Name>, operation: Option<Operation>, span: Span) {
        self.current.push(Instruction { label, operation, span });
    }

    fn open(&mut self, label: Option<Name>, pair: Pair<'_, Rule>, span: Span, diagnostics: &mut Vec<Diagnostic>) {
        let mut open = Open {
            label,
            operator: Operator { verb: Verb::And, negated: false },
            first: None,
            span,
            outer: Vec::new(),
        };
        for piece in pair.into_inner() {
            match piece.as_rule() {
                Rule::expr_operator => open.operator = operator(piece.as_str()),
                _ => open.first = operand(piece),
            }
        }
        self.enter(open, diagnostics);
    }

    /// Opens a parenthesis, unless it is nested too deeply.
    fn enter(&mut self, mut open: Open, diagnostics: &mut Vec<Diagnostic>) {
        if self.open.len() < MAX_DEPTH {
            open.outer = std::mem::take(&mut self.current);
            self.open.push(open);
            return;
        }
        if self.too_deep == 0 {
            let message = format!("parentheses are nested more than {MAX_DEPTH} deep");
            let help = "store an intermediate result in a variable instead";
            diagnostics.push(Diagnostic::new(Code::ParenthesisTooDeep, open.span, message).help(help));
        }
        self.push(None, Some(Operation::Broken), open.span);
        self.too_deep += 1;
    }

    fn close(&mut self, close: Span, diagnostics: &mut Vec<Diagnostic>) {
        if self.too_deep > 0 {
            self.too_deep -= 1;
        } else if let Some(Open { label, operator, first, span, outer }) = self.open.pop() {
            let body = std::mem::replace(&mut self.current, outer);
            self.push(label, Some(Operation::Parenthesis { operator, first, body, close }), span);
        } else {
            let message = "this parenthesis closes nothing";
            diagnostics.push(
                Diagnostic::new(Code::ParenthesisNotOpened, close, message)
                    .help("a parenthesis opens behind an operator, like `AND(`"),
            );
        }
    }

    /// Reports a line that cannot be read. Parentheses that it leaves open, or closes, count all the same, so that
    /// their other ends are not reported.
    fn bad_line(&mut self, pair: &Pair<'_, Rule>, diagnostics: &mut Vec<Diagnostic>) {
        let explained = expected::explain(Rule::lone_instruction, pair.as_str(), pair.as_span().start());
        let at = explained.span().start - pair.as_span().start();
        let help = advice(pair.as_str(), at);
        diagnostics.push(if explained.help.is_empty() { explained.help(help) } else { explained });
        self.push(None, Some(Operation::Broken), span(pair));
        let mut opened = Vec::new();
        for (at, c) in pair.as_str().char_indices() {
            let at = Span::new(pair.as_span().start() + at, pair.as_span().start() + at + 1);
            match c {
                '(' => opened.push(at),
                ')' if opened.pop().is_none() => self.close(at, diagnostics),
                _ => {}
            }
        }
        for span in opened {
            let operator = Operator { verb: Verb::And, negated: false };
            self.enter(Open { label: None, operator, first: None, span, outer: Vec::new() }, diagnostics);
            self.push(None, Some(Operation::Broken), span);
        }
    }

    fn finish(mut self, diagnostics: &mut Vec<Diagnostic>) -> Vec<Instruction> {
        // Every open parenthesis is an error, but only the innermost is reported.
        if let Some(innermost) = self.open.last() {
            let message = match self.open.len() + self.too_deep {
                1 => "this parenthesis is never closed".to_owned(),
                2 => "this parenthesis and the one around it are never closed".to_owned(),
                n => format!("this parenthesis and {} around it are never closed", n - 1),
            };
            let help = "close it with `)` on a line of its own";
            diagnostics.push(Diagnostic::new(Code::ParenthesisNotClosed, innermost.span, message).help(help));
        }
        let end = self.current.last().map_or(Span::default(), |i| Span::new(i.span.end, i.span.end));
        self.too_deep = 0;
        while !self.open.is_empty() {
            self.close(end, diagnostics);
        }
        self.current
    }
}

/// Help for a line that cannot be read from this byte on.
fn advice(line: &str, at: usize) -> &'static str {
    let (before, behind) = line.split_at(at);
    if behind.starts_with('(') && before.contains('(') {
        "a parameter is a variable or a literal: compute the value before, and store it in a variable"
    } else if behind.starts_with(['<', '>', '=', '+', '-', '*', '/']) {
        "Instruction List has words instead of signs: `GT`, `LT`, `EQ`, `ADD`, `SUB`, …, each on a line of its own"
    } else {
        "an instruction is one operator with one operand, on a line of its own"
    }
}

pub fn operation(pair: Pair<'_, Rule>) -> Operation {
    let rule = pair.as_rule();
    let word = first_word(&pair);
    let suffix = |stem: &str| match word.key().trim_start_matches(stem) {
        "C" => Condition::IfTrue,
        "CN" => Condition::IfFalse,
        _ => Condition::Always,
    };
    let mut pieces = pair.into_inner();
    let Some(first) = pieces.next() else { return Operation::Broken };
    match rule {
        Rule::jump => {
            let target = pieces.next().map_or_else(|| word.clone(), |p| name(&p));
            Operation::Jump { condition: suffix("JMP"), target }
        }
        Rule::ret => Operation::Return { condition: suffix("RET") },
        Rule::call => match pieces.next() {
            Some(callee) => Operation::Call {
                condition: suffix("CAL"),
                callee: path(callee),
                arguments: Arguments { list: arguments(pieces.next()), enclosed: true },
            },
            None => Operation::Broken,
        },
        Rule::formal_call => Operation::Function {
            name: name(&first),
            arguments: Arguments { list: arguments(pieces.next()), enclosed: true },
        },
        _ if first.as_rule() == Rule::operator => {
            Operation::Simple { operator: operator(first.as_str()), operands: pieces.filter_map(operand).collect() }
        }
        _ => {
            let list = pieces.filter_map(operand).map(Argument::Positional).collect();
            Operation::Function { name: name(&first), arguments: Arguments { list, enclosed: false } }
        }
    }
}

/// Consumes a pair of the rule `arguments`.
fn arguments(pair: Option<Pair<'_, Rule>>) -> Vec<Argument> {
    pair.into_iter().flat_map(Pair::into_inner).filter_map(argument).collect()
}

/// Operator of a word that the grammar has read as one.
pub fn operator(word: &str) -> Operator {
    let word = word.to_ascii_uppercase().replace('&', "AND");
    let find = |stem: &str| Verb::ALL.iter().find(|(_, w)| *w == stem).map(|&(verb, _)| verb);
    match find(&word) {
        Some(verb) => Operator { verb, negated: false },
        None => Operator { verb: find(word.trim_end_matches('N')).unwrap_or(Verb::Ld), negated: true },
    }
}

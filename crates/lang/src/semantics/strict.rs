//! Checks against the letter of edition 2: constructs that are accepted although it does not have them, because real
//! programs do.

use std::collections::BTreeSet;

use super::address;
use super::project::Project;
use super::shape::PouId;
use super::{Shape, uses};
use crate::syntax::ast::{
    Argument, Arguments, Instruction, Operation, PouKind, Unit, VarBlock, Verb, key, with_nested,
};
use crate::syntax::{Comments, comments, without_comments};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::{Source, Span};

/// Reports everything in a file that the letter of edition 2 does not allow, each kind by its code.
#[must_use]
pub fn strict(source: &Source, unit: &Unit) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    // A project in XML has its own punctuation.
    if !source.text().trim_start().starts_with('<') {
        text(source, unit, &mut found);
    }
    let blocks = unit.pous.iter().flat_map(|pou| &pou.blocks).chain(&unit.globals);
    blocks.for_each(|block| names_and_addresses(block, &mut found));
    globals(unit, &mut found);
    if let (Some(first), false) = (unit.pous.first(), unit.pous.iter().any(|pou| pou.kind == PouKind::Program)) {
        let message = "this file holds no program";
        let help = "write a `PROGRAM` that calls it";
        found.push(Diagnostic::new(Code::StrictNoProgram, first.name.span, message).help(help));
    }
    found.sort_by_key(Diagnostic::span);
    found
}

/// Checks comments, ends of lines, and calls.
fn text(source: &Source, unit: &Unit, found: &mut Vec<Diagnostic>) {
    let Comments { to_line_end, nested } = comments(source.text());
    found.extend(to_line_end.into_iter().map(|span| {
        let message = "edition 2 has no comments that run to the end of the line";
        Diagnostic::new(Code::StrictLineComment, span, message).help("write `(* … *)`")
    }));
    found.extend(nested.into_iter().map(|span| {
        let message = "edition 2 has no comments inside comments";
        Diagnostic::new(Code::StrictNestedComment, span, message).help("remove the inner `(*` and `*)`")
    }));
    let plain = without_comments(source.text());
    for (instruction, _) in unit.pous.iter().flat_map(|pou| with_nested(&pou.body)) {
        punctuation(instruction, &plain, found);
    }
}

fn punctuation(instruction: &Instruction, plain: &str, found: &mut Vec<Diagnostic>) {
    let end = match &instruction.operation {
        Some(Operation::Parenthesis { close, .. }) => close.end,
        _ => instruction.span.end,
    };
    let behind = plain.get(end..).unwrap_or_default();
    let blanks = behind.len() - behind.trim_start_matches([' ', '\t']).len();
    if behind[blanks..].starts_with(';') {
        let span = Span::new(end + blanks, end + blanks + 1);
        let message = "an instruction ends with its line, not with `;`";
        found.push(Diagnostic::new(Code::StrictSemicolon, span, message).help("remove the `;`"));
    }
    match &instruction.operation {
        Some(Operation::Parenthesis { close, .. }) => {
            let before = plain.get(..close.start).unwrap_or_default();
            let line = before.rsplit('\n').next().unwrap_or_default();
            if !line.trim().is_empty() && close.start < close.end {
                let message = "`)` stands behind an instruction on its line";
                found.push(Diagnostic::new(Code::StrictClosing, *close, message).help("put it on a line of its own"));
            }
        }
        Some(Operation::Call { arguments, .. } | Operation::Function { arguments, .. }) => {
            formal_call(arguments, instruction.span, plain, found);
        }
        _ => {}
    }
}

/// Checks that every parameter of a formal call stands on a line of its own (B.2.1, `il_param_list`).
fn formal_call(arguments: &Arguments, span: Span, plain: &str, found: &mut Vec<Diagnostic>) {
    let is_formal = arguments.list.iter().any(|argument| !matches!(argument, Argument::Positional(_)));
    let text = plain.get(span.range()).unwrap_or_default();
    let breaks = |(at, _): (usize, &str)| text[at + 1..].trim_start_matches([' ', '\t', '\r']).starts_with('\n');
    if is_formal && !text.match_indices(['(', ',']).take(arguments.list.len()).all(breaks) {
        let message = "the parameters of a formal call stand on lines of their own";
        let help = "put a line end behind `(` and behind each `,`";
        found.push(Diagnostic::new(Code::StrictFormalCall, span, message).help(help));
    }
}

/// Reports words of the language as names of variables, and addresses without a size.
fn names_and_addresses(block: &VarBlock, found: &mut Vec<Diagnostic>) {
    const OTHERS: [&str; 9] = ["JMP", "JMPC", "JMPCN", "CAL", "CALC", "CALCN", "RET", "RETC", "RETCN"];
    let is_word = |name: &str| Verb::ALL.iter().any(|(_, word)| *word == name) || OTHERS.contains(&name);
    for declaration in &block.declarations {
        for name in declaration.names.iter().filter(|name| is_word(&name.key())) {
            let message = format!("`{}` is an operator, and cannot be the name of a variable", name.text);
            found.push(Diagnostic::new(Code::StrictOperatorName, name.span, message).help("rename the variable"));
        }
        let is_bool = declaration.spec.as_ref().is_some_and(|spec| spec.to_string().eq_ignore_ascii_case("BOOL"));
        let unsized_at = declaration
            .location
            .as_ref()
            .filter(|location| !is_bool && matches!(address::read(&location.text), Some((_, None))));
        if let Some(location) = unsized_at {
            let message = format!("`{}` is the address of one bit", location.text);
            let help = "write the size: B for 8 bits, W for 16, D for 32, L for 64";
            found.push(Diagnostic::new(Code::StrictAddressSize, location.span, message).help(help));
        }
    }
}

/// Reports global variables that a unit uses without declaring them.
fn globals(unit: &Unit, found: &mut Vec<Diagnostic>) {
    let (project, ..) = Project::of(unit);
    for (i, pou) in unit.pous.iter().enumerate() {
        let context = project.context(PouId(i));
        let mut reported = BTreeSet::new();
        for (path, _) in uses::paths(&context.pou.body, Some(&context)) {
            let name = &path.root.text;
            let is_global = context.symbols.find(name).is_none() && project.globals.find(name).is_some();
            if is_global && !name.starts_with('%') && reported.insert(key(name)) {
                let message = format!("`{name}` is a global variable that `{}` does not declare", pou.name.text);
                let what = context.project.globals.find(name).and_then(|(_, symbol)| symbol.shape.as_ref());
                let spec = what.map_or_else(|| "…".to_owned(), Shape::to_string);
                let help = format!("declare it: `VAR_EXTERNAL {name} : {spec}; END_VAR`");
                found.push(Diagnostic::new(Code::StrictGlobal, path.span, message).help(help));
            }
        }
    }
}

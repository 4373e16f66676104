//! Every variable that is used is declared. A name that is not is reported where it is used first.
//!
//! Passes: `LD a` where `a` is declared, however it is spelt.
//! Fails: `LD b` where it is not; `LD a.Q` and `LD a[1]`, since there is no type with parts; `LD %IX0.0`.

use std::collections::BTreeMap;

use super::Context;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::ast::{Name, Operand, Operation, with_nested};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let operations = with_nested(&context.pou.body).filter_map(|(instruction, _)| instruction.operation.as_ref());
    let operands = operations.flat_map(|operation| match operation {
        // Of an operator that is not supported it is enough to say so.
        Operation::Simple { operator, operands } if operator.verb.is_boolean() => operands.iter().collect(),
        Operation::Parenthesis { operator, first, .. } if operator.verb.is_boolean() => first.iter().collect(),
        _ => Vec::new(),
    });
    let names = operands.filter_map(|operand| match operand {
        Operand::Variable(name) => Some(name),
        Operand::Constant(_) => None,
    });
    let unknown = names.filter(|name| context.symbols.find(&name.text).is_none());
    let mut uses: BTreeMap<String, (&Name, usize)> = BTreeMap::new();
    unknown.for_each(|name| uses.entry(name.key()).or_insert((name, 0)).1 += 1);
    let mut firsts: Vec<(&Name, usize)> = uses.into_values().collect();
    firsts.sort_by_key(|(name, _)| name.span);
    let found = firsts.into_iter().enumerate().filter_map(|(i, (name, uses))| {
        let diagnostic = undeclared(name, i, context)?;
        Some(if uses > 1 { diagnostic.here(format!("the first of {uses} uses")) } else { diagnostic })
    });
    found.collect()
}

fn undeclared(name: &Name, position: usize, context: &Context<'_>) -> Option<Diagnostic> {
    if name.text.starts_with('%') {
        let message = format!("the address `{}` is not supported", name.text);
        let help = "declare a variable for it in `VAR_INPUT`, `VAR_OUTPUT` or `VAR`";
        return Some(Diagnostic::new(Code::DeclarationNotSupported, name.span, message).help(help));
    }
    let base = name.text.split(['.', '[']).next().unwrap_or_default();
    if let Some((_, symbol)) = context.symbols.find(base) {
        // Of a type that is not supported nothing can be said.
        symbol.role?;
        let message = format!("`{base}` is of type `BOOL` and has no parts, so there is no `{}`", name.text);
        return Some(Diagnostic::new(Code::OperandUnfit, name.span, message));
    }
    let message = format!("`{}` is not declared", name.text);
    let diagnostic = Diagnostic::new(Code::NameNotDeclared, name.span, message);
    Some(diagnostic.suggest_at(position, &name.text, context.symbols.names()))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Code;
    use crate::semantics::testing::{lines, program};

    #[test]
    fn unknown_names_are_reported_wherever_they_stand() {
        let text = program("LD x\nAND( y\nOR I\nOR( z\n)\n)\nST Q");
        assert_eq!(lines(Code::NameNotDeclared, &text), [2, 3, 5]);
    }

    #[test]
    fn a_name_is_reported_once() {
        let text = program("LD x\nAND y\nOR X\nST y\nS x");
        assert_eq!(lines(Code::NameNotDeclared, &text), [2, 3]);
    }

    #[test]
    fn parts_and_addresses_are_refused_by_name() {
        let text = program("LD i.Q\nAND i[1]\nOR %IX0.0\nST q");
        assert_eq!(lines(Code::OperandUnfit, &text), [2, 3]);
        assert_eq!(lines(Code::DeclarationNotSupported, &text), [4]);
    }

    #[test]
    fn a_name_whose_declaration_cannot_be_read_is_not_reported_again() {
        let text = "PROGRAM p VAR\na : BOOL\nEND_VAR\nLD a\nST a\nEND_PROGRAM";
        assert_eq!(lines(Code::NameNotDeclared, text), [0; 0]);
        assert_eq!(lines(Code::Syntax, text), [2]);
    }
}

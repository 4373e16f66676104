//! Typing of operators with their operands.

use super::Typing;
use crate::semantics::effect::block;
use crate::semantics::function::Function;
use crate::semantics::inference::{Class, NOWHERE};
use crate::semantics::program::{Action, Statement, TypeId};
use crate::syntax::ast::{Arguments, Instruction, Name, Operand, Operator, Verb};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

impl Typing<'_> {
    pub fn simple(
        &mut self,
        operator: Operator,
        operands: &[Operand],
        span: Span,
        result: TypeId,
    ) -> (Option<Action>, TypeId) {
        if let Some(Operand::Variable(path)) = operands.first()
            && operator.verb.is_block_input()
            && (!matches!(operator.verb, Verb::S | Verb::R) || block(&operands[0], self.context).is_some())
        {
            return (self.input_operator(operator, path, span, result), result);
        }
        // `ADD a, b` is a call of the function ADD, and `NOT` of nothing is the operator.
        if operands.len() > 1 && operator.verb.combines() && !operator.negated {
            let name = Name { text: operator.verb.word().to_owned(), span };
            let list = operands.iter().cloned().map(crate::syntax::ast::Argument::Positional).collect();
            return self.function(&name, &Arguments { list, enclosed: false }, span, result);
        }
        let takes = usize::from(operator.verb != Verb::Not);
        if operands.len() != takes {
            self.count(operator, operands, takes, span);
            return (None, self.types.fresh());
        }
        let Some(operand) = operands.first() else {
            self.types.demand(result, Class::Bits, span, "NOT");
            return (Some(Action::Complement(result)), result);
        };
        self.with_operand(operator, operand, span, result)
    }

    fn with_operand(
        &mut self,
        operator: Operator,
        operand: &Operand,
        span: Span,
        result: TypeId,
    ) -> (Option<Action>, TypeId) {
        let negated = operator.negated;
        let word = operator.to_string();
        match operator.verb {
            Verb::Ld => {
                let Some((ty, operand)) = self.operand(operand) else { return (None, self.types.fresh()) };
                if negated {
                    self.types.demand(ty, Class::Bits, span, word);
                }
                (Some(Action::Load { ty, negated, operand }), ty)
            }
            Verb::St => {
                let Some((ty, place)) = self.writable(operand, &word) else { return (None, result) };
                let at = place.span;
                self.same(ty, result, at, |known| {
                    format!(
                        "`{word}` stores in a variable of type `{}`, but the current result is of another",
                        known.scalar
                    )
                });
                if negated {
                    self.types.demand(ty, Class::Bits, span, word);
                }
                (Some(Action::Store { ty, negated, place }), result)
            }
            Verb::S | Verb::R => {
                let Some((ty, place)) = self.writable(operand, &word) else { return (None, result) };
                let boolean = self.types.boolean(NOWHERE);
                self.same(ty, boolean, place.span, |known| {
                    format!("`{word}` needs a `BOOL`, but this is `{}`", known.scalar)
                });
                self.same(result, boolean, span, |known| {
                    format!("`{word}` needs a `BOOL` as the current result, which is `{}`", known.scalar)
                });
                (Some(if operator.verb == Verb::S { Action::Set(place) } else { Action::Reset(place) }), result)
            }
            verb => {
                let Some(function) = function(verb) else {
                    let message = format!("`{operator}` is an operator for instances of function blocks");
                    self.diagnostics.push(Diagnostic::new(Code::NotCallable, operand.span(), message));
                    return (None, self.types.fresh());
                };
                let at = operand.span();
                let Some((ty, operand)) = self.operand(operand) else { return (None, self.types.fresh()) };
                let left = self.combine(function, operator, span, result, ty, at);
                (Some(Action::Combine { function, ty: result, negated, operand }), left)
            }
        }
    }

    /// Adds the constraints of an operator on its two sides; returns the type of its value.
    fn combine(
        &mut self,
        function: Function,
        operator: Operator,
        span: Span,
        result: TypeId,
        operand: TypeId,
        at: Span,
    ) -> TypeId {
        let word = operator.to_string();
        self.same(result, operand, at, |known| {
            format!("`{word}` needs two values of one type, and the current result is `{}`", known.scalar)
        });
        if operator.negated {
            self.types.demand(result, Class::Bits, span, word.clone());
        }
        self.demand(function, result, span, &word);
        if function.compares() { self.types.boolean(span) } else { result }
    }

    /// Adds the constraint of a function on the type of its operands.
    pub fn demand(&mut self, function: Function, ty: TypeId, span: Span, word: &str) {
        let class = match function {
            Function::Add | Function::Sub => Class::Magnitudes,
            Function::Mul | Function::Div | Function::Mod => Class::Integers,
            Function::Eq | Function::Ne => return,
            Function::Gt | Function::Ge | Function::Le | Function::Lt => Class::Ordered,
            Function::And
            | Function::Or
            | Function::Xor
            | Function::Shl
            | Function::Shr
            | Function::Rol
            | Function::Ror => Class::Bits,
        };
        self.types.demand(ty, class, span, word);
    }

    #[allow(clippy::too_many_arguments, reason = "these are the parts of one instruction")]
    pub fn parenthesis(
        &mut self,
        operator: Operator,
        first: Option<&Operand>,
        body: &[Instruction],
        close: Span,
        span: Span,
        result: TypeId,
    ) -> (Option<Action>, TypeId) {
        let mut statements = Vec::new();
        let mut inner = self.types.fresh();
        if let Some(first) = first {
            match self.operand(first) {
                Some((ty, operand)) => {
                    let action = Action::Load { ty, negated: false, operand };
                    statements.push(Statement { action, span: first.span() });
                    inner = ty;
                }
                None => inner = self.types.fresh(),
            }
        }
        let (more, value) = self.sequence(body, inner);
        statements.extend(more);
        let Some(function) = function(operator.verb) else { return (None, self.types.fresh()) };
        let left = self.combine(function, operator, span, result, value, close);
        let action = Action::Defer { function, ty: result, negated: operator.negated, body: statements, close };
        (Some(action), left)
    }

    fn count(&mut self, operator: Operator, operands: &[Operand], takes: usize, span: Span) {
        let count = |span, message: String| Diagnostic::new(Code::OperandCount, span, message);
        self.diagnostics.push(match operands.get(takes) {
            None => {
                let help = format!("write it behind the operator, like `{operator} a`");
                count(span, format!("`{operator}` needs an operand")).help(help)
            }
            Some(first) if takes == 0 => count(first.span(), "`NOT` takes no operand".to_owned())
                .help("it complements the current result; use `LDN` to load a complement"),
            Some(second) => count(second.span(), format!("`{operator}` takes one operand"))
                .help("write one instruction for each operand"),
        });
    }
}

/// Function of an operator that combines.
pub fn function(verb: Verb) -> Option<Function> {
    Some(match verb {
        Verb::And => Function::And,
        Verb::Or => Function::Or,
        Verb::Xor => Function::Xor,
        Verb::Add => Function::Add,
        Verb::Sub => Function::Sub,
        Verb::Mul => Function::Mul,
        Verb::Div => Function::Div,
        Verb::Mod => Function::Mod,
        Verb::Gt => Function::Gt,
        Verb::Ge => Function::Ge,
        Verb::Eq => Function::Eq,
        Verb::Ne => Function::Ne,
        Verb::Le => Function::Le,
        Verb::Lt => Function::Lt,
        _ => return None,
    })
}

//! The canonical text of a syntax tree: one instruction a line, operators in upper case, parentheses closed on a line of
//! their own. Reading it back gives the same tree.

use std::fmt::{self, Display, Formatter};

use super::ast::{Declaration, Instruction, Operand, Operation, Pou, Unit, VarBlock};

impl Display for Unit {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.pous.iter().try_for_each(|pou| write!(f, "{pou}"))
    }
}

impl Display for Pou {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.kind, self.name.text)?;
        if let Some(result) = &self.result {
            write!(f, " : {}", result.text)?;
        }
        writeln!(f)?;
        self.blocks.iter().try_for_each(|block| write!(f, "{block}"))?;
        list(f, &self.body, 1)?;
        writeln!(f, "END_{}", self.kind)
    }
}

impl Display for VarBlock {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.kind)?;
        if self.constant {
            write!(f, " CONSTANT")?;
        }
        if let Some(retain) = &self.retain {
            write!(f, " {}", retain.text.to_ascii_uppercase())?;
        }
        writeln!(f)?;
        self.declarations.iter().try_for_each(|declaration| writeln!(f, "    {declaration}"))?;
        writeln!(f, "END_VAR")
    }
}

impl Display for Declaration {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let names: Vec<&str> = self.names.iter().map(|name| name.text.as_str()).collect();
        write!(f, "{}", names.join(", "))?;
        if let Some(location) = &self.location {
            write!(f, " AT {}", location.text)?;
        }
        write!(f, " : {}", self.type_text.as_ref().map_or("", |t| t.text.as_str()))?;
        if let Some(initial) = &self.initial {
            write!(f, " := {}", initial.text)?;
        }
        write!(f, ";")
    }
}

impl Display for Operand {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(constant) => f.write_str(&constant.text),
            Self::Variable(name) => f.write_str(&name.text),
        }
    }
}

fn list(f: &mut Formatter<'_>, instructions: &[Instruction], depth: usize) -> fmt::Result {
    instructions.iter().try_for_each(|i| instruction(f, i, depth))
}

fn instruction(f: &mut Formatter<'_>, instruction: &Instruction, depth: usize) -> fmt::Result {
    let indent = depth * 4;
    if let Some(label) = &instruction.label {
        writeln!(f, "{}:", label.text)?;
    }
    match &instruction.operation {
        None | Some(Operation::Broken) => Ok(()),
        Some(Operation::Simple { operator, operands }) => {
            let operands: Vec<String> = operands.iter().map(ToString::to_string).collect();
            let line = format!("{:5} {}", operator.to_string(), operands.join(", "));
            writeln!(f, "{:indent$}{}", "", line.trim_end())
        }
        Some(Operation::Parenthesis { operator, first, body, .. }) => {
            let first = first.as_ref().map(|first| format!(" {first}")).unwrap_or_default();
            writeln!(f, "{:indent$}{operator}({first}", "")?;
            list(f, body, depth + 1)?;
            writeln!(f, "{:indent$})", "")
        }
        Some(Operation::Jump { condition, target }) => {
            writeln!(f, "{:indent$}JMP{} {}", "", condition.suffix(), target.text)
        }
        Some(Operation::Return { condition }) => writeln!(f, "{:indent$}RET{}", "", condition.suffix()),
        Some(Operation::Call { callee }) => writeln!(f, "{:indent$}CAL {}", "", callee.text),
        Some(Operation::Function { name }) => writeln!(f, "{:indent$}{}", "", name.text),
    }
}

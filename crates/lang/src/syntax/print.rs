//! Canonical text of a syntax tree: one instruction a line, operators in upper case, parentheses closed on a line of
//! their own. Parsing it gives the same tree.

use std::fmt::{self, Display, Formatter};

use super::ast::{
    Argument, Arguments, Configuration, Declaration, Feed, Initial, InitialKind, Instruction, Operand, Operation, Pou,
    Range, TypeDeclaration, TypeSpec, Unit, VarBlock,
};

impl Display for Unit {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if !self.types.is_empty() {
            writeln!(f, "TYPE")?;
            self.types.iter().try_for_each(|declared| writeln!(f, "    {declared}"))?;
            writeln!(f, "END_TYPE")?;
        }
        self.globals.iter().try_for_each(|block| write!(f, "{block}"))?;
        self.pous.iter().try_for_each(|pou| write!(f, "{pou}"))?;
        self.configurations.iter().try_for_each(|configuration| write!(f, "{configuration}"))
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
        if let Some(spec) = &self.spec {
            write!(f, " : {spec}")?;
        }
        if let Some(edge) = &self.edge {
            write!(f, " {}", edge.text.to_ascii_uppercase())?;
        }
        if let Some(initial) = &self.initial {
            write!(f, " := {initial}")?;
        }
        write!(f, ";")
    }
}

impl Display for TypeDeclaration {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.name.text)?;
        if let Some(spec) = &self.spec {
            write!(f, " : {spec}")?;
        }
        if let Some(initial) = &self.initial {
            write!(f, " := {initial}")?;
        }
        write!(f, ";")
    }
}

impl Display for TypeSpec {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Named(name) => f.write_str(&name.text),
            Self::Subrange { base, range } => write!(f, "{} ({range})", base.text),
            Self::Enumeration(values) => {
                let values: Vec<&str> = values.iter().map(|value| value.text.as_str()).collect();
                write!(f, "({})", values.join(", "))
            }
            Self::Array { ranges, of, .. } => write!(f, "ARRAY [{}] OF {of}", separated(ranges)),
            Self::Structure { members, .. } => {
                let members: Vec<String> = members.iter().map(ToString::to_string).collect();
                write!(f, "STRUCT {} END_STRUCT", members.join(" "))
            }
        }
    }
}

impl Display for Range {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}..{}", self.lower.text, self.upper.text)
    }
}

impl Display for Initial {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.kind {
            InitialKind::Constant(constant) => f.write_str(&constant.text),
            InitialKind::Name(path) => path.fmt(f),
            InitialKind::List(items) => {
                let items = items.iter().map(|(times, value)| match (times, &value.kind) {
                    (1, _) => value.to_string(),
                    (_, InitialKind::List(inner)) if inner.is_empty() => format!("{times}()"),
                    _ => format!("{times}({value})"),
                });
                write!(f, "[{}]", items.collect::<Vec<_>>().join(", "))
            }
            InitialKind::Structure(members) => {
                let members = members.iter().map(|(name, value)| format!("{} := {value}", name.text));
                write!(f, "({})", members.collect::<Vec<_>>().join(", "))
            }
        }
    }
}

impl Display for Configuration {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "CONFIGURATION {}", self.name.text)?;
        for task in &self.tasks {
            let interval = task.interval.as_ref().map(|interval| format!("INTERVAL := {}, ", interval.text));
            writeln!(f, "    TASK {} ({}PRIORITY := 1);", task.name.text, interval.unwrap_or_default())?;
        }
        for program in &self.programs {
            let task = program.task.as_ref().map(|task| format!(" WITH {}", task.text)).unwrap_or_default();
            writeln!(f, "    PROGRAM {}{task} : {};", program.name.text, program.program.text)?;
        }
        writeln!(f, "END_CONFIGURATION")
    }
}

impl Display for Argument {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Positional(operand) => operand.fmt(f),
            Self::Input { name, value: Feed::Operand(operand) } => write!(f, "{} := {operand}", name.text),
            Self::Input { name, value: Feed::List(instructions) } => {
                writeln!(f, "{} := (", name.text)?;
                list(f, instructions, 3)?;
                write!(f, "        )")
            }
            Self::Output { negated, name, target } => {
                write!(f, "{}{} => {target}", if *negated { "NOT " } else { "" }, name.text)
            }
        }
    }
}

fn separated<T: Display>(items: &[T]) -> String {
    items.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

/// Text of the arguments after the name of a called unit.
fn arguments(arguments: &Arguments) -> String {
    match (arguments.list.is_empty(), arguments.enclosed) {
        (true, _) => String::new(),
        (false, true) => format!("({})", separated(&arguments.list)),
        (false, false) => format!(" {}", separated(&arguments.list)),
    }
}

impl Display for Operand {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(constant) => f.write_str(&constant.text),
            Self::Variable(path) => path.fmt(f),
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
        Some(Operation::Call { condition, callee, arguments: given }) => {
            writeln!(f, "{:indent$}CAL{} {callee}{}", "", condition.suffix(), arguments(given))
        }
        Some(Operation::Function { name, arguments: given }) => {
            // Without parentheses, the current result would be the first input.
            let given = if given.enclosed && given.list.is_empty() { "()".to_owned() } else { arguments(given) };
            writeln!(f, "{:indent$}{}{given}", "", name.text)
        }
    }
}

//! Flat code as text.

use super::{FlatProgram, Instruction, Operand, Target};
use crate::semantics::{Kind, Role, Type};
use petril_base::source::Source;

impl FlatProgram {
    /// Text of an instruction as one would write it: `ANDN  O1`, `JMPC  17`, `JMP   End`.
    #[must_use]
    pub fn text(&self, instruction: Instruction) -> String {
        let n = |negated: bool| if negated { "N" } else { "" };
        let name = |target| self.target_text(target);
        let value = |operand, ty| match operand {
            Operand::Place(target) => name(target),
            Operand::Constant(pattern) => literal(ty, pattern),
        };
        let (operator, operand) = match instruction {
            Instruction::Load { ty, negated, operand } => (format!("LD{}", n(negated)), value(operand, ty)),
            Instruction::Store { negated, target, .. } => (format!("ST{}", n(negated)), name(target)),
            Instruction::Set(target) => ("S".to_owned(), name(target)),
            Instruction::Reset(target) => ("R".to_owned(), name(target)),
            Instruction::Complement(_) => return "NOT".to_owned(),
            Instruction::Combine { function, ty, negated, operand } => {
                let operand = match operand {
                    // The distance of a shift is a number, whatever is shifted.
                    Operand::Constant(distance) if function.shifts() => distance.to_string(),
                    _ => value(operand, ty),
                };
                (format!("{}{}", function.word(), n(negated)), operand)
            }
            Instruction::Convert { from, to } => return format!("{from}_TO_{to}"),
            Instruction::Bound { lower, upper, .. } => ("BOUND".to_owned(), format!("{lower}..{upper}")),
            Instruction::Jump { condition, target } => {
                let target = if target == self.end() { "End".to_owned() } else { (target + 1).to_string() };
                (format!("JMP{}", condition.suffix()), target)
            }
        };
        format!("{operator:<5} {operand}")
    }

    /// Text of a variable, or of an element of an array as `level[A]`.
    fn target_text(&self, target: Target) -> String {
        match target {
            Target::Variable(variable) => self.variable(variable).name.clone(),
            Target::Element(element) => {
                let first = &self.variable(element.first).name;
                let index = &self.variable(element.index).name;
                match first.rsplit_once('[') {
                    Some((array, rest)) => {
                        let member = rest.split_once(']').map_or("", |(_, member)| member);
                        format!("{array}[{index}]{member}")
                    }
                    None => format!("{first}[{index}]"),
                }
            }
        }
    }

    /// Listing of the whole code: line number, instruction, and the source line it comes from, each source line once;
    /// then the buffers. Printed by `petril flat`.
    #[must_use]
    pub fn listing(&self, source: &Source) -> String {
        let texts: Vec<String> = self.code.iter().map(|line| self.text(line.instruction)).collect();
        let width = texts.iter().map(String::len).max().unwrap_or(0);
        let digits = texts.len().to_string().len();
        let mut out = String::new();
        let mut last = 0;
        for (i, (line, text)) in self.code.iter().zip(&texts).enumerate() {
            let from = source.line_of(line.span.start);
            let origin = if from == last { String::new() } else { format!("{from:4} | {}", source.line_text(from)) };
            last = from;
            out += format!("{:digits$}  {text:width$}   {origin}", i + 1).trim_end();
            out += "\n";
        }
        let buffers: Vec<&str> = self.with_role(Role::Buffer).map(|id| self.variable(id).name.as_str()).collect();
        if !buffers.is_empty() {
            out += &format!("\nbuffers of parentheses: {}\n", buffers.join(", "));
        }
        out
    }
}

/// Text of a value as a literal of its type: `TRUE`, `-5`, `16#FF`, `T#200ms`.
#[must_use]
pub fn literal(ty: Type, pattern: u64) -> String {
    match ty.kind {
        Kind::Bits if ty.is_bool() => if pattern & 1 == 1 { "TRUE" } else { "FALSE" }.to_owned(),
        Kind::Bits => format!("16#{:X}", pattern & ty.mask()),
        Kind::Time => format!("T#{}ms", ty.number(pattern)),
        Kind::Signed | Kind::Unsigned => ty.number(pattern).to_string(),
    }
}

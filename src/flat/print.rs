//! Flat code as text.

use super::{FlatProgram, Instruction};
use crate::semantics::{Function, Operand, Role};
use crate::source::Source;

impl FlatProgram {
    /// An instruction as one would write it: `ANDN  O1`, `JMPC  17`, `JMP   End`.
    #[must_use]
    pub fn text(&self, instruction: Instruction) -> String {
        let n = |negated: bool| if negated { "N" } else { "" };
        let name = |variable| self.variable(variable).name.clone();
        let value = |operand| match operand {
            Operand::Variable(variable) => name(variable),
            Operand::Constant(value) => if value { "TRUE" } else { "FALSE" }.to_owned(),
        };
        let (operator, operand) = match instruction {
            Instruction::Load { negated, operand } => (format!("LD{}", n(negated)), value(operand)),
            Instruction::Store { negated, variable } => (format!("ST{}", n(negated)), name(variable)),
            Instruction::Set(variable) => ("S".to_owned(), name(variable)),
            Instruction::Reset(variable) => ("R".to_owned(), name(variable)),
            Instruction::Complement => return "NOT".to_owned(),
            Instruction::Combine { function, negated, operand } => {
                let word = match function {
                    Function::And => "AND",
                    Function::Or => "OR",
                    Function::Xor => "XOR",
                };
                (format!("{word}{}", n(negated)), value(operand))
            }
            Instruction::Jump { condition, target } => {
                let target = if target == self.end() { "End".to_owned() } else { (target + 1).to_string() };
                (format!("JMP{}", condition.suffix()), target)
            }
        };
        format!("{operator:<5} {operand}")
    }

    /// The whole code: line number, instruction, and the source line it comes from, each source line once; then the
    /// buffers. This is what `petril flat` prints.
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

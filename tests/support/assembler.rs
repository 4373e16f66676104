//! Flat code of any type from a few words, for tests of what works on flat code.

use petril::flat::{Condition, FlatProgram, Function, Hazard, Instruction, Line, Operand, Target, Variable};
use petril::logic;
use petril::semantics::{Role, Type, VarId};
use petril::source::Span;

/// A type by its name.
pub fn ty(name: &str) -> Type {
    Type::named(name).unwrap_or_else(|| panic!("no type {name}"))
}

/// A program. Declarations are like `in x INT`, `var n USINT 250`, `out q BOOL`; instructions stand one on a line:
/// `LD x`, `LD INT#5`, `ADDN y`, `JMPC 3` (to line 3, from 1), `TO DINT`, `INDEX 0..4`, `SUBRANGE -5..5`. The type of an
/// instruction is that of what was loaded before.
pub fn assemble(declarations: &str, code: &str) -> FlatProgram {
    let variables: Vec<Variable> = declarations.lines().filter(|line| !line.trim().is_empty()).map(variable).collect();
    let mut assembler = Assembler { variables: &variables, ty: Type::BOOL };
    let lines = code.lines().map(str::trim).filter(|line| !line.is_empty());
    let code: Vec<Line> =
        lines.map(|line| Line { instruction: assembler.instruction(line), span: Span::default() }).collect();
    FlatProgram {
        name: "p".to_owned(),
        variables,
        code,
        scan_time: None,
        cycle: 20,
        presets_vary: false,
        restrictions: Default::default(),
        addresses: Default::default(),
        internal: Default::default(),
    }
}

fn variable(declaration: &str) -> Variable {
    let words: Vec<&str> = declaration.split_whitespace().collect();
    let role = match words[0] {
        "in" => Role::Input,
        "out" => Role::Output,
        "var" => Role::Memory,
        _ => Role::Buffer,
    };
    let ty = ty(words[2]);
    let initial = words.get(3).map_or(0, |word| ty.pattern(word.parse().unwrap()));
    Variable { name: words[1].to_owned(), role, ty, bits: ty.width, initial, span: None }
}

struct Assembler<'a> {
    variables: &'a [Variable],
    ty: Type,
}

impl Assembler<'_> {
    fn find(&self, name: &str) -> Option<VarId> {
        self.variables.iter().position(|variable| variable.name == name).map(VarId)
    }

    fn operand(&self, word: &str) -> Operand {
        match self.find(word) {
            Some(id) => Operand::Place(Target::Variable(id)),
            None => Operand::Constant(self.ty.pattern(logic::number(word).unwrap_or_else(|e| panic!("{word}: {e}")))),
        }
    }

    fn instruction(&mut self, line: &str) -> Instruction {
        let (word, operand) = line.split_once(' ').unwrap_or((line, ""));
        let target = || Target::Variable(self.find(operand).unwrap_or_else(|| panic!("no variable {operand}")));
        let jump = |condition| Instruction::Jump { condition, target: operand.parse::<usize>().unwrap() - 1 };
        let bound = |hazard| {
            let (lower, upper) = operand.split_once("..").unwrap();
            Instruction::Bound { ty: self.ty, lower: lower.parse().unwrap(), upper: upper.parse().unwrap(), hazard }
        };
        let instruction = match word {
            "LD" | "LDN" => {
                let typed = operand.split_once('#').map(|(head, _)| ty(head));
                self.ty = typed.or(self.find(operand).map(|id| self.variables[id.0].ty)).unwrap_or(self.ty);
                Instruction::Load { ty: self.ty, negated: word == "LDN", operand: self.operand(operand) }
            }
            "ST" | "STN" => Instruction::Store { ty: self.ty, negated: word == "STN", target: target() },
            "S" => Instruction::Set(target()),
            "R" => Instruction::Reset(target()),
            "NOT" => Instruction::Complement(self.ty),
            "JMP" => jump(Condition::Always),
            "JMPC" => jump(Condition::IfTrue),
            "JMPCN" => jump(Condition::IfFalse),
            "TO" => Instruction::Convert { from: self.ty, to: ty(operand) },
            "INDEX" => bound(Hazard::Index),
            "SUBRANGE" => bound(Hazard::Subrange),
            _ => {
                let function = function(word.strip_suffix('N').unwrap_or(word));
                Instruction::Combine {
                    function,
                    ty: self.ty,
                    negated: word.ends_with('N'),
                    operand: self.operand(operand),
                }
            }
        };
        self.ty = instruction.gives().unwrap_or(self.ty);
        instruction
    }
}

fn function(word: &str) -> Function {
    use Function::{Add, And, Div, Eq, Ge, Gt, Le, Lt, Mod, Mul, Ne, Or, Rol, Ror, Shl, Shr, Sub, Xor};
    let all = [And, Or, Xor, Add, Sub, Mul, Div, Mod, Gt, Ge, Eq, Ne, Le, Lt, Shl, Shr, Rol, Ror];
    all.into_iter().find(|function| function.word() == word).unwrap_or_else(|| panic!("no operator {word}"))
}

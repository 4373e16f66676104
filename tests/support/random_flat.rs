//! Random flat programs over all types, with arrays, conversions, bounds and every function, whether the standard has it for
//! the type or not.

use petril::flat::{Condition, Element, FlatProgram, Function, Hazard, Instruction, Operand, Target, Variable};
use petril::semantics::{Kind, Role, Type, VarId};

use super::token_game::{flat, variable};

/// Decisions, made by numbers in their order; when there are no more, the first choice is taken.
pub struct Choices<'a>(std::slice::Iter<'a, u32>);

impl<'a> Choices<'a> {
    pub fn new(numbers: &'a [u32]) -> Self {
        Self(numbers.iter())
    }

    pub fn pick(&mut self, choices: usize) -> usize {
        self.0.next().map_or(0, |&number| number as usize % choices)
    }

    pub fn of<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.pick(list.len())]
    }

    pub fn flag(&mut self) -> bool {
        self.pick(2) == 1
    }

    /// A pattern of a type, often a small number or one near the ends.
    pub fn pattern(&mut self, ty: Type) -> u64 {
        let number = match self.pick(4) {
            0 => self.pick(8) as i128,
            1 => ty.greatest() - self.pick(3) as i128,
            2 => ty.least() + self.pick(3) as i128,
            _ => (self.pick(1 << 32) as i128) << 32 | self.pick(1 << 32) as i128,
        };
        ty.pattern(number)
    }

    /// A type, mostly a narrow one.
    pub fn ty(&mut self) -> Type {
        let wide = self.pick(12);
        let all: Vec<Type> = Type::ALL.iter().map(|&(_, ty)| ty).collect();
        let fits = |ty: &&Type| match wide {
            0..7 => ty.width <= 8,
            7..10 => ty.width <= 16,
            _ => true,
        };
        let few: Vec<Type> = all.iter().filter(fits).copied().collect();
        self.of(&few)
    }
}

/// A program in the making.
struct Making<'c, 'n> {
    choices: &'c mut Choices<'n>,
    variables: Vec<Variable>,
    arrays: Vec<Element>,
    code: Vec<Instruction>,
}

/// A program of at most `statements` statements. Every statement begins with a load, and jumps go to statements.
pub fn program(choices: &mut Choices<'_>, statements: usize) -> FlatProgram {
    let mut making = Making { choices, variables: Vec::new(), arrays: Vec::new(), code: Vec::new() };
    making.declare();
    let count = 1 + making.choices.pick(statements);
    let mut starts = Vec::new();
    for _ in 0..count {
        starts.push(making.code.len());
        if making.arrays.is_empty() || making.choices.pick(4) > 0 {
            making.statement(count);
        } else {
            making.index();
        }
    }
    starts.push(making.code.len());
    let mut code = making.code;
    for instruction in &mut code {
        if let Instruction::Jump { target, .. } = instruction {
            *target = starts[*target];
        }
    }
    flat(making.variables, code)
}

impl Making<'_, '_> {
    fn declare(&mut self) {
        let roles = [Role::Memory, Role::Input, Role::Output, Role::Constant];
        for number in 0..2 + self.choices.pick(5) {
            let (role, ty) = (self.choices.of(&roles), self.choices.ty());
            let mut new = variable(&format!("v{number}"), role, ty);
            new.initial = self.choices.pattern(ty);
            self.variables.push(new);
        }
        for number in 0..self.choices.pick(3) {
            let (ty, length, stride) = (self.choices.ty(), 1 + self.choices.pick(5), 1 + self.choices.pick(2));
            let first = VarId(self.variables.len());
            for position in 0..length * stride {
                // What lies between the elements are those of other members.
                let own = if position % stride == 0 { ty } else { self.choices.ty() };
                let mut new = variable(&format!("a{number}[{position}]"), Role::Memory, own);
                new.initial = self.choices.pattern(own);
                self.variables.push(new);
            }
            let types: Vec<Type> = Type::ALL.iter().map(|&(_, ty)| ty).filter(|ty| !ty.is_bool()).collect();
            let mut index = variable(&format!("i{number}"), Role::Buffer, self.choices.of(&types));
            index.bits = (usize::BITS - (length - 1).leading_zeros()).max(1);
            self.variables.push(index);
            let index = VarId(self.variables.len() - 1);
            self.arrays.push(Element { first, stride, length, index });
        }
    }

    /// Variables and elements of a type, or of any.
    fn places(&self, ty: Option<Type>, written: bool) -> Vec<Target> {
        let fits = |variable: &Variable| ty.is_none_or(|ty| variable.ty == ty);
        let may = |variable: &Variable| !written || matches!(variable.role, Role::Memory | Role::Output);
        let variables = (0..self.variables.len()).map(VarId).filter(|id| {
            let variable = &self.variables[id.0];
            fits(variable) && may(variable) && (!written || variable.role != Role::Buffer)
        });
        let arrays = self.arrays.iter().filter(|array| fits(&self.variables[array.first.0]));
        variables.map(Target::Variable).chain(arrays.map(|&array| Target::Element(array))).collect()
    }

    fn operand(&mut self, ty: Type) -> Operand {
        let places = self.places(Some(ty), false);
        if places.is_empty() || self.choices.pick(4) == 0 {
            return Operand::Constant(self.choices.pattern(ty));
        }
        Operand::Place(self.choices.of(&places))
    }

    fn statement(&mut self, statements: usize) {
        let places = self.places(None, false);
        let place = self.choices.of(&places);
        let (Target::Variable(example) | Target::Element(Element { first: example, .. })) = place;
        let mut ty = self.variables[example.0].ty;
        let (negated, operand) = (self.choices.flag(), Operand::Place(place));
        let negated = negated && self.variables[example.0].role != Role::Buffer;
        self.code.push(Instruction::Load { ty, negated, operand });
        for _ in 0..self.choices.pick(5) {
            ty = self.compute(ty);
        }
        for _ in 0..1 + self.choices.pick(2) {
            self.finish(ty, statements);
        }
    }

    /// An instruction that works on the current result; the type of what comes of it.
    fn compute(&mut self, ty: Type) -> Type {
        match self.choices.pick(8) {
            0 => {
                self.code.push(Instruction::Complement(ty));
                ty
            }
            1 => {
                let to = self.choices.ty();
                self.code.push(Instruction::Convert { from: ty, to });
                to
            }
            2 => {
                let (a, b) = (self.choices.pattern(ty), self.choices.pattern(ty));
                let (a, b) = (ty.number(a), ty.number(b));
                let hazard = self.choices.of(&[Hazard::Subrange, Hazard::Index]);
                // Bounds may be outside of the type.
                let upper = a.max(b) + if self.choices.pick(4) == 0 { 300 } else { 0 };
                self.code.push(Instruction::Bound { ty, lower: a.min(b), upper, hazard });
                ty
            }
            _ => {
                // The large ones only where they are not too large.
                let count = if ty.width <= 16 || self.choices.pick(20) == 0 { Function::ALL.len() } else { 15 };
                let function = Function::ALL[self.choices.pick(count)];
                let negated = ty.kind == Kind::Bits && self.choices.flag();
                let operand_type = if function.shifts() && self.choices.flag() { self.choices.ty() } else { ty };
                let operand = self.operand(operand_type);
                self.code.push(Instruction::Combine { function, ty, negated, operand });
                if function.compares() { Type::BOOL } else { ty }
            }
        }
    }

    /// Stores, sets, resets or jumps.
    fn finish(&mut self, ty: Type, statements: usize) {
        let places = self.places(Some(ty), true);
        let choice = self.choices.pick(if ty.is_bool() { 8 } else { 5 });
        if choice == 4 || places.is_empty() {
            // Most jumps that do not ask lead to loops.
            if ty.is_bool() || self.choices.pick(8) == 0 {
                let conditions = [Condition::IfTrue, Condition::IfFalse, Condition::Always];
                let condition = conditions[if ty.is_bool() { self.choices.pick(3) } else { 2 }];
                let target = self.choices.pick(statements + 1);
                self.code.push(Instruction::Jump { condition, target });
            }
            return;
        }
        let target = self.choices.of(&places);
        self.code.push(match choice {
            5 | 6 => Instruction::Set(target),
            7 => Instruction::Reset(target),
            _ => Instruction::Store { ty, negated: self.choices.pick(4) == 0, target },
        });
    }

    /// An index buffer gets a new value.
    fn index(&mut self) {
        let array = self.arrays[self.choices.pick(self.arrays.len())];
        let numbers: Vec<Target> = self.places(None, false);
        let place = self.choices.of(&numbers);
        let (Target::Variable(example) | Target::Element(Element { first: example, .. })) = place;
        let (from, to) = (self.variables[example.0].ty, self.variables[array.index.0].ty);
        self.code.push(Instruction::Load { ty: from, negated: false, operand: Operand::Place(place) });
        let upper = array.length as i128 - 1;
        self.code.push(Instruction::Bound { ty: from, lower: 0, upper, hazard: Hazard::Index });
        self.code.push(Instruction::Convert { from, to });
        let target = Target::Variable(array.index);
        self.code.push(Instruction::Store { ty: to, negated: false, target });
    }
}

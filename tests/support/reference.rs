//! A third opinion on what a program means: the checked program executed as it is written, call by call, with the integers of
//! Rust. It knows neither flat code nor buffers, and shares no code with what it is compared with.

mod calls;
mod places;

use std::rc::Rc;

use petril::flat::Hazard;
use petril::semantics::{
    Action, Condition, Function, Index, Kind, Operand, Place, Pou, Program, Root, Scalar, Section, Shape, Statement,
    Step, Type, TypeId, Value, elements,
};

/// The value of a variable: a pattern, or the values of its parts.
#[derive(Clone, Debug)]
pub enum Cell {
    One(u64),
    Parts(Vec<Cell>),
}

/// A part of a variable: its number, and the way from there.
#[derive(Clone, Debug)]
struct Location {
    variable: usize,
    way: Vec<usize>,
}

/// A unit in execution: where its variables are.
struct Frame<'p> {
    pou: &'p Pou,
    variables: Vec<Option<Location>>,
}

/// A program with its memory.
pub struct Reference<'p> {
    program: &'p Program,
    scan_time: i128,
    /// First the variables of the program and the global ones, then those of calls.
    memory: Vec<Cell>,
    globals: usize,
    result: u64,
    pub hazards: Vec<Hazard>,
    /// How many instructions may still be executed in this scan.
    steps: usize,
    /// Clocks stop at the preset time of their timer.
    clocks_stop: bool,
}

/// The scan takes too long.
#[derive(Debug)]
pub struct TooLong;

type Done = Result<(), TooLong>;

impl<'p> Reference<'p> {
    /// Where preset times may be anything, clocks stop at them (`clocks_stop`); else they go on while their timers run.
    pub fn new(program: &'p Program, clocks_stop: bool) -> Self {
        let scan_time = i128::from(program.interval.unwrap_or(20));
        let (memory, hazards) = (Vec::new(), Vec::new());
        let mut new = Self { program, scan_time, memory, globals: 0, result: 0, hazards, steps: 0, clocks_stop };
        let entry = &program.pous[&program.entry];
        new.memory = entry.variables.iter().map(|variable| new.cell(&variable.shape, &variable.initial)).collect();
        new.globals = new.memory.len();
        let globals: Vec<Cell> =
            program.globals.iter().map(|global| new.cell(&global.shape, &global.initial)).collect();
        new.memory.extend(globals);
        new
    }

    /// The elementary values of the program's variables and the global ones, in their order; those of temporary, external and
    /// in-out variables are left out.
    pub fn values(&self) -> Vec<u64> {
        let mut values = Vec::new();
        let entry = &self.program.pous[&self.program.entry];
        let own = entry.variables.iter().map(|variable| (&variable.shape, variable.section));
        let global = self.program.globals.iter().map(|variable| (&variable.shape, variable.section));
        for (cell, (shape, section)) in self.memory.iter().zip(own.chain(global)) {
            if !matches!(section, Section::Temp | Section::External(_) | Section::InOut) {
                self.leaves(cell, shape, &mut values);
            }
        }
        values
    }

    fn leaves(&self, cell: &Cell, shape: &Shape, values: &mut Vec<u64>) {
        match (cell, shape) {
            (Cell::One(pattern), _) => values.push(*pattern),
            (Cell::Parts(cells), Shape::Array { of, .. }) => cells.iter().for_each(|c| self.leaves(c, of, values)),
            (Cell::Parts(cells), Shape::Structure(structure)) => {
                cells.iter().zip(&structure.members).for_each(|(c, member)| self.leaves(c, &member.shape, values));
            }
            (Cell::Parts(cells), Shape::Instance(id)) => {
                for (cell, variable) in cells.iter().zip(&self.program.pous[id].variables) {
                    if stays(variable.section) {
                        self.leaves(cell, &variable.shape, values);
                    }
                }
            }
            (Cell::Parts(_), Shape::Scalar(_)) => panic!("one value has parts"),
        }
    }

    /// A variable at power-on.
    fn cell(&self, shape: &Shape, initial: &Value) -> Cell {
        let given = |position: usize| match initial {
            Value::Parts(parts) => {
                parts.iter().rev().find(|(range, _)| range.contains(&position)).map(|(_, value)| value)
            }
            _ => None,
        };
        match shape {
            Shape::Scalar(scalar) => Cell::One(match initial {
                Value::Scalar(pattern) => *pattern,
                _ => scalar.default,
            }),
            Shape::Array { ranges, of } => {
                let of = (0..elements(ranges)).map(|i| self.cell(of, given(i).unwrap_or(&Value::Default)));
                Cell::Parts(of.collect())
            }
            Shape::Structure(structure) => {
                let members = structure.members.iter().enumerate();
                Cell::Parts(members.map(|(i, m)| self.cell(&m.shape, given(i).unwrap_or(&m.initial))).collect())
            }
            Shape::Instance(id) => {
                let variables = self.program.pous[id].variables.iter().enumerate();
                Cell::Parts(variables.map(|(i, v)| self.cell(&v.shape, given(i).unwrap_or(&v.initial))).collect())
            }
        }
    }

    /// Gives the elementary input at a position a value.
    pub fn set(&mut self, position: usize, pattern: u64) {
        self.memory[position] = Cell::One(pattern);
    }

    /// Executes one scan of at most so many instructions.
    pub fn scan(&mut self, steps: usize) -> Done {
        self.hazards.clear();
        self.steps = steps;
        let program = self.program;
        let pou = &program.pous[&program.entry];
        let shapes = pou.variables.iter().chain(&program.globals).map(|variable| Rc::new(variable.shape.clone()));
        for (i, shape) in shapes.enumerate() {
            let mut cell = std::mem::replace(&mut self.memory[i], Cell::One(0));
            self.tick(&mut cell, &shape);
            self.memory[i] = cell;
        }
        for (i, variable) in pou.variables.iter().enumerate().filter(|(_, v)| v.section == Section::Temp) {
            self.memory[i] = self.cell(&variable.shape, &variable.initial);
        }
        let variables = pou.variables.iter().enumerate().map(|(i, variable)| Some(self.own(i, variable.section)));
        let frame = Frame { pou, variables: variables.collect() };
        self.body(&frame)
    }

    fn own(&self, position: usize, section: Section) -> Location {
        let variable = match section {
            Section::External(global) => self.globals + global,
            _ => position,
        };
        Location { variable, way: Vec::new() }
    }

    /// The running clocks of timers advance.
    fn tick(&self, cell: &mut Cell, shape: &Shape) {
        let (Cell::Parts(cells), shape) = (cell, shape) else { return };
        match shape {
            Shape::Scalar(_) => {}
            Shape::Array { of, .. } => cells.iter_mut().for_each(|cell| self.tick(cell, of)),
            Shape::Structure(structure) => {
                cells.iter_mut().zip(&structure.members).for_each(|(cell, member)| self.tick(cell, &member.shape));
            }
            Shape::Instance(id) => {
                let pou = &self.program.pous[id];
                let find = |name: &str| pou.variables.iter().position(|variable| variable.name == name);
                if let (true, Some(clock), Some(running)) = (pou.is_library, find("CLOCK"), find("RUNNING")) {
                    let number = |position: usize| Type::TIME.number(one(&cells[position]));
                    let preset = find("PT").map_or(0, number);
                    if one(&cells[running]) == 1 && (!self.clocks_stop || number(clock) < preset) {
                        cells[clock] = Cell::One(Type::TIME.pattern(number(clock) + self.scan_time));
                    }
                    return;
                }
                cells.iter_mut().zip(&pou.variables).for_each(|(cell, inner)| self.tick(cell, &inner.shape));
            }
        }
    }

    fn body(&mut self, frame: &Frame<'p>) -> Done {
        let mut at = 0;
        while let Some(statement) = frame.pou.body.get(at) {
            at += 1;
            match &statement.action {
                Action::Jump(condition, target) if self.is(*condition) => at = *target,
                Action::Return(condition) if self.is(*condition) => return Ok(()),
                Action::Jump(..) | Action::Return(_) => self.step()?,
                _ => self.statement(frame, statement)?,
            }
            self.step()?;
        }
        Ok(())
    }

    fn step(&mut self) -> Done {
        self.steps = self.steps.checked_sub(1).ok_or(TooLong)?;
        Ok(())
    }

    fn is(&self, condition: Condition) -> bool {
        match condition {
            Condition::Always => true,
            Condition::IfTrue => self.result & 1 == 1,
            Condition::IfFalse => self.result & 1 == 0,
        }
    }

    fn statement(&mut self, frame: &Frame<'p>, statement: &'p Statement) -> Done {
        let ty = |id: &TypeId| frame.pou.types[id.0];
        match &statement.action {
            Action::Load { ty: id, negated, operand } => {
                self.result = complement(ty(id), *negated, self.operand(frame, operand));
            }
            Action::Store { ty: id, negated, place } => self.store(frame, ty(id), *negated, place),
            Action::Set(place) | Action::Reset(place) => {
                let location = self.location(frame, place);
                if self.result & 1 == 1 {
                    let sets = matches!(statement.action, Action::Set(_));
                    *self.cell_at(&location) = Cell::One(u64::from(sets));
                }
            }
            Action::Complement(id) => self.result = complement(ty(id), true, self.result),
            Action::Combine { function, ty: id, negated, operand } => {
                let right = complement(ty(id), *negated, self.operand(frame, operand));
                self.result = self.compute(*function, ty(id), self.result, right);
            }
            Action::Defer { function, ty: id, negated, body, .. } => {
                let left = self.result;
                self.sequence(frame, body)?;
                let right = complement(ty(id), *negated, self.result);
                self.result = self.compute(*function, ty(id), left, right);
            }
            Action::Call(call) => self.call(frame, call)?,
            Action::Standard(standard) => self.standard(frame, standard)?,
            Action::Jump(..) | Action::Return(_) => {}
        }
        Ok(())
    }

    fn sequence(&mut self, frame: &Frame<'p>, body: &'p [Statement]) -> Done {
        body.iter().try_for_each(|statement| self.statement(frame, statement))
    }
}

fn one(cell: &Cell) -> u64 {
    match cell {
        Cell::One(pattern) => *pattern,
        Cell::Parts(_) => panic!("this is more than one value"),
    }
}

fn complement(ty: Type, negated: bool, value: u64) -> u64 {
    if negated { !value & ty.mask() } else { value & ty.mask() }
}

/// Whether an instance keeps a variable from call to call.
fn stays(section: Section) -> bool {
    matches!(section, Section::Input | Section::Output | Section::Local | Section::Constant)
}

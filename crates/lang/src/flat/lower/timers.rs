//! Clocks of timers, which advance from scan to scan whether or not their timer is called.

use super::Lowering;
use crate::flat::narrow::Timer;
use crate::flat::{Function, Instruction, Operand, Target};
use crate::semantics::{CLOCK, Condition, Kind, PouId, RUNNING, Section, Shape, Type, VarId, elements};
use petril_base::source::Span;

impl Lowering<'_> {
    /// Emits the lines that advance each running clock by the scan time at the beginning of every scan, until it has
    /// reached the greatest preset time it can be given; where that is not known, its present one. Returns whether
    /// there are timers.
    pub fn ticks(&mut self) -> bool {
        let entry = self.pou(self.program.entry);
        let mut first = 0;
        let mut timers = Vec::new();
        for variable in &entry.variables {
            if matches!(variable.section, Section::External(_) | Section::InOut | Section::Temp) {
                continue;
            }
            self.find(&variable.shape, first, variable.span, &mut timers);
            first += self.layouts.size(&variable.shape);
        }
        for variable in &self.program.globals {
            self.find(&variable.shape, first, variable.span, &mut timers);
            first += self.layouts.size(&variable.shape);
        }
        for (timer, running, span) in &mut timers {
            timer.line = self.tick(*timer, *running, *span);
        }
        self.timers = timers.iter().map(|(timer, ..)| *timer).collect();
        !timers.is_empty()
    }

    fn find(&mut self, shape: &Shape, first: usize, span: Span, timers: &mut Vec<(Timer, VarId, Span)>) {
        match shape {
            Shape::Scalar(_) => {}
            Shape::Array { ranges, of } => {
                let size = self.layouts.size(of);
                (0..elements(ranges)).for_each(|i| self.find(of, first + i * size, span, timers));
            }
            Shape::Structure(structure) => {
                for (i, member) in structure.members.iter().enumerate() {
                    let offset = self.layouts.offset(shape, i);
                    self.find(&member.shape, first + offset, span, timers);
                }
            }
            Shape::Instance(id) => self.find_in_instance(*id, first, span, timers),
        }
    }

    fn find_in_instance(&mut self, id: PouId, first: usize, span: Span, timers: &mut Vec<(Timer, VarId, Span)>) {
        let pou = self.pou(id);
        let shape = Shape::Instance(id);
        let mut at = |name: &str| {
            let position = pou.variables.iter().position(|variable| variable.name == name)?;
            Some(VarId(first + self.layouts.offset(&shape, position)))
        };
        if let (true, Some(clock), Some(preset), Some(running)) = (pou.is_library, at(CLOCK), at("PT"), at(RUNNING)) {
            timers.push((Timer { clock, preset, step: self.scan_time, line: 0 }, running, span));
            return;
        }
        for (i, variable) in pou.variables.iter().enumerate() {
            if super::layout::is_kept(variable.section) {
                let offset = self.layouts.offset(&shape, i);
                let span = if pou.is_library { span } else { variable.span };
                self.find(&variable.shape, first + offset, span, timers);
            }
        }
    }

    /// Emits the lines that advance one clock; returns the line that compares it with its preset time.
    fn tick(&mut self, timer: Timer, running: VarId, span: Span) -> usize {
        let stands = self.label();
        self.load_variable(Type::BOOL, running, span);
        self.jump(Condition::IfFalse, stands, span);
        self.load_variable(Type::TIME, timer.clock, span);
        let operand = Operand::Place(Target::Variable(timer.preset));
        let line = self.code.len();
        self.emit(Instruction::Combine { function: Function::Ge, ty: Type::TIME, negated: false, operand }, span);
        self.jump(Condition::IfTrue, stands, span);
        self.load_variable(Type::TIME, timer.clock, span);
        // A clock below its preset time cannot overflow, so it is counted as bits.
        let ty = Type::new(Kind::Bits, Type::TIME.width);
        let operand = Operand::Constant(timer.step);
        self.emit(Instruction::Combine { function: Function::Add, ty, negated: false, operand }, span);
        self.store(Type::TIME, timer.clock, span);
        self.place_label(stands);
        line
    }
}

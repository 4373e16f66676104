//! Lowering of statements that are one instruction, and of parentheses.

use super::{Frame, Label, Lowering};
use crate::flat::{Function, Hazard, Instruction, Operand, Target};
use crate::semantics::{Action, Place, Scalar, Statement, Type, TypeId};
use petril_base::source::Span;

impl<'p> Lowering<'p> {
    /// Lowers the instruction list of a unit.
    pub fn body(&mut self, frame: &Frame<'p>) {
        let starts: Vec<Label> = (0..=frame.pou.body.len()).map(|_| self.label()).collect();
        for (statement, &start) in frame.pou.body.iter().zip(&starts) {
            self.place_label(start);
            self.statement(frame, statement, frame.depth, &starts);
        }
        self.place_label(starts[frame.pou.body.len()]);
    }

    /// Lowers the statements inside a parenthesis or an argument.
    pub fn sequence(&mut self, frame: &Frame<'p>, body: &[Statement], depth: usize) {
        body.iter().for_each(|statement| self.statement(frame, statement, depth, &[]));
    }

    fn statement(&mut self, frame: &Frame<'p>, statement: &Statement, depth: usize, starts: &[Label]) {
        let span = frame.span.unwrap_or(statement.span);
        let ty = |id: &TypeId| frame.pou.types[id.0];
        match &statement.action {
            Action::Load { ty: id, negated, operand } => {
                let operand = self.operand(frame, operand, None, span);
                self.emit(Instruction::Load { ty: ty(id), negated: *negated, operand }, span);
                self.release_address(operand);
            }
            Action::Store { ty: id, negated, place } => self.store_in(frame, ty(id), *negated, place, span),
            Action::Set(place) | Action::Reset(place) => {
                let target = self.address(frame, place, Some(Type::BOOL), span).target();
                let sets = matches!(statement.action, Action::Set(_));
                self.emit(if sets { Instruction::Set(target) } else { Instruction::Reset(target) }, span);
                self.release_address(Operand::Place(target));
            }
            Action::Complement(id) => self.emit(Instruction::Complement(ty(id)), span),
            Action::Combine { function, ty: id, negated, operand } => {
                let operand = self.operand(frame, operand, Some(ty(id)), span);
                let (function, ty) = (*function, ty(id));
                self.emit(Instruction::Combine { function, ty, negated: *negated, operand }, span);
                self.release_address(operand);
            }
            Action::Defer { function, ty: id, negated, body, close } => {
                let close = frame.span.unwrap_or(*close);
                self.defer(frame, (*function, ty(id), *negated), body, depth, (span, close));
            }
            Action::Jump(condition, target) => {
                if let Some(&label) = starts.get(*target) {
                    self.jump(*condition, label, span);
                }
            }
            Action::Return(condition) => self.jump(*condition, frame.exit, span),
            Action::Call(call) => self.call(frame, call, depth, span),
            Action::Standard(standard) => self.standard(frame, standard, depth, span),
        }
    }

    /// Stores the current result, after a check of the place's subrange.
    pub fn store_in(&mut self, frame: &Frame<'p>, ty: Type, negated: bool, place: &Place, span: Span) {
        self.bound(&place.scalar(), span);
        let target = self.address(frame, place, Some(ty), span).target();
        self.emit(Instruction::Store { ty, negated, target }, span);
        self.release_address(Operand::Place(target));
    }

    /// Checks the current result against a subrange.
    pub fn bound(&mut self, scalar: &Scalar, span: Span) {
        if let (Some((lower, upper)), None) = (scalar.range, &scalar.enumeration) {
            self.emit(Instruction::Bound { ty: scalar.ty, lower, upper, hazard: Hazard::Subrange }, span);
        }
    }

    fn defer(
        &mut self,
        frame: &Frame<'p>,
        (function, ty, negated): (Function, Type, bool),
        body: &[Statement],
        depth: usize,
        (span, close): (Span, Span),
    ) {
        let (left, right) = self.parenthesis_buffers(ty, depth);
        self.store(ty, left, span);
        self.sequence(frame, body, depth + 1);
        self.store(ty, right, close);
        self.load_variable(ty, left, close);
        let operand = Operand::Place(Target::Variable(right));
        self.emit(Instruction::Combine { function, ty, negated, operand }, close);
    }
}

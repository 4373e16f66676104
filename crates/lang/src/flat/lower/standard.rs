//! Lowering of standard functions.

use super::calls::early;
use super::{Frame, Lowering};
use crate::flat::{Function, Hazard, Instruction, Operand, Target};
use crate::semantics::{Condition, Feed, FeedSource, Standard, StandardFunction, Type, VarId};
use petril_base::source::Span;

/// Argument that can be read more than once.
#[derive(Clone, Copy)]
struct Argument {
    ty: Type,
    operand: Operand,
}

impl<'p> Lowering<'p> {
    pub fn standard(&mut self, frame: &Frame<'p>, standard: &Standard, depth: usize, span: Span) {
        let ty = frame.pou.types[standard.ty.0];
        let (skip, done) = (self.label(), self.label());
        self.enabled(frame, &standard.enable, (skip, depth), span);
        let Some(first) = standard.arguments.first() else { return };
        let first_ty = frame.pou.types[first.ty.0];
        let early = early(standard.arguments.iter());
        let ready: Vec<VarId> = standard.arguments[..early].iter().map(|feed| self.ready(frame, feed, depth)).collect();
        // The current result must not change once the first argument is in it.
        let kept = matches!(first.source, FeedSource::Result).then_some(first_ty);
        let rest = standard.arguments.iter().enumerate().skip(1);
        let rest: Vec<Argument> =
            rest.map(|(position, feed)| self.argument(frame, feed, ready.get(position).copied(), kept)).collect();
        match ready.first() {
            Some(&buffer) => self.load_variable(first_ty, buffer, span),
            None => self.load_feed(frame, first, depth),
        }
        self.apply(standard.function, first_ty, ty, &rest, span);
        for argument in rest {
            self.release_address(argument.operand);
        }
        ready.into_iter().for_each(|buffer| self.release(buffer));
        if standard.enable.eno.is_some() {
            let value = self.acquire(ty, ty.width);
            self.store(ty, value, span);
            self.eno(frame, &standard.enable, true, span);
            self.load_variable(ty, value, span);
            self.release(value);
        }
        if standard.enable.en.is_some() {
            self.jump(Condition::Always, done, span);
            self.place_label(skip);
            self.eno(frame, &standard.enable, false, span);
            self.load(ty, Operand::Constant(0), span);
            self.place_label(done);
        }
    }

    /// Argument that is in a buffer already, or an operand.
    fn argument(&mut self, frame: &Frame<'p>, feed: &Feed, ready: Option<VarId>, kept: Option<Type>) -> Argument {
        let ty = frame.pou.types[feed.ty.0];
        let operand = match (ready, &feed.source) {
            (None, FeedSource::Operand(operand)) => self.operand(frame, operand, kept, frame.span.unwrap_or(feed.span)),
            (Some(buffer), _) => Operand::Place(Target::Variable(buffer)),
            // The current result is the first argument, and a list is in a buffer.
            (None, FeedSource::Result | FeedSource::List(_)) => Operand::Constant(0),
        };
        Argument { ty, operand }
    }

    /// Applies the function to the current result and the other arguments.
    fn apply(&mut self, function: StandardFunction, from: Type, ty: Type, rest: &[Argument], span: Span) {
        match function {
            StandardFunction::Move => {}
            StandardFunction::Convert if from == ty => {}
            StandardFunction::Convert => self.emit(Instruction::Convert { from, to: ty }, span),
            StandardFunction::Not => self.emit(Instruction::Complement(ty), span),
            StandardFunction::Abs => self.absolute(ty, span),
            StandardFunction::Min => rest.iter().for_each(|other| self.replace_if(Function::Gt, ty, *other, span)),
            StandardFunction::Max => rest.iter().for_each(|other| self.replace_if(Function::Lt, ty, *other, span)),
            StandardFunction::Limit => {
                // LIMIT(MN, IN, MX) = MIN(MAX(MN, IN), MX)
                if let [value, upper] = rest {
                    self.replace_if(Function::Lt, ty, *value, span);
                    self.replace_if(Function::Gt, ty, *upper, span);
                }
            }
            StandardFunction::Sel => self.select(ty, rest, span),
            StandardFunction::Mux => self.choose(from, ty, rest, span),
            StandardFunction::Fold(function) => {
                rest.iter().for_each(|other| self.function(function, from, *other, span));
            }
            StandardFunction::Chain(function) => self.chain(function, from, rest, span),
        }
    }

    fn function(&mut self, function: Function, ty: Type, other: Argument, span: Span) {
        self.emit(Instruction::Combine { function, ty, negated: false, operand: other.operand }, span);
    }

    fn absolute(&mut self, ty: Type, span: Span) {
        if !ty.is_signed() {
            return;
        }
        let (positive, done) = (self.label(), self.label());
        let value = self.acquire(ty, ty.width);
        let argument = Argument { ty, operand: Operand::Place(Target::Variable(value)) };
        self.store(ty, value, span);
        self.function(Function::Lt, ty, Argument { ty, operand: Operand::Constant(0) }, span);
        self.jump(Condition::IfFalse, positive, span);
        self.load(ty, Operand::Constant(0), span);
        self.function(Function::Sub, ty, argument, span);
        self.jump(Condition::Always, done, span);
        self.place_label(positive);
        self.load_variable(ty, value, span);
        self.place_label(done);
        self.release(value);
    }

    /// Replaces the current result by the other value if the comparison of the two holds.
    fn replace_if(&mut self, comparison: Function, ty: Type, other: Argument, span: Span) {
        let (keep, done) = (self.label(), self.label());
        let value = self.acquire(ty, ty.width);
        self.store(ty, value, span);
        self.function(comparison, ty, other, span);
        self.jump(Condition::IfFalse, keep, span);
        self.load(other.ty, other.operand, span);
        self.jump(Condition::Always, done, span);
        self.place_label(keep);
        self.load_variable(ty, value, span);
        self.place_label(done);
        self.release(value);
    }

    /// `SEL`: the current result selects one of two values.
    fn select(&mut self, ty: Type, rest: &[Argument], span: Span) {
        let [zero, one] = rest else { return };
        let (second, done) = (self.label(), self.label());
        self.jump(Condition::IfTrue, second, span);
        self.load(ty, zero.operand, span);
        self.jump(Condition::Always, done, span);
        self.place_label(second);
        self.load(ty, one.operand, span);
        self.place_label(done);
    }

    /// `MUX`: the current result is the number of the selected value, from 0.
    fn choose(&mut self, number: Type, ty: Type, rest: &[Argument], span: Span) {
        let done = self.label();
        let upper = rest.len() as i128 - 1;
        self.emit(Instruction::Bound { ty: number, lower: 0, upper, hazard: Hazard::Index }, span);
        let chosen = self.acquire(number, number.width);
        self.store(number, chosen, span);
        for (i, value) in rest.iter().enumerate() {
            let next = self.label();
            if i + 1 < rest.len() {
                self.load_variable(number, chosen, span);
                let operand = Operand::Constant(i as u64);
                self.function(Function::Eq, number, Argument { ty: number, operand }, span);
                self.jump(Condition::IfFalse, next, span);
            }
            self.load(ty, value.operand, span);
            if i + 1 < rest.len() {
                self.jump(Condition::Always, done, span);
            }
            self.place_label(next);
        }
        self.place_label(done);
        self.release(chosen);
    }

    /// `GT(a, b, c)`: a > b and b > c.
    fn chain(&mut self, function: Function, ty: Type, rest: &[Argument], span: Span) {
        let Some((first, others)) = rest.split_first() else { return };
        self.function(function, ty, *first, span);
        if others.is_empty() {
            return;
        }
        let so_far = self.acquire(Type::BOOL, 1);
        for pair in rest.windows(2) {
            self.store(Type::BOOL, so_far, span);
            self.load(ty, pair[0].operand, span);
            self.function(function, ty, pair[1], span);
            let operand = Operand::Place(Target::Variable(so_far));
            self.function(Function::And, Type::BOOL, Argument { ty: Type::BOOL, operand }, span);
        }
        self.release(so_far);
    }
}

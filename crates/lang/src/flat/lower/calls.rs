//! Inlining of calls.

use std::collections::BTreeMap;

use super::layout::{Leaf, direct, is_kept};
use super::places::Address;
use super::{Frame, Label, Lowering};
use crate::flat::{Instruction, Operand, Target};
use crate::semantics::{
    Call, Callee, Condition, Enable, Feed, FeedSource, Place, Pou, PouId, PouKind, Role, Scalar, Section, Shape, Type,
    VarId,
};
use petril_base::source::Span;

impl<'p> Lowering<'p> {
    pub fn call(&mut self, frame: &Frame<'p>, call: &Call, depth: usize, span: Span) {
        let (skip, done) = (self.label(), self.label());
        match call.condition {
            Condition::Always => {}
            Condition::IfTrue => self.jump(Condition::IfFalse, done, span),
            Condition::IfFalse => self.jump(Condition::IfTrue, done, span),
        }
        let (id, mut variables) = match &call.callee {
            Callee::Instance(id, place) => (*id, self.instance(frame, *id, place, span)),
            Callee::Function(id) => (*id, self.own_variables(*id)),
        };
        let pou = self.pou(id);
        let result = pou.variables.iter().position(|variable| variable.section == Section::Result);
        let callee_span = if pou.is_library { Some(span) } else { frame.span };
        let is_function = pou.kind == PouKind::Function;
        self.enabled(frame, &call.enable, (skip, depth), span);
        if let Some((input, ty)) = call.result_to {
            let ty = frame.pou.types[ty.0];
            self.hand_over(&pou.variables[input].shape, variables[input], ty, span);
        }
        self.inputs(frame, call, pou, &variables, depth);
        let mut held = Vec::new();
        for (position, place) in &call.in_outs {
            let address = self.address(frame, place, None, span);
            held.extend(self.hold(address));
            variables[*position] = Some(address);
        }
        let exit = self.label();
        let inner = Frame { pou, variables, depth, exit, span: callee_span };
        for (position, variable) in pou.variables.iter().enumerate() {
            let is_given = call.inputs.iter().any(|(given, _)| *given == position);
            let anew = match variable.section {
                Section::Temp => true,
                Section::Local | Section::Output | Section::Result | Section::Constant => is_function,
                Section::Input => is_function && !is_given,
                Section::InOut | Section::External(_) => false,
            };
            if anew {
                self.initialise(&inner, position, callee_span.unwrap_or(span));
            }
        }
        self.body(&inner);
        self.place_label(exit);
        let (before, after) = call.outputs.split_at(call.before_eno);
        self.outputs(frame, &inner, before, span);
        self.eno(frame, &call.enable, true, span);
        self.outputs(frame, &inner, after, span);
        held.into_iter().for_each(|index| self.let_go(index));
        if call.enable.en.is_some() {
            let executed = self.label();
            self.jump(Condition::Always, executed, span);
            self.place_label(skip);
            if is_function {
                result.into_iter().for_each(|position| self.initialise(&inner, position, span));
            }
            self.eno(frame, &call.enable, false, span);
            self.place_label(executed);
        }
        if let (Some(position), true) = (result, is_function)
            && let (Some(scalar), Some(from)) = (pou.variables[position].shape.scalar(), inner.variables[position])
        {
            self.load(scalar.ty, Operand::Place(from.target()), span);
        }
        self.place_label(done);
    }

    /// Stores the inputs, from left to right.
    fn inputs(&mut self, frame: &Frame<'p>, call: &Call, pou: &Pou, variables: &[Option<Address>], depth: usize) {
        // All calls of a function share its variables, and a list may contain one; an instance has its own.
        let early = if pou.kind == PouKind::Function { early(call.inputs.iter().map(|(_, feed)| feed)) } else { 0 };
        let ready: Vec<VarId> = call.inputs[..early].iter().map(|(_, feed)| self.ready(frame, feed, depth)).collect();
        for (position, (input, feed)) in call.inputs.iter().enumerate() {
            let ty = frame.pou.types[feed.ty.0];
            match ready.get(position) {
                Some(&buffer) => self.load_variable(ty, buffer, feed.span),
                None => self.load_feed(frame, feed, depth),
            }
            self.hand_over(&pou.variables[*input].shape, variables[*input], ty, feed.span);
        }
        ready.into_iter().for_each(|buffer| self.release(buffer));
    }

    /// Stores outputs of the called unit in variables of the caller.
    fn outputs(&mut self, frame: &Frame<'p>, inner: &Frame<'p>, outputs: &[(usize, bool, Place)], span: Span) {
        for (output, negated, place) in outputs {
            let Some(scalar) = inner.pou.variables[*output].shape.scalar() else { continue };
            let Some(from) = inner.variables[*output] else { continue };
            self.load(scalar.ty, Operand::Place(from.target()), span);
            self.store_in(frame, scalar.ty, *negated, place, span);
        }
    }

    /// Computes a value into a buffer.
    pub fn ready(&mut self, frame: &Frame<'p>, feed: &Feed, depth: usize) -> VarId {
        let ty = frame.pou.types[feed.ty.0];
        self.load_feed(frame, feed, depth);
        let buffer = self.acquire(ty, ty.width);
        self.store(ty, buffer, frame.span.unwrap_or(feed.span));
        buffer
    }

    /// Loads a value into the current result.
    pub fn load_feed(&mut self, frame: &Frame<'p>, feed: &Feed, depth: usize) {
        let ty = frame.pou.types[feed.ty.0];
        let span = frame.span.unwrap_or(feed.span);
        match &feed.source {
            FeedSource::Result => {}
            FeedSource::Operand(operand) => {
                let operand: Operand = self.operand(frame, operand, None, span);
                self.load(ty, operand, span);
                self.release_address(operand);
            }
            FeedSource::List(list) => self.sequence(frame, list, depth + 1),
        }
    }

    /// `EN`: jumps to `skip` if the call is not to be executed.
    pub fn enabled(&mut self, frame: &Frame<'p>, enable: &Enable, (skip, depth): (Label, usize), span: Span) {
        if let Some(en) = &enable.en {
            self.load_feed(frame, en, depth);
            self.jump(Condition::IfFalse, skip, span);
        }
    }

    /// `ENO`: stores whether the call was executed.
    pub fn eno(&mut self, frame: &Frame<'p>, enable: &Enable, executed: bool, span: Span) {
        if let Some((negated, place)) = &enable.eno {
            self.load(Type::BOOL, Operand::Constant(u64::from(executed)), span);
            self.store_in(frame, Type::BOOL, *negated, place, span);
        }
    }

    /// Stores the current result in an input.
    fn hand_over(&mut self, shape: &Shape, address: Option<Address>, ty: Type, span: Span) {
        let (Some(scalar), Some(address)) = (shape.scalar(), address) else { return };
        self.bound(scalar, span);
        self.emit(Instruction::Store { ty, negated: false, target: address.target() }, span);
    }

    /// Addresses of the variables of an instance: its own, and the buffers of those that are initialised at each call.
    fn instance(&mut self, frame: &Frame<'p>, id: PouId, place: &Place, span: Span) -> Vec<Option<Address>> {
        let base = direct(self.address(frame, place, None, span)).0;
        let mut variables = self.own_variables(id);
        for (position, variable) in self.pou(id).variables.iter().enumerate() {
            if is_kept(variable.section) {
                let offset = self.layouts.offset(&Shape::Instance(id), position);
                variables[position] = Some(Address::Direct(base + offset));
            }
        }
        variables
    }

    /// Buffers of a unit: all variables of a function, the temporary ones of a function block. Recursion is excluded,
    /// so all calls share them.
    fn own_variables(&mut self, id: PouId) -> Vec<Option<Address>> {
        if let Some(known) = self.buffers.units.get(&id) {
            return known.clone();
        }
        let pou = self.pou(id);
        let is_function = pou.kind == PouKind::Function;
        let mut variables = Vec::new();
        for variable in &pou.variables {
            let is_buffer = match variable.section {
                Section::Temp => true,
                Section::InOut | Section::External(_) => false,
                _ => is_function,
            };
            variables.push(is_buffer.then(|| {
                let name = match variable.section {
                    Section::Result => pou.name.clone(),
                    _ => format!("{}.{}", pou.name, variable.name),
                };
                let name = self.unused(&name);
                let leaf = Leaf { name, role: Role::Buffer, span: variable.span };
                self.variables_of(&leaf, &variable.shape, &variable.initial)
            }));
        }
        self.buffers.units.insert(id, variables.clone());
        variables
    }

    /// Sets a variable to its initial value.
    pub fn initialise(&mut self, frame: &Frame<'p>, position: usize, span: Span) {
        let variable = &frame.pou.variables[position];
        let Some(first) = frame.variables[position].map(|address| direct(address).0) else { return };
        let mut alike: BTreeMap<(Type, u64), Vec<usize>> = BTreeMap::new();
        let values: Vec<(Scalar, u64)> = self.values(&variable.shape, &variable.initial);
        for (offset, (scalar, pattern)) in values.into_iter().enumerate() {
            alike.entry((scalar.ty, pattern)).or_default().push(first + offset);
        }
        for ((ty, pattern), variables) in alike {
            self.load(ty, Operand::Constant(pattern), span);
            for variable in variables {
                self.emit(Instruction::Store { ty, negated: false, target: Target::Variable(VarId(variable)) }, span);
            }
        }
    }
}

/// Number of arguments up to the last list. These are computed before any of them is used, from left to right: a list
/// may call a unit that writes the variables named before it.
pub fn early<'f>(arguments: impl Iterator<Item = &'f Feed>) -> usize {
    let last = arguments.enumerate().filter(|(_, feed)| matches!(feed.source, FeedSource::List(_))).last();
    last.map_or(0, |(position, _)| position + 1)
}

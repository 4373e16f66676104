//! Calls of units and of standard functions.

use petril::flat::Hazard;
use petril::semantics::{
    Call, Callee, Enable, Feed, FeedSource, PouId, PouKind, Scalar, Section, Standard, StandardFunction, Type,
};

use super::{Cell, Done, Frame, Location, Reference, TooLong, complement, stays};

impl<'p> Reference<'p> {
    /// A call that is not enabled does nothing but write FALSE to `ENO`; the value of a function is then what it begins with.
    /// Else inputs get their values from left to right, the body is executed, and outputs are written in the order of the text,
    /// `ENO` among them.
    pub(super) fn call(&mut self, frame: &Frame<'p>, call: &'p Call) -> Done {
        if !self.is(call.condition) {
            return Ok(());
        }
        let program = self.program;
        let (Callee::Instance(id, _) | Callee::Function(id)) = &call.callee;
        let base = match &call.callee {
            Callee::Instance(_, place) => Some(self.location(frame, place)),
            Callee::Function(_) => None,
        };
        let given = self.result;
        let is_enabled = self.enabled(frame, &call.enable)?;
        let memory = self.memory.len();
        let pou = &program.pous[id];
        let mut inner = Frame { pou, variables: self.variables(*id, base.as_ref()) };
        if is_enabled {
            if let Some((input, _)) = call.result_to {
                self.hand_over(&inner, input, given);
            }
            for (input, feed) in &call.inputs {
                let value = self.value_of(frame, feed, given)?;
                self.hand_over(&inner, *input, value);
            }
            for (position, place) in &call.in_outs {
                inner.variables[*position] = Some(self.location(frame, place));
            }
            self.body(&inner)?;
        }
        for (position, (output, negated, place)) in call.outputs.iter().enumerate().filter(|_| is_enabled) {
            if position == call.before_eno {
                self.eno(frame, &call.enable, is_enabled);
            }
            self.result = self.variable(&inner, *output);
            let ty = pou.variables[*output].shape.scalar().map_or(Type::BOOL, |scalar| scalar.ty);
            self.store(frame, ty, *negated, place);
        }
        if call.before_eno == call.outputs.len() || !is_enabled {
            self.eno(frame, &call.enable, is_enabled);
        }
        self.take_result(&inner);
        self.memory.truncate(memory);
        Ok(())
    }

    /// What a function returns becomes the current result.
    fn take_result(&mut self, frame: &Frame<'p>) {
        let is_result = |variable: &petril::semantics::Variable| variable.section == Section::Result;
        if frame.pou.kind == PouKind::Function
            && let Some(position) = frame.pou.variables.iter().position(is_result)
        {
            self.result = self.variable(frame, position);
        }
    }

    /// Where the variables of a unit are: in its instance, or new ones.
    fn variables(&mut self, id: PouId, base: Option<&Location>) -> Vec<Option<Location>> {
        let program = self.program;
        let mut variables = Vec::new();
        for (position, variable) in program.pous[&id].variables.iter().enumerate() {
            variables.push(match (variable.section, base) {
                (Section::InOut, _) => None,
                (Section::External(_), _) => Some(self.own(position, variable.section)),
                (section, Some(base)) if stays(section) => {
                    let way = base.way.iter().copied().chain([position]).collect();
                    Some(Location { variable: base.variable, way })
                }
                _ => {
                    self.memory.push(self.cell(&variable.shape, &variable.initial));
                    Some(Location { variable: self.memory.len() - 1, way: Vec::new() })
                }
            });
        }
        variables
    }

    /// What an argument is worth now.
    fn value_of(&mut self, frame: &Frame<'p>, feed: &'p Feed, given: u64) -> Result<u64, TooLong> {
        Ok(match &feed.source {
            FeedSource::Result => given,
            FeedSource::Operand(operand) => self.operand(frame, operand),
            FeedSource::List(list) => {
                self.sequence(frame, list)?;
                self.result
            }
        })
    }

    fn enabled(&mut self, frame: &Frame<'p>, enable: &'p Enable) -> Result<bool, TooLong> {
        let Some(en) = &enable.en else { return Ok(true) };
        Ok(self.value_of(frame, en, 0)? & 1 == 1)
    }

    fn eno(&mut self, frame: &Frame<'p>, enable: &'p Enable, executed: bool) {
        if let Some((negated, place)) = &enable.eno {
            self.result = u64::from(executed);
            self.store(frame, Type::BOOL, *negated, place);
        }
    }

    fn hand_over(&mut self, frame: &Frame<'p>, position: usize, value: u64) {
        let scalar = frame.pou.variables[position].shape.scalar().cloned();
        self.bound(&scalar.unwrap_or_else(|| Scalar::new(Type::BOOL)), value);
        if let Some(location) = &frame.variables[position] {
            *self.cell_at(location) = Cell::One(value);
        }
    }

    pub(super) fn standard(&mut self, frame: &Frame<'p>, standard: &'p Standard) -> Done {
        let given = self.result;
        let is_enabled = self.enabled(frame, &standard.enable)?;
        let value = if is_enabled { self.apply(frame, standard, given)? } else { 0 };
        self.eno(frame, &standard.enable, is_enabled);
        self.result = value;
        Ok(())
    }

    /// The value of a standard function.
    fn apply(&mut self, frame: &Frame<'p>, standard: &'p Standard, given: u64) -> Result<u64, TooLong> {
        let ty = |feed: &Feed| frame.pou.types[feed.ty.0];
        let arguments = standard.arguments.iter();
        let values: Vec<u64> = arguments.map(|feed| self.value_of(frame, feed, given)).collect::<Result<_, _>>()?;
        let from = ty(&standard.arguments[0]);
        let to = frame.pou.types[standard.ty.0];
        Ok(match standard.function {
            StandardFunction::Convert => self.convert(from, to, values[0]),
            StandardFunction::Move => values[0],
            StandardFunction::Not => complement(to, true, values[0]),
            StandardFunction::Abs => self.fit(to, to.number(values[0]).abs()),
            StandardFunction::Min => values.into_iter().min_by_key(|&value| to.number(value)).unwrap_or(0),
            StandardFunction::Max => values.into_iter().max_by_key(|&value| to.number(value)).unwrap_or(0),
            StandardFunction::Limit => {
                let [least, value, greatest] = [0, 1, 2].map(|i| to.number(values[i]));
                to.pattern(least.max(value).min(greatest))
            }
            StandardFunction::Sel => values[if values[0] & 1 == 1 { 2 } else { 1 }],
            StandardFunction::Mux => {
                let number = usize::try_from(from.number(values[0])).ok().filter(|&k| k + 1 < values.len());
                self.note(number.is_none().then_some(Hazard::Index));
                values[number.unwrap_or(0) + 1]
            }
            StandardFunction::Fold(function) => {
                let (first, rest) = (values[0], &values[1..]);
                rest.iter().fold(first, |left, &right| self.compute(function, from, left, right))
            }
            StandardFunction::Chain(function) => {
                let pairs: Vec<(u64, u64)> = values.windows(2).map(|pair| (pair[0], pair[1])).collect();
                let all = pairs.into_iter().map(|(left, right)| self.compute(function, from, left, right));
                u64::from(all.fold(true, |so_far, holds| so_far & (holds == 1)))
            }
        })
    }
}

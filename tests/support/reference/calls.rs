//! Calls of units and of standard functions.

use petril::flat::Hazard;
use petril::semantics::{
    Call, Callee, Enable, Feed, FeedSource, PouId, PouKind, Scalar, Section, Standard, StandardFunction, Type,
};

use super::{Cell, Done, Frame, Location, Reference, TooLong, complement, stays};

impl<'p> Reference<'p> {
    pub(super) fn call(&mut self, frame: &Frame<'p>, call: &'p Call) -> Done {
        if !self.is(call.condition) {
            return Ok(());
        }
        let given = self.result;
        let program = self.program;
        let (Callee::Instance(id, _) | Callee::Function(id)) = &call.callee;
        let pou = &program.pous[id];
        let base = match &call.callee {
            Callee::Instance(_, place) => Some(self.location(frame, place)),
            Callee::Function(_) => None,
        };
        // Lists are computed before anything is handed over, that of `EN` first.
        let en = self.list(frame, call.enable.en.as_ref())?;
        let lists = call.inputs.iter().map(|(_, feed)| self.list(frame, Some(feed)));
        let lists: Vec<Option<u64>> = lists.collect::<Result<_, _>>()?;
        let inner = Frame { pou, variables: self.variables(*id, base.as_ref()) };
        let executed = self.enable(frame, &call.enable, en)?;
        if executed {
            if let Some((input, _)) = call.result_to {
                self.hand_over(&inner, input, given);
            }
            for ((input, feed), list) in call.inputs.iter().zip(lists) {
                let value = match (list, &feed.source) {
                    (Some(value), _) => value,
                    (None, FeedSource::Operand(operand)) => self.operand(frame, operand),
                    (None, _) => given,
                };
                self.hand_over(&inner, *input, value);
            }
            let mut variables = inner.variables;
            for (position, place) in &call.in_outs {
                variables[*position] = Some(self.location(frame, place));
            }
            let inner = Frame { pou, variables };
            self.body(&inner)?;
            for (output, negated, place) in &call.outputs {
                self.result = self.variable(&inner, *output);
                let ty = pou.variables[*output].shape.scalar().map_or(Type::BOOL, |scalar| scalar.ty);
                self.store(frame, ty, *negated, place);
            }
            self.take_result(&inner);
        } else if let Some((input, _)) = call.result_to {
            panic!("an input operator has no EN, but gives {input}");
        } else {
            self.take_result(&inner);
        }
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

    fn list(&mut self, frame: &Frame<'p>, feed: Option<&'p Feed>) -> Result<Option<u64>, TooLong> {
        let Some(Feed { source: FeedSource::List(list), .. }) = feed else { return Ok(None) };
        self.sequence(frame, list)?;
        Ok(Some(self.result))
    }

    /// Whether a call is executed; `ENO` gets it.
    fn enable(&mut self, frame: &Frame<'p>, enable: &'p Enable, list: Option<u64>) -> Result<bool, TooLong> {
        let enabled = match (list, enable.en.as_ref().map(|feed| &feed.source)) {
            (Some(value), _) => value,
            (None, Some(FeedSource::Operand(operand))) => self.operand(frame, operand),
            (None, Some(FeedSource::List(list))) => {
                self.sequence(frame, list)?;
                self.result
            }
            (None, _) => 1,
        };
        if let Some((negated, place)) = &enable.eno {
            self.result = enabled;
            self.store(frame, Type::BOOL, *negated, place);
        }
        Ok(enabled & 1 == 1)
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
        if !self.enable(frame, &standard.enable, None)? {
            self.result = 0;
            return Ok(());
        }
        let ty = |feed: &Feed| frame.pou.types[feed.ty.0];
        // The first argument comes last.
        let mut values = vec![0; standard.arguments.len()];
        let order = (1..values.len()).chain([0]);
        for position in order {
            values[position] = match &standard.arguments[position].source {
                FeedSource::Result => given,
                FeedSource::Operand(operand) => self.operand(frame, operand),
                FeedSource::List(list) => {
                    self.sequence(frame, list)?;
                    self.result
                }
            };
        }
        let from = ty(&standard.arguments[0]);
        let to = frame.pou.types[standard.ty.0];
        self.result = match standard.function {
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
        };
        Ok(())
    }
}

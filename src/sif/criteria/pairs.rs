//! Every two inputs have all values together that they can have.
//!
//! Where all valuations are known, a small set of them is a cover. Where they are too many, tests are built one after the other,
//! input by input, each taking the value that makes more new pairs. After Cohen, Dalal, Fredman and Patton, "The AETG system: an
//! approach to testing based on combinatorial design" (1997); restrictions are kept by a solver.

use fixedbitset::FixedBitSet;

use super::super::cone::{Encoded, inputs_of};
use super::super::faults::Model;
use super::super::solver::{Answer, Literal};
use super::all::Choice;
use super::cover::cover;
use super::limits::{Limits, Questions};
use super::pool::Pool;
use crate::simulate::Lots;

/// Most bits for a table of pairs and valuations.
const MAX_BITS: usize = 1 << 28;

/// How many tests are built before the best is taken.
const CANDIDATES: usize = 6;

/// Tests in which any two inputs have all values that they can have.
pub fn pairs(model: &Model<'_>, pool: &Pool, limits: &Limits) -> Choice {
    let inputs = model.cone.inputs.len();
    if pool.is_all && inputs * inputs * 2 * pool.tests.len() <= MAX_BITS {
        covered(model, pool, limits)
    } else {
        built(model, limits)
    }
}

/// Of all valuations.
fn covered(model: &Model<'_>, pool: &Pool, limits: &Limits) -> Choice {
    let inputs = &model.cone.inputs;
    let mut columns: Vec<[FixedBitSet; 2]> = Vec::new();
    for input in inputs {
        let mut ones = FixedBitSet::with_capacity(pool.tests.len());
        (0..pool.tests.len()).filter(|test| pool.tests[*test].contains(input.0)).for_each(|test| ones.insert(test));
        let mut zeros = ones.clone();
        zeros.toggle_range(..);
        columns.push([zeros, ones]);
    }
    let mut rows = Vec::new();
    for (at, a) in columns.iter().enumerate() {
        // A single input has two values, with nothing beside it.
        if columns.len() == 1 {
            rows.extend(a.iter().cloned());
        }
        for b in &columns[at + 1..] {
            for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(x, y)| (&a[x], &b[y])) {
                let mut row = a.clone();
                row.intersect_with(b);
                rows.push(row);
            }
        }
    }
    let impossible = rows.iter().filter(|row| row.is_clear()).count();
    let found = cover(&rows, pool.tests.len(), &limits.stop);
    Choice {
        tests: found.chosen.into_iter().map(|test| pool.tests[test].clone()).collect(),
        is_smallest: found.is_smallest,
        notes: note(rows.len(), impossible),
        ..Choice::default()
    }
}

fn note(all: usize, impossible: usize) -> Vec<String> {
    let cannot = if impossible > 0 { format!(", of which {impossible} cannot be") } else { String::new() };
    vec![format!("{all} pairs of values{cannot}")]
}

/// Which pairs of values have not been seen yet.
struct Open {
    inputs: usize,
    open: FixedBitSet,
}

impl Open {
    fn new(inputs: usize) -> Self {
        let mut open = FixedBitSet::with_capacity(inputs * inputs * 4);
        for a in 0..inputs {
            for b in (0..inputs).filter(|b| a != *b) {
                open.insert_range((a * inputs + b) * 4..(a * inputs + b) * 4 + 4);
            }
        }
        Self { inputs, open }
    }

    fn at(&self, (a, x): (usize, bool), (b, y): (usize, bool)) -> usize {
        (a * self.inputs + b) * 4 + 2 * usize::from(x) + usize::from(y)
    }

    fn is_open(&self, a: (usize, bool), b: (usize, bool)) -> bool {
        self.open.contains(self.at(a, b))
    }

    /// Both ways round.
    fn close(&mut self, a: (usize, bool), b: (usize, bool)) {
        let places = [self.at(a, b), self.at(b, a)];
        places.into_iter().for_each(|place| self.open.set(place, false));
    }

    /// The first pair that is open, from a place on.
    fn next(&self, from: usize) -> Option<(usize, (usize, bool), (usize, bool))> {
        let mut place = from;
        while place < self.open.len() {
            if self.open.contains(place) {
                let (pair, values) = (place / 4, place % 4);
                return Some((place, (pair / self.inputs, values & 2 != 0), (pair % self.inputs, values & 1 != 0)));
            }
            place += 1;
        }
        None
    }

    /// How many open pairs a value makes with values that are set.
    fn gain(&self, value: (usize, bool), set: &[(usize, bool)]) -> usize {
        set.iter().filter(|other| self.is_open(value, **other)).count()
    }
}

/// One after the other.
fn built(model: &Model<'_>, limits: &Limits) -> Choice {
    let inputs = &model.cone.inputs;
    let mut builder = Builder::new(model, limits);
    let mut open = Open::new(inputs.len());
    let (mut impossible, mut undecided) = (0, 0);
    let mut found: Vec<Vec<(usize, bool)>> = Vec::new();
    let mut from = 0;
    while let Some((place, a, b)) = open.next(from) {
        from = place;
        if (limits.stop)() || found.len() >= limits.tests {
            undecided += open.open.count_ones(..) / 2;
            break;
        }
        let mut best: Option<(usize, Vec<(usize, bool)>)> = None;
        let mut answer = Answer::Satisfiable;
        for _ in 0..CANDIDATES {
            match builder.build(a, b, &open) {
                Ok(test) => {
                    let gain = (0..test.len()).map(|at| open.gain(test[at], &test[..at])).sum();
                    if best.as_ref().is_none_or(|(most, _)| gain > *most) {
                        best = Some((gain, test));
                    }
                }
                Err(other) => {
                    answer = other;
                    break;
                }
            }
        }
        match best {
            Some((_, test)) => {
                for at in 0..test.len() {
                    (0..at).for_each(|other| open.close(test[at], test[other]));
                }
                found.push(test);
            }
            None => {
                open.close(a, b);
                if answer == Answer::Unsatisfiable { impossible += 1 } else { undecided += 1 }
            }
        }
    }
    let all = inputs.len() * inputs.len().saturating_sub(1) * 2;
    let valuation = |test: &Vec<(usize, bool)>| {
        model.specification.valuation(test.iter().filter(|(_, value)| *value).map(|(at, _)| inputs[*at]))
    };
    Choice {
        tests: found.iter().map(valuation).collect(),
        notes: note(all, impossible),
        incomplete: (undecided > 0).then(|| format!("{undecided} pairs of values were not decided within the limits")),
        ..Choice::default()
    }
}

/// Makes tests input by input.
struct Builder<'m> {
    model: &'m Model<'m>,
    questions: Questions,
    encoded: Encoded,
    /// For each input that varies, whether a restriction speaks of it.
    is_bound: Vec<bool>,
    lots: Lots,
}

impl<'m> Builder<'m> {
    fn new(model: &'m Model<'m>, limits: &Limits) -> Self {
        let mut questions = Questions::new(limits);
        let encoded = model.cone.encode(&mut questions.solver);
        let mut bound = FixedBitSet::with_capacity(model.specification.signals.len());
        for (restriction, literal) in model.cone.restrictions.iter().zip(&encoded.restrictions) {
            questions.solver.require([*literal]);
            let of = inputs_of(model.specification, &restriction.allowed);
            of.into_iter().for_each(|input| bound.insert(input.0));
        }
        let is_bound = model.cone.inputs.iter().map(|input| bound.contains(input.0)).collect();
        Self { model, questions, encoded, is_bound, lots: Lots::new(3) }
    }

    fn literal(&self, (at, value): (usize, bool)) -> Literal {
        let literal = self.encoded.literals[self.model.cone.inputs[at].0];
        if value { literal } else { !literal }
    }

    /// A test with these two values.
    fn build(&mut self, a: (usize, bool), b: (usize, bool), open: &Open) -> Result<Vec<(usize, bool)>, Answer> {
        let inputs = self.is_bound.len();
        let mut test = vec![a, b];
        let mut assumed: Vec<Literal> = Vec::new();
        assumed.extend([a, b].into_iter().filter(|(at, _)| self.is_bound[*at]).map(|value| self.literal(value)));
        match self.questions.ask(&assumed) {
            Answer::Satisfiable => {}
            other => return Err(other),
        }
        let mut model = self.model_found();
        let mut order: Vec<usize> = (0..inputs).filter(|at| *at != a.0 && *at != b.0).collect();
        for at in 1..order.len() {
            order.swap(at, self.lots.below(at as u128 + 1) as usize);
        }
        for at in order {
            let (no, yes) = (open.gain((at, false), &test), open.gain((at, true), &test));
            let mut value = if no == yes { self.lots.below(2) == 1 } else { yes > no };
            if self.is_bound[at] {
                // What is possible already need not be asked.
                if no == yes {
                    value = model[at];
                }
                assumed.push(self.literal((at, value)));
                if model[at] != value {
                    if self.questions.ask(&assumed) == Answer::Satisfiable {
                        model = self.model_found();
                    } else {
                        value = !value;
                        assumed.pop();
                        assumed.push(self.literal((at, value)));
                    }
                }
            }
            test.push((at, value));
        }
        Ok(test)
    }

    fn model_found(&self) -> Vec<bool> {
        let inputs = self.model.cone.inputs.iter();
        inputs.map(|input| self.questions.solver.value(self.encoded.literals[input.0])).collect()
    }
}

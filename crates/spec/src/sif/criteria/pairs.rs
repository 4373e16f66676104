//! Pairwise testing: any two inputs take all value combinations that are allowed.
//!
//! If all valuations are known, a small set is found as a set cover. If they are too many, tests are built one by one,
//! input by input, each taking the value that makes more new pairs. After Cohen, Dalal, Fredman and Patton, "The AETG
//! system: an approach to testing based on combinatorial design" (1997); a solver keeps the restrictions.

use fixedbitset::FixedBitSet;

use super::super::cone::{Cone, inputs_of};
use super::super::faults::Model;
use super::super::formula::SignalId;
use super::super::solver::{Answer, Literal};
use super::all::Choice;
use super::cover::cover;
use super::limits::{Limits, Questions};
use super::pool::Pool;
use petril_check::simulate::Lots;

/// Upper bound on the bits of a table of pairs and valuations.
const MAX_BITS: usize = 1 << 28;

/// Number of candidate tests of which the best is taken.
const CANDIDATES: usize = 6;

/// Generates tests that cover all allowed pairs of values.
pub fn pairs(model: &Model<'_>, pool: &Pool, limits: &Limits) -> Choice {
    let inputs = model.cone.inputs.len();
    if pool.is_all && inputs * inputs * 2 * pool.tests.len() <= MAX_BITS {
        covered(model, pool, limits)
    } else {
        built(model, limits)
    }
}

/// Covers the pairs by a selection of all valuations.
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
        // A single input has two values and no partner.
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

/// Value of an input, given by its position among the varied ones.
type Value = (usize, bool);

/// Pairs of values not covered yet.
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

    fn at(&self, (a, x): Value, (b, y): Value) -> usize {
        (a * self.inputs + b) * 4 + 2 * usize::from(x) + usize::from(y)
    }

    fn is_open(&self, a: Value, b: Value) -> bool {
        self.open.contains(self.at(a, b))
    }

    /// Marks a pair as covered, in both orders.
    fn close(&mut self, a: Value, b: Value) {
        let places = [self.at(a, b), self.at(b, a)];
        places.into_iter().for_each(|place| self.open.set(place, false));
    }

    /// First uncovered pair from an index on.
    fn next(&self, from: usize) -> Option<(usize, Value, Value)> {
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

    /// Number of uncovered pairs that a value forms with values already set.
    fn gain(&self, value: Value, set: &[Value]) -> usize {
        set.iter().filter(|other| self.is_open(value, **other)).count()
    }
}

/// Builds tests one by one.
fn built(model: &Model<'_>, limits: &Limits) -> Choice {
    let inputs = &model.cone.inputs;
    let mut builder = Builder::new(model, limits);
    let mut open = Open::new(inputs.len());
    let (mut impossible, mut undecided) = (0, 0);
    let mut found: Vec<Vec<Value>> = Vec::new();
    let mut from = 0;
    while let Some((place, a, b)) = open.next(from) {
        from = place;
        if (limits.stop)() || found.len() >= limits.tests {
            undecided += open.open.count_ones(..) / 2;
            break;
        }
        let mut best: Option<(usize, Vec<Value>)> = None;
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
    let valuation = |test: &Vec<Value>| {
        model.specification.valuation(test.iter().filter(|(_, value)| *value).map(|(at, _)| inputs[*at]))
    };
    Choice {
        tests: found.iter().map(valuation).collect(),
        notes: note(all, impossible),
        incomplete: (undecided > 0).then(|| format!("{undecided} pairs of values were not decided within the limits")),
        ..Choice::default()
    }
}

/// Builder of tests, input by input.
struct Builder {
    parts: Vec<Part>,
    /// Group of each varied input that occurs in a restriction.
    of: Vec<Option<usize>>,
    lots: Lots,
}

/// Inputs that are related by restrictions, with a solver of their own.
struct Part {
    questions: Questions,
    /// Varied inputs of the group, by position, with their literals.
    literals: Vec<(usize, Literal)>,
    assumed: Vec<Literal>,
    /// Values compatible with those already set.
    model: Vec<Value>,
}

impl Part {
    fn new(model: &Model<'_>, input: SignalId, limits: &Limits) -> Self {
        let cone = Cone::of(model.specification, &[input], model.cone.restrictions.clone());
        let mut questions = Questions::new(limits);
        let encoded = cone.encode(&mut questions.solver);
        encoded.restrictions.iter().for_each(|restriction| questions.solver.require([*restriction]));
        let inside = model.specification.valuation(cone.all_inputs());
        let varied = model.cone.inputs.iter().enumerate().filter(|(_, input)| inside.contains(input.0));
        let literals = varied.map(|(at, input)| (at, encoded.literals[input.0])).collect();
        Self { questions, literals, assumed: Vec::new(), model: Vec::new() }
    }

    fn literal(&self, (at, value): Value) -> Option<Literal> {
        let (_, literal) = self.literals.iter().find(|(other, _)| *other == at)?;
        Some(if value { *literal } else { !*literal })
    }

    fn holds(&self, value: Value) -> bool {
        self.model.contains(&value)
    }

    fn ask(&mut self) -> Answer {
        let answer = self.questions.ask(&self.assumed);
        if answer == Answer::Satisfiable {
            let value = |(at, literal): &(usize, Literal)| (*at, self.questions.solver.value(*literal));
            self.model = self.literals.iter().map(value).collect();
        }
        answer
    }
}

impl Builder {
    fn new(model: &Model<'_>, limits: &Limits) -> Self {
        let mut bound = FixedBitSet::with_capacity(model.specification.signals.len());
        for restriction in &model.cone.restrictions {
            let of = inputs_of(model.specification, &restriction.allowed);
            of.into_iter().for_each(|input| bound.insert(input.0));
        }
        let mut parts: Vec<Part> = Vec::new();
        let mut of = vec![None; model.cone.inputs.len()];
        for (at, input) in model.cone.inputs.iter().enumerate() {
            if bound.contains(input.0) && of[at].is_none() {
                let part = Part::new(model, *input, limits);
                part.literals.iter().for_each(|(inside, _)| of[*inside] = Some(parts.len()));
                parts.push(part);
            }
        }
        Self { parts, of, lots: Lots::new(3) }
    }

    /// Builds a test with these two values.
    fn build(&mut self, a: Value, b: Value, open: &Open) -> Result<Vec<Value>, Answer> {
        for part in &mut self.parts {
            let wanted = [a, b].into_iter().filter_map(|value| part.literal(value)).collect();
            part.assumed = wanted;
            match part.ask() {
                Answer::Satisfiable => {}
                other => return Err(other),
            }
        }
        let mut test = vec![a, b];
        let mut order: Vec<usize> = (0..self.of.len()).filter(|at| *at != a.0 && *at != b.0).collect();
        for at in 1..order.len() {
            order.swap(at, self.lots.below(at as u128 + 1) as usize);
        }
        for at in order {
            let (no, yes) = (open.gain((at, false), &test), open.gain((at, true), &test));
            let wish = if no == yes { self.lots.below(2) == 1 } else { yes > no };
            let value = match self.of[at] {
                None => wish,
                Some(part) => self.parts[part].take(at, wish, no == yes),
            };
            test.push((at, value));
        }
        Ok(test)
    }
}

impl Part {
    /// Sets an input as wished if possible; if the wish does not matter, as in the model.
    fn take(&mut self, at: usize, wish: bool, is_indifferent: bool) -> bool {
        let is_so = self.holds((at, wish));
        let wished = self.literal((at, wish));
        self.assumed.extend(wished);
        if is_so || (!is_indifferent && self.ask() == Answer::Satisfiable) {
            return wish;
        }
        self.assumed.pop();
        let other = self.literal((at, !wish));
        self.assumed.extend(other);
        !wish
    }
}

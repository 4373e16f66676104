//! Modified condition/decision coverage (MC/DC): each condition is shown to decide the outcome, both as TRUE and as
//! FALSE.
//!
//! A *condition* is a literal where it stands, a *decision* an equation. A test shows a condition if an output of the function
//! would change with it (its Boolean difference is 1). Two tests that show it and in which it and the outcome differ are a pair:
//! by *unique cause* if all other names of the equation are the same in both, else by *masking*. Unique cause is taken wherever
//! there is such a pair. A name that stands in an equation twice is flipped in both places then, but only the place that is
//! shown counts. After Chilenski and Miller, "Applicability of modified condition/decision coverage to software testing"
//! (1994), and Chilenski, "An investigation of three forms of the modified condition decision coverage (MCDC) criterion" (2001).

use std::collections::HashMap;

use fixedbitset::FixedBitSet;
use rustc_hash::FxBuildHasher;

use super::super::cone::Encoded;
use super::super::faults::{Model, View, What, named};
use super::super::solver::{Answer, Literal};
use super::super::specification::Restriction;
use super::all::Choice;
use super::limits::{Limits, Questions};
use super::pairing::{Pairing, select};
use super::pool::Pool;

/// Form of MC/DC by which a condition is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    UniqueCause,
    Masking,
}

/// Selects tests for each condition that can decide.
pub fn mcdc(model: &Model<'_>, pool: &Pool, limits: &Limits) -> Choice {
    let is_literal = |node: &usize| matches!(model.nodes[*node].what, What::Literal(_));
    let conditions: Vec<usize> = (0..model.nodes.len()).filter(is_literal).collect();
    let mut tests = pool.tests.clone();
    let mut facts = Facts::of(model, &tests);
    let mut twins = None;
    let mut choice = Choice::default();
    let mut shown = Vec::new();
    let mut undecided = 0;
    for &node in &conditions {
        if (limits.stop)() {
            undecided += 1;
            continue;
        }
        let found = [Kind::UniqueCause, Kind::Masking].into_iter().find_map(|kind| {
            if facts.pairing(model, node, kind).is_possible() {
                return Some(Ok(kind));
            }
            if pool.is_all {
                return None;
            }
            let twins = twins.get_or_insert_with(|| Twins::new(model, limits));
            match twins.pair(node, kind) {
                Found::Pair(pair) => {
                    tests.extend(*pair);
                    facts.add(model, &tests);
                    Some(Ok(kind))
                }
                Found::None(_) => None,
                Found::Stopped => Some(Err(())),
            }
        });
        match found {
            Some(Ok(kind)) => shown.push((node, kind)),
            Some(Err(())) => undecided += 1,
            None => {
                let twins = twins.get_or_insert_with(|| Twins::new(model, limits));
                let because = match twins.pair(node, Kind::Masking) {
                    Found::None(restrictions) if restrictions.is_empty() => "whatever the inputs are".to_owned(),
                    Found::None(restrictions) => format!("because of {}", restrictions.join(", ")),
                    _ => "under the restrictions".to_owned(),
                };
                choice.notes.push(format!("{} never decides, {because}", named(model, node)));
            }
        }
    }
    if undecided > 0 {
        choice.incomplete =
            Some(format!("of {undecided} conditions it was not decided within the limits how to show them"));
    }
    let count = |kind| shown.iter().filter(|(_, of)| *of == kind).count();
    let (unique, masked) = (count(Kind::UniqueCause), count(Kind::Masking));
    let masked = if masked > 0 { format!(", {masked} by masking only") } else { String::new() };
    choice.notes.insert(0, format!("of {} conditions, {unique} are shown by unique cause{masked}", conditions.len()));

    let pairings: Vec<Pairing> = shown.iter().map(|(node, kind)| facts.pairing(model, *node, *kind)).collect();
    let chosen = select(&pairings, tests.len());
    choice.purposes = vec![Vec::new(); chosen.len()];
    for ((node, kind), pairing) in shown.iter().zip(&pairings) {
        let Some(pair) = pairing.pair_in(&chosen) else { continue };
        let others = if *kind == Kind::Masking { ", by masking" } else { "" };
        for (test, value) in pair.into_iter().zip(["FALSE", "TRUE"]) {
            let text = format!("{} decides, being {value}{others}", named(model, *node));
            let at = chosen.iter().position(|other| *other == test);
            at.into_iter().for_each(|at| choice.purposes[at].push(text.clone()));
        }
    }
    choice.tests = chosen.into_iter().map(|test| tests[test].clone()).collect();
    choice
}

/// Values of all nodes in each test.
struct Facts {
    count: usize,
    views: Vec<View<u64>>,
}

impl Facts {
    fn of(model: &Model<'_>, tests: &[FixedBitSet]) -> Self {
        let views = tests.chunks(64).map(|batch| View::of(model, batch)).collect();
        Self { count: tests.len(), views }
    }

    /// Adds the tests that are new since the last call.
    fn add(&mut self, model: &Model<'_>, tests: &[FixedBitSet]) {
        let full = self.count / 64;
        self.views.truncate(full);
        self.views.extend(tests[full * 64..].chunks(64).map(|batch| View::of(model, batch)));
        self.count = tests.len();
    }

    /// Pairs of tests for a condition.
    fn pairing(&self, model: &Model<'_>, node: usize, kind: Kind) -> Pairing {
        let equation = &model.equations[model.nodes[node].equation];
        let What::Literal(own) = model.nodes[node].what else { return Pairing::default() };
        let formula = model.specification.definition(equation.signal);
        let names = formula.map(super::super::formula::Formula::signals).unwrap_or_default();
        let others: Vec<usize> = names.iter().filter(|name| **name != own).map(|name| name.0).collect();
        let mut groups: HashMap<Vec<u64>, usize, FxBuildHasher> = HashMap::default();
        let mut pairing = Pairing::default();
        for test in 0..self.count {
            let (view, bit) = (&self.views[test / 64], test % 64);
            let has = |word: u64| word >> bit & 1 == 1;
            if !has(view.observed[node]) {
                continue;
            }
            let (value, outcome) = (has(view.values[node]), has(view.values[equation.root]));
            // Tests of the same group on different sides form a pair.
            let key: Vec<u64> = match kind {
                // The outcomes must differ, too: a name that occurs twice may cancel its own effect.
                Kind::UniqueCause => {
                    let mut key = vec![0; others.len().div_ceil(64) + 1];
                    key[0] = u64::from(value != outcome);
                    for (at, name) in others.iter().enumerate() {
                        key[1 + at / 64] |= u64::from(has(view.signals[*name])) << (at % 64);
                    }
                    key
                }
                Kind::Masking => vec![u64::from(value != outcome)],
            };
            let next = groups.len();
            let group = *groups.entry(key).or_insert(next);
            pairing.put(test, group, value);
        }
        pairing.settle();
        pairing
    }
}

/// Two copies of a function in one solver.
struct Twins<'m> {
    model: &'m Model<'m>,
    questions: Questions,
    copies: [(Encoded, View<Literal>); 2],
}

/// Result of a search for a pair.
enum Found {
    /// Valuations of the varied inputs: with the condition FALSE, and TRUE.
    Pair(Box<[FixedBitSet; 2]>),
    /// No pair exists, because of these restrictions.
    None(Vec<String>),
    /// The limits did not suffice.
    Stopped,
}

impl<'m> Twins<'m> {
    fn new(model: &'m Model<'m>, limits: &Limits) -> Self {
        let mut questions = Questions::new(limits);
        let copies = [(); 2].map(|()| {
            let encoded = model.cone.encode(&mut questions.solver);
            let view = View::in_solver(&mut questions.solver, model, encoded.literals.clone());
            (encoded, view)
        });
        Self { model, questions, copies }
    }

    fn pair(&mut self, node: usize, kind: Kind) -> Found {
        let model = self.model;
        let equation = &model.equations[model.nodes[node].equation];
        let [(one, first), (two, second)] = &self.copies;
        let solver = &mut self.questions.solver;
        let mut assumed = vec![!first.values[node], second.values[node], first.observed[node], second.observed[node]];
        assumed.push(solver.xor(first.values[equation.root], second.values[equation.root]));
        if kind == Kind::UniqueCause {
            let formula = model.specification.definition(equation.signal);
            for name in formula.map(super::super::formula::Formula::signals).unwrap_or_default() {
                if !matches!(model.nodes[node].what, What::Literal(own) if own == name) {
                    assumed.push(!solver.xor(first.signals[name.0], second.signals[name.0]));
                }
            }
        }
        assumed.extend(one.restrictions.iter().chain(&two.restrictions));
        match self.questions.ask(&assumed) {
            Answer::Satisfiable => {
                let varied = model.specification.valuation(model.cone.inputs.iter().copied());
                let pair = [one, two].map(|encoded| {
                    let mut test = encoded.model(&model.cone, &self.questions.solver);
                    test.intersect_with(&varied);
                    test
                });
                Found::Pair(Box::new(pair))
            }
            Answer::Unsatisfiable => {
                let core = self.questions.solver.core(&assumed);
                let is_blamed = |(at, _): &(usize, &&Restriction)| {
                    core.contains(&one.restrictions[*at]) || core.contains(&two.restrictions[*at])
                };
                let blamed = model.cone.restrictions.iter().enumerate().filter(is_blamed);
                Found::None(blamed.map(|(_, restriction)| restriction.name.clone()).collect())
            }
            Answer::Stopped => Found::Stopped,
        }
    }
}

//! Data of one function shared by all criteria, computed once.

use fixedbitset::FixedBitSet;

use super::super::faults::{Fault, Model, described, faults};
use super::super::formula::SignalId;
use super::super::plan::{Coverage, Criterion, Plan, Test};
use super::super::specification::Specification;
use super::all::{Choice, all};
use super::allowed::Allowed;
use super::completion::Completion;
use super::cover::cover;
use super::coverage::coverage;
use super::limits::Limits;
use super::mcdc::mcdc;
use super::order::ordered;
use super::pairs::pairs;
use super::pool::{Pool, Sight};

/// Function with its faults and the valuations that show them.
pub struct Study<'s> {
    model: Model<'s>,
    limits: Limits,
    faults: Vec<Fault>,
    allowed: Option<Allowed>,
    pool: Pool,
    completion: Completion<'s>,
}

impl<'s> Study<'s> {
    /// Computes the data.
    #[must_use]
    pub fn new(specification: &'s Specification, function: usize, limits: &Limits) -> Self {
        let model = Model::new(specification, function);
        let faults = faults(&model);
        let allowed = Allowed::of(&model.cone, model.outputs(), limits, false);
        let completion = Completion::new(&model.cone, function, limits);
        let pool = if completion.contradicts() {
            Pool::empty(faults.len())
        } else {
            Pool::new(&model, &faults, allowed.as_ref(), limits)
        };
        Self { model, limits: limits.clone(), faults, allowed, pool, completion }
    }

    /// Generates the tests by a criterion.
    pub fn plan(&mut self, criterion: Criterion) -> Plan {
        if self.pool.is_all && self.pool.tests.is_empty() {
            let note = "no valuation can be: the restrictions contradict each other".to_owned();
            return self.finished(criterion, Choice { notes: vec![note], is_smallest: true, ..Choice::default() });
        }
        let choice = match criterion {
            Criterion::All => all(&self.model, self.allowed.as_ref(), true, &self.limits),
            Criterion::AllBoth => all(&self.model, self.allowed.as_ref(), false, &self.limits),
            Criterion::Mcdc => mcdc(&self.model, &self.pool, &self.limits),
            Criterion::Faults => self.killing(),
            Criterion::Pairs => pairs(&self.model, &self.pool, &self.limits),
        };
        self.finished(criterion, choice)
    }

    /// Mutation score of tests (sets of inputs that are TRUE).
    pub fn coverage(&mut self, tests: &[FixedBitSet]) -> Coverage {
        coverage(&self.model, &self.faults, &self.pool, &mut self.completion, tests)
    }

    /// Criterion `faults`: a small set of tests that shows every detectable fault.
    fn killing(&self) -> Choice {
        let found = cover(&self.pool.rows, self.pool.tests.len(), &self.limits.stop);
        let undecided = self.pool.sights.iter().filter(|sight| **sight == Sight::Undecided).count();
        let incomplete = (undecided > 0)
            .then(|| format!("of {undecided} faults it was not decided within the limits whether they can be seen"));
        let purposes = found.chosen.iter().map(|test| self.alone(*test, &found.chosen)).collect();
        Choice {
            purposes,
            tests: found.chosen.iter().map(|test| self.pool.tests[*test].clone()).collect(),
            is_smallest: found.is_smallest && self.pool.is_all,
            incomplete,
            ..Choice::default()
        }
    }

    /// Faults shown by only one of the chosen tests, in words.
    fn alone(&self, test: usize, chosen: &[usize]) -> Vec<String> {
        let shows =
            |row: &&FixedBitSet| row.contains(test) && chosen.iter().filter(|at| row.contains(**at)).count() == 1;
        let mut alone = self.faults.iter().zip(&self.pool.rows).filter(|(_, row)| shows(row)).map(|(fault, _)| fault);
        let Some(first) = alone.next() else { return Vec::new() };
        let more = match alone.count() {
            0 => String::new(),
            1 => ", and one fault more".to_owned(),
            more => format!(", and {more} faults more"),
        };
        vec![format!("alone finds {}: {}{more}", first.class.name(), described(&self.model, first))]
    }

    /// Completes and orders the tests, and measures them.
    fn finished(&mut self, criterion: Criterion, mut choice: Choice) -> Plan {
        let specification = self.model.specification;
        choice.purposes.resize(choice.tests.len(), Vec::new());
        let chosen = choice.tests.len();
        let mut tests = Vec::new();
        for (test, purpose) in choice.tests.iter().zip(choice.purposes) {
            if let Some(inputs) = self.completion.complete(test) {
                tests.push(Test { values: inputs, purpose });
            }
        }
        if tests.len() < chosen {
            let lost = format!("for {} tests the other inputs could not be set", chosen - tests.len());
            choice.incomplete = Some(choice.incomplete.map_or(lost.clone(), |reason| format!("{reason}; {lost}")));
        }
        let rest = specification.valuation(specification.inputs().filter(|input| specification.rest(*input)));
        let mut values: Vec<FixedBitSet> = tests.iter().map(|test| test.values.clone()).collect();
        let order = ordered(&values, &rest);
        specification.settle_all(&mut values);
        let test = |at: usize| Test {
            values: std::mem::take(&mut values[at]),
            purpose: std::mem::take(&mut tests[at].purpose),
        };
        let tests: Vec<Test> = order.into_iter().map(test).collect();
        let values: Vec<FixedBitSet> = tests.iter().map(|test| test.values.clone()).collect();
        // If the tests are too many to list, their mutation score is not known.
        let is_unlisted = tests.is_empty() && choice.incomplete.is_some();
        let coverage = if is_unlisted { Coverage::default() } else { self.coverage(&values) };
        Plan {
            function: self.model.function,
            criterion,
            varied: self.model.cone.inputs.clone(),
            touched: self.touched(),
            tests,
            incomplete: choice.incomplete,
            notes: choice.notes,
            is_smallest: choice.is_smallest,
            cubes: choice.cubes,
            coverage,
        }
    }

    /// Outputs that depend on the varied inputs, the function's own first.
    fn touched(&self) -> Vec<SignalId> {
        let specification = self.model.specification;
        let mut reached = specification.valuation(self.model.cone.inputs.iter().copied());
        for id in &specification.order {
            let mut uses = false;
            if let Some(formula) = specification.definition(*id) {
                formula.each_signal(&mut |signal| uses |= reached.contains(signal.0));
            }
            if uses {
                reached.insert(id.0);
            }
        }
        let own = self.model.outputs();
        let others = specification.outputs().filter(|output| !own.contains(output) && reached.contains(output.0));
        own.iter().copied().chain(others).collect()
    }
}

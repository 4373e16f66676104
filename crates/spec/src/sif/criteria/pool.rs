//! Pool of valuations to select tests from, with the faults each of them shows.

use fixedbitset::FixedBitSet;

use super::super::cone::Encoded;
use super::super::faults::{Fault, Model, View};
use super::super::solver::{Answer, Literal};
use super::allowed::Allowed;
use super::limits::{Limits, Questions};
use super::sample::sample;
use petril_check::simulate::Lots;

/// Upper bound on valuations for the pool to hold all of them.
const MAX_ALL: u64 = 1 << 14;

/// Upper bound on the bits of the table of valuations and faults.
const MAX_BITS: u64 = 1 << 30;

/// Number of random valuations tried before the solver is asked.
const BY_CHANCE: usize = 128;

/// Upper bound on later faults that a valuation from the solver is extended to show.
const MAX_PACKED: usize = 64;

/// Number of consecutive failures after which the extension ends.
const MAX_MISSES: usize = 8;

/// Pool of allowed valuations of the varied inputs.
pub struct Pool {
    /// Valuations.
    pub tests: Vec<FixedBitSet>,
    /// For each fault, the valuations that show it.
    pub rows: Vec<FixedBitSet>,
    /// Detectability of each fault.
    pub sights: Vec<Sight>,
    /// Whether the pool holds all allowed valuations.
    pub is_all: bool,
}

/// Detectability of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sight {
    /// A valuation of the pool shows the fault.
    Shown,
    /// The fault is equivalent: no allowed valuation shows it.
    Equivalent,
    /// The limits did not suffice to decide.
    Undecided,
}

impl Pool {
    /// Pool without allowed valuations, where no fault is detectable.
    pub fn empty(faults: usize) -> Self {
        let (rows, sights) = (vec![FixedBitSet::new(); faults], vec![Sight::Equivalent; faults]);
        Self { tests: Vec::new(), rows, sights, is_all: true }
    }

    /// Collects all allowed valuations if they are few, else some that show every detectable fault.
    pub fn new(model: &Model<'_>, faults: &[Fault], allowed: Option<&Allowed>, limits: &Limits) -> Self {
        let count = allowed.and_then(|sets| sets.diagrams.count_if_few(&sets.allowed));
        let is_few = |count: &u64| *count <= MAX_ALL && count.saturating_mul(faults.len() as u64) <= MAX_BITS;
        match allowed.filter(|_| count.as_ref().is_some_and(is_few)) {
            Some(sets) => {
                let tests: Vec<FixedBitSet> = sets.diagrams.valuations(&sets.allowed).collect();
                let rows = rows(model, faults, &tests);
                let sight = |row: &FixedBitSet| if row.is_clear() { Sight::Equivalent } else { Sight::Shown };
                let sights = rows.iter().map(sight).collect();
                Self { tests, rows, sights, is_all: true }
            }
            None => searched(model, faults, limits),
        }
    }
}

/// For each fault, the tests that show it.
pub fn rows(model: &Model<'_>, faults: &[Fault], tests: &[FixedBitSet]) -> Vec<FixedBitSet> {
    let mut words = vec![Vec::with_capacity(tests.len().div_ceil(64)); faults.len()];
    for batch in tests.chunks(64) {
        let view = View::of(model, batch);
        let used = u64::MAX >> (64 - batch.len());
        for (fault, words) in faults.iter().zip(&mut words) {
            words.push((view.kills(model, fault) & used) as usize);
        }
    }
    words.into_iter().map(|words| FixedBitSet::with_capacity_and_blocks(tests.len(), words)).collect()
}

/// Collects random valuations first, then one from the solver for each fault still open, with its neighbours.
fn searched(model: &Model<'_>, faults: &[Fault], limits: &Limits) -> Pool {
    let mut questions = Questions::new(limits);
    let encoded = model.cone.encode(&mut questions.solver);
    for restriction in &encoded.restrictions {
        questions.solver.require([*restriction]);
    }
    if questions.ask(&[]) == Answer::Unsatisfiable {
        return Pool::empty(faults.len());
    }
    let view = View::in_solver(&mut questions.solver, model, encoded.literals.clone());
    let mut sights = vec![Sight::Undecided; faults.len()];
    let mut tests = sample(model, &mut questions, &encoded, BY_CHANCE, limits);
    for batch in tests.chunks(64) {
        let view = View::of(model, batch);
        let used = u64::MAX >> (64 - batch.len());
        let open = faults.iter().zip(&mut sights).filter(|(_, sight)| **sight == Sight::Undecided);
        open.filter(|(fault, _)| view.kills(model, fault) & used != 0).for_each(|(_, sight)| *sight = Sight::Shown);
    }
    let mut lots = Lots::new(1);
    // A node that is never observed hides all its faults.
    let mut is_hidden: Vec<Option<bool>> = vec![None; model.nodes.len()];
    for at in 0..faults.len() {
        if sights[at] != Sight::Undecided {
            continue;
        }
        if (limits.stop)() {
            break;
        }
        let node = faults[at].node;
        let mut is_never = || questions.ask(&[view.observed[node]]) == Answer::Unsatisfiable;
        if *is_hidden[node].get_or_insert_with(&mut is_never) {
            sights[at] = Sight::Equivalent;
            continue;
        }
        let seen = view.kills(&mut questions.solver, model, &faults[at]);
        match questions.ask(&[seen]) {
            Answer::Unsatisfiable => sights[at] = Sight::Equivalent,
            Answer::Stopped => {}
            Answer::Satisfiable => {
                let found = encoded.model(&model.cone, &questions.solver);
                let open = (at + 1..faults.len()).filter(|other| sights[*other] == Sight::Undecided);
                let mut packed = Packed { model, questions: &mut questions, encoded: &encoded, view: &view, found };
                packed.pack(seen, open.map(|other| &faults[other]));
                let found = packed.found;
                let near = neighbours(model, &found, &mut lots);
                tests.extend(useful(model, faults, &mut sights, &near));
            }
        }
    }
    let varied = model.specification.valuation(model.cone.inputs.iter().copied());
    tests.iter_mut().for_each(|test| test.intersect_with(&varied));
    let rows = rows(model, faults, &tests);
    Pool { tests, rows, sights, is_all: false }
}

/// Valuation that is to show as many faults as possible.
struct Packed<'p, 'm> {
    model: &'p Model<'m>,
    questions: &'p mut Questions,
    encoded: &'p Encoded,
    view: &'p View<Literal>,
    found: FixedBitSet,
}

impl Packed<'_, '_> {
    /// Requires further faults to be shown, one by one, besides those shown already.
    fn pack<'f>(&mut self, seen: Literal, open: impl Iterator<Item = &'f Fault>) {
        let (mut assumed, mut misses) = (vec![seen], 0);
        let mut known = View::of(self.model, std::slice::from_ref(&self.found));
        for fault in open.take(MAX_PACKED) {
            // The solver tends to keep values, so a fault shown already needs no extra requirement.
            if known.kills(self.model, fault) & 1 == 1 {
                continue;
            }
            assumed.push(self.view.kills(&mut self.questions.solver, self.model, fault));
            if self.questions.ask(&assumed) == Answer::Satisfiable {
                self.found = self.encoded.model(&self.model.cone, &self.questions.solver);
                known = View::of(self.model, std::slice::from_ref(&self.found));
                misses = 0;
            } else {
                assumed.pop();
                misses += 1;
                if misses > MAX_MISSES {
                    return;
                }
            }
        }
    }
}

/// A valuation and some that differ from it in one input.
fn neighbours(model: &Model<'_>, valuation: &FixedBitSet, lots: &mut Lots) -> Vec<FixedBitSet> {
    let inputs = &model.cone.inputs;
    let mut near = vec![valuation.clone()];
    for position in 0..inputs.len().min(63) {
        let input = if inputs.len() <= 63 { inputs.get(position) } else { lots.one_of(inputs) };
        let mut other = valuation.clone();
        input.iter().for_each(|input| other.toggle(input.0));
        near.push(other);
    }
    near
}

/// Selects, of up to 64 valuations, allowed ones that show faults not shown before.
fn useful(model: &Model<'_>, faults: &[Fault], sights: &mut [Sight], near: &[FixedBitSet]) -> Vec<FixedBitSet> {
    let view = View::of(model, near);
    let can_be = model.cone.allows(&|signal| view.signals[signal.0]) & (u64::MAX >> (64 - near.len()));
    let mut taken = 0_u64;
    for (fault, sight) in faults.iter().zip(sights).filter(|(_, sight)| **sight == Sight::Undecided) {
        let kills = view.kills(model, fault) & can_be;
        if kills != 0 {
            *sight = Sight::Shown;
            if kills & taken == 0 {
                taken |= kills & kills.wrapping_neg();
            }
        }
    }
    (0..near.len()).filter(|bit| taken >> bit & 1 == 1).map(|bit| near[bit].clone()).collect()
}

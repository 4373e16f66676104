//! How much work may be done, and questions to a solver that end.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::super::solver::{Answer, Literal, Solver, Stop};

/// How much work may be done. What it does not suffice for is said in the plan.
#[derive(Clone)]
pub struct Limits {
    /// Whether the work is to end at once.
    pub stop: Stop,
    /// Most tests that are listed.
    pub tests: usize,
    /// Most nodes of a decision diagram.
    pub nodes: usize,
    /// Most decisions of a solver about one question.
    pub effort: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { stop: Arc::new(|| false), tests: 4096, nodes: 100_000, effort: 20_000 }
    }
}

/// A solver that gives every question the same effort.
pub struct Questions {
    /// The solver: clauses are told to it directly.
    pub solver: Solver,
    left: Arc<AtomicU64>,
    effort: u64,
}

impl Questions {
    /// A solver without clauses.
    #[must_use]
    pub fn new(limits: &Limits) -> Self {
        let left = Arc::new(AtomicU64::new(0));
        let (stop, fuel) = (Arc::clone(&limits.stop), Arc::clone(&left));
        let stop: Stop = Arc::new(move || {
            let before = fuel.load(Ordering::Relaxed);
            fuel.store(before.saturating_sub(1), Ordering::Relaxed);
            before == 0 || stop()
        });
        Self { solver: Solver::new(&stop), left, effort: limits.effort }
    }

    /// Looks for a model in which all of these are true.
    pub fn ask(&mut self, assumed: &[Literal]) -> Answer {
        // Assumptions are decisions, too.
        self.left.store(self.effort + 2 * assumed.len() as u64, Ordering::Relaxed);
        self.solver.solve(assumed)
    }

    /// A model in which all of `fixed` are true and as many of `wished` as can be, the first ones first: no more of them could be
    /// true beside those that are. Gives what the wishes came to.
    pub fn closest(&mut self, fixed: &[Literal], wished: &[Literal]) -> Option<Vec<bool>> {
        let mut assumed: Vec<Literal> = fixed.iter().chain(wished).copied().collect();
        match self.ask(&assumed) {
            Answer::Satisfiable => return Some(vec![true; wished.len()]),
            Answer::Unsatisfiable => assumed.truncate(fixed.len()),
            Answer::Stopped => return None,
        }
        let read = |questions: &Self| wished.iter().map(|wish| questions.solver.value(*wish)).collect::<Vec<bool>>();
        if self.ask(&assumed) != Answer::Satisfiable {
            return None;
        }
        let mut model = read(self);
        for (position, wish) in wished.iter().enumerate() {
            assumed.push(*wish);
            if model[position] {
                continue;
            }
            match self.ask(&assumed) {
                Answer::Satisfiable => model = read(self),
                Answer::Unsatisfiable => _ = assumed.pop(),
                Answer::Stopped => return None,
            }
        }
        Some(model)
    }
}

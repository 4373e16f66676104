//! Work limits, and a solver whose questions end.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::super::solver::{Answer, Literal, Solver, Stop};

/// Work limits. A plan reports what they did not suffice for.
#[derive(Clone)]
pub struct Limits {
    /// Whether to stop at once.
    pub stop: Stop,
    /// Upper bound on tests listed.
    pub tests: usize,
    /// Upper bound on nodes of a decision diagram.
    pub nodes: usize,
    /// Upper bound on decisions of a solver per question.
    pub effort: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { stop: Arc::new(|| false), tests: 4096, nodes: 100_000, effort: 20_000 }
    }
}

/// Solver with the same effort for every question.
pub struct Questions {
    /// Solver; clauses are added to it directly.
    pub solver: Solver,
    left: Arc<AtomicU64>,
    effort: u64,
}

impl Questions {
    /// Creates a solver without clauses.
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

    /// Searches for a model under assumptions.
    pub fn ask(&mut self, assumed: &[Literal]) -> Answer {
        // Assumptions count as decisions, too.
        self.left.store(self.effort + 2 * assumed.len() as u64, Ordering::Relaxed);
        self.solver.solve(assumed)
    }

    /// A model of `fixed` that satisfies a maximal set of `wished`, earlier wishes first: none of the others can be
    /// added. Returns which wishes hold.
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

//! Options of a check, and the report that they begin.

use super::assumptions::assumptions;
use super::{Exploration, Report};
use crate::requirement::{Assertion, Assumption, Demand};
use crate::translate::System;
use petril_lang::flat::Tolerated;
use petril_logic::{FairnessAssumption, Requirement, View};
use petril_search::{Budget, Graph};

/// Options of a check.
#[derive(Clone, Debug)]
pub struct Options {
    /// State space: one state per scan, or one per marking.
    pub view: View,
    /// Fairness assumptions, bound for the system and the view; only runs that meet all of them count.
    pub fairness: Vec<FairnessAssumption>,
    /// Limits of the exploration.
    pub budget: Budget,
    /// Hazards that are not errors. In the scan view, other hazards end the run.
    pub tolerated: Tolerated,
    /// Assumptions about the inputs of each scan (scan view only).
    pub assumptions: Vec<Assumption>,
    /// Assertions at lines of the program.
    pub assertions: Vec<Assertion>,
}

impl Default for Options {
    /// Scan view, no hazard tolerated, no assumptions, no fairness.
    fn default() -> Self {
        let (budget, tolerated) = (Budget::default(), Tolerated::default());
        let (assumptions, assertions, fairness) = (Vec::new(), Vec::new(), Vec::new());
        Self { view: View::Scan, fairness, budget, tolerated, assumptions, assertions }
    }
}

impl Options {
    /// Report without answers on a graph that was explored with these options; `left_out` says which states fairness leaves out.
    pub(super) fn report(
        &self,
        system: &System,
        requirements: &[(Requirement, Demand)],
        graph: &Graph,
        left_out: Option<String>,
    ) -> Report {
        // Depth counts steps; in the scan view the first scan is a step, too.
        let depth = graph.depth() + usize::from(self.view == View::Scan && !graph.is_empty());
        let timed = requirements.iter().any(|(requirement, _)| requirement.speaks_of_time())
            || self.fairness.iter().any(|assumed| assumed.speaks_of_time);
        Report {
            exploration: Exploration {
                view: self.view,
                states: graph.len(),
                steps: graph.steps(),
                depth,
                complete: graph.is_complete(),
                stop: graph.stop().clone(),
                bytes: graph.bytes(),
                recalled: false,
            },
            assumptions: assumptions(system, self, timed).into_iter().chain(left_out).collect(),
            warnings: Vec::new(),
            answers: Vec::new(),
            checks: Vec::new(),
            remarks: Vec::new(),
            coverage: None,
        }
    }
}

//! Diagnosis of a counterexample: expected value, last writers of the decisive variables, and inputs that matter.

mod candidates;
mod decisive;
mod error;
mod repair;
mod rerun;
mod wanted;

pub use error::of_error;

use std::collections::{BTreeMap, BTreeSet};

use super::views::SystemView;
use super::{Trace, Why, Witness, Writer};
use crate::scans::ScanSpace;
use crate::witness::{ScanTrace, last_writes};
use petril_lang::semantics::{Role, VarId};
use petril_logic::{Bound, Dag, Evidence, Labels, NodeId};
use petril_search::Graph;

/// A violated requirement with its counterexample.
#[derive(Clone, Copy)]
pub struct Broken<'a> {
    /// View; diagnosis needs the scan view.
    pub view: &'a dyn SystemView,
    /// State graph of the view.
    pub graph: &'a Graph,
    /// Requirement.
    pub formula: &'a Bound,
    /// DAG of the formula and its negation.
    pub dag: &'a Dag,
    /// Node of the negation.
    pub negation: NodeId,
    /// Satisfying states of each node.
    pub labels: &'a Labels,
    /// Counterexample in the graph.
    pub evidence: &'a Evidence,
}

/// Diagnoses a replayed counterexample; `None` in the transition view.
pub fn why(broken: Broken<'_>, witness: &Witness) -> Option<Why> {
    let (Trace::Scans(trace), Some(scans)) = (&witness.trace, broken.view.scans()) else { return None };
    let wanted = wanted::wanted(&broken);
    let (writers, unwritten) = writers(&scans.base().space, trace, &wanted.literals);
    let (repair, unrepaired) = match repair::repair(&broken, scans, trace) {
        Ok(repair) => (Some(repair), None),
        Err(reason) => (None, Some(reason)),
    };
    Some(Why { wanted: wanted.sentences, writers, unwritten, repair, unrepaired })
}

/// Last writers of the variables, each up to the scan in which its value counts; and the variables never written by
/// then.
fn writers(space: &ScanSpace<'_>, trace: &ScanTrace, literals: &[(usize, VarId)]) -> (Vec<Writer>, Vec<VarId>) {
    let program = &space.system().program;
    let (mut writers, mut unwritten) = (Vec::new(), Vec::new());
    let (mut seen, mut known) = (BTreeSet::new(), BTreeMap::new());
    for &(position, variable) in literals {
        if program.variable(variable).role == Role::Input || !seen.insert((position, variable)) {
            continue;
        }
        let last = known.entry(position).or_insert_with(|| last_writes(space.system(), trace, position));
        match last[variable.0] {
            Some(write) => writers.push(Writer { variable, value: write.value, scan: write.scan, line: write.line }),
            None => unwritten.push(variable),
        }
    }
    writers.dedup();
    unwritten.dedup();
    (writers, unwritten)
}

//! Why a run breaks a requirement: what was wanted, who wrote the values that break it, and which inputs matter.

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
use crate::explore::{Graph, ScanSpace};
use crate::logic::{Bound, Dag, Evidence, Labels, NodeId};
use crate::witness::{ScanTrace, last_writes};
use petril_lang::semantics::{Role, VarId};

/// A requirement that is broken, and the run that shows it.
#[derive(Clone, Copy)]
pub struct Broken<'a> {
    /// The view, which is that of scans.
    pub view: &'a dyn SystemView,
    /// Its graph.
    pub graph: &'a Graph,
    /// The requirement.
    pub formula: &'a Bound,
    /// Its formula and its negation.
    pub dag: &'a Dag,
    /// The negation.
    pub negation: NodeId,
    /// Which states satisfy which node.
    pub labels: &'a Labels,
    /// The run in the graph.
    pub evidence: &'a Evidence,
}

/// Why a run that has been replayed breaks a requirement; nothing in the transition view.
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

/// Who wrote the variables last, each until the scan in which its value counts; and those that nobody has written by then.
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

//! Reference model of a specification, scan by scan, with latches and delays.

use fixedbitset::FixedBitSet;

use crate::sif::{Kind, SignalId, Specification};

/// Reference model: the behaviour of a system that satisfies its specification, from power-on.
#[derive(Clone, Debug)]
pub(super) struct Model<'s> {
    specification: &'s Specification,
    /// Definitions in topological order: each after those it uses, reset conditions included.
    order: Vec<SignalId>,
    /// Scan cycle in milliseconds.
    cycle: u64,
    /// Value of each signal at the end of the last scan.
    values: FixedBitSet,
    /// For each signal, how long its formula has been TRUE (or latched), in milliseconds.
    since: Vec<Option<u64>>,
}

impl<'s> Model<'s> {
    /// Starts at power-on, with nothing latched.
    pub fn new(specification: &'s Specification, cycle: u64) -> Self {
        let count = specification.signals.len();
        let (values, since) = (FixedBitSet::with_capacity(count), vec![None; count]);
        Self { specification, order: order(specification), cycle, values, since }
    }

    /// Returns to power-on.
    pub fn restart(&mut self) {
        self.values.clear();
        self.since.fill(None);
    }

    /// Executes a scan with these inputs.
    pub fn scan(&mut self, inputs: &FixedBitSet) {
        let specification = self.specification;
        specification.inputs().for_each(|input| self.values.set(input.0, inputs.contains(input.0)));
        for &id in &self.order {
            let Kind::Defined { formula, latched, delayed, .. } = &specification.signal(id).kind else { continue };
            let is = |signal: SignalId| self.values.contains(signal.0);
            // The latch stores that the formula was TRUE, not that the delay had passed.
            let is_kept = latched.as_ref().is_some_and(|reset| self.since[id.0].is_some() && !reset.holds(is));
            let is_wanted = formula.holds(is) || is_kept;
            let since = is_wanted.then(|| self.since[id.0].map_or(0, |since| since + self.cycle));
            self.since[id.0] = since;
            let passed = since.is_some_and(|since| since >= u64::from(delayed.unwrap_or(0)));
            self.values.set(id.0, passed);
        }
    }

    /// Value of a signal at the end of the last scan.
    pub fn value(&self, signal: SignalId) -> bool {
        self.values.contains(signal.0)
    }

    /// Number of scans with constant inputs after which these signals are stable.
    pub fn scans(&self, signals: &[SignalId]) -> u64 {
        let mut scans = vec![0_u64; self.specification.signals.len()];
        for &id in &self.order {
            let Kind::Defined { delayed, .. } = &self.specification.signal(id).kind else { continue };
            let before = self.specification.uses(id).into_iter().map(|used| scans[used.0]).max().unwrap_or(0);
            let own = delayed.map_or(0, |delay| u64::from(delay).div_ceil(self.cycle.max(1)));
            // Of several delays in a row, each begins in the scan in which the one before ends, or in the next one.
            scans[id.0] = before + own + u64::from(before > 0 && own > 0);
        }
        signals.iter().map(|signal| scans[signal.0]).max().unwrap_or(0) + 1
    }
}

/// Definitions in topological order, reset conditions included, as far as such an order exists.
fn order(specification: &Specification) -> Vec<SignalId> {
    let mut left = specification.order.clone();
    let mut waiting = specification.valuation(left.iter().copied());
    let mut order = Vec::with_capacity(left.len());
    loop {
        let before = order.len();
        left.retain(|&id| {
            let waits = specification.uses(id).iter().any(|used| *used != id && waiting.contains(used.0));
            if !waits {
                waiting.set(id.0, false);
                order.push(id);
            }
            waits
        });
        if order.len() == before {
            order.extend(left);
            return order;
        }
    }
}

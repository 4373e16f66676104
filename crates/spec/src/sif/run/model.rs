//! A specification scan by scan: what is latched is remembered, what is delayed comes when its time has passed.

use fixedbitset::FixedBitSet;

use crate::sif::{Kind, SignalId, Specification};

/// What a system that is as specified does, from power-on.
#[derive(Clone, Debug)]
pub(super) struct Model<'s> {
    specification: &'s Specification,
    /// The definitions, each behind those it uses, also to be reset.
    order: Vec<SignalId>,
    /// Milliseconds from one scan to the next.
    cycle: u64,
    /// What each signal is at the end of the last scan.
    values: FixedBitSet,
    /// For how long the formula of each signal has been TRUE, in milliseconds.
    since: Vec<Option<u64>>,
}

impl<'s> Model<'s> {
    /// At power-on nothing is latched.
    pub fn new(specification: &'s Specification, cycle: u64) -> Self {
        let count = specification.signals.len();
        let (values, since) = (FixedBitSet::with_capacity(count), vec![None; count]);
        Self { specification, order: order(specification), cycle, values, since }
    }

    /// Nothing is remembered any more.
    pub fn restart(&mut self) {
        self.values.clear();
        self.since.fill(None);
    }

    /// A scan that reads these inputs.
    pub fn scan(&mut self, inputs: &FixedBitSet) {
        let specification = self.specification;
        specification.inputs().for_each(|input| self.values.set(input.0, inputs.contains(input.0)));
        for &id in &self.order {
            let Kind::Defined { formula, latched, delayed, .. } = &specification.signal(id).kind else { continue };
            let is = |signal: SignalId| self.values.contains(signal.0);
            // What is remembered is that the formula was TRUE, not that its time had passed.
            let is_kept = latched.as_ref().is_some_and(|reset| self.since[id.0].is_some() && !reset.holds(is));
            let is_wanted = formula.holds(is) || is_kept;
            let since = is_wanted.then(|| self.since[id.0].map_or(0, |since| since + self.cycle));
            self.since[id.0] = since;
            let passed = since.is_some_and(|since| since >= u64::from(delayed.unwrap_or(0)));
            self.values.set(id.0, passed);
        }
    }

    /// What a signal is at the end of the last scan.
    pub fn value(&self, signal: SignalId) -> bool {
        self.values.contains(signal.0)
    }

    /// How many scans it takes, as long as inputs stay as they are, until these signals do, too.
    pub fn scans(&self, signals: &[SignalId]) -> u64 {
        let mut scans = vec![0_u64; self.specification.signals.len()];
        for &id in &self.order {
            let Kind::Defined { delayed, .. } = &self.specification.signal(id).kind else { continue };
            let before = self.specification.uses(id).into_iter().map(|used| scans[used.0]).max().unwrap_or(0);
            let own = delayed.map_or(0, |delay| u64::from(delay).div_ceil(self.cycle.max(1)));
            // Of several delays in a row, each begins with the scan in which the one before ends, or with the next one.
            scans[id.0] = before + own + u64::from(before > 0 && own > 0);
        }
        signals.iter().map(|signal| scans[signal.0]).max().unwrap_or(0) + 1
    }
}

/// The definitions, each behind those it uses, also to be reset, as far as there is such an order.
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

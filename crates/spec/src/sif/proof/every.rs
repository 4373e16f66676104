//! Exhaustive exploration by the interpreter: for programs without gates, and to confirm proofs where inputs are few.

use std::collections::{BTreeMap, HashSet};

use super::run::{Failure, Given, Run};
use super::subject::Subject;
use crate::sif::Stop;
use petril_lang::semantics::Role;

/// Upper bound on the bits of all inputs.
const MAX_BITS: u32 = 16;

/// Result of exploring all scans that satisfy some restrictions.
#[derive(Clone, Debug, Default)]
pub(super) struct Seen {
    /// For each claim checked that is wrong in some scan, a shortest run to it.
    pub(super) wrong: BTreeMap<usize, Vec<Given>>,
    /// For each kind of failure, a shortest run to it.
    pub(super) failures: BTreeMap<Failure, Vec<Given>>,
    /// Number of states, power-on included.
    pub(super) states: u64,
    /// Number of scans computed.
    pub(super) scans: u64,
    /// Number of these scans that satisfy the restrictions and do not fail.
    pub(super) ended: u64,
    /// Reason why not every scan from every state was computed, if so.
    pub(super) stopped: Option<String>,
}

/// Input valuations of a scan; `None` if they are too many.
fn readings(subject: &Subject<'_>) -> Option<Vec<Given>> {
    let program = subject.program;
    let inputs: Vec<_> = program.with_role(Role::Input).collect();
    let domain = |&input: &_| {
        let (least, greatest) = program.range(input);
        let ty = program.variable(input).ty;
        (greatest - least < 1 << MAX_BITS).then(|| (least..=greatest).map(|number| ty.pattern(number)).collect())
    };
    let domains: Vec<Vec<u64>> = inputs.iter().map(domain).collect::<Option<_>>()?;
    let count = domains.iter().try_fold(1_usize, |count, domain| count.checked_mul(domain.len()))?;
    let count =
        count.checked_shl(u32::try_from(subject.outside.len()).ok()?).filter(|&count| count <= 1 << MAX_BITS)?;
    let reading = |mut number: usize| {
        let mut digit = |base: usize| {
            let digit = number % base;
            number /= base;
            digit
        };
        let outside = subject.outside.iter().map(|&id| (id, digit(2) == 1)).collect();
        let mut inputs: Vec<_> =
            inputs.iter().zip(&domains).rev().map(|(&input, domain)| (input, domain[digit(domain.len())])).collect();
        inputs.reverse();
        Given { inputs, outside }
    };
    (subject.outside.len() <= MAX_BITS as usize).then(|| (0..count).map(reading).collect())
}

/// Explores all states by scans that satisfy the restrictions, up to `limit` scans, and checks the claims. `None` if
/// inputs are too many.
pub(super) fn every(
    subject: &Subject<'_>,
    restrictions: &[usize],
    claims: &[usize],
    limit: u64,
    stop: &Stop,
) -> Option<Seen> {
    let readings = readings(subject)?;
    let carried = subject.program.carried();
    let key = |(memory, latches): &(Vec<u64>, Vec<bool>)| -> Vec<u64> {
        let kept = carried.ones().map(|at| memory[at]);
        kept.chain(latches.iter().map(|&latch| u64::from(latch))).collect()
    };
    let mut seen = Seen::default();
    let mut run = Run::new(subject);
    let mut states = vec![run.position()];
    // For each state, its predecessor and the inputs of the scan between.
    let mut ways: Vec<Option<(usize, usize)>> = vec![None];
    let mut known = HashSet::from([key(&states[0])]);
    let way = |ways: &[Option<(usize, usize)>], mut state: usize, reading: usize| -> Vec<Given> {
        let mut given = vec![readings[reading].clone()];
        while let Some((before, reading)) = ways[state] {
            given.push(readings[reading].clone());
            state = before;
        }
        given.reverse();
        given
    };
    let mut state = 0;
    'all: while state < states.len() {
        for (number, reading) in readings.iter().enumerate() {
            if seen.scans == limit {
                seen.stopped = Some(format!("the limit of {limit} scans was reached"));
                break 'all;
            }
            if seen.scans.is_multiple_of(1024) && stop() {
                seen.stopped = Some("the search was stopped".to_owned());
                break 'all;
            }
            run.restore(&states[state]);
            let scan = run.scan(reading);
            seen.scans += 1;
            if scan.broken.iter().any(|broken| restrictions.contains(broken)) {
                continue;
            }
            if let Some(failure) = scan.failure {
                seen.failures.entry(failure).or_insert_with(|| way(&ways, state, number));
                continue;
            }
            seen.ended += 1;
            for &claim in claims {
                let of = &subject.claims[claim];
                if !of.form.fits(scan.memory[of.variable.0] == 1, scan.wanted[of.signal.0]) {
                    seen.wrong.entry(claim).or_insert_with(|| way(&ways, state, number));
                }
            }
            let position = run.position();
            if known.insert(key(&position)) {
                states.push(position);
                ways.push(Some((state, number)));
            }
        }
        state += 1;
    }
    seen.states = states.len() as u64;
    Some(seen)
}

//! Reference run of a proof: the interpreter beside the specification's definitions, evaluated as written. Shares no
//! code with gates and solver; their findings are shown only if confirmed here.

use super::subject::Subject;
use crate::sif::{Kind, SignalId};
use petril_lang::flat::Hazard;
use petril_lang::interpret::{Fault, Machine};
use petril_lang::semantics::VarId;

/// Inputs of a scan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Given {
    /// Free inputs of the program.
    pub inputs: Vec<(VarId, u64)>,
    /// Inputs of the specification that the program does not have.
    pub outside: Vec<(SignalId, bool)>,
}

/// Scan with its specified values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Scan {
    /// Inputs read.
    pub given: Given,
    /// Value of each signal at the end, by the specification; of a delayed output, by the program.
    pub signals: Vec<bool>,
    /// Value of each definition without delay.
    pub wanted: Vec<bool>,
    /// Values of all variables at the end; meaningless if the scan failed.
    pub memory: Vec<u64>,
    /// Failure of the scan, if any.
    pub failure: Option<Failure>,
    /// Positions of the restrictions violated.
    pub broken: Vec<usize>,
}

/// Failure of a scan: its end is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Failure {
    /// Error in this line (from 0).
    Hazard(usize, Hazard),
    /// The scan never ends.
    Endless,
    /// The scan exceeds the limit on instructions.
    TooLong,
}

/// Run under way.
#[derive(Clone)]
pub(super) struct Run<'s> {
    subject: &'s Subject<'s>,
    machine: Machine<'s>,
    /// Latch of each signal.
    latches: Vec<bool>,
}

impl<'s> Run<'s> {
    /// Starts at power-on, with nothing latched.
    pub(super) fn new(subject: &'s Subject<'s>) -> Self {
        let latches = vec![false; subject.specification.signals.len()];
        Self { subject, machine: Machine::new(subject.program), latches }
    }

    /// Current position: values of all variables, and latches.
    pub(super) fn position(&self) -> (Vec<u64>, Vec<bool>) {
        let memory = (0..self.subject.program.variables.len()).map(|id| self.machine.value(VarId(id))).collect();
        (memory, self.latches.clone())
    }

    /// Restores a position.
    pub(super) fn restore(&mut self, (memory, latches): &(Vec<u64>, Vec<bool>)) {
        self.machine.restore(memory);
        self.latches.clone_from(latches);
    }

    /// Executes one scan.
    pub(super) fn scan(&mut self, given: &Given) -> Scan {
        let subject = self.subject;
        given.inputs.iter().for_each(|&(input, value)| self.machine.set(input, value));
        let ended = self.machine.scan();
        let failure = match (subject.tolerated.first_error(self.machine.hazards()), ended) {
            (Some((line, hazard)), _) => Some(Failure::Hazard(line, hazard)),
            (None, Err(Fault::Endless)) => Some(Failure::Endless),
            (None, Err(Fault::TooLong)) => Some(Failure::TooLong),
            (None, Ok(())) => None,
        };
        let specification = subject.specification;
        let mut signals = vec![false; specification.signals.len()];
        subject.inputs().for_each(|(id, variable)| signals[id.0] = self.machine.value(variable) == 1);
        given.outside.iter().for_each(|&(id, value)| signals[id.0] = value);
        let mut wanted = signals.clone();
        for &id in &subject.definitions {
            let Kind::Defined { formula, latched, .. } = &specification.signal(id).kind else { continue };
            let is = |signal: SignalId| signals[signal.0];
            let kept = latched.as_ref().is_some_and(|reset| self.latches[id.0] && !reset.holds(is));
            wanted[id.0] = formula.holds(is) || kept;
            self.latches[id.0] = latched.is_some() && wanted[id.0];
            let made = subject.variables[id.0].filter(|_| subject.is_delayed(id));
            signals[id.0] = made.map_or(wanted[id.0], |variable| self.machine.value(variable) == 1);
        }
        let broken = |at: &usize| !specification.restrictions[*at].allowed.holds(|signal| signals[signal.0]);
        let broken = subject.restrictions.iter().copied().filter(broken).collect();
        Scan { given: given.clone(), signals, wanted, memory: self.position().0, failure, broken }
    }
}

/// Executes a run with these inputs.
pub(super) fn run(subject: &Subject<'_>, given: &[Given]) -> Vec<Scan> {
    let mut run = Run::new(subject);
    given.iter().map(|given| run.scan(given)).collect()
}

//! A program and its specification side by side, scan by scan: the interpreter, and definitions evaluated as they are
//! written. It shares nothing with the gates and the solver, and what they find is shown only if it is so here.

use super::subject::Subject;
use crate::sif::{Kind, SignalId};
use petril_lang::flat::Hazard;
use petril_lang::interpret::{Fault, Machine};
use petril_lang::semantics::VarId;

/// What a scan reads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Given {
    /// The free inputs of the program.
    pub inputs: Vec<(VarId, u64)>,
    /// Inputs of the specification that the program does not have.
    pub outside: Vec<(SignalId, bool)>,
}

/// A scan, and what was specified of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Scan {
    /// What it read.
    pub given: Given,
    /// What each signal is at its end, by the specification; what is delayed is what the program makes of it.
    pub signals: Vec<bool>,
    /// What each definition is without delay.
    pub wanted: Vec<bool>,
    /// The values of all variables at its end. They mean nothing if it failed.
    pub memory: Vec<u64>,
    /// Why it failed, if it did.
    pub failure: Option<Failure>,
    /// The positions of the restrictions that it breaks.
    pub broken: Vec<usize>,
}

/// Why nothing is known of the end of a scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Failure {
    /// It meets an error in this line (from 0).
    Hazard(usize, Hazard),
    /// It never ends.
    Endless,
    /// It takes so long that nobody waited for its end.
    TooLong,
}

/// A run under way.
#[derive(Clone)]
pub(super) struct Run<'s> {
    subject: &'s Subject<'s>,
    machine: Machine<'s>,
    /// What is remembered of each signal.
    latches: Vec<bool>,
}

impl<'s> Run<'s> {
    /// The run that has not begun: nothing is latched.
    pub(super) fn new(subject: &'s Subject<'s>) -> Self {
        let latches = vec![false; subject.specification.signals.len()];
        Self { subject, machine: Machine::new(subject.program), latches }
    }

    /// What it is at: the values of all variables, and what is latched.
    pub(super) fn position(&self) -> (Vec<u64>, Vec<bool>) {
        let memory = (0..self.subject.program.variables.len()).map(|id| self.machine.value(VarId(id))).collect();
        (memory, self.latches.clone())
    }

    /// Goes to where a run was.
    pub(super) fn restore(&mut self, (memory, latches): &(Vec<u64>, Vec<bool>)) {
        self.machine.restore(memory);
        self.latches.clone_from(latches);
    }

    /// One scan more.
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

/// The run that reads this.
pub(super) fn run(subject: &Subject<'_>, given: &[Given]) -> Vec<Scan> {
    let mut run = Run::new(subject);
    given.iter().map(|given| run.scan(given)).collect()
}

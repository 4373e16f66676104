//! Diagnosis of a run-time error: expected and actual value at the instruction, and the last writers of the values it
//! depends on.

use std::collections::{BTreeMap, BTreeSet};

use super::scan_trace::{Scan, ScanTrace};
use super::writes::Write;
use crate::translate::System;
use petril_lang::flat::{FlatProgram, Function, Hazard, Instruction, Operand, Target};
use petril_lang::interpret::Machine;
use petril_lang::semantics::{Role, VarId};

/// Upper bound on values named in a sentence.
const MOST: usize = 4;

/// Diagnosis of a scan that meets an error or never ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failed {
    /// Expected and actual value, as a sentence.
    pub wanted: String,
    /// Variables the error depends on and the program has written, each with its last write.
    pub writes: Vec<(VarId, Write)>,
    /// Variables the error depends on that still have their initial values.
    pub unwritten: Vec<VarId>,
}

/// Diagnoses the last scan of a replayed run that meets an error or never ends; `None` for other runs.
#[must_use]
pub fn failed(system: &System, trace: &ScanTrace) -> Option<Failed> {
    let (last, before) = trace.scans.split_last()?;
    let mut run = Run::new(&system.program);
    for scan in before {
        run.begin(scan);
        while !run.machine.at_end() {
            run.step();
        }
        run.scan += 1;
    }
    run.begin(last);
    let (wanted, sources) = match last.hazard {
        Some((line, hazard)) => run.error(line, hazard)?,
        None if last.end.is_none() => run.endless()?,
        None => return None,
    };
    Some(run.failed(wanted, &sources))
}

/// A run with the origins of its values (dynamic data dependences).
struct Run<'p> {
    program: &'p FlatProgram,
    machine: Machine<'p>,
    scan: usize,
    writes: BTreeMap<VarId, Write>,
    /// Variables that the current result was computed from since it was loaded.
    sources: BTreeSet<VarId>,
    /// Variables that the contents of each buffer were computed from.
    held: BTreeMap<VarId, BTreeSet<VarId>>,
}

impl<'p> Run<'p> {
    fn new(program: &'p FlatProgram) -> Self {
        let (writes, sources, held) = (BTreeMap::new(), BTreeSet::new(), BTreeMap::new());
        Self { program, machine: Machine::new(program), scan: 0, writes, sources, held }
    }

    fn begin(&mut self, scan: &Scan) {
        scan.inputs.iter().for_each(|&(input, value)| self.machine.set(input, value));
        self.machine.begin_scan();
    }

    fn instruction(&self) -> Option<Instruction> {
        self.program.code.get(self.machine.line()).map(|code| code.instruction)
    }

    fn variable(&self, target: Target) -> VarId {
        match target {
            Target::Variable(variable) => variable,
            Target::Element(element) => element.at(self.machine.value(element.index) as usize),
        }
    }

    /// Variables that the value of an operand was computed from.
    fn read(&self, target: Target) -> BTreeSet<VarId> {
        let index = if let Target::Element(element) = target { Some(element.index) } else { None };
        let all = [Some(self.variable(target)), index].into_iter().flatten();
        let own = |id: VarId| match self.program.variable(id).role {
            Role::Buffer => self.held.get(&id).cloned().unwrap_or_default(),
            Role::Constant => BTreeSet::new(),
            _ => BTreeSet::from([id]),
        };
        all.flat_map(own).collect()
    }

    fn step(&mut self) {
        let Some(instruction) = self.instruction() else { return };
        let line = self.machine.line();
        match instruction {
            Instruction::Load { .. } => {
                self.sources = instruction.reads().map(|read| self.read(read)).unwrap_or_default();
            }
            Instruction::Combine { .. } => {
                let more = instruction.reads().map(|read| self.read(read)).unwrap_or_default();
                self.sources.extend(more);
            }
            _ => {}
        }
        let acts = match instruction {
            Instruction::Set(_) | Instruction::Reset(_) => self.machine.result() & 1 == 1,
            _ => true,
        };
        let written = instruction.writes().filter(|_| acts).map(|target| self.variable(target));
        self.machine.step();
        if let Some(variable) = written {
            if self.program.variable(variable).role == Role::Buffer {
                self.held.insert(variable, self.sources.clone());
            }
            let value = self.machine.value(variable);
            self.writes.insert(variable, Write { value, scan: self.scan, line });
        }
    }

    /// Executes up to the first error at a line; returns the diagnosis and the variables it depends on.
    fn error(&mut self, line: usize, hazard: Hazard) -> Option<(String, BTreeSet<VarId>)> {
        let meets = |machine: &Machine<'_>| machine.line() == line && machine.clone().step() == Some(hazard);
        while !meets(&self.machine) {
            if self.machine.at_end() {
                return None;
            }
            self.step();
        }
        let instruction = self.instruction()?;
        let read = instruction.reads().map(|read| self.read(read)).unwrap_or_default();
        let sources = match hazard {
            Hazard::DivisionByZero => read,
            _ => self.sources.union(&read).copied().collect(),
        };
        let wanted = self.demand(instruction, hazard)?;
        let facts = self.facts(&sources);
        let facts = if facts.is_empty() { facts } else { format!(": {facts}") };
        let place = format!("In scan {}, `{}`", self.scan + 1, self.words(line));
        Some((format!("{place} {wanted}{facts}"), sources))
    }

    /// Expected and actual value at an instruction that is about to meet an error.
    fn demand(&self, instruction: Instruction, hazard: Hazard) -> Option<String> {
        let result = self.machine.result();
        Some(match instruction {
            _ if hazard == Hazard::DivisionByZero => "had to divide by another number than 0".to_owned(),
            Instruction::Bound { ty, lower, upper, .. } => {
                let what = if hazard == Hazard::Index { "an index" } else { "a value" };
                format!("had to get {what} from {lower} to {upper}, but it is {}", ty.number(result & ty.mask()))
            }
            Instruction::Convert { from, to } => {
                let number = from.number(result & from.mask());
                format!("had to give a number from {} to {}, but it is {number}", to.least(), to.greatest())
            }
            Instruction::Combine { function, ty, operand, .. } => {
                let right = match operand {
                    Operand::Constant(pattern) => pattern,
                    Operand::Place(target) => self.machine.value(self.variable(target)),
                };
                let (left, right) = (ty.number(result & ty.mask()), ty.number(right & ty.mask()));
                let (sign, number) = match function {
                    Function::Add => ("+", left.checked_add(right)?),
                    Function::Sub => ("-", left.checked_sub(right)?),
                    Function::Mul => ("*", left.checked_mul(right)?),
                    _ => ("/", left.checked_div(right)?),
                };
                let (least, greatest) = (ty.least(), ty.greatest());
                format!("had to give a number from {least} to {greatest}, but {left} {sign} {right} is {number}")
            }
            _ => return None,
        })
    }

    /// Executes up to the first repeated state; returns the lines of the endless loop in words, and the variables read
    /// there.
    fn endless(&mut self) -> Option<(String, BTreeSet<VarId>)> {
        let mut ahead = self.machine.clone();
        ahead.scan().is_err().then_some(())?;
        while !self.machine.same_state(&ahead) {
            self.step();
        }
        let (mut sources, mut first, mut last) = (BTreeSet::new(), usize::MAX, 0);
        loop {
            let line = self.machine.line();
            (first, last) = (first.min(line), last.max(line));
            let read = self.instruction()?.reads().map(|read| self.read(read)).unwrap_or_default();
            sources.extend(read);
            self.step();
            if self.machine.same_state(&ahead) {
                break;
            }
        }
        let round = if first == last {
            format!("stays in line {}", first + 1)
        } else {
            format!("goes round lines {} to {}", first + 1, last + 1)
        };
        let facts = self.facts(&sources);
        let facts = if facts.is_empty() { facts } else { format!(": {facts}") };
        Some((
            format!("In scan {}, control had to come to the end, but {round} for ever{facts}", self.scan + 1),
            sources,
        ))
    }

    fn words(&self, line: usize) -> String {
        let text = self.program.code.get(line).map(|code| self.program.text(code.instruction)).unwrap_or_default();
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// Values of variables, in words.
    fn facts(&self, variables: &BTreeSet<VarId>) -> String {
        let fact = |&id: &VarId| {
            let value = self.program.value_text(id, self.machine.value(id));
            format!("`{}` is {value}", self.program.variable(id).name)
        };
        let mut facts: Vec<String> = variables.iter().take(MOST).map(fact).collect();
        if variables.len() > MOST {
            facts.push(format!("{} more", variables.len() - MOST));
        }
        enumerated(&facts)
    }

    fn failed(&self, wanted: String, sources: &BTreeSet<VarId>) -> Failed {
        let computed = || sources.iter().copied().filter(|&id| self.program.variable(id).role != Role::Input);
        Failed {
            wanted,
            writes: computed().filter_map(|id| Some((id, *self.writes.get(&id)?))).collect(),
            unwritten: computed().filter(|id| !self.writes.contains_key(id)).collect(),
        }
    }
}

/// "a", "a and b", "a, b and c".
fn enumerated(parts: &[String]) -> String {
    match parts {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

//! Last write to each variable: the instruction, and the scan.

use super::scan_trace::ScanTrace;
use crate::translate::System;
use petril_lang::flat::{Instruction, Target};
use petril_lang::interpret::Machine;
use petril_lang::semantics::VarId;

/// Write to a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Write {
    /// Value written, as a bit pattern of the variable's type.
    pub value: u64,
    /// Position of the scan in the run.
    pub scan: usize,
    /// Line of flat code, from 0.
    pub line: usize,
}

/// Last write to each variable up to the end of scan `until` of a replayed run, whether or not it changed the value. A
/// set or reset that does not act is not a write, and neither is the copying of inputs.
#[must_use]
pub fn last_writes(system: &System, trace: &ScanTrace, until: usize) -> Vec<Option<Write>> {
    let program = &system.program;
    let mut writes = vec![None; program.variables.len()];
    let mut machine = Machine::new(program);
    // The replay has shown that these scans end.
    let ending = trace.scans.iter().take_while(|scan| scan.end.is_some());
    for (scan, told) in ending.enumerate().take(until + 1) {
        told.inputs.iter().for_each(|&(input, value)| machine.set(input, value));
        machine.begin_scan();
        while !machine.at_end() {
            let line = machine.line();
            let written = written(&machine, program.code[line].instruction);
            machine.step();
            if let Some(variable) = written {
                writes[variable.0] = Some(Write { value: machine.value(variable), scan, line });
            }
        }
    }
    writes
}

/// Variable that the instruction at hand is about to write.
fn written(machine: &Machine<'_>, instruction: Instruction) -> Option<VarId> {
    let acts = match instruction {
        Instruction::Set(_) | Instruction::Reset(_) => machine.result() & 1 == 1,
        _ => true,
    };
    let target = instruction.writes().filter(|_| acts)?;
    Some(match target {
        Target::Variable(variable) => variable,
        Target::Element(element) => element.at(machine.value(element.index) as usize),
    })
}

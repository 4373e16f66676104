//! Symbolic execution of a scan: flat code is executed once, with wires instead of bits.
//!
//! Where control branches, each branch has a wire that says when it is taken; where branches join, multiplexers choose
//! between their values by these wires. Programs with backward jumps are left to the interpreter, and so are those that
//! would take too many gates. Gates for simulation leave out multiplication, division, and shifts by computed distances
//! too.

use std::collections::BTreeMap;

use super::gates::{Network, Wire};
use super::memory::{Jumped, Memory};
use super::numbers::{self, complement, constant, resized};
use super::products;
use crate::flat::{Condition, Element, FlatProgram, Function, Hazard, Instruction, Operand, Target, Tolerated};
use crate::semantics::{Type, VarId};

/// A scan as a function of the bits of all variables.
pub(super) struct Compiled {
    pub(super) network: Network,
    /// The bits of each variable at the end of the scan.
    pub(super) memory: Vec<Vec<Wire>>,
    /// Conditions under which the first error of the scan is in this line.
    pub(super) errors: Vec<(Wire, usize, Hazard)>,
    /// Conditions under which control reaches the lines from this one up to that of the next entry.
    pub(super) lines: Vec<(usize, Wire)>,
}

/// Limits on the size and the kinds of gates of a network.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Maximum number of gates.
    gates: usize,
    /// Whether products, quotients, and shifts by computed distances are allowed. They take thousands of gates each.
    products: bool,
}

impl Limits {
    /// Limits for gates that simulate scans: 256 lanes evaluate a hundred gates in about the interpreter's time for a
    /// line.
    pub(super) fn for_lanes(program: &FlatProgram) -> Self {
        Self { gates: (program.end() * 100).clamp(1000, 1 << 18), products: false }
    }

    /// Limits for gates that proofs are made of.
    pub(super) const FOR_PROOFS: Self = Self { gates: 1 << 22, products: true };
}

/// Maximum number of bits of an array that is indexed.
const ARRAY_BITS: usize = 1 << 15;

/// Reason why a scan has no gates, with the line (from 0).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoGates {
    /// The line jumps backward, so the scan may have any length.
    Back(usize),
    /// The instruction of the line is left to the interpreter.
    Instruction(usize),
    /// The limit on the number of gates is exceeded at the line.
    TooMany(usize),
}

impl NoGates {
    /// The line (from 0).
    #[must_use]
    pub fn line(self) -> usize {
        let (Self::Back(line) | Self::Instruction(line) | Self::TooMany(line)) = self;
        line
    }
}

/// Compiles a scan to a network with `inputs` inputs; `beginning` has the wires of each variable at the beginning of
/// the scan.
pub(super) fn compile(
    program: &FlatProgram,
    tolerated: Tolerated,
    inputs: usize,
    beginning: &[Vec<Wire>],
    limits: Limits,
) -> Result<Compiled, NoGates> {
    let network = Network::new(inputs);
    let mut memory = Vec::new();
    let mut starts = vec![0];
    for (variable, bits) in program.variables.iter().zip(beginning) {
        memory.extend(resized(bits, variable.ty.width as usize));
        starts.push(memory.len());
    }
    let (start, memory) = (memory.clone(), Memory::new(memory));
    let mut compiler =
        Compiler { program, tolerated, limits, network, memory, starts, errors: Vec::new(), lines: Vec::new() };
    let is_ending = compiler.run()?;
    let Compiler { network, memory, starts, errors, lines, .. } = compiler;
    // Without a way to the end, every scan meets an error.
    let end = if is_ending { memory.bits() } else { &start };
    let memory = starts.windows(2).map(|range| end[range[0]..range[1]].to_vec()).collect();
    Ok(Compiled { network, memory, errors, lines })
}

struct Compiler<'p> {
    program: &'p FlatProgram,
    tolerated: Tolerated,
    limits: Limits,
    network: Network,
    memory: Memory,
    /// Offset of each variable's bits.
    starts: Vec<usize>,
    errors: Vec<(Wire, usize, Hazard)>,
    lines: Vec<(usize, Wire)>,
}

/// Symbolic state at a point of control, beside the memory.
struct Flow {
    /// Condition under which control reaches this point.
    active: Wire,
    result: Vec<Wire>,
}

impl Compiler<'_> {
    /// Whether control comes to the end.
    fn run(&mut self) -> Result<bool, NoGates> {
        let end = self.program.end();
        // What comes to a line by jumps, the first jump first.
        let mut arriving: BTreeMap<usize, Vec<Jumped>> = BTreeMap::new();
        let mut flow = Some(Flow { active: Wire::TRUE, result: Vec::new() });
        for line in 0..end {
            flow = self.joined(flow, arriving.remove(&line).unwrap_or_default());
            self.note(line, flow.as_ref());
            let Some(now) = &mut flow else { continue };
            if let Instruction::Jump { condition, target } = self.program.code[line].instruction {
                if target <= line {
                    return Err(NoGates::Back(line));
                }
                let jumps = match condition {
                    Condition::Always => Wire::TRUE,
                    Condition::IfTrue => resized(&now.result, 1)[0],
                    Condition::IfFalse => !resized(&now.result, 1)[0],
                };
                let active = self.network.and(now.active, jumps);
                if active != Wire::FALSE {
                    let jumped = Jumped { active, result: now.result.clone(), since: self.memory.changes() };
                    arriving.entry(target).or_default().push(jumped);
                }
                now.active = self.network.and(now.active, !jumps);
                if now.active == Wire::FALSE {
                    flow = None;
                }
            } else {
                self.execute(line, now)?;
            }
            if self.network.gates().len() > self.limits.gates {
                return Err(NoGates::TooMany(line));
            }
        }
        flow = self.joined(flow, arriving.remove(&end).unwrap_or_default());
        self.note(end, flow.as_ref());
        Ok(flow.is_some())
    }

    /// Records the condition under which control reaches a line.
    fn note(&mut self, line: usize, flow: Option<&Flow>) {
        let active = flow.map_or(Wire::FALSE, |flow| flow.active);
        if self.lines.last().is_none_or(|(_, before)| *before != active) {
            self.lines.push((line, active));
        }
    }

    /// Several parts of control as one.
    fn joined(&mut self, flow: Option<Flow>, mut jumped: Vec<Jumped>) -> Option<Flow> {
        let mut flow = match flow {
            Some(flow) => flow,
            // Where nobody goes on, the last one that has jumped does.
            None => {
                let last = jumped.pop()?;
                self.memory.return_to(&last);
                Flow { active: last.active, result: last.result }
            }
        };
        self.memory.join(&mut self.network, &jumped);
        for Jumped { active, result, .. } in jumped {
            let width = flow.result.len().max(result.len());
            flow.result = self.chosen(active, &resized(&result, width), &resized(&flow.result, width));
            flow.active = self.network.or(flow.active, active);
        }
        Some(flow)
    }

    fn chosen(&mut self, condition: Wire, yes: &[Wire], no: &[Wire]) -> Vec<Wire> {
        yes.iter().zip(no).map(|(&yes, &no)| self.network.choose(condition, yes, no)).collect()
    }

    /// Executes an instruction that is not a jump.
    fn execute(&mut self, line: usize, flow: &mut Flow) -> Result<(), NoGates> {
        match self.program.code[line].instruction {
            Instruction::Load { ty, negated, operand } => {
                flow.result = complement(&self.operand(line, operand, ty)?, negated);
            }
            Instruction::Store { ty, negated, target } => {
                let value = complement(&resized(&flow.result, ty.width as usize), negated);
                self.write(line, target, &mut |_, old| resized(&value, old.len()))?;
            }
            Instruction::Set(target) => {
                let set = resized(&flow.result, 1)[0];
                self.write(line, target, &mut |network, old| vec![network.or(old[0], set)])?;
            }
            Instruction::Reset(target) => {
                let reset = resized(&flow.result, 1)[0];
                self.write(line, target, &mut |network, old| vec![network.and(old[0], !reset)])?;
            }
            Instruction::Complement(ty) => {
                flow.result = complement(&resized(&flow.result, ty.width as usize), true);
            }
            Instruction::Combine { function, ty, negated, operand } => {
                self.combine(line, flow, function, ty, negated, operand)?;
            }
            Instruction::Convert { from, to } => {
                let bits = resized(&flow.result, from.width as usize);
                let (result, overflow) = numbers::convert(&mut self.network, from, to, &bits);
                flow.result = result;
                self.meet(flow, overflow, line, Hazard::Overflow);
            }
            Instruction::Bound { ty, lower, upper, hazard } => {
                let bits = resized(&flow.result, ty.width as usize);
                let inside = numbers::is_between(&mut self.network, ty, &bits, lower, upper);
                if hazard == Hazard::Index {
                    flow.result = self.chosen(inside, &bits, &constant(ty.pattern(lower), bits.len()));
                }
                self.meet(flow, !inside, line, hazard);
            }
            Instruction::Jump { .. } => return Err(NoGates::Instruction(line)),
        }
        Ok(())
    }

    fn combine(
        &mut self,
        line: usize,
        flow: &mut Flow,
        function: Function,
        ty: Type,
        negated: bool,
        operand: Operand,
    ) -> Result<(), NoGates> {
        let a = resized(&flow.result, ty.width as usize);
        let unfit = NoGates::Instruction(line);
        if matches!(function, Function::Shl | Function::Shr | Function::Rol | Function::Ror) {
            flow.result = match operand {
                Operand::Constant(distance) => {
                    numbers::shift(function, &a, if negated { !distance & ty.mask() } else { distance }).ok_or(unfit)?
                }
                Operand::Place(_) if self.limits.products => {
                    let width = if negated { ty.width as usize } else { u64::BITS as usize };
                    let distance = complement(&resized(&self.place(line, operand)?, width), negated);
                    products::shift(&mut self.network, function, &a, &distance)
                }
                Operand::Place(_) => return Err(unfit),
            };
            return Ok(());
        }
        let b = complement(&self.operand(line, operand, ty)?, negated);
        let network = &mut self.network;
        let mut each = |gate: fn(&mut Network, Wire, Wire) -> Wire| -> Vec<Wire> {
            a.iter().zip(&b).map(|(&a, &b)| gate(network, a, b)).collect()
        };
        flow.result = match function {
            Function::And => each(Network::and),
            Function::Or => each(Network::or),
            Function::Xor => each(Network::xor),
            Function::Add | Function::Sub => {
                let (sum, overflow) = numbers::sum(network, ty, &a, &b, function == Function::Sub);
                self.meet(flow, overflow, line, Hazard::Overflow);
                sum
            }
            Function::Mul if self.limits.products => {
                let (product, overflow) = products::product(network, ty, &a, &b);
                self.meet(flow, overflow, line, Hazard::Overflow);
                product
            }
            Function::Div | Function::Mod if self.limits.products => {
                let by_zero = !network.any(b.iter().copied());
                let divided = products::quotient(network, ty, &a, &b);
                let (number, overflow) = match function {
                    Function::Div => (divided.quotient, divided.overflow),
                    _ => (divided.remainder, Wire::FALSE),
                };
                self.meet(flow, by_zero, line, Hazard::DivisionByZero);
                self.meet(flow, overflow, line, Hazard::Overflow);
                number
            }
            _ => vec![numbers::compare(network, function, ty, &a, &b).ok_or(unfit)?],
        };
        Ok(())
    }

    /// Records an error under a condition; control continues only without the error.
    fn meet(&mut self, flow: &mut Flow, condition: Wire, line: usize, hazard: Hazard) {
        if !self.tolerated.allows(hazard) {
            let met = self.network.and(flow.active, condition);
            if met != Wire::FALSE {
                self.errors.push((met, line, hazard));
                flow.active = self.network.and(flow.active, !condition);
            }
        }
    }

    fn range(&self, variable: VarId) -> std::ops::Range<usize> {
        self.starts[variable.0]..self.starts[variable.0 + 1]
    }

    fn operand(&mut self, line: usize, operand: Operand, ty: Type) -> Result<Vec<Wire>, NoGates> {
        let width = ty.width as usize;
        match operand {
            Operand::Constant(pattern) => Ok(constant(pattern, width)),
            Operand::Place(_) => Ok(resized(&self.place(line, operand)?, width)),
        }
    }

    /// All bits of an operand.
    fn place(&mut self, line: usize, operand: Operand) -> Result<Vec<Wire>, NoGates> {
        Ok(match operand {
            Operand::Constant(pattern) => constant(pattern, u64::BITS as usize),
            Operand::Place(Target::Variable(variable)) => self.memory.bits()[self.range(variable)].to_vec(),
            Operand::Place(Target::Element(element)) => {
                let width = self.range(element.first).len();
                let hits = self.hits(line, element)?;
                let mut value = vec![Wire::FALSE; width];
                for (variable, hit) in hits {
                    let bits = resized(&self.memory.bits()[self.range(variable)], width);
                    value = self.chosen(hit, &bits, &value);
                }
                value
            }
        })
    }

    fn write(
        &mut self,
        line: usize,
        target: Target,
        new: &mut dyn FnMut(&mut Network, &[Wire]) -> Vec<Wire>,
    ) -> Result<(), NoGates> {
        let hits = match target {
            Target::Variable(variable) => vec![(variable, Wire::TRUE)],
            Target::Element(element) => self.hits(line, element)?,
        };
        for (variable, hit) in hits {
            let range = self.range(variable);
            let old = self.memory.bits()[range.clone()].to_vec();
            let new = new(&mut self.network, &old);
            let bits = self.chosen(hit, &new, &old);
            self.memory.set(range.start, &bits);
        }
        Ok(())
    }

    /// The elements of an array, each with when it is meant. An index is always one of the array.
    fn hits(&mut self, line: usize, element: Element) -> Result<Vec<(VarId, Wire)>, NoGates> {
        let width = self.program.variable(element.first).ty.width as usize;
        if element.length * width > ARRAY_BITS {
            return Err(NoGates::TooMany(line));
        }
        let bits = (usize::BITS - (element.length.saturating_sub(1)).leading_zeros()) as usize;
        let index = resized(&self.memory.bits()[self.range(element.index)], bits);
        let hit = |at: usize| {
            let same = numbers::equal(&mut self.network, &index, &constant(at as u64, bits));
            (element.at(at), same)
        };
        Ok((0..element.length).map(hit).collect())
    }
}

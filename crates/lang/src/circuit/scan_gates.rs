//! A scan as gates, for proofs about all scans at once.

use super::compile::{Limits, NoGates, compile};
use super::gates::{Gate, Wire};
use crate::flat::{FlatProgram, Hazard, Target, Tolerated};
use crate::semantics::{Role, VarId};

/// Transition function of a scan: the bits at its end as gates over those at its beginning.
///
/// Node 0 of the network is FALSE; then come the inputs, then the gates in topological order.
#[derive(Clone, Debug)]
pub struct ScanGates {
    /// Variable and bit of each input, at the beginning of the scan after the inputs have been copied.
    pub inputs: Vec<(VarId, u32)>,
    /// Gates in topological order.
    pub gates: Vec<Gate>,
    /// Bits of each variable at the beginning, the least significant first. Variables that are never written have their
    /// initial values; buffers, which no scan reads before it writes them, are FALSE.
    pub beginning: Vec<Vec<Wire>>,
    /// Bits of each variable at the end of a scan without errors. Meaningless in other scans.
    pub end: Vec<Vec<Wire>>,
    /// Conditions under which the first error of the scan is in this line (from 0).
    pub errors: Vec<(Wire, usize, Hazard)>,
}

impl ScanGates {
    /// Compiles the scan of a program. The scan always ends, since programs with backward jumps have no gates.
    ///
    /// # Errors
    /// The scan has no gates.
    pub fn of(program: &FlatProgram, tolerated: Tolerated) -> Result<Self, NoGates> {
        let mut varies: Vec<bool> = program.variables.iter().map(|variable| variable.role == Role::Input).collect();
        for target in program.code.iter().filter_map(|line| line.instruction.writes()) {
            match target {
                Target::Variable(id) => varies[id.0] = true,
                Target::Element(element) => element.all().for_each(|id| varies[id.0] = true),
            }
        }
        let mut inputs = Vec::new();
        let mut beginning = Vec::with_capacity(program.variables.len());
        for ((position, variable), varies) in program.variables.iter().enumerate().zip(varies) {
            let bits = (0..variable.ty.width).map(|bit| {
                if !varies {
                    return Wire::constant(variable.initial >> bit & 1 == 1);
                }
                if variable.role == Role::Buffer || bit >= variable.bits {
                    return Wire::FALSE;
                }
                inputs.push((VarId(position), bit));
                Wire::input(inputs.len() - 1)
            });
            beginning.push(bits.collect::<Vec<Wire>>());
        }
        let compiled = compile(program, tolerated, inputs.len(), &beginning, Limits::FOR_PROOFS)?;
        Ok(Self {
            inputs,
            gates: compiled.network.gates().to_vec(),
            beginning,
            end: compiled.memory,
            errors: compiled.errors,
        })
    }

    /// Number of the first gate's node.
    #[must_use]
    pub fn first_gate(&self) -> usize {
        1 + self.inputs.len()
    }

    /// Evaluates every node in 64 scans at once: `inputs` has a word for each input, with a bit for every scan.
    #[must_use]
    pub fn evaluate(&self, inputs: &[u64]) -> Lanes {
        let mut nodes = Vec::with_capacity(self.first_gate() + self.gates.len());
        nodes.push(0);
        nodes.extend_from_slice(inputs);
        let mut lanes = Lanes { nodes };
        for gate in &self.gates {
            let word = match *gate {
                Gate::And(a, b) => lanes.word(a) & lanes.word(b),
                Gate::Xor(a, b) => lanes.word(a) ^ lanes.word(b),
            };
            lanes.nodes.push(word);
        }
        lanes
    }
}

/// Values of all nodes of a network in 64 scans.
#[derive(Clone, Debug)]
pub struct Lanes {
    nodes: Vec<u64>,
}

impl Lanes {
    /// Values of a wire, one bit for each scan.
    #[must_use]
    pub fn word(&self, wire: Wire) -> u64 {
        let complement = if wire.is_complement() { u64::MAX } else { 0 };
        self.nodes[wire.node()] ^ complement
    }

    /// Bit pattern of wires in one of the scans, the least significant bit first.
    #[must_use]
    pub fn pattern(&self, wires: &[Wire], scan: usize) -> u64 {
        wires.iter().enumerate().fold(0, |pattern, (bit, &wire)| pattern | (self.word(wire) >> scan & 1) << bit)
    }
}

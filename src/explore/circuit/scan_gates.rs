//! One scan as gates, for those who reason about all scans at once.

use super::compile::{Limits, NoGates, compile};
use super::gates::{Gate, Wire};
use petril_lang::flat::{FlatProgram, Hazard, Target, Tolerated};
use petril_lang::semantics::{Role, VarId};

/// What a scan makes of the bits it begins with.
///
/// Node 0 of the network is FALSE; then come the inputs, then the gates, each behind what it reads.
#[derive(Clone, Debug)]
pub struct ScanGates {
    /// Which bit of which variable each input is, at the beginning of the scan, when the inputs have been copied.
    pub inputs: Vec<(VarId, u32)>,
    /// The gates.
    pub gates: Vec<Gate>,
    /// The bits of each variable at the beginning, the least first. Variables that nothing ever writes have their initial
    /// values; buffers, which no scan reads before it writes them, are FALSE.
    pub beginning: Vec<Vec<Wire>>,
    /// The bits of each variable at the end of a scan that meets no error. They mean nothing in other scans.
    pub end: Vec<Vec<Wire>>,
    /// When the scan meets an error first in this line (from 0).
    pub errors: Vec<(Wire, usize, Hazard)>,
}

impl ScanGates {
    /// The scan of a program. It always ends, since control never goes back in what has gates.
    ///
    /// # Errors
    /// Gates do not serve.
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

    /// The node of the first gate.
    #[must_use]
    pub fn first_gate(&self) -> usize {
        1 + self.inputs.len()
    }

    /// What every node gives in 64 scans at once: `inputs` has a word for each input, in which every scan has a bit.
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

/// What the nodes of a network give in 64 scans.
#[derive(Clone, Debug)]
pub struct Lanes {
    nodes: Vec<u64>,
}

impl Lanes {
    /// What a wire gives, one bit for each scan.
    #[must_use]
    pub fn word(&self, wire: Wire) -> u64 {
        let complement = if wire.is_complement() { u64::MAX } else { 0 };
        self.nodes[wire.node()] ^ complement
    }

    /// The number that some wires give in one of the scans, the least bit first.
    #[must_use]
    pub fn pattern(&self, wires: &[Wire], scan: usize) -> u64 {
        wires.iter().enumerate().fold(0, |pattern, (bit, &wire)| pattern | (self.word(wire) >> scan & 1) << bit)
    }
}

//! Bit-parallel simulation: a scan as a network of gates, each of which computes one bit of many scans at once.
//!
//! A lane is one scan: a packed state with its inputs set, which is overwritten by the state at the end of the scan. A
//! plane holds one bit of all lanes, so a gate is one machine instruction for 64 scans, and the network has no jumps.

mod compile;
mod gates;
mod layout;
mod memory;
mod numbers;
mod products;
mod scan_gates;
mod transpose;

pub use compile::NoGates;
pub use gates::{Gate, Wire};
pub use layout::{Field, Layout};
pub use scan_gates::{Lanes, ScanGates};

use std::ops::Range;

use fixedbitset::FixedBitSet;

use crate::flat::{FlatProgram, Hazard, Tolerated};
use crate::semantics::VarId;
use compile::{Limits, compile};
use transpose::transpose;

/// Network that simulates scans of packed states.
pub struct Circuit {
    /// Number of words of a state.
    words: usize,
    /// Word and bit of each input in a state. Inputs are the nodes from 1.
    inputs: Vec<(usize, u32)>,
    gates: Vec<Gate>,
    /// New value of bits of a state: word, bit, wire. Other bits are unchanged.
    outputs: Vec<(usize, u32, Wire)>,
    errors: Vec<(Wire, usize, Hazard)>,
    /// Conditions under which control reaches ranges of lines.
    lines: Vec<(Wire, Range<usize>)>,
}

/// Number of scans computed together.
pub const LANES: usize = 256;

/// Planes of one node: its value in all lanes.
type Planes = [u64; LANES / 64];

/// Reusable memory.
#[derive(Default)]
pub struct Scratch {
    nodes: Vec<Planes>,
}

impl Circuit {
    /// The scan of a program whose variables stand in these fields of states of so many words. Nothing if the interpreter
    /// serves better.
    pub fn of(program: &FlatProgram, tolerated: Tolerated, fields: &[(VarId, Field)], words: usize) -> Option<Self> {
        let (inputs, own) = inputs(program, fields);
        let compiled = compile(program, tolerated, inputs.len(), &own, Limits::for_lanes(program)).ok()?;
        let mut outputs = Vec::new();
        for &(variable, field) in fields {
            let bits = field.positions().zip(&compiled.memory[variable.0]).zip(&own[variable.0]);
            let changed = bits.filter(|((_, wire), own)| wire != own);
            outputs.extend(changed.map(|(((word, bit), &wire), _)| (word, bit, wire)));
        }
        let (gates, errors) = (compiled.network.gates().to_vec(), compiled.errors);
        Some(Self { words, inputs, gates, outputs, errors, lines: Vec::new() }.pruned())
    }

    /// Compiles the scan as [`Circuit::of`] does, but only to find the lines that are executed.
    pub fn of_lines(
        program: &FlatProgram,
        tolerated: Tolerated,
        fields: &[(VarId, Field)],
        words: usize,
    ) -> Option<Self> {
        let (inputs, own) = inputs(program, fields);
        let compiled = compile(program, tolerated, inputs.len(), &own, Limits::for_lanes(program)).ok()?;
        let ends = compiled.lines.iter().skip(1).map(|(line, _)| *line).chain([program.end() + 1]);
        let lines = compiled.lines.iter().zip(ends).map(|(&(line, wire), end)| (wire, line..end)).collect();
        let (gates, outputs, errors) = (compiled.network.gates().to_vec(), Vec::new(), Vec::new());
        Some(Self { words, inputs, gates, outputs, errors, lines }.pruned())
    }

    /// Removes unused gates and inputs.
    fn pruned(mut self) -> Self {
        let first = 1 + self.inputs.len();
        let mut used = vec![false; first + self.gates.len()];
        used[0] = true;
        self.outputs.iter().for_each(|(_, _, wire)| used[wire.node()] = true);
        self.errors.iter().for_each(|(wire, ..)| used[wire.node()] = true);
        self.lines.iter().for_each(|(wire, _)| used[wire.node()] = true);
        for (position, gate) in self.gates.iter().enumerate().rev() {
            if used[first + position] {
                let (Gate::And(a, b) | Gate::Xor(a, b)) = *gate;
                used[a.node()] = true;
                used[b.node()] = true;
            }
        }
        let mut new = vec![0; used.len()];
        let kept = used.iter().enumerate().filter(|(_, used)| **used);
        kept.enumerate().for_each(|(number, (node, _))| new[node] = number);
        let moved = |wire: Wire| wire.at(new[wire.node()]);
        let mut is_used = used.iter().skip(1);
        self.inputs.retain(|_| is_used.next() == Some(&true));
        self.gates.retain(|_| is_used.next() == Some(&true));
        for gate in &mut self.gates {
            *gate = match *gate {
                Gate::And(a, b) => Gate::And(moved(a), moved(b)),
                Gate::Xor(a, b) => Gate::Xor(moved(a), moved(b)),
            };
        }
        self.outputs.iter_mut().for_each(|(_, _, wire)| *wire = moved(*wire));
        self.errors.iter_mut().for_each(|(wire, ..)| *wire = moved(*wire));
        self.lines.iter_mut().for_each(|(wire, _)| *wire = moved(*wire));
        self
    }

    /// Makes of each state, up to [`LANES`] of them one after another, the one at the end of its scan; calls `failed` with each
    /// lane whose scan fails, in ascending order, the line and what happens there. What is left of these means nothing.
    pub fn run(&self, lanes: &mut [u64], scratch: &mut Scratch, mut failed: impl FnMut(usize, usize, Hazard)) {
        let count = lanes.len() / self.words;
        let nodes = self.evaluate(lanes, scratch);
        for group in 0..count.div_ceil(64) {
            self.write(lanes, group, nodes);
        }
        if !self.errors.is_empty() {
            let errors: Vec<Planes> = self.errors.iter().map(|&(wire, ..)| plane(nodes, wire)).collect();
            for lane in 0..count {
                let met = errors.iter().position(|planes| planes[lane / 64] >> (lane % 64) & 1 == 1);
                if let Some(&(_, line, hazard)) = met.map(|error| &self.errors[error]) {
                    failed(lane, line, hazard);
                }
            }
        }
    }

    /// Adds the lines that are executed in a scan from one of up to [`LANES`] states.
    pub fn reach(&self, lanes: &[u64], scratch: &mut Scratch, executed: &mut FixedBitSet) {
        let count = lanes.len() / self.words;
        let nodes = self.evaluate(lanes, scratch);
        for (wire, lines) in &self.lines {
            let planes = plane(nodes, *wire);
            if (0..count).any(|lane| planes[lane / 64] >> (lane % 64) & 1 == 1) {
                executed.insert_range(lines.clone());
            }
        }
    }

    /// Computes all nodes.
    fn evaluate<'s>(&self, lanes: &[u64], scratch: &'s mut Scratch) -> &'s [Planes] {
        let count = lanes.len() / self.words;
        let nodes = &mut scratch.nodes;
        nodes.clear();
        nodes.resize(1 + self.inputs.len() + self.gates.len(), Planes::default());
        for group in 0..count.div_ceil(64) {
            self.read(lanes, group, nodes);
        }
        let first = 1 + self.inputs.len();
        for (position, gate) in self.gates.iter().enumerate() {
            let plane = match *gate {
                Gate::And(a, b) => {
                    let (a, b) = (plane(nodes, a), plane(nodes, b));
                    std::array::from_fn(|group| a[group] & b[group])
                }
                Gate::Xor(a, b) => {
                    let (a, b) = (&nodes[a.node()], &nodes[b.node()]);
                    std::array::from_fn(|group| a[group] ^ b[group])
                }
            };
            nodes[first + position] = plane;
        }
        nodes
    }

    /// Fills the planes of the inputs from a group of lanes.
    fn read(&self, lanes: &[u64], group: usize, nodes: &mut [Planes]) {
        let lanes = &lanes[group * 64 * self.words..];
        let mut inputs = self.inputs.iter().zip(1..).peekable();
        for word in 0..self.words {
            if inputs.peek().is_none_or(|((of, _), _)| *of != word) {
                continue;
            }
            let mut planes = [0; 64];
            planes.iter_mut().zip(lanes.chunks_exact(self.words)).for_each(|(plane, lane)| *plane = lane[word]);
            transpose(&mut planes);
            while let Some((&(_, bit), node)) = inputs.next_if(|((of, _), _)| *of == word) {
                nodes[node][group] = planes[bit as usize];
            }
        }
    }

    /// Writes the planes of the outputs to a group of lanes.
    fn write(&self, lanes: &mut [u64], group: usize, nodes: &[Planes]) {
        let lanes = &mut lanes[group * 64 * self.words..];
        let mut outputs = self.outputs.iter().peekable();
        for word in 0..self.words {
            let (mut planes, mut mask) = ([0; 64], 0);
            while let Some(&(_, bit, wire)) = outputs.next_if(|(of, ..)| *of == word) {
                planes[bit as usize] = plane(nodes, wire)[group];
                mask |= 1 << bit;
            }
            if mask == 0 {
                continue;
            }
            transpose(&mut planes);
            for (lane, plane) in lanes.chunks_exact_mut(self.words).zip(planes) {
                lane[word] = lane[word] & !mask | plane;
            }
        }
    }
}

/// Positions of the bits of all fields, and for each variable the wires of its bits.
fn inputs(program: &FlatProgram, fields: &[(VarId, Field)]) -> (Vec<(usize, u32)>, Vec<Vec<Wire>>) {
    let mut inputs = Vec::new();
    let mut own = vec![Vec::new(); program.variables.len()];
    for &(variable, field) in fields {
        for position in field.positions() {
            own[variable.0].push(Wire::input(inputs.len()));
            inputs.push(position);
        }
    }
    (inputs, own)
}

/// Values of a wire.
#[inline(always)]
fn plane(nodes: &[Planes], wire: Wire) -> Planes {
    let complement = if wire.is_complement() { u64::MAX } else { 0 };
    nodes[wire.node()].map(|word| word ^ complement)
}

//! Many scans at once: a scan as a network of gates, each of which computes one bit of many scans.
//!
//! A lane is one scan. What it begins with is a packed state, its inputs set; what it ends with takes its place. A plane holds
//! one bit of all lanes, so a gate is one instruction of the processor for 64 scans, and the network knows no jumps.

mod compile;
mod gates;
mod memory;
mod numbers;
mod products;
mod scan_gates;
mod transpose;

pub use compile::NoGates;
pub use gates::{Gate, Wire};
pub use scan_gates::{Lanes, ScanGates};

use std::ops::Range;

use fixedbitset::FixedBitSet;

use super::layout::Field;
use super::space::Failure;
use crate::flat::{FlatProgram, Hazard, Tolerated};
use crate::semantics::VarId;
use compile::{Limits, compile};
use transpose::transpose;

/// A scan of packed states.
pub(super) struct Circuit {
    /// Words of a state.
    words: usize,
    /// Where each input is in a state: word and bit. They are nodes from 1.
    inputs: Vec<(usize, u32)>,
    gates: Vec<Gate>,
    /// What each bit of a state becomes: word, bit, wire. Other bits stay as they are.
    outputs: Vec<(usize, u32, Wire)>,
    errors: Vec<(Wire, usize, Hazard)>,
    /// When control comes to these lines.
    lines: Vec<(Wire, Range<usize>)>,
}

/// Scans computed together.
pub(super) const LANES: usize = 256;

/// The planes of one node.
type Planes = [u64; LANES / 64];

/// Memory used again and again.
#[derive(Default)]
pub(super) struct Scratch {
    nodes: Vec<Planes>,
}

impl Circuit {
    /// The scan of a program whose variables stand in these fields of states of so many words. Nothing if the interpreter
    /// serves better.
    pub(super) fn of(
        program: &FlatProgram,
        tolerated: Tolerated,
        fields: &[(VarId, Field)],
        words: usize,
    ) -> Option<Self> {
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

    /// What [`Circuit::of`] gives, but it only tells which lines are executed.
    pub(super) fn of_lines(
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

    /// Without the gates and inputs that nothing depends on.
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

    /// Makes of each state, up to [`LANES`] of them one after another, the one at the end of its scan; calls `failed` for the
    /// lanes whose scans fail, in ascending order. What is left of these means nothing.
    pub(super) fn run(&self, lanes: &mut [u64], scratch: &mut Scratch, mut failed: impl FnMut(usize, Failure)) {
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
                    failed(lane, Failure::Hazard(line, hazard));
                }
            }
        }
    }

    /// Adds the lines that are executed in a scan from one of these states, up to [`LANES`] of them.
    pub(super) fn reach(&self, lanes: &[u64], scratch: &mut Scratch, executed: &mut FixedBitSet) {
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

    /// Gives a group of lanes what their planes say.
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

/// Where the bits of all fields are, and for each variable the wires of its own.
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

/// What a wire gives.
#[inline(always)]
fn plane(nodes: &[Planes], wire: Wire) -> Planes {
    let complement = if wire.is_complement() { u64::MAX } else { 0 };
    nodes[wire.node()].map(|word| word ^ complement)
}

//! Networks of two-input gates (xor-and graphs), with structural hashing and constant propagation.

use rustc_hash::FxHashMap;

/// Output of a node, or its complement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Wire(u32);

impl Wire {
    /// The constant TRUE: the complement of node 0.
    pub const TRUE: Self = Self(1);
    /// The constant FALSE: node 0.
    pub const FALSE: Self = Self(0);

    /// The wire of a network's input, numbered from 0.
    pub(super) fn input(number: usize) -> Self {
        Self((number as u32 + 1) << 1)
    }

    pub(super) fn constant(value: bool) -> Self {
        Self(value.into())
    }

    /// Number of the node.
    #[must_use]
    pub fn node(self) -> usize {
        (self.0 >> 1) as usize
    }

    /// Whether the wire is the complement of its node.
    #[must_use]
    pub fn is_complement(self) -> bool {
        self.0 & 1 == 1
    }

    /// Returns the wire with another node, for a network with renumbered nodes.
    pub(super) fn at(self, node: usize) -> Self {
        Self((node as u32) << 1 | self.0 & 1)
    }
}

impl std::ops::Not for Wire {
    type Output = Self;

    fn not(self) -> Self {
        Self(self.0 ^ 1)
    }
}

/// A gate. The wires of an exclusive or are not complemented.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Gate {
    /// Conjunction.
    And(Wire, Wire),
    /// Exclusive or.
    Xor(Wire, Wire),
}

/// A network under construction. Node 0 is FALSE; then come inputs, then gates in topological order.
pub(super) struct Network {
    inputs: usize,
    gates: Vec<Gate>,
    known: FxHashMap<Gate, u32>,
}

impl Network {
    pub(super) fn new(inputs: usize) -> Self {
        Self { inputs, gates: Vec::new(), known: FxHashMap::default() }
    }

    pub(super) fn gates(&self) -> &[Gate] {
        &self.gates
    }

    fn gate(&mut self, gate: Gate) -> Wire {
        let next = (1 + self.inputs + self.gates.len()) as u32;
        let node = *self.known.entry(gate).or_insert(next);
        if node == next {
            self.gates.push(gate);
        }
        Wire(node << 1)
    }

    pub(super) fn and(&mut self, a: Wire, b: Wire) -> Wire {
        let (a, b) = (a.min(b), a.max(b));
        // The constants are the smallest wires.
        match a {
            Wire::FALSE => a,
            Wire::TRUE => b,
            _ if a == b => a,
            _ if a == !b => Wire::FALSE,
            _ => self.gate(Gate::And(a, b)),
        }
    }

    pub(super) fn or(&mut self, a: Wire, b: Wire) -> Wire {
        !self.and(!a, !b)
    }

    pub(super) fn xor(&mut self, a: Wire, b: Wire) -> Wire {
        let (low, high) = (Wire(a.min(b).0 & !1), Wire(a.max(b).0 & !1));
        let plain = match low {
            _ if low == high => Wire::FALSE,
            Wire::FALSE => high,
            _ => self.gate(Gate::Xor(low, high)),
        };
        Wire(plain.0 ^ (a.0 ^ b.0) & 1)
    }

    /// Multiplexer: `yes` if the condition is TRUE, else `no`.
    pub(super) fn choose(&mut self, condition: Wire, yes: Wire, no: Wire) -> Wire {
        match (yes, no) {
            _ if yes == no => yes,
            _ if yes == !no => self.xor(condition, no),
            (Wire::TRUE, _) => self.or(condition, no),
            (Wire::FALSE, _) => self.and(!condition, no),
            (_, Wire::TRUE) => self.or(!condition, yes),
            (_, Wire::FALSE) => self.and(condition, yes),
            _ => {
                let (yes, no) = (self.and(condition, yes), self.and(!condition, no));
                self.or(yes, no)
            }
        }
    }

    /// Conjunction of wires.
    pub(super) fn all(&mut self, wires: impl IntoIterator<Item = Wire>) -> Wire {
        wires.into_iter().fold(Wire::TRUE, |all, wire| self.and(all, wire))
    }

    /// Disjunction of wires.
    pub(super) fn any(&mut self, wires: impl IntoIterator<Item = Wire>) -> Wire {
        wires.into_iter().fold(Wire::FALSE, |any, wire| self.or(any, wire))
    }
}

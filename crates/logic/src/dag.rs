//! Bound formulas in negation normal form, with shared subformulas, for labelling.
//!
//! Six temporal operators remain, X, U and W under A and E, since `¬E[f U g] = A[¬g W (¬f ∧ ¬g)]` and
//! `¬E[f W g] = A[¬g U (¬f ∧ ¬g)]`, and likewise with A and E exchanged. Sharing avoids the duplication of subformulas.

use std::collections::BTreeMap;

use super::bound::Bound;
use super::formula::Quantifier;

/// Identifier of a node: its position in the [`Dag`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct NodeId(usize);

impl NodeId {
    /// Position in the [`Dag`].
    #[must_use]
    pub fn index(self) -> usize {
        self.0
    }
}

/// Node: a formula in negation normal form whose subformulas are nodes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Node {
    /// State formula or its negation.
    State {
        /// State formula.
        formula: Bound,
        /// Whether the node is the negation of the formula.
        negated: bool,
    },
    /// Conjunction.
    And(NodeId, NodeId),
    /// Disjunction.
    Or(NodeId, NodeId),
    /// AX or EX.
    Next(Quantifier, NodeId),
    /// AU or EU.
    Until(Quantifier, NodeId, NodeId),
    /// AW or EW (weak until).
    WeakUntil(Quantifier, NodeId, NodeId),
}

/// Formulas with shared subformulas, as a directed acyclic graph in topological order: subformulas come first.
#[derive(Clone, Debug, Default)]
pub struct Dag {
    nodes: Vec<Node>,
}

impl Node {
    /// The state formula of the node, if it has one.
    #[must_use]
    pub fn state(&self) -> Option<&Bound> {
        match self {
            Self::State { formula, .. } => Some(formula),
            _ => None,
        }
    }
}

impl Dag {
    /// Whether a node says that something is possible, so that a path shows it.
    #[must_use]
    pub fn is_existential(&self, node: NodeId) -> bool {
        match *self.node(node) {
            Node::State { .. } => false,
            Node::And(f, g) | Node::Or(f, g) => self.is_existential(f) || self.is_existential(g),
            Node::Next(quantifier, _) | Node::Until(quantifier, ..) | Node::WeakUntil(quantifier, ..) => {
                quantifier == Quantifier::Some
            }
        }
    }

    /// All nodes, indexed by [`NodeId`].
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Identifiers of all nodes, subformulas first.
    pub fn ids(&self) -> impl Iterator<Item = NodeId> + use<> {
        (0..self.nodes.len()).map(NodeId)
    }

    /// The node of an identifier.
    #[must_use]
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.0]
    }

    /// Whether a subformula is universal (about all paths), so that no single run can show it.
    #[must_use]
    pub fn is_universal(&self, id: NodeId) -> bool {
        match *self.node(id) {
            Node::State { .. } => false,
            Node::And(f, g) | Node::Or(f, g) => self.is_universal(f) || self.is_universal(g),
            Node::Next(quantifier, f) => quantifier == Quantifier::All || self.is_universal(f),
            Node::Until(quantifier, f, g) | Node::WeakUntil(quantifier, f, g) => {
                quantifier == Quantifier::All || self.is_universal(f) || self.is_universal(g)
            }
        }
    }

    /// Returns the node as a formula.
    #[must_use]
    pub fn formula(&self, id: NodeId) -> Bound {
        let part = |id: &NodeId| Box::new(self.formula(*id));
        let until = |quantifier: &Quantifier, weak, f, g| {
            let (hold, release) = (part(f), part(g));
            Bound::Until { quantifier: *quantifier, weak, hold, release }
        };
        match self.node(id) {
            Node::State { formula, negated: false } => formula.clone(),
            Node::State { formula, negated: true } => Bound::Not(Box::new(formula.clone())),
            Node::And(f, g) => Bound::And(part(f), part(g)),
            Node::Or(f, g) => Bound::Or(part(f), part(g)),
            Node::Next(quantifier, f) => Bound::Next(*quantifier, part(f)),
            Node::Until(quantifier, f, g) => until(quantifier, false, f, g),
            Node::WeakUntil(quantifier, f, g) => until(quantifier, true, f, g),
        }
    }

    /// Adds a formula, or its negation.
    pub fn add(&mut self, formula: &Bound, negated: bool) -> NodeId {
        Builder { dag: self, known: BTreeMap::new() }.build(formula, negated)
    }
}

/// Adds the subformulas of one formula, each once. They are identified by address, which does not change meanwhile.
struct Builder<'d> {
    dag: &'d mut Dag,
    known: BTreeMap<(*const Bound, bool), NodeId>,
}

impl Builder<'_> {
    fn build(&mut self, formula: &Bound, negated: bool) -> NodeId {
        let key = (std::ptr::from_ref(formula), negated);
        if let Some(&id) = self.known.get(&key) {
            return id;
        }
        let node = self.node(formula, negated);
        let id = self.push(node);
        self.known.insert(key, id);
        id
    }

    fn push(&mut self, node: Node) -> NodeId {
        self.dag.nodes.push(node);
        NodeId(self.dag.nodes.len() - 1)
    }

    fn node(&mut self, formula: &Bound, negated: bool) -> Node {
        if formula.is_state_formula() {
            return Node::State { formula: formula.clone(), negated };
        }
        let junction = |and: bool, f, g| if and { Node::And(f, g) } else { Node::Or(f, g) };
        match formula {
            Bound::Not(f) => self.node(f, !negated),
            Bound::And(f, g) => junction(!negated, self.build(f, negated), self.build(g, negated)),
            Bound::Or(f, g) => junction(negated, self.build(f, negated), self.build(g, negated)),
            Bound::Implies(f, g) => junction(negated, self.build(f, !negated), self.build(g, negated)),
            Bound::Iff(f, g) => {
                // f <-> g is (f ∧ g) ∨ (¬f ∧ ¬g); its negation (f ∧ ¬g) ∨ (¬f ∧ g).
                let both = Node::And(self.build(f, false), self.build(g, negated));
                let neither = Node::And(self.build(f, true), self.build(g, !negated));
                Node::Or(self.push(both), self.push(neither))
            }
            Bound::Next(quantifier, f) => {
                let quantifier = if negated { quantifier.dual() } else { *quantifier };
                Node::Next(quantifier, self.build(f, negated))
            }
            Bound::Until { quantifier, weak, hold, release } => {
                let (hold, release) = (self.build(hold, negated), self.build(release, negated));
                match (negated, weak) {
                    (false, false) => Node::Until(*quantifier, hold, release),
                    (false, true) => Node::WeakUntil(*quantifier, hold, release),
                    (true, _) => {
                        let neither = self.push(Node::And(hold, release));
                        let dual = quantifier.dual();
                        if *weak {
                            Node::Until(dual, release, neither)
                        } else {
                            Node::WeakUntil(dual, release, neither)
                        }
                    }
                }
            }
            _ => unreachable!("the others are state formulas, or about paths, which are not labelled"),
        }
    }
}

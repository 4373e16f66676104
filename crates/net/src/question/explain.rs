//! Evidence for a branching-time formula at the initial marking: a run, with runs that branch off.
//!
//! Existential subformulas are shown by a path. Universal subformulas are only stated where they hold.

use fixedbitset::FixedBitSet;

use super::paths::Paths;
use super::replay::Played;
use super::{Branch, Run};
use crate::net::{Tokens, TransitionId};
use petril_logic::{Dag, Labels, Node, NodeId, Quantifier, near_lasso, shortest};

/// Builds a run from the initial marking that shows a node, replayed by the plain firing rule with all claims about
/// single markings; or the contradiction found by the replay.
pub(super) fn explain(paths: &Paths<'_>, dag: &Dag, labels: &Labels, node: NodeId) -> Result<Option<Run>, String> {
    let teller = Teller { paths, dag, labels };
    let tale = teller.tale(node, 0);
    teller.replayed(&tale, &paths.net.initial_tokens()).map(Some)
}

/// Path through the reachability graph with claims.
#[derive(Default)]
struct Tale {
    states: Vec<u32>,
    /// For a lasso, the position that the last state steps back to.
    loop_start: Option<usize>,
    /// State formulas with the positions at which they hold.
    claims: Vec<(usize, NodeId)>,
    /// Temporal subformulas with their positions, and the path that shows an existential one.
    branches: Vec<(usize, NodeId, Option<Tale>)>,
    /// Whether the path ends in a deadlock.
    is_dead: bool,
}

struct Teller<'a> {
    paths: &'a Paths<'a>,
    dag: &'a Dag,
    labels: &'a Labels,
}

impl Teller<'_> {
    fn tale(&self, id: NodeId, state: u32) -> Tale {
        let mut tale = Tale { states: vec![state], ..Tale::default() };
        self.tell(id, &mut tale);
        tale
    }

    fn is_local(&self, id: NodeId) -> bool {
        match *self.dag.node(id) {
            Node::State { .. } => true,
            Node::And(f, g) | Node::Or(f, g) => self.is_local(f) && self.is_local(g),
            _ => false,
        }
    }

    fn holds(&self, id: NodeId, state: u32) -> bool {
        self.labels.of(id).contains(state as usize)
    }

    /// Extends the path to show a node, which holds at its last state.
    fn tell(&self, id: NodeId, tale: &mut Tale) {
        let state = tale.states[tale.states.len() - 1];
        match *self.dag.node(id) {
            Node::State { .. } => tale.claims.push((tale.states.len() - 1, id)),
            Node::And(f, g) => {
                // One path goes on to show what it can; the other part branches off here.
                let (first, then) = if self.dag.is_existential(g) { (f, g) } else { (g, f) };
                if self.is_local(first) {
                    self.tell(first, tale);
                } else {
                    self.branch(first, tale);
                }
                self.tell(then, tale);
            }
            Node::Or(f, g) => {
                let is_better = |f, g| self.is_local(f) || self.dag.is_existential(f) && !self.is_local(g);
                let takes_f = self.holds(f, state) && (!self.holds(g, state) || is_better(f, g));
                self.tell(if takes_f { f } else { g }, tale);
            }
            Node::Next(Quantifier::Some, f) => {
                let next = self.paths.graph.successors(state).iter().find(|&&next| self.holds(f, next));
                tale.states.extend(next);
                self.tell(f, tale);
            }
            Node::Until(Quantifier::Some, f, g) | Node::WeakUntil(Quantifier::Some, f, g) => {
                let goal = |state| self.holds(g, state);
                if let Some(way) = shortest(&self.paths.graph, state, self.labels.of(id), false, goal) {
                    self.walk(f, &way, tale);
                    self.tell(g, tale);
                } else {
                    self.go_round(f, self.labels.of(id), tale);
                }
            }
            _ => self.branch(id, tale),
        }
    }

    fn branch(&self, id: NodeId, tale: &mut Tale) {
        let state = tale.states[tale.states.len() - 1];
        let why = self.dag.is_existential(id).then(|| self.tale(id, state));
        tale.branches.push((tale.states.len() - 1, id, why));
    }

    /// Extends the path along states; the node holds at all of them but the last.
    fn walk(&self, id: NodeId, way: &[u32], tale: &mut Tale) {
        for &state in way {
            if self.is_local(id) {
                tale.claims.push((tale.states.len() - 1, id));
            }
            tale.states.push(state);
        }
    }

    /// Extends the path by a lasso or to a deadlock, within a set of states that all satisfy the node.
    fn go_round(&self, id: NodeId, within: &FixedBitSet, tale: &mut Tale) {
        let knot = tale.states.len() - 1;
        let (graph, state) = (&self.paths.graph, tale.states[knot]);
        let Some(lasso) = near_lasso(graph, within, state) else {
            // No lasso was found; the claim of a deadlock lets the replay refute it.
            tale.is_dead = true;
            return;
        };
        if !self.is_local(id) {
            self.branch(id, tale);
        }
        self.walk(id, &lasso.states, tale);
        if self.is_local(id) {
            tale.claims.push((tale.states.len() - 1, id));
        }
        tale.loop_start = lasso.loop_start.map(|start| knot + start);
        tale.is_dead = lasso.loop_start.is_none();
    }

    /// Replays a path from a marking by the plain firing rule.
    fn replayed(&self, tale: &Tale, from: &Tokens) -> Result<Run, String> {
        let net = self.paths.net;
        let targets = tale.states.iter().skip(1).copied().chain(tale.loop_start.map(|start| tale.states[start]));
        let (mut firings, mut markings) = (Vec::new(), vec![from.clone()]);
        for target in targets {
            let marking = self.paths.exploration.marking(target).ok_or("a state is not there")?;
            let (transition, after) =
                self.step(&markings[markings.len() - 1], &marking).ok_or("a step is not there")?;
            firings.push(transition);
            markings.push(after);
        }
        for &(position, claim) in &tale.claims {
            if !self.is_true(claim, &markings[position]) {
                return Err(format!("marking {position} does not show it"));
            }
        }
        let last = &markings[markings.len() - 1];
        if tale.is_dead && net.transition_ids().any(|transition| net.has_concession(last, transition)) {
            return Err("the last marking is not dead".to_owned());
        }
        let mut branches = Vec::with_capacity(tale.branches.len());
        for (at, node, why) in &tale.branches {
            let run = why.as_ref().map(|why| self.replayed(why, &markings[*at])).transpose()?;
            branches.push(Branch { at: *at, formula: self.dag.formula(*node).simplified(), run });
        }
        Ok(Run { firings, loop_start: tale.loop_start, branches, is_shortest: false })
    }

    /// The transition that leads from a marking to another, and the marking it produces.
    fn step(&self, from: &Tokens, to: &[u64]) -> Option<(TransitionId, Tokens)> {
        let net = self.paths.net;
        net.transition_ids().filter(|&transition| net.has_concession(from, transition)).find_map(|transition| {
            let mut tokens = from.clone();
            net.play(&mut tokens, transition).ok()?;
            net.place_ids().zip(to).all(|(place, &n)| tokens.on(place) == n).then_some((transition, tokens))
        })
    }

    /// Whether a marking satisfies a state formula.
    fn is_true(&self, id: NodeId, tokens: &Tokens) -> bool {
        match self.dag.node(id) {
            Node::State { formula, negated } => formula.holds_in(&Played(self.paths.net, tokens)) == Some(!*negated),
            Node::And(f, g) => self.is_true(*f, tokens) && self.is_true(*g, tokens),
            Node::Or(f, g) => self.is_true(*f, tokens) || self.is_true(*g, tokens),
            _ => false,
        }
    }
}

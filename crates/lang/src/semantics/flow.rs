//! Control flow of a unit, and flow of the current result along it. Computed once for all users.

use petgraph::Direction;
use petgraph::graph::NodeIndex;

use super::Context;
use super::control_flow::{self, ControlFlow};
use super::effect::{Leaves, effect};

/// Flow of an instruction list. Positions are those of its instructions; one more stands for its end.
pub struct Flow {
    pub graph: ControlFlow,
    /// Whether each instruction uses the current result, and the current result after it.
    pub effects: Vec<(bool, Leaves)>,
    /// Whether each position is reachable.
    pub reachable: Vec<bool>,
    /// Whether the current result is live before each position: used by this instruction, or after it before it is
    /// replaced.
    pub needed: Vec<bool>,
}

impl Flow {
    pub fn of(context: &Context<'_>) -> Self {
        let body = &context.pou.body;
        let graph = control_flow::graph(body);
        let effects: Vec<_> = body.iter().map(|instruction| effect(instruction, context)).collect();
        let reachable = control_flow::reachable(&graph);
        let needed = needed(&effects, &graph);
        Self { graph, effects, reachable, needed }
    }
}

fn needed(effects: &[(bool, Leaves)], graph: &ControlFlow) -> Vec<bool> {
    let mut needed: Vec<bool> = effects.iter().map(|(uses, _)| *uses).chain([false]).collect();
    let mut work: Vec<usize> = (0..effects.len()).filter(|&i| needed[i]).collect();
    while let Some(i) = work.pop() {
        for before in graph.neighbors_directed(NodeIndex::new(i), Direction::Incoming) {
            let before = before.index();
            if !needed[before] && effects[before].1 == Leaves::Same {
                needed[before] = true;
                work.push(before);
            }
        }
    }
    needed
}

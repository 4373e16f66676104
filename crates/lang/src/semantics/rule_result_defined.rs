//! The current result is used only where a load has given it a value, on every path of control.
//!
//! Passes: `LD a`, `ST b`.
//! Fails: `ST b` as the first instruction; `ST b` after an `LD a` that a path jumps over.

use petgraph::Direction;
use petgraph::graph::NodeIndex;

use super::Context;
use super::control_flow::ControlFlow;
use super::effect::Leaves;
use super::flow::Flow;
use petril_base::diagnostic::{Code, Diagnostic};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let body = &context.pou.body;
    let Flow { graph, effects, reachable, .. } = context.flow();
    let undefined_after = undefined_after(effects, graph);
    let mut found = Vec::new();
    for (i, instruction) in body.iter().enumerate().filter(|&(i, _)| reachable[i] && effects[i].0) {
        let culprits = graph.neighbors_directed(NodeIndex::new(i), Direction::Incoming);
        let culprit = culprits.map(NodeIndex::index).filter(|&p| reachable[p] && undefined_after[p]).min();
        if i > 0 && culprit.is_none() {
            continue;
        }
        let message = "the current result may have no value here";
        let diagnostic = Diagnostic::new(Code::ResultUndefined, instruction.span, message).here("uses it");
        let diagnostic = match culprit {
            Some(p) if effects[p].1 == Leaves::Nothing => {
                diagnostic.also(body[p].span, "a call of a function block leaves none (IEC 61131-3, 3.2.3)")
            }
            Some(p) => diagnostic.also(body[p].span, "control comes from here without a value"),
            None => diagnostic,
        };
        found.push(diagnostic.help("load a value first, with `LD`"));
    }
    found
}

/// Whether control can leave each instruction while the current result has no value. A use counts as giving it one, so
/// that one missing load is one diagnostic.
fn undefined_after(effects: &[(bool, Leaves)], graph: &ControlFlow) -> Vec<bool> {
    let mut undefined = vec![false; effects.len() + 1];
    let calls = (0..effects.len()).filter(|&i| effects[i].1 == Leaves::Nothing);
    let mut work: Vec<NodeIndex> = [0].into_iter().chain(calls).map(NodeIndex::new).collect();
    while let Some(node) = work.pop() {
        let gives_value = match effects.get(node.index()) {
            Some((_, Leaves::Nothing)) => false,
            Some((uses, leaves)) => *uses || *leaves == Leaves::Value,
            None => true,
        };
        if gives_value || undefined[node.index()] {
            continue;
        }
        undefined[node.index()] = true;
        work.extend(graph.neighbors(node));
    }
    undefined
}

#[cfg(test)]
mod tests {
    use crate::semantics::testing::{lines, program};
    use petril_base::diagnostic::Code;

    #[test]
    fn a_use_before_any_load_is_reported_once() {
        assert_eq!(lines(Code::ResultUndefined, &program("ST q\nST m\nAND i")), [2]);
        assert_eq!(lines(Code::ResultUndefined, &program("RETC\nLD i\nST q")), [2]);
        assert_eq!(lines(Code::ResultUndefined, &program("LD i\nST q\nRETC")), [0; 0]);
    }

    #[test]
    fn a_jump_can_bring_a_result_or_none() {
        assert_eq!(lines(Code::ResultUndefined, &program("JMP on\nback: LD i\non: ST q\nJMPC back")), [4]);
        assert_eq!(lines(Code::ResultUndefined, &program("LD i\nJMPC on\nLD j\non: ST q")), [0; 0]);
    }

    #[test]
    fn unreachable_uses_do_not_count() {
        assert_eq!(lines(Code::ResultUndefined, &program("RET\nST q")), [0; 0]);
    }
}

//! Every computed value is used: stored, tested, or passed on.
//!
//! Passes: `LD a`, `AND b`, `ST c`.
//! Fails: `LD a`, `AND b`, `LD c`: the conjunction is lost.

use petgraph::graph::NodeIndex;

use super::Context;
use super::effect::Leaves;
use super::flow::Flow;
use crate::syntax::ast::Operation;
use petril_base::diagnostic::{Code, Diagnostic};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let body = &context.pou.body;
    let Flow { graph, effects, reachable, needed } = context.flow();
    let lost = body.iter().enumerate().filter(|&(i, _)| {
        effects[i].1 == Leaves::Value
            && reachable[i]
            && !graph.neighbors(NodeIndex::new(i)).any(|next| needed[next.index()])
    });
    // A function of the file may be called for its outputs.
    let lost = lost.filter(|(_, instruction)| !matches!(instruction.operation, Some(Operation::Function { .. })));
    lost.map(|(_, instruction)| {
        Diagnostic::new(Code::ResultNotUsed, instruction.span, "the value computed here is never used")
            .help("store it with `ST`, or remove the instructions that compute it")
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use crate::semantics::testing::{lines, program};
    use petril_base::diagnostic::Code;

    #[test]
    fn lost_values_are_reported_where_they_are_complete() {
        assert_eq!(lines(Code::ResultNotUsed, &program("LD i\nAND j\nLD m\nST q\nLD i\nAND( j\n)")), [3, 7]);
        assert_eq!(lines(Code::ResultNotUsed, &program("LD i\nJMPC on\nLD j\non: ST q\nLD m\nJMPC end\nend:")), [0; 0]);
        assert_eq!(lines(Code::ResultNotUsed, &program("LD i\nST q\nST m")), [0; 0], "it may be stored twice");
    }
}

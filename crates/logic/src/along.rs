//! Evaluation of formulas along one run.

use super::bound::Bound;
use super::dag::{Dag, Node, NodeId};
use super::formula::Quantifier;

/// Evaluates each node of a [`Dag`] at each position of a run of `length` states. The last state steps back to the one
/// at `loop_start`; without a loop the continuation is unknown, and a node holds only if it does for every
/// continuation.
///
/// Nodes under E are evaluated on this run alone. `holds` says whether a state formula holds at a position,
/// `everywhere` whether a node under A does, which no run can show.
#[must_use]
pub fn along(
    dag: &Dag,
    (length, loop_start): (usize, Option<usize>),
    holds: &dyn Fn(&Bound, usize) -> bool,
    everywhere: &dyn Fn(NodeId, usize) -> bool,
) -> Vec<Vec<bool>> {
    let mut truths: Vec<Vec<bool>> = Vec::with_capacity(dag.nodes().len());
    for id in dag.ids() {
        let of = |id: &NodeId| &truths[id.index()];
        let each = |truth: &dyn Fn(usize) -> bool| (0..length).map(truth).collect::<Vec<bool>>();
        truths.push(match dag.node(id) {
            Node::State { formula, negated } => each(&|at| holds(formula, at) != *negated),
            Node::And(f, g) => each(&|at| of(f)[at] && of(g)[at]),
            Node::Or(f, g) => each(&|at| of(f)[at] || of(g)[at]),
            Node::Next(Quantifier::Some, f) => {
                each(&|at| if at + 1 < length { of(f)[at + 1] } else { loop_start.is_some_and(|start| of(f)[start]) })
            }
            Node::Until(Quantifier::Some, f, g) => until(of(f), of(g), loop_start, false),
            Node::WeakUntil(Quantifier::Some, f, g) => until(of(f), of(g), loop_start, true),
            Node::Next(Quantifier::All, _)
            | Node::Until(Quantifier::All, ..)
            | Node::WeakUntil(Quantifier::All, ..) => each(&|at| everywhere(id, at)),
        });
    }
    truths
}

/// Evaluates U, or W if `for_ever`, at each position.
fn until(hold: &[bool], release: &[bool], loop_start: Option<usize>, for_ever: bool) -> Vec<bool> {
    let mut truths = vec![false; hold.len()];
    let mut next = loop_start.is_some() && for_ever;
    // In the second pass, the value at the beginning of the loop is known.
    for _ in 0..2 {
        for at in (0..hold.len()).rev() {
            truths[at] = release[at] || (hold[at] && next);
            next = truths[at];
        }
        next = loop_start.is_some_and(|start| truths[start]);
    }
    truths
}

#[cfg(test)]
mod tests {
    use super::until;

    /// Result as digits, one for each position: 1 if the formula holds.
    fn shown(hold: &str, release: &str, loop_start: Option<usize>, for_ever: bool) -> String {
        let bits = |text: &str| text.chars().map(|c| c == '1').collect::<Vec<_>>();
        until(&bits(hold), &bits(release), loop_start, for_ever)
            .into_iter()
            .map(|b| if b { '1' } else { '0' })
            .collect()
    }

    #[test]
    fn an_open_end_promises_nothing() {
        assert_eq!(shown("1101", "0010", None, false), "1110");
        assert_eq!(shown("1101", "0010", None, true), "1110");
        assert_eq!(shown("1111", "0000", None, true), "0000");
    }

    #[test]
    fn a_loop_goes_round() {
        // The release at position 1 comes again after the end.
        assert_eq!(shown("1111", "0100", Some(0), false), "1111");
        assert_eq!(shown("1101", "0100", Some(1), false), "1101");
        assert_eq!(shown("1111", "1000", Some(1), false), "1000");
        assert_eq!(shown("1111", "0000", Some(1), false), "0000");
        assert_eq!(shown("1111", "0000", Some(1), true), "1111");
        assert_eq!(shown("0111", "0000", Some(1), true), "0111");
        assert_eq!(shown("1101", "0000", Some(1), true), "0000");
        assert_eq!(shown("0111", "0000", Some(0), true), "0000");
    }
}

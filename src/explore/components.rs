//! Strongly connected components of a part of a graph (Tarjan 1972, with an explicit stack).

use fixedbitset::FixedBitSet;

use super::graph::Graph;

/// The strongly connected components of a part of a graph.
pub struct Components {
    /// The component of each state; [`Components::NONE`] outside the part.
    pub of: Vec<u32>,
    /// How many components there are. A component's number exceeds those of the components it leads to.
    pub count: usize,
    /// Components with a cycle: more than one state, or a state with a step to itself.
    pub cyclic: FixedBitSet,
}

impl Components {
    /// Stands for "outside the part".
    pub const NONE: u32 = u32::MAX;

    /// Whether a state lies on a cycle within the part.
    #[must_use]
    pub fn on_cycle(&self, state: u32) -> bool {
        let component = self.of[state as usize];
        component != Self::NONE && self.cyclic.contains(component as usize)
    }
}

/// The components of the states in `part`, steps out of it left aside.
#[must_use]
pub fn components(graph: &Graph, part: &FixedBitSet) -> Components {
    let n = graph.len();
    let mut result = Components { of: vec![Components::NONE; n], count: 0, cyclic: FixedBitSet::with_capacity(n) };
    // 0 stands for "not seen".
    let mut order = vec![0_u32; n];
    let mut low = vec![0_u32; n];
    let mut seen = 0;
    let mut stack: Vec<u32> = Vec::new();
    let mut path: Vec<(u32, usize)> = Vec::new();
    for root in part.ones() {
        if order[root] != 0 {
            continue;
        }
        path.push((root as u32, 0));
        while let Some(&mut (state, ref mut next)) = path.last_mut() {
            let s = state as usize;
            if *next == 0 {
                seen += 1;
                (order[s], low[s]) = (seen, seen);
                stack.push(state);
            }
            let unseen = graph.successors(state)[*next..].iter().position(|&t| {
                let t = t as usize;
                if !part.contains(t) {
                    return false;
                }
                if order[t] != 0 && result.of[t] == Components::NONE {
                    low[s] = low[s].min(order[t]);
                }
                order[t] == 0
            });
            if let Some(offset) = unseen {
                let target = graph.successors(state)[*next + offset];
                *next += offset + 1;
                path.push((target, 0));
                continue;
            }
            path.pop();
            if let Some(&(parent, _)) = path.last() {
                low[parent as usize] = low[parent as usize].min(low[s]);
            }
            if low[s] == order[s] {
                close(graph, state, &mut stack, &mut result);
            }
        }
    }
    result
}

/// Takes the component whose first state is `root` off the stack.
fn close(graph: &Graph, root: u32, stack: &mut Vec<u32>, result: &mut Components) {
    let component = result.count as u32;
    let start = stack.iter().rposition(|&state| state == root).unwrap_or(0);
    let members = stack.split_off(start);
    for &state in &members {
        result.of[state as usize] = component;
    }
    if members.len() > 1 || graph.successors(root).contains(&root) {
        result.cyclic.insert(component as usize);
    }
    result.count += 1;
}

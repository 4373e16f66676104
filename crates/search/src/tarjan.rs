//! Tarjan's algorithm for strongly connected components (1972), with an explicit stack: graphs of states are deep.

use std::sync::atomic::{AtomicBool, Ordering};

use fixedbitset::FixedBitSet;

/// Component number of nodes outside the part.
pub const NONE: u32 = u32::MAX;

/// Computes the component of each of `n` nodes ([`NONE`] for nodes outside `part`) and the number of components. A
/// component's number exceeds those of the components it leads to. `None` if `stopping` is set meanwhile.
pub fn tarjan<'g>(
    n: usize,
    part: &FixedBitSet,
    successors: impl Fn(u32) -> &'g [u32],
    stopping: &AtomicBool,
) -> Option<(Vec<u32>, usize)> {
    let mut component = vec![NONE; n];
    let mut count = 0;
    // Discovery order of nodes (0: not seen), and low links: the smallest order known to be in the same component.
    let (mut order, mut low) = (vec![0_u32; n], vec![0_u32; n]);
    let mut seen = 0;
    let mut stack: Vec<u32> = Vec::new();
    let mut path: Vec<(u32, usize)> = Vec::new();
    for root in part.ones() {
        if order[root] != 0 {
            continue;
        }
        path.push((root as u32, 0));
        while let Some(&mut (node, ref mut next)) = path.last_mut() {
            let v = node as usize;
            if *next == 0 {
                if seen % 4096 == 0 && stopping.load(Ordering::Relaxed) {
                    return None;
                }
                seen += 1;
                (order[v], low[v]) = (seen, seen);
                stack.push(node);
            }
            let unseen = successors(node)[*next..].iter().position(|&target| {
                let t = target as usize;
                if !part.contains(t) {
                    return false;
                }
                if order[t] != 0 && component[t] == NONE {
                    low[v] = low[v].min(order[t]);
                }
                order[t] == 0
            });
            if let Some(offset) = unseen {
                let target = successors(node)[*next + offset];
                *next += offset + 1;
                path.push((target, 0));
                continue;
            }
            path.pop();
            if let Some(&(parent, _)) = path.last() {
                low[parent as usize] = low[parent as usize].min(low[v]);
            }
            if low[v] == order[v] {
                // The node is the root of its component, whose other nodes lie above it on the stack.
                while let Some(member) = stack.pop() {
                    component[member as usize] = count;
                    if member == node {
                        break;
                    }
                }
                count += 1;
            }
        }
    }
    Some((component, count as usize))
}

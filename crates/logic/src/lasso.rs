//! Lassos: infinite paths made of a stem and a cycle.

use fixedbitset::FixedBitSet;
use rustc_hash::FxHashMap;

use super::fairness::{Constraints, endings};
use petril_search::{Graph, components};

/// A lasso, or a path that ends in a state without steps.
pub struct Lasso {
    /// States without the first one.
    pub states: Vec<u32>,
    /// Number of steps to the state to which the last one steps back.
    pub loop_start: Option<usize>,
}

/// Finds a lasso inside a set that satisfies the constraints, or a path to a state without steps: a shortest stem, and
/// a cycle, which is a shortest one if there are no constraints.
pub(super) fn lasso(
    graph: &Graph,
    within: &FixedBitSet,
    constraints: Option<&Constraints>,
    state: u32,
) -> Option<Lasso> {
    let endings = endings(graph, within, constraints);
    let mut states = shortest(graph, state, within, false, |s| endings.contains(s as usize))?;
    let round = round(graph, &endings, constraints, states.last().copied().unwrap_or(state))?;
    let loop_start = round.loop_start.map(|start| states.len() + start);
    states.extend_from_slice(&round.states);
    Some(Lasso { states, loop_start })
}

/// Finds a lasso from one of the [`endings`] within its strongly connected component.
///
/// The path goes to a nearest state of a set not yet visited, as long as there is one, and then back to a state of the
/// path after which all sets were visited.
pub(super) fn round(
    graph: &Graph,
    endings: &FixedBitSet,
    constraints: Option<&Constraints>,
    knot: u32,
) -> Option<Lasso> {
    if graph.successors(knot).is_empty() {
        return Some(Lasso { states: Vec::new(), loop_start: None });
    }
    let parts = components(graph, endings);
    let mut inside = FixedBitSet::with_capacity(graph.len());
    inside.extend(endings.ones().filter(|&state| parts.of[state] == parts.of[knot as usize]));
    let mut wanted: Vec<&FixedBitSet> = constraints.map_or(Vec::new(), |constraints| constraints.weak.iter().collect());
    let mut walk = vec![knot];
    loop {
        let last_visit = |set: &FixedBitSet| walk.iter().rposition(|&state| set.contains(state as usize));
        let missing: Vec<&FixedBitSet> = wanted.iter().copied().filter(|set| last_visit(set).is_none()).collect();
        let at = walk[walk.len() - 1];
        if !missing.is_empty() {
            let is_missing = |state: u32| missing.iter().any(|set| set.contains(state as usize));
            walk.extend(shortest(graph, at, &inside, false, is_missing)?);
            continue;
        }
        // All sets are visited from this position on; stepping back to it repeats the fewest states.
        let latest = wanted.iter().filter_map(|set| last_visit(set)).min().unwrap_or(walk.len() - 1);
        let back = match graph.successors(at).contains(&walk[latest]) {
            true => vec![walk[latest]],
            false => shortest(graph, at, &inside, true, |state| walk[..=latest].contains(&state))?,
        };
        let (target, way) = back.split_last()?;
        let start = walk[..=latest].iter().rposition(|state| state == target)?;
        walk.extend_from_slice(way);
        let owed = constraints.into_iter().flat_map(|constraints| constraints.owed(&walk[start..]));
        let before = wanted.len();
        wanted.extend(owed);
        if wanted.len() == before {
            return Some(Lasso { states: walk[1..].to_vec(), loop_start: Some(start) });
        }
    }
}

/// Maximum number of states that [`near_lasso`] searches.
const NEAR: usize = 10_000;

/// Finds a lasso in a set whose every state has a step into the set, or no step at all: one whose last state steps back
/// to a state on the shortest path to it, if there is one among the nearest states, otherwise any.
#[must_use]
pub fn near_lasso(graph: &Graph, within: &FixedBitSet, state: u32) -> Option<Lasso> {
    let mut parents: FxHashMap<u32, (u32, usize)> = FxHashMap::from_iter([(state, (state, 0))]);
    let mut queue = vec![state];
    let mut next = 0;
    let way = |parents: &FxHashMap<u32, (u32, usize)>, end: u32| {
        let before = |&at: &u32| Some(parents[&at].0).filter(|&parent| parent != at);
        let mut way: Vec<u32> = std::iter::successors(Some(end), before).collect();
        way.reverse();
        way
    };
    while let Some(&from) = queue.get(next) {
        next += 1;
        let depth = parents[&from].1;
        if graph.row_of(from).is_some() && graph.successors(from).is_empty() {
            return Some(Lasso { states: way(&parents, from)[1..].to_vec(), loop_start: None });
        }
        for &target in graph.successors(from).iter().filter(|&&target| within.contains(target as usize)) {
            if let Some(&(_, above)) = parents.get(&target) {
                let states = if above <= depth { way(&parents, from) } else { Vec::new() };
                if states.get(above) == Some(&target) {
                    return Some(Lasso { states: states[1..].to_vec(), loop_start: Some(above) });
                }
            } else if parents.len() < NEAR {
                parents.insert(target, (from, depth + 1));
                queue.push(target);
            }
        }
    }
    wandering(graph, within, state)
}

/// Path that always steps to the state with the smallest number, which is seldom far from the initial one.
fn wandering(graph: &Graph, within: &FixedBitSet, state: u32) -> Option<Lasso> {
    let mut positions: FxHashMap<u32, usize> = FxHashMap::from_iter([(state, 0)]);
    let mut states = vec![state];
    loop {
        let successors = graph.successors(states[states.len() - 1]);
        if successors.is_empty() {
            return Some(Lasso { states: states[1..].to_vec(), loop_start: None });
        }
        let next = successors.iter().copied().filter(|&next| within.contains(next as usize)).min()?;
        if let Some(&start) = positions.get(&next) {
            return Some(Lasso { states: states[1..].to_vec(), loop_start: Some(start) });
        }
        positions.insert(next, states.len());
        states.push(next);
    }
}

/// Finds a shortest path inside a set to a state that satisfies `goal`; returns it without the first state. With
/// `leave`, the path has at least one step.
#[must_use]
pub fn shortest(
    graph: &Graph,
    from: u32,
    within: &FixedBitSet,
    leave: bool,
    goal: impl Fn(u32) -> bool,
) -> Option<Vec<u32>> {
    if !leave && goal(from) {
        return Some(Vec::new());
    }
    let mut parents: FxHashMap<u32, u32> = FxHashMap::default();
    let mut gone = FixedBitSet::with_capacity(graph.rows());
    let mut queue = vec![from];
    let mut next = 0;
    while let Some(&state) = queue.get(next) {
        next += 1;
        if graph.row_of(state).is_none_or(|row| gone.put(row as usize)) {
            continue;
        }
        for &target in graph.successors(state) {
            if !within.contains(target as usize) || parents.contains_key(&target) {
                continue;
            }
            parents.insert(target, state);
            if goal(target) {
                let mut path = vec![target];
                while parents[&path[path.len() - 1]] != from {
                    path.push(parents[&path[path.len() - 1]]);
                }
                path.reverse();
                return Some(path);
            }
            queue.push(target);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use petril_search::Stop;

    /// The whole graph with these successors.
    fn graph(successors: &[&[u32]]) -> Graph {
        let ends = successors.iter().scan(0, |end, row| {
            *end += row.len() as u64;
            Some(*end)
        });
        let starts = std::iter::once(0).chain(ends).collect();
        Graph::of_rows(successors.len(), starts, successors.concat(), Stop::Complete)
    }

    /// The lasso from state 0 inside these states, or inside all.
    fn near(successors: &[&[u32]], within: &[usize]) -> Option<(Vec<u32>, Option<usize>)> {
        let mut set = FixedBitSet::with_capacity(successors.len());
        set.extend(within.iter().copied());
        set.insert_range(if within.is_empty() { 0..successors.len() } else { 0..0 });
        near_lasso(&graph(successors), &set, 0).map(|lasso| (lasso.states, lasso.loop_start))
    }

    #[test]
    fn a_near_lasso_comes_back_to_its_own_way() {
        assert_eq!(near(&[&[0]], &[]), Some((vec![], Some(0))));
        assert_eq!(near(&[&[1], &[1]], &[]), Some((vec![1], Some(1))));
        assert_eq!(near(&[&[1], &[2], &[0]], &[]), Some((vec![1, 2], Some(0))));
        assert_eq!(near(&[&[1], &[2], &[1]], &[]), Some((vec![1, 2], Some(1))));
        assert_eq!(near(&[&[1], &[2], &[]], &[]), Some((vec![1, 2], None)), "paths may end");
        // State 1 has a shorter loop, and is not inside.
        assert_eq!(near(&[&[1, 2], &[1], &[0]], &[]), Some((vec![1], Some(1))));
        assert_eq!(near(&[&[1, 2], &[1], &[0]], &[0, 2]), Some((vec![2], Some(0))));
        // The step from 1 to 2 leads to a known state that is not on the way to 1.
        assert_eq!(near(&[&[1, 2], &[2], &[3], &[2]], &[]), Some((vec![2, 3], Some(1))));
    }

    /// Each state of the loop 1, 2, 3 is reached by a way that the loop does not come back to.
    #[test]
    fn any_lasso_serves_where_none_comes_back_to_its_way() {
        assert_eq!(near(&[&[1, 2], &[2], &[3], &[1]], &[]), Some((vec![1, 2, 3], Some(1))));
        assert_eq!(near(&[&[4, 2, 1], &[2], &[3], &[1], &[4]], &[0, 1, 2, 3]), Some((vec![1, 2, 3], Some(1))));
        // State 1, the least, is not inside.
        let rows: [&[u32]; 5] = [&[1, 2, 3], &[1], &[3], &[4], &[2]];
        assert_eq!(near(&rows, &[0, 2, 3, 4]), Some((vec![2, 3, 4], Some(1))));
        // A loop and an end beyond the nearest states.
        let far = (NEAR + 5) as u32;
        for (last, loop_start) in [(vec![far - 1], Some(NEAR + 4)), (vec![], None)] {
            let mut rows: Vec<Vec<u32>> = (1..=far).map(|next| vec![next]).collect();
            rows.push(last);
            let rows: Vec<&[u32]> = rows.iter().map(Vec::as_slice).collect();
            assert_eq!(near(&rows, &[]), Some(((1..=far).collect(), loop_start)));
        }
    }
}

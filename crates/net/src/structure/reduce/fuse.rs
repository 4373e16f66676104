//! Fusion of places between which tokens move freely.
//!
//! Transitions that take one token from one place and put one on another, with no other arc, are *moves*. Places that
//! are not kept and are strongly connected by moves become one place, since a token on one of them can be moved to
//! wherever it is needed. The moves become self-loops of that place. So the markings reachable elsewhere stay the same.
//! In a dead marking the places are empty, since otherwise a move could fire; and as long as the new place has a token,
//! a loop can fire. Keeps reachability and deadlocks.
//!
//! Source: fusion of equivalent places, Berthelot 1987; state machine components, Thierry-Mieg 2020.

use petgraph::algo::kosaraju_scc;
use petgraph::graph::{DiGraph, NodeIndex};

use super::draft::{Draft, Row, sum};
use super::log::{Around, Step};
use super::{MANY, Property, Rule};

pub fn apply(draft: &mut Draft) {
    if draft.property == Property::Paths {
        return;
    }
    let moves: Vec<(u32, u32, u32)> = draft.transition_ids().filter_map(|id| as_move(draft, id)).collect();
    let mut places: Vec<u32> = moves.iter().flat_map(|&(from, to, _)| [from, to]).collect();
    places.sort_unstable();
    places.dedup();
    let position = |place: u32| places.binary_search(&place).unwrap_or_default();
    let mut graph: DiGraph<u32, ()> = DiGraph::new();
    places.iter().for_each(|&place| _ = graph.add_node(place));
    for &(from, to, _) in &moves {
        graph.add_edge(NodeIndex::new(position(from)), NodeIndex::new(position(to)), ());
    }
    draft.spend(draft.transitions.len() + moves.len());
    for circle in kosaraju_scc(&graph).into_iter().filter(|circle| circle.len() > 1) {
        let mut circle: Vec<u32> = circle.into_iter().map(|node| graph[node]).collect();
        circle.sort_unstable();
        fuse(draft, &circle);
    }
}

fn as_move(draft: &Draft, id: u32) -> Option<(u32, u32, u32)> {
    let row = draft.transition(id);
    let ([(from, 1)], [(to, 1)]) = (&row.pre[..], &row.post[..]) else { return None };
    let is_free = from != to && !draft.place(*from).is_kept && !draft.place(*to).is_kept;
    is_free.then_some((*from, *to, id))
}

/// Fuses several places, given in ascending order, into one.
fn fuse(draft: &mut Draft, circle: &[u32]) {
    let [into, others @ ..] = circle else { return };
    let tokens = circle.iter().try_fold(0_u64, |sum, &place| sum.checked_add(draft.place(place).tokens));
    let Some(tokens) = tokens.filter(|&tokens| tokens < MANY) else { return };
    let around = Around::of(draft, circle);
    let fused = |row: &Row| -> Option<Row> {
        let inside = |place: u32| circle.binary_search(&place).is_ok();
        sum([&row.iter().map(|&(place, weight)| (if inside(place) { *into } else { place }, weight)).collect()]
            .into_iter())
    };
    let rows = around.transitions.iter().map(|&(id, ..)| {
        let row = draft.transition(id);
        Some((id, fused(&row.pre)?, fused(&row.post)?))
    });
    let Some(rows) = rows.collect::<Option<Vec<(u32, Row, Row)>>>() else { return };
    draft.spend(rows.len() * 4);
    let position = |place: u32| circle.binary_search(&place).ok();
    let moves = around.transitions.iter().filter_map(|&(id, ..)| {
        let (from, to, id) = as_move(draft, id)?;
        Some((position(from)?, position(to)?, id))
    });
    let moves = moves.collect();
    draft.log.step(Step::Fused { moves, around });
    draft.places[*into as usize].tokens = tokens;
    rows.into_iter().for_each(|(id, pre, post)| draft.rewrite(id, pre, post));
    others.iter().for_each(|&place| draft.remove_place(place));
    draft.count(Rule::Fusion, circle.len());
}

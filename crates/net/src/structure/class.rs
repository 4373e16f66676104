//! Structural classes of nets.

use std::collections::BTreeMap;

use super::flow::Flow;
use crate::net::Net;

/// Structural classes of a net. A read arc counts as a self-loop of two arcs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Class {
    /// Whether every arc has weight 1.
    pub ordinary: bool,
    /// Whether every arc from a place to a transition has weight 1.
    pub single_inputs: bool,
    /// Whether no place is in both the preset and the postset of a transition (no self-loops).
    pub pure: bool,
    /// Whether the net is ordinary, and every transition has exactly one input and one output place.
    pub state_machine: bool,
    /// Whether the net is ordinary, and every place has exactly one producer and one consumer: no choice.
    pub marked_graph: bool,
    /// Whether the net is ordinary, and transitions that share an input place have no other one.
    pub free_choice: bool,
    /// Whether the net is ordinary, and transitions that share an input place have equal presets.
    pub extended_free_choice: bool,
    /// Whether every firing keeps the total number of tokens.
    pub keeps_tokens: bool,
}

impl Class {
    /// Determines the classes of a net.
    #[must_use]
    pub fn of(net: &Net, flow: &Flow) -> Self {
        let single_inputs = net.transition_ids().all(|id| net.pre(id).all(|(_, weight)| weight == 1));
        let ordinary = single_inputs && net.transition_ids().all(|id| net.post(id).all(|(_, weight)| weight == 1));
        let one = |list: &[u32]| list.len() == 1;
        let transitions = || 0..flow.transitions();
        let places = || 0..flow.places();
        let sum = |list: &mut dyn Iterator<Item = u64>| list.map(u128::from).sum::<u128>();
        Self {
            ordinary,
            single_inputs,
            pure: net.read_arc_count() == 0,
            state_machine: ordinary && transitions().all(|id| one(&flow.inputs[id]) && one(&flow.outputs[id])),
            marked_graph: ordinary && places().all(|place| one(&flow.producers[place]) && one(&flow.consumers[place])),
            free_choice: ordinary
                && transitions().all(|id| {
                    one(&flow.inputs[id]) || flow.inputs[id].iter().all(|&p| one(&flow.consumers[p as usize]))
                }),
            extended_free_choice: ordinary && choices_are_free(flow),
            keeps_tokens: net.transition_ids().all(|id| {
                sum(&mut net.taken(id).map(|(_, weight)| weight)) == sum(&mut net.put(id).map(|(_, weight)| weight))
            }),
        }
    }
}

/// Whether all inputs of each transition have the same consumers.
fn choices_are_free(flow: &Flow) -> bool {
    let mut kinds: BTreeMap<&[u32], usize> = BTreeMap::new();
    let kind_of: Vec<usize> = (0..flow.places())
        .map(|place| {
            let next = kinds.len();
            *kinds.entry(&flow.consumers[place]).or_insert(next)
        })
        .collect();
    (0..flow.transitions()).all(|id| {
        let mut kinds = flow.inputs[id].iter().map(|&place| kind_of[place as usize]);
        kinds.next().is_none_or(|first| kinds.all(|kind| kind == first))
    })
}

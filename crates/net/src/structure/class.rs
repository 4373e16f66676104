//! Classes of nets, by the shape of their arcs.

use std::collections::BTreeMap;

use super::flow::Flow;
use crate::net::Net;

/// To which classes a net belongs. A read arc counts as two arcs, as if its tokens were taken and put back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Class {
    /// Every arc has weight 1.
    pub ordinary: bool,
    /// Every arc to a transition has weight 1.
    pub single_inputs: bool,
    /// No transition puts tokens on a place that it needs tokens of.
    pub pure: bool,
    /// Ordinary, and every transition has one input and one output: tokens wander.
    pub state_machine: bool,
    /// Ordinary, and every place has one producer and one consumer: no choice.
    pub marked_graph: bool,
    /// Ordinary, and of two transitions that share an input neither has another one.
    pub free_choice: bool,
    /// Ordinary, and transitions that share an input have all inputs in common.
    pub extended_free_choice: bool,
    /// Every firing leaves the number of tokens as it is.
    pub keeps_tokens: bool,
}

impl Class {
    /// The classes of a net.
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

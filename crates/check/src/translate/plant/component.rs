//! Device of the plant: a connected net, its markings, and its nodes in the system net.

use crate::translate::provenance::{PlaceRole, TransitionRole};
use crate::translate::weaver::Weaver;
use petril_lang::semantics::VarId;
use petril_net::net::{Arcs, PlaceId};

/// Connected component of a plant net.
#[derive(Clone, Debug)]
pub struct Component {
    /// Name of the net, numbered if the net has several components.
    pub name: String,
    /// Places of the component.
    pub places: Vec<PlantPlace>,
    /// Transitions of the component.
    pub transitions: Vec<PlantTransition>,
    /// Reachable markings if outputs may have any value; the first is the initial one.
    pub markings: Vec<LocalMarking>,
}

/// Place of the plant.
#[derive(Clone, Debug)]
pub struct PlantPlace {
    /// Name in the system net: `net.place`.
    pub name: String,
    /// Whether the place is marked initially.
    pub marked: bool,
    /// External values of inputs while the place is marked.
    pub drives: Vec<(VarId, u64)>,
}

/// Transition of the plant. Places are positions in [`Component::places`].
#[derive(Clone, Debug)]
pub struct PlantTransition {
    /// Name in the system net: `net.transition`.
    pub name: String,
    /// Places from which the transition removes a token.
    pub consume: Vec<usize>,
    /// Places to which the transition adds a token.
    pub produce: Vec<usize>,
    /// Places that must be marked (read arcs).
    pub read: Vec<usize>,
    /// Values that outputs must have.
    pub tests: Vec<(VarId, u64)>,
}

impl PlantTransition {
    /// Whether the transition tests an output for two values at once.
    fn contradicts_itself(&self) -> bool {
        let differs = |&(output, value): &(VarId, u64)| self.tests.iter().any(|&(o, v)| o == output && v != value);
        self.tests.iter().any(differs)
    }
}

/// Reachable marking of a component.
#[derive(Clone, Debug)]
pub struct LocalMarking {
    /// Marked places, ascending.
    pub marked: Vec<usize>,
    /// External values: one for each input that the component drives.
    pub inputs: Vec<(VarId, u64)>,
    /// Firings from the marking, each possible if the outputs that the transition tests have the right values.
    pub moves: Vec<Move>,
}

/// Firing of a transition in a component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Move {
    /// Position in [`Component::transitions`].
    pub transition: usize,
    /// Position in [`Component::markings`].
    pub target: usize,
}

impl Component {
    /// Whether the component drives an input.
    #[must_use]
    pub fn drives(&self, input: VarId) -> bool {
        self.places.iter().any(|place| place.drives.iter().any(|&(variable, _)| variable == input))
    }

    /// Dead transitions, by position: whatever the outputs are, no reachable marking enables them.
    #[must_use]
    pub fn dead_transitions(&self) -> Vec<usize> {
        let mut fires = vec![false; self.transitions.len()];
        self.markings.iter().flat_map(|marking| &marking.moves).for_each(|step| fires[step.transition] = true);
        let (transitions, fires) = (&self.transitions, &fires);
        (0..fires.len()).filter(|&position| !fires[position] || transitions[position].contradicts_itself()).collect()
    }

    /// Markings reachable from `from` by any number of moves while the outputs keep their values, each with its
    /// predecessor and the move that first led there; in breadth-first order, `from` itself first.
    #[must_use]
    pub fn closure(&self, from: usize, output: impl Fn(VarId) -> u64) -> Vec<(usize, Option<(usize, Move)>)> {
        let mut reached = vec![(from, None)];
        let mut seen = vec![false; self.markings.len()];
        seen[from] = true;
        let mut next = 0;
        while let Some(&(marking, _)) = reached.get(next) {
            next += 1;
            for &step in &self.markings[marking].moves {
                let enabled = self.transitions[step.transition].tests.iter().all(|&(v, value)| output(v) == value);
                if enabled && !seen[step.target] {
                    seen[step.target] = true;
                    reached.push((step.target, Some((marking, step))));
                }
            }
        }
        reached
    }

    /// Shortest sequence of transitions, by position, from one marking to another.
    #[must_use]
    pub fn path(&self, from: usize, to: usize, output: impl Fn(VarId) -> u64) -> Option<Vec<usize>> {
        let closure = self.closure(from, output);
        let mut path = Vec::new();
        let mut at = to;
        while at != from {
            let (_, Some((earlier, step))) = closure.iter().find(|(marking, _)| *marking == at)? else { return None };
            path.push(step.transition);
            at = *earlier;
        }
        path.reverse();
        Some(path)
    }

    /// Adds the blocking place, whose token lets the component move. A component without transitions needs none.
    pub(in crate::translate) fn add_blocking_place(&self, weaver: &mut Weaver, index: usize) -> Option<PlaceId> {
        let name = format!("block_{}", self.name);
        (!self.transitions.is_empty()).then(|| weaver.place(&name, true, PlaceRole::Blocking(index)))
    }

    /// Adds the places of the component.
    pub(in crate::translate) fn add_places(&self, weaver: &mut Weaver, index: usize) -> Vec<PlaceId> {
        self.places.iter().map(|place| weaver.place(&place.name, place.marked, PlaceRole::Plant(index))).collect()
    }

    /// Adds the transitions of the component, with the blocking place as a side condition.
    pub(in crate::translate) fn add_transitions(
        &self,
        weaver: &mut Weaver,
        index: usize,
        places: &[PlaceId],
        blocking: Option<PlaceId>,
    ) {
        let ids = |list: &[usize]| list.iter().map(|&place| places[place]).collect::<Vec<_>>();
        for (position, transition) in self.transitions.iter().enumerate() {
            let tests = transition.tests.iter().flat_map(|&(output, pattern)| {
                let bits = weaver.variable(output).iter().enumerate();
                bits.map(move |(position, bit)| bit.place(pattern >> position & 1 == 1))
            });
            let read: Vec<PlaceId> = ids(&transition.read).into_iter().chain(blocking).chain(tests).collect();
            let arcs = Arcs { consume: &ids(&transition.consume), produce: &ids(&transition.produce), read: &read };
            let role = TransitionRole::Plant { component: index, transition: position };
            weaver.transition(&transition.name, arcs, role);
        }
    }
}

//! One device of the plant: a connected net, its markings, and its nodes in the system net.

use crate::translate::provenance::{PlaceRole, TransitionRole};
use crate::translate::weaver::Weaver;
use petril_lang::semantics::VarId;
use petril_net::net::{Arcs, PlaceId};

/// A connected component of a plant net.
#[derive(Clone, Debug)]
pub struct Component {
    /// The name of its net, numbered if the net has several components.
    pub name: String,
    /// Its places.
    pub places: Vec<PlantPlace>,
    /// Its transitions.
    pub transitions: Vec<PlantTransition>,
    /// Its reachable markings when outputs may have any value; the first is the initial one.
    pub markings: Vec<LocalMarking>,
}

/// A place of the plant.
#[derive(Clone, Debug)]
pub struct PlantPlace {
    /// Its name in the system net: `net.place`.
    pub name: String,
    /// Whether it is marked at the beginning.
    pub marked: bool,
    /// The external values it stands for.
    pub drives: Vec<(VarId, u64)>,
}

/// A transition of the plant. Places are positions in [`Component::places`].
#[derive(Clone, Debug)]
pub struct PlantTransition {
    /// Its name in the system net: `net.transition`.
    pub name: String,
    /// Places from which it takes a token.
    pub consume: Vec<usize>,
    /// Places on which it puts one.
    pub produce: Vec<usize>,
    /// Places that must be marked.
    pub read: Vec<usize>,
    /// Values that outputs must have.
    pub tests: Vec<(VarId, u64)>,
}

impl PlantTransition {
    /// Whether it asks an output for two values at once.
    fn contradicts_itself(&self) -> bool {
        let differs = |&(output, value): &(VarId, u64)| self.tests.iter().any(|&(o, v)| o == output && v != value);
        self.tests.iter().any(differs)
    }
}

/// A reachable marking of a component.
#[derive(Clone, Debug)]
pub struct LocalMarking {
    /// The marked places, ascending.
    pub marked: Vec<usize>,
    /// The external values: one for each input the component drives.
    pub inputs: Vec<(VarId, u64)>,
    /// Where its transitions lead, if the outputs they test have the right values.
    pub moves: Vec<Move>,
}

/// A firing in a component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Move {
    /// Position in [`Component::transitions`].
    pub transition: usize,
    /// Position in [`Component::markings`].
    pub target: usize,
}

impl Component {
    /// Whether it drives an input.
    #[must_use]
    pub fn drives(&self, input: VarId) -> bool {
        self.places.iter().any(|place| place.drives.iter().any(|&(variable, _)| variable == input))
    }

    /// The transitions that can never fire, by position: whatever the outputs are, no marking that can be reached enables them.
    #[must_use]
    pub fn dead_transitions(&self) -> Vec<usize> {
        let mut fires = vec![false; self.transitions.len()];
        self.markings.iter().flat_map(|marking| &marking.moves).for_each(|step| fires[step.transition] = true);
        let (transitions, fires) = (&self.transitions, &fires);
        (0..fires.len()).filter(|&position| !fires[position] || transitions[position].contradicts_itself()).collect()
    }

    /// The markings it can come to from `from` by any number of moves while the outputs keep their values, each with the
    /// move that first led there; `from` itself comes first. Nearest first.
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

    /// The names of the transitions that lead from one marking to another, as few as possible.
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

    /// Adds the place whose token lets the component move. A component without transitions needs none.
    pub(in crate::translate) fn add_blocking_place(&self, weaver: &mut Weaver, index: usize) -> Option<PlaceId> {
        let name = format!("block_{}", self.name);
        (!self.transitions.is_empty()).then(|| weaver.place(&name, true, PlaceRole::Blocking(index)))
    }

    /// Adds its places.
    pub(in crate::translate) fn add_places(&self, weaver: &mut Weaver, index: usize) -> Vec<PlaceId> {
        self.places.iter().map(|place| weaver.place(&place.name, place.marked, PlaceRole::Plant(index))).collect()
    }

    /// Adds its transitions, with the blocking place as a side condition.
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

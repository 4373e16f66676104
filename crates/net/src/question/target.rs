//! Structural reduction of a net for one goal, and the goal in the reduced net.

use std::sync::atomic::AtomicBool;

use super::Means;
use crate::Goal;
use crate::engine::Model;
use crate::net::{Net, PlaceId, TransitionId};
use crate::structure::reduce::{Keep, Options, Property, Reduced, reduce_until};

/// Net in which a goal is searched for.
pub(super) struct Target<'n> {
    net: &'n Net,
    /// Reduced net; `None` for the net itself.
    reduced: Option<(Reduced<'n>, Model)>,
}

impl<'n> Target<'n> {
    /// Reduces the net as far as the goal allows, or until `stopping` is set.
    pub(super) fn of(net: &'n Net, goal: &Goal, stopping: &AtomicBool) -> Self {
        let mut keep = Keep::nothing(Property::Reachability);
        if !see(goal, &mut keep) {
            return Self::unreduced(net);
        }
        let reduced = reduce_until(net, &keep, &Options::default(), stopping);
        let model = Model::from(&reduced.net);
        Self { net, reduced: Some((reduced, model)) }
    }

    /// Takes the net itself.
    pub(super) fn unreduced(net: &'n Net) -> Self {
        Self { net, reduced: None }
    }

    /// Model to search, where `whole` is the net itself.
    pub(super) fn model<'a>(&'a self, whole: &'a Model) -> &'a Model {
        self.reduced.as_ref().map_or(whole, |(_, model)| model)
    }

    /// Technique of a search here.
    pub(super) fn means(&self) -> Means {
        if self.reduced.is_some() { Means::Reduction } else { Means::StubbornSets }
    }

    /// Translates the goal to the reduced net. Enabledness of a removed transition becomes a condition on its preset.
    pub(super) fn goal(&self, goal: &Goal) -> Goal {
        let Some((reduced, _)) = &self.reduced else { return goal.clone() };
        let place = |place: u32| reduced.place(PlaceId::at(place as usize)).map_or(u32::MAX, |id| id.index() as u32);
        let transition = |id: u32| reduced.transition(TransitionId::at(id as usize)).map(|id| id.index() as u32);
        let needs = |id: u32| self.net.pre(TransitionId::at(id as usize));
        let enough = |(id, weight): (PlaceId, u64)| Goal::AtLeast {
            terms: vec![(place(id.index() as u32), 1)],
            least: weight.into(),
        };
        let too_few = |(id, weight): (PlaceId, u64)| Goal::AtLeast {
            terms: vec![(place(id.index() as u32), -1)],
            least: 1 - i128::from(weight),
        };
        match goal {
            Goal::Truth(_) | Goal::Dead | Goal::Alive => goal.clone(),
            Goal::AtLeast { terms, least } => {
                let terms = terms.iter().map(|&(id, factor)| (place(id), factor)).collect();
                Goal::AtLeast { terms, least: *least }
            }
            Goal::Enabled(id) => {
                transition(*id).map_or_else(|| Goal::All(needs(*id).map(enough).collect()), Goal::Enabled)
            }
            Goal::Disabled(id) => {
                transition(*id).map_or_else(|| Goal::Any(needs(*id).map(too_few).collect()), Goal::Disabled)
            }
            Goal::All(parts) => Goal::All(parts.iter().map(|part| self.goal(part)).collect()),
            Goal::Any(parts) => Goal::Any(parts.iter().map(|part| self.goal(part)).collect()),
        }
    }

    /// Lifts a firing sequence to the net itself; `None` if it gets too long.
    pub(super) fn lifted(&self, firings: &[usize]) -> Option<Vec<u32>> {
        let Some((reduced, _)) = &self.reduced else { return Some(firings.iter().map(|&id| id as u32).collect()) };
        let firings: Vec<TransitionId> = firings.iter().map(|&id| TransitionId::at(id)).collect();
        let lifted = reduced.lift(&firings).ok()?;
        Some(lifted.into_iter().map(|id| id.index() as u32).collect())
    }
}

/// Adds the places and transitions observed by a goal; whether a reduction can preserve it.
fn see(goal: &Goal, keep: &mut Keep) -> bool {
    match goal {
        Goal::Truth(_) => {}
        Goal::AtLeast { terms, .. } => {
            keep.places.extend(terms.iter().map(|&(place, _)| PlaceId::at(place as usize)));
        }
        Goal::Enabled(id) | Goal::Disabled(id) => keep.transitions.push(TransitionId::at(*id as usize)),
        Goal::Dead => keep.property = Property::Deadlock,
        Goal::Alive => return false,
        Goal::All(parts) | Goal::Any(parts) => return parts.iter().all(|part| see(part, keep)),
    }
    true
}

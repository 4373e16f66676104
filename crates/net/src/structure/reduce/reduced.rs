//! Result of a reduction.

use std::collections::BTreeSet;

use super::draft::{Draft, Place, Transition};
use super::lift::{LiftError, lift};
use super::log::Log;
use super::{Property, Rule};
use crate::net::{Builder, Net, PlaceId, TransitionId};

/// Size of a net.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Number of places.
    pub places: usize,
    /// Number of transitions.
    pub transitions: usize,
    /// Number of arcs; a read arc counts as two.
    pub arcs: usize,
}

impl Size {
    /// Measures a net.
    #[must_use]
    pub fn of(net: &Net) -> Self {
        Self { places: net.places().len(), transitions: net.transitions().len(), arcs: net.arc_count() }
    }
}

/// A reduced net, and its relation to the original.
#[derive(Clone, Debug)]
pub struct Reduced<'n> {
    /// The reduced net. Nodes that the original also has keep their names.
    pub net: Net,
    /// Number of applications of each rule that was applied.
    pub applied: Vec<(Rule, usize)>,
    pub(super) original: &'n Net,
    pub(super) property: Property,
    /// The kept places, as places of the original.
    pub(super) kept: Vec<PlaceId>,
    places: Vec<Option<PlaceId>>,
    transitions: Vec<Option<TransitionId>>,
    /// Number of each transition in the log.
    pub(super) numbers: Vec<u32>,
    pub(super) log: Log,
}

impl<'n> Reduced<'n> {
    /// Returns the original, without any reduction.
    pub(super) fn unchanged(original: &'n Net, property: Property) -> Self {
        let numbers = 0..original.transitions().len() as u32;
        Self {
            net: original.clone(),
            applied: Vec::new(),
            original,
            property,
            kept: original.place_ids().collect(),
            places: original.place_ids().map(Some).collect(),
            transitions: original.transition_ids().map(Some).collect(),
            log: Log::new(numbers.len()),
            numbers: numbers.collect(),
        }
    }

    /// Makes the reduced net of a draft.
    pub(super) fn of(original: &'n Net, property: Property, draft: Draft) -> Self {
        let Draft { places, transitions, log, applied, .. } = draft;
        let mut builder = Builder::new(original.name());
        let add = |(id, place): (PlaceId, &Place)| {
            (!place.is_gone).then(|| builder.place_with(original.place(id).name, place.tokens))
        };
        let ids: Vec<Option<PlaceId>> = original.place_ids().zip(&places).map(add).collect();
        let present = (0..).zip(&transitions).filter(|(_, transition)| !transition.is_gone);
        let numbers: Vec<u32> = present.map(|(id, _)| id).collect();
        let ends = ends(&log);
        let mut taken: BTreeSet<String> = BTreeSet::new();
        for &number in &numbers {
            let Transition { pre, post, .. } = &transitions[number as usize];
            let row = |row: &[(u32, u64)]| -> Vec<(PlaceId, u64)> {
                row.iter().filter_map(|&(place, weight)| Some((ids[place as usize]?, weight))).collect()
            };
            let name = name(original, ends[number as usize], &mut taken);
            builder.weighted(name, &row(pre), &row(post), &[]);
        }
        let mut transition_ids = vec![None; log.originals];
        for (position, &number) in numbers.iter().enumerate().filter(|(_, number)| (**number as usize) < log.originals)
        {
            transition_ids[number as usize] = Some(TransitionId::at(position));
        }
        Self {
            net: builder.build(),
            applied: Rule::ALL.into_iter().zip(applied).filter(|&(_, times)| times > 0).collect(),
            original,
            property,
            kept: original.place_ids().filter(|id| places[id.index()].is_kept).collect(),
            places: ids,
            transitions: transition_ids,
            numbers,
            log,
        }
    }

    /// Finds a place of the original in the reduced net. A kept place is always there, with the same tokens.
    #[must_use]
    pub fn place(&self, original: PlaceId) -> Option<PlaceId> {
        self.places[original.index()]
    }

    /// Finds a transition of the original in the reduced net, if it is still there. A kept transition that is there is
    /// enabled if and only if it is in the original. One that was removed is enabled in the original if its preset,
    /// which is kept, has the tokens.
    #[must_use]
    pub fn transition(&self, original: TransitionId) -> Option<TransitionId> {
        self.transitions[original.index()]
    }

    /// Lifts a run of the reduced net to a run of the original, both from the initial marking. The kept places have the
    /// same tokens at the end; if deadlocks are kept and the last marking is dead, so is that of the original. The
    /// lifted run has been replayed on the original by the plain firing rule.
    ///
    /// # Errors
    /// See [`LiftError`]. In particular, the lifted run may be too long.
    pub fn lift(&self, run: &[TransitionId]) -> Result<Vec<TransitionId>, LiftError> {
        lift(self, run)
    }
}

/// For each transition of a log, the first and the last original transition it stands for, if there are any.
fn ends(log: &Log) -> Vec<Option<(u32, u32)>> {
    let mut ends: Vec<Option<(u32, u32)>> = (0..log.originals as u32).map(|id| Some((id, id))).collect();
    for word in &log.words {
        let of = |part: Option<&u32>| part.and_then(|&id| ends[id as usize]);
        let both = of(word.first()).zip(of(word.last()));
        ends.push(both.map(|((first, _), (_, last))| (first, last)));
    }
    ends
}

/// Name of a transition: its own, or those of the first and the last transition it stands for, with a number if not
/// unique.
fn name(net: &Net, ends: Option<(u32, u32)>, taken: &mut BTreeSet<String>) -> String {
    let original = |id: u32| net.transition(TransitionId::at(id as usize)).name;
    let name = match ends {
        Some((first, last)) if first == last => original(first).to_owned(),
        Some((first, last)) => format!("{}..{}", original(first), original(last)),
        None => "always".to_owned(),
    };
    let mut unique = name.clone();
    for more in 2.. {
        if taken.insert(unique.clone()) {
            break;
        }
        unique = format!("{name} {more}");
    }
    unique
}

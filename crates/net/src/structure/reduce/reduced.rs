//! What a reduction leaves.

use std::collections::BTreeSet;

use super::draft::{Draft, Place, Transition};
use super::lift::{LiftError, lift};
use super::log::Log;
use super::{Property, Rule};
use crate::net::{Builder, Net, PlaceId, TransitionId};

/// How large a net is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Places.
    pub places: usize,
    /// Transitions.
    pub transitions: usize,
    /// Arcs, a read arc counting as two.
    pub arcs: usize,
}

impl Size {
    /// The size of a net.
    #[must_use]
    pub fn of(net: &Net) -> Self {
        Self { places: net.places().len(), transitions: net.transitions().len(), arcs: net.arc_count() }
    }
}

/// A reduced net, and what it says about the original.
#[derive(Clone, Debug)]
pub struct Reduced<'n> {
    /// The reduced net. A node that the original has, too, has the same name.
    pub net: Net,
    /// How often each rule was applied, of those that were.
    pub applied: Vec<(Rule, usize)>,
    pub(super) original: &'n Net,
    pub(super) property: Property,
    /// The kept places, in the original.
    pub(super) kept: Vec<PlaceId>,
    places: Vec<Option<PlaceId>>,
    transitions: Vec<Option<TransitionId>>,
    /// For each transition its number in the log.
    pub(super) numbers: Vec<u32>,
    pub(super) log: Log,
}

impl<'n> Reduced<'n> {
    /// A net that nothing was done to.
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

    /// The net of a draft.
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

    /// A place of the original in the reduced net. A kept place is always there, with the same tokens.
    #[must_use]
    pub fn place(&self, original: PlaceId) -> Option<PlaceId> {
        self.places[original.index()]
    }

    /// A transition of the original in the reduced net, if it is still there. A kept transition that is there is enabled when
    /// it is in the original. One that is gone is enabled in the original when its preset, which is kept, has the tokens.
    #[must_use]
    pub fn transition(&self, original: TransitionId) -> Option<TransitionId> {
        self.transitions[original.index()]
    }

    /// A run of the original for a run of the reduced net, both from the initial marking. The kept places have the same tokens
    /// at the end; if deadlocks are kept and the last marking is dead, so is that of the original. It has been replayed on the
    /// original by the plain firing rule.
    ///
    /// # Errors
    /// See [`LiftError`]. In particular, a run may stand for one too long to be of use.
    pub fn lift(&self, run: &[TransitionId]) -> Result<Vec<TransitionId>, LiftError> {
        lift(self, run)
    }
}

/// For each transition of a log, the first and the last of the originals it stands for, if there are any.
fn ends(log: &Log) -> Vec<Option<(u32, u32)>> {
    let mut ends: Vec<Option<(u32, u32)>> = (0..log.originals as u32).map(|id| Some((id, id))).collect();
    for word in &log.words {
        let of = |part: Option<&u32>| part.and_then(|&id| ends[id as usize]);
        let both = of(word.first()).zip(of(word.last()));
        ends.push(both.map(|((first, _), (_, last))| (first, last)));
    }
    ends
}

/// The name of a transition: its own, or that of the first and that of the last of those it stands for; and a number if need be.
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

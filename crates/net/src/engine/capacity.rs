//! Exploration with capacity 1 on each place.
//!
//! A place that invariants do not prove safe gets a complementary place, which is marked while the place is not. A
//! transition that adds a token to the place takes that of the complement, so it never adds a second one. If the
//! complement disables a transition, the net is not safe, and the transition is enabled in the net but not here.

use super::cover::Bounds;
use super::exploration::Exploration;
use super::model::{Arcs, Model, Rule, Touch};
use super::search::{Options, explore, explore_within};
use crate::net::Net;
use petril_search::Progress;

/// Explores the safe part of a net. The places of the net come first, then their complements; transitions are those of
/// the net.
pub(crate) fn explore_safely(
    net: &Net,
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
) -> Exploration {
    let model = Model::from(net);
    let rules = match model.rules() {
        Ok(rules) => rules,
        Err(reason) => return Exploration::refused(reason),
    };
    let bounds = Bounds::of(&model.initial, &rules);
    let unproven: Vec<usize> = (0..model.initial.len()).filter(|&place| !bounds.is_safe(place)).collect();
    if unproven.is_empty() {
        explore_within(&model, &rules, &bounds, options, watch, None, None)
    } else {
        explore(&with_complements(model, &rules, &unproven), options, watch, None)
    }
}

fn with_complements(mut model: Model, rules: &[Rule], places: &[usize]) -> Model {
    let first = model.initial.len();
    model.initial.extend(places.iter().map(|&place| 1 - model.initial[place].min(1)).collect::<Vec<_>>());
    for (arcs, rule) in model.transitions.iter_mut().zip(rules) {
        for touch in rule {
            if let Ok(complement) = places.binary_search(&touch.place) {
                guard(arcs, touch, (first + complement) as u32);
            }
        }
    }
    model
}

/// Adds the arcs of a transition to the complement of a place it changes: the complement loses what the place gains.
fn guard(arcs: &mut Arcs, touch: &Touch, complement: u32) {
    let gain = touch.change();
    let list = if gain > 0 { &mut arcs.pre } else { &mut arcs.post };
    list.extend((gain != 0).then_some((complement, gain.unsigned_abs())));
}

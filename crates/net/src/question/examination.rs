//! Global properties of a net, as examined in the Model Checking Contest.

use super::replay::{Played, refuted, way};
use super::{Branch, Question, Reply, Run};
use crate::engine::Exploration;
use crate::net::{Net, PlaceId, TransitionId};
use petril_logic::{Bound, Comparison, Quantifier, Term, Valuation};
use petril_search::Stop;

/// Global property of a net (examination of the contest).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Examination {
    /// A deadlock is reachable.
    ReachabilityDeadlock,
    /// The net is safe (1-bounded): no place ever holds more than one token.
    OneSafe,
    /// Some place has the same number of tokens in every reachable marking.
    StableMarking,
    /// Every transition is quasi-live: it can fire at least once.
    QuasiLiveness,
    /// The net is live: every transition can fire again from every reachable marking.
    Liveness,
}

impl Examination {
    /// All examinations.
    pub const ALL: [Self; 5] =
        [Self::ReachabilityDeadlock, Self::OneSafe, Self::StableMarking, Self::QuasiLiveness, Self::Liveness];

    /// Name of the examination in the contest.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::ReachabilityDeadlock => "ReachabilityDeadlock",
            Self::OneSafe => "OneSafe",
            Self::StableMarking => "StableMarking",
            Self::QuasiLiveness => "QuasiLiveness",
            Self::Liveness => "Liveness",
        }
    }

    /// The examination as a question.
    #[must_use]
    pub fn question(self) -> Question {
        match self {
            Self::ReachabilityDeadlock => {
                let (hold, release) = (Box::new(Bound::Truth(true)), Box::new(Bound::Deadlock));
                Question::Holds(Bound::Until { quantifier: Quantifier::Some, weak: false, hold, release })
            }
            examination => Question::Examination(examination),
        }
    }

    /// Answer from the figures of an exploration, if they suffice.
    pub(super) fn reply(self, net: &Net, exploration: &Exploration) -> Option<Reply> {
        if matches!(exploration.stop, Stop::Refused(_)) {
            return None;
        }
        let is_complete = exploration.stop == Stop::Complete;
        match self {
            Self::ReachabilityDeadlock => None,
            Self::OneSafe => match two_tokens(net, exploration) {
                Some(reply) => Some(reply),
                None => is_complete.then_some(Reply::Holds(None)),
            },
            Self::StableMarking => stable(net, exploration),
            Self::QuasiLiveness => match never_enabled(exploration) {
                dead if dead.is_empty() => Some(Reply::Holds(None)),
                dead if is_complete => Some(Reply::Violated(Some(said(dead.into_iter().map(dead_for_ever))))),
                _ => None,
            },
            Self::Liveness => match &exploration.figures.deadlock {
                Some(marking) if net.transitions().len() > 0 => {
                    let claims = net.transition_ids().map(dead_for_ever).collect();
                    Some(shown_at(net, exploration, marking, claims, |played| played.is_deadlock()))
                }
                _ if net.transitions().len() == 0 => Some(Reply::Holds(None)),
                _ => match never_enabled(exploration) {
                    dead if is_complete && !dead.is_empty() => {
                        Some(Reply::Violated(Some(said(dead.into_iter().map(dead_for_ever)))))
                    }
                    _ => None,
                },
            },
        }
    }
}

/// The formula `AG !enabled(t)`: the transition is dead.
pub(super) fn dead_for_ever(transition: TransitionId) -> Bound {
    always(Bound::Not(Box::new(Bound::Enabled(transition))))
}

fn always(f: Bound) -> Bound {
    let (hold, release) = (Box::new(f), Box::new(Bound::Truth(false)));
    Bound::Until { quantifier: Quantifier::All, weak: true, hold, release }
}

fn never_enabled(exploration: &Exploration) -> Vec<TransitionId> {
    exploration.figures.never_enabled.iter().map(|&transition| TransitionId::at(transition)).collect()
}

/// A run without firings that claims these formulas of the initial marking.
fn said(formulas: impl Iterator<Item = Bound>) -> Run {
    let branches = formulas.map(|formula| Branch { at: 0, formula, run: None });
    Run { branches: branches.collect(), ..Run::default() }
}

/// Answer "no" from a reached marking in which the formulas hold. The marking computed by the plain firing rule must
/// pass the test.
pub(super) fn shown_at(
    net: &Net,
    exploration: &Exploration,
    marking: &[u64],
    formulas: Vec<Bound>,
    test: impl Fn(&Played<'_>) -> bool,
) -> Reply {
    match way(net, exploration, marking) {
        Ok((firings, last)) if test(&Played(net, &last)) => {
            let at = firings.len();
            let branches = formulas.into_iter().map(|formula| Branch { at, formula, run: None }).collect();
            Reply::Violated(Some(Run { firings, branches, is_shortest: true, ..Run::default() }))
        }
        Ok(_) => refuted("the last marking does not show it"),
        Err(what) => refuted(&what),
    }
}

/// Refutes safeness by one of the nearest markings with two tokens on a place.
fn two_tokens(net: &Net, exploration: &Exploration) -> Option<Reply> {
    let (place, marking) = exploration.second_token()?;
    let place = PlaceId::at(place);
    let claim = Bound::Compare(Comparison::Greater, Term::Tokens(place), Term::Number(1));
    Some(shown_at(net, exploration, &marking, vec![claim], |played| played.tokens(place) > 1))
}

/// Stable places: no transition that can fire changes their number of tokens.
fn stable(net: &Net, exploration: &Exploration) -> Option<Reply> {
    let mut dead = vec![false; net.transitions().len()];
    exploration.figures.never_enabled.iter().for_each(|&transition| dead[transition] = true);
    let mut changes = vec![false; net.places().len()];
    let mut may_change = vec![false; net.places().len()];
    for transition in net.transition_ids() {
        let mut effect: std::collections::BTreeMap<usize, i128> = std::collections::BTreeMap::new();
        net.pre(transition).for_each(|(place, n)| *effect.entry(place.index()).or_default() -= i128::from(n));
        net.post(transition).for_each(|(place, n)| *effect.entry(place.index()).or_default() += i128::from(n));
        for (place, _) in effect.into_iter().filter(|&(_, change)| change != 0) {
            may_change[place] = true;
            changes[place] |= !dead[transition.index()];
        }
    }
    if changes.iter().all(|&changes| changes) {
        return Some(Reply::Violated(None));
    }
    let known = if exploration.stop == Stop::Complete { &changes } else { &may_change };
    let initial = net.initial_tokens();
    let stable: Vec<Bound> = net
        .place_ids()
        .filter(|place| !known[place.index()])
        .map(|place| {
            always(Bound::Compare(Comparison::Equal, Term::Tokens(place), Term::Number(initial.on(place).into())))
        })
        .collect();
    (!stable.is_empty()).then(|| Reply::Holds(Some(said(stable.into_iter()))))
}

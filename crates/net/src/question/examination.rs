//! Questions about a net as a whole, as the Model Checking Contest asks them.

use super::replay::{Played, refuted, way};
use super::{Branch, Question, Reply, Run};
use crate::engine::Exploration;
use crate::net::{Net, PlaceId, TransitionId};
use petril_logic::{Bound, Comparison, Quantifier, Term, Valuation};
use petril_search::Stop;

/// A question about a net as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Examination {
    /// Whether a marking can be reached that enables nothing.
    ReachabilityDeadlock,
    /// Whether no place ever holds more than one token.
    OneSafe,
    /// Whether there is a place whose tokens never change in number.
    StableMarking,
    /// Whether every transition can fire.
    QuasiLiveness,
    /// Whether every transition can fire again, whatever has fired.
    Liveness,
}

impl Examination {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::ReachabilityDeadlock, Self::OneSafe, Self::StableMarking, Self::QuasiLiveness, Self::Liveness];

    /// What the contest calls it.
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

    /// The question it asks.
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

    /// What the figures of an exploration say, if that is enough.
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

/// `AG !enabled(t)`.
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

/// What holds from the beginning.
fn said(formulas: impl Iterator<Item = Bound>) -> Run {
    let branches = formulas.map(|formula| Branch { at: 0, formula, run: None });
    Run { branches: branches.collect(), ..Run::default() }
}

/// The reply "no" that a marking gives, from which on some formulas hold. The marking reached by the plain firing rule must
/// pass a test.
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

/// One of the nearest markings in which a place has more than one token.
fn two_tokens(net: &Net, exploration: &Exploration) -> Option<Reply> {
    let (place, marking) = exploration.second_token()?;
    let place = PlaceId::at(place);
    let claim = Bound::Compare(Comparison::Greater, Term::Tokens(place), Term::Number(1));
    Some(shown_at(net, exploration, &marking, vec![claim], |played| played.tokens(place) > 1))
}

/// A place never changes if no transition that changes it can fire.
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

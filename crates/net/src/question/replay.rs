//! Replay by the plain firing rule, which shares no code with the search.

use super::Reply;
use crate::engine::Exploration;
use crate::net::{Net, PlaceId, Tokens, TransitionId};
use petril_base::VarId;
use petril_logic::Valuation;

/// Answer where replay and search disagree (an error in Petril).
pub(super) fn refuted(what: &str) -> Reply {
    let message = "the replay refutes the search, which is an error in Petril; please report it";
    Reply::Unknown(format!("{message}: {what}"))
}

/// Firing sequence to a marking found, and the marking it reaches by the plain firing rule.
pub(super) fn way(
    net: &Net,
    exploration: &Exploration,
    marking: &[u64],
) -> Result<(Vec<TransitionId>, Tokens), String> {
    let firings = exploration.firings(marking).ok_or("the way to a marking is lost")?;
    let firings: Vec<TransitionId> = firings.into_iter().map(TransitionId::at).collect();
    let last = last_marking(net, &firings)?;
    Ok((firings, last))
}

/// Last marking of a run, by the plain firing rule.
pub(super) fn last_marking(net: &Net, firings: &[TransitionId]) -> Result<Tokens, String> {
    let mut tokens = net.initial_tokens();
    for &transition in firings {
        fire(net, &mut tokens, transition)?;
    }
    Ok(tokens)
}

fn fire(net: &Net, tokens: &mut Tokens, transition: TransitionId) -> Result<(), String> {
    let name = net.transition(transition).name;
    if !net.has_concession(tokens, transition) {
        return Err(format!("`{name}` is not enabled"));
    }
    net.play(tokens, transition).map_err(|_| format!("`{name}` puts too many tokens"))
}

/// A marking of the replay.
pub(super) struct Played<'n>(pub(super) &'n Net, pub(super) &'n Tokens);

impl Valuation for Played<'_> {
    fn value(&self, _: VarId) -> u64 {
        0
    }

    fn is_marked(&self, place: PlaceId) -> bool {
        self.tokens(place) > 0
    }

    fn tokens(&self, place: PlaceId) -> u64 {
        self.1.on(place)
    }

    fn is_enabled(&self, transition: TransitionId) -> bool {
        self.0.has_concession(self.1, transition)
    }

    fn is_deadlock(&self) -> bool {
        self.0.transition_ids().all(|transition| !self.is_enabled(transition))
    }
}

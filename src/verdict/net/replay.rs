//! Runs replayed by the plain firing rule, which shares nothing with the search.

use super::{Reply, Run};
use crate::logic::Valuation;
use crate::net::{Net, PlaceId, Tokens, TransitionId};
use crate::semantics::VarId;

/// The reply where a replay contradicts the search.
pub(super) fn refuted(what: &str) -> Reply {
    let message = "the replay refutes the search, which is an error in Petril; please report it";
    Reply::Unknown(format!("{message}: {what}"))
}

/// The markings of a run, by the plain firing rule.
pub(super) fn replayed(net: &Net, run: &Run) -> Result<Vec<Tokens>, String> {
    let mut tokens = net.initial_tokens();
    let mut markings = vec![tokens.clone()];
    for &transition in &run.firings {
        fire(net, &mut tokens, transition)?;
        markings.push(tokens.clone());
    }
    match run.loop_start {
        Some(start) if markings[start] != tokens => Err("the loop does not close".to_owned()),
        _ => Ok(markings),
    }
}

/// The last marking of a run, by the plain firing rule.
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

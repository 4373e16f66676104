//! Questions about a net alone, all answered by one exploration: what can be reached, on the way (`hunt`); what speaks of paths,
//! on the whole graph (`paths`). Every run is replayed by the plain firing rule (`replay`).

mod hunt;
mod paths;
mod replay;

use rayon::prelude::*;

use self::hunt::{Hunt, search};
use self::paths::Paths;
use crate::explore::engine::{Figures, Options};
use crate::explore::{Progress, Stop};
use crate::logic::Bound;
use crate::net::{Net, PlaceId, TransitionId};

/// A question about a net.
#[derive(Clone, Debug)]
pub enum Question {
    /// Whether a formula holds at the beginning.
    Holds(Bound),
    /// How many tokens these places can hold together, a place named twice counting twice.
    Most(Vec<PlaceId>),
}

/// The answer to a question.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reply {
    /// It holds; with a run that shows it, if one can.
    Holds(Option<Run>),
    /// It does not; with a run that shows it, if one can.
    Violated(Option<Run>),
    /// So many tokens at most.
    Most(u64),
    /// Nobody knows, for this reason.
    Unknown(String),
}

/// A firing sequence from the initial marking. It is shortest if it is finite.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// The transitions in the order of firing.
    pub firings: Vec<TransitionId>,
    /// For a run without end, the number of firings after which the marking was the one that the last firing leads to.
    pub loop_start: Option<usize>,
}

/// What came of an exploration.
#[derive(Clone, Debug)]
pub struct NetReport {
    /// The answers, in the order of the questions.
    pub replies: Vec<Reply>,
    /// What was explored.
    pub figures: Figures,
    /// Why the exploration ended. It may end as soon as all is answered.
    pub stop: Stop,
}

/// Explores a net until every question is answered, or the options or `watch` end it. Every run has been replayed by the plain
/// firing rule.
///
/// What answers a [`Hunt::Goal`] without going through all states has its place before the search: a hunt whose reply is known
/// need not take part in it.
#[must_use]
pub fn judge(
    net: &Net,
    questions: &[Question],
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
) -> NetReport {
    let hunts: Vec<Hunt<'_>> = questions.iter().map(Hunt::of).collect();
    let exploration = search(net, &hunts, options, watch);
    let on_paths = hunts.iter().any(|hunt| matches!(hunt, Hunt::Paths(_)));
    let paths = on_paths.then(|| Paths::of(net, &exploration));
    let replies = hunts.par_iter().map(|hunt| match hunt {
        Hunt::Goal(goal) => goal.reply(net, &exploration),
        Hunt::Most(most) => most.reply(&exploration),
        Hunt::Paths(formula) => match &paths {
            Some(Ok(paths)) => paths.reply(formula),
            Some(Err(reason)) => Reply::Unknown(reason.clone()),
            None => Reply::Unknown("nobody looked".to_owned()),
        },
    });
    NetReport { replies: replies.collect(), figures: exploration.figures.clone(), stop: exploration.stop.clone() }
}

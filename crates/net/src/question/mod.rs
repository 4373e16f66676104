//! Questions about a net alone. One exploration answers all of them in a small net: what can be reached, on the way (`hunt`); what
//! speaks of paths, on the graph (`paths`). In a larger one, goals that are left open are thought about one by one (`think`).
//! Every run is replayed by the plain firing rule (`replay`).

mod aim;
mod atoms;
mod condition;
mod equation;
mod examination;
mod explain;
mod hunt;
mod ledger;
mod linear;
mod live;
mod means;
mod paths;
mod replay;
mod split;
mod target;
mod think;

pub use self::examination::Examination;
use self::hunt::{Hunt, search};
use self::ledger::Ledger;
pub use self::means::Means;
use self::paths::Paths;
use self::split::Split;
use self::think::Thinker;
use crate::engine::{Exploration, Figures, Model, Options};
use crate::net::{Net, PlaceId, TransitionId};
use petril_logic::Bound;
use petril_search::{Budget, Progress, Stop, watched};

/// A question about a net.
#[derive(Clone, Debug)]
pub enum Question {
    /// Whether a formula holds at the beginning.
    Holds(Bound),
    /// How many tokens these places can hold together, a place named twice counting twice.
    Most(Vec<PlaceId>),
    /// Something about the net as a whole.
    Examination(Examination),
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

/// A firing sequence from the initial marking, or from where it branches off another.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Run {
    /// The transitions in the order of firing.
    pub firings: Vec<TransitionId>,
    /// For a run without end, the number of firings after which the marking was the one that the last firing leads to.
    pub loop_start: Option<usize>,
    /// What else is to be shown on the way.
    pub branches: Vec<Branch>,
    /// Whether it is known that none shorter shows the same.
    pub is_shortest: bool,
}

/// A formula that holds on the way of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Branch {
    /// After how many firings.
    pub at: usize,
    /// The formula.
    pub formula: Bound,
    /// A run from there that shows it. None can show what holds on all paths.
    pub run: Option<Run>,
}

/// What came of an exploration.
#[derive(Clone, Debug)]
pub struct NetReport {
    /// The answers, in the order of the questions.
    pub replies: Vec<Reply>,
    /// What each of them rests on, ascending; nothing if the initial marking is enough.
    pub means: Vec<Vec<Means>>,
    /// What was explored.
    pub figures: Figures,
    /// Why the exploration ended. It may end as soon as all is answered.
    pub stop: Stop,
}

/// Called now and then with how far the work is; gives a reason to stop.
type Watch<'w> = &'w mut (dyn FnMut(&Progress) -> Option<String> + 'w);

/// States of the first exploration.
const FIRST: u64 = 100_000;

/// So many times as many states are explored next.
const GROWTH: u64 = 16;

/// Explores a net until every question is answered, or the options or `watch` end it. Every run has been replayed by the plain
/// firing rule.
///
/// A part of the states comes first, which is all of a small net. What is open then is thought about (`think`), and larger parts
/// follow.
#[must_use]
pub fn judge(
    net: &Net,
    questions: &[Question],
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
) -> NetReport {
    judge_aloud(net, questions, options, watch, &mut |_, _, _| {})
}

/// As [`judge`]; `tell` is called with each answer as soon as it is known, and with the number of the question.
#[must_use]
pub fn judge_aloud(
    net: &Net,
    questions: &[Question],
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
    tell: &mut dyn FnMut(usize, &Reply, &[Means]),
) -> NetReport {
    let mut hunts = Vec::new();
    let splits: Vec<Split<'_>> = questions.iter().map(|question| Split::of(question, net, &mut hunts)).collect();
    let mut ledger = Ledger::new(splits, hunts.len(), tell);
    let model = Model::from(net);
    let mut thinker = None;
    let mut states = FIRST.min(options.budget.states);
    loop {
        let open = ledger.open();
        let wanted: Vec<&Hunt<'_>> = open.iter().map(|&at| &hunts[at]).collect();
        let budget = Budget { states, ..options.budget };
        let exploration = search(&model, &wanted, &Options { budget, ..*options }, watch);
        let (found, mut reason) = answers(net, &wanted, &exploration, &budget, watch);
        for (at, reply) in open.into_iter().zip(found) {
            reply.into_iter().for_each(|reply| ledger.put(at, reply, Means::Exploration));
        }
        let is_partial = exploration.stop == Stop::States(states);
        let open = ledger.open();
        if reason.is_none() && is_partial && !open.is_empty() {
            let thinker = thinker.get_or_insert_with(|| Thinker::new(net, &model, &hunts));
            // A state takes longer there, and each goal has states of its own.
            let each = if states == options.budget.states { states } else { states / GROWTH };
            reason = thinker.round(&open, each, options, watch, &mut |at, reply, by| ledger.put(at, reply, by));
        }
        let is_last = !is_partial || states == options.budget.states;
        if reason.is_some() || is_last || ledger.open().is_empty() {
            let reason = reason.unwrap_or_else(|| exploration.stop.to_string());
            let (replies, means) = ledger.close(&reason);
            return NetReport { replies, means, figures: exploration.figures, stop: exploration.stop };
        }
        states = states.saturating_mul(GROWTH).min(options.budget.states);
    }
}

/// What an exploration answers; and why it was stopped while it did, if it was.
fn answers(
    net: &Net,
    hunts: &[&Hunt<'_>],
    exploration: &Exploration,
    budget: &Budget,
    watch: Watch<'_>,
) -> (Vec<Option<Reply>>, Option<String>) {
    let mut replies: Vec<Option<Reply>> = hunts.iter().map(|hunt| hunt.reply(net, exploration)).collect();
    let is_open = |at: &usize| hunts[*at].needs_the_graph() && replies[*at].is_none();
    let open: Vec<usize> = (0..hunts.len()).filter(is_open).collect();
    if open.is_empty() {
        return (replies, None);
    }
    let bytes = Paths::bytes(exploration);
    if bytes > budget.bytes {
        // Others may still be answered, by more states without their graph.
        let more = (bytes - budget.bytes) >> 20;
        let reason = format!("the graph needs {} MiB, {more} more than the limit", bytes >> 20);
        open.into_iter().for_each(|at| replies[at] = Some(Reply::Unknown(reason.clone())));
        return (replies, None);
    }
    let progress = Progress { bytes, ..exploration.progress() };
    let (found, reason) = watched(watch, &progress, |stopping| {
        let wanted: Vec<&Hunt<'_>> = open.iter().map(|&at| hunts[at]).collect();
        Paths::of(net, exploration, stopping).map(|paths| paths.replies(&wanted, stopping))
    });
    let found = found.flatten().unwrap_or_default();
    open.into_iter().zip(found).for_each(|(at, reply)| replies[at] = reply);
    (replies, reason)
}

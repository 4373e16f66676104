//! Checks of a net alone. In a small net one exploration answers all questions: reachability on the fly (`hunt`),
//! branching time on the graph (`paths`). In a larger one, open goals go one by one through a portfolio of techniques
//! (`think`). Every run is replayed by the plain firing rule (`replay`).

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
    /// Whether a formula holds at the initial marking.
    Holds(Bound),
    /// Maximum number of tokens on these places together; a place named twice counts twice.
    Most(Vec<PlaceId>),
    /// Global property of the net.
    Examination(Examination),
}

/// The answer to a question.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reply {
    /// The property holds; with a run that shows it, if one can.
    Holds(Option<Run>),
    /// The property is violated; with a run that shows it, if one can.
    Violated(Option<Run>),
    /// Maximum number of tokens.
    Most(u64),
    /// Undecided, with the reason.
    Unknown(String),
}

/// Firing sequence from the initial marking, or from where it branches off another run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Run {
    /// Transitions in the order of firing.
    pub firings: Vec<TransitionId>,
    /// For a lasso, the number of firings before the marking that the last firing returns to.
    pub loop_start: Option<usize>,
    /// Formulas that are shown at markings of the run.
    pub branches: Vec<Branch>,
    /// Whether no shorter run shows the same.
    pub is_shortest: bool,
}

/// Formula claimed at a marking of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Branch {
    /// Number of firings before that marking.
    pub at: usize,
    /// Formula.
    pub formula: Bound,
    /// Run from there that shows it; `None` for universal formulas, which no run can show.
    pub run: Option<Run>,
}

/// Results of the check of a net.
#[derive(Clone, Debug)]
pub struct NetReport {
    /// Answers, in the order of the questions.
    pub replies: Vec<Reply>,
    /// Techniques that each answer rests on, ascending; empty if the initial marking decides.
    pub means: Vec<Vec<Means>>,
    /// Figures of the last exploration.
    pub figures: Figures,
    /// Reason why the exploration ended. It may end as soon as all is answered.
    pub stop: Stop,
}

/// Progress callback; returns a reason to stop.
type Watch<'w> = &'w mut (dyn FnMut(&Progress) -> Option<String> + 'w);

/// Limit on the states of the first exploration.
const FIRST: u64 = 100_000;

/// Growth factor of that limit from round to round.
const GROWTH: u64 = 16;

/// Explores a net until every question is answered, or the options or `watch` end it. Every run has been replayed by
/// the plain firing rule.
///
/// The first round explores a limited number of states, which suffices for a small net. Open goals then go through the
/// portfolio (`think`), and rounds with more states follow.
#[must_use]
pub fn judge(
    net: &Net,
    questions: &[Question],
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
) -> NetReport {
    judge_aloud(net, questions, options, watch, &mut |_, _, _| {})
}

/// As [`judge`]; `tell` is called with the number of each question and its answer as soon as it is known.
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
            // A state costs more there, and each goal has a state space of its own.
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

/// Answers of an exploration, and the reason if `watch` stopped the work meanwhile.
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
        // Other properties may still be decided by more states, without a graph.
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

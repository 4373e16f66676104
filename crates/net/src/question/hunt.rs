//! Properties checked on the fly: evaluated in each state while the net is explored.

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use super::aim::aim;
use super::replay::{Played, last_marking, refuted, way};
use super::{Examination, Means, Question, Reply, Run};
use crate::engine::{self, Exploration, Model, Options, View, Wanted};
use crate::net::{Net, PlaceId, Tokens, TransitionId};
use petril_base::VarId;
use petril_logic::{Bound, Quantifier, Valuation};
use petril_search::{Progress, Stop};

/// A property to check during an exploration.
pub(super) enum Hunt<'q> {
    /// Reachability or invariance: one state decides it.
    Goal(Goal<'q>),
    /// Maximum number of tokens on places.
    Most(Most<'q>),
    /// Global property, decided by the figures or the graph.
    Whole(Examination),
    /// Branching-time formula, decided on the graph only.
    Paths(&'q Bound),
}

/// Reachability goal: a state where the formula is true (for `EF`) or false (for `AG`).
pub(super) struct Goal<'q> {
    /// State formula.
    pub(super) formula: &'q Bound,
    /// Whether the property is `EF` (else `AG`).
    pub(super) is_existential: bool,
    is_found: AtomicBool,
    found: Mutex<Option<Vec<u64>>>,
}

/// Maximum number of tokens that places hold together.
pub(super) struct Most<'q> {
    places: &'q [PlaceId],
    tokens: AtomicU64,
}

/// Explores a net and evaluates every property in each state, until all are decided or a limit is met.
pub(super) fn search(
    model: &Model,
    hunts: &[&Hunt<'_>],
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
) -> Exploration {
    let options = Options { keep: true, ..*options };
    engine::explore(model, &options, watch, Some(&Hunts(hunts)))
}

/// Properties of one search. The search may end early only if each is a goal that has been found.
struct Hunts<'h, 'q>(&'h [&'h Hunt<'q>]);

impl Wanted for Hunts<'_, '_> {
    fn is(&self, view: &View<'_>) -> bool {
        self.0.iter().for_each(|hunt| hunt.look(view));
        self.0.iter().all(|hunt| hunt.is_over())
    }

    fn forget(&self) {
        self.0.iter().for_each(|hunt| hunt.forget());
    }
}

impl<'q> Hunt<'q> {
    pub(super) fn of(question: &'q Question) -> Self {
        match question {
            Question::Holds(formula) => Self::of_formula(formula),
            Question::Examination(examination) => Self::Whole(*examination),
            Question::Most(places) => Self::Most(Most { places, tokens: AtomicU64::new(0) }),
        }
    }

    /// The property of a whole formula: goal if it is `EF` or `AG` of a state formula.
    pub(super) fn of_formula(formula: &'q Bound) -> Self {
        let goal = |formula, is_existential| Self::Goal(Goal::of(formula, is_existential));
        match formula {
            Bound::Until { quantifier: Quantifier::Some, weak: false, hold, release }
                if **hold == Bound::Truth(true) && release.is_state_formula() =>
            {
                goal(release, true)
            }
            Bound::Until { quantifier: Quantifier::All, weak: true, hold, release }
                if **release == Bound::Truth(false) && hold.is_state_formula() =>
            {
                goal(hold, false)
            }
            _ => Self::Paths(formula),
        }
    }

    /// Whether the graph can decide more than the figures.
    pub(super) fn needs_the_graph(&self) -> bool {
        matches!(self, Self::Paths(_) | Self::Whole(Examination::Liveness))
    }

    /// What a marking must have to decide the question, or to raise what is known of it.
    pub(super) fn aim(&self) -> Option<crate::Goal> {
        match self {
            Self::Goal(goal) => aim(goal.formula, goal.is_existential),
            Self::Most(most) => Some(most.aim()),
            Self::Whole(_) | Self::Paths(_) => None,
        }
    }

    /// Answer from a run to the goal. The run is replayed first; a last marking that misses the goal is an error.
    pub(super) fn reached(&self, net: &Net, firings: Vec<TransitionId>, by: Means) -> Option<Reply> {
        let last = match last_marking(net, &firings) {
            Ok(last) => last,
            Err(what) => return Some(refuted(&what)),
        };
        match self {
            Self::Goal(goal) => Some(goal.shown_by(net, firings, &last, by == Means::StubbornSets)),
            Self::Most(most) => {
                let before = most.tokens.fetch_max(most.sum(|place| last.on(place)), Ordering::Relaxed);
                let is_more = before < most.tokens.load(Ordering::Relaxed);
                (!is_more).then(|| refuted("the last marking has no more tokens"))
            }
            Self::Whole(_) | Self::Paths(_) => None,
        }
    }

    /// Answer if the goal is unreachable.
    pub(super) fn absent(&self) -> Option<Reply> {
        match self {
            Self::Goal(goal) if goal.is_existential => Some(Reply::Violated(None)),
            Self::Goal(_) => Some(Reply::Holds(None)),
            Self::Most(most) => Some(Reply::Most(most.tokens.load(Ordering::Relaxed))),
            Self::Whole(_) | Self::Paths(_) => None,
        }
    }

    fn look(&self, view: &View<'_>) {
        match self {
            Self::Goal(goal) => goal.look(view),
            Self::Most(most) => most.look(view),
            Self::Whole(_) | Self::Paths(_) => {}
        }
    }

    /// Answer from an exploration, if it suffices.
    pub(super) fn reply(&self, net: &Net, exploration: &Exploration) -> Option<Reply> {
        match self {
            Self::Whole(examination) => examination.reply(net, exploration),
            Self::Goal(goal) if goal.is_found() => goal.reply(net, exploration),
            _ if exploration.stop == Stop::Complete => self.absent(),
            _ => None,
        }
    }

    fn is_over(&self) -> bool {
        matches!(self, Self::Goal(goal) if goal.is_found())
    }

    /// Forgets a state that will not be kept. A maximum stays: the marking was reached all the same.
    fn forget(&self) {
        if let Self::Goal(goal) = self {
            goal.forget();
        }
    }
}

impl<'q> Goal<'q> {
    fn of(formula: &'q Bound, is_existential: bool) -> Self {
        Self { formula, is_existential, is_found: AtomicBool::new(false), found: Mutex::new(None) }
    }

    fn is_found(&self) -> bool {
        self.is_found.load(Ordering::Acquire)
    }

    fn look(&self, view: &View<'_>) {
        if !self.is_found()
            && self.formula.holds_in(&Seen(view)) == Some(self.is_existential)
            && let Ok(mut found) = self.found.lock()
        {
            found.get_or_insert_with(|| view.marking());
            self.is_found.store(true, Ordering::Release);
        }
    }

    fn forget(&self) {
        if let Ok(mut found) = self.found.lock() {
            *found = None;
            self.is_found.store(false, Ordering::Release);
        }
    }

    /// Answer from the state found, if any.
    fn reply(&self, net: &Net, exploration: &Exploration) -> Option<Reply> {
        let shown = |(firings, last): (Vec<TransitionId>, Tokens)| self.shown_by(net, firings, &last, true);
        let found = self.found.lock().ok()?.clone()?;
        Some(way(net, exploration, &found).map_or_else(|what| refuted(&what), shown))
    }

    /// Answer from a run to a marking.
    fn shown_by(&self, net: &Net, firings: Vec<TransitionId>, last: &Tokens, is_shortest: bool) -> Reply {
        if self.formula.holds_in(&Played(net, last)) != Some(self.is_existential) {
            return refuted("the last marking does not show it");
        }
        let run = Run { firings, is_shortest, ..Run::default() };
        if self.is_existential { Reply::Holds(Some(run)) } else { Reply::Violated(Some(run)) }
    }
}

impl Most<'_> {
    fn look(&self, view: &View<'_>) {
        self.tokens.fetch_max(self.sum(|place| view.tokens(place.index())), Ordering::Relaxed);
    }

    fn sum(&self, tokens: impl Fn(PlaceId) -> u64) -> u64 {
        self.places.iter().map(|&place| tokens(place)).fold(0, u64::saturating_add)
    }

    /// A marking with more tokens than any known.
    fn aim(&self) -> crate::Goal {
        let mut terms: BTreeMap<u32, i64> = BTreeMap::new();
        self.places.iter().for_each(|place| *terms.entry(place.index() as u32).or_default() += 1);
        let least = i128::from(self.tokens.load(Ordering::Relaxed)) + 1;
        crate::Goal::AtLeast { terms: terms.into_iter().collect(), least }
    }
}

/// A state as the search shows it.
pub(super) struct Seen<'v>(pub(super) &'v View<'v>);

impl Valuation for Seen<'_> {
    fn value(&self, _: VarId) -> u64 {
        0
    }

    fn is_marked(&self, place: PlaceId) -> bool {
        self.tokens(place) > 0
    }

    fn tokens(&self, place: PlaceId) -> u64 {
        self.0.tokens(place.index())
    }

    fn is_enabled(&self, transition: TransitionId) -> bool {
        self.0.is_enabled(transition.index())
    }

    fn is_deadlock(&self) -> bool {
        self.0.is_deadlock()
    }
}

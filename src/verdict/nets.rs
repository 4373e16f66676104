//! Questions about a net alone, all answered by one exploration: what can be reached, on the way; what speaks of paths, on the
//! whole graph.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

use fixedbitset::FixedBitSet;
use rayon::prelude::*;

use super::check::is_existential;
use crate::explore::engine::{Exploration, Figures, Model, Options, View, explore};
use crate::explore::{Graph, Progress, Stop};
use crate::logic::{Bound, Dag, Labels, Node, NodeId, Quantifier, Valuation, evidence, label_from};
use crate::net::{Net, PlaceId, Tokens, TransitionId};
use crate::semantics::VarId;

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
#[must_use]
pub fn judge(
    net: &Net,
    questions: &[Question],
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
) -> NetReport {
    let hunts: Vec<Hunt<'_>> = questions.iter().map(Hunt::of).collect();
    let may_stop = hunts.iter().all(|hunt| matches!(hunt, Hunt::Goal { .. }));
    let wanted = |view: &View<'_>| {
        hunts.iter().for_each(|hunt| hunt.look(view));
        may_stop && hunts.iter().all(Hunt::is_over)
    };
    let options = Options { keep: true, ..*options };
    let exploration = explore(&Model::from(net), &options, watch, Some(&wanted));
    let on_paths = hunts.iter().any(|hunt| matches!(hunt, Hunt::Paths(_))) && exploration.stop == Stop::Complete;
    let graph = on_paths.then(|| Paths::of(net, &exploration)).flatten();
    let replies = hunts.par_iter().map(|hunt| match hunt {
        Hunt::Goal { formula, is_existential, found } => match found.get() {
            Some(marking) => shown(net, &exploration, formula, *is_existential, marking),
            None if exploration.stop != Stop::Complete => Reply::Unknown(exploration.stop.to_string()),
            None if *is_existential => Reply::Violated(None),
            None => Reply::Holds(None),
        },
        Hunt::Most(_, most) => match exploration.stop {
            Stop::Complete => Reply::Most(most.load(Ordering::Relaxed)),
            _ => Reply::Unknown(exploration.stop.to_string()),
        },
        Hunt::Paths(formula) => match &graph {
            Some(paths) => paths.reply(formula),
            None if exploration.stop == Stop::Complete => Reply::Unknown("the graph has too many states".to_owned()),
            None => Reply::Unknown(exploration.stop.to_string()),
        },
    });
    NetReport { replies: replies.collect(), figures: exploration.figures.clone(), stop: exploration.stop.clone() }
}

/// What is looked for in each state.
enum Hunt<'q> {
    /// A state where the formula is true, for `EF`; or false, for `AG`.
    Goal { formula: &'q Bound, is_existential: bool, found: OnceLock<Vec<u64>> },
    /// The most tokens.
    Most(&'q [PlaceId], AtomicU64),
    /// Nothing: states alone do not tell.
    Paths(&'q Bound),
}

impl<'q> Hunt<'q> {
    fn of(question: &'q Question) -> Self {
        let formula = match question {
            Question::Most(places) => return Self::Most(places, AtomicU64::new(0)),
            Question::Holds(formula) => formula,
        };
        let goal = |formula, is_existential| Self::Goal { formula, is_existential, found: OnceLock::new() };
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

    fn look(&self, view: &View<'_>) {
        match self {
            Self::Goal { formula, is_existential, found } => {
                if found.get().is_none() && formula.holds_in(&Seen(view)) == Some(*is_existential) {
                    let _ = found.set(view.marking());
                }
            }
            Self::Most(places, most) => {
                let sum = places.iter().map(|place| view.tokens(place.index())).sum();
                most.fetch_max(sum, Ordering::Relaxed);
            }
            Self::Paths(_) => {}
        }
    }

    fn is_over(&self) -> bool {
        matches!(self, Self::Goal { found, .. } if found.get().is_some())
    }
}

/// The reply that a marking gives to `EF` or `AG` of a formula.
fn shown(net: &Net, exploration: &Exploration, formula: &Bound, is_existential: bool, marking: &[u64]) -> Reply {
    let Some(firings) = exploration.firings(marking) else {
        return Reply::Unknown(
            "the way to a marking is lost, which is an error in Petril; please report it".to_owned(),
        );
    };
    let run = Run { firings: firings.into_iter().map(TransitionId::at).collect(), loop_start: None };
    match replayed(net, &run) {
        Ok(markings) => {
            let last = &markings[markings.len() - 1];
            if formula.holds_in(&Played(net, last)) != Some(is_existential) {
                return refuted("the last marking does not show it");
            }
            if is_existential { Reply::Holds(Some(run)) } else { Reply::Violated(Some(run)) }
        }
        Err(what) => refuted(&what),
    }
}

fn refuted(what: &str) -> Reply {
    let message = "the replay refutes the search, which is an error in Petril; please report it";
    Reply::Unknown(format!("{message}: {what}"))
}

/// The markings of a run, by the plain firing rule.
fn replayed(net: &Net, run: &Run) -> Result<Vec<Tokens>, String> {
    let mut tokens = net.initial_tokens();
    let mut markings = vec![tokens.clone()];
    for &transition in &run.firings {
        let name = net.transition(transition).name;
        if !net.has_concession(&tokens, transition) {
            return Err(format!("`{name}` is not enabled"));
        }
        net.play(&mut tokens, transition).map_err(|_| format!("`{name}` puts too many tokens"))?;
        markings.push(tokens.clone());
    }
    match run.loop_start {
        Some(start) if markings[start] != tokens => Err("the loop does not close".to_owned()),
        _ => Ok(markings),
    }
}

/// The whole graph, for formulas about paths.
struct Paths<'e> {
    net: &'e Net,
    exploration: &'e Exploration,
    graph: Graph,
    /// Where the firings of each state begin in `fired`.
    starts: Vec<u64>,
    /// The transition of each step, in the order of the graph's rows.
    fired: Vec<u32>,
}

impl<'e> Paths<'e> {
    fn of(net: &'e Net, exploration: &'e Exploration) -> Option<Self> {
        let (starts, targets, fired) = exploration.steps(true)?.into_parts();
        let graph = Graph::of_rows(starts.clone(), targets);
        Some(Self { net, exploration, graph, starts, fired })
    }

    fn reply(&self, formula: &Bound) -> Reply {
        let mut dag = Dag::default();
        let (yes, no) = (dag.add(formula, false), dag.add(formula, true));
        let mut atoms = self.atoms(&dag);
        let labels = label_from(&self.graph, &dag, &mut |node, _| std::mem::take(&mut atoms[node.index()]), None);
        let holds = labels.of(yes).contains(0);
        let shows = if holds { yes } else { no };
        let run = if is_existential(&dag, shows) { self.run(&dag, &labels, shows) } else { Ok(None) };
        match run {
            Ok(run) if holds => Reply::Holds(run),
            Ok(run) => Reply::Violated(run),
            Err(what) => refuted(&what),
        }
    }

    /// The states in which each formula about one state holds.
    fn atoms(&self, dag: &Dag) -> Vec<FixedBitSet> {
        let states = self.graph.len();
        let mut sets: Vec<FixedBitSet> = dag.nodes().iter().map(|_| FixedBitSet::new()).collect();
        let formulas = dag.nodes().iter().enumerate().filter_map(|(position, node)| match node {
            Node::State { formula, .. } => Some((position, formula)),
            _ => None,
        });
        let formulas: Vec<(usize, &Bound)> = formulas.collect();
        formulas.iter().for_each(|&(position, _)| sets[position].grow(states));
        self.exploration.for_each_state(|state, view| {
            for &(position, formula) in &formulas {
                if formula.holds_in(&Seen(view)) == Some(true) {
                    sets[position].insert(state as usize);
                }
            }
        });
        sets
    }

    /// A run that shows a node at the initial state, replayed with everything it claims of single states.
    fn run(&self, dag: &Dag, labels: &Labels, node: NodeId) -> Result<Option<Run>, String> {
        let Some(evidence) = evidence(&self.graph, dag, labels, None, node, &[0]) else { return Ok(None) };
        let targets = evidence.states.iter().skip(1).copied().chain(evidence.loop_start.map(|i| evidence.states[i]));
        let firings = evidence.states.iter().zip(targets).map(|(&from, to)| {
            let position = self.graph.successors(from).iter().position(|&target| target == to)?;
            Some(TransitionId::at(self.fired[self.starts[from as usize] as usize + position] as usize))
        });
        let firings: Option<Vec<TransitionId>> = firings.collect();
        let run = Run { firings: firings.ok_or("a step is not there")?, loop_start: evidence.loop_start };
        let markings = replayed(self.net, &run)?;
        for claim in &evidence.claims {
            if let Node::State { formula, negated } = dag.node(claim.node)
                && formula.holds_in(&Played(self.net, &markings[claim.position])) != Some(!*negated)
            {
                return Err(format!("marking {} does not show it", claim.position));
            }
        }
        Ok(Some(run))
    }
}

/// A state as the search shows it.
struct Seen<'v>(&'v View<'v>);

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

/// A marking of the replay.
struct Played<'n>(&'n Net, &'n Tokens);

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

//! Vacuity: whether the premises of a requirement that holds ever occur, and a run in which they do.

use fixedbitset::FixedBitSet;

use super::views::SystemView;
use super::{Note, Vacuity, Witness};
use crate::witness::Disagreement;
use petril_logic::{Bound, Dag, Fairness, Premise, Step, label, premises, shortest};
use petril_search::Graph;

/// Result for the premises of a requirement.
#[derive(Default)]
pub struct Occurrence {
    /// First premise that never occurs where the requirement uses it.
    pub vacuous: Option<Vacuity>,
    /// In the scan view, if all premises occur: a run to the first one and to those nested in its conclusion.
    pub example: Option<Witness>,
}

/// Searches a complete graph for the premises of a requirement.
pub fn occurrence(
    view: &dyn SystemView,
    graph: &Graph,
    paths: Option<&Fairness>,
    formula: &Bound,
) -> Result<Occurrence, Disagreement> {
    let premises = premises(formula);
    let mut told: Option<(&Premise<'_>, Vec<FixedBitSet>)> = None;
    for premise in &premises {
        let sets = sets(view, graph, paths, premise);
        let reached = match is_anywhere(premise.way.first()) {
            true => !sets[1].is_clear(),
            false => graph.initial().iter().any(|&state| sets[0].contains(state as usize)),
        };
        if !reached {
            let text = premise.formula.text(view.system());
            let somewhere = sets.last().is_some_and(|set| !set.is_clear());
            let vacuous = if somewhere { Vacuity::NotThere(text) } else { Vacuity::Nowhere(text) };
            return Ok(Occurrence { vacuous: Some(vacuous), example: None });
        }
        // Nested premises belong to one chain.
        let goes_on = told
            .as_ref()
            .is_none_or(|(before, _)| premise.way.len() > before.way.len() && premise.way.starts_with(&before.way));
        if view.scans().is_some() && goes_on {
            told = Some((premise, sets));
        }
    }
    let example = told.map(|(premise, sets)| Example::of(view, graph, paths, premise, &sets)).transpose()?;
    Ok(Occurrence { vacuous: None, example })
}

/// Whether a way begins with a step to any state; all states are reachable.
fn is_anywhere(step: Option<&Step<'_>>) -> bool {
    matches!(step, Some(Step::Eventually(Bound::Truth(false))))
}

/// For each suffix of the way, the states from which it can be followed. A first step to any state is not computed.
fn sets(view: &dyn SystemView, graph: &Graph, paths: Option<&Fairness>, premise: &Premise<'_>) -> Vec<FixedBitSet> {
    let rests = premise.rests();
    let skipped = usize::from(is_anywhere(premise.way.first()));
    let mut dag = Dag::default();
    let nodes: Vec<_> = rests[skipped..].iter().map(|rest| dag.add(rest, false)).collect();
    let holds = |formula: &Bound, state: u32| view.holds(formula, graph.state(state));
    let labels = label(graph, &dag, &holds, paths);
    // Only states of fair runs count.
    let counting = |set: &FixedBitSet| paths.map_or_else(|| set.clone(), |paths| set & paths.surely());
    let known = nodes.into_iter().map(|node| counting(labels.of(node)));
    std::iter::repeat_n(FixedBitSet::new(), skipped).chain(known).collect()
}

/// Run to a premise, and on to the step that its conclusion is about.
struct Example<'a> {
    view: &'a dyn SystemView,
    graph: &'a Graph,
    paths: Option<&'a Fairness>,
    states: Vec<u32>,
    /// State formulas shown, with their positions.
    claims: Vec<(usize, &'a Bound)>,
}

impl<'a> Example<'a> {
    fn of(
        view: &'a dyn SystemView,
        graph: &'a Graph,
        paths: Option<&'a Fairness>,
        premise: &Premise<'a>,
        sets: &[FixedBitSet],
    ) -> Result<Witness, Disagreement> {
        let mut example = Self { view, graph, paths, states: Vec::new(), claims: Vec::new() };
        example.walk(premise, sets);
        example.claim(premise.formula);
        example.follow(premise.conclusion);
        example.witness()
    }

    /// Follows the way by shortest paths.
    fn walk(&mut self, premise: &Premise<'a>, sets: &[FixedBitSet]) {
        let lowest = |set: &FixedBitSet, of: &[u32]| of.iter().copied().find(|&state| set.contains(state as usize));
        let anywhere = is_anywhere(premise.way.first());
        if anywhere {
            // States are numbered by distance (breadth-first).
            let nearest = sets[1].ones().next().map(|state| state as u32);
            self.states = nearest.map(|state| self.graph.path_to(state)).unwrap_or_default();
        } else {
            self.states.extend(lowest(&sets[0], self.graph.initial()));
        }
        for (number, step) in premise.way.iter().enumerate().skip(usize::from(anywhere)) {
            let Some(&state) = self.states.last() else { return };
            let goal = &sets[number + 1];
            match step {
                Step::Given(earlier) => self.claim(earlier),
                Step::Next => self.states.extend(lowest(goal, self.graph.successors(state))),
                Step::Eventually(end) => {
                    let mut within = FixedBitSet::with_capacity(self.graph.len());
                    within.extend(self.graph.ids().filter(|&id| !self.holds(end, id)).map(|id| id as usize));
                    let way = shortest(self.graph, state, &within, false, |id| goal.contains(id as usize));
                    self.states.extend(way.unwrap_or_default());
                }
            }
        }
    }

    /// Continues to the states that the conclusion is about.
    fn follow(&mut self, mut conclusion: &'a Bound) {
        while let Some(&state) = self.states.last() {
            match conclusion {
                Bound::Next(_, f) => {
                    let next = self.graph.successors(state).iter().copied().find(|&next| self.counts(next));
                    self.states.extend(next);
                    conclusion = f;
                }
                Bound::Until { weak: false, release, .. } if release.is_state_formula() => {
                    let mut all = FixedBitSet::with_capacity(self.graph.len());
                    all.insert_range(..);
                    let way = shortest(self.graph, state, &all, false, |id| self.holds(release, id) && self.counts(id));
                    let Some(way) = way else { return };
                    self.states.extend(way);
                    return self.claim(release);
                }
                _ => return,
            }
        }
    }

    /// Whether a fair run surely begins in the state.
    fn counts(&self, state: u32) -> bool {
        self.paths.is_none_or(|paths| paths.surely().contains(state as usize))
    }

    fn holds(&self, formula: &Bound, state: u32) -> bool {
        self.view.holds(formula, self.graph.state(state))
    }

    fn claim(&mut self, formula: &'a Bound) {
        if formula.is_state_formula() && !matches!(formula, Bound::Truth(_)) {
            self.claims.push((self.states.len().saturating_sub(1), formula));
        }
    }

    /// Replays the run and checks its claims.
    fn witness(self) -> Result<Witness, Disagreement> {
        let states: Vec<&[u64]> = self.states.iter().map(|&state| self.graph.state(state)).collect();
        let text = |formula: &Bound| formula.text(self.view.system());
        let trace = self.view.replayed(&states, None, &|position, holds| {
            let claims = self.claims.iter().filter(|(at, _)| *at == position);
            match claims.map(|(_, formula)| formula).find(|formula| holds(formula) != Some(true)) {
                Some(formula) => Err(Disagreement(format!("the replay does not show that `{}` holds", text(formula)))),
                None => Ok(()),
            }
        })?;
        let note = |&(at, formula): &(usize, &Bound)| Note {
            first: at,
            last: at,
            text: format!("`{}` is true", text(formula)),
        };
        Ok(Witness { trace, notes: self.claims.iter().map(note).collect() })
    }
}

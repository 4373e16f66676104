//! Verdicts on LTL formulas.

use std::cell::RefCell;

use super::fairness::states_where;
use super::judge::Judge;
use super::views::witness;
use super::{Outcome, Vacuity};
use crate::witness::Holds;
use petril_logic::{Bound, Claim, Constraints, Counterexample, Dag, Evidence, Path, Search, search};

impl Judge<'_> {
    /// Decides whether an LTL formula holds on all paths.
    pub(super) fn outcome_on_paths(&self, path: &Path<Bound>) -> Outcome {
        let Self { view, graph, fair, budget, .. } = *self;
        let none = Constraints::default();
        let constraints = fair.map_or(&none, |fair| fair.paths.constraints());
        let is_true = match search(graph, path, constraints, &|atom| states_where(view, atom), budget) {
            Search::Found(found) => return self.violated(path, found),
            Search::Stopped(stop) => {
                return Outcome::Unknown(format!("{stop} while the formula was followed along the paths"));
            }
            Search::TooLarge => {
                return Outcome::Unknown("the formula is too large to be followed along paths".to_owned());
            }
            Search::Open => false,
            Search::None => true,
        };
        if let Some(reason) = self.undecided(is_true) {
            return Outcome::Unknown(reason);
        }
        let mut never = |premise: &Bound| graph.is_complete() && self.holds_nowhere(premise);
        let vacuous = path.vacuous_premise(&mut never).map(|premise| Vacuity::Nowhere(premise.text(view.system())));
        Outcome::Holds { vacuous, witness: None, example: None }
    }

    /// Replays a counterexample. The formula is evaluated once more on the atoms that the replay shows.
    fn violated(&self, path: &Path<Bound>, found: Counterexample) -> Outcome {
        let mut dag = Dag::default();
        let claims = found.atoms.iter().map(|(position, atom, value)| {
            let node = dag.add(atom, !value);
            Claim { position: *position, node }
        });
        let claims = claims.collect();
        let Counterexample { states, loop_start, .. } = found;
        let (len, evidence) = (states.len(), Evidence { states, loop_start, claims });
        let atoms = path.atoms();
        let seen = RefCell::new(vec![Vec::new(); len + 1]);
        let look = |position: usize, holds: Holds<'_>| {
            if let Some(seen) = seen.borrow_mut().get_mut(position) {
                *seen = atoms.iter().map(|atom| holds(atom) == Some(true)).collect();
            }
        };
        let assumed = self.fair.map_or(&[][..], |fair| fair.assumptions);
        let witness = match witness(self.view, &dag, &evidence, assumed, &look) {
            Ok(witness) => witness,
            Err(disagreement) => return Outcome::refuted(&disagreement.to_string()),
        };
        let seen = seen.into_inner();
        let mut next = 0;
        let numbered = path.map(&mut |_| {
            next += 1;
            next - 1
        });
        let holds = |atom: &usize, position: usize| seen[position].get(*atom).copied().unwrap_or(false);
        if numbered.holds_on(len, loop_start, &holds) {
            return Outcome::refuted("the formula is true on the run that should show that it is not");
        }
        Outcome::Violated(witness, None)
    }
}

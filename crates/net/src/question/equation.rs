//! Reachability goals excluded by the state equation (marking equation).

use std::sync::atomic::AtomicBool;

use crate::Goal;
use crate::net::{Net, PlaceId, TransitionId};
use crate::structure::state_equation::{Constraint, Outcome, Problem, Relation};

/// Upper bound on the number of linear programs per goal.
const PROGRAMS: usize = 40;

/// Whether no solution of the state equation satisfies the goal, as far as about `steps` elementary steps can tell.
/// Non-linear parts of the goal are dropped, which is an over-approximation.
///
/// Once `stopping` is set, nothing more is excluded.
pub(super) fn is_impossible(problem: &Problem<'_>, net: &Net, goal: &Goal, steps: u64, stopping: &AtomicBool) -> bool {
    let mut work = Work { problem, net, programs: PROGRAMS, steps: steps / PROGRAMS as u64 * 4, stopping };
    work.excludes(vec![goal], Vec::new(), Vec::new())
}

struct Work<'a> {
    problem: &'a Problem<'a>,
    net: &'a Net,
    programs: usize,
    steps: u64,
    stopping: &'a AtomicBool,
}

impl Work<'_> {
    /// Whether the goals, the constraints, and one alternative of each choice are infeasible together.
    fn excludes<'g>(
        &mut self,
        mut goals: Vec<&'g Goal>,
        mut constraints: Vec<Constraint>,
        mut choices: Vec<Choice<'g>>,
    ) -> bool {
        while let Some(goal) = goals.pop() {
            match goal {
                Goal::Truth(false) => return true,
                Goal::AtLeast { terms, least } => match constraint(terms, *least) {
                    Some(constraint) => constraints.push(constraint),
                    None if terms.is_empty() && *least > 0 => return true,
                    None => {}
                },
                Goal::Enabled(id) => {
                    let needs = self.net.pre(TransitionId::at(*id as usize));
                    constraints
                        .extend(needs.filter_map(|(place, weight)| constraint(&[(number(place), 1)], weight.into())));
                }
                Goal::Disabled(id) => choices.push(Choice::Disabled(*id)),
                Goal::Any(parts) => choices.push(Choice::Goals(parts)),
                Goal::All(parts) => goals.extend(parts),
                // "Some transition is enabled" would be a choice among all; a deadlock, too many choices.
                Goal::Truth(true) | Goal::Dead | Goal::Alive => {}
            }
        }
        if !constraints.is_empty() {
            let Some(left) = self.programs.checked_sub(1) else { return false };
            self.programs = left;
            match self.problem.solve_until(&constraints, self.steps, self.stopping) {
                Outcome::Infeasible(_) => return true,
                Outcome::Feasible(_) => {}
                Outcome::Unknown => return false,
            }
        }
        let Some(choice) = choices.pop() else { return false };
        match choice {
            Choice::Goals(parts) => {
                parts.iter().all(|part| self.excludes(vec![part], constraints.clone(), choices.clone()))
            }
            Choice::Disabled(id) => {
                let too_few: Vec<Option<Constraint>> = (self.net.pre(TransitionId::at(id as usize)))
                    .map(|(place, weight)| constraint(&[(number(place), -1)], 1 - i128::from(weight)))
                    .collect();
                too_few.into_iter().all(|too_few| {
                    let constraints = constraints.iter().cloned().chain(too_few).collect();
                    self.excludes(Vec::new(), constraints, choices.clone())
                })
            }
        }
    }
}

/// Disjunction of which one alternative has to hold.
#[derive(Clone, Copy)]
enum Choice<'g> {
    Goals(&'g [Goal]),
    /// Some place of the transition's preset has too few tokens.
    Disabled(u32),
}

fn number(place: PlaceId) -> u32 {
    place.index() as u32
}

/// A comparison as a constraint; `None` without terms or if a number is too large.
fn constraint(terms: &[(u32, i64)], least: i128) -> Option<Constraint> {
    if terms.is_empty() {
        return None;
    }
    let terms = terms.iter().map(|&(place, factor)| (PlaceId::at(place as usize), factor)).collect();
    Some(Constraint { terms, relation: Relation::AtLeast, value: least.try_into().ok()? })
}

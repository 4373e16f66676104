//! Proofs and counterexamples by SAT: bounded model checking and strengthened k-induction.
//!
//! First, one scan from any state of the carried bits: what is excluded there is excluded everywhere. Then, in turns,
//! runs of k scans from power-on, and k-induction (Sheeran, Singh and Stålmarck, "Checking safety properties using
//! induction and a SAT-solver", 2000): a property that holds in the first k scans, and after any k scans in which it
//! holds, always holds. States are required to differ pairwise, which makes the method complete. The induction
//! hypothesis is strengthened by all goals not refuted yet.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::run::Given;
use super::subject::Subject;
use super::unrolled::{Frame, Network};
use crate::sif::{Answer, Literal, Solver, Stop};

/// Bad-state property: something that must never be true at the end of a scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Goal {
    /// The claim at this position is violated.
    Claim(usize),
    /// The scan meets the error at this position in the list of the gates.
    Error(usize),
}

impl Goal {
    /// Positions of the restrictions that its scans satisfy.
    pub(super) fn restrictions<'s>(self, subject: &'s Subject<'_>) -> &'s [usize] {
        match self {
            Self::Claim(claim) => &subject.claims[claim].restrictions,
            Self::Error(_) => &subject.everywhere,
        }
    }

    /// Position of its claim.
    pub(super) fn claim(self) -> Option<usize> {
        match self {
            Self::Claim(claim) => Some(claim),
            Self::Error(_) => None,
        }
    }
}

/// Result for a goal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Finding {
    /// Excluded from any state, reachable or not.
    AnyState,
    /// Excluded by induction over this number of scans.
    Induction(usize),
    /// Reached in the last scan of a shortest run with these inputs.
    Run(Vec<Given>),
    /// Undecided, with the reason.
    Open(String),
}

/// Limits of the search.
pub(super) struct Bounds {
    /// Upper bound on the scans of a run, and of an induction.
    pub(super) scans: usize,
    /// Upper bound on conflicts of the solver per question.
    pub(super) conflicts: u64,
    /// Whether to stop.
    pub(super) stop: Stop,
}

/// Goals of a network.
pub(super) fn goals(network: &Network<'_>) -> Vec<Goal> {
    let claims = (0..network.subject.claims.len()).map(Goal::Claim);
    claims.chain((0..network.gates.errors.len()).map(Goal::Error)).collect()
}

/// Decides all goals, as far as the limits allow.
pub(super) fn search(network: &Network<'_>, bounds: &Bounds) -> Vec<Finding> {
    let goals = goals(network);
    let left = Arc::new(AtomicU64::new(0));
    let stop = {
        let (left, stop) = (left.clone(), bounds.stop.clone());
        // The solver calls this once per conflict.
        let none_left =
            move || left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1)).is_err();
        Arc::new(move || none_left() || stop()) as Stop
    };
    let mut search = Search {
        network,
        bounds,
        left,
        runs: Side::new(&stop, false, network),
        steps: Side::new(&stop, true, network),
        findings: vec![None; goals.len()],
        goals,
    };
    search.decide();
    let open = || Finding::Open("it was not reached".to_owned());
    search.findings.into_iter().map(|finding| finding.unwrap_or_else(open)).collect()
}

/// A solver with an unrolling of scans.
struct Side {
    solver: Solver,
    frames: Vec<Frame>,
}

impl Side {
    /// Unrolls one scan, from any state or from power-on.
    fn new(stop: &Stop, from_any: bool, network: &Network<'_>) -> Self {
        let mut solver = Solver::new(stop);
        let start = if from_any { network.any_state(&mut solver) } else { network.power_on(&solver) };
        let frame = network.scan(&mut solver, &start);
        Self { solver, frames: vec![frame] }
    }

    /// Unrolls one scan more; the scans before it are required not to fail.
    fn extend(&mut self, network: &Network<'_>, all_differ: bool) {
        let Some(last) = self.frames.last() else { return };
        self.solver.require([!last.fails]);
        let frame = network.scan(&mut self.solver, &last.end.clone());
        if all_differ {
            self.frames.iter().for_each(|earlier| earlier.start.differ(&frame.start, &mut self.solver));
        }
        self.frames.push(frame);
    }
}

struct Search<'n> {
    network: &'n Network<'n>,
    bounds: &'n Bounds,
    /// Conflicts left for the current question.
    left: Arc<AtomicU64>,
    runs: Side,
    steps: Side,
    goals: Vec<Goal>,
    findings: Vec<Option<Finding>>,
}

impl Search<'_> {
    fn decide(&mut self) {
        for goal in 0..self.goals.len() {
            let possible = self.possible(goal);
            self.findings[goal] = possible.err().map(Finding::Open);
        }
        for goal in self.undecided() {
            if self.ask_step(goal, &[]) == Answer::Unsatisfiable {
                self.findings[goal] = Some(Finding::AnyState);
            }
        }
        for scans in 1..=self.bounds.scans {
            if scans > 1 {
                self.runs.extend(self.network, false);
            }
            self.runs_of(scans);
            if self.undecided().is_empty() {
                return;
            }
            self.steps.extend(self.network, true);
            self.induction(scans);
            if self.undecided().is_empty() {
                return;
            }
            if (self.bounds.stop)() {
                break;
            }
        }
        let scans = self.runs.frames.len().min(self.bounds.scans);
        let bits = self.steps.frames[0].start.bits();
        for goal in self.undecided() {
            let reason = if (self.bounds.stop)() {
                format!("the search was stopped after runs of {scans} scans")
            } else {
                let what = if self.goals[goal].claim().is_some() { "shows a difference" } else { "meets it" };
                format!(
                    "no run of up to {scans} scans {what}, and induction over {scans} scans does not exclude longer ones ({bits} \
                     bits are carried from scan to scan)"
                )
            };
            self.findings[goal] = Some(Finding::Open(reason));
        }
    }

    fn undecided(&self) -> Vec<usize> {
        (0..self.goals.len()).filter(|&goal| self.findings[goal].is_none()).collect()
    }

    /// Positions of the restrictions that a goal's scans satisfy.
    fn restrictions(&self, goal: usize) -> &[usize] {
        self.goals[goal].restrictions(self.network.subject)
    }

    /// Literals of a goal's restrictions in all frames.
    fn allowed(&self, goal: usize, frames: &[Frame]) -> Vec<Literal> {
        let used = &self.network.subject.restrictions;
        let at: Vec<usize> = self.restrictions(goal).iter().filter_map(|at| used.binary_search(at).ok()).collect();
        frames.iter().flat_map(|frame| at.iter().map(|&at| frame.allowed[at])).collect()
    }

    /// Checks that a first scan can satisfy a goal's restrictions; else the error says why nothing is proved.
    fn possible(&mut self, goal: usize) -> Result<(), String> {
        let mut assumed = self.allowed(goal, &self.runs.frames);
        if self.solve(false, &assumed) == Answer::Unsatisfiable {
            return Err("its restrictions contradict each other, so no scan can begin and nothing is proved".to_owned());
        }
        if matches!(self.goals[goal], Goal::Claim(_)) {
            assumed.push(!self.runs.frames[0].fails);
            if self.solve(false, &assumed) == Answer::Unsatisfiable {
                return Err("every scan that its restrictions allow fails".to_owned());
            }
        }
        Ok(())
    }

    fn solve(&mut self, steps: bool, assumed: &[Literal]) -> Answer {
        self.left.store(self.bounds.conflicts, Ordering::Relaxed);
        let side = if steps { &mut self.steps } else { &mut self.runs };
        side.solver.solve(assumed)
    }

    /// Literals that make the last scan bad.
    fn bad(&self, goal: usize, frame: &Frame) -> Vec<Literal> {
        match self.goals[goal] {
            Goal::Claim(claim) => vec![frame.wrong[claim], !frame.fails],
            Goal::Error(error) => vec![frame.errors[error]],
        }
    }

    /// Induction step: whether the last of the scans from any state can be bad after scans in which the others hold.
    fn ask_step(&mut self, goal: usize, others: &[usize]) -> Answer {
        let Some((last, before)) = self.steps.frames.split_last() else { return Answer::Stopped };
        let mut assumed = self.bad(goal, last);
        if assumed[0] == self.steps.solver.constant(false) {
            return Answer::Unsatisfiable;
        }
        assumed.extend(self.allowed(goal, &self.steps.frames));
        for &other in others {
            // A claim that holds under fewer restrictions holds under more.
            let holds_here = self.restrictions(other).iter().all(|at| self.restrictions(goal).contains(at));
            if let (Goal::Claim(claim), true) = (self.goals[other], holds_here) {
                assumed.extend(before.iter().map(|frame| !frame.wrong[claim]));
            }
        }
        self.solve(true, &assumed)
    }

    /// Bounded model checking: looks for runs of exactly `scans` scans from power-on whose last scan is bad.
    fn runs_of(&mut self, scans: usize) {
        for goal in self.undecided() {
            let frames = &self.runs.frames[..scans];
            let mut assumed = self.bad(goal, &frames[scans - 1]);
            assumed.extend(self.allowed(goal, frames));
            self.findings[goal] = match self.solve(false, &assumed) {
                Answer::Unsatisfiable => None,
                Answer::Satisfiable => {
                    let given = self.runs.frames.iter().map(|frame| self.network.given(&self.runs.solver, frame));
                    Some(Finding::Run(given.collect()))
                }
                Answer::Stopped => Some(Finding::Open(format!("the solver gave up on runs of {scans} scans"))),
            };
        }
    }

    /// Strengthened k-induction with k = `scans`: the hypothesis is that all goals still believed excluded are excluded
    /// in the first k scans. Goals that fail are removed until a fixpoint is reached.
    fn induction(&mut self, scans: usize) {
        let right =
            |finding: &Option<Finding>| matches!(finding, None | Some(Finding::AnyState | Finding::Induction(_)));
        let mut thought: Vec<usize> = (0..self.goals.len()).filter(|&goal| right(&self.findings[goal])).collect();
        loop {
            let count = thought.len();
            for goal in thought.clone() {
                if self.findings[goal].is_none() && self.ask_step(goal, &thought) != Answer::Unsatisfiable {
                    thought.retain(|&other| other != goal);
                }
            }
            if thought.len() == count {
                break;
            }
        }
        for goal in thought {
            self.findings[goal].get_or_insert(Finding::Induction(scans));
        }
    }
}

//! Proofs and counterexamples by satisfiability.
//!
//! First from any state of what is carried: what one scan cannot do from there, no scan does. Then, in turns, runs of so many scans
//! from power-on, and induction over as many (Sheeran, Singh and Stålmarck, "Checking safety properties using induction and a
//! SAT-solver", 2000): what is never wrong in the first k scans, and not after k scans that were right, is never wrong. Only
//! states that differ have to be looked at, which makes the method complete. All goals are assumed at once of the scans before.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::run::Given;
use super::subject::Subject;
use super::unrolled::{Frame, Network};
use crate::sif::{Answer, Literal, Solver, Stop};

/// Something that is never to be so at the end of a scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Goal {
    /// The claim at this position is wrong.
    Claim(usize),
    /// The scan meets the error at this position among those of the gates.
    Error(usize),
}

impl Goal {
    /// The positions of the restrictions that its scans keep.
    pub(super) fn restrictions<'s>(self, subject: &'s Subject<'_>) -> &'s [usize] {
        match self {
            Self::Claim(claim) => &subject.claims[claim].restrictions,
            Self::Error(_) => &subject.everywhere,
        }
    }

    /// The position of its claim.
    pub(super) fn claim(self) -> Option<usize> {
        match self {
            Self::Claim(claim) => Some(claim),
            Self::Error(_) => None,
        }
    }
}

/// What is known of a goal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Finding {
    /// It is not so from any state.
    AnyState,
    /// It is not so, by induction over so many scans.
    Induction(usize),
    /// It is so in the last scan of a shortest run that reads this.
    Run(Vec<Given>),
    /// It is not known.
    Open(String),
}

/// How far to go.
pub(super) struct Bounds {
    /// Scans of a run, and of an induction.
    pub(super) scans: usize,
    /// Conflicts of the solver for one question.
    pub(super) conflicts: u64,
    /// Whether the work is to end.
    pub(super) stop: Stop,
}

/// The goals of a network.
pub(super) fn goals(network: &Network<'_>) -> Vec<Goal> {
    let claims = (0..network.subject.claims.len()).map(Goal::Claim);
    claims.chain((0..network.gates.errors.len()).map(Goal::Error)).collect()
}

/// Decides all goals, as far as the bounds allow.
pub(super) fn search(network: &Network<'_>, bounds: &Bounds) -> Vec<Finding> {
    let goals = goals(network);
    let left = Arc::new(AtomicU64::new(0));
    let stop = {
        let (left, stop) = (left.clone(), bounds.stop.clone());
        // The solver asks once for each conflict.
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

/// A solver and the scans in it.
struct Side {
    solver: Solver,
    frames: Vec<Frame>,
}

impl Side {
    /// One scan, from any state or from power-on.
    fn new(stop: &Stop, from_any: bool, network: &Network<'_>) -> Self {
        let mut solver = Solver::new(stop);
        let start = if from_any { network.any_state(&mut solver) } else { network.power_on(&solver) };
        let frame = network.scan(&mut solver, &start);
        Self { solver, frames: vec![frame] }
    }

    /// One scan more; those before it do not fail.
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
    /// Conflicts left for the question at hand.
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

    /// The positions of the restrictions that a goal's scans keep.
    fn restrictions(&self, goal: usize) -> &[usize] {
        self.goals[goal].restrictions(self.network.subject)
    }

    /// That scans keep a goal's restrictions.
    fn allowed(&self, goal: usize, frames: &[Frame]) -> Vec<Literal> {
        let used = &self.network.subject.restrictions;
        let at: Vec<usize> = self.restrictions(goal).iter().filter_map(|at| used.binary_search(at).ok()).collect();
        frames.iter().flat_map(|frame| at.iter().map(|&at| frame.allowed[at])).collect()
    }

    /// Whether a first scan can keep a goal's restrictions; else why nothing is proved.
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

    /// What makes the last of these scans bad.
    fn bad(&self, goal: usize, frame: &Frame) -> Vec<Literal> {
        match self.goals[goal] {
            Goal::Claim(claim) => vec![frame.wrong[claim], !frame.fails],
            Goal::Error(error) => vec![frame.errors[error]],
        }
    }

    /// Whether the last of the scans from any state can be bad, after scans in which the others were not.
    fn ask_step(&mut self, goal: usize, others: &[usize]) -> Answer {
        let Some((last, before)) = self.steps.frames.split_last() else { return Answer::Stopped };
        let mut assumed = self.bad(goal, last);
        if assumed[0] == self.steps.solver.constant(false) {
            return Answer::Unsatisfiable;
        }
        assumed.extend(self.allowed(goal, &self.steps.frames));
        for &other in others {
            // What is right where fewer restrictions are kept is right where more are.
            let holds_here = self.restrictions(other).iter().all(|at| self.restrictions(goal).contains(at));
            if let (Goal::Claim(claim), true) = (self.goals[other], holds_here) {
                assumed.extend(before.iter().map(|frame| !frame.wrong[claim]));
            }
        }
        self.solve(true, &assumed)
    }

    /// Looks for runs of so many scans from power-on whose last is bad.
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

    /// Proves what no scan makes wrong after so many in which everything that is still thought right was right.
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

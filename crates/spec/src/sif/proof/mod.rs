//! Proofs that a program computes its specification: at the end of every scan, each output equals its formula over the
//! inputs of that scan, provided that scans satisfy the restrictions.
//!
//! Gates of a scan and the specification go to a SAT solver (`search.rs`). Counterexamples are replayed by the
//! interpreter before they are shown; proofs are confirmed independently where possible. Programs without gates are
//! explored by the interpreter, scan by scan.

mod diagrams;
mod every;
mod run;
mod sample;
mod search;
mod shown;
mod subject;
mod unrolled;

use std::collections::BTreeMap;

use petril_check::verdict::Verdict;
use petril_lang::circuit::ScanGates;

use super::Stop;
use every::{Seen, every};
pub use run::{Failure, Given, Scan};
use search::{Bounds, Finding, Goal, goals, search};
use shown::Shown;
pub use subject::{Claim, Form, Subject};
use unrolled::Network;

/// Limits of a proof.
#[derive(Clone)]
pub struct Options {
    /// Upper bound on the scans of a run from power-on, and of an induction.
    pub scans: usize,
    /// Upper bound on conflicts of the solver per question.
    pub conflicts: u64,
    /// Upper bound on scans computed by the interpreter where nothing else decides; a sixteenth of it to confirm
    /// proofs.
    pub tries: u64,
    /// Whether to stop.
    pub stop: Stop,
}

impl Default for Options {
    /// Sixteen scans, a million conflicts, 2²⁰ tries, never stopped.
    fn default() -> Self {
        Self { scans: 16, conflicts: 1_000_000, tries: 1 << 20, stop: std::sync::Arc::new(|| false) }
    }
}

/// Result for a claim.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The claim holds in every scan of every run.
    Proved {
        /// Method of the proof.
        by: By,
        /// Independent confirmation, if any.
        confirmed: Option<Confirmed>,
    },
    /// The claim is violated at the end of the last of these scans, as the interpreter shows.
    Refuted(Vec<Scan>),
    /// Undecided, with the reason.
    Unknown(String),
}

impl Outcome {
    /// Verdict without evidence.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match self {
            Self::Proved { .. } => Verdict::Holds,
            Self::Refuted(_) => Verdict::Violated,
            Self::Unknown(_) => Verdict::Unknown,
        }
    }
}

/// Method of a proof.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum By {
    /// Single scan from any state, reachable or not.
    AnyState,
    /// Induction over this number of scans.
    Induction(usize),
    /// Exhaustive exploration by the interpreter.
    EveryScan,
}

/// Independent confirmation of a proof.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Confirmed {
    /// Exhaustive exploration by the interpreter.
    EveryScan {
        /// Number of states, power-on included.
        states: u64,
        /// Number of scans.
        scans: u64,
    },
    /// Equality of decision diagrams.
    Diagrams,
}

/// Answer for one output.
#[derive(Clone, Debug)]
pub struct Answer {
    /// Claim.
    pub claim: Claim,
    /// Result.
    pub outcome: Outcome,
}

/// Results for all claims.
#[derive(Clone, Debug)]
pub struct Proof {
    /// Answers, one for each output, in their order.
    pub answers: Vec<Answer>,
    /// Failures of scans, each with a shortest run; nothing is known of the program after them.
    pub failures: Vec<(Failure, Vec<Scan>)>,
    /// Failures not known to be unreachable, with the reason; `None` stands for any failure.
    pub unknown_failures: Vec<(Option<Failure>, String)>,
    /// Assumptions of all proofs.
    pub assumptions: Vec<String>,
    /// Further remarks.
    pub remarks: Vec<String>,
    /// Number of random scans on which gates and interpreter agreed.
    pub compared: usize,
}

impl Proof {
    /// Overall verdict.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let answers = self.answers.iter().map(|answer| answer.outcome.verdict());
        let failures = self.failures.iter().map(|_| Verdict::Violated);
        let unknown = self.unknown_failures.iter().map(|_| Verdict::Unknown);
        answers.chain(failures).chain(unknown).max().unwrap_or(Verdict::Holds)
    }
}

/// Proves or refutes the claims.
#[must_use]
pub fn prove(subject: &Subject<'_>, options: &Options) -> Proof {
    let mut proof = Proof {
        answers: Vec::new(),
        failures: Vec::new(),
        unknown_failures: Vec::new(),
        assumptions: shown::assumptions(subject),
        remarks: shown::remarks(subject),
        compared: 0,
    };
    match ScanGates::of(subject.program, subject.tolerated) {
        Ok(gates) => by_gates(subject, &gates, options, &mut proof),
        Err(no_gates) => by_interpreter(subject, &shown::no_gates(subject, no_gates), options, &mut proof),
    }
    if !proof.failures.is_empty() || !proof.unknown_failures.is_empty() {
        proof.assumptions.push("of scans that fail, and of what comes after them, nothing is claimed".to_owned());
    }
    proof
}

/// Results of exhaustive exploration, by list of restrictions.
struct Interpreted(BTreeMap<Vec<usize>, Option<Seen>>);

impl Interpreted {
    fn new(subject: &Subject<'_>, goals: &[Goal], tries: u64, options: &Options) -> Self {
        let mut groups: BTreeMap<Vec<usize>, Vec<usize>> = BTreeMap::new();
        for goal in goals {
            let claims = groups.entry(goal.restrictions(subject).to_vec()).or_default();
            claims.extend(goal.claim());
        }
        let seen = |(restrictions, claims): (Vec<usize>, Vec<usize>)| {
            let seen = every(subject, &restrictions, &claims, tries, &options.stop);
            (restrictions, seen)
        };
        Self(groups.into_iter().map(seen).collect())
    }

    /// Result for these restrictions; `None` if they were not tried.
    fn of(&self, restrictions: &[usize]) -> Option<&Seen> {
        self.0.get(restrictions).and_then(Option::as_ref)
    }
}

fn by_gates(subject: &Subject<'_>, gates: &ScanGates, options: &Options, proof: &mut Proof) {
    let compared = sample::compare(subject, gates);
    let network = Network::new(subject, gates);
    let goals = goals(&network);
    let bounds = Bounds { scans: options.scans, conflicts: options.conflicts, stop: options.stop.clone() };
    let findings = match &compared {
        Ok(_) => search(&network, &bounds),
        Err(what) => vec![Finding::Open(disagreement(what)); goals.len()],
    };
    proof.compared = compared.as_ref().copied().unwrap_or(0);
    let confirming = Interpreted::new(subject, &goals, options.tries / 16, options);
    let open =
        goals.iter().zip(&findings).filter(|(_, finding)| compared.is_ok() && matches!(finding, Finding::Open(_)));
    let open: Vec<Goal> = open.map(|(goal, _)| *goal).collect();
    let deciding = Interpreted::new(subject, &open, options.tries, options);
    for (goal, finding) in goals.into_iter().zip(findings) {
        let restrictions = goal.restrictions(subject);
        let seen = if open.contains(&goal) { deciding.of(restrictions) } else { confirming.of(restrictions) };
        match goal {
            Goal::Claim(position) => {
                let claim = subject.claims[position].clone();
                let outcome = claimed(subject, gates, position, finding, seen);
                proof.answers.push(Answer { claim, outcome });
            }
            Goal::Error(position) => {
                let (_, line, hazard) = gates.errors[position];
                let failure = Failure::Hazard(line, hazard);
                match failing(subject, failure, finding, seen) {
                    Outcome::Proved { .. } => {}
                    Outcome::Refuted(scans) => proof.failures.push((failure, scans)),
                    Outcome::Unknown(reason) => proof.unknown_failures.push((Some(failure), reason)),
                }
            }
        }
    }
}

/// Result for a claim: the solver's finding, checked by the interpreter.
fn claimed(
    subject: &Subject<'_>,
    gates: &ScanGates,
    position: usize,
    finding: Finding,
    seen: Option<&Seen>,
) -> Outcome {
    let complete = seen.filter(|seen| seen.stopped.is_none());
    let by_every_scan = complete.map(|seen| Confirmed::EveryScan { states: seen.states, scans: seen.scans });
    let shown = Shown::Wrong(position);
    match finding {
        Finding::Run(given) => shown.replayed(subject, &given).map_or_else(Outcome::Unknown, Outcome::Refuted),
        _ if seen.is_some_and(|seen| seen.wrong.contains_key(&position)) => match finding {
            Finding::Open(_) => {
                let given = seen.and_then(|seen| seen.wrong.get(&position)).cloned().unwrap_or_default();
                shown.replayed(subject, &given).map_or_else(Outcome::Unknown, Outcome::Refuted)
            }
            _ => Outcome::Unknown(disagreement("the interpreter finds a difference where the solver finds none")),
        },
        Finding::AnyState => {
            let diagrams = || diagrams::holds(subject, gates, &subject.claims[position]);
            match by_every_scan.map_or_else(diagrams, |_| None) {
                Some(false) => {
                    Outcome::Unknown(disagreement("decision diagrams differ where the solver finds nothing"))
                }
                Some(true) => Outcome::Proved { by: By::AnyState, confirmed: Some(Confirmed::Diagrams) },
                None => Outcome::Proved { by: By::AnyState, confirmed: by_every_scan },
            }
        }
        Finding::Induction(scans) => Outcome::Proved { by: By::Induction(scans), confirmed: by_every_scan },
        Finding::Open(reason) => every_scan(complete, reason),
    }
}

/// Result for an error, as by [`claimed`].
fn failing(subject: &Subject<'_>, failure: Failure, finding: Finding, seen: Option<&Seen>) -> Outcome {
    let complete = seen.filter(|seen| seen.stopped.is_none());
    let confirmed = complete.map(|seen| Confirmed::EveryScan { states: seen.states, scans: seen.scans });
    let run = seen.and_then(|seen| seen.failures.get(&failure));
    match (finding, run) {
        (Finding::Run(given), _) => {
            Shown::Failure(failure).replayed(subject, &given).map_or_else(Outcome::Unknown, Outcome::Refuted)
        }
        (Finding::Open(_), Some(given)) => {
            Shown::Failure(failure).replayed(subject, given).map_or_else(Outcome::Unknown, Outcome::Refuted)
        }
        (_, Some(_)) => Outcome::Unknown(disagreement("the interpreter meets an error where the solver finds none")),
        (Finding::AnyState, None) => Outcome::Proved { by: By::AnyState, confirmed },
        (Finding::Induction(scans), None) => Outcome::Proved { by: By::Induction(scans), confirmed },
        (Finding::Open(reason), None) => every_scan(complete, reason),
    }
}

/// Decides by exhaustive exploration what the solver leaves open.
fn every_scan(complete: Option<&Seen>, reason: String) -> Outcome {
    match complete {
        Some(seen) if seen.ended > 0 => Outcome::Proved { by: By::EveryScan, confirmed: None },
        _ => Outcome::Unknown(reason),
    }
}

/// Decides all claims about a program without gates, which `reason` explains.
fn by_interpreter(subject: &Subject<'_>, reason: &str, options: &Options, proof: &mut Proof) {
    let goals: Vec<Goal> = (0..subject.claims.len()).map(Goal::Claim).collect();
    let interpreted = Interpreted::new(subject, &goals, options.tries, options);
    let everywhere = every(subject, &subject.everywhere, &[], options.tries, &options.stop);
    let why = |seen: Option<&Seen>| match seen {
        None => format!("{reason}, and its inputs are too many to try all"),
        Some(seen) => match &seen.stopped {
            Some(stopped) => format!("{reason}, and not all scans were tried: {stopped}"),
            None if seen.ended == 0 => "no scan that its restrictions allow comes to an end".to_owned(),
            None => reason.to_owned(),
        },
    };
    for (position, claim) in subject.claims.iter().enumerate() {
        let seen = interpreted.of(&claim.restrictions);
        let outcome = match seen.and_then(|seen| seen.wrong.get(&position)) {
            Some(given) => {
                Shown::Wrong(position).replayed(subject, given).map_or_else(Outcome::Unknown, Outcome::Refuted)
            }
            None => every_scan(seen.filter(|seen| seen.stopped.is_none()), why(seen)),
        };
        proof.answers.push(Answer { claim: claim.clone(), outcome });
    }
    let seen = everywhere.as_ref();
    for (&failure, given) in seen.iter().flat_map(|seen| &seen.failures) {
        match Shown::Failure(failure).replayed(subject, given) {
            Ok(scans) => proof.failures.push((failure, scans)),
            Err(reason) => proof.unknown_failures.push((Some(failure), reason)),
        }
    }
    if seen.is_none_or(|seen| seen.stopped.is_some()) {
        proof.unknown_failures.push((None, why(seen)));
    }
}

fn disagreement(what: &str) -> String {
    format!("{what}, which is an error in Petril; please report it")
}

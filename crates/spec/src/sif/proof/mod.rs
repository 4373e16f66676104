//! Whether a program computes what is specified: each output, at the end of every scan, is its formula over the inputs of that
//! scan, as long as scans keep the restrictions.
//!
//! A scan as gates and the specification go to a solver (`search.rs`). What it finds wrong is replayed by the
//! interpreter before it is shown; what it proves is confirmed in another way where that is possible. Programs without gates
//! are explored by the interpreter, scan by scan.

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

/// How a proof is looked for.
#[derive(Clone)]
pub struct Options {
    /// Scans of a run from power-on, and of an induction, at most.
    pub scans: usize,
    /// Conflicts of the solver for one question, at most.
    pub conflicts: u64,
    /// Scans that the interpreter computes where nothing else decides, at most; a sixteenth of them to confirm proofs.
    pub tries: u64,
    /// Whether the work is to end.
    pub stop: Stop,
}

impl Default for Options {
    /// Sixteen scans, a million conflicts, a million tries, no end.
    fn default() -> Self {
        Self { scans: 16, conflicts: 1_000_000, tries: 1 << 20, stop: std::sync::Arc::new(|| false) }
    }
}

/// What is known of a claim.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It is so in every scan of every run.
    Proved {
        /// How.
        by: By,
        /// How that was confirmed by something that shares nothing with the proof.
        confirmed: Option<Confirmed>,
    },
    /// It is not so at the end of the last of these scans, as the interpreter shows.
    Refuted(Vec<Scan>),
    /// Nothing is known, for this reason.
    Unknown(String),
}

impl Outcome {
    /// The verdict alone.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match self {
            Self::Proved { .. } => Verdict::Holds,
            Self::Refuted(_) => Verdict::Violated,
            Self::Unknown(_) => Verdict::Unknown,
        }
    }
}

/// How a claim was proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum By {
    /// For one scan, whatever it begins with, reachable or not.
    AnyState,
    /// By induction over so many scans.
    Induction(usize),
    /// The interpreter computed every scan from every state.
    EveryScan,
}

/// How a proof was confirmed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Confirmed {
    /// The interpreter computed every scan from every state.
    EveryScan {
        /// States, power-on included.
        states: u64,
        /// Scans.
        scans: u64,
    },
    /// Decision diagrams of both are the same.
    Diagrams,
}

/// What is known of one output.
#[derive(Clone, Debug)]
pub struct Answer {
    /// What is claimed.
    pub claim: Claim,
    /// What is known.
    pub outcome: Outcome,
}

/// What is known of all that was claimed.
#[derive(Clone, Debug)]
pub struct Proof {
    /// One for each output, in their order.
    pub answers: Vec<Answer>,
    /// The ways in which scans fail, each with a shortest run; what the program does after them is not known.
    pub failures: Vec<(Failure, Vec<Scan>)>,
    /// The ways of which it is not known whether they occur, with the reason.
    pub unknown_failures: Vec<(Option<Failure>, String)>,
    /// What all proofs assume.
    pub assumptions: Vec<String>,
    /// What else is worth knowing.
    pub remarks: Vec<String>,
    /// Scans by chance that gates and interpreter computed alike.
    pub compared: usize,
}

impl Proof {
    /// The verdict on everything.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let answers = self.answers.iter().map(|answer| answer.outcome.verdict());
        let failures = self.failures.iter().map(|_| Verdict::Violated);
        let unknown = self.unknown_failures.iter().map(|_| Verdict::Unknown);
        answers.chain(failures).chain(unknown).max().unwrap_or(Verdict::Holds)
    }
}

/// Proves or refutes what is claimed.
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

/// What the interpreter finds by trying everything, for each list of restrictions that some goals have.
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

    /// What scans that keep these restrictions show. Nothing if they were not tried.
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

/// What is known of a claim, after what the solver found was looked at by the interpreter.
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

/// The same of an error.
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

/// What the solver leaves open may be known from trying everything.
fn every_scan(complete: Option<&Seen>, reason: String) -> Outcome {
    match complete {
        Some(seen) if seen.ended > 0 => Outcome::Proved { by: By::EveryScan, confirmed: None },
        _ => Outcome::Unknown(reason),
    }
}

/// All that is known of a program without gates, for this reason.
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

//! Sources of inputs: a table, random numbers, or a report.

use std::time::{SystemTime, UNIX_EPOCH};

use petril::exchange::recorded::{Recorded, recorded};
use petril::explore::ScanState;
use petril::flat::FlatProgram;
use petril::logic::{bind_domain, parse_domain};
use petril::printable;
use petril::simulate::{Chance, Plan};
use petril::source::Source;
use petril::translate::{Domains, Plant, System};
use serde_json::Value;

use crate::cli::args::Simulate;
use crate::cli::console::Console;
use crate::cli::{Failure, input, input_table};

/// Maximum size of input tables and reports, in bytes.
const MAX_INPUTS: u64 = 1 << 30;

/// Input source of a simulation.
pub enum Steering<'s> {
    /// Rows of a table, then no changes. Empty without a table.
    Rows(Vec<Plan>),
    Chance(Box<Chance<'s>>),
    Recorded(Recorded),
}

impl<'s> Steering<'s> {
    /// Input source given by the arguments.
    pub fn of(arguments: &Simulate, system: &'s System, console: &Console) -> Result<Self, Failure> {
        if let Some(path) = &arguments.inputs {
            let source = input::source(path, MAX_INPUTS, console)?;
            let rows = input_table::read(&source, &system.program).map_err(|diagnostics| {
                console.diagnostics(&diagnostics, &source);
                Failure::Reported
            })?;
            return Ok(Self::Rows(rows.into_iter().map(|inputs| Plan { moves: Vec::new(), inputs }).collect()));
        }
        if let Some(path) = &arguments.replay {
            let source = input::source(path, MAX_INPUTS, console)?;
            let say = |problem: String| Failure::Message(format!("{}: {problem}", printable::line(source.name())));
            let report: Value = serde_json::from_str(source.text())
                .map_err(|error| say(format!("this is no JSON document: {error}")))?;
            return Ok(Self::Recorded(recorded(&report, arguments.requirement.as_deref(), system).map_err(say)?));
        }
        // In interactive mode inputs are set by key, random ones too.
        if let Some(seed) = arguments.random.filter(|_| !arguments.interactive) {
            let seed = seed.unwrap_or_else(|| {
                let seed = any_seed();
                console.message(&format!("the seed is {seed}: `--random {seed}` makes this run again\n"));
                seed
            });
            return Ok(Self::Chance(Box::new(Chance::new(system, seed))));
        }
        Ok(Self::Rows(Vec::new()))
    }

    /// Number of scans given by the source, if bounded.
    pub fn len(&self) -> Option<usize> {
        match self {
            Self::Rows(rows) => Some(rows.len()).filter(|&count| count > 0),
            Self::Chance(_) => None,
            Self::Recorded(recorded) => Some(recorded.plans.len()),
        }
    }

    /// Plan before the scan at a position, from a state.
    pub fn plan(&mut self, position: usize, from: &ScanState) -> Plan {
        match self {
            Self::Rows(rows) => rows.get(position).cloned().unwrap_or_default(),
            Self::Chance(chance) => chance.plan(from),
            Self::Recorded(recorded) => recorded.plan(position),
        }
    }

    /// Recorded run of a report, if that is the source.
    pub fn recorded(&self) -> Option<&Recorded> {
        match self {
            Self::Recorded(recorded) => Some(recorded),
            _ => None,
        }
    }

    /// Plans known before the run.
    pub fn plans(&self) -> Vec<Plan> {
        match self {
            Self::Rows(rows) => rows.clone(),
            Self::Chance(_) => Vec::new(),
            Self::Recorded(recorded) => recorded.plans.clone(),
        }
    }
}

/// New seed of at most six digits.
pub fn any_seed() -> u64 {
    let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    u64::from(now.subsec_nanos()) % 1_000_000
}

/// Domains given on the command line.
pub fn domains(texts: &[String], program: &FlatProgram, plant: &Plant, console: &Console) -> Result<Domains, Failure> {
    let mut domains = Domains::new();
    let mut failed = false;
    for (position, text) in texts.iter().enumerate() {
        let source = Source::new(format!("domain {}", position + 1), text.as_str());
        let bound = parse_domain(&source).and_then(|domain| bind_domain(&domain, program, plant, &mut domains));
        if let Err(error) = bound {
            console.diagnostics(&[error], &source);
            failed = true;
        }
    }
    if failed { Err(Failure::Reported) } else { Ok(domains) }
}

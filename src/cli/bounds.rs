//! Limits on the work of a verb, and how the verb is ended when one is reached.

use std::time::Duration;

use super::args::{Limits, NetVerb, Verb};
use super::memory;

/// Limits on all work of a verb.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub struct Bounds {
    /// Stop after this many seconds.
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub timeout: Option<Duration>,
    /// Stop when this much memory is in use, in MiB [default: half of the machine's memory, or of its control group's].
    #[arg(long, value_name = "MIB")]
    pub max_memory: Option<u64>,
}

impl Bounds {
    /// Memory limit in MiB.
    pub fn memory(&self) -> u64 {
        self.max_memory.unwrap_or_else(memory::default_limit)
    }
}

impl Limits {
    /// Limits on the work as a whole.
    pub fn bounds(&self) -> Bounds {
        let timeout = self.timeout.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
        Bounds { timeout, max_memory: self.max_memory }
    }
}

/// Parses a number of seconds.
fn seconds(text: &str) -> Result<Duration, String> {
    let number = text.parse().map_err(|_| format!("`{text}` is not a number of seconds"))?;
    Duration::try_from_secs_f64(number).map_err(|error| error.to_string())
}

impl Verb {
    /// Limits on the work, unless it is an interactive session.
    pub fn bounds(&self) -> Option<Bounds> {
        Some(match self {
            // Each program has its own time.
            Self::Check(check) if check.program.is_none() => Bounds { timeout: None, ..check.limits.bounds() },
            Self::Check(check) => check.limits.bounds(),
            Self::Translate(translate) => translate.bounds,
            Self::Flat(flat) => flat.bounds,
            Self::Simulate(simulate) if simulate.interactive => return None,
            Self::Simulate(simulate) => simulate.bounds,
            Self::Draw(draw) => draw.bounds,
            Self::Net(NetVerb::Info(info)) => info.on.limits.bounds(),
            Self::Net(NetVerb::Check(check)) => check.on.limits.bounds(),
            Self::Net(NetVerb::Explore(on)) => on.limits.bounds(),
            Self::Net(NetVerb::Reduce(reduce)) => reduce.bounds,
            Self::Net(NetVerb::Convert(convert)) => convert.bounds,
            Self::Sif(verb) => verb.bounds(),
            Self::Explain(_) | Self::Init(_) | Self::Completions(_) | Self::Man(_) => return None,
        })
    }

    /// Whether the output is one JSON document.
    pub fn wants_json(&self) -> bool {
        match self {
            Self::Check(arguments) => arguments.json,
            Self::Net(NetVerb::Info(arguments)) => arguments.on.json,
            Self::Net(NetVerb::Check(arguments)) => arguments.on.json,
            Self::Net(NetVerb::Explore(arguments)) => arguments.json,
            Self::Net(NetVerb::Reduce(arguments)) => arguments.json,
            Self::Sif(verb) => verb.wants_json(),
            _ => false,
        }
    }

    /// Whether the verb has a verdict, or another answer that can be incomplete.
    pub fn has_verdict(&self) -> bool {
        match self {
            Self::Check(_) | Self::Net(NetVerb::Info(_) | NetVerb::Check(_) | NetVerb::Explore(_)) => true,
            Self::Sif(verb) => verb.has_verdict(),
            _ => false,
        }
    }
}

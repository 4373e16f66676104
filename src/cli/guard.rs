//! Limits on the whole process, in every phase of its work. Work that polls [`asked`] reports its partial results;
//! other work is ended somewhat later, with a message.

use std::fmt;
use std::io::{self, Write};
use std::process::exit;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::json;

use super::bounds::Bounds;
use super::{memory, output};

/// Reason to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reason {
    /// The user interrupted the program.
    Interrupted,
    /// The time limit was reached.
    Time(Duration),
    /// The memory limit was reached; `limit` and memory in use, in MiB.
    Memory { limit: u64, used: u64 },
}

impl Reason {
    /// Memory above this limit, in MiB.
    pub fn memory(limit: u64) -> Self {
        Self::Memory { limit, used: used() }
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Interrupted => write!(f, "interrupted"),
            Self::Time(limit) => write!(f, "the time limit of {} s was reached", limit.as_secs_f64()),
            Self::Memory { limit, used } => write!(f, "the limit of {limit} MiB was reached: {used} MiB are in use"),
        }
    }
}

/// Output of a verb that the guard ends.
#[derive(Clone, Copy)]
pub struct Ending {
    /// Whether the verb has a verdict, which is then "unknown".
    pub has_verdict: bool,
    pub wants_json: bool,
}

struct Guard {
    started: Instant,
    timeout: Option<Duration>,
    /// Memory limit in MiB.
    memory: u64,
}

static GUARD: OnceLock<Guard> = OnceLock::new();
static INTERRUPTED: OnceLock<Instant> = OnceLock::new();
/// Memory in use, in MiB.
static USED: AtomicU64 = AtomicU64::new(0);
/// Whether the work polls for a reason to stop.
static IS_ASKING: AtomicBool = AtomicBool::new(false);
/// Number of threads blocked on a reader of their output.
static PAUSED: AtomicUsize = AtomicUsize::new(0);
static PHASE: Mutex<&str> = Mutex::new("starting");

/// Interval between two checks of clock and memory.
const TICK: Duration = Duration::from_millis(10);

/// Signals within this interval count as one: a signal to the program and one to its group.
const TWICE: Duration = Duration::from_millis(500);

/// Memory of a process apart from its work, in MiB.
const BASE: u64 = 64;

/// Starts to enforce the limits. Ctrl-C asks the work to stop; a second Ctrl-C ends the program.
pub fn start(bounds: &Bounds, ending: Ending) {
    let guard = Guard { started: Instant::now(), timeout: bounds.timeout, memory: bounds.memory() };
    let guard = GUARD.get_or_init(|| guard);
    // Without a handler, signals end the program as usual.
    let _ = ctrlc::set_handler(|| {
        if INTERRUPTED.get_or_init(Instant::now).elapsed() > TWICE {
            output::discard_unfinished();
            exit(130);
        }
    });
    let _ = thread::Builder::new().name("guard".to_owned()).spawn(move || guard.keep(ending));
}

/// Declares that the work polls for a reason to stop; it is then given time to report partial results.
pub fn listen() {
    IS_ASKING.store(true, Ordering::Relaxed);
}

/// Reason why the work is to stop, if any.
pub fn asked() -> Option<Reason> {
    if is_interrupted() {
        return Some(Reason::Interrupted);
    }
    let guard = GUARD.get()?;
    if let Some(limit) = guard.timeout.filter(|&limit| guard.started.elapsed() > limit) {
        return Some(Reason::Time(limit));
    }
    (used() > guard.memory).then(|| Reason::memory(guard.memory))
}

/// As [`asked`], with slightly extended limits for work that completes partial results.
pub fn asked_to_finish() -> Option<Reason> {
    let reason = asked()?;
    let guard = GUARD.get()?;
    let is_over = |asked: Duration| guard.started.elapsed() > to_finish(asked);
    let is_due = match reason {
        Reason::Interrupted => INTERRUPTED.get().is_some_and(|at| is_over(at.saturating_duration_since(guard.started))),
        Reason::Time(limit) => is_over(limit),
        Reason::Memory { limit, used } => used > limit.saturating_mul(12) / 10 + BASE / 2,
    };
    is_due.then_some(reason)
}

/// Time until which work that was asked to stop at `asked` may complete what it has begun.
pub fn to_finish(asked: Duration) -> Duration {
    asked.saturating_add(asked / 5).saturating_add(Duration::from_millis(300))
}

/// Whether the work is to stop.
pub fn is_asked() -> bool {
    asked().is_some()
}

/// Whether the user interrupted the program.
pub fn is_interrupted() -> bool {
    INTERRUPTED.get().is_some()
}

/// Memory in use, in MiB.
pub fn used() -> u64 {
    USED.load(Ordering::Relaxed)
}

/// Sets the current phase of the work.
pub fn phase(name: &'static str) {
    *PHASE.lock().unwrap_or_else(PoisonError::into_inner) = name;
}

/// Current phase of the work.
pub fn doing() -> &'static str {
    *PHASE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Runs work that may block on a reader of output for any time.
pub fn pause<T>(work: impl FnOnce() -> T) -> T {
    PAUSED.fetch_add(1, Ordering::SeqCst);
    let done = work();
    PAUSED.fetch_sub(1, Ordering::SeqCst);
    done
}

/// Time at which work that was asked to stop at `asked` is ended: 1.4 times as long, plus 0.8 s.
fn grace(asked: Duration) -> Duration {
    asked.saturating_add(asked / 5 * 2).saturating_add(Duration::from_millis(800))
}

impl Guard {
    fn keep(&self, ending: Ending) {
        let mut since = None;
        let is_limited = memory::address_space().is_some();
        loop {
            thread::sleep(TICK);
            // On systems without this figure, memory is limited only by the work itself.
            let used = memory::resident().unwrap_or_default() >> 20;
            USED.store(used, Ordering::Relaxed);
            if let Some((taken, space)) = memory::address_space().filter(|_| is_limited)
                && taken > space - space / 8
            {
                // When it is used up, the next allocation aborts the process.
                self.end(Reason::Memory { limit: space >> 20, used: taken >> 20 }, ending, false);
            }
            let Some(reason) = asked() else {
                since = None;
                continue;
            };
            let now = self.started.elapsed();
            let end = if IS_ASKING.load(Ordering::Relaxed) { grace(*since.get_or_insert(now)) } else { now };
            let is_overdue = now >= end || used > self.memory.saturating_mul(14) / 10 + BASE;
            let is_paused = PAUSED.load(Ordering::SeqCst) > 0;
            if is_overdue && (!is_paused || reason == Reason::Interrupted) {
                self.end(reason, ending, is_paused);
            }
        }
    }

    /// Ends the process. Nothing more is printed if a reader blocks the output.
    fn end(&self, reason: Reason, ending: Ending, is_paused: bool) {
        output::discard_unfinished();
        let is_interrupted = reason == Reason::Interrupted;
        if !is_paused {
            let phase = doing();
            let seconds = self.started.elapsed().as_secs_f64();
            let message = format!("{reason}, while {phase}, after {seconds:.1} s with {} MiB", used());
            let verdict = if ending.has_verdict { "unknown" } else { "error" };
            let _ = writeln!(io::stderr(), "{verdict}: {message}");
            if ending.wants_json {
                let document = json!({ "verdict": verdict, "error": message, "diagnostics": [] });
                let _ = writeln!(io::stdout(), "{document:#}");
            }
        }
        exit(if ending.has_verdict && !is_paused {
            3
        } else if is_interrupted {
            130
        } else {
            2
        });
    }
}

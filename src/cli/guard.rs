//! Limits on the whole process, in every phase of its work. Work that polls [`asked`] reports its partial results;
//! other work is ended somewhat later, with a message.

use std::fmt;
use std::io::{self, Write};
use std::process::exit;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};
use std::thread;
use std::time::{Duration, Instant};

use petril::printable;
use serde_json::json;

use super::bounds::Bounds;
use super::origin::Origin;
use super::phase::{self, Phase};
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

/// How a verb is ended that does not end itself.
pub struct Ending {
    /// Whether the verb has a verdict, which is then "unknown".
    pub has_verdict: bool,
    pub wants_json: bool,
    pub origin: Arc<Origin>,
}

struct Guard {
    clock: Clock,
    timeout: Option<Duration>,
    /// Memory limit in MiB.
    memory: u64,
}

/// The time since the work began, which may begin anew.
struct Clock {
    first: Instant,
    /// When the work began, in milliseconds after the first time.
    began: AtomicU64,
}

/// The beginning of no work: the clock stands.
const NEVER: u64 = u64::MAX;

impl Clock {
    fn new() -> Self {
        Self { first: Instant::now(), began: AtomicU64::new(0) }
    }

    /// Time since the work began, at some time.
    fn at(&self, time: Instant) -> Duration {
        let began = Duration::from_millis(self.began.load(Ordering::Relaxed));
        time.saturating_duration_since(self.first).saturating_sub(began)
    }

    fn elapsed(&self) -> Duration {
        self.at(Instant::now())
    }
}

static GUARD: OnceLock<Guard> = OnceLock::new();
static INTERRUPTED: OnceLock<Instant> = OnceLock::new();
/// Memory in use, in MiB.
static USED: AtomicU64 = AtomicU64::new(0);
/// Number of threads blocked on a reader of their output.
static PAUSED: AtomicUsize = AtomicUsize::new(0);

/// Interval between two checks of clock and memory.
const TICK: Duration = Duration::from_millis(10);

/// Signals within this interval count as one: a signal to the program and one to its group.
const TWICE: Duration = Duration::from_millis(500);

/// Memory of a process apart from its work, in MiB.
const BASE: u64 = 64;

/// Makes running out of memory an end like others: the standard library says how many bytes could not be had, and aborts.
#[cfg(unix)]
fn exit_instead_of_abort() {
    let always = Arc::new(std::sync::atomic::AtomicBool::new(true));
    // If it cannot be done, the process aborts as usual.
    let _ = signal_hook::flag::register_conditional_shutdown(signal_hook::consts::SIGABRT, 2, always);
}

#[cfg(not(unix))]
fn exit_instead_of_abort() {}

/// Starts to enforce the limits. Ctrl-C asks the work to stop; a second Ctrl-C ends the program.
pub fn start(bounds: &Bounds, ending: Ending) {
    exit_instead_of_abort();
    let guard = Guard { clock: Clock::new(), timeout: bounds.timeout, memory: bounds.memory() };
    let guard = GUARD.get_or_init(|| guard);
    // Without a handler, signals end the program as usual.
    let _ = ctrlc::set_handler(|| {
        if INTERRUPTED.get_or_init(Instant::now).elapsed() > TWICE {
            output::discard_unfinished();
            exit(130);
        }
    });
    let _ = thread::Builder::new().name("guard".to_owned()).spawn(move || guard.keep(&ending));
}

/// Starts the clock anew.
pub fn restart() {
    if let Some(guard) = GUARD.get() {
        let now = u64::try_from(guard.clock.first.elapsed().as_millis()).unwrap_or(NEVER);
        guard.clock.began.store(now, Ordering::Relaxed);
    }
}

/// Stops the clock, until it is started anew.
pub fn rest() {
    if let Some(guard) = GUARD.get() {
        guard.clock.began.store(NEVER, Ordering::Relaxed);
    }
}

/// Reason why the work is to stop, if any.
pub fn asked() -> Option<Reason> {
    if is_interrupted() {
        return Some(Reason::Interrupted);
    }
    let guard = GUARD.get()?;
    if let Some(limit) = guard.timeout.filter(|&limit| guard.clock.elapsed() > limit) {
        return Some(Reason::Time(limit));
    }
    (used() > guard.memory).then(|| Reason::memory(guard.memory))
}

/// As [`asked`], with slightly extended limits for work that completes partial results.
pub fn asked_to_finish() -> Option<Reason> {
    let reason = asked()?;
    let guard = GUARD.get()?;
    let is_over = |asked: Duration| guard.clock.elapsed() > to_finish(asked);
    let is_due = match reason {
        Reason::Interrupted => INTERRUPTED.get().is_some_and(|&at| is_over(guard.clock.at(at))),
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

/// Whether nobody waits any longer for one of several programs that was asked to stop with all others.
pub fn is_to_leave(is_asking: bool) -> bool {
    let (Some(guard), Some(&at)) = (GUARD.get(), INTERRUPTED.get()) else { return false };
    !is_asking || guard.clock.elapsed() > to_wait(guard.clock.at(at))
}

/// Memory in use, in MiB.
pub fn used() -> u64 {
    USED.load(Ordering::Relaxed)
}

/// Runs work that may block on a reader of output for any time.
pub fn pause<T>(work: impl FnOnce() -> T) -> T {
    PAUSED.fetch_add(1, Ordering::SeqCst);
    let done = work();
    PAUSED.fetch_sub(1, Ordering::SeqCst);
    done
}

/// The time from which nobody waits for one of several programs that was asked to stop at another one: after the time to finish, and
/// before the process is ended.
pub fn to_wait(asked: Duration) -> Duration {
    asked.saturating_add(asked / 10 * 3).saturating_add(Duration::from_millis(550))
}

/// Time at which work that was asked to stop at `asked` is ended: 1.4 times as long, plus 0.8 s.
fn grace(asked: Duration) -> Duration {
    asked.saturating_add(asked / 5 * 2).saturating_add(Duration::from_millis(800))
}

impl Guard {
    fn keep(&self, ending: &Ending) {
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
            let Phase { is_asking, .. } = phase::of_process();
            let now = self.clock.elapsed();
            let end = if is_asking { grace(*since.get_or_insert(now)) } else { now };
            let most = if is_asking { self.memory.saturating_mul(14) / 10 + BASE } else { self.memory };
            let is_paused = PAUSED.load(Ordering::SeqCst) > 0;
            if (now >= end || used > most) && (!is_paused || reason == Reason::Interrupted) {
                self.end(reason, ending, is_paused);
            }
        }
    }

    /// Ends the process. Where a reader keeps others waiting, nothing more is printed.
    fn end(&self, reason: Reason, ending: &Ending, is_paused: bool) {
        output::discard_unfinished();
        let is_interrupted = reason == Reason::Interrupted;
        if !is_paused {
            let phase = phase::of_process().name;
            let seconds = self.clock.elapsed().as_secs_f64();
            let message = format!("{reason}, while {phase}, after {seconds:.1} s with {} MiB", used());
            let verdict = if ending.has_verdict { "unknown" } else { "error" };
            let _ = writeln!(io::stderr(), "{verdict}: {message}");
            if ending.wants_json {
                let document = json!({
                    "verdict": verdict,
                    "error": message,
                    "provenance": ending.origin.provenance().json(),
                    "diagnostics": [],
                });
                let _ = writeln!(io::stdout(), "{}", printable::json(&format!("{document:#}")));
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

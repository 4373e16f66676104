//! Observation of a search: figures on the terminal, and the limits.

use std::cell::Cell;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use indicatif::{HumanBytes, HumanCount, ProgressBar, ProgressDrawTarget, ProgressStyle};
use petril::explore::{Budget, Progress};

use super::Failure;
use super::args::Limits;
use super::guard::{self, Reason};
use super::memory;
use super::sign_of_life::{self, in_short};

/// Watcher of a search.
pub struct Watcher {
    bar: ProgressBar,
    /// Whether this is the only search, so that its figures are those of all the work.
    is_alone: bool,
    started: Instant,
    timeout: Option<Duration>,
    /// Memory limit in MiB.
    memory: u64,
    /// Time of the last display of figures, since the start.
    shown: Cell<Duration>,
}

/// Delay before figures are shown, and interval between them.
const PAUSE: Duration = Duration::from_millis(250);

/// Upper bound on threads, which are all started at once.
const MAX_THREADS: usize = 1024;

/// Sets the number of threads, once.
pub fn use_threads(limits: &Limits) -> Result<(), Failure> {
    static THREADS: OnceLock<Option<String>> = OnceLock::new();
    let Some(threads) = limits.threads else { return Ok(()) };
    if threads > MAX_THREADS {
        return Err(Failure::Message(format!("--threads: at most {MAX_THREADS}, not {threads}")));
    }
    let error = THREADS.get_or_init(|| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
        pool.err().map(|error| error.to_string())
    });
    error.as_ref().map_or(Ok(()), |error| Err(Failure::Message(format!("cannot use {threads} threads: {error}"))))
}

/// Progress bar on standard error for this number of steps, if that is a terminal.
pub fn steps(count: usize, of: &'static str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(count as u64), ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos} of {len} {msg}, {elapsed}") {
        bar.set_style(style);
    }
    bar.set_message(of);
    bar
}

impl Watcher {
    /// Sets the number of threads, and creates a watcher.
    pub fn new(limits: &Limits) -> Result<Self, Failure> {
        use_threads(limits)?;
        sign_of_life::begin();
        // The bar is drawn on standard error, and only if that is a terminal.
        Self::drawing(limits, ProgressDrawTarget::stderr(), true)
    }

    /// Creates a watcher without display, for one of several searches.
    pub fn unseen(limits: &Limits) -> Result<Self, Failure> {
        Self::drawing(limits, ProgressDrawTarget::hidden(), false)
    }

    fn drawing(limits: &Limits, target: ProgressDrawTarget, is_alone: bool) -> Result<Self, Failure> {
        let timeout = match limits.timeout.map(Duration::try_from_secs_f64) {
            Some(Err(error)) => return Err(Failure::Message(format!("--timeout: {error}"))),
            Some(Ok(timeout)) => Some(timeout),
            None => None,
        };
        let bar = ProgressBar::with_draw_target(None, target);
        bar.set_style(ProgressStyle::default_spinner());
        let memory = limits.budget().bytes >> 20;
        Ok(Self { bar, is_alone, started: Instant::now(), timeout, memory, shown: Cell::default() })
    }

    /// Updates the figures; returns a reason to stop when a limit on time or memory is exceeded.
    pub fn watch(&self, progress: &Progress) -> Option<String> {
        let elapsed = self.started.elapsed();
        let done = progress.expanded == progress.states;
        if self.is_alone {
            let (states, rest) = (in_short(progress.states), in_short(progress.states - progress.expanded));
            sign_of_life::say(if done {
                format!("{states} states, checking the requirements")
            } else {
                format!("{states} states, {rest} still to expand")
            });
        }
        if elapsed > self.shown.get() + PAUSE || (done && elapsed > PAUSE) {
            if self.shown.replace(elapsed).is_zero() {
                self.bar.enable_steady_tick(Duration::from_millis(100));
            }
            self.bar.set_message(if done {
                format!("explored {} states, checking the requirements", HumanCount(progress.states))
            } else {
                let rate = progress.states as f64 / elapsed.as_secs_f64();
                format!(
                    "exploring: {} states, {} still to expand, depth {}, {} states/s, {}",
                    HumanCount(progress.states),
                    HumanCount(progress.states - progress.expanded),
                    progress.depth,
                    HumanCount(rate as u64),
                    HumanBytes(progress.bytes),
                )
            });
        }
        if done {
            // States explored within the limits are still checked.
            let time = self.timeout.filter(|&timeout| elapsed > guard::to_finish(timeout)).map(Reason::Time);
            return guard::asked_to_finish().or(time).map(|reason| reason.to_string());
        }
        let time = self.timeout.filter(|&timeout| elapsed > timeout).map(Reason::Time);
        let memory = (guard::used() > self.memory).then(|| Reason::memory(self.memory));
        guard::asked().or(time).or(memory).map(|reason| reason.to_string())
    }

    /// Progress bar, which can make room for other output.
    pub fn figures(&self) -> ProgressBar {
        self.bar.clone()
    }

    /// Runs work while the figures are hidden.
    pub fn suspend<T>(&self, work: impl FnOnce() -> T) -> T {
        self.bar.suspend(work)
    }

    /// Clears the figures.
    pub fn finish(&self) {
        sign_of_life::end();
        self.bar.finish_and_clear();
    }
}

impl Limits {
    /// Limits enforced by the search itself.
    pub fn budget(&self) -> Budget {
        self.budget_of(Budget::default().states)
    }

    /// As [`Limits::budget`], with another default limit on states.
    pub fn budget_of(&self, states: u64) -> Budget {
        let bytes = self.max_memory.unwrap_or_else(memory::default_limit).saturating_mul(1 << 20);
        Budget { states: self.max_states.unwrap_or(states), bytes }
    }
}

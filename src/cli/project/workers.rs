//! The programs of a project, checked beside each other. Who goes on for longer than it may is not waited for.

use std::any::Any;
use std::collections::BTreeMap;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, Sender};
use std::thread;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use petril::printable::line;
use petril::verdict::Verdict;

use super::file::Entry;
use super::run::Judged;
use crate::cli::args::{Check, When};
use crate::cli::cache::Cache;
use crate::cli::check::{Done, checked};
use crate::cli::console::{Console, Told};
use crate::cli::guard::{self, Reason};
use crate::cli::phase::{self, Phase, Shown};
use crate::cli::progress::Watcher;
use crate::cli::{Failure, sign_of_life};

/// Between two looks at those who work.
const TICK: Duration = Duration::from_millis(20);

/// State shared by all workers.
struct Work {
    checks: Vec<(Check, Entry)>,
    next: AtomicUsize,
    cache: Option<Cache>,
    colour: When,
    /// Files read before.
    read: Vec<(String, String)>,
    bar: ProgressBar,
}

/// News of the program at a position.
struct News(usize, Event);

enum Event {
    Begun(Running),
    Done(Box<Result<Done, Failure>>, Told),
    /// The worker has panicked.
    Panicked(Box<dyn Any + Send>),
}

/// A program that is being checked.
struct Running {
    started: Instant,
    phase: Shown,
}

impl Running {
    /// Why nobody waits for it any longer.
    fn overdue(&self, timeout: Option<Duration>) -> Option<String> {
        let Phase { name, is_asking } = self.phase.get();
        let taken = self.started.elapsed();
        let is_late = |limit: Duration| taken > if is_asking { guard::to_wait(limit) } else { limit };
        let time = timeout.filter(|&limit| is_late(limit)).map(Reason::Time);
        let interrupted = guard::is_to_leave(is_asking).then_some(Reason::Interrupted);
        let reason = time.or(interrupted)?;
        Some(format!("{reason}, while {name}, after {:.1} s", taken.as_secs_f64()))
    }
}

impl Work {
    /// Checks programs until none is left. A program that is checked never takes up the work on another one in between.
    fn take_part(&self, news: &Sender<News>) {
        loop {
            let position = self.next.fetch_add(1, Ordering::Relaxed);
            let Some((arguments, entry)) = self.checks.get(position) else { return };
            self.bar.set_message(line(&entry.name));
            let tell = |event| drop(news.send(News(position, event)));
            tell(Event::Begun(Running { started: Instant::now(), phase: phase::set_apart() }));
            let own = Console::holding(self.colour, self.read.clone());
            let check = || {
                let watcher = Watcher::unseen(&arguments.limits)?;
                checked(arguments, &entry.program, self.cache.as_ref(), &own, &watcher, None)
            };
            match catch_unwind(AssertUnwindSafe(check)) {
                Ok(done) => tell(Event::Done(Box::new(done), own.told())),
                Err(panic) => return tell(Event::Panicked(panic)),
            }
        }
    }
}

/// Starts a thread that takes part. It waits for the ones that compute, of which there is one for each processor.
fn hire(work: &Arc<Work>, news: &Sender<News>) {
    let (work, news) = (Arc::clone(work), news.clone());
    thread::spawn(move || work.take_part(&news));
}

/// Checks all programs, several at once. What they say is printed in their order.
pub fn all(checks: Vec<(Check, Entry)>, cache: Option<Cache>, console: &Console) -> Vec<Judged> {
    let count = checks.len();
    let bar = ProgressBar::with_draw_target(Some(count as u64), ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos} of {len} programs, {elapsed}: {wide_msg}") {
        bar.set_style(style);
    }
    sign_of_life::begin();
    let (colour, read) = (console.colour(), console.provenance().inputs);
    let work = Arc::new(Work { checks, next: AtomicUsize::new(0), cache, colour, read, bar });
    let (sender, news) = mpsc::channel();
    (0..rayon::current_num_threads().min(count)).for_each(|_| hire(&work, &sender));
    let mut tally = Tally { all: count, ..Tally::default() };
    let mut running: BTreeMap<usize, Running> = BTreeMap::new();
    let mut results: BTreeMap<usize, (Result<Done, Failure>, Option<Told>)> = BTreeMap::new();
    while results.len() < count {
        let mut ended = Vec::new();
        match news.recv_timeout(TICK) {
            Ok(News(position, Event::Begun(program))) => drop(running.insert(position, program)),
            // Whoever was not waited for may be ready all the same, and too late.
            Ok(News(position, Event::Done(done, told))) if running.contains_key(&position) => {
                ended.push((position, *done, Some(told)));
            }
            Ok(News(position, Event::Panicked(panic))) if running.contains_key(&position) => resume_unwind(panic),
            _ => {}
        }
        for (&position, program) in &running {
            let timeout = work.checks[position].0.limits.bounds().timeout;
            let is_ended = ended.iter().any(|(other, ..)| *other == position);
            if let Some(reason) = program.overdue(timeout).filter(|_| !is_ended) {
                ended.push((position, Err(Failure::Stopped(reason)), None));
                hire(&work, &sender);
            }
        }
        for (position, done, told) in ended {
            running.remove(&position);
            work.bar.inc(1);
            tally.count(done.as_ref().map(|done| done.report.verdict()).unwrap_or(Verdict::Holds));
            sign_of_life::say(tally.to_string());
            results.insert(position, (done, told));
        }
    }
    sign_of_life::end();
    work.bar.finish_and_clear();
    let judged = |((arguments, entry), (done, told)): (&(Check, Entry), Ended)| {
        let mut diagnostics = Vec::new();
        if let Some(mut told) = told {
            diagnostics = told.take_diagnostics();
            console.tell(told);
        }
        match &done {
            Err(Failure::Message(message)) => console.error(&format!("{}: {message}", line(&entry.name))),
            Err(Failure::Stopped(message)) => console.message(&format!("unknown: {}: {message}\n", line(&entry.name))),
            Err(Failure::Reported) | Ok(_) => {}
        }
        Judged { name: entry.name.clone(), arguments: arguments.clone(), done, diagnostics }
    };
    work.checks.iter().zip(results.into_values()).map(judged).collect()
}

/// Outcome of a program, and what was to be printed about it.
type Ended = (Result<Done, Failure>, Option<Told>);

/// Number of programs that are done.
#[derive(Default)]
struct Tally {
    all: usize,
    done: usize,
    violated: usize,
}

impl Tally {
    fn count(&mut self, verdict: Verdict) {
        self.done += 1;
        self.violated += usize::from(verdict == Verdict::Violated);
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {} programs, {} violated", self.done, self.all, self.violated)
    }
}

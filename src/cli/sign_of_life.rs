//! Heartbeat: periodic lines on standard error for logs, where no progress bar is visible.

use std::io::{self, IsTerminal, Write};
use std::sync::{Mutex, Once, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::{guard, phase};

/// Environment variable for the seconds between two lines; 0 for none.
const VARIABLE: &str = "PETRIL_PROGRESS";

/// Default interval between two lines.
const PAUSE: Duration = Duration::from_secs(10);

/// Work in progress.
struct Work {
    started: Instant,
    /// Progress figures beside the phase.
    figures: String,
}

static WORK: Mutex<Option<Work>> = Mutex::new(None);

/// Starts work. From now on lines are printed, unless standard error is a terminal, which has its progress bar.
pub fn begin() {
    static THREAD: Once = Once::new();
    set(Some(Work { started: Instant::now(), figures: String::new() }));
    THREAD.call_once(|| {
        if let Some(pause) = pause().filter(|_| !io::stderr().is_terminal()) {
            // Without a thread there are no lines; the work goes on.
            drop(thread::Builder::new().name("sign of life".to_owned()).spawn(move || print(pause)));
        }
    });
}

/// Sets the progress figures.
pub fn say(figures: String) {
    if let Some(work) = WORK.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
        work.figures = figures;
    }
}

/// Ends work.
pub fn end() {
    set(None);
}

fn set(work: Option<Work>) {
    *WORK.lock().unwrap_or_else(PoisonError::into_inner) = work;
}

fn print(pause: Duration) {
    loop {
        thread::sleep(pause);
        let line = WORK.lock().unwrap_or_else(PoisonError::into_inner).as_ref().map(line);
        if let Some((_, line)) = line.filter(|(elapsed, _)| *elapsed >= pause) {
            // Errors of standard error are ignored.
            drop(guard::pause(|| io::stderr().write_all(line.as_bytes())));
        }
    }
}

fn line(work: &Work) -> (Duration, String) {
    let elapsed = work.started.elapsed();
    let what = if work.figures.is_empty() { phase::of_process().name } else { &work.figures };
    (elapsed, format!("petril: {} s, {what}\n", elapsed.as_secs()))
}

/// Interval from the environment; `None` if 0.
fn pause() -> Option<Duration> {
    let asked = std::env::var(VARIABLE).ok().and_then(|text| text.trim().parse().ok());
    let asked = asked.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    Some(asked.unwrap_or(PAUSE)).filter(|pause| !pause.is_zero())
}

/// Number in short form: 950, 4.2 k, 4.2 M.
pub fn in_short(number: u64) -> String {
    let units = [(1_000_000_000, "G"), (1_000_000, "M"), (1_000, "k")];
    match units.into_iter().find(|&(unit, _)| number >= unit) {
        Some((unit, letter)) => format!("{}.{} {letter}", number / unit, number % unit * 10 / unit),
        None => number.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::in_short;

    #[test]
    fn numbers_in_short() {
        let texts = [0, 999, 1_000, 4_251_999, 999_999, 7_000_000_000].map(in_short);
        assert_eq!(texts, ["0", "999", "1.0 k", "4.2 M", "999.9 k", "7.0 G"]);
    }
}

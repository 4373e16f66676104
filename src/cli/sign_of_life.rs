//! Signs of life where nobody sees figures: a line on standard error now and then, so that a log shows that work goes on.

use std::io::{self, IsTerminal, Write};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// The environment variable that says how many seconds pass between two lines; 0 for none.
const VARIABLE: &str = "PETRIL_PROGRESS";

/// Time between two lines.
const PAUSE: Duration = Duration::from_secs(10);

/// Lines on standard error until this is dropped.
pub struct SignOfLife {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Default)]
struct Shared {
    state: Mutex<State>,
    is_over: Condvar,
}

#[derive(Default)]
struct State {
    is_over: bool,
    /// What is going on, if more than the time is known.
    text: String,
}

impl SignOfLife {
    /// Lines from now on, unless standard error is a terminal, which has its own figures.
    pub fn start() -> Self {
        let shared = Arc::new(Shared::default());
        let own = Arc::clone(&shared);
        let pause = pause().filter(|_| !io::stderr().is_terminal());
        // Without a thread there are no lines; the work goes on.
        let spawn = |pause| thread::Builder::new().name("sign of life".to_owned()).spawn(move || own.print(pause)).ok();
        Self { thread: pause.and_then(spawn), shared }
    }

    /// No lines.
    pub fn none() -> Self {
        Self { shared: Arc::default(), thread: None }
    }

    /// Whether somebody reads what is going on.
    pub fn is_read(&self) -> bool {
        self.thread.is_some()
    }

    /// Something goes on.
    pub fn say(&self, text: String) {
        self.shared.state.lock().unwrap_or_else(PoisonError::into_inner).text = text;
    }

    /// No more lines.
    pub fn end(&self) {
        self.shared.state.lock().unwrap_or_else(PoisonError::into_inner).is_over = true;
        self.shared.is_over.notify_all();
    }
}

impl Drop for SignOfLife {
    fn drop(&mut self) {
        self.end();
        self.thread.take().into_iter().for_each(|thread| drop(thread.join()));
    }
}

impl Shared {
    fn print(&self, pause: Duration) {
        let started = Instant::now();
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        while !state.is_over {
            let waited = self.is_over.wait_timeout_while(state, pause, |state| !state.is_over);
            let (now, timeout) = waited.unwrap_or_else(PoisonError::into_inner);
            state = now;
            if timeout.timed_out() && !state.is_over {
                let comma = if state.text.is_empty() { "" } else { ", " };
                let line = format!("petril: {} s{comma}{}\n", started.elapsed().as_secs(), state.text);
                // If nobody listens, so be it.
                drop(io::stderr().write_all(line.as_bytes()));
            }
        }
    }
}

/// The time between two lines that is asked for.
fn pause() -> Option<Duration> {
    let asked = std::env::var(VARIABLE).ok().and_then(|text| text.trim().parse().ok());
    let asked = asked.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    Some(asked.unwrap_or(PAUSE)).filter(|pause| !pause.is_zero())
}

/// A number in few characters: 950, 4.2 k, 4.2 M.
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

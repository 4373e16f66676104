//! Last resort where work does not end although time is up, memory is used up, or whoever started the program wants its end.
//!
//! Work is asked to stop by those who watch it, and keeps what it has found. Some of it does not ask in time: one step of it
//! takes long. Then the program ends here, with a message and without a verdict.

use std::process::exit;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use super::memory;
use super::progress::interrupted_for;

/// Ends the program some time after a limit was reached, unless it is dropped before.
pub struct Guard {
    is_over: Arc<AtomicBool>,
}

/// Between two looks.
const PAUSE: Duration = Duration::from_millis(25);

/// How long work may go on after it was asked to stop, beside half of the time it had.
const GRACE: Duration = Duration::from_millis(900);

impl Guard {
    /// Guards the limits of time and of memory, in bytes, from now on.
    pub fn new(timeout: Option<Duration>, memory: u64) -> Self {
        let is_over = Arc::new(AtomicBool::new(false));
        let (over, started) = (Arc::clone(&is_over), Instant::now());
        // Without another thread, limits hold where work asks.
        let _ = thread::Builder::new().name("guard".to_owned()).spawn(move || {
            while !over.load(Ordering::Acquire) {
                thread::sleep(PAUSE);
                if let Some((code, message)) = overdue(started.elapsed(), timeout, memory)
                    && !over.load(Ordering::Acquire)
                {
                    if let Some(message) = message {
                        eprintln!("error: {message}");
                    }
                    exit(code);
                }
            }
        });
        Self { is_over }
    }
}

impl Drop for Guard {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Release);
    }
}

/// The exit code with which the program is to end, and what is said then.
fn overdue(elapsed: Duration, timeout: Option<Duration>, memory: u64) -> Option<(i32, Option<String>)> {
    if interrupted_for().is_some_and(|time| time > GRACE) {
        return Some((130, None));
    }
    if let Some(timeout) =
        timeout.filter(|&timeout| elapsed > timeout.saturating_add(timeout / 2).saturating_add(GRACE))
    {
        let limit = timeout.as_secs_f64();
        return Some((2, Some(format!("the time limit of {limit} s was reached, and work did not end"))));
    }
    let used = memory::resident().filter(|&used| used > memory.saturating_add(memory / 2))?;
    let (limit, used) = (memory >> 20, used >> 20);
    Some((2, Some(format!("the limit of {limit} MiB was reached, and work did not end: {used} MiB are in use"))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_has_half_of_its_time_more_and_a_second() {
        let seconds = Duration::from_secs_f64;
        let (ten, all) = (Some(seconds(10.0)), u64::MAX);
        assert_eq!(overdue(seconds(15.5), ten, all), None);
        assert!(overdue(seconds(16.0), ten, all).is_some_and(|(code, message)| {
            code == 2 && message.is_some_and(|message| message.contains("the time limit of 10 s"))
        }));
        assert_eq!(overdue(seconds(1e6), None, all), None);
        assert_eq!(overdue(seconds(0.5), Some(Duration::ZERO), all), None);
        assert_eq!(overdue(seconds(1e6), Some(Duration::MAX), all), None);
    }

    #[test]
    fn work_has_half_of_its_memory_more() {
        let Some(used) = memory::resident() else { return };
        assert_eq!(overdue(Duration::ZERO, None, used * 2), None);
        assert!(overdue(Duration::ZERO, None, used / 4).is_some_and(|(code, message)| {
            code == 2 && message.is_some_and(|message| message.contains("MiB are in use"))
        }));
    }
}

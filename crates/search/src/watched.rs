//! Long work that a watcher can cancel.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use crate::budget::Progress;

/// Time between two calls of the watcher.
const PAUSE: Duration = Duration::from_millis(20);

/// Does some work on another thread, and sets the flag when `watch` returns a reason to stop. Returns the result of the
/// work, and the reason, if there was one.
///
/// Long work on nets is always cancelled in this way: it checks the flag now and then.
pub fn watched<T: Send>(
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
    progress: &Progress,
    work: impl FnOnce(&AtomicBool) -> T + Send,
) -> (Option<T>, Option<String>) {
    let stopping = AtomicBool::new(false);
    let (sender, receiver) = channel();
    let flag = &stopping;
    thread::scope(|scope| {
        // The sender goes with the work: if that panics, nobody waits for a result any more.
        scope.spawn(move || sender.send(work(flag)));
        let mut reason = None;
        loop {
            match receiver.recv_timeout(PAUSE) {
                Ok(result) => return (Some(result), reason),
                Err(RecvTimeoutError::Disconnected) => return (None, reason),
                Err(RecvTimeoutError::Timeout) => {
                    reason = reason.or_else(|| watch(progress));
                    stopping.store(reason.is_some(), Ordering::Relaxed);
                }
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A panic is passed on, and not waited for.
    #[test]
    #[should_panic(expected = "a scoped thread panicked")]
    fn work_that_panics_is_over() {
        let mut looks = 0;
        let mut watch = |_: &Progress| {
            looks += 1;
            assert!(looks < 500, "the work is still watched after ten seconds");
            None
        };
        let _: (Option<()>, _) = watched(&mut watch, &Progress::default(), |_| panic!("a mistake"));
    }
}

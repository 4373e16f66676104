//! `--watch`: repeats the check whenever an input file changes.

use std::process::ExitCode;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::Duration;

use notify::{RecursiveMode, Watcher as _};

use super::console::Console;
use super::seen::Seen;
use super::{Failure, Outcome, guard, phase, report::counted};

/// Quiet period before files are inspected: editors write in several steps.
const QUIET: Duration = Duration::from_millis(100);

/// Polling interval for interrupts and for changes that the file system does not report.
const TICK: Duration = Duration::from_millis(200);

/// Exit code after an interrupt.
const INTERRUPTED: u8 = 130;

/// Repeats `check` on each change until interrupted.
pub fn run(console: &Console, check: &dyn Fn() -> Outcome) -> Outcome {
    loop {
        console.clear()?;
        guard::restart();
        if let Err(Failure::Message(message)) = check() {
            console.error(&message);
        }
        guard::rest();
        phase::begin_asking("waiting for a change");
        let seen = console.take_seen();
        if guard::is_interrupted() {
            return Ok(ExitCode::from(INTERRUPTED));
        }
        console.message(&format!("watching {}; Ctrl-C ends\n", counted(seen.count(), "file")));
        let (heard, events) = mpsc::channel();
        let watcher = notify::recommended_watcher(move |_| {
            let _ = heard.send(());
        });
        // Without a watcher, files are polled.
        let _watcher = watcher.ok().map(|mut watcher| {
            for folder in seen.folders() {
                let _ = watcher.watch(&folder, RecursiveMode::NonRecursive);
            }
            watcher
        });
        if !is_changed(&seen, &events) {
            return Ok(ExitCode::from(INTERRUPTED));
        }
    }
}

/// Waits for a change; false if interrupted.
fn is_changed(seen: &Seen, events: &Receiver<()>) -> bool {
    loop {
        match events.recv_timeout(TICK) {
            // Under continuous events, files are inspected nevertheless.
            Ok(()) => drop((0..20).take_while(|_| events.recv_timeout(QUIET).is_ok()).count()),
            // The watcher is gone.
            Err(RecvTimeoutError::Disconnected) => std::thread::sleep(TICK),
            Err(RecvTimeoutError::Timeout) => {}
        }
        if guard::is_interrupted() {
            return false;
        }
        if seen.is_other_now() {
            return true;
        }
    }
}

//! `--watch`: checks again whenever a file changes that was read.

use std::process::ExitCode;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::Duration;

use notify::{RecursiveMode, Watcher as _};

use super::console::Console;
use super::seen::Seen;
use super::{Failure, Outcome, guard, phase, report::counted};

/// How long nothing must happen until files are looked at: editors write in several steps.
const QUIET: Duration = Duration::from_millis(100);

/// How often somebody is asked to end, and files are looked at though nobody said that they changed: not all file systems say.
const TICK: Duration = Duration::from_millis(200);

/// The exit code of a program that was interrupted.
const INTERRUPTED: u8 = 130;

/// Checks, and checks again, until it is interrupted. `check` prints what it finds.
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
        // Without a watcher, files are looked at again and again.
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

/// Waits until something is not what it was; whether it is so, and not the end.
fn is_changed(seen: &Seen, events: &Receiver<()>) -> bool {
    loop {
        match events.recv_timeout(TICK) {
            // Where something happens all the time, files are looked at all the same.
            Ok(()) => drop((0..20).take_while(|_| events.recv_timeout(QUIET).is_ok()).count()),
            // Nobody listens.
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

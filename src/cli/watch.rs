//! `--watch`: checks again whenever a file changes that was read.

use std::collections::BTreeSet;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::Duration;

use notify::{RecursiveMode, Watcher as _};

use super::console::Console;
use super::{Failure, Outcome, progress, report::counted};

/// How long nothing must happen until files are looked at: editors write in several steps.
const QUIET: Duration = Duration::from_millis(100);

/// How often somebody is asked to end, and files are looked at though nobody said that they changed: not all file systems say.
const TICK: Duration = Duration::from_millis(200);

/// The exit code of a program that was interrupted.
const INTERRUPTED: u8 = 130;

/// Checks, and checks again, until it is interrupted. `check` prints what it finds.
pub fn run(console: &Console, check: &dyn Fn() -> Outcome) -> Outcome {
    progress::listen();
    loop {
        if io::stdout().is_terminal() {
            console.print("\u{1b}[2J\u{1b}[H")?;
        }
        if let Err(Failure::Message(message)) = check() {
            console.error(&message);
        }
        let files = console.take_files();
        if progress::is_interrupted() {
            return Ok(ExitCode::from(INTERRUPTED));
        }
        console.message(&format!("watching {}; Ctrl-C ends\n", counted(files.len(), "file")));
        let (heard, events) = mpsc::channel();
        let watcher = notify::recommended_watcher(move |_| {
            let _ = heard.send(());
        });
        // Without a watcher, files are looked at again and again.
        let _watcher = watcher.ok().map(|mut watcher| {
            for folder in folders(files.iter().map(|(path, _)| path.as_path())) {
                let _ = watcher.watch(&folder, RecursiveMode::NonRecursive);
            }
            watcher
        });
        if !is_changed(&files, &events) {
            return Ok(ExitCode::from(INTERRUPTED));
        }
    }
}

/// Waits until a file is not what was read; whether one is, and not the end.
fn is_changed(files: &[(PathBuf, Option<blake3::Hash>)], events: &Receiver<()>) -> bool {
    loop {
        match events.recv_timeout(TICK) {
            Ok(()) => while events.recv_timeout(QUIET).is_ok() {},
            // Nobody listens.
            Err(RecvTimeoutError::Disconnected) => std::thread::sleep(TICK),
            Err(RecvTimeoutError::Timeout) => {}
        }
        if progress::is_interrupted() {
            return false;
        }
        if files.iter().any(|(path, then)| std::fs::read(path).ok().map(|bytes| blake3::hash(&bytes)) != *then) {
            return true;
        }
    }
}

/// The folders of files: an editor may put a new file in the place of an old one.
fn folders<'p>(files: impl Iterator<Item = &'p Path>) -> BTreeSet<PathBuf> {
    let folder = |file: &Path| file.parent().filter(|folder| !folder.as_os_str().is_empty()).map(Path::to_owned);
    files.map(|file| folder(file).unwrap_or_else(|| PathBuf::from("."))).collect()
}

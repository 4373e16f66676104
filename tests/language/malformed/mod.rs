//! Whatever is given to the program, it answers: exit code 2, what is wrong and where; never a panic, never a hang.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

mod files;
mod nesting;
mod plants;
mod programs;
mod requirements;
mod soup;
mod xml;

use std::fs;

use support::process::{Run, petril};
use tempfile::TempDir;

/// What a refusal may print. A hundred diagnostics of the longest lines stay below it.
const MAX_MESSAGES: usize = 100_000;

/// Runs `petril` in a folder with these files.
fn run(files: &[(&str, &[u8])], arguments: &[&str]) -> Run {
    let folder = TempDir::new().unwrap();
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).unwrap();
    }
    petril(folder.path(), arguments)
}

/// The input is refused, nothing is printed but messages, and they name the place and say these words.
fn refused(run: &Run, place: &str, words: &[&str]) {
    let stderr = &run.stderr;
    let shown: String = stderr.chars().take(2000).collect();
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{shown}");
    assert!(stderr.len() < MAX_MESSAGES, "{} bytes of messages", stderr.len());
    assert!(place.is_empty() || stderr.contains(&format!("--> {place}\n")), "not at {place}:\n{shown}");
    for word in words {
        assert!(stderr.contains(word), "no `{word}` in\n{shown}");
    }
}

/// As many times as it takes to break what is not made for it.
const MANY: usize = 100_000;

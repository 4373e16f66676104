//! Provenance of the reports of a run, as far as it is known yet.

use std::fmt;
use std::sync::{Mutex, MutexGuard, PoisonError};

use petril::exchange::Provenance;

use super::seen::{Seen, sha256};

/// Inputs read, and options asked for.
#[derive(Debug, Default)]
pub struct Origin {
    seen: Mutex<Seen>,
    /// Files read before, by whoever is reported to.
    read_before: Vec<(String, String)>,
    /// Hash of the options of the command line.
    options: Mutex<String>,
}

impl Origin {
    /// Nothing yet but files that others have read.
    pub fn after(read_before: Vec<(String, String)>) -> Self {
        Self { read_before, ..Self::default() }
    }

    /// Files and patterns read.
    pub fn seen(&self) -> MutexGuard<'_, Seen> {
        lock(&self.seen)
    }

    /// Notes that the command line asks for this.
    pub fn has_options(&self, options: &dyn fmt::Debug) {
        *lock(&self.options) = sha256(format!("{options:?}").as_bytes());
    }

    /// Provenance of a report made now.
    pub fn provenance(&self) -> Provenance {
        let words = std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned());
        let mut inputs = self.read_before.clone();
        inputs.extend(self.seen().inputs());
        let command = std::iter::once("petril".to_owned()).chain(words).collect();
        Provenance { command, inputs, options: lock(&self.options).clone() }
    }
}

/// A value that several threads share, also after one of them has panicked.
fn lock<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

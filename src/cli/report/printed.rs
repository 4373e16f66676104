//! Incremental report: answers are printed in report order as soon as they are final.

use std::sync::{Mutex, PoisonError};

use indicatif::ProgressBar;
use petril::source::Source;
use petril::translate::System;
use petril::verdict::{News, Report};

use super::Text;
use crate::cli::Failure;
use crate::cli::args::Check;
use crate::cli::check::{self, Done};
use crate::cli::console::Console;
use crate::cli::progress::Watcher;

/// Partially printed report.
pub struct Printed<'a> {
    arguments: &'a Check,
    console: &'a Console,
    /// Progress bar, suspended while printing.
    figures: ProgressBar,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    /// Report without answers, set once the exploration is printed.
    opened: Option<Report>,
    /// Count of printed answers.
    answers: usize,
    /// First output error.
    failure: Option<Failure>,
}

impl<'a> Printed<'a> {
    /// A report of which nothing is printed yet.
    pub fn new(arguments: &'a Check, console: &'a Console, watcher: &Watcher) -> Self {
        Self { arguments, console, figures: watcher.figures(), state: Mutex::default() }
    }

    /// Prints an event of the check.
    pub fn hear(&self, system: &System, source: &Source, news: News<'_>) {
        let text = Text { system, source, arguments: self.arguments, console: self.console };
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let out = match news {
            News::Explored(report) => {
                let mut report = report.clone();
                check::add_warnings(&mut report, self.console);
                let out = text.opening(&report);
                state.opened = Some(report);
                out
            }
            News::Answered(position, answer) => {
                let Some(report) = &state.opened else { return };
                let out = text.next(answer, report);
                state.answers = position + 1;
                out
            }
        };
        if let Err(failure) = self.figures.suspend(|| self.console.print(&out)) {
            state.failure.get_or_insert(failure);
        }
    }

    /// Prints the rest of a complete report.
    pub fn rest(self, done: &Done) -> Result<(), Failure> {
        let Done { system, source, report, .. } = done;
        let text = Text { system, source, arguments: self.arguments, console: self.console };
        let State { opened, answers, failure } = self.state.into_inner().unwrap_or_else(PoisonError::into_inner);
        if let Some(failure) = failure {
            return Err(failure);
        }
        let opening = if opened.is_some() { String::new() } else { text.opening(report) };
        let text = opening + &text.closing(report, answers);
        self.console.print_report(&text, &done.provenance, self.arguments.details).map(drop)
    }
}

//! Terminal output: colour, width, and destination of messages.

use std::fmt;
use std::fs::File;
use std::hash::{BuildHasher as _, Hasher as _, RandomState};
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use petril::diagnostic::{Diagnostic, Style, render};
use petril::exchange::{Provenance, json};
use petril::printable;
use petril::source::Source;
use serde_json::Value;

use super::args::When;
use super::origin::Origin;
use super::seen::Seen;
use super::{Failure, Outcome, SUCCESS, guard, output, reason};

/// Upper bound on the diagnostics printed for one file; the first ones are the ones to fix.
pub const MAX_DIAGNOSTICS: usize = 100;

/// Output channels. Results go to standard output, messages to standard error.
pub struct Console {
    errors_in_colour: bool,
    output_in_colour: bool,
    width: usize,
    /// Width of results in columns: that of the terminal they go to, or the requested one.
    output_width: Option<usize>,
    /// Whether results may contain other characters than ASCII.
    has_unicode: bool,
    /// Diagnostics printed so far, for JSON output.
    printed: Mutex<Vec<Value>>,
    /// Messages held back, unless they are printed at once.
    held: Option<Mutex<String>>,
    colour: When,
    /// Mark after the escape character of colours until they are printed. Random in each run, so that no text contains
    /// it.
    mark: String,
    origin: Arc<Origin>,
}

/// Output collected by a holding console.
pub struct Told {
    messages: String,
    diagnostics: Vec<Value>,
    seen: Seen,
}

impl Told {
    /// Takes the diagnostics, for JSON output.
    pub fn take_diagnostics(&mut self) -> Vec<Value> {
        std::mem::take(&mut self.diagnostics)
    }
}

impl Console {
    pub fn new(colour: When) -> Self {
        let wanted = |terminal: bool| match colour {
            When::Always => true,
            When::Never => false,
            When::Auto => terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty()),
        };
        let width = console_width().unwrap_or(120);
        Self {
            errors_in_colour: wanted(io::stderr().is_terminal()),
            output_in_colour: wanted(io::stdout().is_terminal()),
            width,
            output_width: console_width().or_else(terminal_width),
            has_unicode: locale_has_unicode(),
            printed: Mutex::default(),
            held: None,
            colour,
            mark: format!("{:016x}", RandomState::new().build_hasher().finish()),
            origin: Arc::default(),
        }
    }

    /// Records the options of the command line.
    pub fn has_options(&self, options: &dyn fmt::Debug) {
        self.origin.has_options(options);
    }

    /// Provenance of a report made now.
    pub fn provenance(&self) -> Provenance {
        self.origin.provenance()
    }

    /// Where the reports come from.
    pub fn origin(&self) -> Arc<Origin> {
        Arc::clone(&self.origin)
    }

    /// Colour setting.
    pub fn colour(&self) -> When {
        self.colour
    }

    /// Creates a console that holds its output until it is passed to [`tell`](Self::tell).
    pub fn holding(colour: When, read_before: Vec<(String, String)>) -> Self {
        Self { held: Some(Mutex::default()), origin: Arc::new(Origin::after(read_before)), ..Self::new(colour) }
    }

    /// Output held by a holding console.
    pub fn told(self) -> Told {
        let messages = self.held.map(inner).unwrap_or_default();
        Told { messages, diagnostics: inner(self.printed), seen: std::mem::take(&mut *self.origin.seen()) }
    }

    /// Prints the output of a holding console.
    pub fn tell(&self, told: Told) {
        self.write(&told.messages);
        lock(&self.printed).extend(told.diagnostics);
        self.origin.seen().extend(told.seen);
    }

    /// Records a file that was read, or could not be (`None`).
    pub fn has_read(&self, path: &Path, bytes: Option<&[u8]>) {
        output::has_read(path);
        self.origin.seen().file(path, bytes);
    }

    /// Records the files matched by a pattern.
    pub fn has_matched(&self, pattern: &str, files: &[PathBuf]) {
        self.origin.seen().pattern(pattern, files);
    }

    /// Takes the record of files and patterns read since the last call.
    pub fn take_seen(&self) -> Seen {
        std::mem::take(&mut *self.origin.seen())
    }

    /// Prints the diagnostics of a file, up to a limit, each followed by an empty line.
    pub fn diagnostics(&self, diagnostics: &[Diagnostic], source: &Source) {
        let style = Style { colour: self.errors_in_colour, width: self.width };
        lock(&self.printed).extend(diagnostics.iter().map(|diagnostic| json::diagnostic(diagnostic, source)));
        for diagnostic in diagnostics.iter().take(MAX_DIAGNOSTICS) {
            self.write(&format!("{}\n", render(diagnostic, source, style)));
        }
        if let Some(more @ 1..) = diagnostics.len().checked_sub(MAX_DIAGNOSTICS) {
            self.message(&format!("… and {more} more in {}\n", printable::line(source.name())));
        }
    }

    /// Warnings printed so far: code, place, and message of each.
    pub fn warnings(&self) -> Vec<(String, String, String)> {
        let printed = lock(&self.printed);
        let text = |value: &Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        let warnings = printed.iter().filter(|diagnostic| diagnostic["severity"] == "warning");
        let place = |d: &Value| format!("{}:{}:{}", text(&d["file"]), d["line"], d["column"]);
        warnings.map(|d| (text(&d["code"]), place(d), text(&d["message"]))).collect()
    }

    /// Prints an error without a place in a file. Its further lines are indented, so that none of them can pass for a
    /// line of its own.
    pub fn error(&self, message: &str) {
        let title = if self.errors_in_colour { "\u{1b}[1;31merror\u{1b}[0m" } else { "error" };
        let message = printable::lines(message);
        let lines =
            message.lines().map(|line| if line.starts_with("  ") { line.to_owned() } else { format!("  {line}") });
        self.write(&format!("{title}: {}\n", lines.collect::<Vec<_>>().join("\n").trim_start()));
    }

    /// Prints a message. Write errors are ignored.
    pub fn message(&self, text: &str) {
        self.write(&printable::lines(text));
    }

    /// Prints a message as it is, with its colours.
    fn write(&self, text: &str) {
        match &self.held {
            Some(held) => lock(held).push_str(text),
            None => drop(guard::pause(|| io::stderr().write_all(text.as_bytes()))),
        }
    }

    /// Prints a result. Only the colours of [`paint()`](Self::paint) can affect the terminal; other escapes are
    /// neutralised.
    pub fn print(&self, text: &str) -> Outcome {
        let mark = format!("\u{1b}{}", self.mark);
        let pieces: Vec<_> = text.split(&mark).map(printable::lines).collect();
        self.print_as_it_is(&pieces.join("\u{1b}"))
    }

    /// Prints a report for people, followed by its provenance if output goes to a file or all details are wanted.
    pub fn print_report(&self, text: &str, provenance: &Provenance, tells_everything: bool) -> Outcome {
        if !tells_everything && !is_kept() {
            return self.print(text);
        }
        let pairs = provenance.pairs();
        let lines = pairs.iter().map(|(what, said)| format!("{what}: {said}\n"));
        self.print(&format!("{text}\n{}", lines.collect::<String>()))
    }

    /// Clears the terminal, if results go to one.
    pub fn clear(&self) -> Outcome {
        if io::stdout().is_terminal() { self.print_as_it_is("\u{1b}[2J\u{1b}[H") } else { Ok(SUCCESS) }
    }

    fn print_as_it_is(&self, text: &str) -> Outcome {
        // Text after the last line end stays in a buffer, and write errors would be lost without a flush.
        let mut out = io::stdout().lock();
        match guard::pause(|| out.write_all(text.as_bytes()).and_then(|()| out.flush())) {
            Ok(()) => Ok(SUCCESS),
            // The reader has closed the pipe, as `head` does.
            Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(SUCCESS),
            Err(error) => Err(Failure::Message(format!("cannot print: {}", reason(&error)))),
        }
    }

    /// Prints a result as a JSON document, with provenance and the diagnostics printed so far.
    pub fn print_json(&self, mut document: Value) -> Outcome {
        if document["provenance"].is_null() {
            document["provenance"] = self.provenance().json();
        }
        document["diagnostics"] = Value::Array(std::mem::take(&mut *lock(&self.printed)));
        self.print_as_it_is(&printable::json(&format!("{document:#}\n")))
    }

    /// Width of results in columns; unlimited for a pipe.
    pub fn output_width(&self) -> usize {
        self.output_width.unwrap_or(usize::MAX)
    }

    /// Whether results may contain other characters than ASCII.
    pub fn has_unicode(&self) -> bool {
        self.has_unicode
    }

    /// Colours a word of a result by its meaning.
    pub fn paint(&self, word: &str, colour: Colour) -> String {
        let code = match colour {
            Colour::Good => "32",
            Colour::Bad => "31",
            Colour::Doubtful => "33",
        };
        let escape = format!("\u{1b}{}", self.mark);
        if self.output_in_colour { format!("{escape}[1;{code}m{word}{escape}[0m") } else { word.to_owned() }
    }

    /// Whether results are coloured.
    pub fn output_in_colour(&self) -> bool {
        self.output_in_colour
    }
}

/// Locks a mutex, even after a thread has panicked.
fn lock<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

fn inner<T>(shared: Mutex<T>) -> T {
    shared.into_inner().unwrap_or_else(PoisonError::into_inner)
}

/// Meaning of a colour.
#[derive(Clone, Copy)]
pub enum Colour {
    Good,
    Bad,
    Doubtful,
}

/// Whether standard output is a file.
fn is_kept() -> bool {
    #[cfg(unix)]
    let copy = std::os::fd::AsFd::as_fd(&io::stdout()).try_clone_to_owned();
    #[cfg(windows)]
    let copy = std::os::windows::io::AsHandle::as_handle(&io::stdout()).try_clone_to_owned();
    copy.is_ok_and(|copy| File::from(copy).metadata().is_ok_and(|about| about.is_file()))
}

/// Width from the environment variable `COLUMNS`, if set.
fn console_width() -> Option<usize> {
    std::env::var("COLUMNS").ok()?.parse().ok().filter(|&width| width >= 40)
}

/// Width of the terminal that results go to, if any.
fn terminal_width() -> Option<usize> {
    let (terminal_size::Width(columns), _) = terminal_size::terminal_size_of(io::stdout())?;
    Some(usize::from(columns)).filter(|&width| width >= 40)
}

/// Whether the locale uses UTF-8, and the terminal is not a dumb one.
fn locale_has_unicode() -> bool {
    let set = |name: &str| std::env::var(name).ok().filter(|value| !value.is_empty());
    let locale = ["LC_ALL", "LC_CTYPE", "LANG"].into_iter().find_map(set).unwrap_or_default().to_uppercase();
    (locale.contains("UTF-8") || locale.contains("UTF8")) && set("TERM").is_none_or(|terminal| terminal != "dumb")
}

//! Project run: all programs are checked concurrently and reported in project order.

use std::ffi::OsString;
use std::fmt;
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError, mpsc};
use std::thread;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use petril::exchange::json;
use petril::printable::line;
use petril::verdict::Verdict;
use serde_json::{Value, json};

use super::file::{Entry, NAME, find, read};
use super::forms;
use super::given::arguments;
use super::summary::{Line, summary};
use crate::cli::args::Check;
use crate::cli::cache::Cache;
use crate::cli::check::{Done, checked, code};
use crate::cli::console::{Console, Told};
use crate::cli::progress::{Watcher, use_threads};
use crate::cli::report::Text;
use crate::cli::{Failure, Outcome, guard, sign_of_life};

/// A project program, checked or failed.
pub struct Judged {
    /// Program name.
    pub name: String,
    pub arguments: Check,
    pub done: Result<Done, Failure>,
    /// Diagnostics of its files, for JSON output.
    pub diagnostics: Vec<Value>,
}

pub fn run(command: &Check, given: &[OsString], console: &Console) -> Outcome {
    let nothing = || {
        Failure::Message(format!(
            "there is no program to check, and no `{NAME}` here or above\n  name a program, or write a project file; `petril init` \
             writes an example of both"
        ))
    };
    let path = command.project.clone().or_else(find).ok_or_else(nothing)?;
    let entries = chosen(read(&path, console)?, &command.only)?;
    let checks = entries.into_iter().map(|entry| Ok((arguments(&entry, given)?, entry)));
    let checks: Vec<(Check, Entry)> = checks.collect::<Result<_, Failure>>()?;
    use_threads(&command.limits)?;
    guard::listen();
    let cache = if command.no_cache { None } else { Cache::open(Some(&path), console) };
    let results = all(checks, cache.as_ref(), console);
    forms::write(&command.forms, &results)?;
    if command.json {
        console.print_json(document(&path, &results))?;
    } else {
        console.print_report(&text(&path, &results, console), &console.provenance(), command.details)?;
    }
    Ok(worst(&results))
}

/// Programs selected by `--only`; all without patterns.
fn chosen(entries: Vec<Entry>, only: &[String]) -> Result<Vec<Entry>, Failure> {
    if only.is_empty() {
        return Ok(entries);
    }
    let pattern = |text: &String| {
        let wrong = |error: glob::PatternError| {
            Failure::Message(format!("--only: `{}` is no pattern: {}", line(text), error.msg))
        };
        let pattern = glob::Pattern::new(text).map_err(wrong)?;
        if entries.iter().any(|entry| pattern.matches(&entry.name)) {
            return Ok(pattern);
        }
        let names: Vec<&str> = entries.iter().map(|entry| entry.name.as_str()).collect();
        let nearest = petril::diagnostic::nearest(text, names.iter().copied());
        let help =
            nearest.map_or_else(|| format!("there are {}", names.join(", ")), |n| format!("did you mean `{n}`?"));
        Err(Failure::Message(format!(
            "--only: no program of the project is called `{}`\n  {}",
            line(text),
            line(&help)
        )))
    };
    let patterns: Vec<glob::Pattern> = only.iter().map(pattern).collect::<Result<_, Failure>>()?;
    Ok(entries.into_iter().filter(|entry| patterns.iter().any(|pattern| pattern.matches(&entry.name))).collect())
}

/// Checks all programs concurrently. Their diagnostics are printed in project order.
fn all(checks: Vec<(Check, Entry)>, cache: Option<&Cache>, console: &Console) -> Vec<Judged> {
    let bar = ProgressBar::with_draw_target(Some(checks.len() as u64), ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos} of {len} programs, {elapsed}: {wide_msg}") {
        bar.set_style(style);
    }
    sign_of_life::begin();
    let tally = Mutex::new(Tally { all: checks.len(), ..Tally::default() });
    let (next, colour, read) = (AtomicUsize::new(0), console.colour(), console.provenance().inputs);
    let (found, results) = mpsc::channel();
    // Worker threads only wait for the rayon pool, which has one thread per processor. A pool thread busy with one
    // program thus never steals work of another in between.
    let workers = rayon::current_num_threads().min(checks.len());
    thread::scope(|scope| {
        for _ in 0..workers {
            let (found, next, checks, bar, tally, read) = (found.clone(), &next, &checks, &bar, &tally, &read);
            scope.spawn(move || {
                while let Some((position, (arguments, entry))) = take(next, checks) {
                    bar.set_message(line(&entry.name));
                    let own = Console::holding(colour, read.clone());
                    let watcher = Watcher::unseen(&arguments.limits);
                    let done =
                        watcher.and_then(|watcher| checked(arguments, &entry.program, cache, &own, &watcher, None));
                    bar.inc(1);
                    let verdict = done.as_ref().map(|done| done.report.verdict());
                    let mut tally = tally.lock().unwrap_or_else(PoisonError::into_inner);
                    tally.count(verdict.unwrap_or(Verdict::Holds));
                    sign_of_life::say(tally.to_string());
                    drop(tally);
                    // The receiver outlives the workers.
                    let _ = found.send((position, done, own.told()));
                }
            });
        }
    });
    drop(found);
    sign_of_life::end();
    bar.finish_and_clear();
    let mut results: Vec<(usize, Result<Done, Failure>, Told)> = results.iter().collect();
    results.sort_by_key(|&(position, ..)| position);
    let told = |((arguments, entry), (_, done, mut told)): ((Check, Entry), (usize, _, Told))| {
        let diagnostics = told.take_diagnostics();
        console.tell(told);
        if let Err(Failure::Message(message)) = &done {
            console.error(&format!("{}: {message}", line(&entry.name)));
        }
        Judged { name: entry.name, arguments, done, diagnostics }
    };
    checks.into_iter().zip(results).map(told).collect()
}

/// Counts of finished and violated programs.
#[derive(Default)]
struct Tally {
    all: usize,
    done: usize,
    violated: usize,
}

impl Tally {
    fn count(&mut self, verdict: Verdict) {
        self.done += 1;
        self.violated += usize::from(verdict == Verdict::Violated);
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {} programs, {} violated", self.done, self.all, self.violated)
    }
}

/// Takes the next unclaimed item.
fn take<'a, T>(next: &AtomicUsize, of: &'a [T]) -> Option<(usize, &'a T)> {
    let position = next.fetch_add(1, Ordering::Relaxed);
    Some((position, of.get(position)?))
}

/// Summary table, followed by the answers that do not hold.
fn text(path: &Path, results: &[Judged], console: &Console) -> String {
    let lines: Vec<Line<'_>> = results.iter().map(|result| Line::of(&result.name, result.done.as_ref().ok())).collect();
    let mut out = summary(path, &lines, console);
    for Judged { name, arguments, done, .. } in results {
        let Ok(Done { system, source, report, .. }) = done else { continue };
        if report.verdict() != Verdict::Holds {
            let text = Text { system, source, arguments, console };
            out += &format!("\n{}\n{}", line(&format!("{name}: {}", source.name())), text.failing(report));
        }
    }
    out
}

fn document(path: &Path, results: &[Judged]) -> Value {
    let program = |result: &Judged| {
        let mut report = match &result.done {
            Ok(done) => json::report(&done.told(), result.arguments.by_line || result.arguments.details),
            Err(Failure::Message(message)) => json!({ "verdict": "error", "error": message }),
            Err(Failure::Reported) => json!({ "verdict": "error", "error": null }),
        };
        report["diagnostics"] = result.diagnostics.clone().into();
        json!({ "name": result.name, "verdict": report["verdict"], "report": report })
    };
    let verdicts = results.iter().filter_map(|result| result.done.as_ref().ok()).map(|done| done.report.verdict());
    let is_wrong = results.iter().any(|result| result.done.is_err());
    let verdict = if is_wrong { "error" } else { verdicts.max().unwrap_or(Verdict::Holds).word() };
    json!({
        "project": path.display().to_string(),
        "programs": results.iter().map(program).collect::<Vec<_>>(),
        "verdict": verdict,
    })
}

/// Exit code of the worst result: unusable input, then violated, then unknown.
fn worst(results: &[Judged]) -> ExitCode {
    if results.iter().any(|result| result.done.is_err()) {
        return ExitCode::from(2);
    }
    let verdicts = results.iter().filter_map(|result| result.done.as_ref().ok()).map(|done| done.report.verdict());
    code(verdicts.max().unwrap_or(Verdict::Holds))
}

//! Project run: all programs are checked concurrently and reported in project order.

use std::ffi::OsString;
use std::path::Path;
use std::process::ExitCode;

use petril::exchange::json;
use petril::printable::line;
use petril::verdict::Verdict;
use serde_json::{Value, json};

use super::assumed::assumed;
use super::file::{Entry, NAME, find, read};
use super::forms;
use super::given::arguments;
use super::summary::{Line, summary};
use super::workers::all;
use crate::cli::args::Check;
use crate::cli::cache::Cache;
use crate::cli::check::{Done, code};
use crate::cli::console::Console;
use crate::cli::progress::use_threads;
use crate::cli::report::Text;
use crate::cli::{Failure, Outcome, output, phase};

/// A project program, checked or failed.
pub struct Judged {
    /// Program name.
    pub name: String,
    pub arguments: Check,
    pub done: Result<Done, Failure>,
    /// Diagnostics of its files, for JSON output.
    pub diagnostics: Vec<Value>,
}

impl Judged {
    /// The verdict; nothing if the files cannot be used.
    pub fn verdict(&self) -> Option<Verdict> {
        match &self.done {
            Ok(done) => Some(done.report.verdict()),
            Err(Failure::Stopped(_)) => Some(Verdict::Unknown),
            Err(Failure::Message(_) | Failure::Reported) => None,
        }
    }
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
    refuse_inputs(&checks, command)?;
    phase::begin_asking("checking programs");
    let cache = if command.no_cache { None } else { Cache::open(Some(&path), console) };
    let results = all(checks, cache, console);
    forms::write(&command.forms, &results)?;
    if command.json {
        console.print_json(document(&path, &results))?;
    } else {
        console.print_report(&text(&path, &results, console), &console.provenance(), command.details)?;
    }
    Ok(worst(&results).map_or(ExitCode::from(2), code))
}

/// Refuses outputs in the place of inputs before there is any work. A plant that a requirement file names is known later.
fn refuse_inputs(checks: &[(Check, Entry)], command: &Check) -> Result<(), Failure> {
    for (Check { require, plant, .. }, Entry { program, .. }) in checks {
        require.iter().chain(plant).chain([program]).for_each(|path| output::has_read(path));
    }
    forms::refuse(&command.forms, checks.iter().map(|(_, entry)| entry.name.as_str()))
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

/// Summary table, followed by the answers that do not hold.
fn text(path: &Path, results: &[Judged], console: &Console) -> String {
    let lines: Vec<Line<'_>> = results.iter().map(Line::of).collect();
    let mut out = summary(path, &lines, console) + &assumed(results, console);
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
            Err(Failure::Stopped(message)) => json!({ "verdict": "unknown", "error": message }),
            Err(Failure::Reported) => json!({ "verdict": "error", "error": null }),
        };
        report["diagnostics"] = result.diagnostics.clone().into();
        json!({ "name": result.name, "verdict": report["verdict"], "report": report })
    };
    let verdict = worst(results).map_or("error", Verdict::word);
    json!({
        "project": path.display().to_string(),
        "programs": results.iter().map(program).collect::<Vec<_>>(),
        "verdict": verdict,
    })
}

/// The worst verdict: violated, then unknown; none if there is input that cannot be used.
fn worst(results: &[Judged]) -> Option<Verdict> {
    let verdicts: Option<Vec<Verdict>> = results.iter().map(Judged::verdict).collect();
    Some(verdicts?.into_iter().max().unwrap_or(Verdict::Holds))
}

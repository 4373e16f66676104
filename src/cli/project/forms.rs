//! Report files of a project: one file for all programs where the format allows it, else one for each.

use std::fs;
use std::path::{Component, Path, PathBuf};

use petril::exchange::{Checked, Stamp, junit, sarif};
use petril::printable;
use serde_json::Value;

use super::run::Judged;
use crate::cli::forms::{self, Forms, stamp};
use crate::cli::{Failure, output, phase, reason, shown};

/// Refuses forms in the place of inputs, for programs with these names.
pub fn refuse<'n>(forms: &Forms, names: impl Iterator<Item = &'n str>) -> Result<(), Failure> {
    let mut outputs: Vec<PathBuf> = forms.junit.iter().chain(&forms.sarif).cloned().collect();
    for name in names {
        let within = |folder: &Option<PathBuf>, ending| folder.as_ref().map(|folder| path(folder, name, ending));
        outputs.extend(within(&forms.html, ".html").into_iter().chain(within(&forms.csv, ".csv")));
    }
    output::refuse(&outputs)
}

/// Writes the requested files for all programs that could be checked.
pub fn write(forms: &Forms, results: &[Judged]) -> Result<(), Failure> {
    refuse(forms, results.iter().map(|result| result.name.as_str()))?;
    phase::begin_asking("writing the report");
    let done = || results.iter().filter_map(|result| Some((result, result.done.as_ref().ok()?)));
    let told: Vec<(&str, Checked<'_>, Stamp)> =
        done().map(|(result, done)| (result.name.as_str(), done.told(), stamp(done.started))).collect();
    if let Some(file) = &forms.junit {
        output::write_text(file, &junit::write_all(&told))?;
    }
    if let Some(file) = &forms.sarif {
        let documents = told.iter().map(|(_, checked, stamp)| sarif::write(checked, *stamp));
        if let Some(document) = documents.reduce(joined) {
            output::write_text(file, &printable::json(&format!("{document}\n")))?;
        }
    }
    for (result, done) in done() {
        let within = |folder: &Option<PathBuf>, ending: &str| {
            folder.as_ref().map(|folder| file(folder, &result.name, ending)).transpose()
        };
        let own = Forms {
            html: within(&forms.html, ".html")?,
            csv: within(&forms.csv, ".csv")?,
            trace_csv: within(&forms.trace_csv, "")?,
            vcd: within(&forms.vcd, "")?,
            ..Forms::default()
        };
        forms::write(&own, &done.told(), done.started)?;
    }
    Ok(())
}

/// Merges the runs of two SARIF documents.
fn joined(mut all: Value, mut more: Value) -> Value {
    if let (Some(runs), Some(others)) = (all["runs"].as_array_mut(), more["runs"].as_array_mut()) {
        runs.append(others);
    }
    all
}

/// The file of a program in a folder. A name like `lines/press` is a path in it, and never one out of it.
fn path(folder: &Path, name: &str, ending: &str) -> PathBuf {
    let inside = Path::new(name).components().filter(|part| matches!(part, Component::Normal(_)));
    let mut path = folder.join(inside.collect::<PathBuf>()).into_os_string();
    path.push(ending);
    PathBuf::from(path)
}

/// As [`path`]; the folder is made if there is none.
fn file(folder: &Path, name: &str, ending: &str) -> Result<PathBuf, Failure> {
    let path = path(folder, name, ending);
    let parent = path.parent().unwrap_or(folder);
    let cannot = |error| Failure::Message(format!("cannot make the folder `{}`: {}", shown(parent), reason(&error)));
    fs::create_dir_all(parent).map_err(cannot)?;
    Ok(path)
}

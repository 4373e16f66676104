//! Report files: output formats written to files, several at once if requested.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Instant, SystemTime, UNIX_EPOCH};

use petril::exchange::{Checked, Purpose, Stamp, html, junit, report_csv, runs, sarif, vcd};
use petril::printable;
use petril::verdict::{Answer, Trace};

use super::{Failure, output, phase, reason, shown};

/// Files that a check writes beside its report.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct Forms {
    /// Write the report as one page for a browser, which needs nothing else: requirements, runs to step through, diagrams.
    #[arg(long, value_name = "FILE", help_heading = "Files")]
    pub html: Option<PathBuf>,
    /// Write the report as JUnit XML, for continuous integration.
    #[arg(long, value_name = "FILE", help_heading = "Files")]
    pub junit: Option<PathBuf>,
    /// Write what is violated or unknown as SARIF 2.1.0, for code scanning and editors.
    #[arg(long, value_name = "FILE", help_heading = "Files")]
    pub sarif: Option<PathBuf>,
    /// Write a table (CSV) with one row for each requirement.
    #[arg(long, value_name = "FILE", help_heading = "Files")]
    pub csv: Option<PathBuf>,
    /// Write the inputs of each counterexample into this folder, as tables that `petril simulate --inputs` reads.
    #[arg(long, value_name = "FOLDER", help_heading = "Files")]
    pub trace_csv: Option<PathBuf>,
    /// Write each counterexample into this folder as a value change dump (VCD), for waveform viewers (scan view).
    #[arg(long, value_name = "FOLDER", help_heading = "Files")]
    pub vcd: Option<PathBuf>,
}

/// Writes the requested files. Each file is written completely or not at all.
pub fn write(forms: &Forms, checked: &Checked<'_>, started: Instant) -> Result<(), Failure> {
    refuse(forms)?;
    phase::begin_asking("writing the report");
    let stamp = stamp(started);
    if let Some(file) = &forms.html {
        output::write_text(file, &html::write(checked, stamp))?;
    }
    if let Some(file) = &forms.junit {
        output::write_text(file, &junit::write(checked, stamp))?;
    }
    if let Some(file) = &forms.sarif {
        output::write_text(file, &printable::json(&format!("{}\n", sarif::write(checked, stamp))))?;
    }
    if let Some(file) = &forms.csv {
        output::write_text(file, &report_csv::write(checked))?;
    }
    if let Some(folder) = &forms.trace_csv {
        each_counterexample(folder, "csv", checked, |_, trace| Some(report_csv::inputs(checked.system, trace)))?;
    }
    if let Some(folder) = &forms.vcd {
        each_counterexample(folder, "vcd", checked, |answer, trace| match trace {
            Trace::Scans(trace) => {
                Some(vcd::write(checked.system, trace, &format!("{}: {}", answer.name, answer.formula)))
            }
            Trace::Firings(_) => None,
        })?;
    }
    Ok(())
}

/// Rejects a file used for two outputs, and an output that would overwrite an input.
pub fn refuse(forms: &Forms) -> Result<(), Failure> {
    output::refuse([&forms.html, &forms.junit, &forms.sarif, &forms.csv].into_iter().flatten())
}

/// Writes a file for each counterexample, named after the requirement.
fn each_counterexample(
    folder: &Path,
    ending: &str,
    checked: &Checked<'_>,
    content: impl Fn(&Answer, &Trace) -> Option<String>,
) -> Result<(), Failure> {
    fs::create_dir_all(folder)
        .map_err(|error| Failure::Message(format!("cannot make the folder `{}`: {}", shown(folder), reason(&error))))?;
    for answer in checked.answers() {
        for (_, witness) in runs(answer).filter(|(purpose, _)| *purpose == Purpose::Counterexample) {
            let plain = |c: char| if c.is_alphanumeric() || c == '-' { c } else { '_' };
            let name: String = answer.name.chars().map(plain).collect();
            if let Some(content) = content(answer, &witness.trace) {
                output::write_text(&folder.join(format!("{name}.{ending}")), &content)?;
            }
        }
    }
    Ok(())
}

/// Current time and duration. `SOURCE_DATE_EPOCH` replaces the time, for reproducible output, and the duration is then
/// 0.
pub fn stamp(started: Instant) -> Stamp {
    let said = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|text| text.parse().ok());
    let now = || SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    match said {
        Some(seconds) => Stamp { seconds, took: 0.0 },
        None => Stamp { seconds: now(), took: started.elapsed().as_secs_f64() },
    }
}

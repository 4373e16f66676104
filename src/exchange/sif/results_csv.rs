//! Test results as a table (CSV): one row per test.

use super::told::{brief, error_line, reasons};
use super::{Ran, Sheets};
use crate::exchange::{Provenance, table};

/// Columns of the table.
const COLUMNS: [&str; 12] =
    ["function", "test", "result", "start", "scans", "inputs", "reason", "line", "tool", "files", "options", "command"];

/// Writes the results of a run.
#[must_use]
pub fn write(sheets: &Sheets<'_>, ran: &Ran<'_>) -> String {
    let rows = sheets.plans.iter().zip(ran.results).flat_map(|(plan, run)| {
        plan.tests.iter().zip(&run.tests).enumerate().map(|(number, (test, made))| {
            vec![
                sheets.specification.functions[plan.function].name.clone(),
                (number + 1).to_string(),
                made.ending.word().to_owned(),
                ran.mode().to_owned(),
                made.scans.to_string(),
                brief(sheets, test),
                reasons(sheets, ran, made).join("; "),
                error_line(ran, made).map(|line| line.to_string()).unwrap_or_default(),
                Provenance::tool(),
                sheets.provenance.files(),
                sheets.provenance.options.clone(),
                sheets.provenance.command_line(),
            ]
        })
    });
    table::write(std::iter::once(COLUMNS.map(str::to_owned).to_vec()).chain(rows))
}

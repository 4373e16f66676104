//! What became of tests as a table (CSV): one row for each.

use super::plan_csv::table;
use super::told::{brief, error_line, reasons};
use super::{Ran, Sheets};

/// The columns.
const COLUMNS: [&str; 8] = ["function", "test", "result", "start", "scans", "inputs", "reason", "line"];

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
            ]
        })
    });
    table(std::iter::once(COLUMNS.map(str::to_owned).to_vec()).chain(rows))
}

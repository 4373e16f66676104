//! Reports as one page for a browser.
use super::checked::Checked;
use super::stamp::Stamp;

/// Writes a report.
#[must_use]
pub fn write(_checked: &Checked<'_>, _stamp: Stamp) -> String {
    String::new()
}

//! Test protocol as one page, to be printed, filled in and signed: a cover, and for each function its data sheet, its
//! tests with checkboxes, what is left out, and the mutation score.
//!
//! The page has no script, and a content security policy forbids requests. All user texts are escaped in one place
//! (`markup`).

mod cover;
mod data_sheet;
mod faults;
mod left_out;
mod markup;
mod matrix;
mod paper;
mod test_sheet;

use std::collections::BTreeSet;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest as _, Sha256};

use super::Sheets;
use markup::escaped;
use petril_spec::sif::{Formula, Kind, SignalId, Specification};

/// Style sheet for screen and paper.
const STYLE: &str = include_str!("protocol.css");

/// Writes the protocol.
#[must_use]
pub fn write(sheets: &Sheets<'_>) -> String {
    let title = sheets.specification.title.as_deref().unwrap_or("Safety functions");
    let hash = STANDARD.encode(Sha256::digest(STYLE));
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'sha256-{hash}'; \
         base-uri 'none'; form-action 'none'\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<meta name=\"generator\" content=\"Petril\">\n\
         <title>{}: test protocol</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<main>\n",
        escaped(title)
    );
    page += &cover::cover(sheets, title);
    for (position, plan) in sheets.plans.iter().enumerate() {
        let name = escaped(&sheets.specification.functions[plan.function].name);
        page += &format!("<section class=\"function\" id=\"f{}\" aria-label=\"{name}\">\n", position + 1);
        page += &data_sheet::data_sheet(sheets, plan);
        page += &test_sheet::test_sheet(sheets, position, plan);
        page += &sheets.excluded.get(position).map(|excluded| left_out::left_out(sheets, excluded)).unwrap_or_default();
        page += &faults::coverage(sheets.specification, &plan.coverage);
        page += "</section>\n";
    }
    page += &sheets.run.as_ref().and_then(|ran| Some(faults::hunt(ran, ran.hunt?))).unwrap_or_default();
    page + "</main>\n</body>\n</html>\n"
}

/// Positions of the restrictions that concern a function's inputs.
fn restrictions(specification: &Specification, function: usize) -> impl Iterator<Item = usize> + '_ {
    let cone = petril_spec::sif::Cone::of_function(specification, function);
    let kept =
        move |at: &usize| cone.restrictions.iter().any(|own| std::ptr::eq(*own, &specification.restrictions[*at]));
    (0..specification.restrictions.len()).filter(kept)
}

/// Reset condition of a latched output.
fn latch(specification: &Specification, output: SignalId) -> Option<&Formula> {
    match &specification.signal(output).kind {
        Kind::Defined { latched, .. } => latched.as_ref(),
        Kind::Input { .. } => None,
    }
}

/// Delay of an output in milliseconds.
fn delay(specification: &Specification, output: SignalId) -> Option<u32> {
    match specification.signal(output).kind {
        Kind::Defined { delayed, .. } => delayed,
        Kind::Input { .. } => None,
    }
}

/// Removes duplicates, keeping the order.
fn once(ids: impl IntoIterator<Item = SignalId>) -> Vec<SignalId> {
    let mut seen = BTreeSet::new();
    ids.into_iter().filter(|id| seen.insert(*id)).collect()
}

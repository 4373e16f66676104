//! What is said of a specification is what the definitions say, all valuations tried one by one; and every kind of finding by
//! hand.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

mod by_hand;
mod random;
mod textbook;

use petril::sif::Specification;
use petril::sif::sanity::{Finding, check, never};
use petril::source::Source;

/// A specification that has no error.
fn read(text: &str) -> Specification {
    let (specification, diagnostics) = Specification::read(&[Source::new("test.sif", text)]);
    specification.unwrap_or_else(|| panic!("{diagnostics:?}\n{text}"))
}

/// What is said of a text, as messages without help.
fn said(text: &str) -> Vec<String> {
    let specification = read(text);
    check(&specification, &never()).iter().map(|finding| message(&specification, finding)).collect()
}

fn message(specification: &Specification, finding: &Finding) -> String {
    let diagnostic = finding.diagnostic(specification);
    format!("{} {}", diagnostic.code, diagnostic.message)
}

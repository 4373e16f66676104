//! Parsing of text to a syntax tree and printing of the tree, and reading of PLCopen projects in XML to the same tree.
//! The grammar is `grammar/il.pest`; only this module knows that pest reads it.

pub mod ast;
mod comments;
mod consume;
mod dialect;
mod expected;
mod nesting;
mod parse;
mod plcopen;
mod print;

pub use comments::{Comments, comments, requirements_in_comments};
pub use dialect::{standard_address, standard_operator};
pub use parse::parse;

/// Replaces the comments of a text by blanks, so that its length does not change.
#[must_use]
pub fn without_comments(text: &str) -> String {
    comments::blank(text, 0).0
}

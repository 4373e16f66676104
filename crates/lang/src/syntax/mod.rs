//! Text to syntax tree and back, and PLCopen's projects in XML to the same tree. The grammar is `grammar/il.pest`; nothing
//! outside this module knows pest reads it.

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

/// The text with blanks instead of comments, of the same length.
#[must_use]
pub fn without_comments(text: &str) -> String {
    comments::blank(text, 0).0
}

//! Text to syntax tree and back. The grammar is `grammar/il.pest`; nothing outside this module knows pest reads it.

pub mod ast;
mod comments;
mod consume;
mod expected;
mod nesting;
mod parse;
mod print;

pub use parse::parse;

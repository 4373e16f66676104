//! Linear time: formulas about one path, required of all paths (LTL).
//!
//! ```text
//! ¬f ──automaton──▶ modes that follow a path ──product──▶ a graph with a path exactly for each path with ¬f ──search──▶ a lasso
//! ```
//!
//! On a path that ends, X f is true in its last state, as AX f is, and the other operators speak of the states there are.

mod automaton;
mod formula;
mod search;
mod word;

pub use formula::Path;
pub use search::{Counterexample, Search, search};

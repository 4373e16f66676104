//! Linear temporal logic (LTL): formulas about one path, required of all paths.
//!
//! ```text
//! ¬f ──automaton──▶ modes that follow a path ──product──▶ a graph with a path exactly for each path with ¬f ──search──▶ a lasso
//! ```
//!
//! On a finite path, X f is true in its last state, as AX f is, and the other operators range over the states there
//! are.

mod automaton;
mod formula;
mod search;
mod word;

pub use formula::Path;
pub use search::{Counterexample, Search, search};

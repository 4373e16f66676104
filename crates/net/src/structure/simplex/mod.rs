//! Linear programs, solved in floating point by the dual simplex algorithm. Nothing is proved here: whoever uses an answer
//! rounds it and verifies it exactly.
//!
//! The programs are of one form: minimise c·x where Ax ≥ b, x ≥ 0 and c ≥ 0. Since c is not negative, x = 0 is the best there is
//! until a row asks for more, so the search begins there and mends one row after another. Either all rows are satisfied, or
//! one of them cannot be: then a sum of rows, with weights that are not negative, says that something is larger than itself.

mod basis;
mod choice;
mod order;
mod search;

pub use search::minimise;

/// Minimise `costs`·x where each of `rows` times x is at least its entry in `least`, and x ≥ 0.
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// The coefficients of each row that are not 0, ascending by variable.
    pub rows: Vec<Vec<(u32, f64)>>,
    /// What each row is at least.
    pub least: Vec<f64>,
    /// What each variable costs; not negative.
    pub costs: Vec<f64>,
}

/// How a search for the least costs ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Solved {
    /// These values of the variables cost least.
    Optimal(Vec<f64>),
    /// The rows contradict each other: so many times each, they sum up to coefficients that are at most 0, but to more than 0
    /// on the right.
    Infeasible(Vec<f64>),
    /// The steps did not suffice, or numbers lost their meaning.
    GaveUp,
}

/// What is as good as 0 in comparisons of values and costs.
const TOLERANCE: f64 = 1e-7;

/// A number between 0 and 1 that depends on nothing but a position: it keeps equal costs apart, so that no step is in vain.
pub fn scattered(position: usize) -> f64 {
    let mixed = (position as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    (mixed >> 40) as f64 / (1_u64 << 24) as f64
}

//! Linear programs, solved in floating point by the dual simplex algorithm. Nothing is proved here: callers round an
//! answer and verify it exactly.
//!
//! Programs have the form: minimise c·x subject to Ax ≥ b, x ≥ 0, with c ≥ 0. Since c is not negative, x = 0 is dual
//! feasible, so the search begins there and repairs one violated row after another. Either all rows become satisfied,
//! or one of them cannot be: then a sum of rows with non-negative weights is a contradiction (Farkas's lemma).

mod basis;
mod choice;
mod order;
mod search;

pub use search::minimise;

/// Linear program: minimise `costs`·x where each of `rows` times x is at least its entry in `least`, and x ≥ 0.
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// Non-zero coefficients of each row, ascending by variable.
    pub rows: Vec<Vec<(u32, f64)>>,
    /// Lower bound of each row.
    pub least: Vec<f64>,
    /// Cost of each variable; not negative.
    pub costs: Vec<f64>,
}

/// Result of solving a linear program.
#[derive(Clone, Debug, PartialEq)]
pub enum Solved {
    /// Values of the variables with the least cost.
    Optimal(Vec<f64>),
    /// The rows contradict each other: with these multipliers (a Farkas certificate) they sum up to coefficients of at
    /// most 0, but to a bound above 0.
    Infeasible(Vec<f64>),
    /// No answer: the steps were used up, or the numbers became too inexact.
    GaveUp,
}

/// Magnitude below which values and costs count as 0.
const TOLERANCE: f64 = 1e-7;

/// Pseudo-random number between 0 and 1 that depends only on a position: perturbs equal costs, to avoid degenerate
/// steps.
pub fn scattered(position: usize) -> f64 {
    let mixed = (position as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    (mixed >> 40) as f64 / (1_u64 << 24) as f64
}

//! Programs and nets together: the translation, plants, both views of a system, requirements about it, runs and their replay,
//! and verdicts.

pub mod requirement;
pub mod scans;
pub mod simulate;
pub mod translate;
pub mod verdict;
pub mod witness;

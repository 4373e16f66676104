//! Specifications of programs: safety functions, their sanity, tests made of them, and proofs.

pub mod sif;

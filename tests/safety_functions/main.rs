//! Safety functions: specifications, sanity, tests and proofs.

mod sif_criteria;
mod sif_engines;
mod sif_import;
mod sif_proof;
mod sif_proof_agrees;
mod sif_proof_limits;
mod sif_protocol;
mod sif_reading;
mod sif_roads;
mod sif_run;
mod sif_sanity;

//! The two views of a system, scans as gates, and what stands for many inputs.

mod exploration;
mod representatives;
mod scan_gates_agree;
mod views_agree;
mod wide_inputs;
mod wide_views_agree;

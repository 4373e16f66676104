#![doc = include_str!("../README.md")]

mod request;
pub mod requirement;
pub mod scans;
pub mod simulate;
pub mod translate;
pub mod verdict;
pub mod witness;

pub use request::Check;

#![doc = include_str!("../README.md")]

pub mod circuit;
pub mod flat;
pub mod interpret;
pub mod semantics;
pub mod syntax;

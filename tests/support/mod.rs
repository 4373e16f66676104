//! Random programs and nets, textbook versions, and oracles that the tests share.
#![allow(missing_docs, reason = "names of tests say what is meant")]
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that cannot be set up has failed")]

pub mod agreement;
pub mod assembler;
pub mod browser;
pub mod constructs;
pub mod contest;
pub mod document;
pub mod forms;
pub mod growing_net;
pub mod indifference;
pub mod naive_ctl;
pub mod naive_faults;
pub mod naive_ltl;
pub mod naive_nets;
pub mod naive_partial;
pub mod naive_structure;
pub mod process;
pub mod proofs;
pub mod random_flat;
pub mod random_formula;
pub mod random_graph;
pub mod random_model;
pub mod random_net;
pub mod random_program;
pub mod random_wide_blocks;
pub mod random_wide_body;
pub mod random_wide_program;
pub mod random_wide_value;
pub mod reference;
pub mod refined_net;
pub mod reports;
pub mod runs;
pub mod sif_system;
pub mod systems;
pub mod token_game;

use petril::flat::{FlatProgram, flatten};
use petril::logic::{Bound, View, bind, parse_formula};
use petril::semantics;
use petril::source::Source;
use petril::syntax;
use petril::translate::System;

/// The flat code of a program that must be right.
pub fn program(text: &str) -> FlatProgram {
    let source = Source::new("program", text);
    let (unit, errors) = syntax::parse(&source);
    let (program, more) = semantics::check(&unit, errors.is_empty());
    flatten(&program.unwrap_or_else(|| panic!("{text}\n{errors:#?}\n{more:#?}")))
}

/// A formula that must be right.
pub fn formula(text: &str, system: &System, view: View) -> Bound {
    let formula = parse_formula(&Source::new("formula", text)).unwrap_or_else(|e| panic!("{text}: {e:?}"));
    bind(&formula, system, view).unwrap_or_else(|e| panic!("{text}: {e:?}"))
}

//! PLC programs: their syntax, their typing, flat code, and the interpreter that says what a program means.
//!
//! ```text
//! text ──syntax──▶ AST ──semantics──▶ Program ──flat──▶ FlatProgram ──interpret──▶ values after each scan
//! ```

pub mod flat;
pub mod interpret;
pub mod semantics;
pub mod syntax;

//! PLC programs: syntax, static semantics, flat code, and the interpreter, which defines the meaning of a program.
//!
//! ```text
//! text ──syntax──▶ AST ──semantics──▶ Program ──flat──▶ FlatProgram ──interpret──▶ values after each scan
//! ```

pub mod circuit;
pub mod flat;
pub mod interpret;
pub mod semantics;
pub mod syntax;

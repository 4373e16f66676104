//! Single faults of a function's equations (mutants), by which a set of tests is measured.
//!
//! A fault changes one equation of the function, an output's or an auxiliary value's, in one place; it is detected
//! where an output of the function differs. A *literal* is an occurrence of a name or its negation; a *term* is any
//! other subformula. Names are those of the function's interface, its outputs and auxiliary values, as far as they are
//! computed from the inputs its outputs depend on; none is inserted where that would make a definition cyclic.
//!
//! | class | what is changed | in the literature |
//! |---|---|---|
//! | literal negation | a literal is negated | LNF |
//! | term negation | a term inside an equation is negated | TNF |
//! | expression negation | a whole equation is negated | ENF |
//! | operator | `&` and `\|` for each other; `\|` becomes `xor`; `xor` becomes `\|`, `&`, `<->`; `->` is turned round or becomes `<->`, `&`, `\|`; `<->` becomes `xor`, or `->` either way; `at most one of` becomes `exactly one of` or `\|`; `exactly one of` becomes `at most one of`, `\|` or `xor` | ORF |
//! | literal omission | a literal that is an operand of `&`, `\|` or `xor` is left out | LOF |
//! | term omission | the same with a term | TOF |
//! | literal insertion | a name or its negation becomes a further operand of an `&` or `\|` that has not got it yet | LIF |
//! | literal reference | another name or its negation stands in the place of a literal | LRF |
//! | stuck at FALSE, stuck at TRUE | a literal, a term or the whole is always this | SA0, SA1 |
//!
//! After Kuhn, "Fault classes and error detection capability of specification-based testing" (1999), and Lau and Yu,
//! "An extended fault class hierarchy for specification-based testing" (2005), who define these for disjunctive normal
//! forms: here they apply to formulas as they are written, and literals are inserted at each gate. Faults of a class
//! with the same resulting text count once. A fault is *equivalent* if no allowed valuation shows it; this is decided
//! by trying all, or by satisfiability.

mod changes;
mod class;
mod logic;
mod model;
mod nodes;
mod view;
mod words;

pub(super) use changes::{Fault, faults};
pub use class::Class;
pub(super) use model::Model;
pub(super) use nodes::What;
pub(super) use view::View;
pub(super) use words::{described, named};

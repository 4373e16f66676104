//! Single faults of a function's equations: what a set of tests is measured by.
//!
//! A fault changes one equation of the function, an output's or an auxiliary value's, in one place; it is seen where an output
//! of the function is then different. A *literal* is a name or its negation, as it stands; a *term* is any other part of a
//! formula. Names are those of the function's interface, its outputs and auxiliary values, as far as they are computed from the
//! inputs that its outputs depend on; none is put where the equation would then need itself.
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
//! After Kuhn, "Fault classes and error detection capability of specification-based testing" (1999), and Lau and Yu, "An extended
//! fault class hierarchy for specification-based testing" (2005), who define these for disjunctive normal forms: here they are
//! about formulas as they are written, and inserted literals about each gate. What would be written the same is one fault of its
//! class. A fault is *equivalent* if no valuation that can be shows it; this is found by trying all, or by satisfiability.

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

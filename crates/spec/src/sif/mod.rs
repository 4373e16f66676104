//! Safety instrumented functions (SIF): Boolean specifications, sanity checks of them, test generation, and proofs that
//! a program computes them. After seed paper 002 (a personnel protection system).
//!
//! ```
//! use petril_spec::sif::Specification;
//! use petril_base::source::Source;
//!
//! let text = "function F1 {
//!     interface { input door; input beam; output stop; }
//!     formal    { stop = beam & !door; }
//! }";
//! let (specification, _) = Specification::read(&[Source::new("door.sif", text)]);
//! let specification = specification.unwrap();
//! let stop = &specification.functions[0].outputs[0];
//! assert_eq!(specification.text(specification.definition(*stop).unwrap()), "beam & !door");
//! ```

mod binding;
mod cone;
mod criteria;
mod diagram;
mod faults;
mod formula;
mod parse;
mod plan;
pub mod proof;
mod requirements;
mod resolve;
mod run;
pub mod sanity;
mod scan;
mod solver;
mod specification;
mod written;

pub use binding::{Binder, Located};
pub use cone::{Cone, Encoded};
pub use criteria::{Limits, Study, about, coverage_of, excluded, plan};
pub use diagram::{Cube, Diagram, Diagrams};
pub use faults::Class;
pub use formula::{Formula, Operator, SignalId};
pub use plan::{ClassCoverage, Coverage, Criterion, Excluded, Missed, Plan, Test};
pub use requirements::requirements;
pub use run::{Decide, Deviation, Ending, Fate, Hunt, Mutant, PlanRun, Runner, Start, TestRun, hunt, mutants};
pub use solver::{Answer, Literal, Solver, Stop};
pub use specification::{Binding, Function, Kind, Place, Restriction, Scope, Signal, Specification, Zone};

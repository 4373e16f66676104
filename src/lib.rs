//! Petril proves PLC programs in IEC 61131-3 Instruction List right, or shows the exact scan in which they go wrong.
//!
//! A program is read and checked, flattened into numbered lines, and translated into a safe Petri net together with the
//! PLC's cycle and a model of the plant. All its reachable states are explored, and requirements in CTL are checked on them.
//!
//! ```
//! use petril::{diagnostic::any_error, flat, logic, semantics, source::Source, syntax, translate, verdict};
//!
//! let source = Source::new("starter.il", "
//!     PROGRAM starter
//!     VAR_INPUT  Start, Stop : BOOL; END_VAR
//!     VAR_OUTPUT Motor : BOOL; END_VAR
//!         LD   Start
//!         OR   Motor
//!         ANDN Stop
//!         ST   Motor
//!     END_PROGRAM");
//! let (unit, errors) = syntax::parse(&source);
//! let (program, warnings) = semantics::check(&unit, !any_error(&errors));
//! let program = flat::flatten(&program.expect("the program has no errors"));
//!
//! // No plant: Start and Stop may have any value in any scan.
//! let system = translate::System::new(program, translate::Plant::default());
//!
//! let check = |formula: &str| {
//!     let view = logic::View::Scan;
//!     let requirement = logic::parse_requirement("r1", &Source::new("formula", formula)).expect("a formula");
//!     let bound = logic::bind_requirement(&requirement, &system, view).expect("names the program has");
//!     let options = verdict::Options { view, ..Default::default() };
//!     verdict::check(&system, &[(requirement, bound)], &options, &mut |_| None)
//! };
//! assert_eq!(check("AG (Stop -> !Motor)").verdict(), verdict::Verdict::Holds);
//! assert_eq!(check("AG (Motor -> Start)").verdict(), verdict::Verdict::Violated);
//! ```
//!
//! `docs/architecture.md` says what the modules are for and in which order they stand; `docs/semantics.md` what exactly is
//! proved.

pub mod draw;
pub mod exchange;
pub mod explore;
pub mod logic;
pub mod net;
pub mod sif;
pub mod simulate;
pub mod structure;
pub mod translate;
pub mod verdict;
pub mod witness;

pub use petril_base::{diagnostic, printable, source};
pub use petril_lang::{flat, interpret, semantics, syntax};

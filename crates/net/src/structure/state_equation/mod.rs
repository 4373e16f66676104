//! The state equation (marking equation): every reachable marking m is m₀ + C·x, where C is the incidence matrix, x ≥ 0
//! counts firings, and m ≥ 0. If constraints on m contradict this, no reachable marking satisfies them; the converse
//! does not hold.
//!
//! A linear program finds the contradiction in floating point, which is then rounded to integers and verified exactly
//! ([`Certificate::verify`], [`Bound::verify`]). Only verified results are reported.
//!
//! ```
//! use petril_net::net::Builder;
//! use petril_net::structure::state_equation::{Constraint, Outcome, Problem, Relation};
//!
//! // Two machines take turns with one tool.
//! let mut builder = Builder::new("tool");
//! let [tool, a, b] = [("tool", 1), ("a", 0), ("b", 0)].map(|(name, tokens)| builder.place_with(name, tokens));
//! for (name, machine) in [("a", a), ("b", b)] {
//!     builder.weighted(format!("{name} takes"), &[(tool, 1)], &[(machine, 1)], &[]);
//!     builder.weighted(format!("{name} returns"), &[(machine, 1)], &[(tool, 1)], &[]);
//! }
//! let net = builder.build();
//!
//! let both = [Constraint { terms: vec![(a, 1), (b, 1)], relation: Relation::AtLeast, value: 2 }];
//! let problem = Problem::new(&net);
//! let Outcome::Infeasible(certificate) = problem.solve(&both, 1_000_000) else { panic!("only one has the tool") };
//! assert!(certificate.verify(&net, &both));
//! assert_eq!(problem.bound(&[a, b], 1_000_000).map(|bound| bound.most), Some(1));
//! ```

mod bound;
mod certificate;
mod constraint;
mod problem;

pub use bound::Bound;
pub use certificate::Certificate;
pub use constraint::{Constraint, Relation};
pub use problem::{Outcome, Problem};

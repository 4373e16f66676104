#![doc = include_str!("../README.md")]

mod along;
mod atoms;
mod bind;
mod bound;
mod dag;
mod domain;
mod evidence;
mod fairness;
mod formula;
mod label;
mod lasso;
mod literal;
mod ltl;
mod mentions;
mod parse;
mod past;
mod reach;
mod scope;
mod simplify;
mod sweep;
mod text;
mod timed;
mod vacuity;
mod view;

pub use along::along;
pub use atoms::Atom;
pub use bind::{Name, Nodes, ScanTime, Spot, Vocabulary, bind_in_net, bind_names};
pub use bound::{Bound, Term, Valuation};
pub use dag::{Dag, Node, NodeId};
pub use domain::DomainText;
pub use evidence::{Claim, Evidence, evidence};
pub use fairness::{Constraint, Constraints, Fairness, FairnessAssumption, FairnessText, Recurrence};
pub use formula::{Amount, Comparison, Duration, Expression, Formula, Past as PastOperator, Quantifier, Temporal};
pub use label::{Labels, label, label_from, label_until};
pub use lasso::{Lasso, near_lasso, shortest};
pub use literal::number;
pub use ltl::{Counterexample, Path, Search, search};
pub use mentions::Mentions;
pub use parse::{
    AssertionText, AssumptionText, Body, Origin, PlantText, Requirement, RequirementFile, Tag, parse_domain,
    parse_fairness, parse_formula, parse_requirement, parse_requirements, two_comparisons,
};
pub use past::{History, Past, remembered};
pub use reach::leading_to;
pub use text::Names;
pub use vacuity::{Premise, Step, premises};
pub use view::View;

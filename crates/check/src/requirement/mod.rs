//! Requirements about a program: what their names mean in its system, in one of its views.

mod assertion;
mod assumed;
mod assumption;
mod bind;
mod demand;
mod domain;
mod fairness;
mod fit;
mod names;
mod program;
mod recalled;
mod representatives;
mod valuations;

pub use assertion::{Assertion, bind_assertion};
pub use assumed::{Assumed, Moment};
pub use assumption::{Assumption, bind_assumption};
pub use bind::bind;
pub use demand::{Demand, bind_requirement};
pub use domain::bind_domain;
pub use fairness::{always_scanning, bind_fairness};
pub use fit::misfit;
pub use representatives::representatives;
pub use valuations::{Remembering, RememberingValuation, ScanValuation};

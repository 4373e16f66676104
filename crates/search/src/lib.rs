#![doc = include_str!("../README.md")]

mod budget;
mod components;
mod graph;
mod pairs;
mod product;
mod search;
mod space;
mod store;
mod table;
mod tarjan;
mod watched;

pub use budget::{Budget, Progress, Stop, is_available};
pub use components::{Components, components, components_until};
pub use graph::{Graph, Parts};
pub use pairs::{Follower, Pairs, followed};
pub use product::{Observer, observed};
pub use search::explore;
pub use space::{DeadEnd, StateSpace, Step, Successors};
pub use tarjan::{NONE, tarjan};
pub use watched::watched;

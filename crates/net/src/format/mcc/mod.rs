//! Property files of the Model Checking Contest: CTL formulas on a net, and bounds of places.
//!
//! ```
//! use petril_base::source::Source;
//! use petril_net::format::{mcc, tina};
//!
//! let text = "<property-set xmlns='http://mcc.lip6.fr/'><property><id>lamp-00</id><formula>
//!     <exists-path><finally><integer-le>
//!       <integer-constant>2</integer-constant>
//!       <tokens-count><place>on</place><place>off</place></tokens-count>
//!     </integer-le></finally></exists-path>
//! </formula></property></property-set>";
//! let (properties, errors) = mcc::read(&Source::new("lamp.xml", text));
//! assert!(errors.is_empty());
//!
//! let lamp = tina::read(&Source::new("lamp.net", "tr switch off -> on\npl off (1)\n")).expect("well written").net;
//! let mcc::Query::Holds(formula) = &properties[0].query else { panic!("it asks whether something holds") };
//! let bound = petril_logic::bind_in_net(formula, &lamp.nodes()).expect("places of the net");
//! assert_eq!(bound.text(&lamp), r#"EF (2 <= tokens("on") + tokens("off"))"#);
//! ```
//!
//! Places and transitions are identified by their ids in the net's PNML file, which are seldom their names: such
//! formulas are bound with [`Nodes::by_id`](petril_logic::Nodes::by_id).

mod formula;
mod read;
mod reader;

#[cfg(test)]
mod tests;

pub use read::read;

use petril_base::source::Span;
use petril_logic::Formula;

/// A property of a net.
#[derive(Clone, Debug)]
pub struct Property {
    /// Id, unique in its file.
    pub id: String,
    /// Position of the id.
    pub span: Span,
    /// Question asked.
    pub query: Query,
}

/// Question of a property.
#[derive(Clone, Debug)]
pub enum Query {
    /// Whether a formula holds at the initial marking.
    Holds(Formula),
    /// Maximum number of tokens on some places together.
    Bound(Vec<Place>),
}

/// Place of the net.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Id.
    pub id: String,
    /// Position of the id.
    pub span: Span,
}

//! Nodes of a net in formulas.

use petril_base::{PlaceId, TransitionId, VarId};
use petril_logic::{Names, Nodes};

use crate::net::Net;

impl Net {
    /// The nodes by their names, for formulas about the net.
    #[must_use]
    pub fn nodes(&self) -> Nodes<'_> {
        let places = self.place_ids().map(|place| (self.place(place).name, place));
        let transitions = self.transition_ids().map(|transition| (self.transition(transition).name, transition));
        Nodes::by_name(places, transitions)
    }
}

/// A net alone has no variables.
impl Names for Net {
    fn variable(&self, variable: VarId) -> String {
        format!("variable {}", variable.0)
    }

    fn literal(&self, _: VarId, _: i128) -> Option<String> {
        None
    }

    fn marked(&self, place: PlaceId) -> String {
        format!("marked(\"{}\")", self.place(place).name)
    }

    fn tokens(&self, place: PlaceId) -> String {
        format!("tokens(\"{}\")", self.place(place).name)
    }

    fn enabled(&self, transition: TransitionId) -> String {
        format!("enabled(\"{}\")", self.transition(transition).name)
    }
}

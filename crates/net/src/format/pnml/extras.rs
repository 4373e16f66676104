//! Extras of a document beside the structure of the net: positions of nodes, and notes in tool sections.

/// A position in the plane, in the units of PNML: x to the right, y down.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Point {
    /// To the right.
    pub x: i32,
    /// Down.
    pub y: i32,
}

/// One position for each node of a net, no two the same.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Positions {
    /// By position of the place.
    pub places: Vec<Point>,
    /// By position of the transition.
    pub transitions: Vec<Point>,
}

/// Notes on one node: pairs of a word and a value, in the order to be written.
pub type Note = Vec<(&'static str, String)>;

/// A note on every node of a net.
#[derive(Clone, Debug, Default)]
pub struct Notes {
    /// By position of the place.
    pub places: Vec<Note>,
    /// By position of the transition.
    pub transitions: Vec<Note>,
}

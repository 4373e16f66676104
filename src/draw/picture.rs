//! A picture of a net as data: the position of each shape. [`Picture::svg`] writes SVG; a page can move tokens on it.

use petril_net::net::{PlaceId, TransitionId};

/// A position on the sheet: x to the right, y down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct At {
    /// Distance to the right, in pixels.
    pub x: f64,
    /// Distance down, in pixels.
    pub y: f64,
}

/// Style of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaceStyle {
    /// White: the place itself.
    Own,
    /// Grey: a copy of a place that is drawn elsewhere too.
    Copy,
}

/// Head of an arc.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Head {
    /// An arrow.
    Arrow,
    /// A black circle: a read arc.
    Dot,
}

/// Alignment of a text to its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// The text begins at its position.
    Start,
    /// The text is centred at its position.
    Middle,
    /// The text ends at its position.
    End,
}

/// A drawn place: a circle of radius [`RADIUS`](super::RADIUS).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnPlace {
    /// The place.
    pub place: PlaceId,
    /// Centre.
    pub at: At,
    /// Style.
    pub style: PlaceStyle,
    /// Whether the place is marked initially.
    pub marked: bool,
}

/// A drawn transition: a box of height [`BOX_HEIGHT`](super::BOX_HEIGHT).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnTransition {
    /// The transition.
    pub transition: TransitionId,
    /// Centre.
    pub at: At,
    /// Width in pixels.
    pub width: f64,
}

/// A drawn arc: a straight line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnArc {
    /// The transition at one end of the arc.
    pub transition: TransitionId,
    /// Start point.
    pub from: At,
    /// End point.
    pub to: At,
    /// Head at the end point.
    pub head: Head,
}

/// A drawn text, vertically centred.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnText {
    /// The text.
    pub text: String,
    /// Position.
    pub at: At,
    /// Alignment to the position.
    pub anchor: Anchor,
    /// Whether the text is bold.
    pub strong: bool,
}

/// A picture of a net: its shapes with their positions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// Width in pixels.
    pub width: f64,
    /// Height in pixels.
    pub height: f64,
    /// Description of the picture for those who cannot see it.
    pub title: String,
    /// The places.
    pub places: Vec<DrawnPlace>,
    /// The transitions.
    pub transitions: Vec<DrawnTransition>,
    /// The arcs.
    pub arcs: Vec<DrawnArc>,
    /// The texts.
    pub texts: Vec<DrawnText>,
}

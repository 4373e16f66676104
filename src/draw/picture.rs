//! A picture of a net as data: where each shape stands. [`Picture::svg`] makes a file of it; a page can make tokens move on it.

use petril_net::net::{PlaceId, TransitionId};

/// A position on the sheet: x to the right, y down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct At {
    /// To the right.
    pub x: f64,
    /// Down.
    pub y: f64,
}

/// How a place is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaceStyle {
    /// White.
    Own,
    /// Grey: the same place is drawn elsewhere too.
    Copy,
}

/// How an arc ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Head {
    /// An arrow.
    Arrow,
    /// A black circle: a read arc.
    Dot,
}

/// On which side of its anchor a text stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Begins there.
    Start,
    /// Is centred there.
    Middle,
    /// Ends there.
    End,
}

/// A circle of radius [`RADIUS`](super::RADIUS).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnPlace {
    /// The place.
    pub place: PlaceId,
    /// Its centre.
    pub at: At,
    /// How it is drawn.
    pub style: PlaceStyle,
    /// Whether it is marked at the beginning.
    pub marked: bool,
}

/// A box as high as [`BOX_HEIGHT`](super::BOX_HEIGHT).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnTransition {
    /// The transition.
    pub transition: TransitionId,
    /// Its centre.
    pub at: At,
    /// How wide it is.
    pub width: f64,
}

/// A straight line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnArc {
    /// The transition it belongs to.
    pub transition: TransitionId,
    /// Where it begins.
    pub from: At,
    /// Where it ends.
    pub to: At,
    /// How it ends.
    pub head: Head,
}

/// A text, vertically centred.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnText {
    /// The text.
    pub text: String,
    /// Where it stands.
    pub at: At,
    /// Which side of it stands there.
    pub anchor: Anchor,
    /// Whether it is set off.
    pub strong: bool,
}

/// A picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// How wide it is.
    pub width: f64,
    /// How high it is.
    pub height: f64,
    /// What it shows, for those who cannot see it.
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

//! SVG: circles, boxes, arcs and texts on a white sheet.
//!
//! The sheet is a white rectangle of its own, so that the picture is the same on a light and on a dark page.

use std::fmt::Write as _;

use quick_xml::escape::escape;

use super::picture::{Anchor, At, DrawnArc, DrawnPlace, DrawnText, DrawnTransition, Head, Picture, PlaceStyle};
use petril_base::printable;
use petril_net::net::{PlaceId, TransitionId};

/// Radius of a place.
pub const RADIUS: f64 = 12.0;
/// Height of a transition.
pub const BOX_HEIGHT: f64 = 24.0;
/// Radius of a token.
const TOKEN: f64 = 4.5;
/// Font size.
const FONT: f64 = 11.0;
/// Width of a letter; in the widest of the usual monospaced fonts a letter is 0.61 of the font size wide.
const LETTER: f64 = 6.8;

/// Width of a text as written.
pub fn width(text: &str) -> f64 {
    let text = printable::line(text);
    // Most characters from U+1100 on take two columns.
    text.chars().map(|c| if c < '\u{1100}' { LETTER } else { 2.0 * LETTER }).sum()
}

impl Picture {
    /// Adds a place.
    pub(super) fn place(&mut self, at: At, style: PlaceStyle, place: PlaceId, marked: bool) {
        self.places.push(DrawnPlace { place, at, style, marked });
    }

    /// Adds a transition with its text in it.
    pub(super) fn transition(&mut self, transition: TransitionId, at: At, width: f64, text: &str) {
        self.transitions.push(DrawnTransition { transition, at, width });
        self.text(at, Anchor::Middle, text, false);
    }

    /// Adds a text, unless it is empty.
    pub(super) fn text(&mut self, at: At, anchor: Anchor, text: &str, strong: bool) {
        if !text.is_empty() {
            self.texts.push(DrawnText { text: text.to_owned(), at, anchor, strong });
        }
    }

    /// Returns the finished picture; `title` is for those who cannot see it.
    pub(super) fn finish(self, width: f64, height: f64, title: &str) -> Self {
        Self { width, height, title: title.to_owned(), ..self }
    }

    /// Returns the picture as an SVG file.
    #[must_use]
    pub fn svg(&self) -> String {
        let Self { width, height, .. } = *self;
        let title = printable::line(&self.title);
        let mut out = format!(
            r##"<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0}" height="{height:.0}" viewBox="0 0 {width:.0} {height:.0}" font-family="ui-monospace, 'DejaVu Sans Mono', Menlo, Consolas, monospace" font-size="{FONT}">
<title>{title}</title>
<defs>
<marker id="petril-arrow" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="8" markerHeight="8" markerUnits="userSpaceOnUse" orient="auto"><path d="M0 1L8 4L0 7Z" fill="#222"/></marker>
<marker id="petril-dot" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="7" markerHeight="7" markerUnits="userSpaceOnUse" orient="auto"><circle cx="4" cy="4" r="4" fill="#222"/></marker>
</defs>
<rect width="{width:.0}" height="{height:.0}" rx="8" fill="#fff"/>
"##,
            title = escape(&title),
        );
        let arcs = |head| self.arcs.iter().filter(move |arc| arc.head == head).map(path).collect::<String>();
        let circles = |style| {
            let places = self.places.iter().filter(move |place| place.style == style);
            places.map(|place| circle(place.at, RADIUS)).collect::<String>()
        };
        let tokens = self.places.iter().filter(|place| place.marked).map(|place| circle(place.at, TOKEN)).collect();
        let groups = [
            (r##"fill="none" stroke="#222" marker-end="url(#petril-arrow)""##, arcs(Head::Arrow)),
            (r##"fill="none" stroke="#222" marker-end="url(#petril-dot)""##, arcs(Head::Dot)),
            (r##"fill="#fff" stroke="#222" stroke-width="1.3""##, circles(PlaceStyle::Own)),
            (r##"fill="#ddd" stroke="#777" stroke-width="1.3""##, circles(PlaceStyle::Copy)),
            (r##"fill="#111""##, tokens),
            (r##"fill="#fff" stroke="#222" stroke-width="1.3""##, self.transitions.iter().map(rectangle).collect()),
            (r##"fill="#111""##, self.texts.iter().map(text).collect()),
        ];
        for (attributes, shapes) in groups {
            if !shapes.is_empty() {
                let _ = write!(out, "<g {attributes}>\n{shapes}</g>\n");
            }
        }
        out + "</svg>\n"
    }
}

fn circle(At { x, y }: At, radius: f64) -> String {
    format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\"/>\n")
}

fn path(DrawnArc { from, to, .. }: &DrawnArc) -> String {
    format!("<path d=\"M{:.1} {:.1}L{:.1} {:.1}\"/>\n", from.x, from.y, to.x, to.y)
}

fn rectangle(&DrawnTransition { at, width, .. }: &DrawnTransition) -> String {
    let (x, y) = (at.x - width / 2.0, at.y - BOX_HEIGHT / 2.0);
    format!("<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{BOX_HEIGHT}\" rx=\"1.5\"/>\n")
}

fn text(DrawnText { text, at: At { x, y }, anchor, strong }: &DrawnText) -> String {
    let anchor = match anchor {
        Anchor::Start => "",
        Anchor::Middle => r#" text-anchor="middle""#,
        Anchor::End => r#" text-anchor="end""#,
    };
    let weight = if *strong { r#" font-weight="bold""# } else { "" };
    let (text, y) = (printable::line(text), y + FONT * 0.35);
    format!("<text x=\"{x:.1}\" y=\"{y:.1}\"{anchor}{weight}>{}</text>\n", escape(&text))
}

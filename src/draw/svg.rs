//! SVG: circles, boxes, arcs and texts on a white sheet.
//!
//! The sheet is a white rectangle of its own, so that the picture is the same on a light and on a dark page.

use std::fmt::Write as _;

use quick_xml::escape::escape;

use super::escape::printable;

/// Radius of a place.
pub const RADIUS: f64 = 12.0;
/// Height of a transition.
pub const BOX_HEIGHT: f64 = 24.0;
/// Size of the letters.
const FONT: f64 = 11.0;
/// Width of a letter; the widest of the usual monospaced fonts has 0.61 of their size.
const LETTER: f64 = 6.8;

/// A position on the sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct At {
    pub x: f64,
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

/// A picture in the making, one piece of text for each kind of shape.
#[derive(Default)]
pub struct Sheet {
    arrows: String,
    dots: String,
    own: String,
    copies: String,
    tokens: String,
    boxes: String,
    texts: String,
}

/// The width of a text.
pub fn width(text: &str) -> f64 {
    // Scripts without a Latin look mostly take two columns.
    text.chars().map(|c| if c < '\u{1100}' { LETTER } else { 2.0 * LETTER }).sum()
}

impl Sheet {
    pub fn place(&mut self, At { x, y }: At, style: PlaceStyle, marked: bool) {
        let list = if style == PlaceStyle::Own { &mut self.own } else { &mut self.copies };
        let _ = writeln!(list, r#"<circle cx="{x:.1}" cy="{y:.1}" r="{RADIUS}"/>"#);
        if marked {
            let _ = writeln!(self.tokens, r#"<circle cx="{x:.1}" cy="{y:.1}" r="4.5"/>"#);
        }
    }

    /// A transition with its text in it.
    pub fn transition(&mut self, at: At, width: f64, text: &str) {
        let (x, y) = (at.x - width / 2.0, at.y - BOX_HEIGHT / 2.0);
        let _ =
            writeln!(self.boxes, r#"<rect x="{x:.1}" y="{y:.1}" width="{width:.1}" height="{BOX_HEIGHT}" rx="1.5"/>"#);
        self.text(at, Anchor::Middle, text, false);
    }

    pub fn arc(&mut self, from: At, to: At, head: Head) {
        let list = if head == Head::Arrow { &mut self.arrows } else { &mut self.dots };
        let _ = writeln!(list, r#"<path d="M{:.1} {:.1}L{:.1} {:.1}"/>"#, from.x, from.y, to.x, to.y);
    }

    /// A text, vertically centred.
    pub fn text(&mut self, At { x, y }: At, anchor: Anchor, text: &str, strong: bool) {
        if text.is_empty() {
            return;
        }
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => r#" text-anchor="middle""#,
            Anchor::End => r#" text-anchor="end""#,
        };
        let weight = if strong { r#" font-weight="bold""# } else { "" };
        let text = printable(text);
        let _ = writeln!(
            self.texts,
            r#"<text x="{x:.1}" y="{:.1}"{anchor}{weight}>{}</text>"#,
            y + FONT * 0.35,
            escape(&text)
        );
    }

    /// The finished picture; `title` is for those who cannot see it.
    pub fn finish(&self, width: f64, height: f64, title: &str) -> String {
        let title = printable(title);
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
        let groups = [
            (r##"fill="none" stroke="#222" marker-end="url(#petril-arrow)""##, &self.arrows),
            (r##"fill="none" stroke="#222" marker-end="url(#petril-dot)""##, &self.dots),
            (r##"fill="#fff" stroke="#222" stroke-width="1.3""##, &self.own),
            (r##"fill="#ddd" stroke="#777" stroke-width="1.3""##, &self.copies),
            (r##"fill="#111""##, &self.tokens),
            (r##"fill="#fff" stroke="#222" stroke-width="1.3""##, &self.boxes),
            (r##"fill="#111""##, &self.texts),
        ];
        for (attributes, shapes) in groups {
            if !shapes.is_empty() {
                let _ = write!(out, "<g {attributes}>\n{shapes}</g>\n");
            }
        }
        out + "</svg>\n"
    }
}

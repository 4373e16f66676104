//! The picture of the subnet of one instruction.

use super::block::Block;
use super::diagram;
use super::picture::{Anchor, At, Picture, PlaceStyle};
use super::svg::{BOX_HEIGHT, RADIUS, width};
use petril_check::translate::{PlaceRole, System, TransitionRole};
use petril_net::net::PlaceId;

/// Room around the picture.
const MARGIN: f64 = 16.0;

/// Draws the subnet of a line of flat code (from 0): the transitions that execute it and the places they touch. Control
/// enters on the left above and leaves below; the bits are on the right. An instruction of several steps is drawn step by
/// step.
///
/// # Panics
/// If the program does not have the line.
#[must_use]
pub fn subnet(system: &System, line: usize, title: Option<&str>) -> Picture {
    let transitions: Vec<_> = system.transitions_of(TransitionRole::Line(line)).collect();
    let own = system.place(PlaceRole::Line(line));
    if system.moves(own).len() < transitions.len() {
        return diagram::line(system, line, title.unwrap_or(system.net.place(own).name));
    }
    let arcs = transitions.iter().map(|&id| system.net.arcs(id));
    let mut targets: Vec<PlaceId> = arcs.flat_map(|arcs| arcs.produce).copied().collect();
    targets.retain(|place| matches!(system.places[place.index()], PlaceRole::Line(_)));
    // The next line last, below; a jump's target on the way there.
    targets.sort_by_key(|place| (system.places[place.index()] == PlaceRole::Line(line + 1), *place));
    targets.dedup();
    let left = [own].into_iter().chain(targets).collect();
    let block = Block::new(system, left, &transitions);

    let widths = block.widths();
    let mut sheet = Picture::default();
    let mut top = MARGIN + RADIUS.max(BOX_HEIGHT / 2.0);
    if let Some(title) = title {
        sheet.text(At { x: MARGIN, y: MARGIN + 4.0 }, Anchor::Start, title, true);
        top += 26.0;
    }
    block.draw(&mut sheet, At { x: MARGIN, y: top }, widths, |_| Some(PlaceStyle::Own));
    let total = widths.total().max(title.map_or(0.0, width)) + 2.0 * MARGIN;
    sheet.finish(total, top + block.height() + RADIUS + MARGIN, title.unwrap_or(system.net.place(own).name))
}

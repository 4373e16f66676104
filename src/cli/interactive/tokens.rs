//! Net pane at the control place: transitions from there, each with the tokens it needs, consumes and produces.

use petril::net::{PlaceId, TransitionId};
use petril::translate::PlaceRole;
use petril::witness::Replay;
use ratatui::layout::Rect;
use ratatui::style::{Color, Stylize};
use ratatui::text::{Line, Span};

use super::screen::Screen;

/// Title: number of tokens.
pub fn title(screen: &Screen<'_>) -> String {
    let tokens = screen.session.replay().marking().marked().count();
    format!("net · {tokens} tokens on {} places", screen.session.system().net.places().len())
}

/// Control place, marked places of the plant, and transitions, enabled ones first.
pub fn lines(screen: &Screen<'_>, area: Rect) -> Vec<Line<'static>> {
    let system = screen.session.system();
    let replay = screen.session.replay();
    let is_enabled = |&id: &TransitionId| system.net.is_enabled(replay.marking(), id);
    let is_idle = replay.control() == PlaceRole::Idle;
    let plant = system.plant_moves().iter().filter(|_| is_idle);
    let (enabled, others): (Vec<_>, Vec<_>) = replay.ways().iter().chain(plant).copied().partition(is_enabled);
    let next = screen.session.next_transition();
    let mut lines = vec![control(screen, &replay)];
    lines.extend(marked_plant(screen, &replay));
    for &id in enabled.iter().chain(&others).take(usize::from(area.height)) {
        lines.push(transition(screen, &replay, id, next == Some(id)));
    }
    lines
}

fn name(screen: &Screen<'_>, place: PlaceId) -> String {
    screen.session.system().net.place(place).name.to_owned()
}

fn control(screen: &Screen<'_>, replay: &Replay<'_>) -> Line<'static> {
    let system = screen.session.system();
    let control = replay.marking().marked().find(|place| system.places[place.index()].is_control());
    Line::from_iter(["control at ".dim(), control.map_or_else(String::new, |place| name(screen, place)).bold()])
}

/// Marked places of the plant, on one line.
fn marked_plant(screen: &Screen<'_>, replay: &Replay<'_>) -> Option<Line<'static>> {
    let system = screen.session.system();
    let is_plant = |place: &PlaceId| matches!(system.places[place.index()], PlaceRole::Plant(_));
    let marked: Vec<String> = replay.marking().marked().filter(is_plant).map(|place| name(screen, place)).collect();
    (!marked.is_empty()).then(|| Line::from_iter(["plant ".dim(), Span::raw(marked.join("  "))]))
}

/// `▶ t: ●a ○b → c`: places consumed, then read (in brackets), then produced; `●` is marked.
fn transition(screen: &Screen<'_>, replay: &Replay<'_>, id: TransitionId, is_next: bool) -> Line<'static> {
    let net = &screen.session.system().net;
    let arcs = net.arcs(id);
    let is_enabled = net.is_enabled(replay.marking(), id);
    let token = |&place: &PlaceId| {
        let marked = replay.marking().is_marked(place);
        let text = format!(" {}{}", if marked { '●' } else { '○' }, name(screen, place));
        if marked { text.fg(Color::Green) } else { text.fg(Color::Red) }
    };
    let title = format!("{} {}:", if is_next { '▶' } else { ' ' }, net.transition(id).name);
    let mut spans = vec![if is_enabled { title.bold() } else { title.dim() }];
    spans.extend(arcs.consume.iter().map(token));
    if !arcs.read.is_empty() {
        spans.push(" [".dim());
        spans.extend(arcs.read.iter().map(token));
        spans.push(" ]".dim());
    }
    spans.push(" →".dim());
    spans.extend(arcs.produce.iter().map(|&place| Span::raw(format!(" {}", name(screen, place)))));
    Line::from(spans)
}

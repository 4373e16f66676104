//! Tests of what the terminal shows, on a test backend. Snapshots are reviewed before they are accepted.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::exchange::tina;
use petril::flat::{Tolerated, flatten};
use petril::semantics;
use petril::simulate::{Plan, Session};
use petril::source::Source;
use petril::syntax;
use petril::translate::{Plant, System};
use petril::verdict::Note;
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::draw::draw;
use super::keys::{Flow, HELP};
use super::screen::{Mode, Screen};

const SWITCH: &str = include_str!("../../../examples/two-hand-switch.il");
const HANDS: &str = include_str!("../../../nets/two-hand-switch.net");
const TANK: &str = include_str!("../../../examples/tank.il");

fn read(name: &str, text: &str, plant: Option<&str>) -> (System, Source) {
    let source = Source::new(name, text);
    let (unit, errors) = syntax::parse(&source);
    let (program, _) = semantics::check(&unit, errors.is_empty());
    let program = flatten(&program.unwrap());
    let mut devices = Plant::default();
    if let Some(net) = plant {
        devices.add(&tina::read_safe(&Source::new("plant.net", net)).unwrap(), &program).unwrap();
    }
    (System::new(program, devices), source)
}

fn begin<'s>((system, source): &'s (System, Source)) -> Screen<'s> {
    Screen::new(Session::new(system, Tolerated::default(), Vec::new()), source, Vec::new(), 1)
}

/// Presses keys: one per character, or a name in angle brackets.
fn press(screen: &mut Screen<'_>, keys: &str) -> Flow {
    let mut flow = Flow::GoOn;
    let mut rest = keys;
    while let Some(c) = rest.chars().next() {
        let (code, length) = match rest.split_once('>').filter(|_| c == '<') {
            Some(("<enter", _)) => (KeyCode::Enter, 7),
            Some(("<esc", _)) => (KeyCode::Esc, 5),
            Some(("<down", _)) => (KeyCode::Down, 6),
            Some(("<back", _)) => (KeyCode::Backspace, 6),
            Some(("<home", _)) => (KeyCode::Home, 6),
            Some(("<end", _)) => (KeyCode::End, 5),
            _ => (KeyCode::Char(c), c.len_utf8()),
        };
        rest = &rest[length..];
        flow = screen.press(KeyEvent::new(code, KeyModifiers::NONE));
    }
    flow
}

fn seen(screen: &Screen<'_>, width: u16, height: u16) -> String {
    let mut terminal = Terminal::new(TestBackend::new(width, height)).unwrap();
    terminal.draw(|frame| draw(frame, screen)).unwrap();
    terminal.backend().to_string()
}

fn said(screen: &Screen<'_>) -> String {
    screen.message.as_ref().map_or_else(String::new, |(text, _)| text.clone())
}

#[test]
fn a_scan_line_by_line() {
    let system = read("two-hand-switch.il", SWITCH, None);
    let mut screen = begin(&system);
    press(&mut screen, "34s12llllll");
    assert_eq!(said(&screen), "");
    insta::assert_snapshot!("lines-80x24", seen(&screen, 80, 24));
    press(&mut screen, "n");
    insta::assert_snapshot!("tokens-80x24", seen(&screen, 80, 24));
    insta::assert_snapshot!("tokens-40x12", seen(&screen, 40, 12));
}

/// The guide shows the current screens and keys.
#[test]
fn the_guide_shows_what_is_seen() {
    let guide = include_str!("../../../docs/simulation.md");
    let system = read("two-hand-switch.il", SWITCH, None);
    let mut screen = begin(&system);
    let shown = |screen: &Screen<'_>| {
        let text = seen(screen, 80, 24);
        text.lines().map(|line| format!("{}\n", line.trim_matches('"').trim_end())).collect::<String>()
    };
    press(&mut screen, "34s13s24lllllllll");
    let lines = shown(&screen);
    assert!(guide.contains(&lines), "SCREEN\n{lines}");
    press(&mut screen, "n");
    let tokens = shown(&screen);
    let (_, tokens) = tokens.split_once("┌net").unwrap();
    let tokens: String = tokens.lines().take(6).map(|line| format!("{line}\n")).collect();
    assert!(guide.contains(&format!("┌net{tokens}")), "NET\n┌net{tokens}");
    for (key, text) in HELP {
        let row = format!("| `{}` | {text} |\n", key.replace("  ", "`, `"));
        assert!(guide.contains(&row), "{row}");
    }
}

#[test]
fn numbers_and_many_scans() {
    let system = read("tank.il", TANK, None);
    let mut screen = begin(&system);
    press(&mut screen, "170<enter>ss130<enter>sss2s190<enter>ss");
    insta::assert_snapshot!("numbers-120x40", seen(&screen, 120, 40));
    insta::assert_snapshot!("numbers-40x12", seen(&screen, 40, 12));
}

#[test]
fn the_plant_and_the_help() {
    let system = read("two-hand-switch.il", SWITCH, Some(HANDS));
    let mut screen = begin(&system);
    press(&mut screen, "p1");
    insta::assert_snapshot!("plant-80x24", seen(&screen, 80, 24));
    press(&mut screen, "<esc>ns");
    insta::assert_snapshot!("idle-80x24", seen(&screen, 80, 24));
    press(&mut screen, "?");
    insta::assert_snapshot!("help-80x24", seen(&screen, 80, 24));
}

#[test]
fn keys_do_what_the_help_says() {
    let system = read("two-hand-switch.il", SWITCH, None);
    let mut screen = begin(&system);
    let at = |screen: &Screen<'_>| (screen.session.scans().len(), screen.session.line());
    press(&mut screen, "ss");
    assert_eq!(at(&screen), (2, None));
    press(&mut screen, "lll");
    assert_eq!(at(&screen), (2, Some(2)));
    press(&mut screen, "L");
    assert_eq!(at(&screen), (2, Some(1)));
    press(&mut screen, "1");
    assert_eq!(said(&screen), "a scan is under way: inputs are read when one begins");
    press(&mut screen, "T");
    assert_eq!(at(&screen), (2, Some(0)));
    press(&mut screen, "SS");
    assert_eq!(at(&screen), (1, None));
    press(&mut screen, "<home>S");
    assert_eq!((at(&screen), said(&screen).as_str()), ((0, None), "there is nothing before power-on"));
    press(&mut screen, "<end>r");
    assert_eq!(at(&screen), (3, None));
    press(&mut screen, "/Output & !S1<enter>");
    assert_eq!(screen.mode, Mode::Steps);
    press(&mut screen, "/Outpu<back>ut<enter>");
    assert_eq!(
        (&screen.mode, said(&screen).as_str()),
        (&Mode::Steps, "`Output` would be true after none of 10000 scans")
    );
}

#[test]
fn wrong_answers_are_asked_again() {
    let system = read("tank.il", TANK, None);
    let mut screen = begin(&system);
    press(&mut screen, "1abc<enter>");
    assert_eq!(said(&screen), "`abc` is no value of `Level`: write a number from -32768 to 32767");
    assert!(matches!(&screen.mode, Mode::Value(_, text) if text == "abc"));
    press(&mut screen, "<back><back><back>-7<enter>s");
    assert_eq!((screen.session.scans().len(), screen.session.value(screen.variables[0])), (1, 0xFFF9));
    press(&mut screen, "/AG Alarm<enter>");
    assert!(said(&screen).starts_with("a condition is about what has been"), "{}", said(&screen));
    press(&mut screen, "<esc>c");
    assert!(said(&screen).starts_with("a condition is about what has been"), "{}", said(&screen));
    press(&mut screen, "<esc>%");
    assert_eq!(said(&screen), "`%` does nothing; ? says what the keys do");
    assert_eq!(press(&mut screen, "q"), Flow::End);
    assert_eq!(screen.press(KeyEvent::new(KeyCode::Char('c'), KeyModifiers::CONTROL)), Flow::End);
}

/// Notes of a recorded run are shown at their scans, as long as the run is unchanged.
#[test]
fn notes_of_a_report_are_told() {
    let system = read("tank.il", TANK, None);
    let note = |first, last, text: &str| Note { first, last, text: text.to_owned() };
    let notes = vec![note(0, 0, "`a` is true"), note(1, 2, "`b` is false")];
    let plans = vec![Plan::default(); 3];
    let mut screen = Screen::new(Session::new(&system.0, Tolerated::default(), plans), &system.1, notes, 1);
    assert_eq!(screen.note(), None);
    press(&mut screen, "s");
    assert_eq!(screen.note().as_deref(), Some("after scan 1: `a` is true"));
    assert!(seen(&screen, 80, 24).contains("after scan 1: `a` is true"));
    press(&mut screen, "ss");
    assert_eq!(screen.note().as_deref(), Some("after scans 2 to 3: `b` is false"));
    press(&mut screen, "S2");
    assert_eq!(screen.note().as_deref(), Some("after scans 2 to 3: `b` is false"));
    press(&mut screen, "s");
    assert_eq!(screen.note(), None);
}

/// No terminal is too small, and no key crashes the program.
#[test]
fn any_size_and_any_key() {
    let programs = [read("tank.il", TANK, None), read("two-hand-switch.il", SWITCH, Some(HANDS))];
    for system in &programs {
        let mut screen = begin(system);
        for keys in [
            "", "1", "2", "<enter>", "<esc>", "llll", "tttttt", "TT", "n", "?", "x", "p1", "p", "<down>", "<esc>",
            "sss", "r", "<home>",
        ] {
            press(&mut screen, keys);
            for (width, height) in [(1, 1), (2, 30), (3, 3), (10, 5), (40, 12), (63, 17), (64, 18), (200, 3), (200, 60)]
            {
                seen(&screen, width, height);
            }
        }
    }
}

//! Key bindings.

use petril::simulate::Session;
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::screen::{Mode, Screen};

/// Whether the session continues.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    GoOn,
    End,
}

/// Key bindings, as shown in the help.
pub const HELP: [(&str, &str); 16] = [
    ("s  PgDn", "a scan forward, or to the end of this one"),
    ("S  PgUp", "a scan back, or to the beginning of this one"),
    ("l  Right", "a line forward"),
    ("L  Left", "a line back"),
    ("t  T", "a transition forward, back"),
    ("r", "a scan by chance"),
    ("Home  End", "to power-on; to the end of what is planned"),
    ("1 … z", "changes the input of that key"),
    ("Up  Down", "choose a variable"),
    ("Space", "changes the chosen input"),
    ("p", "what the plant can do"),
    ("/", "run until a condition: `n > 3`, `at line 5`"),
    ("c  C", "run on to it; by chance where nothing is planned"),
    ("n", "the net: its tokens and transitions here"),
    ("?", "this help"),
    ("q", "the end"),
];

impl Screen<'_> {
    /// Handles a key.
    pub fn press(&mut self, key: KeyEvent) -> Flow {
        if key.modifiers.contains(KeyModifiers::CONTROL) {
            return if key.code == KeyCode::Char('c') { Flow::End } else { Flow::GoOn };
        }
        self.message = None;
        match self.mode.clone() {
            Mode::Steps => return self.step(key.code),
            Mode::Help => self.mode = Mode::Steps,
            Mode::Plant(chosen) => self.choose(key.code, chosen),
            Mode::Value(input, text) => {
                if let Some(text) = self.typed(key.code, text, |text| Mode::Value(input, text)) {
                    self.take_value(input, &text);
                }
            }
            Mode::Until(text) => {
                if let Some(text) = self.typed(key.code, text, Mode::Until) {
                    self.condition = text;
                    self.run(false);
                }
            }
        }
        Flow::GoOn
    }

    /// Handles a key in stepping mode.
    fn step(&mut self, key: KeyCode) -> Flow {
        match key {
            KeyCode::Char('q') => return Flow::End,
            KeyCode::Char('s') | KeyCode::PageDown => self.attempt(Session::step_scan),
            KeyCode::Char('S') | KeyCode::PageUp => self.attempt(Session::back_scan),
            KeyCode::Char('l') | KeyCode::Right => self.attempt(Session::step_line),
            KeyCode::Char('L') | KeyCode::Left => self.attempt(Session::back_line),
            KeyCode::Char('t') => self.attempt(Session::step_transition),
            KeyCode::Char('T') => self.attempt(Session::back_transition),
            KeyCode::Char('r') => self.random_scan(),
            KeyCode::Home => while self.session.back_scan().is_ok() {},
            KeyCode::End => self.attempt(|session| {
                while session.scans().len() < session.planned() {
                    session.step_scan()?;
                }
                Ok(())
            }),
            KeyCode::Up | KeyCode::Char('k') => self.chosen = self.chosen.saturating_sub(1),
            KeyCode::Down | KeyCode::Char('j') => {
                self.chosen = (self.chosen + 1).min(self.variables.len().saturating_sub(1));
            }
            KeyCode::Char(' ') | KeyCode::Enter => {
                if let Some(&input) = self.variables.get(self.chosen) {
                    self.change(input);
                }
            }
            KeyCode::Char('p') => self.open_plant(),
            KeyCode::Char('/') => self.mode = Mode::Until(String::new()),
            KeyCode::Char('c') => self.run(false),
            KeyCode::Char('C') => self.run(true),
            KeyCode::Char('n') => self.shows_tokens = !self.shows_tokens,
            KeyCode::Char('?') => self.mode = Mode::Help,
            KeyCode::Char(label) => match self.labelled(label) {
                Some(input) => {
                    self.chosen = self.variables.iter().position(|&id| id == input).unwrap_or(self.chosen);
                    self.change(input);
                }
                None => self.complain(format!("`{label}` does nothing; ? says what the keys do")),
            },
            _ => {}
        }
        Flow::GoOn
    }

    fn open_plant(&mut self) {
        if self.session.is_within() {
            self.complain("the plant stands while a scan is under way");
        } else if self.session.choices().is_empty() && self.session.plan().moves.is_empty() {
            self.complain("the plant can do nothing now");
        } else {
            self.mode = Mode::Plant(0);
        }
    }

    /// Handles a key in plant mode.
    fn choose(&mut self, key: KeyCode, chosen: usize) {
        let choices = self.session.choices();
        let act = |screen: &mut Self, position: usize| {
            if let Some(&choice) = choices.get(position) {
                screen.attempt(|session| session.act(choice));
            }
            screen.mode = Mode::Plant(0);
        };
        match key {
            KeyCode::Up | KeyCode::Char('k') => self.mode = Mode::Plant(chosen.saturating_sub(1)),
            KeyCode::Down | KeyCode::Char('j') => {
                self.mode = Mode::Plant((chosen + 1).min(choices.len().saturating_sub(1)));
            }
            KeyCode::Enter | KeyCode::Char(' ') => act(self, chosen),
            KeyCode::Char(digit @ '1'..='9') => act(self, digit as usize - '1' as usize),
            KeyCode::Backspace => {
                self.session.take_back();
                self.mode = Mode::Plant(0);
            }
            KeyCode::Char('s') => {
                self.mode = Mode::Steps;
                self.attempt(Session::step_scan);
            }
            _ => self.mode = Mode::Steps,
        }
    }

    /// Handles a key in text input; returns the text when it is complete.
    fn typed(&mut self, key: KeyCode, mut text: String, mode: impl FnOnce(String) -> Mode) -> Option<String> {
        match key {
            KeyCode::Enter => {
                self.mode = Mode::Steps;
                return Some(text);
            }
            KeyCode::Esc => {
                self.mode = Mode::Steps;
                return None;
            }
            KeyCode::Backspace => _ = text.pop(),
            KeyCode::Char(c) => text.push(c),
            _ => {}
        }
        self.mode = mode(text);
        None
    }
}

//! `petril simulate --interactive`: an interactive session in the terminal.
//!
//! A [`Screen`] handles keys and holds what is shown; only this file uses the terminal.

mod diagram;
mod draw;
mod keys;
mod overlay;
mod screen;
mod source_pane;
mod tokens;
mod variables;

#[cfg(test)]
mod tests;

use std::io::{self, IsTerminal};
use std::process::ExitCode;

use ratatui::crossterm::event::{self, Event, KeyEventKind};
use ratatui::crossterm::style;

use super::console::Console;
use super::{Failure, Outcome, reason};
use keys::Flow;
pub use screen::Screen;

/// Runs the session until its user quits.
pub fn run(mut screen: Screen<'_>, console: &Console) -> Outcome {
    if !io::stdin().is_terminal() || !io::stdout().is_terminal() {
        let message = "--interactive needs a terminal, for keys and for what it shows";
        return Err(Failure::Message(message.to_owned()));
    }
    style::force_color_output(console.output_in_colour());
    // A signal ends the program without unwinding, so the terminal is restored here. Without a handler, it ends as
    // usual.
    let _ = ctrlc::set_handler(|| {
        ratatui::restore();
        std::process::exit(130);
    });
    let outcome = show(&mut screen);
    ratatui::restore();
    outcome.map_err(|error| Failure::Message(format!("cannot use the terminal: {}", reason(&error))))?;
    Ok(ExitCode::SUCCESS)
}

/// Event loop: draws, and waits for a key. A panic restores the terminal before it is reported.
fn show(screen: &mut Screen<'_>) -> io::Result<()> {
    let mut terminal = ratatui::try_init()?;
    loop {
        terminal.draw(|frame| draw::draw(frame, screen))?;
        match event::read()? {
            Event::Key(key) if key.kind != KeyEventKind::Release && screen.press(key) == Flow::End => return Ok(()),
            _ => {}
        }
    }
}

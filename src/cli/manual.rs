//! `petril man`: manual pages, one for each verb.

use std::fs;

use clap::{Command, CommandFactory};
use clap_mangen::Man;

use super::args::{Args, Manual};
use super::console::Console;
use super::{Failure, Outcome, SUCCESS, output, reason, shown};

pub fn run(arguments: &Manual, console: &Console) -> Outcome {
    let mut command = Args::command();
    command.build();
    let Some(folder) = &arguments.output else {
        return console.print(&page(&command)?);
    };
    let cannot = |error| Failure::Message(format!("cannot make `{}`: {}", shown(folder), reason(&error)));
    fs::create_dir_all(folder).map_err(cannot)?;
    let mut left = vec![&command];
    while let Some(command) = left.pop() {
        let name = command.get_display_name().unwrap_or(command.get_name());
        output::write_text(&folder.join(format!("{name}.1")), &page(command)?)?;
        left.extend(command.get_subcommands().filter(|verb| verb.get_name() != "help"));
    }
    Ok(SUCCESS)
}

fn page(command: &Command) -> Result<String, Failure> {
    let mut page = Vec::new();
    let written = Man::new(command.clone()).render(&mut page);
    written.map_err(|error| Failure::Message(format!("cannot write the page: {}", reason(&error))))?;
    Ok(String::from_utf8_lossy(&page).into_owned())
}

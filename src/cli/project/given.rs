//! Options on the command line of a project run, which apply to every program.

use std::ffi::OsString;

use clap::parser::ValueSource;
use clap::{ArgMatches, Args, Command};
use petril::printable::line;

use super::file::Entry;
use crate::cli::Failure;
use crate::cli::args::Check;

/// Options of `petril check` that were typed, as typed.
pub fn given(matches: &ArgMatches) -> Vec<OsString> {
    let Some(("check", matches)) = matches.subcommand() else { return Vec::new() };
    let command = Check::augment_args(Command::new("check"));
    let typed = |id: &str| matches.value_source(id) == Some(ValueSource::CommandLine);
    let of_project = ["project", "only", "watch", "json"];
    let mut given = Vec::new();
    for argument in command.get_arguments() {
        let id = argument.get_id().as_str();
        let Some(option) = argument.get_long().filter(|_| typed(id) && !of_project.contains(&id)) else { continue };
        if !argument.get_action().takes_values() {
            given.push(format!("--{option}").into());
            continue;
        }
        for value in matches.get_raw(id).into_iter().flatten() {
            let mut word = OsString::from(format!("--{option}="));
            word.push(value);
            given.push(word);
        }
    }
    given
}

/// Arguments for checking a program of a project. Options on the command line come last and take precedence.
pub fn arguments(entry: &Entry, given: &[OsString]) -> Result<Check, Failure> {
    let command = Check::augment_args(Command::new("check")).args_override_self(true);
    let options = entry.options.iter().map(OsString::from).chain(given.iter().cloned());
    let words = std::iter::once(OsString::from("check")).chain(options);
    let words = words.chain([OsString::from("--"), entry.program.clone().into_os_string()]);
    let matches = command.try_get_matches_from(words);
    let check = matches.and_then(|matches| clap::FromArgMatches::from_arg_matches(&matches));
    check.map_err(|error| Failure::Message(format!("{}: {}", line(&entry.name), error.to_string().trim())))
}

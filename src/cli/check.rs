//! `petril check`: requirements on a program.

use std::process::ExitCode;

use petril::exchange::json;
use petril::logic;
use petril::verdict::{Options, Verdict, check};

use super::args::{Check, View};
use super::console::Console;
use super::progress::Watcher;
use super::{Failure, Outcome, input, report};

pub fn run(arguments: &Check, console: &Console) -> Outcome {
    let view = match arguments.view {
        View::Scan => logic::View::Scan,
        View::Transition => logic::View::Transition,
    };
    if arguments.fair && view == logic::View::Scan {
        let message = "--fair is for `--view transition`: in the scan view the PLC always scans again";
        return Err(Failure::Message(message.to_owned()));
    }
    let (system, source) = input::system(&arguments.program, arguments.pou.as_deref(), &arguments.plant, console)?;
    let requirements = input::requirements(&arguments.require, &arguments.requirement, &system, view, console)?;
    let watcher = Watcher::new(&arguments.limits)?;
    let options = Options { view, fair: arguments.fair, budget: arguments.limits.budget() };
    let result = check(&system, &requirements, options, &mut |progress| watcher.watch(progress));
    watcher.finish();
    if arguments.json {
        console.print_json(json::report(&system, &result, source.name()))?;
    } else {
        let text = report::Text { system: &system, source: &source, arguments, console };
        console.print(&text.report(&result))?;
    }
    Ok(match result.verdict() {
        Verdict::Holds => ExitCode::SUCCESS,
        Verdict::Violated => ExitCode::from(1),
        Verdict::Unknown => ExitCode::from(3),
    })
}

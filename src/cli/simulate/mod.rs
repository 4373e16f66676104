//! `petril simulate`: simulation of a program scan by scan.

mod scans;
mod show;
mod steering;

use std::ffi::OsStr;
use std::process::ExitCode;

use petril::logic::{Bound, View};
use petril::printable::line;
use petril::simulate::{Session, condition};
use petril::source::Source;
use petril::translate::System;
use petril::witness::line_by_line;

use super::args::{Format, Simulate};
use super::console::Console;
use super::input::Program;
use super::interactive::Screen;
use super::report::counted;
use super::{Failure, Outcome, SUCCESS, input, interactive, output, phase, shown};
use scans::{Run, scans};
use steering::Steering;

/// Default number of scans.
const DEFAULT_SCANS: usize = 10;

/// Default maximum number of scans with `--until`.
const UNTIL_SCANS: usize = 1000;

pub fn run(arguments: &Simulate, console: &Console) -> Outcome {
    if !arguments.plant.is_empty() && arguments.random.is_none() && arguments.replay.is_none() && !arguments.interactive
    {
        let message = "nothing says what the plant does: give --random, --replay or --interactive";
        return Err(Failure::Message(message.to_owned()));
    }
    let format = format(arguments)?;
    let (Program { flat, source }, plant) =
        input::parts(&arguments.program, &arguments.plant, &arguments.meaning.reading, console)?;
    let domains = steering::domains(&arguments.domain, &flat, &plant, console)?;
    // The net is needed only to step through it, and to list a scan line by line, which plays it on the net, too.
    let is_played = arguments.interactive || arguments.by_line.is_some();
    let compose = if is_played { System::with_domains } else { System::without_net };
    phase::begin("composing the net");
    let system = compose(flat, plant, domains);
    let until = arguments.until.as_ref().map(|text| until(text, &system, console)).transpose()?;
    let mut steering = Steering::of(arguments, &system, console)?;
    if arguments.interactive {
        return interact(arguments, &system, &source, steering, console);
    }
    let default = steering.len().unwrap_or(if until.is_some() { UNTIL_SCANS } else { DEFAULT_SCANS });
    let count = arguments.scans.unwrap_or(default);
    phase::begin("simulating");
    let made = scans(&system, arguments.meaning.tolerated(), &mut steering, count, until.as_ref())
        .map_err(|problem| refused(arguments, &problem))?;
    if let Some(recorded) = steering.recorded() {
        console.message(&format!("this is the run of `{}`\n", line(&recorded.requirement)));
    }
    print(arguments, format, &system, &source, &made, console)?;
    let notes = steering.recorded().into_iter().flat_map(|recorded| &recorded.notes);
    for note in notes.filter(|note| note.last < made.trace.scans.len()) {
        console.message(&format!("{}\n", line(&note.sentence(View::Scan))));
    }
    Ok(tell(arguments, &system, &source, &made, console))
}

/// Error of a run that differs from the report.
fn refused(arguments: &Simulate, problem: &str) -> Failure {
    let report = arguments.replay.as_ref().map(|path| format!("{}: ", shown(path)));
    Failure::Message(report.unwrap_or_default() + problem)
}

/// Opens the run in the terminal. Replayed runs are compared with their report first.
fn interact(
    arguments: &Simulate,
    system: &System,
    source: &Source,
    mut steering: Steering<'_>,
    console: &Console,
) -> Outcome {
    let tolerated = arguments.meaning.tolerated();
    let plans = steering.plans();
    if arguments.replay.is_some() {
        scans(system, tolerated, &mut steering, plans.len(), None).map_err(|problem| refused(arguments, &problem))?;
    }
    let notes = steering.recorded().map_or_else(Vec::new, |recorded| recorded.notes.clone());
    let seed = arguments.random.flatten().unwrap_or_else(steering::any_seed);
    let mut screen = Screen::new(Session::new(system, tolerated, plans), source, notes, seed);
    if let Some(recorded) = steering.recorded() {
        screen.say(format!("the run of `{}`: s goes through it, and ? says what other keys do", recorded.requirement));
    }
    interactive::run(screen, console)
}

/// Output format from the arguments or the file extension.
fn format(arguments: &Simulate) -> Result<Format, Failure> {
    let ending = arguments.output.as_ref().and_then(|path| path.extension()).and_then(OsStr::to_str);
    let format = arguments.format.unwrap_or(match ending {
        Some("csv") => Format::Csv,
        Some("vcd") => Format::Vcd,
        _ => Format::Table,
    });
    if arguments.by_line.is_some() && format != Format::Table {
        return Err(Failure::Message("--by-line is for tables; leave out the format, or --by-line".to_owned()));
    }
    Ok(format)
}

/// Condition of `--until`.
fn until(text: &str, system: &System, console: &Console) -> Result<Bound, Failure> {
    let source = Source::new("condition", text);
    condition(&source, system, View::Scan).map_err(|diagnostics| {
        console.diagnostics(&diagnostics, &source);
        Failure::Reported
    })
}

/// Prints the scans, and one of them line by line if requested.
fn print(
    arguments: &Simulate,
    format: Format,
    system: &System,
    source: &Source,
    run: &Run,
    console: &Console,
) -> Result<(), Failure> {
    let trace = &run.trace;
    let scans = counted(trace.scans.len(), "scan");
    let title = format!("{} from {}, {scans}", system.program.name, source.name());
    // Files have no width.
    let width = if arguments.output.is_some() { usize::MAX } else { console.output_width() };
    let mut text = show::text(system, trace, format, &title, width);
    if let Some(scan) = arguments.by_line {
        let Some(position) = scan.checked_sub(1).filter(|&position| position < trace.scans.len()) else {
            return Err(Failure::Message(format!("there is no scan {scan}: the scans are 1 to {}", trace.scans.len())));
        };
        let lines = line_by_line(system, trace, position, source);
        text += &format!("\nscan {scan} line by line:\n\n{lines}");
    }
    match &arguments.output {
        Some(path) => output::write_text(path, &text),
        None => console.print(&text).map(drop),
    }
}

/// Prints how the run ended, and returns the exit code.
fn tell(arguments: &Simulate, system: &System, source: &Source, run: &Run, console: &Console) -> ExitCode {
    let scans = run.trace.scans.len();
    match (&arguments.until, run.failure) {
        (Some(condition), _) if run.is_met => {
            console.message(&format!("after scan {scans}: `{}` is true\n", line(condition)));
        }
        (_, Some(failure)) => {
            console.error(&show::explain(failure, scans, &system.program, source));
            return ExitCode::from(1);
        }
        (Some(condition), None) => {
            console.message(&format!("`{}` is true after none of the {scans} scans\n", line(condition)));
            return ExitCode::from(1);
        }
        (None, None) => {}
    }
    SUCCESS
}

//! `petril sif import`: skeleton of a specification from an I/O list.

use std::ffi::OsStr;
use std::fs;

use petril::exchange::sif::{list, workbook};
use petril::printable::line;

use super::args::SifImport;
use crate::cli::console::Console;
use crate::cli::input::{MAX_TEXT, source};
use crate::cli::{Failure, Outcome, SUCCESS, output, reason, shown};

pub fn run(arguments: &SifImport, console: &Console) -> Outcome {
    let path = &arguments.list;
    let name = shown(path);
    let ending = path.extension().and_then(OsStr::to_str).map(str::to_lowercase);
    let rows = if ending.as_deref() == Some("xlsx") {
        let cannot = |error: std::io::Error| Failure::Message(format!("cannot read `{name}`: {}", reason(&error)));
        if fs::metadata(path).map_err(cannot)?.len() > MAX_TEXT {
            return Err(Failure::Message(format!("`{name}` has more than {} MiB", MAX_TEXT >> 20)));
        }
        output::has_read(path);
        workbook::rows(&fs::read(path).map_err(cannot)?)
    } else {
        list::rows_of_text(source(path, MAX_TEXT, console)?.text())
    };
    let rows = rows.map_err(|problem| Failure::Message(format!("{name}: {}", line(&problem))))?;
    let title = path.file_stem().and_then(OsStr::to_str).unwrap_or("list");
    let text = list::frame(title, &rows).map_err(|problems| {
        let lines: Vec<String> = problems.iter().take(20).map(|problem| format!("{name}: {}", line(problem))).collect();
        Failure::Message(lines.join("\n"))
    })?;
    match &arguments.output {
        None => console.print(&text),
        Some(file) => {
            output::write_text(file, &text)?;
            Ok(SUCCESS)
        }
    }
}

//! `petril init`: writes an example project.

use std::fs;
use std::path::{Path, PathBuf};

use super::args::Init;
use super::console::Console;
use super::{Failure, Outcome, output, reason, shown};

macro_rules! files {
    ($($name:literal)+) => {
        [$(($name, include_str!(concat!("example/", $name)))),+]
    };
}

/// Files of the example. Its program has a fault, and the README explains how to find it.
const FILES: [(&str, &str); 5] = files! { "gate.il" "gate.net" "gate.req" "petril.toml" "README.md" };

pub fn run(arguments: &Init, console: &Console) -> Outcome {
    let folder = &arguments.folder;
    let is_here = folder == Path::new(".");
    // Nothing is written if a file would be overwritten.
    let taken: Vec<String> = FILES
        .iter()
        .map(|(name, _)| if is_here { PathBuf::from(name) } else { folder.join(name) })
        .filter(|path| fs::symlink_metadata(path).is_ok())
        .map(|path| format!("`{}`", shown(&path)))
        .collect();
    if !taken.is_empty() {
        let (verb, them) = if taken.len() == 1 { ("exists", "it is") } else { ("exist", "they are") };
        let message = format!("{} {verb} already; {them} as before, and nothing was written", taken.join(", "));
        return Err(Failure::Message(message));
    }
    let cannot = |error| Failure::Message(format!("cannot make `{}`: {}", shown(folder), reason(&error)));
    fs::create_dir_all(folder).map_err(cannot)?;
    for (name, text) in FILES {
        output::write_text(&folder.join(name), text)?;
    }
    let place = if is_here { "here".to_owned() } else { format!("in `{}`", shown(folder)) };
    let names: Vec<&str> = FILES.iter().map(|&(name, _)| name).collect();
    let go = if is_here { String::new() } else { format!("cd {} && ", shown(folder)) };
    console.print(&format!(
        "A roll-up gate was written {place}: {}.\nIts program has a fault. To see it:\n\n    {go}petril check\n",
        names.join(", ")
    ))
}

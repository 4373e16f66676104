//! `docs/coverage.md`: what becomes of every public program in the folder that `PETRIL_DATA` names. Without it there is
//! nothing to test here.
//!
//! To write the document: `PETRIL_BLESS=1 PETRIL_DATA=… cargo test --test language coverage`.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use support::process::petril;
use tempfile::TempDir;

const HEAD: &str = "# Coverage

Every public Instruction List program that we hold, and what `petril flat` says of it: how many lines of flat code it
becomes, or why it is refused. `(n more)` counts further errors of the same file. The programs are not part of this
project; the table is written and checked by `cargo test --test language coverage`.
";

/// The files of a folder with one of these endings, and of its folders, in order.
fn files(folder: &Path, ending: &str, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            files(&path, ending, found);
        } else if path.extension().is_some_and(|own| own == ending) {
            found.push(path);
        }
    }
}

/// A row: the file, whether it is read, and how large it is or what is wrong with it.
fn row(root: &Path, file: &Path) -> (bool, String) {
    let name = file.strip_prefix(root).unwrap().display().to_string();
    let run = petril(file.parent().unwrap(), &["flat", file.file_name().unwrap().to_str().unwrap()]);
    let errors: Vec<&str> = run.stderr.lines().filter(|line| line.starts_with("error[")).collect();
    match run.code {
        0 => {
            let lines = run.stdout.lines().take_while(|line| !line.is_empty()).count();
            (true, format!("| `{name}` | {lines} lines | |"))
        }
        2 => {
            let first = errors.first().unwrap_or_else(|| panic!("{name}: {}", run.stderr));
            let (code, message) = first.trim_start_matches("error[").split_once("]: ").unwrap();
            let place = run.stderr.lines().skip_while(|line| line != first).nth(1).unwrap();
            let line = place.rsplit(':').nth(1).unwrap();
            let more = if errors.len() > 1 { format!(" ({} more)", errors.len() - 1) } else { String::new() };
            (false, format!("| `{name}` | {code} | line {line}: {}{more} |", message.replace('|', "\\|")))
        }
        code => panic!("{name} ends with {code}: {}", run.stderr),
    }
}

/// The projects of PLCopen, unpacked.
fn projects(data: &Path) -> TempDir {
    let folder = TempDir::new().unwrap();
    let archive = data.join("plcopen/projects.tar.xz");
    let tar = Command::new("tar").arg("xJf").arg(archive).arg("-C").arg(folder.path()).status();
    assert!(tar.is_ok_and(|status| status.success()), "the projects cannot be unpacked");
    folder
}

fn is_project(path: &Path) -> bool {
    String::from_utf8_lossy(&fs::read(path).unwrap()).contains("<project ")
}

fn table(title: &str, root: &Path, ending: &str) -> String {
    let mut found = Vec::new();
    files(root, ending, &mut found);
    found.retain(|path| ending != "xml" || is_project(path));
    let rows: Vec<(bool, String)> = found.iter().map(|file| row(root, file)).collect();
    let read = rows.iter().filter(|(read, _)| *read).count();
    let rows: Vec<String> = rows.into_iter().map(|(_, row)| row).collect();
    format!(
        "\n## {title}\n\n{read} of {} are read.\n\n| file | read | refused because |\n|---|---|---|\n{}\n",
        rows.len(),
        rows.join("\n")
    )
}

#[test]
fn the_document_says_what_becomes_of_every_program() {
    let Some(data) = env::var_os("PETRIL_DATA") else {
        eprintln!("PETRIL_DATA is not set: nothing is tested");
        return;
    };
    let data = Path::new(&data);
    let projects = projects(data);
    let now = HEAD.to_owned()
        + &table("Programs", &data.join("il"), "il")
        + &table("Programs with traces and facts", &data.join("golden"), "il")
        + &table("PLCopen projects", projects.path(), "xml");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/coverage.md");
    if env::var_os("PETRIL_BLESS").is_some() {
        fs::write(&path, &now).unwrap();
    }
    let then = fs::read_to_string(&path).unwrap();
    let stale = then.lines().zip(now.lines()).find(|(then, now)| then != now);
    assert!(then == now, "docs/coverage.md is stale, first here: {stale:?}");
}

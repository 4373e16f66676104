//! Files that are not there, cannot be read or cannot be written, and arguments that ask for nothing.

use std::fs;
use std::path::Path;
use std::process::Command;

use tempfile::TempDir;

use super::refused;
use support::process::{petril, run};

/// A folder with a program `p.il` and a plant `n.net`.
fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    let program = "PROGRAM p\nVAR_INPUT a : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\nLD a\nST q\nEND_PROGRAM\n";
    fs::write(folder.path().join("p.il"), program).unwrap();
    fs::write(folder.path().join("n.net"), "pl {a=1} (1)\n").unwrap();
    folder
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn files_that_cannot_be_read_are_refused() {
    let folder = folder();
    fs::create_dir(folder.path().join("x.net")).unwrap();
    let lines: [&[&str]; 8] = [
        &["flat", "nowhere.il"],
        &["flat", "."],
        &["flat", "p.il/p.il"],
        &["check", "p.il", "--plant", "nowhere.net"],
        &["check", "p.il", "--plant", "x.net"],
        &["check", "p.il", "--require", "nowhere.req"],
        &["simulate", "p.il", "--inputs", "nowhere.csv"],
        &["net", "info", "x.net"],
    ];
    for line in lines {
        let run = petril(folder.path(), line);
        refused(&run, "", &[&format!("error: cannot read `{}`: ", line.last().unwrap())]);
        assert!(!run.stderr.contains("os error"), "{}", run.stderr);
    }
}

#[cfg(unix)]
#[test]
fn files_of_others_are_refused() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let path = folder.path().join("p.il");
    fs::set_permissions(&path, fs::Permissions::from_mode(0o0)).unwrap();
    // Who may read everything cannot be refused.
    if fs::read(&path).is_err() {
        refused(&petril(folder.path(), &["flat", "p.il"]), "", &["cannot read `p.il`: permission denied"]);
    }
}

#[test]
fn files_that_cannot_be_written_are_not_begun() {
    let folder = folder();
    fs::create_dir(folder.path().join("out.net")).unwrap();
    let before = names(folder.path());
    for output in ["nowhere/x.net", "p.il/x.net", "out.net"] {
        let run = petril(folder.path(), &["translate", "p.il", "-o", output]);
        refused(&run, "", &[&format!("error: cannot write `{output}`: ")]);
        assert!(!run.stderr.contains("os error") && !run.stderr.contains("tmp"), "{}", run.stderr);
    }
    refused(&petril(folder.path(), &["translate", "p.il", "-o", "x.doc"]), "", &["`x.doc`", ".pnml"]);
    refused(&petril(folder.path(), &["translate", "bad.il", "-o", "x.net"]), "", &["bad.il"]);
    refused(&petril(folder.path(), &["draw", "p.il", "--line", "7", "-o", "x.svg"]), "", &["no line 7", "1 to 2"]);
    refused(&petril(folder.path(), &["draw", "--instruction", "CAL", "-o", "x.svg"]), "", &["no picture of `CAL`"]);
    assert_eq!(names(folder.path()), before);
}

#[cfg(unix)]
#[test]
fn links_are_followed_and_devices_written_to() {
    use std::os::unix::fs::symlink;
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("target.net"), "old").unwrap();
    symlink("target.net", at("link.net")).unwrap();
    symlink("/dev/full", at("full.net")).unwrap();
    assert_eq!(petril(folder.path(), &["translate", "p.il", "-o", "link.net"]).code, 0);
    assert!(fs::symlink_metadata(at("link.net")).unwrap().is_symlink());
    assert!(fs::read_to_string(at("target.net")).unwrap().starts_with("net p\n"));
    let run = petril(folder.path(), &["translate", "p.il", "-o", "full.net"]);
    refused(&run, "", &["cannot write `full.net`: no space left"]);
    assert!(fs::symlink_metadata(at("full.net")).unwrap().is_symlink());
}

/// A shell's view: results that cannot be printed are an error, a reader that has seen enough is none.
#[cfg(unix)]
#[test]
fn output_that_nobody_can_take() {
    let folder = folder();
    let shell = |line: &str| {
        let mut command = Command::new("sh");
        command.args(["-c", line]).env("PETRIL", env!("CARGO_BIN_EXE_petril")).current_dir(folder.path());
        run(command)
    };
    refused(&shell("$PETRIL flat p.il > /dev/full"), "", &["cannot print: no space left"]);
    let run = shell("{ $PETRIL simulate p.il --scans 100000; echo $? >&2; } | head -1");
    assert_eq!((run.stdout.as_str(), run.stderr.as_str()), ("  scan | a q\n", "0\n"));
}

#[test]
fn arguments_that_ask_for_nothing_are_refused() {
    let folder = folder();
    let lines: [(&[&str], &str); 12] = [
        (&[], "Usage: petril"),
        (&["frobnicate"], "unrecognized subcommand"),
        (&["check"], "there is no program to check"),
        (&["check", "p.il", "-r"], "a value is required"),
        (&["check", "p.il", "--view", "plan"], "possible values: scan, transition"),
        (&["check", "p.il", "--fair"], "--fair is for `--view transition`"),
        (&["check", "p.il", "--max-states", "few"], "invalid digit"),
        (&["check", "p.il", "--timeout=-1"], "--timeout"),
        (&["check", "p.il", "--timeout", "NaN"], "--timeout"),
        (&["translate", "p.il"], "--output"),
        (&["draw", "-o", "x.svg"], "<PROGRAM"),
        (&["net", "info", "p.il"], ".net or .pnml"),
    ];
    for (line, word) in lines {
        refused(&petril(folder.path(), line), "", &[word]);
    }
}

//! The pictures in `docs/pictures/` are those that the commands in `docs/semantics.md` make now.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::fs;
use std::path::Path;

use support::process::petril;
use tempfile::TempDir;

/// Compares `docs/pictures/NAME` with what the command line, `-o` and a file, makes.
fn compare(command: &[&str], name: &str) {
    let folder = TempDir::new().unwrap();
    let made = folder.path().join(name);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let line = [command, &["-o", made.to_str().unwrap()]].concat();
    let run = petril(root, &line);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let committed = fs::read_to_string(root.join("docs/pictures").join(name)).unwrap();
    assert!(
        fs::read_to_string(made).unwrap() == committed,
        "docs/pictures/{name} is not what `petril {command:?}` makes"
    );
}

#[test]
fn pictures_of_instructions_are_up_to_date() {
    let semantics = include_str!("../../docs/semantics.md");
    let (_, list) = semantics.split_once("for instruction in ").unwrap();
    let (list, _) = list.split_once(';').unwrap();
    let instructions: Vec<&str> = list.split_whitespace().collect();
    assert_eq!(instructions.len(), 19);
    for instruction in instructions {
        let name = format!("{}.svg", instruction.to_lowercase());
        compare(&["draw", "--instruction", instruction], &name);
        assert!(semantics.contains(&format!("![{instruction}](pictures/{name})")), "{instruction} is not shown");
    }
}

#[test]
fn picture_of_a_whole_system_is_up_to_date() {
    compare(&["translate", "docs/pictures/lamp.il", "--plant", "docs/pictures/lamp.net"], "lamp.svg");
}

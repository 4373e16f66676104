//! Which tests there are, how long they take, and which switches they come to; those that are known are not measured again.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::plant::LINTS;
use crate::process::{self, Ended, Test};

pub fn measure(copy: &Path, programs: &[String]) {
    let mut known: Vec<Test> = fs::read(copy.join("tests.json"))
        .map_or_else(|_| Vec::new(), |bytes| serde_json::from_slice(&bytes).expect("a list of tests"));
    for (program, path) in build(copy, programs) {
        let list = Command::new(&path).args(["--list", "--format", "terse"]).current_dir(copy).output();
        let list = String::from_utf8(list.expect("tests can be listed").stdout).expect("names are UTF-8");
        let names = list.lines().filter_map(|line| line.strip_suffix(": test"));
        for name in names.flat_map(|name| if name.starts_with("cli::") { sessions(copy, name) } else { vec![name.to_owned()] }) {
            if known.iter().any(|test| test.program == program && test.name == name) {
                continue;
            }
            let (program, path) = (program.clone(), path.clone());
            let mut test = Test { program, path, name, seconds: 0.0, reached: Vec::new() };
            let table = copy.join("reached");
            let _ = fs::remove_file(&table);
            let (ended, seconds) =
                process::run(copy, &test, ("PETRIL_FAULTS_REACHED", &table.to_string_lossy()), 1800.0);
            let bytes = fs::read(&table).unwrap_or_default();
            let numbers = bytes.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]));
            test.reached = numbers.collect::<BTreeSet<_>>().into_iter().collect();
            test.seconds = seconds;
            match ended {
                Ended::Passed if test.reached.is_empty() => {}
                Ended::Passed => known.push(test),
                _ => println!(
                    "left out, fails without a fault: {program} {name}",
                    program = test.program,
                    name = test.name
                ),
            }
        }
        let here = || known.iter().filter(|test| test.program == program);
        println!("{program}: {} tests, {:.1} s", here().count(), here().map(|test| test.seconds).sum::<f64>());
        fs::write(copy.join("tests.json"), serde_json::to_vec(&known).expect("tests are plain data")).expect("written");
    }
}

/// Sessions at the command line, each of which `trycmd` runs alone when its file is named.
fn sessions(copy: &Path, test: &str) -> Vec<String> {
    let folders =
        ["tests/cli", "docs", "."].iter().flat_map(|folder| fs::read_dir(copy.join(folder)).expect("a folder"));
    let names = folders.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    names.filter(|name| name.ends_with(".md")).map(|name| format!("{test} trycmd={name}")).collect()
}

/// Builds test programs: their names and files.
fn build(copy: &Path, programs: &[String]) -> Vec<(String, String)> {
    let mut command = Command::new("cargo");
    command.args(["test", "--offline", "--workspace", "--no-run", "--message-format=json", "--quiet"]);
    command.env("RUSTFLAGS", LINTS).current_dir(copy);
    for program in programs {
        match program.as_str() {
            "lib" => command.arg("--lib"),
            program => command.args(["--test", program]),
        };
    }
    let output = command.output().expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let messages = text.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    messages
        .filter_map(|message| {
            let is_lib =
                message["target"]["kind"].as_array().is_some_and(|kinds| kinds.iter().any(|kind| kind == "lib"));
            let name = if is_lib { "lib" } else { message["target"]["name"].as_str()? };
            let is_test = message["profile"]["test"] == true && programs.iter().any(|program| program == name);
            is_test.then(|| Some((name.to_owned(), message["executable"].as_str()?.to_owned())))?
        })
        .collect()
}

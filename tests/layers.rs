//! The order of modules within each crate, which cargo does not see, and what only one of them may do.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// The modules of crates with more than one layer. A module may use only modules to its left; files that are not named here may be
/// used by all. `docs/architecture.md` says why each stands where it does.
const ORDERS: [(&str, &[&str]); 4] = [
    ("crates/lang/src", &["syntax", "semantics", "flat", "circuit", "interpret"]),
    ("crates/net/src", &["net", "structure", "engine", "question", "format"]),
    ("crates/check/src", &["translate", "scans", "requirement", "witness", "simulate", "verdict"]),
    ("src", &["draw", "exchange", "cli"]),
];

/// Every source file of a folder, with its text.
fn files(folder: &Path) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                found.push(path);
            }
        }
    }
    found.sort();
    found.into_iter().map(|path| (path.clone(), fs::read_to_string(path).unwrap())).collect()
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every source file of the project with its path from the top.
fn sources() -> Vec<(String, String)> {
    let all = ["src", "crates"].into_iter().flat_map(|folder| files(&root().join(folder)));
    all.map(|(path, text)| (path.strip_prefix(root()).unwrap().to_str().unwrap().replace('\\', "/"), text)).collect()
}

/// The code of a file: without comments, and without its own tests, which may use what they like.
fn code(text: &str) -> String {
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
    code.lines().map(|line| line.split("//").next().unwrap()).collect::<Vec<_>>().join("\n")
}

/// The modules of a crate that a text names after `crate::` or `petril::`, singly or in a group.
fn used(text: &str) -> BTreeSet<String> {
    let mut used = BTreeSet::new();
    for prefix in ["crate::", "petril::"] {
        for (at, _) in text.match_indices(prefix) {
            let rest = &text[at + prefix.len()..];
            let names = match rest.strip_prefix('{') {
                Some(group) => group.split('}').next().unwrap().split(',').collect(),
                None => vec![rest],
            };
            let first_word = |name: &str| {
                let name = name.trim();
                name.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or_default().to_owned()
            };
            used.extend(names.into_iter().map(first_word));
        }
    }
    used
}

#[test]
fn modules_use_only_modules_to_their_left() {
    for (folder, order) in ORDERS {
        for (position, module) in order.iter().enumerate() {
            let found = files(&root().join(folder).join(module));
            assert!(!found.is_empty(), "{folder} has no module {module}");
            for (path, text) in found {
                if path.file_name().is_some_and(|name| name == "tests.rs" || name == "testing.rs") {
                    continue;
                }
                for other in used(&code(&text)) {
                    let to_the_right = order[position + 1..].contains(&other.as_str());
                    assert!(!to_the_right, "{}: {module} uses {other}, which stands to its right", path.display());
                }
            }
        }
    }
}

#[test]
fn the_orders_name_every_folder() {
    for (folder, order) in ORDERS {
        let entries = fs::read_dir(root().join(folder)).unwrap().map(|entry| entry.unwrap().path());
        let folders = entries.filter(|path| path.is_dir());
        let found: BTreeSet<String> =
            folders.map(|path| path.file_name().unwrap().to_str().unwrap().to_owned()).collect();
        assert_eq!(found, order.iter().map(|&name| name.to_owned()).collect(), "{folder}");
    }
}

/// Files, the terminal and the clock belong to the command line; the grammars' parser to the modules that read text; the machine to
/// what runs programs.
#[test]
fn some_things_are_done_in_one_place_only() {
    let only: [(&[&str], &[&str]); 4] = [
        (&["std::fs", "stdout", "stderr", "stdin", "println!", "print!("], &["src/cli/"]),
        (&["Instant", "SystemTime"], &["src/cli/"]),
        (
            &["pest_derive", "pest::Parser"],
            &["crates/lang/src/syntax/", "crates/logic/src/parse", "crates/net/src/format/", "crates/spec/src/sif/"],
        ),
        (
            &["interpret::Machine"],
            &[
                "crates/lang/src/interpret/",
                "crates/check/src/scans/",
                "crates/check/src/witness/",
                "crates/check/src/simulate/",
                "crates/spec/src/sif/",
            ],
        ),
    ];
    let sources = sources();
    for (words, places) in only {
        for place in places {
            assert!(sources.iter().any(|(path, _)| path.starts_with(place)), "{place} is not there");
        }
        for (path, text) in sources.iter().filter(|(path, _)| !places.iter().any(|place| path.starts_with(place))) {
            if let Some(word) = words.iter().find(|word| code(text).contains(**word)) {
                panic!("{path} has `{word}`, which only {places:?} may have");
            }
        }
    }
}

#[test]
fn the_test_sees_what_it_should() {
    let expected = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect::<BTreeSet<_>>();
    assert_eq!(used("use crate::net::{Arcs};\nuse crate::{flat, logic::View};"), expected(&["flat", "logic", "net"]));
    assert_eq!(used(&code("// crate::cli\nlet x = crate::explore::explore();")), expected(&["explore"]));
}

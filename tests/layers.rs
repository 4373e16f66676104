//! The order of the modules, and what only one of them may do.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// A module may use only modules to its left. `docs/architecture.md` says why each stands where it does.
const ORDER: [&str; 21] = [
    "printable",
    "source",
    "diagnostic",
    "xml",
    "rows",
    "syntax",
    "semantics",
    "flat",
    "interpret",
    "net",
    "translate",
    "structure",
    "explore",
    "logic",
    "witness",
    "simulate",
    "verdict",
    "sif",
    "draw",
    "exchange",
    "cli",
];

/// Every source file of a module, with its text.
fn files(module: &str) -> Vec<(PathBuf, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    let mut folders = vec![root.join(module)];
    let single = root.join(format!("{module}.rs"));
    if single.exists() {
        found.push(single);
    }
    while let Some(folder) = folders.pop() {
        let Ok(entries) = fs::read_dir(&folder) else { continue };
        for path in entries.map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                found.push(path);
            }
        }
    }
    assert!(!found.is_empty(), "module {module} has no file");
    found.sort();
    found.into_iter().map(|path| (path.clone(), fs::read_to_string(path).unwrap())).collect()
}

/// The code of a file: without comments, and without its own tests, which may use what they like.
fn code(text: &str) -> String {
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
    code.lines().map(|line| line.split("//").next().unwrap()).collect::<Vec<_>>().join("\n")
}

/// The modules a text names behind `crate::` or `petril::`, singly or in a group.
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
            used.extend(names.into_iter().map(first_word).filter(|name| ORDER.contains(&name.as_str())));
        }
    }
    used
}

#[test]
fn modules_use_only_modules_to_their_left() {
    for (position, module) in ORDER.iter().enumerate() {
        for (path, text) in files(module) {
            if path.file_name().is_some_and(|name| name == "tests.rs" || name == "testing.rs") {
                continue;
            }
            for other in used(&code(&text)) {
                let allowed = ORDER[..=position].contains(&other.as_str());
                assert!(allowed, "{}: {module} uses {other}, which stands to its right", path.display());
            }
        }
    }
}

#[test]
fn the_order_names_every_module() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = BTreeSet::new();
    for path in fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path()) {
        found.insert(path.file_stem().unwrap().to_str().unwrap().to_owned());
    }
    ["lib", "main"].iter().for_each(|name| _ = found.remove(*name));
    assert_eq!(found, ORDER.iter().map(|&name| name.to_owned()).collect());
}

/// Files, the terminal and the clock belong to the command line; the grammars' parser to the modules that read text.
#[test]
fn some_things_are_done_in_one_place_only() {
    let only: [(&[&str], &[&str]); 4] = [
        (&["std::fs", "stdout", "stderr", "stdin", "println!", "print!("], &["cli"]),
        (&["Instant", "SystemTime"], &["cli"]),
        (&["pest_derive", "pest::Parser"], &["syntax", "logic", "exchange", "sif"]),
        (&["interpret::Machine"], &["interpret", "explore", "witness", "simulate", "sif"]),
    ];
    for module in ORDER {
        for (path, text) in files(module) {
            for (words, modules) in only {
                let found = words.iter().find(|word| code(&text).contains(**word));
                if let Some(word) = found.filter(|_| !modules.contains(&module)) {
                    panic!("{} has `{word}`, which only {modules:?} may have", path.display());
                }
            }
        }
    }
}

#[test]
fn the_test_sees_what_it_should() {
    assert_eq!(
        used("use crate::net::{Arcs};\nuse crate::{flat, logic::View};"),
        ["flat", "logic", "net"].map(String::from).into()
    );
    assert_eq!(used(&code("// crate::cli\nlet x = crate::explore::explore();")), ["explore".to_owned()].into());
}

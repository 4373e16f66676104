//! Every problem Petril knows, shown in `tests/diagnostics/*.md`: the text that has it, and what is said about it.
//!
//! To write what is said now into the documents: `PETRIL_BLESS=1 cargo test --test diagnostics`. Then read them.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

mod support;

use std::fs;
use std::path::{Path, PathBuf};

use petril::diagnostic::Code;
use support::document::replay;

fn documents() -> Vec<(PathBuf, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/diagnostics");
    let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths.into_iter().map(|path| (path.clone(), fs::read_to_string(path).unwrap())).collect()
}

#[test]
fn documents_show_what_is_said() {
    let mut stale = Vec::new();
    for (path, text) in documents() {
        let now = replay(&text);
        if now == text {
            continue;
        }
        if std::env::var_os("PETRIL_BLESS").is_some() {
            fs::write(&path, now).unwrap();
            continue;
        }
        let first = text.lines().zip(now.lines()).position(|(then, now)| then != now);
        let line = first.unwrap_or(text.lines().count().min(now.lines().count()));
        let show = |text: &str| text.lines().skip(line).take(5).collect::<Vec<_>>().join("\n");
        stale.push(format!("{}:{}\n{}\nis now\n{}", path.display(), line + 1, show(&text), show(&now)));
    }
    assert!(stale.is_empty(), "{}", stale.join("\n\n"));
}

#[test]
fn every_code_is_shown() {
    let documents: String = documents().into_iter().map(|(_, text)| text).collect();
    let missing: Vec<&str> =
        Code::ALL.iter().map(|code| code.id()).filter(|id| !documents.contains(&format!("[{id}]:"))).collect();
    assert!(missing.is_empty(), "no document in tests/diagnostics shows {missing:?}");
}

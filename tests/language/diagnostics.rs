//! Every problem Petril knows, shown as the text that has it and what is said about it: one page for each code in
//! `docs/codes/`, which `petril explain` prints, and its variants in `tests/diagnostics/`.
//!
//! A page ends with the text mended; there the code is no longer reported.
//!
//! To write what is said now into the documents: `PETRIL_BLESS=1 cargo test --test language diagnostics`. Then read them.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use petril::diagnostic::Code;
use support::document::{replay, replay_again};
use support::process::petril;

fn documents() -> Vec<(PathBuf, String)> {
    let folders = ["docs/codes", "tests/diagnostics"].map(|folder| Path::new(env!("CARGO_MANIFEST_DIR")).join(folder));
    let entries = folders.iter().flat_map(|folder| fs::read_dir(folder).unwrap());
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
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

/// The codes that diagnostics in a text have.
fn codes(text: &str) -> BTreeSet<&str> {
    let heads = text.lines().filter(|line| line.starts_with("error[") || line.starts_with("warning["));
    heads.filter_map(|line| Some(line.split_once('[')?.1.split_once("]: ")?.0)).collect()
}

#[test]
fn every_page_shows_its_code_and_how_to_mend_it() {
    for &code in Code::ALL {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("docs/codes/{code}.md"));
        let page = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let title = format!("# {code}: {}\n", code.summary().trim_end_matches('.'));
        assert!(page.starts_with(&title), "{code} is not titled\n{title}");
        assert_eq!(codes(&page), BTreeSet::from([code.id()]), "{code}");
        let mended = replay_again(&page).1.unwrap();
        let said = mended.stderr + &mended.stdout;
        assert!(mended.code != 2 && !codes(&said).contains(code.id()), "the mended text of {code}\n{said}");
        assert_eq!(petril(Path::new("."), &["explain", &code.id().to_lowercase()]).stdout, page);
    }
}

#[test]
fn there_is_no_page_without_a_code() {
    let (pages, _): (Vec<_>, Vec<_>) =
        documents().into_iter().partition(|(path, _)| path.parent().unwrap().ends_with("codes"));
    assert_eq!(pages.len(), Code::ALL.len());
}

//! Documents: links lead to files and headings that exist, and the book (`docs/SUMMARY.md`) has every document once, by its title.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Component, Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Paths from the root of the Markdown files in `folder`.
fn documents(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(root().join(folder)).unwrap().map(|entry| entry.unwrap().file_name());
    let mut paths: Vec<PathBuf> = entries.map(|name| Path::new(folder).join(name)).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "md"));
    paths.sort();
    paths
}

/// The lines outside of fences, without code spans.
fn prose(text: &str) -> Vec<String> {
    let mut fence = None;
    let mut lines = Vec::new();
    for line in text.lines() {
        let ticks = line.trim_start().chars().take_while(|&character| character == '`').count();
        match fence {
            Some(length) if ticks >= length && line.trim().len() == ticks => fence = None,
            None if ticks >= 3 => fence = Some(ticks),
            None => lines.push(line.to_owned()),
            Some(_) => {}
        }
    }
    lines
}

/// `line` without its code spans: `` `f(x)` `` may look like a link.
fn without_code(line: &str) -> String {
    line.split('`').step_by(2).collect()
}

/// Targets of the links and pictures in a document.
fn links(text: &str) -> Vec<String> {
    // A code span may go over a line's end.
    let paragraphs = prose(text).join("\n");
    let paragraphs = paragraphs.split("\n\n").map(without_code).collect::<Vec<_>>();
    let targets = paragraphs.iter().flat_map(|paragraph| paragraph.split("](").skip(1));
    targets.map(|rest| rest.split([')', ' ']).next().unwrap().to_owned()).collect()
}

/// The ids that GitHub and mdBook give to headings: lower case, letters, digits, `-` and `_` kept, spaces as `-`.
fn anchors(text: &str) -> BTreeSet<String> {
    let mut times = BTreeMap::new();
    let prose = prose(text);
    let headings = prose.iter().filter(|line| line.starts_with('#'));
    headings
        .map(|line| {
            let kept = |&character: &char| character.is_alphanumeric() || matches!(character, ' ' | '-' | '_');
            let title: String = line.trim_start_matches('#').trim().to_lowercase().chars().filter(kept).collect();
            let anchor = title.replace(' ', "-");
            let before = times.entry(anchor.clone()).and_modify(|n| *n += 1).or_insert(0);
            if *before == 0 { anchor } else { format!("{anchor}-{before}") }
        })
        .collect()
}

/// `path` without `.` and `..`.
fn normal(path: &Path) -> PathBuf {
    path.components().fold(PathBuf::new(), |mut seen, component| {
        match component {
            Component::CurDir => {}
            Component::ParentDir => assert!(seen.pop(), "{} leaves the repository", path.display()),
            other => seen.push(other),
        }
        seen
    })
}

#[test]
fn anchors_are_those_that_a_renderer_makes() {
    let text = "# What is *known*, 2 times?\n```\n# no heading\n```\n## A `b_c` - d\n## A `b_c` - d\n";
    let expected = ["what-is-known-2-times", "a-b_c---d", "a-b_c---d-1"];
    assert_eq!(anchors(text), expected.into_iter().map(str::to_owned).collect());
}

#[test]
fn links_are_found_outside_of_code() {
    let text = "See [a](b.md#c), `x](force := 0)`\nand ![d](e.png).\n\n````md\n```\n[f](g)\n```\n````\n[h](i \"j\")\n";
    assert_eq!(links(text), ["b.md#c", "e.png", "i"]);
}

#[test]
fn links_lead_somewhere() {
    let mut wrong = Vec::new();
    let mut number = 0;
    for document in ["", "docs", "docs/codes"].into_iter().flat_map(documents) {
        let text = fs::read_to_string(root().join(&document)).unwrap();
        for link in links(&text) {
            if link.starts_with("https://") {
                continue;
            }
            number += 1;
            let (file, anchor) = link.split_once('#').map_or((link.as_str(), None), |(file, to)| (file, Some(to)));
            let folder = document.parent().unwrap();
            let target = if file.is_empty() { document.clone() } else { normal(&folder.join(file)) };
            let exists = root().join(&target).exists();
            let has = |anchor: &str| anchors(&fs::read_to_string(root().join(&target)).unwrap()).contains(anchor);
            if !exists || !anchor.is_none_or(has) {
                wrong.push(format!("{}: {link}", document.display()));
            }
        }
    }
    assert_eq!(wrong, Vec::<String>::new());
    assert!(number > 300, "only {number} links were found");
}

#[test]
fn the_book_has_every_document_once() {
    let summary = fs::read_to_string(root().join("docs/SUMMARY.md")).unwrap();
    let mut listed = links(&summary);
    let all = ["docs", "docs/codes"].into_iter().flat_map(documents);
    let all = all.map(|path| path.strip_prefix("docs").unwrap().to_str().unwrap().replace('\\', "/"));
    let all: Vec<String> = all.filter(|path| path != "SUMMARY.md").collect();
    for path in &all {
        assert_eq!(listed.iter().filter(|link| *link == path).count(), 1, "docs/SUMMARY.md has to list {path} once");
    }
    listed.retain(|link| !all.contains(link));
    assert_eq!(listed, Vec::<String>::new(), "docs/SUMMARY.md lists what is not a document");
    for path in all {
        let text = fs::read_to_string(root().join("docs").join(&path)).unwrap();
        let title = text.lines().next().unwrap().trim_start_matches("# ");
        let line = format!("[{title}]({path})");
        assert!(summary.contains(&line), "docs/SUMMARY.md has no `{line}`");
    }
}

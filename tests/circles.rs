//! Circles of files that use each other: those that are left, and no other. A module and its own children may use each other.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use petgraph::algo::kosaraju_scc;
use petgraph::graph::DiGraph;

/// The circles of each crate, by their modules. Whoever opens one takes it out of this list.
const LEFT: [(&str, &[&str]); 18] = [
    ("crates/check", &["scans::scan_lanes", "scans::scan_space"]),
    ("crates/check", &["translate::element", "translate::wire"]),
    ("crates/lang", &["flat::lower::layout", "flat::lower::places"]),
    (
        "crates/lang",
        &[
            "semantics::address",
            "semantics::effect",
            "semantics::flow",
            "semantics::inference",
            "semantics::program",
            "semantics::symbols",
            "semantics::typing",
            "semantics::uses",
        ],
    ),
    ("crates/lang", &["semantics::declare", "semantics::initial"]),
    ("crates/lang", &["syntax::consume", "syntax::expected", "syntax::parse"]),
    ("crates/lang", &["syntax::consume::declarations", "syntax::consume::instructions", "syntax::consume::operands"]),
    ("crates/logic", &["bound", "past"]),
    ("crates/net", &["engine::exploration", "engine::numbering"]),
    ("crates/net", &["engine::fold", "engine::machine"]),
    ("crates/net", &["engine::search", "engine::shard"]),
    ("crates/net", &["format::pnml::contents", "format::pnml::units"]),
    ("crates/net", &["format::tina::consume", "format::tina::expected", "format::tina::read"]),
    ("crates/net", &["question::explain", "question::live", "question::paths"]),
    ("crates/net", &["structure::reduce::draft", "structure::reduce::log"]),
    (".", &["cli::args", "cli::bounds", "cli::forms", "cli::guard", "cli::output", "cli::sif::args"]),
    (".", &["cli::net_info", "cli::net_structure"]),
    (
        ".",
        &[
            "cli::project::assumed",
            "cli::project::forms",
            "cli::project::run",
            "cli::project::summary",
            "cli::project::workers",
        ],
    ),
];

/// Source files of a crate by the paths of their modules, the tests' own left out.
fn modules(source: &Path) -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    let mut folders = vec![source.to_owned()];
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            let stem = path.file_stem().unwrap().to_str().unwrap().to_owned();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") && !["tests", "testing"].contains(&&*stem) {
                let inside: PathBuf = path.strip_prefix(source).unwrap().with_extension("");
                let names = inside.iter().map(|name| name.to_str().unwrap());
                let names = names.filter(|name| !["mod", "lib", "main"].contains(name)).collect::<Vec<_>>();
                found.insert(names.join("::"), fs::read_to_string(path).unwrap());
            }
        }
    }
    found
}

/// Paths that a text names after `crate` and `super`, the members of groups singly; comments and the file's own tests do not count.
fn used(text: &str) -> BTreeSet<String> {
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
    let code: String = code.lines().map(|line| line.split("//").next().unwrap()).collect::<Vec<_>>().join(" ");
    let mut used = BTreeSet::new();
    for word in ["crate::", "super::"] {
        for (at, _) in code.match_indices(word) {
            let is_begun = code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':');
            if !is_begun {
                collect(&code[at..], &mut used);
            }
        }
    }
    used
}

/// Adds the paths that a text begins with.
fn collect(text: &str, used: &mut BTreeSet<String>) {
    let is_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let length = text.find(|c: char| !is_path(c)).unwrap_or(text.len());
    let (path, rest) = text.split_at(length);
    let Some(group) = rest.strip_prefix('{').filter(|_| path.ends_with("::")) else {
        used.insert(path.trim_end_matches(':').to_owned());
        return;
    };
    let (mut depth, mut member) = (0_usize, String::new());
    for c in group.chars() {
        match c {
            '}' if depth == 0 => break,
            ',' if depth == 0 => collect(&format!("{path}{}", std::mem::take(&mut member).trim()), used),
            _ => {
                depth = depth + usize::from(c == '{') - usize::from(c == '}');
                member.push(c);
            }
        }
    }
    collect(&format!("{path}{}", member.trim()), used);
}

/// The module that a path means which is named in another one.
fn meant<'m>(path: &str, from: &str, modules: &'m BTreeMap<String, String>) -> Option<&'m str> {
    let mut at: Vec<&str> = if path.starts_with("crate") { Vec::new() } else { from.split("::").collect() };
    for name in path.split("::") {
        match name {
            "super" => _ = at.pop(),
            "crate" => {}
            name => at.push(name),
        }
    }
    let ancestors = (1..=at.len()).rev().map(|length| at[..length].join("::"));
    ancestors.into_iter().find_map(|name| modules.get_key_value(&name)).map(|(name, _)| name.as_str())
}

fn circles(source: &Path) -> Vec<Vec<String>> {
    let modules = modules(source);
    let mut graph: DiGraph<&str, ()> = DiGraph::new();
    let nodes: BTreeMap<&str, _> = modules.keys().map(|name| (name.as_str(), graph.add_node(name))).collect();
    let is_inside = |one: &str, other: &str| one.starts_with(&format!("{other}::"));
    for (name, text) in modules.iter().filter(|(name, _)| !name.is_empty()) {
        for other in used(text).iter().filter_map(|path| meant(path, name, &modules)) {
            if other != name && !is_inside(name, other) && !is_inside(other, name) {
                graph.add_edge(nodes[name.as_str()], nodes[other], ());
            }
        }
    }
    let circles = kosaraju_scc(&graph).into_iter().filter(|circle| circle.len() > 1);
    let mut circles: Vec<Vec<String>> =
        circles.map(|circle| circle.into_iter().map(|node| graph[node].to_owned()).collect()).collect();
    circles.iter_mut().for_each(|circle| circle.sort());
    circles.sort();
    circles
}

#[test]
fn no_circle_is_new() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut crates: Vec<String> = fs::read_dir(root.join("crates"))
        .unwrap()
        .map(|entry| format!("crates/{}", entry.unwrap().file_name().to_str().unwrap()))
        .collect();
    crates.push(".".to_owned());
    let mut found = BTreeSet::new();
    for name in crates {
        found.extend(circles(&root.join(&name).join("src")).into_iter().map(|circle| (name.clone(), circle)));
    }
    let left = LEFT.iter().map(|(name, circle)| {
        ((*name).to_owned(), circle.iter().map(|&module| module.to_owned()).collect::<Vec<String>>())
    });
    assert_eq!(found, left.collect::<BTreeSet<_>>());
}

#[test]
fn the_test_sees_what_it_should() {
    let paths = used(
        "use crate::net::{Arcs, arcs::{Table, Row}};\nuse super::check;\n// crate::cli\nlet x = petril_net::crate_of();",
    );
    let expected = ["crate::net::Arcs", "crate::net::arcs::Row", "crate::net::arcs::Table", "super::check"];
    assert_eq!(paths, expected.map(str::to_owned).into());
    let modules: BTreeMap<String, String> =
        ["net", "net::arcs", "verdict::check"].map(|name| (name.to_owned(), String::new())).into();
    assert_eq!(meant("crate::net::arcs::Table", "verdict::hazards", &modules), Some("net::arcs"));
    assert_eq!(meant("super::check", "verdict::hazards", &modules), Some("verdict::check"));
    assert_eq!(meant("super::other", "verdict::hazards", &modules), None);
}

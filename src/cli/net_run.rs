//! Runs of a net with their branches, as text and as JSON.

use std::fmt::Write as _;

use petril::logic::Bound;
use petril::net::Net;
use petril::printable::line;
use petril::verdict::{Branch, Run};
use serde_json::json;

/// Upper bound on the length of a formula in characters; longer ones are cut off.
const LONG: usize = 160;

/// Upper bound on branches listed at one marking; the others are counted.
const MANY: usize = 20;

/// Text with a line for each firing and for each claim on the way.
pub fn text(run: &Run, net: &Net) -> String {
    let mut out = String::new();
    write(run, net, 4, &mut out);
    out
}

fn write(run: &Run, net: &Net, indent: usize, out: &mut String) {
    if run.firings.is_empty() && run.branches.is_empty() {
        let _ = writeln!(out, "{:indent$}this marking shows it", "");
    }
    for at in 0..=run.firings.len() {
        let here: Vec<&Branch> = run.branches.iter().filter(|branch| branch.at == at).collect();
        for branch in here.iter().take(MANY) {
            let shown = if branch.run.is_some() { ", as shown by" } else { "" };
            let _ = writeln!(out, "{:indent$}here {}{shown}", "", formula(&branch.formula, net));
            branch.run.iter().for_each(|run| write(run, net, indent + 6, out));
        }
        if here.len() > MANY {
            let _ = writeln!(out, "{:indent$}and {} more like these", "", here.len() - MANY);
        }
        if let Some(&transition) = run.firings.get(at) {
            let again = if run.loop_start == Some(at) { "  (from here for ever)" } else { "" };
            let _ = writeln!(out, "{:indent$}{:>4}  {}{again}", "", at + 1, line(net.transition(transition).name));
        }
    }
}

fn formula(formula: &Bound, net: &Net) -> String {
    let text = line(&formula.text(net));
    match text.char_indices().nth(LONG) {
        Some((end, _)) => format!("{} ...", &text[..end]),
        None => text,
    }
}

/// The run as JSON.
pub fn json(run: &Run, net: &Net) -> serde_json::Value {
    let firings: Vec<&str> = run.firings.iter().map(|&id| net.transition(id).name).collect();
    let branch = |branch: &Branch| {
        json!({
            "after": branch.at,
            "formula": branch.formula.text(net),
            "trace": branch.run.as_ref().map(|run| json(run, net)),
        })
    };
    let branches: Vec<serde_json::Value> = run.branches.iter().map(branch).collect();
    json!({ "firings": firings, "loop_start": run.loop_start, "shortest": run.is_shortest, "branches": branches })
}

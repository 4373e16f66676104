//! `petril net explore`: counts the states of a net, in the output format of the Model Checking Contest.

use std::fmt::Write as _;
use std::process::ExitCode;

use petril::explore::Stop;
use petril::explore::engine::{Figures, Model, Options, explore};
use serde_json::json;

use super::args::{Limits, OnNet};
use super::console::Console;
use super::progress::Watcher;
use super::{Outcome, SUCCESS, input, phase};

pub fn run(arguments: &OnNet, console: &Console) -> Outcome {
    let watcher = Watcher::new(&arguments.limits)?;
    let (located, _) = input::net(&arguments.model, console)?;
    let net = if arguments.json { located.net } else { located.net.into_printable() };
    phase::begin_asking("exploring the net");
    let options = Options { budget: arguments.limits.budget(), threads: threads(&arguments.limits), keep: false };
    let exploration = explore(&Model::from(&net), &options, &mut |progress| watcher.watch(progress), None);
    watcher.finish();
    let (figures, stop) = (&exploration.figures, &exploration.stop);
    let deadlock = figures.deadlock.as_ref().map(|tokens| {
        let marked = net.places().zip(tokens).filter(|(_, tokens)| **tokens > 0);
        marked.map(|(place, &tokens)| (place.name, tokens)).collect::<Vec<_>>()
    });
    if arguments.json {
        let dead: Vec<&str> = figures.never_enabled.iter().map(|&t| nth(&net, t)).collect();
        let maxima: serde_json::Map<String, serde_json::Value> = net
            .places()
            .zip(&figures.place_maxima)
            .map(|(place, &most)| (place.name.to_owned(), most.into()))
            .collect();
        console.print_json(json!({
            "net": net.name(),
            "places": net.places().len(),
            "transitions": net.transitions().len(),
            "complete": *stop == Stop::Complete,
            "stop": stop.to_string(),
            "states": figures.states,
            "steps": figures.transitions,
            "depth": figures.depth,
            "max_tokens_in_place": figures.max_tokens_in_place,
            "max_tokens_in_marking": figures.max_tokens_in_marking,
            "max_tokens": maxima,
            "deadlocks": figures.deadlocks,
            "deadlock": deadlock.map(|marked| marked.into_iter().map(|(name, n)| (name.to_owned(), n.into()))
                .collect::<serde_json::Map<String, serde_json::Value>>()),
            "never_enabled": dead,
            "bits": figures.bits,
            "bytes": figures.bytes,
        }))?;
    } else {
        let marked = deadlock.map(|marked| {
            let named = |(name, n): (&str, u64)| if n == 1 { name.to_owned() } else { format!("{n} {name}") };
            marked.into_iter().map(named).collect::<Vec<_>>().join(", ")
        });
        console.print_report(&text(figures, stop, marked.as_deref()), &console.provenance(), false)?;
    }
    Ok(if *stop == Stop::Complete { SUCCESS } else { ExitCode::from(3) })
}

/// Number of threads: as requested, or one per processor.
pub fn threads(limits: &Limits) -> usize {
    limits.threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from))
}

fn nth(net: &petril::net::Net, position: usize) -> &str {
    net.transition(petril::net::TransitionId::at(position)).name
}

fn text(figures: &Figures, stop: &Stop, deadlock: Option<&str>) -> String {
    let mut out = String::new();
    let known = *stop == Stop::Complete;
    let mut line = |what: &str, number: u64| {
        let _ = if known {
            writeln!(out, "STATE_SPACE {what} {number} TECHNIQUES EXPLICIT")
        } else {
            // Without the last word, no tool takes the line for an answer.
            writeln!(out, "at least {number} {what}")
        };
    };
    line("STATES", figures.states);
    line("TRANSITIONS", figures.transitions);
    line("MAX_TOKEN_PER_MARKING", figures.max_tokens_in_marking);
    line("MAX_TOKEN_IN_PLACE", figures.max_tokens_in_place);
    if !known {
        let _ = writeln!(out, "not all states: {stop}");
    }
    let _ = match deadlock {
        Some(marked) => writeln!(out, "{} deadlocks, one of the nearest: {marked}", figures.deadlocks),
        None => writeln!(out, "no deadlock{}", if known { "" } else { " so far" }),
    };
    let _ = writeln!(
        out,
        "{} firings deep, {} bits a marking, {:.1} bytes a state",
        figures.depth,
        figures.bits,
        figures.bytes as f64 / figures.states.max(1) as f64
    );
    out
}

//! `petril net info`: size and structure of any net, and its behaviour if it can be explored.

use std::process::ExitCode;

use petril::explore::engine::{Behaviour, Exploration, Model, Options, explore};
use petril::explore::{Stop, watched};
use petril::net::{Net, PlaceId, TransitionId};
use petril::structure::Summary;
use serde_json::{Value, json};

use super::args::NetInfo;
use super::console::Console;
use super::net_explore::threads;
use super::net_structure::Structure;
use super::progress::Watcher;
use super::report::counted;
use super::{Outcome, SUCCESS, input, phase};

/// Upper bound on nodes named in a line.
pub const NAMED: usize = 20;

/// Default limit on states. `petril net explore` is for more.
const STATES: u64 = 2_000_000;

/// Upper bound on the nodes of a net that is explored without an explicit limit on states.
const NODES: usize = 20_000;

pub fn run(arguments: &NetInfo, console: &Console) -> Outcome {
    let on = &arguments.on;
    let watcher = Watcher::new(&on.limits)?;
    let (located, _) = input::net(&on.model, console)?;
    let net = if on.json { located.net } else { located.net.into_printable() };
    phase::begin("looking at the structure of the net");
    let summary = Summary::of(&net, arguments.effort);
    let structure = Structure { net: &net, summary: &summary, arguments };
    // Each marking of a large net takes long by itself.
    let nodes = net.places().len() + net.transitions().len();
    if nodes > NODES && on.limits.max_states.is_none() {
        watcher.finish();
        return unexplored(&structure, &net, arguments, console);
    }
    phase::begin_asking("exploring the net");
    let options = Options { budget: on.limits.budget_of(STATES), threads: threads(&on.limits), keep: true };
    let exploration = explore(&Model::from(&net), &options, &mut |progress| watcher.watch(progress), None);
    let second = second_token(&net, &exploration);
    let (live, _) = watched(&mut |progress| watcher.watch(progress), &exploration.progress(), |stopping| {
        exploration.behaviour(stopping)
    });
    let (behaviour, mut facts) = behaviour(&net, &exploration, live.flatten());
    watcher.finish();
    if on.json {
        let mut document =
            document(&net, &structure, exploration.stop == Stop::Complete, &exploration.stop.to_string());
        if second.is_some() || exploration.stop == Stop::Complete {
            document["safe"] = json!(second.is_none());
        }
        if let Some(second) = &second {
            document["second_token"] = json!({ "place": second.place, "firings": second.firings });
        }
        if let (Some(document), Some(facts)) = (document.as_object_mut(), facts.as_object_mut()) {
            document.append(facts);
        }
        console.print_json(document)?;
    } else {
        let safe = match &second {
            Some(second) if second.firings.is_empty() => {
                format!("no: `{}` has several tokens from the beginning", second.place)
            }
            Some(second) => format!("no: `{}` gets a second token by {}", second.place, second.firings.join(", ")),
            None if exploration.stop == Stop::Complete => "yes".to_owned(),
            None => "as far as seen".to_owned(),
        };
        let (markings, rest) = behaviour;
        let text = format!("{}{}{markings}safe         {safe}\n{rest}", size(&net), structure.text());
        console.print_report(&(text + &structure.lists()), &console.provenance(), false)?;
    }
    Ok(if exploration.stop == Stop::Complete { SUCCESS } else { ExitCode::from(3) })
}

/// Report on a net that is not explored.
fn unexplored(structure: &Structure<'_>, net: &Net, arguments: &NetInfo, console: &Console) -> Outcome {
    let reason = format!("the net has more than {NODES} nodes; --max-states N explores so many of its markings");
    if arguments.on.json {
        console.print_json(document(net, structure, false, &reason))?;
    } else {
        let text = format!("{}{}markings     not explored: {reason}\n", size(net), structure.text());
        console.print_report(&(text + &structure.lists()), &console.provenance(), false)?;
    }
    Ok(ExitCode::from(3))
}

fn document(net: &Net, structure: &Structure<'_>, is_complete: bool, stop: &str) -> Value {
    json!({
        "net": net.name(),
        "places": net.places().len(),
        "transitions": net.transitions().len(),
        "arcs": net.arc_count(),
        "read_arcs": net.read_arc_count(),
        "structure": structure.json(),
        "complete": is_complete,
        "stop": stop,
        "safe": Value::Null,
    })
}

fn size(net: &Net) -> String {
    format!(
        "net          {}\nplaces       {}\ntransitions  {}\narcs         {}{}\n",
        net.name(),
        net.places().len(),
        net.transitions().len(),
        net.arc_count(),
        match net.read_arc_count() {
            0 => String::new(),
            n => format!(", of these {} counted as two", counted(n, "read arc")),
        }
    )
}

/// Counterexample to safeness.
struct SecondToken<'n> {
    place: &'n str,
    /// Shortest firing sequence to that marking.
    firings: Vec<&'n str>,
}

/// A nearest marking with several tokens on a place.
fn second_token<'n>(net: &'n Net, exploration: &Exploration) -> Option<SecondToken<'n>> {
    let (place, marking) = exploration.second_token()?;
    let firings = exploration.firings(&marking)?;
    let firings = firings.into_iter().map(|id| net.transition(TransitionId::at(id)).name).collect();
    Some(SecondToken { place: net.place(PlaceId::at(place)).name, firings })
}

/// Behaviour of an explored net: the line about markings, the lines after the one about safeness, and the data for
/// JSON.
fn behaviour(net: &Net, exploration: &Exploration, live: Option<Behaviour>) -> ((String, String), Value) {
    let figures = &exploration.figures;
    if exploration.stop != Stop::Complete {
        let markings = format!("markings     at least {}: {}\n", figures.states, exploration.stop);
        return ((markings, String::new()), json!({}));
    }
    let mut facts = json!({
        "markings": figures.states,
        "firings": figures.transitions,
        "max_tokens_in_place": figures.max_tokens_in_place,
        "max_tokens_in_marking": figures.max_tokens_in_marking,
        "deadlocks": figures.deadlocks,
    });
    let between = counted(figures.transitions as usize, "firing");
    let markings = format!("markings     {} reachable, {between} between them\n", figures.states);
    let mut rest = format!(
        "tokens       {} in a place at most, {} in a marking\ndeadlocks    {}\n",
        figures.max_tokens_in_place, figures.max_tokens_in_marking, figures.deadlocks,
    );
    let dead: Vec<&str> = figures.never_enabled.iter().map(|&id| net.transition(TransitionId::at(id)).name).collect();
    rest += &format!("dead         {}{}\n", counted(dead.len(), "transition"), named(&dead));
    facts["dead_transitions"] = json!(dead);
    rest += &match live {
        Some(behaviour) => {
            facts["live_without_dead"] = json!(behaviour.live_without_dead);
            let without = if dead.is_empty() { "" } else { " without the dead transitions" };
            format!("live         {}{without}\n", if behaviour.live_without_dead { "yes" } else { "no" })
        }
        None => "live         not computed: a limit was reached\n".to_owned(),
    };
    ((markings, rest), facts)
}

/// Names of transitions, up to a limit.
pub fn named(names: &[&str]) -> String {
    match names.len() {
        0 => String::new(),
        n if n > NAMED => format!(": {}, … (--json names all)", names[..NAMED].join(", ")),
        _ => format!(": {}", names.join(", ")),
    }
}

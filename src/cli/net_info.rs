//! `petril net info`: size and behaviour of any safe net.

use std::process::ExitCode;

use petril::explore::{Markings, Stop, behaviour, unsafe_firing};
use petril::witness::firing_trace;
use serde_json::json;

use super::args::NetInfo;
use super::console::Console;
use super::progress::Watcher;
use super::report::counted;
use super::{Outcome, SUCCESS, input};

/// Dead transitions named in the text, at most.
const NAMED: usize = 20;

pub fn run(arguments: &NetInfo, console: &Console) -> Outcome {
    let (located, _) = input::safe_net(&arguments.model, console)?;
    let net = located.net;
    let watcher = Watcher::new(&arguments.limits)?;
    let markings = Markings::explored(&net, arguments.limits.budget(), &mut |progress| watcher.watch(progress));
    let graph = markings.graph();
    watcher.finish();
    let size = format!(
        "net          {}\nplaces       {}\ntransitions  {}\narcs         {}{}\n",
        net.name(),
        net.places().len(),
        net.transitions().len(),
        net.arc_count(),
        match net.read_arc_count() {
            0 => String::new(),
            n => format!(", of these {} counted as two", counted(n, "read arc")),
        }
    );
    let mut document = json!({
        "net": net.name(),
        "places": net.places().len(),
        "transitions": net.transitions().len(),
        "arcs": net.arc_count(),
        "read_arcs": net.read_arc_count(),
        "complete": graph.is_complete(),
        "stop": graph.stop().to_string(),
    });
    let (text, code) = if let Some((state, transition, place)) = unsafe_firing(&markings) {
        let states: Vec<&[u64]> = graph.path_to(state).iter().map(|&id| graph.state(id)).collect();
        let mut run = firing_trace(&markings, &states, None).firings;
        run.push(transition);
        let run: Vec<&str> = run.iter().map(|&id| net.transition(id).name).collect();
        let place = net.place(place).name;
        document["safe"] = json!(false);
        document["second_token"] = json!({ "place": place, "firings": run });
        let text = format!("safe         no: `{place}` gets a second token by {}\n", run.join(", "));
        (text + "markings     not counted, since the net is not safe\n", SUCCESS)
    } else if *graph.stop() == Stop::Complete {
        let behaviour = behaviour(&markings);
        let dead: Vec<&str> = behaviour.dead.iter().map(|&id| net.transition(id).name).collect();
        document["safe"] = json!(true);
        document["markings"] = json!(graph.len());
        document["firings"] = json!(graph.steps());
        document["deadlocks"] = json!(behaviour.deadlocks);
        document["dead_transitions"] = json!(dead);
        document["live_without_dead"] = json!(behaviour.live_without_dead);
        let yes = |fact: bool| if fact { "yes" } else { "no" };
        let text = format!(
            "markings     {} reachable, {} between them\nsafe         yes\ndeadlocks    {}\n\
             dead         {}{}\nlive         {}{}\n",
            graph.len(),
            counted(graph.steps() as usize, "firing"),
            behaviour.deadlocks,
            counted(dead.len(), "transition"),
            named(&dead),
            yes(behaviour.live_without_dead),
            if dead.is_empty() { "" } else { " without the dead transitions" },
        );
        (text, SUCCESS)
    } else {
        document["safe"] = serde_json::Value::Null;
        let text = format!("markings     at least {}: {}\nsafe         as far as seen\n", graph.len(), graph.stop());
        (text, ExitCode::from(3))
    };
    if arguments.json {
        console.print_json(document)?
    } else {
        console.print(&(size + &text))?
    };
    Ok(code)
}

/// The names of transitions, the first of them.
fn named(names: &[&str]) -> String {
    match names.len() {
        0 => String::new(),
        n if n > NAMED => format!(": {}, … (--json names all)", names[..NAMED].join(", ")),
        _ => format!(": {}", names.join(", ")),
    }
}

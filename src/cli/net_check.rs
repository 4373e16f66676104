//! `petril net check`: answers questions about a net, in the output format of the Model Checking Contest.

use std::fmt::Write as _;
use std::process::ExitCode;

use petril::diagnostic::Diagnostic;
use petril::exchange::mcc::{self, Query};
use petril::exchange::tapaal;
use petril::explore::engine::Options;
use petril::logic::{Nodes, View, bind_in_net, parse_formula};
use petril::net::{Located, PlaceId, TransitionId};
use petril::printable;
use petril::source::Source;
use petril::verdict::{Means, Question, Reply, Run, judge_aloud};
use serde_json::json;

use super::args::{NetCheck, TraceForm};
use super::console::Console;
use super::net_explore::threads;
use super::progress::Watcher;
use super::{Failure, Outcome, SUCCESS, input, net_run, phase};

pub fn run(arguments: &NetCheck, console: &Console) -> Outcome {
    let watcher = Watcher::new(&arguments.on.limits)?;
    let (located, _) = input::net(&arguments.on.model, console)?;
    let (names, questions) = questions(arguments, &located, console)?;
    let net = &located.net;
    phase::begin_asking("answering questions about the net");
    let options = Options { budget: arguments.on.limits.budget(), threads: threads(&arguments.on.limits), keep: true };
    let mut printed = Ok(SUCCESS);
    // Answers are printed as they become known, so that they remain when the work is ended from outside.
    let mut tell = |number: usize, reply: &Reply, means: &[Means]| {
        if !arguments.on.json && printed.is_ok() {
            let (name, is_id) = &names[number];
            let answer = Answer { name, is_id: *is_id, reply, means, located: &located };
            printed = watcher.suspend(|| console.print(&answer.text(arguments.trace)));
        }
    };
    let report = judge_aloud(net, &questions, &options, &mut |progress| watcher.watch(progress), &mut tell);
    watcher.finish();
    printed?;
    if !arguments.on.json {
        console.print_report("", &console.provenance(), false)?;
    } else {
        let found = report.replies.iter().zip(&report.means);
        let answer = |((name, is_id), (reply, means)): (&(String, bool), (&Reply, &Vec<Means>))| {
            Answer { name, is_id: *is_id, reply, means, located: &located }.json()
        };
        console.print_json(json!({
            "net": net.name(),
            "states": report.figures.states,
            "stop": report.stop.to_string(),
            "formulas": names.iter().zip(found).map(answer).collect::<Vec<_>>(),
        }))?;
    }
    let any = |test: fn(&Reply) -> bool| report.replies.iter().any(test);
    Ok(match () {
        () if any(|reply| matches!(reply, Reply::Violated(_))) => ExitCode::from(1),
        () if any(|reply| matches!(reply, Reply::Unknown(_))) => ExitCode::from(3),
        () => SUCCESS,
    })
}

/// Name of a question, and whether it is the id of a property.
type Called = (String, bool);

/// Reads the questions with their names. All errors are printed.
fn questions(
    arguments: &NetCheck,
    located: &Located,
    console: &Console,
) -> Result<(Vec<Called>, Vec<Question>), Failure> {
    let (mut names, mut questions) = (Vec::new(), Vec::new());
    let mut failed = false;
    let mut refuse = |diagnostics: &[Diagnostic], source: &Source| {
        console.diagnostics(diagnostics, source);
        failed |= !diagnostics.is_empty();
    };
    let by_id = ids(located);
    for path in &arguments.properties {
        let source = input::source(path, input::MAX_TEXT, console)?;
        let (properties, mut errors) = mcc::read(&source);
        for property in properties {
            let question = match &property.query {
                Query::Holds(formula) => bind_in_net(formula, &by_id).map(|bound| Question::Holds(bound.simplified())),
                Query::Bound(places) => {
                    by_id.places(places.iter().map(|place| (place.id.as_str(), place.span))).map(Question::Most)
                }
            };
            match question {
                Ok(question) => {
                    names.push((property.id, true));
                    questions.push(question);
                }
                Err(more) => errors.extend(more),
            }
        }
        errors.sort_by_key(Diagnostic::span);
        refuse(&errors, &source);
    }
    let by_name = located.net.nodes();
    for text in &arguments.formula {
        let source = Source::new("formula", text.as_str());
        let parsed = parse_formula(&source).map_err(|error| vec![error]);
        let doubt = parsed.as_ref().ok().and_then(|parsed| parsed.doubt(text, View::Transition));
        match parsed.and_then(|parsed| bind_in_net(&parsed, &by_name)) {
            Ok(bound) => {
                console.diagnostics(doubt.as_slice(), &source);
                names.push((text.clone(), false));
                questions.push(Question::Holds(bound.simplified()));
            }
            Err(errors) => refuse(&errors, &source),
        }
    }
    for examination in &arguments.examination {
        names.push((examination.name().to_owned(), false));
        questions.push(examination.question());
    }
    if failed { Err(Failure::Reported) } else { Ok((names, questions)) }
}

/// Nodes by their ids in the file, or by name where the format has none.
fn ids(located: &Located) -> Nodes<'_> {
    let Some((places, transitions)) = &located.ids else { return located.net.nodes() };
    let places = places.iter().enumerate().map(|(i, id)| (id.as_str(), PlaceId::at(i)));
    let transitions = transitions.iter().enumerate().map(|(i, id)| (id.as_str(), TransitionId::at(i)));
    Nodes::by_id(places, transitions)
}

struct Answer<'r> {
    name: &'r str,
    /// Whether the name is the id of a property in a file, rather than a formula.
    is_id: bool,
    reply: &'r Reply,
    means: &'r [Means],
    located: &'r Located,
}

impl Answer<'_> {
    fn run(&self) -> Option<&Run> {
        match self.reply {
            Reply::Holds(run) | Reply::Violated(run) => run.as_ref(),
            _ => None,
        }
    }

    fn techniques(&self) -> String {
        if matches!(self.reply, Reply::Unknown(_)) {
            return "EXPLICIT".to_owned();
        }
        let techniques: Vec<String> = self.means.iter().map(Means::to_string).collect();
        if techniques.is_empty() { "INITIAL_STATE".to_owned() } else { techniques.join(" ") }
    }

    fn text(&self, trace: Option<TraceForm>) -> String {
        let mut out = String::new();
        let word = match self.reply {
            Reply::Holds(_) => "TRUE".to_owned(),
            Reply::Violated(_) => "FALSE".to_owned(),
            Reply::Most(most) => most.to_string(),
            Reply::Unknown(_) => "CANNOT_COMPUTE".to_owned(),
        };
        // An id is made one word, so that it cannot imitate an answer.
        let name = printable::line(self.name);
        let name = if self.is_id { name.replace(' ', "\\u{20}") } else { name };
        let _ = writeln!(out, "FORMULA {name} {word} TECHNIQUES {}", self.techniques());
        if let Reply::Unknown(reason) = self.reply {
            let _ = writeln!(out, "    {}", printable::line(reason));
        }
        let Some(run) = self.run() else { return out };
        let Located { net, ids, .. } = self.located;
        match trace {
            Some(TraceForm::Tapaal) => {
                let trace = tapaal::trace(net, ids.as_ref(), &run.firings, run.loop_start);
                out +=
                    &trace.unwrap_or_else(|_| "    the trace takes too many tokens for TAPAAL's format\n".to_owned());
            }
            Some(TraceForm::Text) => out += &net_run::text(run, net),
            None => {}
        }
        out
    }

    fn json(&self) -> serde_json::Value {
        let (verdict, reason) = match self.reply {
            Reply::Holds(_) => (json!("holds"), None),
            Reply::Violated(_) => (json!("violated"), None),
            Reply::Most(most) => (json!(most), None),
            Reply::Unknown(reason) => (json!("unknown"), Some(reason)),
        };
        let trace = self.run().map(|run| net_run::json(run, &self.located.net));
        json!({ "name": self.name, "verdict": verdict, "reason": reason, "techniques": self.techniques(), "trace": trace })
    }
}

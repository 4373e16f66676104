//! `petril sif check`: valuation counts and sanity checks of a specification.

use std::fmt::Write as _;
use std::process::ExitCode;
use std::sync::Arc;

use petril::diagnostic::Diagnostic;
use petril::printable::line;
use petril::sif::sanity::{Counts, Doubt, Finding, check, counts};
use petril::sif::{Scope, Specification, Stop, about};
use serde_json::{Value, json};

use super::args::SifCheck;
use super::specification;
use crate::cli::console::Console;
use crate::cli::{Outcome, SUCCESS, guard, phase, report::counted};

/// Text in place of a count that is too large.
const TOO_MANY: &str = "more than can be counted";

pub fn run(arguments: &SifCheck, console: &Console) -> Outcome {
    let read = specification(&arguments.specification, console)?;
    let specification = &read.specification;
    let stop: Stop = Arc::new(guard::is_asked);
    // Counting is limited by itself, and questions may take all the time there is.
    phase::begin_asking("counting valuations");
    let counts: Vec<Vec<Counts>> =
        (0..specification.functions.len()).map(|function| counts(specification, function, &stop)).collect();
    phase::begin_asking("asking whether the specification makes sense");
    let findings = check(specification, &stop);
    for (file, source) in read.sources.iter().enumerate() {
        let here = findings.iter().filter(|finding| finding.place.file == file);
        let diagnostics: Vec<Diagnostic> = here.map(|finding| finding.diagnostic(specification)).collect();
        console.diagnostics(&diagnostics, source);
    }
    if arguments.json {
        console.print_json(document(specification, &findings, &counts))?;
    } else {
        console.print_report(&text(specification, &counts), &console.provenance(), false)?;
    }
    let has = |doubt| findings.iter().any(|finding| finding.doubt == doubt);
    Ok(match () {
        () if has(Doubt::Contradiction) => ExitCode::from(1),
        () if has(Doubt::NotDecided) => ExitCode::from(3),
        () => SUCCESS,
    })
}

/// Summary of the specification, and valuation counts of each output.
fn text(specification: &Specification, counts: &[Vec<Counts>]) -> String {
    let mut out = String::new();
    let title = specification.title.as_deref().map(|title| line(title) + "\n").unwrap_or_default();
    let sizes = [
        counted(specification.functions.len(), "function"),
        counted(specification.inputs().count(), "input"),
        counted(specification.outputs().count(), "output"),
        counted(specification.restrictions.len(), "restriction"),
    ];
    let _ = writeln!(out, "{title}{}", sizes.join(", "));
    for (at, zone) in specification.zones.iter().enumerate() {
        let functions = specification.functions.iter().filter(|function| function.zone == Some(at)).count();
        let own = specification.restrictions.iter().filter(|other| other.scope == Scope::Zone(at)).count();
        let own = if own == 0 { String::new() } else { format!(", {}", counted(own, "restriction")) };
        let title = zone.title.as_deref().map(|title| format!(" ({})", line(title))).unwrap_or_default();
        let _ = writeln!(out, "zone {}{title}: {}{own}", zone.name, counted(functions, "function"));
    }
    for (function, counts) in specification.functions.iter().zip(counts) {
        let title = function.title.as_deref().map(|title| format!("  {}", line(title))).unwrap_or_default();
        let _ = writeln!(out, "\n{}{title}", function.name);
        for output in counts {
            out += &lines(specification, output);
        }
    }
    out
}

fn lines(specification: &Specification, counts: &Counts) -> String {
    let name = specification.name(counts.output);
    let number = |count: &Option<String>| count.as_deref().map_or_else(|| TOO_MANY.to_owned(), about);
    let mut rows = vec![
        (format!("valuations of {}", counted(counts.inputs, "input")), valuations(counts.inputs)),
        (format!("with {name} TRUE"), number(&counts.triggers)),
    ];
    for excluded in &counts.excluded {
        let restriction = &specification.restrictions[excluded.restriction].name;
        let by_itself = number(&excluded.by_itself);
        rows.push((format!("  {restriction} excludes {by_itself}, left"), number(&excluded.left)));
    }
    if !counts.excluded.is_empty() {
        rows.push(("relevant tests".to_owned(), number(&counts.left)));
    }
    let width = rows.iter().map(|(what, _)| what.chars().count()).max().unwrap_or(0);
    rows.into_iter().fold(String::new(), |mut out, (what, number)| {
        let _ = writeln!(out, "    {what:<width$}  {number}");
        out
    })
}

/// Count of the valuations of `inputs` inputs.
fn valuations(inputs: usize) -> String {
    match u32::try_from(inputs).ok().and_then(|inputs| 1_u64.checked_shl(inputs)) {
        Some(count) => count.to_string(),
        None => format!("2^{inputs}"),
    }
}

fn document(specification: &Specification, findings: &[Finding], counts: &[Vec<Counts>]) -> Value {
    let functions = specification.functions.iter().zip(counts).map(|(function, counts)| {
        let outputs = counts.iter().map(|counts| {
            let excluded = counts.excluded.iter().map(|excluded| {
                json!({
                    "restriction": specification.restrictions[excluded.restriction].name,
                    "excludes": excluded.by_itself,
                    "left": excluded.left,
                })
            });
            json!({
                "name": specification.name(counts.output),
                "inputs": counts.inputs,
                "valuations": valuations(counts.inputs),
                "true": counts.triggers,
                "excluded": excluded.collect::<Vec<_>>(),
                "left": counts.left,
            })
        });
        let zone = function.zone.map(|zone| specification.zones[zone].name.as_str());
        json!({ "name": function.name, "zone": zone, "outputs": outputs.collect::<Vec<_>>() })
    });
    json!({
        "title": specification.title,
        "zones": specification.zones.iter().map(|zone| &zone.name).collect::<Vec<_>>(),
        "inputs": specification.inputs().count(),
        "restrictions": specification.restrictions.len(),
        "functions": functions.collect::<Vec<_>>(),
        "findings": findings.iter().map(|finding| told(specification, finding)).collect::<Vec<_>>(),
    })
}

/// Finding as JSON; its position is in the diagnostics.
fn told(specification: &Specification, finding: &Finding) -> Value {
    let name = |id| specification.name(id);
    let example = finding.example.as_ref().map(|example| {
        let values: serde_json::Map<String, Value> =
            example.values.iter().map(|&(id, value)| (name(id).to_owned(), value.into())).collect();
        json!({ "values": values, "is_excluded": example.is_excluded })
    });
    json!({
        "code": finding.doubt.code().id(),
        "message": finding.diagnostic(specification).message,
        "function": finding.function.map(|at| &specification.functions[at].name),
        "signals": finding.signals.iter().map(|id| name(*id)).collect::<Vec<_>>(),
        "formula": finding.formula.as_ref().map(|formula| specification.text(formula)),
        "restrictions": finding.restrictions.iter().map(|at| &specification.restrictions[*at].name).collect::<Vec<_>>(),
        "example": example,
    })
}

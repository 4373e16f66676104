//! SARIF 2.1.0 (OASIS) for viewers of static analysis: each requirement and check is a rule; each violation and each
//! unknown verdict is a result.
//!
//! A result points at the instruction that wrote the value at fault, and steps through the last scan of the run.
//! Requirements that hold have no result: in continuous integration every result is an alert.

use serde_json::{Map, Value, json};

use super::checked::{Checked, tags, why};
use super::stamp::Stamp;
use super::{COMMIT, VERSION};
use petril_base::printable::line;
use petril_check::translate::TransitionRole;
use petril_check::verdict::{Answer, Outcome, Trace, Verdict, Witness};
use petril_check::witness::{Executed, firing_story, story};
use petril_lang::flat::{Hazard, value_text};
use petril_lang::semantics::Role;
use petril_logic::Origin;

/// Upper bound on the instructions of a last scan that is stepped through.
const MAX_INSTRUCTIONS: usize = 1 << 16;
/// Upper bound on the locations of a code flow; the last ones are kept.
const MAX_LOCATIONS: usize = 1000;
/// Total number of locations after which code flows contain only changes: consumers limit the file size.
const MAX_ALL: usize = 8000;

/// Writes a report as one run of the tool.
#[must_use]
pub fn write(checked: &Checked<'_>, stamp: Stamp) -> Value {
    let rules: Vec<Value> = checked.answers().map(|answer| rule(checked, answer)).collect();
    let mut room = MAX_ALL;
    let results: Vec<Value> =
        checked.answers().enumerate().filter_map(|(index, answer)| result(checked, answer, index, &mut room)).collect();
    let mut properties = json!({
        "verdict": checked.report.verdict().word(),
        "assumptions": checked.report.assumptions,
        "options": checked.provenance.options,
        "known": checked.answers().filter(|answer| answer.recalled).map(|answer| &answer.name).collect::<Vec<_>>(),
        "warnings": checked.report.warnings,
    });
    properties["verdicts"] =
        checked.answers().map(|a| (a.name.clone(), a.outcome.verdict().word().into())).collect::<Map<_, _>>().into();
    json!({
        "$schema": "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": {
                "name": "Petril",
                "version": env!("PETRIL_VERSION"),
                "semanticVersion": VERSION,
                "rules": rules,
                "properties": { "commit": COMMIT },
            }},
            "invocations": [{
                "executionSuccessful": true,
                "endTimeUtc": format!("{stamp}Z"),
                "commandLine": checked.provenance.command_line(),
                "arguments": checked.provenance.command.get(1..).unwrap_or_default(),
            }],
            "artifacts": artifacts(checked),
            "columnKind": "unicodeCodePoints",
            "results": results,
            "properties": properties,
        }],
    })
}

/// Files read, the program first, with their hashes.
fn artifacts(checked: &Checked<'_>) -> Vec<Value> {
    let program = checked.source.name();
    let mut files = vec![json!({ "location": artifact(program), "sourceLanguage": "iec61131-3-il" })];
    for (file, hash) in &checked.provenance.inputs {
        let hashes = json!({ "sha-256": hash });
        if file == program {
            files[0]["hashes"] = hashes;
        } else {
            files.push(json!({ "location": artifact(file), "hashes": hashes }));
        }
    }
    files
}

fn rule(checked: &Checked<'_>, answer: &Answer) -> Value {
    let short = answer.sentence.as_ref().or(answer.words.as_ref()).unwrap_or(&answer.formula);
    let full: Vec<&str> = [answer.words.as_deref(), Some(answer.formula.as_str())].into_iter().flatten().collect();
    let (short, full) = (line(short), line(&full.join(": ")));
    let mut rule = json!({
        "id": answer.name,
        "shortDescription": { "text": short },
        "fullDescription": { "text": full },
        "defaultConfiguration": { "level": level(answer) },
        "properties": { "tags": tags(answer).collect::<Vec<_>>(), "formula": answer.formula },
    });
    // Requirements that hold have no result to carry the reason.
    if answer.outcome.verdict() == Verdict::Holds
        && let Some(reason) = checked.reason(answer)
    {
        rule["properties"]["reason"] = reason.into();
    }
    if let Some(origin) = checked.file_of(answer) {
        rule["properties"]["origin"] = format!("{}:{}:{}", origin.file, origin.line, origin.column).into();
    }
    rule
}

/// Level of a violated requirement: by its tag `severity`; without one, the highest.
fn level(answer: &Answer) -> &'static str {
    let severity = answer.tags.iter().find(|tag| tag.name.eq_ignore_ascii_case("severity"));
    match severity.and_then(|tag| tag.value.as_deref()).map(str::to_ascii_lowercase).as_deref() {
        Some("medium" | "moderate" | "warning") => "warning",
        Some("low" | "minor" | "note" | "info") => "note",
        _ => "error",
    }
}

fn result(checked: &Checked<'_>, answer: &Answer, index: usize, room: &mut usize) -> Option<Value> {
    let verdict = answer.outcome.verdict();
    if verdict == Verdict::Holds {
        return None;
    }
    let what = answer.sentence.as_ref().unwrap_or(&answer.formula);
    let mut message = line(&format!("{} is {}: {what}", answer.name, verdict.word()));
    message.extend(checked.reason(answer).map(|reason| format!("\n{reason}")));
    let why = why(answer);
    message.extend(why.iter().flat_map(|why| checked.explained(why)).map(|sentence| format!("\n{sentence}")));
    let origin = checked.file_of(answer).map(|origin| located(origin, "the requirement"));
    let writers = why.iter().flat_map(|why| &why.writers).map(|writer| {
        let value = checked.system.program.value_text(writer.variable, writer.value);
        let name = checked.name(writer.variable);
        let scan = writer.scan + 1;
        at_line(checked, writer.line, &format!("{name} = {value} was written here in scan {scan}"))
    });
    let steps = match &answer.outcome {
        Outcome::Violated(witness, _) => steps(checked, witness, room),
        _ => Vec::new(),
    };
    let mut places: Vec<Value> = writers.collect();
    // The last writer is closest to the violation. An error is located where it occurs.
    places.reverse();
    if let Some((line, hazard)) = met(answer) {
        places.insert(0, at_line(checked, line, &hazard.to_string()));
    }
    places.extend(origin);
    let mut places = places.into_iter();
    let nowhere = || json!({ "physicalLocation": { "artifactLocation": artifact(checked.source.name()) } });
    let mut result = json!({
        "ruleId": answer.name,
        "ruleIndex": index,
        "kind": if verdict == Verdict::Violated { "fail" } else { "open" },
        "level": if verdict == Verdict::Violated { level(answer) } else { "none" },
        "message": { "text": message },
        "locations": [places.next().unwrap_or_else(nowhere)],
        "partialFingerprints": { "requirement/v1": answer.name },
    });
    if answer.recalled {
        result["properties"] = json!({ "known": true });
    }
    let related: Vec<Value> = places
        .enumerate()
        .map(|(id, mut place)| {
            place["id"] = id.into();
            place
        })
        .collect();
    if !related.is_empty() {
        result["relatedLocations"] = related.into();
    }
    if !steps.is_empty() {
        result["codeFlows"] = json!([{ "threadFlows": [{ "id": "plc", "locations": steps }] }]);
    }
    Some(result)
}

/// Error met by the last scan of a run.
fn met(answer: &Answer) -> Option<(usize, Hazard)> {
    match &answer.outcome {
        Outcome::Violated(Witness { trace: Trace::Scans(trace), .. }, _) => trace.scans.last()?.hazard,
        _ => None,
    }
}

/// Last scan of a run, instruction by instruction.
fn steps(checked: &Checked<'_>, witness: &Witness, room: &mut usize) -> Vec<Value> {
    let (scan, instructions): (usize, Vec<Executed>) = match &witness.trace {
        Trace::Scans(trace) => {
            let last = trace.scans.len().saturating_sub(1);
            let told = story(checked.system, trace, last, MAX_INSTRUCTIONS).unwrap_or_default().unwrap_or_default();
            (last + 1, told.into_iter().flat_map(|scan| scan.instructions).collect())
        }
        Trace::Firings(trace) => {
            let told = firing_story(checked.system, trace).unwrap_or_default();
            let mut scans = vec![Vec::new()];
            for firing in told {
                let begins = checked.system.transitions[firing.transition.index()] == TransitionRole::Block;
                if begins && scans.last().is_some_and(|scan: &Vec<Executed>| !scan.is_empty()) {
                    scans.push(Vec::new());
                }
                scans.last_mut().into_iter().for_each(|scan| scan.extend(firing.executed.clone()));
            }
            (scans.len(), scans.pop().unwrap_or_default())
        }
    };
    let program = &checked.system.program;
    let from = instructions.len().saturating_sub(MAX_LOCATIONS);
    let is_essential = |executed: &Executed| {
        let declared = |(variable, _)| program.variable(variable).role != Role::Buffer;
        executed.changes && executed.writes.is_some_and(declared) || executed.hazard.is_some()
    };
    let one = |(order, executed): (usize, &Executed)| {
        let result = value_text(executed.ty, executed.result);
        let mut state = json!({ "CR": { "text": result } });
        let mut message = format!("scan {scan}: {}", checked.instruction(executed.line));
        if let Some((variable, value)) = executed.writes {
            let (name, value) = (checked.name(variable), program.value_text(variable, value));
            message += &format!(": {name} = {value}");
            state[name] = json!({ "text": value });
        }
        message.extend(executed.hazard.map(|hazard| format!(": {hazard}")));
        json!({
            "location": at_line(checked, executed.line, &message),
            "state": state,
            "executionOrder": order + 1,
            "importance": if is_essential(executed) { "essential" } else { "unimportant" },
        })
    };
    let all = instructions.iter().enumerate().skip(from);
    let has_room = instructions.len() - from <= *room;
    *room -= if has_room { instructions.len() - from } else { 0 };
    // Every run has at least one location: if nothing changes, its last instruction.
    let last = instructions.len().saturating_sub(1);
    all.filter(|&(i, executed)| has_room || i == last || is_essential(executed)).map(one).collect()
}

/// Location of a line of flat code in the program.
fn at_line(checked: &Checked<'_>, from: usize, message: &str) -> Value {
    let source = checked.source;
    let mut region = json!({ "startLine": checked.source_line(from) });
    if let Some(code) = checked.system.program.code.get(from) {
        let (last, end) = source.line_column(code.span.end);
        let (first, start) = source.line_column(code.span.start);
        region = json!({ "startLine": first, "startColumn": start, "endLine": last, "endColumn": end });
        if (first, start) == (last, end) {
            region = json!({ "startLine": first });
        }
    }
    json!({
        "physicalLocation": { "artifactLocation": artifact(source.name()), "region": region },
        "message": { "text": line(message) },
    })
}

fn located(origin: &Origin, message: &str) -> Value {
    let region = json!({ "startLine": origin.line, "startColumn": origin.column });
    json!({
        "physicalLocation": { "artifactLocation": artifact(&origin.file), "region": region },
        "message": { "text": message },
    })
}

/// A file as a URI reference: relative to the working directory, unless its name is absolute.
fn artifact(file: &str) -> Value {
    let mut uri = String::new();
    for byte in file.replace('\\', "/").bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'-' | b'.' | b'_' | b'~' => uri.push(char::from(byte)),
            _ => uri += &format!("%{byte:02X}"),
        }
    }
    if uri.starts_with('/') {
        uri.insert_str(0, "file://");
    }
    json!({ "uri": uri })
}

//! Proofs of safety functions as JSON. Field names are part of the interface: they are only ever added to.

use serde_json::{Map, Value, json};

use petril_base::source::Source;
use petril_lang::semantics::VarId;
use petril_spec::sif::SignalId;
use petril_spec::sif::proof::{By, Confirmed, Failure, Form, Outcome, Proof, Scan, Subject};

/// A proof; `source` is the text of the program.
#[must_use]
pub fn proof(subject: &Subject<'_>, proof: &Proof, source: &Source) -> Value {
    let specification = subject.specification;
    let outputs = proof.answers.iter().map(|answer| {
        let claim = &answer.claim;
        let function = specification.functions.iter().find(|function| function.outputs.contains(&claim.signal));
        let restrictions = claim.restrictions.iter().map(|&at| &specification.restrictions[at].name);
        let (mut by, mut induction, mut confirmed, mut reason, mut scans) = (None, None, None, None, None);
        match &answer.outcome {
            Outcome::Proved { by: how, confirmed: second } => {
                by = Some(match how {
                    By::AnyState => "any-state",
                    By::Induction(_) => "induction",
                    By::EveryScan => "every-scan",
                });
                induction = if let By::Induction(scans) = how { Some(scans) } else { None };
                confirmed = second.map(|second| match second {
                    Confirmed::EveryScan { states, scans } => {
                        json!({ "by": "every-scan", "states": states, "scans": scans })
                    }
                    Confirmed::Diagrams => json!({ "by": "diagrams" }),
                });
            }
            Outcome::Refuted(run) => scans = Some(run.iter().map(|scan| told(subject, scan)).collect::<Vec<_>>()),
            Outcome::Unknown(why) => reason = Some(why),
        }
        json!({
            "output": specification.name(claim.signal),
            "variable": name(subject, claim.variable),
            "function": function.map(|function| &function.name),
            "claim": match claim.form {
                Form::Equal => "equal",
                Form::Latched => "latched",
                Form::NotWithout => "not-without",
            },
            "restrictions": restrictions.collect::<Vec<_>>(),
            "verdict": answer.outcome.verdict().word(),
            "by": by,
            "induction": induction,
            "confirmed": confirmed,
            "reason": reason,
            "counterexample": scans,
        })
    });
    let failures = proof.failures.iter().map(|(failure, scans)| {
        let scans: Vec<Value> = scans.iter().map(|scan| told(subject, scan)).collect();
        json!({ "error": error(subject, *failure, source), "verdict": "violated", "counterexample": scans })
    });
    let unknown = proof.unknown_failures.iter().map(|(failure, reason)| {
        let error = failure.map(|failure| error(subject, failure, source));
        json!({ "error": error, "verdict": "unknown", "reason": reason })
    });
    json!({
        "program": { "name": subject.program.name, "file": source.name(), "lines": subject.program.end() },
        "assumptions": proof.assumptions,
        "notes": proof.remarks,
        "compared_scans": proof.compared,
        "outputs": outputs.collect::<Vec<_>>(),
        "errors": failures.chain(unknown).collect::<Vec<_>>(),
        "verdict": proof.verdict().word(),
    })
}

fn name<'s>(subject: &'s Subject<'_>, variable: VarId) -> &'s str {
    &subject.program.variable(variable).name
}

fn error(subject: &Subject<'_>, failure: Failure, source: &Source) -> Value {
    match failure {
        Failure::Hazard(line, hazard) => {
            let (row, column) = source.line_column(subject.program.code[line].span.start);
            json!({ "kind": hazard.to_string(), "line": row, "column": column })
        }
        Failure::Endless => json!({ "kind": "endless" }),
        Failure::TooLong => json!({ "kind": "too-long" }),
    }
}

/// A scan: variables read, and the value of each signal.
fn told(subject: &Subject<'_>, scan: &Scan) -> Value {
    let inputs = scan.given.inputs.iter();
    let inputs: Map<String, Value> = inputs
        .map(|&(input, value)| (name(subject, input).to_owned(), subject.program.value_text(input, value).into()))
        .collect();
    let signal = |id: SignalId| subject.specification.name(id).to_owned();
    let bound = subject.inputs().map(|(id, _)| id).chain(subject.outside.iter().copied());
    let signals: Map<String, Value> = bound.map(|id| (signal(id), scan.signals[id.0].into())).collect();
    let specified = subject.claims.iter().map(|claim| claim.signal);
    let specified: Map<String, Value> = specified.map(|id| (signal(id), scan.wanted[id.0].into())).collect();
    let computed = subject.claims.iter();
    let computed: Map<String, Value> =
        computed.map(|claim| (signal(claim.signal), (scan.memory[claim.variable.0] == 1).into())).collect();
    // The values computed by a failing scan are meaningless.
    let computed = scan.failure.is_none().then_some(computed);
    json!({ "variables": inputs, "inputs": signals, "specified": specified, "computed": computed })
}

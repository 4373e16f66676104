//! Tests and their results as JSON, for programs. Field names are part of the interface: they are only ever added to.
//! The schema is `docs/schema/sif-tests.schema.json`.

use fixedbitset::FixedBitSet;
use serde_json::{Map, Value, json};

use super::told::{error_line, reasons};
use super::{Ran, Sheets};
use petril_spec::sif::{
    Coverage, Deviation, Ending, Excluded, Fate, Hunt, Mutant, Plan, SignalId, Specification, Test, TestRun,
};

/// The complete document.
#[must_use]
pub fn document(sheets: &Sheets<'_>) -> Value {
    let specification = sheets.specification;
    let functions = sheets.plans.iter().enumerate().map(|(position, plan)| function(sheets, position, plan));
    let mut document = json!({
        "system": specification.title,
        "files": sheets.sources.iter().map(petril_base::source::Source::name).collect::<Vec<_>>(),
        "tests_from": sheets.origin,
        "tests": sheets.tests(),
        "functions": functions.collect::<Vec<_>>(),
        "run": sheets.run.as_ref().map(run),
    });
    if let Some(ran) = &sheets.run {
        let [_, failed, errors] = ran.counts();
        document["verdict"] = if failed + errors == 0 { "passed" } else { "failed" }.into();
    }
    document
}

fn run(ran: &Ran<'_>) -> Value {
    let [passed, failed, errors] = ran.counts();
    json!({
        "program": { "name": ran.program().name, "file": ran.source.name() },
        "start": ran.mode(),
        "cycle_ms": ran.program().cycle,
        "passed": passed,
        "failed": failed,
        "errors": errors,
        "inputs_left_alone": ran.runner.unset().map(|id| &ran.program().variable(id).name).collect::<Vec<_>>(),
        "mutants": ran.hunt.map(|found| hunt(ran, found)),
    })
}

fn function(sheets: &Sheets<'_>, position: usize, plan: &Plan) -> Value {
    let specification = sheets.specification;
    let function = &specification.functions[plan.function];
    let names = |ids: &[SignalId]| ids.iter().map(|&id| specification.name(id)).collect::<Vec<_>>();
    let run = sheets.run.as_ref().map(|ran| (ran, &ran.results[position]));
    let tests = plan.tests.iter().enumerate().map(|(number, test)| {
        let mut document = self::test(specification, plan, number, test);
        if let Some((ran, run)) = run {
            document["result"] = result(sheets, ran, &run.tests[number]);
        }
        document
    });
    let tests: Vec<Value> = tests.collect();
    let cube = |cube: &petril_spec::sif::Cube| json!({ "true": names(&cube.ones), "false": names(&cube.zeros) });
    json!({
        "function": function.name,
        "title": function.title,
        "zone": function.zone.map(|zone| &specification.zones[zone].name),
        "criterion": if sheets.origin.is_some() { Value::Null } else { plan.criterion.name().into() },
        "inputs": names(&plan.varied),
        "outputs": names(&plan.touched),
        "absent_outputs": run.map(|(_, run)| names(&run.absent)),
        "incomplete": plan.incomplete,
        "notes": plan.notes,
        "smallest": plan.is_smallest,
        "cubes": plan.cubes.iter().map(cube).collect::<Vec<_>>(),
        "tests": tests,
        "coverage": coverage(specification, &plan.coverage),
        "excluded": sheets.excluded.get(position).map(|one| excluded(specification, one)),
    })
}

/// A test: its inputs are the varied ones, and all others not at rest.
fn test(specification: &Specification, plan: &Plan, number: usize, test: &Test) -> Value {
    let is_told =
        |input: &SignalId| plan.varied.contains(input) || test.values.contains(input.0) != specification.rest(*input);
    let inputs: Vec<SignalId> = specification.inputs().filter(is_told).collect();
    json!({
        "number": number + 1,
        "inputs": values(specification, &test.values, &inputs),
        "expected": values(specification, &test.values, &plan.touched),
        "purpose": test.purpose,
    })
}

fn values(specification: &Specification, ones: &FixedBitSet, signals: &[SignalId]) -> Value {
    let value = |&id: &SignalId| (specification.name(id).to_owned(), Value::from(ones.contains(id.0)));
    Value::Object(signals.iter().map(value).collect::<Map<_, _>>())
}

fn result(sheets: &Sheets<'_>, ran: &Ran<'_>, made: &TestRun) -> Value {
    let deviation = |deviation: &Deviation| {
        json!({
            "output": sheets.specification.name(deviation.output),
            "expected": deviation.expected,
            "scan": deviation.scan,
            "early": deviation.early,
        })
    };
    let deviations = match &made.ending {
        Ending::Failed(deviations) => deviations.iter().map(deviation).collect(),
        _ => Vec::new(),
    };
    json!({
        "verdict": made.ending.word(),
        "scans": made.scans,
        "reasons": reasons(sheets, ran, made),
        "deviations": deviations,
        "line": error_line(ran, made),
    })
}

/// Mutation score of tests.
#[must_use]
pub fn coverage(specification: &Specification, coverage: &Coverage) -> Value {
    let class = |class: &petril_spec::sif::ClassCoverage| {
        json!({
            "class": class.class,
            "faults": class.faults,
            "equivalent": class.equivalent,
            "killed": class.killed,
            "undecided": class.undecided,
        })
    };
    let missed = |missed: &petril_spec::sif::Missed| {
        let inputs: Vec<SignalId> = specification.inputs().filter(|id| missed.shown_by.contains(id.0)).collect();
        json!({
            "class": missed.class,
            "fault": missed.fault,
            "true_inputs": inputs.iter().map(|&id| specification.name(id)).collect::<Vec<_>>(),
            "why": missed.why,
        })
    };
    json!({
        "classes": coverage.classes.iter().map(class).collect::<Vec<_>>(),
        "missed": coverage.missed.iter().map(missed).collect::<Vec<_>>(),
    })
}

/// Excluded valuations of a function.
#[must_use]
pub fn excluded(specification: &Specification, excluded: &Excluded) -> Value {
    let name = |position: usize| &specification.restrictions[position].name;
    let by = excluded
        .by_restriction
        .iter()
        .map(|(position, count, alone)| json!({ "restriction": name(*position), "excludes": count, "alone": alone }));
    let listed = excluded.listed.as_ref().map(|listed| {
        let one = |(ones, by): &(FixedBitSet, Vec<usize>)| {
            let inputs = specification.inputs().filter(|id| ones.contains(id.0));
            json!({
                "true_inputs": inputs.map(|id| specification.name(id)).collect::<Vec<_>>(),
                "excluded_by": by.iter().map(|at| name(*at)).collect::<Vec<_>>(),
            })
        };
        listed.iter().map(one).collect::<Vec<_>>()
    });
    json!({
        "valuations": excluded.valuations,
        "triggering": excluded.triggering,
        "by_restriction": by.collect::<Vec<_>>(),
        "listed": listed,
    })
}

fn hunt(ran: &Ran<'_>, hunt: &Hunt) -> Value {
    let counts = |class: Option<&str>| {
        let [all, found, equivalent, missed, undecided] = hunt.counts(class);
        json!({ "faults": all, "found": found, "equivalent": equivalent, "missed": missed, "undecided": undecided })
    };
    let classes = Mutant::CLASSES.map(|class| {
        let mut counts = counts(Some(class));
        counts["class"] = class.into();
        counts
    });
    let left = hunt.mutants.iter().filter(|(_, fate)| !matches!(fate, Fate::Found(..)));
    let left = left.map(|(mutant, fate)| {
        let (fate, why) = match fate {
            Fate::Equivalent => ("equivalent", None),
            Fate::Undecided(why) => ("undecided", Some(why)),
            Fate::Missed | Fate::Found(..) => ("missed", None),
        };
        let line = ran.source.line_of(ran.program().code[mutant.line].span.start);
        json!({ "class": mutant.class, "fault": mutant.fault, "line": line, "fate": fate, "why": why })
    });
    json!({ "all": counts(None), "classes": classes, "not_found": left.collect::<Vec<_>>() })
}

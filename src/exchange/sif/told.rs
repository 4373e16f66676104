//! Descriptions of tests and their results.

use super::{Ran, Sheets};
use petril_check::scans::Failure;
use petril_lang::flat::Hazard;
use petril_lang::interpret::Fault;
use petril_spec::sif::{Ending, Plan, SignalId, Test, TestRun};

/// Spelling of a Boolean: TRUE or FALSE.
pub fn truth(value: bool) -> &'static str {
    if value { "TRUE" } else { "FALSE" }
}

/// Inputs of a test that are not at rest, as `MODE_Acc = TRUE`.
#[must_use]
pub fn brief(sheets: &Sheets<'_>, test: &Test) -> String {
    let specification = sheets.specification;
    let is = |input: SignalId| test.values.contains(input.0);
    let set = specification.inputs().filter(|&input| is(input) != specification.rest(input));
    let set: Vec<String> = set.map(|input| format!("{} = {}", specification.name(input), truth(is(input)))).collect();
    if set.is_empty() { "all inputs at rest".to_owned() } else { set.join(", ") }
}

/// Reasons why a test is not passed: a sentence for each output, or for the error. Empty if it is passed.
#[must_use]
pub fn reasons(sheets: &Sheets<'_>, ran: &Ran<'_>, test: &TestRun) -> Vec<String> {
    match &test.ending {
        Ending::Passed => Vec::new(),
        Ending::Failed(deviations) => {
            let one = |deviation: &petril_spec::sif::Deviation| {
                let name = sheets.specification.name(deviation.output);
                if deviation.early {
                    return format!(
                        "{name} is TRUE after scan {} already, before its delay has passed",
                        deviation.scan
                    );
                }
                let remembered = if test.remembered.contains(&deviation.output) { ", as it is remembered" } else { "" };
                format!("{name} is {}, expected {}{remembered}", truth(!deviation.expected), truth(deviation.expected))
            };
            deviations.iter().map(one).collect()
        }
        Ending::Error(failure) => vec![error(ran, *failure, test.scans)],
        Ending::TooLong => vec!["its delays take more scans than anybody waits for".to_owned()],
    }
}

fn error(ran: &Ran<'_>, failure: Failure, scan: u64) -> String {
    let (line, hazard) = match failure {
        Failure::Hazard(line, hazard) => (line, hazard),
        Failure::Scan(Fault::TooLong) => return format!("scan {scan} takes too many instructions to wait for its end"),
        Failure::Scan(Fault::Endless) | Failure::NotSafe(_) => {
            return format!("scan {scan} never ends: it repeats a state");
        }
    };
    let what = match hazard {
        Hazard::Overflow => "a number does not fit its type",
        Hazard::DivisionByZero => "a number is divided by 0",
        Hazard::Index => "an index is outside its array",
        Hazard::Subrange => "a value is outside the subrange of its variable",
    };
    let line = ran.source.line_of(ran.program().code[line].span.start);
    format!("in scan {scan}, {what} ({}:{line}: {})", ran.source.name(), ran.source.line_text(line).trim())
}

/// Source line of an error.
pub fn error_line(ran: &Ran<'_>, test: &TestRun) -> Option<usize> {
    match test.ending {
        Ending::Error(Failure::Hazard(line, _)) => Some(ran.source.line_of(ran.program().code[line].span.start)),
        _ => None,
    }
}

/// Origin of a plan's tests, in words.
pub fn made_by(sheets: &Sheets<'_>, plan: &Plan) -> String {
    match sheets.origin {
        Some(file) => format!("the tests of {file}"),
        None => plan.criterion.name().to_owned(),
    }
}

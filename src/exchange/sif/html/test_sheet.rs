//! Test sheet of a function: inputs to set, outputs to expect, checkboxes.

use super::data_sheet::time;
use super::markup::{counted, escaped, tick, ticked};
use super::matrix::Matrix;
use super::{delay, latch};
use crate::exchange::sif::Sheets;
use crate::exchange::sif::told::{made_by, reasons};
use petril_spec::sif::{Ending, Plan, SignalId, TestRun};

/// The test sheet of a plan.
pub fn test_sheet(sheets: &Sheets<'_>, position: usize, plan: &Plan) -> String {
    let name = escaped(&sheets.specification.functions[plan.function].name);
    let matrix = Matrix::new(sheets, plan);
    let class = if matrix.is_wide() { "tests-sheet wide" } else { "tests-sheet" };
    let made = sheets.run.as_ref().map(|ran| &ran.results[position]);
    let mut out = format!(
        "<div class=\"{class}\">\n<h3>Tests of {name} <small>{}, {}</small></h3>\n{}",
        counted(plan.tests.len(), "test"),
        escaped(&made_by(sheets, plan)),
        notes(sheets, plan, &matrix)
    );
    if plan.tests.is_empty() {
        return out + "<p class=\"hint\">There is no test.</p>\n</div>\n";
    }
    let (inputs, outputs) = matrix.widths();
    out += &format!(
        "<div class=\"scroll\"><table class=\"tests\">\n<thead>\n<tr class=\"running\"><th colspan=\"{}\">{name}</th></tr>\n<tr><th rowspan=\"2\" scope=\"col\">No.</th>\
         <th colspan=\"{inputs}\" class=\"begins group\">inputs to set</th>\
         <th colspan=\"{outputs}\" class=\"begins group\">outputs to expect</th>\
         <th rowspan=\"2\" scope=\"col\" class=\"begins ticks\">passed</th><th rowspan=\"2\" scope=\"col\" class=\"ticks\">failed</th>\
         <th rowspan=\"2\" scope=\"col\" class=\"begins remark\">Remark</th></tr>\n<tr>{}</tr>\n</thead>\n",
        inputs + outputs + 4,
        matrix.heads()
    );
    for (number, test) in plan.tests.iter().enumerate() {
        let before = number.checked_sub(1).map(|before| &plan.tests[before]);
        let made = made.map(|run| &run.tests[number]);
        let wrong = made.map(wrong).unwrap_or_default();
        let passed = made.map(|made| made.ending == Ending::Passed);
        let class = if passed == Some(false) { " class=\"not-passed\"" } else { "" };
        let said = made.zip(sheets.run.as_ref()).map(|(made, ran)| reasons(sheets, ran, made)).unwrap_or_default();
        let said: String = said.iter().map(|text| format!("<p class=\"reason\">{}</p>", escaped(text))).collect();
        let purpose = if test.purpose.is_empty() {
            String::new()
        } else {
            format!("<p class=\"purpose\">{}</p>", ticked(&test.purpose.join("; ")))
        };
        out += &format!(
            "<tbody{class}><tr><th scope=\"row\">{}</th>{}<td class=\"begins ticks\">{}</td><td class=\"ticks\">{}</td>\
             <td class=\"begins remark\">{said}{purpose}</td></tr></tbody>\n",
            number + 1,
            matrix.cells(test, before, &wrong),
            tick("passed", passed),
            tick("failed", passed.map(|passed| !passed)),
        );
    }
    out += "</table></div>\n<div class=\"blanks signing\"><div class=\"blank\"><span>Tested by</span></div>\
            <div class=\"blank\"><span>Date</span></div><div class=\"blank\"><span>Signature</span></div></div>\n</div>\n";
    out
}

/// Outputs with unexpected values.
fn wrong(made: &TestRun) -> Vec<SignalId> {
    match &made.ending {
        Ending::Failed(deviations) => deviations.iter().map(|deviation| deviation.output).collect(),
        _ => Vec::new(),
    }
}

fn notes(sheets: &Sheets<'_>, plan: &Plan, matrix: &Matrix<'_>) -> String {
    let specification = sheets.specification;
    let mut notes = Vec::new();
    if matrix.inputs.is_some() {
        notes.push(
            "1 is TRUE, 0 is FALSE. <span class=\"bit changed\">Marked</span> inputs change from the test before."
                .to_owned(),
        );
    } else {
        notes.push("<span class=\"changed\">Marked</span> inputs change from the test before.".to_owned());
    }
    notes.push("All inputs that are not named are at rest.".to_owned());
    let latched = plan.touched.iter().filter_map(|&id| Some((id, latch(specification, id)?)));
    let latched = latched
        .map(|(id, reset)| format!("{} (by {})", escaped(specification.name(id)), escaped(&specification.text(reset))));
    let latched: Vec<String> = latched.collect();
    if !latched.is_empty() {
        notes.push(format!("Reset before each test: {}.", latched.join(", ")));
    }
    let delayed = plan.touched.iter().filter_map(|&id| Some((id, delay(specification, id)?)));
    let delayed: Vec<String> =
        delayed.map(|(id, ms)| format!("{} ({})", escaped(specification.name(id)), time(ms))).collect();
    if !delayed.is_empty() {
        notes.push(format!("Wait for what comes late: {}.", delayed.join(", ")));
    }
    let incomplete =
        plan.incomplete.as_ref().map(|why| format!("<p class=\"doubt\">Not all tests: {}</p>\n", escaped(why)));
    let said: String = plan.notes.iter().map(|note| format!("<p class=\"hint\">{}</p>\n", ticked(note))).collect();
    format!("<p class=\"hint\">{}</p>\n{}{said}", notes.join(" "), incomplete.unwrap_or_default())
}

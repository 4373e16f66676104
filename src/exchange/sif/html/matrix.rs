//! Columns of a test sheet: one per signal if they are few, else a list of deviations from rest.

use crate::exchange::sif::Sheets;
use crate::exchange::sif::told::truth;
use petril_spec::sif::{Plan, SignalId, Test};

use super::markup::escaped;
use super::once;

/// Upper bounds on inputs and outputs with columns of their own; more are listed in words.
const MAX_INPUTS: usize = 14;
const MAX_OUTPUTS: usize = 8;

/// Upper bound on columns in portrait format.
const MAX_UPRIGHT: usize = 11;

/// Columns of a test sheet.
pub struct Matrix<'a> {
    sheets: &'a Sheets<'a>,
    /// Inputs with columns of their own; `None` if inputs are listed in words.
    pub inputs: Option<Vec<SignalId>>,
    /// Outputs with columns of their own; `None` if outputs are listed in words.
    pub outputs: Option<Vec<SignalId>>,
    all_outputs: Vec<SignalId>,
}

impl<'a> Matrix<'a> {
    /// Chooses the columns for a plan.
    pub fn new(sheets: &'a Sheets<'a>, plan: &Plan) -> Self {
        let specification = sheets.specification;
        let off = |input: &SignalId| {
            plan.tests.iter().any(|test| test.values.contains(input.0) != specification.rest(*input))
        };
        let inputs = once(plan.varied.iter().copied().chain(specification.inputs().filter(off)));
        let all_outputs = plan.touched.clone();
        Self {
            sheets,
            inputs: Some(inputs).filter(|inputs| inputs.len() <= MAX_INPUTS),
            outputs: Some(all_outputs.clone()).filter(|outputs| outputs.len() <= MAX_OUTPUTS),
            all_outputs,
        }
    }

    /// Whether the sheet is printed in landscape format.
    pub fn is_wide(&self) -> bool {
        let columns = |ids: &Option<Vec<SignalId>>| ids.as_ref().map_or(MAX_UPRIGHT / 2, Vec::len);
        columns(&self.inputs) + columns(&self.outputs) > MAX_UPRIGHT
    }

    /// Number of columns of inputs and of outputs.
    pub fn widths(&self) -> (usize, usize) {
        let width = |ids: &Option<Vec<SignalId>>| ids.as_ref().map_or(1, Vec::len);
        (width(&self.inputs), width(&self.outputs))
    }

    /// Column heads: vertical names, or none below the head of the group.
    pub fn heads(&self) -> String {
        let head = |ids: &Option<Vec<SignalId>>, class: &str| match ids {
            None => format!("<th class=\"begins {class}\"></th>"),
            Some(ids) => {
                let one = |(at, id): (usize, &SignalId)| {
                    let begins = if at == 0 { " begins" } else { "" };
                    let name = escaped(self.sheets.specification.name(*id));
                    format!("<th scope=\"col\" class=\"upright{begins} {class}\"><span>{name}</span></th>")
                };
                ids.iter().enumerate().map(one).collect()
            }
        };
        head(&self.inputs, "in") + &head(&self.outputs, "out")
    }

    /// Cells of a test; changes from the previous test are marked.
    pub fn cells(&self, test: &Test, before: Option<&Test>, wrong: &[SignalId]) -> String {
        let specification = self.sheets.specification;
        let is = |test: &Test, id: SignalId| test.values.contains(id.0);
        let inputs = match &self.inputs {
            Some(ids) => {
                let one = |(at, id): (usize, &SignalId)| {
                    let is_changed = before.is_some_and(|before| is(before, *id) != is(test, *id));
                    let changed = if is_changed { " changed" } else { "" };
                    cell(at, is(test, *id), changed)
                };
                ids.iter().enumerate().map(one).collect::<String>()
            }
            None => {
                let told = |id: SignalId| {
                    let is_changed = before.is_some_and(|before| is(before, id) != is(test, id));
                    let at_rest = is(test, id) == specification.rest(id);
                    (is_changed || !at_rest).then(|| {
                        let class = if is_changed { "set changed" } else { "set" };
                        let back = if at_rest { " (rest)" } else { "" };
                        let name = escaped(specification.name(id));
                        format!("<span class=\"{class}\">{name}&nbsp;=&nbsp;{}{back}</span>", truth(is(test, id)))
                    })
                };
                let told: Vec<String> = specification.inputs().filter_map(told).collect();
                let told = if told.is_empty() { "all at rest".to_owned() } else { told.join(" ") };
                format!("<td class=\"begins words\">{told}</td>")
            }
        };
        let outputs = match &self.outputs {
            Some(ids) => {
                let one = |(at, id): (usize, &SignalId)| {
                    let class = if wrong.contains(id) { " wrong" } else { "" };
                    cell(at, is(test, *id), class)
                };
                ids.iter().enumerate().map(one).collect::<String>()
            }
            None => {
                let group = |value: bool| {
                    let of = self.all_outputs.iter().filter(|id| is(test, **id) == value);
                    let names: Vec<String> = of.map(|id| escaped(specification.name(*id))).collect();
                    if names.is_empty() {
                        String::new()
                    } else {
                        format!("<b>{}:</b> {} ", truth(value), names.join(", "))
                    }
                };
                format!("<td class=\"begins words\">{}{}</td>", group(true), group(false))
            }
        };
        inputs + &outputs
    }
}

fn cell(position: usize, value: bool, class: &str) -> String {
    let begins = if position == 0 { " begins" } else { "" };
    let level = if value { "one" } else { "zero" };
    format!("<td class=\"bit {level}{begins}{class}\">{}</td>", u8::from(value))
}

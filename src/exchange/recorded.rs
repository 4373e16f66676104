//! Runs recorded in reports of `petril check --json`, to be repeated.

use serde_json::{Map, Value};

use petril_check::simulate::Plan;
use petril_check::translate::System;
use petril_check::verdict::Note;
use petril_check::witness::{PlantMove, Scan};
use petril_lang::flat::FlatProgram;
use petril_lang::semantics::{Role, VarId};

/// Run of the scan view, as recorded in a report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recorded {
    /// Requirement that the run belongs to.
    pub requirement: String,
    /// Plans of the scans.
    pub plans: Vec<Plan>,
    /// For a lasso, the position of the scan whose end the last scan repeats.
    pub loop_start: Option<usize>,
    /// Facts shown by the run, with their positions.
    pub notes: Vec<Note>,
    scans: Vec<Expected>,
}

/// Recorded end of a scan.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Expected {
    /// Values of inputs, and of all other variables if the scan ends, as bit patterns.
    values: Vec<(VarId, u64)>,
    ends: bool,
}

/// Extracts the run of a requirement; by default that of the first violated one, or else of the first that has a run.
///
/// With a plant, its recorded moves are repeated; without one, the recorded input values.
///
/// # Errors
/// A sentence: the run is missing, or does not fit this program and plant.
pub fn recorded(report: &Value, requirement: Option<&str>, system: &System) -> Result<Recorded, String> {
    let list = |name: &str| report[name].as_array().map(Vec::as_slice).unwrap_or_default();
    let answers: Vec<&Value> = list("requirements").iter().chain(list("checks")).collect();
    if answers.is_empty() {
        return Err("this is no report of `petril check --json`, or one without requirements".to_owned());
    }
    let name = |answer: &Value| answer["name"].as_str().unwrap_or_default().to_owned();
    let has_run = |answer: &&&Value| run(answer)["kind"] == "scans";
    let answer = match requirement {
        Some(asked) => answers.iter().find(|answer| name(answer).eq_ignore_ascii_case(asked)).ok_or_else(|| {
            let names: Vec<String> = answers.iter().map(|answer| name(answer)).collect();
            format!("the report has no requirement `{asked}`; it has {}", names.join(", "))
        })?,
        None => {
            let violated = answers.iter().filter(has_run).find(|answer| answer["verdict"] == "violated");
            let found = violated.or_else(|| answers.iter().find(has_run));
            found.ok_or(
                "the report has no run of scans: nothing in it is violated, or it was made with `--view transition`",
            )?
        }
    };
    let (name, trace) = (name(answer), run(answer));
    let scans = match (trace["kind"].as_str(), trace["scans"].as_array()) {
        (Some("scans"), Some(scans)) => scans,
        (Some("firings"), _) => {
            return Err(format!("the run of `{name}` is one of firings: make the report with `--view scan`"));
        }
        _ => {
            let verdict = answer["verdict"].as_str().unwrap_or("unknown");
            return Err(format!("the report has no run of `{name}`, which is `{verdict}`"));
        }
    };
    let mut recorded = Recorded {
        requirement: name,
        plans: Vec::new(),
        loop_start: trace["loop_start"].as_u64().map(|start| start.saturating_sub(1) as usize),
        notes: trace["notes"].as_array().into_iter().flatten().filter_map(note).collect(),
        scans: Vec::new(),
    };
    for (position, scan) in scans.iter().enumerate() {
        let (plan, expected) =
            read(scan, system).map_err(|problem| format!("in scan {} of the report, {problem}", position + 1))?;
        recorded.plans.push(plan);
        recorded.scans.push(expected);
    }
    let count = recorded.plans.len();
    match recorded.loop_start {
        Some(start) if start + 1 >= count => Err(format!("the report has no scan behind scan {}", start + 1)),
        _ => Ok(recorded),
    }
}

impl Recorded {
    /// Plan of a scan, by position. A lasso is repeated for ever; after another run nothing changes.
    #[must_use]
    pub fn plan(&self, position: usize) -> Plan {
        let count = self.plans.len();
        match self.loop_start {
            Some(start) if position >= count => {
                self.plans[start + 1 + (position - count) % (count - start - 1)].clone()
            }
            _ => self.plans.get(position).cloned().unwrap_or_default(),
        }
    }

    /// Difference between a scan, by position, and the recorded one, as a sentence.
    #[must_use]
    pub fn difference(&self, program: &FlatProgram, position: usize, scan: &Scan) -> Option<String> {
        let expected = self.scans.get(position)?;
        let number = position + 1;
        let differs = |what: String| {
            let why = "the report is about another program or plant, or was made with other options";
            Some(format!("in scan {number}, {what}: {why}"))
        };
        if expected.ends != scan.end.is_some() {
            return differs(if expected.ends { "the program never ends" } else { "the program ends" }.to_owned());
        }
        let value = |id: VarId| match &scan.end {
            Some(end) => Some(end.memory[id.0]),
            None => scan.inputs.iter().find(|&&(input, _)| input == id).map(|&(_, value)| value),
        };
        let (id, recorded, made) = expected.values.iter().find_map(|&(id, recorded)| {
            let made = value(id)?;
            (made != recorded).then_some((id, recorded, made))
        })?;
        let text = |pattern| program.value_text(id, pattern);
        differs(format!("`{}` becomes {}, and {} in the report", program.variable(id).name, text(made), text(recorded)))
    }
}

/// Run of an answer: its trace, or else the example of its premise.
fn run(answer: &Value) -> &Value {
    if answer["trace"].is_null() { &answer["example"] } else { &answer["trace"] }
}

/// A note; scans count from 1 in reports.
fn note(note: &Value) -> Option<Note> {
    let scan = |key: &str| Some(usize::try_from(note[key].as_u64()?).ok()?.saturating_sub(1));
    Some(Note { first: scan("first")?, last: scan("last")?, text: note["text"].as_str()?.to_owned() })
}

fn read(scan: &Value, system: &System) -> Result<(Plan, Expected), String> {
    let program = &system.program;
    let has_plant = !system.plant.components.is_empty();
    let mut plan = Plan::default();
    let done = scan["plant"].as_array().ok_or("it is not said what the plant does")?;
    for name in done.iter().filter(|_| has_plant) {
        let found = name.as_str().and_then(|name| find(system, name));
        plan.moves.push(found.ok_or_else(|| format!("the plant does {name}, which it cannot"))?);
    }
    let ends = scan["ends"].as_bool().ok_or("it is not said whether it ends")?;
    let mut values = group(scan, "inputs", Role::Input, program)?;
    plan.inputs = values.iter().copied().filter(|&(input, _)| system.plant.driver(input).is_none()).collect();
    if ends {
        values.extend(group(scan, "memory", Role::Memory, program)?);
        values.extend(group(scan, "outputs", Role::Output, program)?);
    }
    Ok((plan, Expected { values, ends }))
}

/// Plant transition of a name.
fn find(system: &System, name: &str) -> Option<PlantMove> {
    system.plant.components.iter().enumerate().find_map(|(component, own)| {
        let transition = own.transitions.iter().position(|transition| transition.name == name)?;
        Some(PlantMove { component, transition })
    })
}

/// Values of all variables of a role.
fn group(scan: &Value, key: &str, role: Role, program: &FlatProgram) -> Result<Vec<(VarId, u64)>, String> {
    let empty = Map::new();
    let given = scan[key].as_object().unwrap_or(&empty);
    let mut values = Vec::new();
    for (name, value) in given {
        let id = program.find(name).filter(|&id| program.variable(id).role == role);
        let id =
            id.ok_or_else(|| format!("there is `{name}` among the {key}, which `{}` has not there", program.name))?;
        let ty = program.variable(id).ty;
        let number = match value {
            Value::Bool(bit) if ty.is_bool() => Some(i128::from(*bit)),
            Value::Number(number) if !ty.is_bool() => {
                number.as_i64().map(i128::from).or_else(|| number.as_u64().map(i128::from))
            }
            _ => None,
        };
        let number = number.filter(|&number| ty.holds(number));
        let number = number.ok_or_else(|| format!("`{name}` is {value}, which is no value of type `{ty}`"))?;
        values.push((id, ty.pattern(number)));
    }
    match program.with_role(role).find(|&id| values.iter().all(|&(other, _)| other != id)) {
        Some(missing) => Err(format!("there is no `{}` among the {key}", program.variable(missing).name)),
        None => Ok(values),
    }
}

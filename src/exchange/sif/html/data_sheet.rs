//! Data sheet of a function, in the three sections of the seed paper's template.

use super::markup::{code, escaped, row, table};
use super::{delay, latch, once, paper, restrictions};
use crate::exchange::sif::Sheets;
use crate::exchange::sif::told::truth;
use petril_spec::sif::{Binding, Kind, Plan, SignalId, Specification};

/// The data sheet of a function.
pub fn data_sheet(sheets: &Sheets<'_>, plan: &Plan) -> String {
    let specification = sheets.specification;
    let function = &specification.functions[plan.function];
    let zone = function.zone.map(|zone| {
        let zone = &specification.zones[zone];
        let title = zone.title.as_ref().map(|title| format!(" · {}", escaped(title))).unwrap_or_default();
        format!("<p class=\"kicker\">Zone {}{title}</p>\n", escaped(&zone.name))
    });
    let title = function.title.as_ref().map(|title| format!(" <span>{}</span>", escaped(title))).unwrap_or_default();
    format!(
        "<div class=\"sheet\">\n{}<h2>{}{title}</h2>\n{}{}{}</div>\n",
        zone.unwrap_or_default(),
        escaped(&function.name),
        informal(&function.informal),
        interface(specification, plan),
        formal(specification, plan.function)
    )
}

fn informal(said: &[(String, String)]) -> String {
    if said.is_empty() {
        return String::new();
    }
    let pair = |(word, text): &(String, String)| {
        let name = match word.to_ascii_lowercase().as_str() {
            "sil" => "SIL".to_owned(),
            "text" => "Description".to_owned(),
            other => capital(other),
        };
        format!("<dt>{}</dt><dd>{}</dd>\n", escaped(&name), escaped(text))
    };
    format!(
        "<h3>1 Informal presentation</h3>\n<dl class=\"said\">\n{}</dl>\n",
        said.iter().map(pair).collect::<String>()
    )
}

/// Capitalises a word.
fn capital(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map(|first| first.to_uppercase().collect::<String>() + letters.as_str()).unwrap_or_default()
}

fn interface(specification: &Specification, plan: &Plan) -> String {
    let function = &specification.functions[plan.function];
    let inputs = once(function.inputs.iter().chain(&plan.varied).copied());
    // Without this column, signals have the names of their variables.
    let is_bound = inputs.iter().chain(&function.outputs).any(|id| specification.signal(*id).binding.is_some());
    let line = |kind: &str, id: SignalId| {
        let signal = specification.signal(id);
        let bound = match &signal.binding {
            Some(Binding::Variable(name, _)) | Some(Binding::Address(name, _)) => code(name),
            None => String::new(),
        };
        let more = match &signal.kind {
            Kind::Input { rest } => format!("at rest {}", truth(*rest)),
            Kind::Defined { .. } if kind == "input" => "output of another function".to_owned(),
            Kind::Defined { .. } => {
                let latched =
                    latch(specification, id).map(|reset| format!("latched until {}", specification.text(reset)));
                let delayed = delay(specification, id).map(|ms| format!("delayed by {}", time(ms)));
                latched.into_iter().chain(delayed).collect::<Vec<_>>().join(", ")
            }
        };
        let description = escaped(signal.description.as_deref().unwrap_or_default());
        let mut cells = vec![kind.to_owned(), code(&signal.name), description, bound, escaped(&more)];
        if !is_bound {
            cells.remove(3);
        }
        row(cells)
    };
    let rows: Vec<String> = inputs.iter().map(|id| line("input", *id)).collect();
    let outputs = function.outputs.iter().map(|id| line("output", *id));
    let mut heads = vec!["", "Name", "What it is", "In the program", "Notes"];
    if !is_bound {
        heads.remove(3);
    }
    format!("<h3>2 Interface</h3>\n{}", table("plain interface", &heads, rows.into_iter().chain(outputs)))
}

/// A line with its indentation.
fn indented(line: &str) -> String {
    let blanks = line.len() - line.trim_start().len();
    " ".repeat(blanks) + &escaped(line)
}

/// A time in seconds or milliseconds.
pub fn time(ms: u32) -> String {
    if ms.is_multiple_of(1000) { format!("{} s", ms / 1000) } else { format!("{ms} ms") }
}

fn formal(specification: &Specification, function: usize) -> String {
    let own = &specification.functions[function];
    let prefix = format!("{}.", own.name);
    let equation = |id: &SignalId| {
        let name = specification.name(*id);
        let formula = specification.definition(*id);
        let equation = formula.map(|formula| paper::equation(specification, &prefix, name, formula));
        let lines: Vec<String> = equation.iter().flat_map(|text| text.split('\n')).map(indented).collect();
        format!("<p class=\"formula\"><code>{}</code></p>\n", lines.join("\n"))
    };
    let equations: String = own.equations.iter().map(equation).collect();
    let rows: Vec<String> = restrictions(specification, function)
        .map(|at| {
            let restriction = &specification.restrictions[at];
            let said = escaped(restriction.sentence.as_deref().unwrap_or_default());
            row([code(&restriction.name), code(&restriction.text), said])
        })
        .collect();
    let restrictions = if rows.is_empty() {
        "<p class=\"hint\">No restrictions.</p>\n".to_owned()
    } else {
        table("plain restrictions", &["Restriction", "What cannot be, or always is", "In words"], rows)
    };
    format!("<h3>3 Formal description</h3>\n{equations}{restrictions}")
}

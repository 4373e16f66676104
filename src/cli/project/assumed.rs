//! Assumptions of the verdicts on the programs of a project, each once.

use petril::printable::line;

use super::run::Judged;
use crate::cli::console::Console;
use crate::cli::report::{counted, paragraph};

/// Upper bound on the programs named with an assumption; more are counted.
const NAMED: usize = 3;

/// A line for each assumption, with the programs it is made of, if these are not all.
pub fn assumed(results: &[Judged], console: &Console) -> String {
    let mut of: Vec<(&str, Vec<&str>)> = Vec::new();
    let mut checked = 0;
    for Judged { name, done, .. } in results {
        let Ok(done) = done else { continue };
        checked += 1;
        for assumption in &done.report.assumptions {
            match of.iter_mut().find(|(known, _)| known == assumption) {
                Some((_, names)) => names.push(name),
                None => of.push((assumption, vec![name])),
            }
        }
    }
    let mut out = String::new();
    for (assumption, names) in of {
        let head = match names.len() {
            count if count == checked => "assumed: ".to_owned(),
            count if count > NAMED => format!("assumed of {}: ", counted(count, "program")),
            _ => format!("assumed of {}: ", line(&names.join("; "))),
        };
        out += &paragraph(&head, "assumed: ".len(), assumption, console.output_width());
    }
    if out.is_empty() { out } else { format!("\n{out}") }
}

//! Configurations with their resources, tasks and global variables.

use pest::iterators::Pair;

use super::declarations::var_block;
use super::operands::constant;
use super::{first_word, name, span};
use crate::syntax::ast::{Configuration, Name, ProgramInstance, Task, Unit};
use crate::syntax::parse::Rule;
use petril_base::diagnostic::{Code, Diagnostic};

/// Consumes a pair of the rule `configuration`; its global variables become those of the file.
pub fn configuration(pair: Pair<'_, Rule>, unit: &mut Unit, diagnostics: &mut Vec<Diagnostic>) {
    let word = first_word(&pair);
    let mut configuration = Configuration { name: word.clone(), tasks: Vec::new(), programs: Vec::new() };
    let mut ended = false;
    for piece in pair.into_inner() {
        match piece.as_rule() {
            Rule::identifier => configuration.name = name(&piece),
            Rule::var_block => unit.globals.push(var_block(piece, diagnostics)),
            Rule::task => configuration.tasks.extend(task(piece)),
            Rule::program_instance => configuration.programs.extend(program(piece)),
            Rule::aside_end => ended = true,
            Rule::bad_aside => {
                let word = first_word(&piece);
                let message = format!("`{}` cannot stand in a configuration", word.text);
                diagnostics.push(
                    Diagnostic::new(Code::Syntax, span(&piece), message)
                        .suggest(&word.text, ["TASK", "PROGRAM", "RESOURCE", "END_RESOURCE", "VAR_GLOBAL"])
                        .help("it holds `VAR_GLOBAL`, `RESOURCE`, `TASK` and `PROGRAM`, like `TASK t (INTERVAL := T#20ms, PRIORITY := 1);`"),
                );
            }
            _ => {}
        }
    }
    if !ended {
        let message = "this `CONFIGURATION` has no end";
        diagnostics.push(Diagnostic::new(Code::EndMissing, word.span, message).help("end it with `END_CONFIGURATION`"));
    }
    unit.configurations.push(configuration);
}

fn task(pair: Pair<'_, Rule>) -> Option<Task> {
    let mut pieces = pair.into_inner().filter(|piece| piece.as_rule() != Rule::task_word);
    let mut task = Task { name: name(&pieces.next()?), interval: None };
    for argument in pieces {
        let mut pieces = argument.into_inner();
        let (Some(parameter), Some(value)) = (pieces.next(), pieces.next()) else { continue };
        if name(&parameter).is("INTERVAL") && value.as_rule() == Rule::constant {
            task.interval = Some(constant(&value));
        }
    }
    Some(task)
}

fn program(pair: Pair<'_, Rule>) -> Option<ProgramInstance> {
    let pieces = pair.into_inner().filter(|piece| matches!(piece.as_rule(), Rule::identifier | Rule::type_name));
    let mut names: Vec<Name> = pieces.map(|piece| name(&piece)).collect();
    let program = names.pop()?;
    let task = (names.len() > 1).then(|| names.pop()).flatten();
    Some(ProgramInstance { name: names.pop()?, task, program })
}

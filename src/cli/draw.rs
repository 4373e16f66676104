//! `petril draw`: draws the subnet of one instruction.

use petril::diagnostic::{any_error, nearest};
use petril::flat::{FlatProgram, flatten};
use petril::printable;
use petril::source::Source;
use petril::translate::{Plant, System};
use petril::{draw, semantics, syntax};

use super::args::Draw;
use super::console::Console;
use super::{Failure, Outcome, SUCCESS, input, output, phase, shown};

/// Operators with pictures.
const OPERATORS: [&str; 19] = [
    "LD", "LDN", "ST", "STN", "S", "R", "AND", "ANDN", "OR", "ORN", "XOR", "XORN", "NOT", "JMP", "JMPC", "JMPCN",
    "RET", "RETC", "RETCN",
];

pub fn run(arguments: &Draw, console: &Console) -> Outcome {
    let (program, line) = match (&arguments.program, &arguments.instruction) {
        (Some(path), _) => {
            let program = input::program(path, &arguments.reading, console)?.flat;
            let lines = program.end();
            let line = arguments.line.unwrap_or(1);
            let index = line.checked_sub(1).filter(|&index| index < lines).ok_or_else(|| {
                Failure::Message(format!("the flat code has no line {line}; its lines are 1 to {lines}"))
            })?;
            (program, index)
        }
        (None, instruction) => single(instruction.as_deref().unwrap_or_default())?,
    };
    let title = program.text(program.code[line].instruction);
    phase::begin("composing the net");
    let system = System::new(program, Plant::default());
    output::write_text(&arguments.output, &draw::subnet(&system, line, Some(title.trim())).svg())?;
    console.message(&format!("{}\n", shown(&arguments.output)));
    Ok(SUCCESS)
}

/// A program whose second line is the operator, with the operand `x` or a jump to the fourth line.
fn single(operator: &str) -> Result<(FlatProgram, usize), Failure> {
    let operator = operator.trim().to_ascii_uppercase();
    let unknown = || {
        let hint = nearest(&operator, OPERATORS).map(|name| format!("; did you mean {name}?")).unwrap_or_default();
        Failure::Message(format!(
            "there is no picture of `{}`{hint}\n  the operators there are pictures of: {}",
            printable::line(&operator),
            OPERATORS.join(" ")
        ))
    };
    if !OPERATORS.contains(&operator.as_str()) {
        return Err(unknown());
    }
    let operand = match operator.as_str() {
        "NOT" | "RET" | "RETC" | "RETCN" => "",
        _ if operator.starts_with("JMP") => "on",
        _ => "x",
    };
    let text = format!("PROGRAM p VAR x : BOOL; END_VAR\nLD x\n{operator} {operand}\nLD x\non: ST x\nEND_PROGRAM");
    let (unit, errors) = syntax::parse(&Source::new("p", text));
    let (program, _) = semantics::check(&unit, !any_error(&errors));
    program.map(|program| (flatten(&program), 1)).ok_or_else(unknown)
}

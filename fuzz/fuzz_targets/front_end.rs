//! Any bytes: reading, checking and flattening come to an end, in little memory, without a panic. Diagnostics lie in the
//! text, and there is a program exactly if none of them is an error. A text that is accepted can be printed and read again,
//! and a small program becomes a net and is executed.
#![no_main]

use libfuzzer_sys::fuzz_target;
use petril::diagnostic::{Diagnostic, Style, any_error, render};
use petril::flat::{FlatProgram, Instruction, flatten};
use petril::interpret::Machine;
use petril::semantics;
use petril::source::Source;
use petril::syntax;
use petril::translate::{Plant, System};

fuzz_target!(|bytes: &[u8]| {
    let Ok(source) = Source::decode("fuzz", bytes) else { return };
    let Some((program, text)) = front_end(&source) else { return };
    // A project in XML may name its tasks by what is no name in a text.
    if !source.text().trim_start().starts_with('<') {
        let again = front_end(&Source::new("printed", text.clone()));
        assert_eq!(again.map(|(again, _)| code(&again)), Some(code(&program)), "printed as\n{text}");
    }
    if is_small(&program) {
        let system = System::new(program, Plant::default());
        assert!(system.net.initial_marking().marked().count() > 0);
        let _ = Machine::new(&system.program).scan();
    }
});

/// The flat code of a text that is accepted, and the text as it is printed.
fn front_end(source: &Source) -> Option<(FlatProgram, String)> {
    let (unit, mut diagnostics) = syntax::parse(source);
    let (program, more) = semantics::check(&unit, !any_error(&diagnostics));
    diagnostics.extend(more);
    // As many as the command line prints.
    diagnostics.iter().take(100).for_each(|diagnostic| is_printable(diagnostic, source));
    assert_eq!(program.is_none(), any_error(&diagnostics), "{diagnostics:?}");
    let program = flatten(&program?);
    Some((program, unit.to_string()))
}

fn is_printable(diagnostic: &Diagnostic, source: &Source) {
    for label in &diagnostic.labels {
        assert!(source.text().get(label.span.range()).is_some(), "{diagnostic:?}");
    }
    let (line, column) = source.line_column(diagnostic.span().start);
    let printed = render(diagnostic, source, Style::default());
    assert!(printed.contains(&format!("{line}:{column}\n")), "{printed}");
    // The names of the grammar's rules are nobody's business, unless they stand in the text.
    let tells_rules = diagnostic.message.contains("Rule::") && !source.text().contains("Rule::");
    assert!(!diagnostic.message.is_empty() && !tells_rules, "{printed}");
}

fn code(program: &FlatProgram) -> Vec<Instruction> {
    program.code.iter().map(|line| line.instruction).collect()
}

/// Nets of long programs with wide numbers are large, which says nothing about the front end.
fn is_small(program: &FlatProgram) -> bool {
    program.code.len() <= 40 && program.variables.iter().map(|variable| variable.bits).sum::<u32>() <= 400
}

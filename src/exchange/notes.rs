//! Annotations of the nodes of a net.

use petril_base::source::Source;
use petril_check::translate::{Part, PlaceRole, System, TransitionRole};
use petril_net::format::pnml::{Note, Notes};

/// Meaning of the nodes of a system net; `source` is the program's text. Lines of code and of text count from 1.
#[must_use]
pub fn notes(system: &System, source: &Source) -> Notes {
    let places = system.places.iter().map(|&role| place(system, source, role)).collect();
    let transitions = system.transitions.iter().map(|&role| transition(system, source, role)).collect();
    Notes { places, transitions }
}

fn note(part: Part, role: &'static str) -> Note {
    vec![("part", part.name().to_owned()), ("role", role.to_owned())]
}

fn place(system: &System, source: &Source, role: PlaceRole) -> Note {
    let variable = |id| ("variable", system.program.variable(id).name.clone());
    let component = |index: usize| ("component", system.plant.components[index].name.clone());
    let word = match role {
        PlaceRole::Bit { .. } => "variable",
        PlaceRole::Result { .. } => "result",
        PlaceRole::Register { .. } => "register",
        PlaceRole::Line(_) => "line",
        PlaceRole::Within(..) => "within-line",
        PlaceRole::Hazard(..) => "hazard",
        PlaceRole::Idle => "idle",
        PlaceRole::Copy(_) => "copy",
        PlaceRole::Copying(..) => "copying",
        PlaceRole::Blocking(_) => "blocking",
        PlaceRole::Plant(_) => "plant",
    };
    let mut note = note(role.part(), word);
    match role {
        PlaceRole::Bit { variable: id, bit, value } => {
            note.push(variable(id));
            // A `BOOL` has only one bit.
            note.extend((!system.program.variable(id).ty.is_bool()).then(|| self::bit(bit)));
            note.push(self::value(value));
        }
        PlaceRole::Result { bit, value } => {
            note.extend((system.result_width() > 1).then(|| self::bit(bit)));
            note.push(self::value(value));
        }
        PlaceRole::Register { register, bit, value } => {
            note.extend([("register", register.to_string()), self::bit(bit), self::value(value)]);
        }
        PlaceRole::Line(line) | PlaceRole::Within(line, _) => note.extend(self::line(system, source, line)),
        PlaceRole::Hazard(line, hazard) => {
            note.push(("hazard", hazard.to_string()));
            note.extend(self::line(system, source, line));
        }
        PlaceRole::Idle => {}
        PlaceRole::Copy(id) | PlaceRole::Copying(id, _) => note.push(variable(id)),
        PlaceRole::Blocking(index) | PlaceRole::Plant(index) => note.push(component(index)),
    }
    note
}

fn transition(system: &System, source: &Source, role: TransitionRole) -> Note {
    let word = match role {
        TransitionRole::Line(_) => "line",
        TransitionRole::Block => "block",
        TransitionRole::Copy { .. } => "copy",
        TransitionRole::Unblock => "unblock",
        TransitionRole::Plant { .. } => "plant",
    };
    let mut note = note(role.part(), word);
    match role {
        TransitionRole::Line(line) => note.extend(self::line(system, source, line)),
        TransitionRole::Copy { variable, bit, value } => {
            let variable = system.program.variable(variable);
            note.push(("variable", variable.name.clone()));
            note.extend((!variable.ty.is_bool()).then(|| self::bit(bit)));
            note.push(self::value(value));
        }
        TransitionRole::Plant { component, .. } => {
            note.push(("component", system.plant.components[component].name.clone()));
        }
        TransitionRole::Block | TransitionRole::Unblock => {}
    }
    note
}

fn bit(bit: u32) -> (&'static str, String) {
    ("bit", bit.to_string())
}

fn value(value: bool) -> (&'static str, String) {
    ("value", u8::from(value).to_string())
}

/// Line of code with the source line it comes from; `End` has none.
fn line(system: &System, source: &Source, line: usize) -> Note {
    let code = system.program.code.get(line);
    let from = code.map(|code| ("source-line", source.line_of(code.span.start).to_string()));
    [("line", (line + 1).to_string())].into_iter().chain(from).collect()
}

//! Devices of a plant from a net, with every check that a plant must pass.

use std::collections::{BTreeMap, BTreeSet};

use petgraph::unionfind::UnionFind;

use super::component::{Component, PlantPlace, PlantTransition};
use super::{Plant, markings};
use crate::translate::valuation::{self, Assignment, Value};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;
use petril_lang::flat::FlatProgram;
use petril_lang::semantics::{Role, VarId};
use petril_net::net::{Arcs, Located, PlaceId, TransitionId};

/// Meaning of a place of the net for the program.
enum Meaning {
    /// Place of the plant, with the external values it stands for.
    Own(Vec<(VarId, u64)>),
    /// Place of the program, marked while its outputs have these values.
    Test(Vec<(VarId, u64)>),
}

impl Meaning {
    fn values(&self) -> &[(VarId, u64)] {
        match self {
            Self::Own(values) | Self::Test(values) => values,
        }
    }
}

/// Component, with the nodes of the net it is made of.
pub struct Device {
    pub component: Component,
    pub places: Vec<PlaceId>,
    pub transitions: Vec<TransitionId>,
}

/// Checks a net and splits it into devices.
pub fn devices(file: &Located, program: &FlatProgram, others: &Plant) -> Result<Vec<Device>, Vec<Diagnostic>> {
    let net = &file.net;
    let mut errors = Vec::new();
    if others.names().iter().any(|name| name == net.name()) {
        let span = file.places.first().or(file.transitions.first()).copied().unwrap_or_default();
        let message = format!("there are two plants named `{}`", net.name());
        errors.push(Diagnostic::new(Code::PlantNameTwice, span, message).help("give each net a name of its own"));
    }
    let mut meanings: Vec<Meaning> = Vec::with_capacity(net.places().len());
    let mut messages = BTreeSet::new();
    for place in net.place_ids() {
        match meaning(file, place, program, errors.len()) {
            Ok(meaning) => meanings.push(meaning),
            // An unknown variable occurs in a place for each of its values.
            Err(error) => errors.extend(messages.insert(error.message.clone()).then_some(error)),
        }
    }
    errors.extend(valuations_twice(file, &meanings));
    if !errors.is_empty() {
        return Err(errors);
    }
    if meanings.iter().all(|meaning| meaning.values().is_empty()) {
        let span = file.places.first().or(file.transitions.first()).copied().unwrap_or_default();
        let message = format!("the plant `{}` gives no input a value and reads no output", net.name());
        let help = "name its places by the values they stand for, like `S1=1,O1=0`";
        return Err(vec![Diagnostic::new(Code::PlantVariableUnfit, span, message).help(help)]);
    }
    let devices = split(file, &meanings, &mut errors);
    let taken: BTreeSet<&str> = others.components.iter().flat_map(names).collect();
    if let Some(twice) = devices.iter().flat_map(|device| names(&device.component)).find(|name| taken.contains(name)) {
        let span = file.places.first().or(file.transitions.first()).copied().unwrap_or_default();
        let message = format!("two plants have something named `{twice}`");
        errors.push(Diagnostic::new(Code::PlantNameTwice, span, message).help("give one of the nets another name"));
    }
    let devices: Vec<Device> = devices
        .into_iter()
        .filter_map(|mut device| {
            let explored = markings::explore(&mut device.component, &device.places, file, program);
            explored.map_err(|error| errors.push(*error)).ok().map(|()| device)
        })
        .collect();
    let all: Vec<&Component> = others.components.iter().chain(devices.iter().map(|device| &device.component)).collect();
    for input in program.with_role(Role::Input) {
        if all.iter().filter(|component| component.drives(input)).count() > 1 {
            let giving = net.place_ids().filter(
                |place| matches!(&meanings[place.index()], Meaning::Own(drives) if drives.iter().any(|d| d.0 == input)),
            );
            let spans: Vec<Span> = giving.map(|place| file.place_span(place)).collect();
            let (first, last) = (spans.first().copied().unwrap_or_default(), spans.last().copied().unwrap_or_default());
            let message = format!("two devices drive the input `{}`", program.variable(input).name);
            let diagnostic = Diagnostic::new(Code::PlantInputAmbiguous, last, message);
            let diagnostic =
                if first == last { diagnostic } else { diagnostic.also(first, "no transition joins them") };
            errors.push(diagnostic.help("let one connected net hold all places that give this input a value"));
        }
    }
    if errors.is_empty() { Ok(devices) } else { Err(errors) }
}

/// Reports places that give the same inputs the same values: they mean the same but are two places, and the transitions
/// of one do not see a token on the other, which is spelt differently.
fn valuations_twice(file: &Located, meanings: &[Meaning]) -> Vec<Diagnostic> {
    let mut first: BTreeMap<Vec<(VarId, u64)>, PlaceId> = BTreeMap::new();
    let mut errors = Vec::new();
    for (place, meaning) in file.net.place_ids().zip(meanings) {
        let Meaning::Own(values) = meaning else { continue };
        let mut valuation = values.clone();
        valuation.sort_unstable();
        if valuation.is_empty() {
            continue;
        }
        let earlier = *first.entry(valuation).or_insert(place);
        if earlier == place {
            continue;
        }
        let (name, other) = (file.net.place(place).name, file.net.place(earlier).name);
        let message = format!("`{name}` and `{other}` are two places that stand for one valuation");
        errors.push(
            Diagnostic::new(Code::PlantValuationTwice, file.place_span(place), message)
                .also(file.place_span(earlier), "the other is this one")
                .help(format!("write `{other}` here, too; what else there is to remember belongs in internal places")),
        );
    }
    errors
}

/// Meaning of a place for the program; `position` is that of its diagnostic, if there will be one.
fn meaning(file: &Located, place: PlaceId, program: &FlatProgram, position: usize) -> Result<Meaning, Diagnostic> {
    let (name, span) = (file.net.place(place).name, file.place_span(place));
    let unfit = |message: String| Diagnostic::new(Code::PlantVariableUnfit, span, message);
    let assignments = match valuation::parse(name) {
        None => return Ok(Meaning::Own(Vec::new())),
        Some(Ok(assignments)) => assignments,
        Some(Err(piece)) => {
            let message = format!("`{piece}` gives no input or output a value");
            return Err(unfit(message).help("name the place like `S1=1,O1=0`, or without `=` if it is internal"));
        }
    };
    let mut values: Vec<(VarId, u64)> = Vec::new();
    for Assignment { text, variable: written, value } in assignments {
        let visible = || program.with_role(Role::Input).chain(program.with_role(Role::Output));
        let Some(variable) = program.find(written) else {
            let message = format!("the program `{}` has no input or output `{written}`", program.name);
            let names = visible().map(|id| program.variable(id).name.as_str());
            let unknown = Diagnostic::new(Code::PlantVariableUnknown, span, message);
            return Err(unknown.suggest_at(position, written, names));
        };
        if values.iter().any(|&(earlier, _)| earlier == variable) {
            return Err(unfit(format!("`{written}` stands twice in one place name")));
        }
        let role = program.variable(variable).role;
        if !matches!(role, Role::Input | Role::Output) {
            let message = format!("`{written}` is neither an input nor an output of the program");
            return Err(
                unfit(message).help("a plant drives inputs and reads outputs; it cannot see inside the program")
            );
        }
        if values.first().is_some_and(|&(first, _)| program.variable(first).role != role) {
            let message = "a place cannot stand for inputs and outputs at once".to_owned();
            return Err(unfit(message).help("give the inputs a place, and read the outputs by another"));
        }
        match pattern(program, variable, value) {
            Some(pattern) => values.push((variable, pattern)),
            None => {
                let help = if program.variable(variable).ty.is_bool() {
                    "name the place like `S1=1,O1=0`, or without `=` if it is internal".to_owned()
                } else {
                    let (least, greatest) = program.range(variable);
                    format!(
                        "`{written}` is of type {}: its values are {least} to {greatest}",
                        program.variable(variable).ty
                    )
                };
                return Err(unfit(format!("`{text}` gives no input or output a value")).help(help));
            }
        }
    }
    if values.first().is_none_or(|&(first, _)| program.variable(first).role == Role::Input) {
        return Ok(Meaning::Own(values));
    }
    let is_so = |&(output, value): &(VarId, u64)| program.variable(output).initial == value;
    if file.net.place(place).is_marked() && !values.iter().all(is_so) {
        let message = format!("`{name}` is marked, but the program does not begin with these outputs");
        return Err(unfit(message).help("leave it unmarked: the program decides when it is marked"));
    }
    Ok(Meaning::Test(values))
}

/// Pattern of a value, if the variable can have it.
fn pattern(program: &FlatProgram, id: VarId, value: Value) -> Option<u64> {
    let variable = program.variable(id);
    let ty = variable.ty;
    let (least, greatest) = program.range(id);
    let number = match value {
        Value::Truth(truth) => Some(i128::from(truth)).filter(|_| ty.is_bool())?,
        Value::Number(number) => Some(number).filter(|number| (least..=greatest).contains(number))?,
    };
    let pattern = ty.pattern(number);
    // Bits that are not stored are 0.
    (pattern.checked_shr(variable.bits).unwrap_or(0) == 0).then_some(pattern)
}

/// Names that a component gives to nodes of the system net, and its own.
fn names(component: &Component) -> impl Iterator<Item = &str> {
    let places = component.places.iter().map(|place| place.name.as_str());
    let transitions = component.transitions.iter().map(|transition| transition.name.as_str());
    places.chain(transitions).chain([component.name.as_str()])
}

/// Splits a net into its connected components. Places of outputs connect nothing.
fn split(file: &Located, meanings: &[Meaning], errors: &mut Vec<Diagnostic>) -> Vec<Device> {
    let net = &file.net;
    let offset = net.places().len();
    let is_own = |place: &PlaceId| matches!(meanings[place.index()], Meaning::Own(_));
    let mut classes = UnionFind::new(offset + net.transitions().len());
    for id in net.transition_ids() {
        let Arcs { consume, produce, read } = net.arcs(id);
        for place in consume.iter().chain(produce).chain(read).filter(|place| is_own(place)) {
            classes.union(place.index(), offset + id.index());
        }
        if let Some(&written) = consume.iter().chain(produce).find(|place| !is_own(place)) {
            let message = format!("the transition `{}` changes an output of the program", net.transition(id).name);
            errors.push(
                Diagnostic::new(Code::PlantWritesProgram, file.transition_span(id), message)
                    .also(file.place_span(written), "this place stands for the program's output")
                    .help("only read it: in TINA's format with `?1`, in PNML with a loop"),
            );
        }
    }
    // Components in the order of their first place; a transition without places of the plant is one of its own.
    let mut components: Vec<(Vec<PlaceId>, Vec<TransitionId>)> = Vec::new();
    let mut component_of = BTreeMap::new();
    let mut member = |node: usize, components: &mut Vec<_>| -> usize {
        *component_of.entry(classes.find(node)).or_insert_with(|| {
            components.push(Default::default());
            components.len() - 1
        })
    };
    // Position of each place in its component.
    let mut position = vec![0; offset];
    for place in net.place_ids().filter(is_own) {
        let component = member(place.index(), &mut components);
        position[place.index()] = components[component].0.len();
        components[component].0.push(place);
    }
    for id in net.transition_ids() {
        let component = member(offset + id.index(), &mut components);
        components[component].1.push(id);
    }
    let several = components.len() > 1;
    let qualified = |name: &str| format!("{}.{name}", net.name());
    let positions =
        |list: &[PlaceId]| list.iter().filter(|place| is_own(place)).map(|place| position[place.index()]).collect();
    let place = |&id: &PlaceId| PlantPlace {
        name: qualified(net.place(id).name),
        marked: net.place(id).is_marked(),
        drives: meanings[id.index()].values().to_vec(),
    };
    let transition = |&id: &TransitionId| {
        let Arcs { consume, produce, read } = net.arcs(id);
        let tests = read.iter().filter(|place| !is_own(place)).flat_map(|place| meanings[place.index()].values());
        PlantTransition {
            name: qualified(net.transition(id).name),
            consume: positions(consume),
            produce: positions(produce),
            read: positions(read),
            tests: tests.copied().collect(),
        }
    };
    (components.into_iter().enumerate())
        .map(|(i, (places, transitions))| {
            let component = Component {
                name: if several { format!("{}.{}", net.name(), i + 1) } else { net.name().to_owned() },
                places: places.iter().map(place).collect(),
                transitions: transitions.iter().map(transition).collect(),
                markings: Vec::new(),
            };
            Device { component, places, transitions }
        })
        .collect()
}

//! Composition of program, PLC cycle and plant in one net (seed paper, figures 7, 8, 10 and 11).

use std::ops::Range;
use std::sync::OnceLock;

use super::copy::{self, Source, Way};
use super::domain::{Domain, Domains};
use super::instruction;
use super::plant::{Component, Plant};
use super::provenance::{Part, PlaceRole, TransitionRole};
use super::subnet::Subnet;
use super::weaver::{Bit, Weaver, Woven};
use petril_base::Rows;
use petril_lang::flat::FlatProgram;
use petril_lang::semantics::{Role, VarId};
use petril_net::net::{Arcs, Net, PlaceId, TransitionId};

/// Program in its plant, with the net of both.
#[derive(Clone, Debug)]
pub struct System {
    /// Program as flat code.
    pub program: FlatProgram,
    /// Environment of the program. Inputs that no plant drives are free: they have any value in any scan.
    pub plant: Plant,
    /// Domains of free inputs, where they are not the whole type.
    pub domains: Domains,
    /// Composed net, safe by construction.
    pub net: Net,
    /// Role of each place.
    pub places: Vec<PlaceRole>,
    /// Role of each transition.
    pub transitions: Vec<TransitionRole>,
    /// Control place of each line, that of `End` the last.
    lines: Vec<PlaceId>,
    /// Position of the first place added for each line; last, of the first one added for the PLC's cycle.
    within: Vec<usize>,
    /// Bits of each variable.
    variables: Vec<Vec<Bit>>,
    /// Bits of the current result.
    result: Vec<Bit>,
    /// For each place, the transitions that move control from it; last, those that do not move control. Built on first
    /// use.
    moves: OnceLock<Rows<TransitionId>>,
}

impl System {
    /// Composes a program and its plant; free inputs have any value of their types.
    #[must_use]
    pub fn new(program: FlatProgram, plant: Plant) -> Self {
        Self::with_domains(program, plant, Domains::new())
    }

    /// Composes a program and its plant; free inputs have the values of their domains.
    #[must_use]
    pub fn with_domains(program: FlatProgram, plant: Plant, mut domains: Domains) -> Self {
        declared_domains(&program, &plant, &mut domains);
        let mut weaver = Weaver::new(&program.name);
        let lines = user_places(&mut weaver, &program);
        let mut within = Vec::with_capacity(lines.len());
        for (line, code) in program.code.iter().enumerate() {
            within.push(weaver.place_count());
            instruction::translate(&mut Subnet::new(&mut weaver, line, &lines), code.instruction);
        }
        within.push(weaver.place_count());
        system_program(&mut weaver, &program, &plant, &domains, (lines[0], lines[program.end()]));
        let Woven { net, places, transitions, variables, result } = weaver.build();
        let moves = OnceLock::new();
        Self { program, plant, domains, net, places, transitions, lines, within, variables, result, moves }
    }

    /// Combines a program and its plant without their net, which is left empty: for runs of scans only, thousands of
    /// which may take less time than the net.
    #[must_use]
    pub fn without_net(program: FlatProgram, plant: Plant, mut domains: Domains) -> Self {
        declared_domains(&program, &plant, &mut domains);
        let Woven { net, places, transitions, variables, result } = Weaver::new(&program.name).build();
        let (lines, within, moves) = (Vec::new(), Vec::new(), OnceLock::new());
        Self { program, plant, domains, net, places, transitions, lines, within, variables, result, moves }
    }

    /// Place with a role that only one place can have; `None` if no place has it, such as a hazard that cannot happen
    /// in the line.
    #[must_use]
    pub fn find(&self, role: PlaceRole) -> Option<PlaceId> {
        let among = |mut places: Range<usize>| places.find(|&place| self.places[place] == role).map(PlaceId::at);
        match role {
            PlaceRole::Bit { variable, bit, value } => {
                Some(self.variables.get(variable.0)?.get(bit as usize)?.place(value))
            }
            PlaceRole::Result { bit, value } => Some(self.result.get(bit as usize)?.place(value)),
            PlaceRole::Line(line) => self.lines.get(line).copied(),
            PlaceRole::Within(line, _) | PlaceRole::Hazard(line, _) => {
                among(*self.within.get(line)?..*self.within.get(line + 1)?)
            }
            PlaceRole::Register { .. } => among(0..self.places.len()),
            _ => among(*self.within.last()?..self.places.len()),
        }
    }

    /// Value of a variable in a marking, given by `is_marked`. `None` unless exactly one place of each of its bits is
    /// marked.
    pub fn value(&self, variable: VarId, is_marked: impl Fn(PlaceId) -> bool) -> Option<u64> {
        pattern(&self.variables[variable.0], is_marked)
    }

    /// Value of the lowest `width` bits of the current result; see [`System::value`].
    pub fn result(&self, width: u32, is_marked: impl Fn(PlaceId) -> bool) -> Option<u64> {
        pattern(&self.result[..width as usize], is_marked)
    }

    /// Number of bits of the current result: that of the widest type the program works with.
    #[must_use]
    pub fn result_width(&self) -> u32 {
        self.result.len() as u32
    }

    /// Places for 0 and 1 of each stored bit of a variable, from the lowest.
    pub fn bits(&self, variable: VarId) -> impl ExactSizeIterator<Item = [PlaceId; 2]> {
        self.variables[variable.0].iter().map(|bit| bit.places())
    }

    /// Transitions that take the control token from a place, or read it there: a jump to its own line.
    #[must_use]
    pub fn moves(&self, control: PlaceId) -> &[TransitionId] {
        &self.all_moves()[control.index()]
    }

    /// Transitions that do not move control: those of the plant.
    #[must_use]
    pub fn plant_moves(&self) -> &[TransitionId] {
        &self.all_moves()[self.places.len()]
    }

    fn all_moves(&self) -> &Rows<TransitionId> {
        let from = |id| {
            let control = self.net.arcs(id).preset().find(|place| self.places[place.index()].is_control());
            (control.map_or(self.places.len(), PlaceId::index), id)
        };
        self.moves.get_or_init(|| Rows::group(self.places.len() + 1, self.net.transition_ids().map(from)))
    }

    /// Place with a role that only one place can have.
    ///
    /// # Panics
    /// If no place has the role, as for a line that the program does not have.
    #[must_use]
    pub fn place(&self, role: PlaceRole) -> PlaceId {
        self.find(role).expect("only roles that have a place are asked for")
    }

    /// Numbers of places and transitions of a part.
    #[must_use]
    pub fn size(&self, part: Part) -> (usize, usize) {
        let places = self.places.iter().filter(|role| role.part() == part).count();
        let transitions = self.transitions.iter().filter(|role| role.part() == part).count();
        (places, transitions)
    }

    /// Inputs that no plant drives.
    pub fn free_inputs(&self) -> impl Iterator<Item = VarId> {
        self.program.with_role(Role::Input).filter(|&input| self.plant.driver(input).is_none())
    }

    /// Domain of a free input.
    #[must_use]
    pub fn domain(&self, input: VarId) -> Domain {
        self.domains.get(&input).cloned().unwrap_or_else(|| Domain::all(self.program.variable(input).ty))
    }

    /// Transitions with a role.
    pub fn transitions_of(&self, role: TransitionRole) -> impl Iterator<Item = TransitionId> {
        self.net.transition_ids().filter(move |id| self.transitions[id.index()] == role)
    }
}

/// Value of some bits, from the lowest.
fn pattern(bits: &[Bit], is_marked: impl Fn(PlaceId) -> bool) -> Option<u64> {
    bits.iter().enumerate().try_fold(0, |pattern, (position, bit)| {
        let one = is_marked(bit.place(true));
        (one != is_marked(bit.place(false))).then_some(pattern | u64::from(one) << position)
    })
}

/// Adds the bits of the program and its control places, one for each line and `End`; returns the control places.
fn user_places(weaver: &mut Weaver, program: &FlatProgram) -> Vec<PlaceId> {
    program.variables.iter().for_each(|variable| weaver.add_variable(variable));
    // An apostrophe is in no IL name, so this one is free if `CR` is not.
    let taken = program.variables.iter().any(|variable| variable.name == "CR");
    let width = program.code.iter().map(|line| instruction::width(&line.instruction)).max();
    weaver.add_result(if taken { "CR'" } else { "CR" }, width.unwrap_or(1));
    (0..=program.end())
        .map(|line| {
            let name = if line == program.end() { "End".to_owned() } else { format!("line_{}", line + 1) };
            weaver.place(&name, false, PlaceRole::Line(line))
        })
        .collect()
}

/// Adds the PLC's cycle: `block` stops the plant, the inputs are copied one after another, the program runs from
/// `begin` to `end`, `unblock` lets the plant move again.
fn system_program(
    weaver: &mut Weaver,
    program: &FlatProgram,
    plant: &Plant,
    domains: &Domains,
    (begin, end): (PlaceId, PlaceId),
) {
    let idle = weaver.place("idle", true, PlaceRole::Idle);
    let inputs: Vec<VarId> = program.with_role(Role::Input).collect();
    let mut control: Vec<PlaceId> = inputs
        .iter()
        .map(|&input| weaver.place(&format!("copy_{}", program.variable(input).name), false, PlaceRole::Copy(input)))
        .collect();
    control.push(begin);
    let blocking: Vec<Option<PlaceId>> =
        (plant.components.iter().enumerate()).map(|(i, component)| component.add_blocking_place(weaver, i)).collect();
    let plant_places: Vec<Vec<PlaceId>> =
        (plant.components.iter().enumerate()).map(|(i, component)| component.add_places(weaver, i)).collect();

    let idle_and_free: Vec<PlaceId> = blocking.iter().flatten().copied().chain([idle]).collect();
    let block = Arcs { consume: &idle_and_free, produce: &[control[0]], read: &[] };
    weaver.transition("block", block, TransitionRole::Block);
    for (k, &input) in inputs.iter().enumerate() {
        let way = Way { from: control[k], to: control[k + 1] };
        match plant.driver(input) {
            Some(driver) => {
                let sources = sources(&plant.components[driver], &plant_places[driver], input);
                copy::driven(weaver, program, input, &sources, way);
            }
            None => {
                let all = Domain::all(program.variable(input).ty);
                copy::free(weaver, program, input, domains.get(&input).unwrap_or(&all), way);
            }
        }
    }
    let unblock = Arcs { consume: &[end], produce: &idle_and_free, read: &[] };
    weaver.transition("unblock", unblock, TransitionRole::Unblock);
    for (i, component) in plant.components.iter().enumerate() {
        component.add_transitions(weaver, i, &plant_places[i], blocking[i]);
    }
}

/// Places of a component that give an input its external value.
fn sources(component: &Component, places: &[PlaceId], input: VarId) -> Vec<Source> {
    let giving = component.places.iter().zip(places);
    giving
        .filter_map(|(place, &id)| {
            let &(_, pattern) = place.drives.iter().find(|&&(variable, _)| variable == input)?;
            Some(Source { place: id, name: place.name.clone(), pattern })
        })
        .collect()
}

/// Adds domains for free inputs that have none: the values that their declarations allow.
fn declared_domains(program: &FlatProgram, plant: &Plant, domains: &mut Domains) {
    for (&input, restriction) in &program.restrictions {
        let variable = program.variable(input);
        if variable.role == Role::Input && plant.driver(input).is_none() && !domains.contains_key(&input) {
            domains.extend(Domain::new(variable.ty, vec![restriction.range()]).map(|domain| (input, domain)));
        }
    }
}

//! Program, PLC cycle and plant as one net (seed paper, figures 7, 8, 10 and 11).

use std::collections::BTreeMap;

use super::domain::{Domain, Domains};
use super::plant::{Component, Plant};
use super::provenance::{Part, PlaceRole, TransitionRole};
use super::weaver::{Subnet, VALUES, Weaver};
use super::{combine, complement, jump, load, set_reset, store};
use crate::flat::{FlatProgram, Instruction, Target};
use crate::net::{Arcs, Net, PlaceId, TransitionId};
use crate::semantics::{Role, VarId};

/// A program in its plant, and the net of both.
#[derive(Clone, Debug)]
pub struct System {
    /// The program.
    pub program: FlatProgram,
    /// Its environment. Inputs no plant drives are free: they have any value in any scan.
    pub plant: Plant,
    /// The values of free inputs, where they are not all of their type.
    pub domains: Domains,
    /// The composed net, safe by construction.
    pub net: Net,
    /// What each place stands for.
    pub places: Vec<PlaceRole>,
    /// What each transition stands for.
    pub transitions: Vec<TransitionRole>,
    /// The place of each role but [`PlaceRole::Plant`].
    by_role: BTreeMap<PlaceRole, PlaceId>,
}

impl System {
    /// Composes a program and its plant; free inputs have any value of their types.
    #[must_use]
    pub fn new(program: FlatProgram, plant: Plant) -> Self {
        Self::with_domains(program, plant, Domains::new())
    }

    /// Composes a program and its plant; free inputs have the values of their domains.
    #[must_use]
    pub fn with_domains(program: FlatProgram, plant: Plant, domains: Domains) -> Self {
        let mut weaver = Weaver::new(&program.name);
        let lines = user_places(&mut weaver, &program);
        for (line, code) in program.code.iter().enumerate() {
            instruction(&mut Subnet::new(&mut weaver, line, &lines), code.instruction);
        }
        system_program(&mut weaver, &program, &plant, lines[0], lines[program.end()]);
        let (net, places, transitions) = weaver.build();
        let by_role = places.iter().copied().zip(net.place_ids()).collect();
        Self { program, plant, domains, net, places, transitions, by_role }
    }

    /// The place of a role that only one place has.
    ///
    /// # Panics
    /// If there is none, as for a line the program does not have.
    #[must_use]
    pub fn place(&self, role: PlaceRole) -> PlaceId {
        self.by_role[&role]
    }

    /// How many places and transitions belong to a part.
    #[must_use]
    pub fn size(&self, part: Part) -> (usize, usize) {
        let places = self.places.iter().filter(|role| role.part() == part).count();
        let transitions = self.transitions.iter().filter(|role| role.part() == part).count();
        (places, transitions)
    }

    /// The inputs no plant drives.
    pub fn free_inputs(&self) -> impl Iterator<Item = VarId> {
        self.program.with_role(Role::Input).filter(|&input| self.plant.driver(input).is_none())
    }

    /// The values of a free input.
    #[must_use]
    pub fn domain(&self, input: VarId) -> Domain {
        self.domains.get(&input).cloned().unwrap_or_else(|| Domain::all(self.program.variable(input).ty))
    }

    /// The transitions of a role.
    pub fn transitions_of(&self, role: TransitionRole) -> impl Iterator<Item = TransitionId> {
        self.net.transition_ids().filter(move |id| self.transitions[id.index()] == role)
    }
}

/// The bits of the program and its control places, one for each line and `End`.
fn user_places(weaver: &mut Weaver, program: &FlatProgram) -> Vec<PlaceId> {
    for (i, variable) in program.variables.iter().enumerate() {
        weaver.add_variable(VarId(i), &variable.name, variable.initial == 1);
    }
    // An apostrophe is in no IL name, so this one is free if `CR` is not.
    let taken = program.variables.iter().any(|variable| variable.name == "CR");
    weaver.add_result(if taken { "CR'" } else { "CR" });
    (0..=program.end())
        .map(|line| {
            let name = if line == program.end() { "End".to_owned() } else { format!("line_{}", line + 1) };
            weaver.place(&name, false, PlaceRole::Line(line))
        })
        .collect()
}

/// The subnet of an instruction (*Compute* in the seed paper, section 3.3).
fn instruction(subnet: &mut Subnet<'_>, instruction: Instruction) {
    match instruction {
        Instruction::Load { negated, operand, .. } => load::translate(subnet, negated, operand),
        Instruction::Store { negated, target: Target::Variable(variable), .. } => {
            store::translate(subnet, negated, variable);
        }
        Instruction::Set(Target::Variable(variable)) => set_reset::translate(subnet, variable, true),
        Instruction::Reset(Target::Variable(variable)) => set_reset::translate(subnet, variable, false),
        Instruction::Complement(_) => complement::translate(subnet),
        Instruction::Combine { function, negated, operand, .. } => {
            combine::translate(subnet, function, negated, operand);
        }
        Instruction::Jump { condition, target } => jump::translate(subnet, condition, target),
        _ => {}
    }
}

/// The PLC's cycle: `block` stops the plant, the inputs are copied one after another, the program runs from `begin` to
/// `end`, `unblock` lets the plant move again.
fn system_program(weaver: &mut Weaver, program: &FlatProgram, plant: &Plant, begin: PlaceId, end: PlaceId) {
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

    let stop = blocking.iter().flatten().copied().chain([idle]).collect();
    let block = Arcs { consume: stop, produce: vec![control[0]], read: vec![] };
    weaver.transition("block".to_owned(), block, TransitionRole::Block);
    for (k, &input) in inputs.iter().enumerate() {
        for (source, value) in sources(plant, &plant_places, input) {
            copy(weaver, program, input, source.as_ref(), value, (control[k], control[k + 1]));
        }
    }
    let go = blocking.iter().flatten().copied().chain([idle]).collect();
    let unblock = Arcs { consume: vec![end], produce: go, read: vec![] };
    weaver.transition("unblock".to_owned(), unblock, TransitionRole::Unblock);
    for (i, component) in plant.components.iter().enumerate() {
        component.add_transitions(weaver, i, &plant_places[i], blocking[i]);
    }
}

/// Where an input's external value comes from: each plant place that gives it one, or, for a free input, either value from
/// nowhere.
fn sources(plant: &Plant, places: &[Vec<PlaceId>], input: VarId) -> Vec<(Option<(PlaceId, String)>, bool)> {
    let Some(driver) = plant.driver(input) else { return VALUES.map(|value| (None, value)).into() };
    let component: &Component = &plant.components[driver];
    let giving = component.places.iter().zip(&places[driver]);
    giving
        .filter_map(|(place, &id)| {
            let &(_, value) = place.drives.iter().find(|&&(variable, _)| variable == input)?;
            Some((Some((id, place.name.clone())), value == 1))
        })
        .collect()
}

/// The two transitions that give an input one external value, whatever it was (seed paper, figure 8).
fn copy(
    weaver: &mut Weaver,
    program: &FlatProgram,
    input: VarId,
    source: Option<&(PlaceId, String)>,
    value: bool,
    (from, to): (PlaceId, PlaceId),
) {
    let bit = weaver.variable(input);
    let name = &program.variable(input).name;
    for old in VALUES {
        let mut arcs = Arcs { consume: vec![from], produce: vec![to], read: vec![] };
        arcs.read.extend(source.map(|&(place, _)| place));
        arcs.consume.push(bit.place(old));
        arcs.produce.push(bit.place(value));
        let from = source.map(|(_, place)| format!(" from {place}")).unwrap_or_default();
        let label = format!("copy_{name}[{}->{}{from}]", u8::from(old), u8::from(value));
        weaver.transition(label, arcs, TransitionRole::Copy { variable: input, value });
    }
}

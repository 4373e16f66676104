//! The scan view: a state is the system at the end of a scan, a step is one scan.
//!
//! A state is packed as the marking of each plant component and the bits of each declared variable. Between two scans
//! the plant makes any number of moves and free inputs take any value of their domains; then the program runs, executed
//! by the interpreter or by gates. Intermediate states are not stored. Leaving out the current result and the buffers
//! is sound, because the static rules ensure that neither is read in a scan before it is written.
//!
//! A scan with a hazard has no successor, unless the hazard is tolerated: the behaviour of a PLC after it is unknown.

use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicBool, Ordering};

use super::free_inputs::FreeInputs;
use super::scan_lanes::Lanes;
use crate::scans::{Admission, Failure};
use crate::translate::{PlaceRole, System};
use petril_lang::circuit::Circuit;
use petril_lang::circuit::{Field, Layout};
use petril_lang::flat::{Tolerated, Variable};
use petril_lang::interpret::Machine;
use petril_lang::semantics::{Role, VarId};
use petril_net::net::PlaceId;
use petril_search::Graph;
use petril_search::{StateSpace, Step, Successors};
use smallvec::SmallVec;

/// State space of the scan view of a system.
pub struct ScanSpace<'s> {
    system: &'s System,
    tolerated: Tolerated,
    /// Field of each plant component's marking in a state.
    components: Vec<Field>,
    /// Position of each component's first place in the net; its other places follow.
    places: Vec<usize>,
    /// Field of each variable in a state; buffers have no bits.
    variables: Vec<(VarId, Field)>,
    free_inputs: FreeInputs,
    words: usize,
    /// Mask of the bits on which later scans depend: the plant's markings, the variables that carry values over, and
    /// the outputs that the plant reads.
    relevant: Vec<u64>,
    /// Scan as gates, if that is faster.
    circuit: Option<Circuit>,
    /// Assumptions about the inputs.
    admission: Option<&'s dyn Admission>,
    /// Whether the gates and the interpreter have disagreed.
    is_refuted: AtomicBool,
}

/// Unpacked scan state.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ScanState {
    /// Marking of each plant component, as a position in its list of markings.
    pub plant: Vec<usize>,
    /// Values of all variables of the program; those of buffers are meaningless.
    pub memory: Vec<u64>,
}

impl ScanState {
    /// The system at power-on, before the first scan. Not a state of the scan view.
    #[must_use]
    pub fn power_on(system: &System) -> Self {
        Self {
            plant: vec![0; system.plant.components.len()],
            memory: system.program.variables.iter().map(|variable| variable.initial).collect(),
        }
    }
}

/// A scan that was executed.
#[derive(Clone, Copy, Debug)]
pub struct ScanRun<'a> {
    /// Marking of each plant component during the scan.
    pub plant: &'a [usize],
    /// Machine at the end of the scan, or somewhere in the loop of an endless one.
    pub machine: &'a Machine<'a>,
    /// Packed state at the end of the scan, or the failure.
    pub end: Result<&'a [u64], Failure>,
}

impl<'s> ScanSpace<'s> {
    /// Makes the space of a system, with every hazard an error.
    #[must_use]
    pub fn new(system: &'s System) -> Self {
        Self::tolerating(system, Tolerated::default())
    }

    /// Makes the space of a system in which some hazards are not errors.
    #[must_use]
    pub fn tolerating(system: &'s System, tolerated: Tolerated) -> Self {
        Self::assuming(system, tolerated, None)
    }

    /// Makes the space of a system in which only admitted scans can begin.
    #[must_use]
    pub fn assuming(system: &'s System, tolerated: Tolerated, admission: Option<&'s dyn Admission>) -> Self {
        let mut layout = Layout::default();
        let width = |markings: usize| usize::BITS - (markings - 1).leading_zeros();
        let markings = system.plant.components.iter().map(|component| component.markings.len());
        let components: Vec<Field> = markings.map(|markings| layout.field(width(markings))).collect();
        let first = |component| system.places.iter().position(|role| *role == PlaceRole::Plant(component)).unwrap_or(0);
        let places = (0..components.len()).map(first).collect();
        let bits = |variable: &Variable| if variable.role == Role::Buffer { 0 } else { variable.bits };
        let fields = system.program.variables.iter().map(|variable| layout.field(bits(variable)));
        let variables: Vec<(VarId, Field)> = (0..).map(VarId).zip(fields).collect();
        let mut carried = system.program.carried();
        carried.extend(system.plant.tested().map(|output| output.0));
        carried.extend(admission.iter().flat_map(|admission| admission.recalls()).map(|variable| variable.0));
        let mut relevant = vec![0; layout.words()];
        let kept = variables.iter().filter(|(variable, _)| carried.contains(variable.0)).map(|(_, field)| field);
        components.iter().chain(kept).for_each(|field| field.set(&mut relevant, u64::MAX));
        let (free_inputs, words) = (FreeInputs::new(system), layout.words());
        let circuit = Circuit::of(&system.program, tolerated, &variables, words);
        let is_refuted = AtomicBool::new(false);
        Self {
            system,
            tolerated,
            components,
            places,
            variables,
            free_inputs,
            words,
            relevant,
            circuit,
            admission,
            is_refuted,
        }
    }

    /// The system explored.
    #[must_use]
    pub fn system(&self) -> &'s System {
        self.system
    }

    /// Whether scans are computed by gates, many at once; otherwise the interpreter runs them one after another.
    #[must_use]
    pub fn has_gates(&self) -> bool {
        self.circuit.is_some()
    }

    /// Unpacks a state.
    #[must_use]
    pub fn unpack(&self, state: &[u64]) -> ScanState {
        let mut memory = vec![0; self.system.program.variables.len()];
        for &(variable, field) in &self.variables {
            memory[variable.0] = field.get(state);
        }
        ScanState { plant: self.components.iter().map(|field| field.get(state) as usize).collect(), memory }
    }

    /// Value of a declared variable in a state.
    #[must_use]
    pub fn value(&self, state: &[u64], variable: VarId) -> u64 {
        self.variables[variable.0].1.get(state)
    }

    /// Whether a place of the plant or of a declared variable's bit is marked at the end of the scan; false for other
    /// places.
    #[must_use]
    pub fn is_marked(&self, state: &[u64], place: PlaceId) -> bool {
        match self.system.places[place.index()] {
            PlaceRole::Bit { variable, bit, value } => (self.value(state, variable) >> bit & 1 == 1) == value,
            PlaceRole::Plant(component) => {
                let marking = self.components[component].get(state) as usize;
                let own = place.index() - self.places[component];
                self.system.plant.components[component].markings[marking].marked.binary_search(&own).is_ok()
            }
            _ => false,
        }
    }

    /// Unpacked state of the graph of this space; `None` is power-on.
    #[must_use]
    pub(super) fn state(&self, id: Option<u32>, graph: &Graph) -> ScanState {
        id.map_or_else(|| self.power_on(), |id| self.unpack(graph.state(id)))
    }

    /// The system at power-on, before the first scan. Not a scan state.
    #[must_use]
    pub fn power_on(&self) -> ScanState {
        ScanState::power_on(self.system)
    }

    /// Packed form of the system at power-on.
    #[must_use]
    pub fn packed_power_on(&self) -> Vec<u64> {
        let mut state = vec![0; self.words];
        for &(variable, field) in &self.variables {
            field.set(&mut state, self.system.program.variable(variable).initial);
        }
        state
    }

    fn pack(&self, plant: &[usize], value: impl Fn(VarId) -> u64, state: &mut [u64]) {
        state.fill(0);
        self.components.iter().zip(plant).for_each(|(field, &marking)| field.set(state, marking as u64));
        self.variables.iter().for_each(|&(variable, field)| field.set(state, value(variable)));
    }

    /// Packs a state.
    pub(super) fn packed(&self, plant: &[usize], memory: &[u64]) -> Vec<u64> {
        let mut state = vec![0; self.words];
        self.pack(plant, |variable| memory[variable.0], &mut state);
        state
    }

    /// Circuit that computes which lines are executed in scans from [`ScanSpace::packed_beginnings`].
    pub(super) fn line_circuit(&self) -> Option<Circuit> {
        Circuit::of_lines(&self.system.program, self.tolerated, &self.variables, self.words)
    }

    /// Markings that each component can have when the next scan begins.
    fn plant_choices(&self, plant: impl Fn(usize) -> usize, output: impl Fn(VarId) -> u64) -> Vec<Vec<usize>> {
        let components = self.system.plant.components.iter().enumerate();
        components
            .map(|(number, component)| {
                let closure = component.closure(plant(number), &output);
                closure.into_iter().map(|(marking, _)| marking).collect()
            })
            .collect()
    }

    /// Whether a scan may begin with the values `now` after one that ended with the values `before`.
    pub(super) fn admits(&self, before: &dyn Fn(VarId) -> u64, now: &dyn Fn(VarId) -> u64) -> bool {
        self.admission.is_none_or(|admission| admission.admits(before, now))
    }

    /// Runs a scan on a machine whose inputs have been set.
    pub(super) fn scan(&self, machine: &mut Machine<'_>) -> Result<(), Failure> {
        let ended = machine.scan();
        match self.tolerated.first_error(machine.hazards()) {
            // The error comes before anything that keeps the scan from ending.
            Some((line, hazard)) => Err(Failure::Hazard(line, hazard)),
            None => ended.map_err(Failure::Scan),
        }
    }

    /// Calls `visit` with the scan from a state for each choice of plant markings and free inputs.
    pub fn scans(&self, from: &ScanState, visit: &mut dyn FnMut(ScanRun<'_>)) {
        let mut state = vec![0; self.words];
        self.beginnings(from, &mut |machine, plant| {
            let result = self.scan(machine);
            self.pack(plant, |variable| machine.value(variable), &mut state);
            visit(ScanRun { plant, machine, end: result.map(|()| state.as_slice()) });
        });
    }

    /// Calls `visit` with the machine before each scan from a state, its inputs set, and the plant's markings.
    pub(super) fn beginnings<'m>(&'m self, from: &ScanState, visit: &mut dyn FnMut(&mut Machine<'m>, &[usize])) {
        let choices = self.plant_choices(|component| from.plant[component], |output| from.memory[output.0]);
        let mut machine = Machine::new(&self.system.program);
        combinations(&choices, |plant| {
            self.free_inputs.for_each(|setting| {
                machine.restore(&from.memory);
                for (component, &marking) in self.system.plant.components.iter().zip(plant) {
                    component.markings[marking].inputs.iter().for_each(|&(input, value)| machine.set(input, value));
                }
                setting.values().for_each(|(input, value)| machine.set(input, value));
                if self.admits(&|id| from.memory[id.0], &|id| machine.value(id)) {
                    visit(&mut machine, plant);
                }
            });
        });
    }

    /// Calls `visit` with each packed state in which a scan from a packed state begins.
    pub(super) fn packed_beginnings(&self, from: &[u64], mut visit: impl FnMut(&[u64])) {
        let field = |input: VarId| self.variables[input.0].1;
        let mut begin: SmallVec<[u64; 8]> = SmallVec::from_slice(from);
        combinations(&self.packed_choices(from), |plant| {
            let components = self.system.plant.components.iter().zip(&self.components).zip(plant);
            for ((component, own), &marking) in components {
                own.set(&mut begin, marking as u64);
                let inputs = &component.markings[marking].inputs;
                inputs.iter().for_each(|&(input, value)| field(input).set(&mut begin, value));
            }
            self.free_inputs.for_each(|setting| {
                setting.changed().for_each(|(input, value)| field(input).set(&mut begin, value));
                if self.admits(&|id| self.value(from, id), &|id| self.value(&begin, id)) {
                    visit(&begin);
                }
            });
        });
    }

    fn packed_choices(&self, from: &[u64]) -> Vec<Vec<usize>> {
        let plant = |component: usize| self.components[component].get(from) as usize;
        self.plant_choices(plant, |output| self.value(from, output))
    }

    /// Checks that the interpreter ends a scan from a packed state in the same way. If not, the space is refused from
    /// now on.
    pub(super) fn confirm(&self, begin: &[u64], end: Result<&[u64], Failure>) {
        let mut machine = Machine::new(&self.system.program);
        machine.restore(&self.unpack(begin).memory);
        let mut expected = begin.to_vec();
        let ended = self.scan(&mut machine);
        self.variables.iter().for_each(|&(variable, field)| field.set(&mut expected, machine.value(variable)));
        if ended.map(|()| expected.as_slice()) != end {
            self.is_refuted.store(true, Ordering::Relaxed);
        }
    }
}

/// Calls `each` with each choice of one element from each list; the last list changes fastest.
fn combinations(lists: &[Vec<usize>], mut each: impl FnMut(&[usize])) {
    let mut digits = vec![0; lists.len()];
    let mut chosen = vec![0; lists.len()];
    loop {
        for (chosen, (list, &digit)) in chosen.iter_mut().zip(lists.iter().zip(&digits)) {
            *chosen = list[digit];
        }
        each(&chosen);
        let Some(turn) = digits.iter().zip(lists).rposition(|(&digit, list)| digit + 1 < list.len()) else { return };
        digits[turn] += 1;
        digits[turn + 1..].fill(0);
    }
}

impl StateSpace for ScanSpace<'_> {
    fn words(&self) -> usize {
        self.words
    }

    fn initial(&self, visit: &mut dyn FnMut(Step<'_>)) {
        self.scans(&self.power_on(), &mut |run| visit(step(run.end)));
    }

    fn successors(&self, state: &[u64], visit: &mut dyn FnMut(Step<'_>)) {
        self.scans(&self.unpack(state), &mut |run| visit(step(run.end)));
    }

    fn expand(&self, states: &[u64], into: &mut Successors) {
        let Some(circuit) = &self.circuit else {
            for state in states.chunks_exact(self.words) {
                self.successors(state, &mut |step| into.add(step));
                into.finish();
            }
            return;
        };
        let mut lanes = Lanes::new(self, circuit, self.words);
        for state in states.chunks_exact(self.words) {
            self.packed_beginnings(state, |begin| lanes.add(begin, into));
            lanes.finish();
        }
        lanes.run(into);
    }

    fn relevant(&self) -> Option<&[u64]> {
        Some(&self.relevant)
    }

    fn fan_out(&self, state: Option<&[u64]>) -> u64 {
        let free = u64::try_from(self.free_inputs.combinations()).unwrap_or(u64::MAX);
        let choices = match state {
            Some(state) => self.packed_choices(state),
            None => self.plant_choices(|_| 0, |output| self.system.program.variable(output).initial),
        };
        choices.iter().fold(free, |product, choice| product.saturating_mul(choice.len() as u64))
    }

    fn refusal(&self) -> Option<String> {
        if self.is_refuted.load(Ordering::Relaxed) {
            return Some(
                "two ways to compute a scan disagree, which is an error in Petril; please report it".to_owned(),
            );
        }
        self.free_inputs.refusal()
    }
}

fn step(end: Result<&[u64], Failure>) -> Step<'_> {
    match end {
        Ok(state) => Step::To(state),
        Err(failure) => Step::Fails(failure.into()),
    }
}

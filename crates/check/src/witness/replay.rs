//! Replay: the token game and the interpreter side by side.

use std::fmt;

use crate::scans::ScanState;
use crate::translate::{PlaceRole, System, TransitionRole};
use petril_lang::flat::{Hazard, Target};
use petril_lang::interpret::Machine;
use petril_lang::semantics::{Role, Type, VarId};
use petril_logic::{Bound, Valuation};
use petril_net::net::{Marking, PlaceId, TransitionId};

/// Disagreement between net, interpreter and search. One of them is wrong, so there is no verdict.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Disagreement(pub String);

impl fmt::Display for Disagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// A run of a system, both as firings and as instructions executed.
#[derive(Clone, Debug)]
pub struct Replay<'s> {
    system: &'s System,
    marking: Marking,
    /// Place that holds the control token.
    control: PlaceId,
    machine: Machine<'s>,
    /// Type of the current result after the last instruction; only its bits have a meaning.
    given: Type,
    /// Hazards whose places control has passed within this line.
    passed: Vec<Hazard>,
    /// Hazards met since the scan began, each with its line.
    hazards: Vec<(usize, Hazard)>,
    compared: Compared,
}

/// Values on which net and interpreter agree. A value that neither has changed is not compared again.
#[derive(Clone, Debug)]
struct Compared {
    result: (Type, u64),
    /// Variables with a bit whose token has moved since the last comparison.
    touched: Vec<VarId>,
    /// Whether all are to be looked at.
    is_all_touched: bool,
    /// Whether a token of the current result has moved since the last comparison.
    is_result_touched: bool,
}

impl Compared {
    /// Nothing was compared yet.
    fn nothing() -> Self {
        Self { result: (Type::BOOL, 0), touched: Vec::new(), is_all_touched: true, is_result_touched: true }
    }
}

impl<'s> Replay<'s> {
    /// Starts at power-on, with control in `idle`.
    #[must_use]
    pub fn new(system: &'s System) -> Self {
        Self {
            system,
            marking: system.net.initial_marking(),
            control: system.place(PlaceRole::Idle),
            machine: Machine::new(&system.program),
            given: Type::BOOL,
            passed: Vec::new(),
            hazards: Vec::new(),
            compared: Compared::nothing(),
        }
    }

    /// Starts at the end of a scan, with control in `idle`.
    #[must_use]
    pub fn after(system: &'s System, state: &ScanState) -> Self {
        let mut replay = Self::new(system);
        replay.machine.restore(&state.memory);
        for (variable, &value) in (0..).map(VarId).zip(&state.memory) {
            for (bit, places) in system.bits(variable).enumerate() {
                replay.marking.put(places[0], value >> bit & 1 == 0);
                replay.marking.put(places[1], value >> bit & 1 == 1);
            }
        }
        let mut positions = vec![0; state.plant.len()];
        for place in system.net.place_ids() {
            if let PlaceRole::Plant(component) = system.places[place.index()] {
                let marking = &system.plant.components[component].markings[state.plant[component]];
                replay.marking.put(place, marking.marked.binary_search(&positions[component]).is_ok());
                positions[component] += 1;
            }
        }
        replay
    }

    /// Role of the control place.
    #[must_use]
    pub fn control(&self) -> PlaceRole {
        self.system.places[self.control.index()]
    }

    /// Current result of the interpreter, with the type given by the last instruction.
    #[must_use]
    pub fn typed_result(&self) -> (Type, u64) {
        (self.given, self.machine.result() & self.given.mask())
    }

    /// Transitions that move control from its place, enabled or not.
    #[must_use]
    pub fn ways(&self) -> &'s [TransitionId] {
        self.system.moves(self.control)
    }

    /// Current marking.
    #[must_use]
    pub fn marking(&self) -> &Marking {
        &self.marking
    }

    /// Whether the place of a role is marked.
    #[must_use]
    pub fn is_at(&self, role: PlaceRole) -> bool {
        self.marking.is_marked(self.system.place(role))
    }

    /// Fires a transition. When control reaches a line, the net has executed the previous instruction; the interpreter
    /// then executes it too, and both are compared.
    ///
    /// # Errors
    /// The transition is not enabled, the net not safe, or net and interpreter differ afterwards.
    pub fn fire(&mut self, transition: TransitionId) -> Result<(), Disagreement> {
        let net = &self.system.net;
        if !net.is_enabled(&self.marking, transition) {
            return Err(Disagreement(format!("`{}` is not enabled", net.transition(transition).name)));
        }
        self.fire_enabled(transition)
    }

    fn fire_enabled(&mut self, transition: TransitionId) -> Result<(), Disagreement> {
        let net = &self.system.net;
        let name = || net.transition(transition).name;
        net.fire(&mut self.marking, transition).map_err(|petril_net::net::NotSafe(place)| {
            Disagreement(format!("`{}` marks `{}` twice", name(), net.place(place).name))
        })?;
        let (places, arcs) = (&self.system.places, net.arcs(transition));
        for place in arcs.consume.iter().chain(arcs.produce) {
            match places[place.index()] {
                PlaceRole::Bit { variable, .. } => self.compared.touched.push(variable),
                PlaceRole::Result { .. } => self.compared.is_result_touched = true,
                _ => {}
            }
        }
        let arrived = arcs.produce.iter().find(|place| places[place.index()].is_control());
        self.control = arrived.copied().unwrap_or(self.control);
        self.follow(transition)?;
        if self.is_within_line() {
            return Ok(());
        }
        self.compare().map_err(|what| Disagreement(format!("after `{}`, net and interpreter differ in {what}", name())))
    }

    /// Lets the interpreter follow a transition that has been fired.
    fn follow(&mut self, transition: TransitionId) -> Result<(), Disagreement> {
        match self.system.transitions[transition.index()] {
            TransitionRole::Block => {
                self.hazards.clear();
                self.machine.begin_scan();
                self.compared.is_all_touched = true;
            }
            TransitionRole::Copy { variable, bit, value } => {
                let others = self.machine.value(variable) & !(1 << bit);
                self.machine.set(variable, others | u64::from(value) << bit);
                self.compared.touched.push(variable);
            }
            TransitionRole::Line(line) if line == self.machine.line() => match self.system.places[self.control.index()]
            {
                PlaceRole::Line(_) => return self.execute(line),
                PlaceRole::Hazard(_, hazard) => self.passed.push(hazard),
                _ => {}
            },
            TransitionRole::Line(line) => {
                let expected = self.machine.line() + 1;
                return Err(Disagreement(format!(
                    "the net executes line {}, the interpreter line {expected}",
                    line + 1
                )));
            }
            TransitionRole::Unblock | TransitionRole::Plant { .. } => {}
        }
        Ok(())
    }

    /// Executes a line by the interpreter, after the net has finished it. Both must have met the same hazard.
    fn execute(&mut self, line: usize) -> Result<(), Disagreement> {
        let instruction = &self.system.program.code[line].instruction;
        self.given = instruction.gives().unwrap_or(self.given);
        match instruction.writes() {
            Some(Target::Variable(variable)) => self.compared.touched.push(variable),
            Some(Target::Element(element)) => {
                let index = self.machine.value(element.index);
                let written = usize::try_from(index).ok().filter(|&index| index < element.length);
                self.compared.touched.extend(written.map(|index| element.at(index)));
                self.compared.is_all_touched |= written.is_none();
            }
            None => {}
        }
        let met: Vec<Hazard> = self.machine.step().into_iter().collect();
        self.compared.is_all_touched |= self.machine.line() >= self.system.program.end();
        let passed = std::mem::take(&mut self.passed);
        self.hazards.extend(met.iter().map(|&hazard| (line, hazard)));
        if met == passed {
            return Ok(());
        }
        let names = |hazards: &[Hazard]| hazards.iter().map(Hazard::to_string).collect::<Vec<_>>().join(", ");
        Err(Disagreement(format!(
            "in line {}, the interpreter meets the hazards [{}], the net [{}]",
            line + 1,
            names(&met),
            names(&passed)
        )))
    }

    /// Whether control is between two steps of one instruction.
    #[must_use]
    pub fn is_within_line(&self) -> bool {
        matches!(self.system.places[self.control.index()], PlaceRole::Within(..) | PlaceRole::Hazard(..))
    }

    /// Fires the only enabled transition among those with these roles.
    ///
    /// # Errors
    /// Not exactly one is enabled, or [`Replay::fire`] fails.
    pub fn fire_only(&mut self, of: impl Fn(TransitionRole) -> bool) -> Result<TransitionId, Disagreement> {
        let system = self.system;
        let candidates = system.moves(self.control).iter().chain(system.plant_moves()).copied();
        let candidates = candidates.filter(|id| of(system.transitions[id.index()]));
        let mut enabled = candidates.filter(|&id| system.net.is_enabled(&self.marking, id));
        let (first, others) = (enabled.next(), enabled.count());
        let Some(only) = first.filter(|_| others == 0) else {
            let enabled = others + usize::from(first.is_some());
            return Err(Disagreement(format!("{enabled} transitions are enabled where one should be")));
        };
        self.fire_enabled(only)?;
        Ok(only)
    }

    /// Compares all bits of the variables and the current result that either side may have changed.
    fn compare(&mut self) -> Result<(), String> {
        let (system, marking) = (self.system, &self.marking);
        let is_marked = |place| marking.is_marked(place);
        let (now, Compared { touched, is_all_touched, .. }) = (self.machine.memory(), &mut self.compared);
        if std::mem::take(is_all_touched) {
            touched.clear();
            touched.extend((0..now.len()).map(VarId));
        }
        touched.sort_unstable();
        for &variable in &*touched {
            if system.value(variable, is_marked) != Some(now[variable.0]) {
                return Err(format!("`{}`", system.program.variable(variable).name));
            }
        }
        touched.clear();
        let (given, result) = self.typed_result();
        if self.compared.is_result_touched || self.compared.result != (given, result) {
            if system.result(given.width, is_marked) != Some(result) {
                return Err("the current result".to_owned());
            }
            self.compared.is_result_touched = false;
            self.compared.result = (given, result);
        }
        // Before the program runs, control is in the system program.
        match self.system.places[self.control.index()] {
            PlaceRole::Line(line) if line != self.machine.line() => Err("the line".to_owned()),
            _ => Ok(()),
        }
    }

    /// Value of a variable in the net; 0 if its bits are not a value.
    #[must_use]
    pub fn value(&self, variable: VarId) -> u64 {
        self.system.value(variable, |place| self.marking.is_marked(place)).unwrap_or(0)
    }

    /// Current result. Only the bits given by the previous instruction have a meaning.
    #[must_use]
    pub fn result(&self) -> u64 {
        self.machine.result()
    }

    /// Hazards met since the scan began, each with its line (from 0), in chronological order.
    #[must_use]
    pub fn hazards(&self) -> &[(usize, Hazard)] {
        &self.hazards
    }

    /// Values of the variables in the net.
    #[must_use]
    pub fn memory(&self) -> Vec<u64> {
        (0..self.system.program.variables.len()).map(|variable| self.value(VarId(variable))).collect()
    }

    /// Whether a state formula holds now, in the net; `None` for a temporal formula.
    #[must_use]
    pub fn holds(&self, formula: &Bound) -> Option<bool> {
        formula.holds_in(self)
    }
}

impl Valuation for Replay<'_> {
    fn value(&self, variable: VarId) -> u64 {
        debug_assert!(self.system.program.variable(variable).role != Role::Buffer);
        Replay::value(self, variable)
    }

    fn is_marked(&self, place: PlaceId) -> bool {
        self.marking.is_marked(place)
    }

    fn tokens(&self, place: PlaceId) -> u64 {
        u64::from(self.marking.is_marked(place))
    }

    fn is_enabled(&self, transition: TransitionId) -> bool {
        self.system.net.is_enabled(&self.marking, transition)
    }

    fn is_deadlock(&self) -> bool {
        !self.system.net.transition_ids().any(|transition| self.is_enabled(transition))
    }
}

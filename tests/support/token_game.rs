//! A fast token game for what is deterministic: control follows the one enabled transition.

use petril::flat::{FlatProgram, Hazard, Instruction, Line, Operand, Target, Variable};
use petril::net::PlaceId;
use petril::semantics::{Role, Type, VarId};
use petril::source::Span;
use petril::translate::{PlaceRole, Plant, System, TransitionRole};

/// A system with a marking of its own.
pub struct Game {
    pub system: System,
    /// By position of the place.
    pub marked: Vec<bool>,
    control: usize,
    moves: Vec<Vec<Move>>,
    /// By position of the place.
    roles: Vec<PlaceRole>,
    /// The hazards whose places control has passed since the scan began, with their lines.
    pub hazards: Vec<(usize, Hazard)>,
    /// How many transitions have been fired.
    pub firings: usize,
}

struct Move {
    needs: Vec<u32>,
    takes: Vec<u32>,
    puts: Vec<u32>,
    /// Where control is afterwards.
    to: u32,
    role: TransitionRole,
}

impl Game {
    pub fn new(system: System) -> Self {
        let positions = |places: &[PlaceId]| places.iter().map(|place| place.index() as u32).collect::<Vec<_>>();
        let moves = system.net.place_ids().map(|control| {
            let moves = system.moves(control).iter().map(|&id| {
                let arcs = system.net.arcs(id);
                let is_control = |place: &&PlaceId| system.places[place.index()].is_control();
                let mut needs = positions(arcs.read);
                needs.extend(positions(arcs.consume));
                Move {
                    needs,
                    takes: positions(arcs.consume),
                    puts: positions(arcs.produce),
                    to: arcs.produce.iter().find(is_control).map_or(control.index(), |place| place.index()) as u32,
                    role: system.transitions[id.index()],
                }
            });
            moves.collect()
        });
        let moves = moves.collect();
        let marked = system.net.place_ids().map(|place| system.net.place(place).is_marked()).collect();
        let control = system.place(PlaceRole::Idle).index();
        let roles = system.places.clone();
        Self { system, marked, control, moves, roles, hazards: Vec::new(), firings: 0 }
    }

    /// Where control is.
    pub fn control(&self) -> PlaceRole {
        self.roles[self.control]
    }

    /// Puts control somewhere.
    pub fn go(&mut self, role: PlaceRole) {
        self.marked[self.control] = false;
        self.control = self.system.place(role).index();
        self.marked[self.control] = true;
        self.hazards.clear();
    }

    /// Gives bits, from the lowest, the values of a pattern.
    pub fn set(&mut self, bits: &[[PlaceId; 2]], pattern: u64) {
        for (position, places) in bits.iter().enumerate() {
            let value = pattern >> position & 1 == 1;
            self.marked[places[0].index()] = !value;
            self.marked[places[1].index()] = value;
        }
    }

    /// The value of a variable.
    pub fn value(&self, variable: VarId) -> Option<u64> {
        self.system.value(variable, |place| self.marked[place.index()])
    }

    /// The value of the current result.
    pub fn result(&self, width: u32) -> Option<u64> {
        self.system.result(width, |place| self.marked[place.index()])
    }

    /// Whether every bit of the registers is 0.
    pub fn registers_are_clear(&self) -> bool {
        self.roles.iter().zip(&self.marked).all(|(role, &marked)| match role {
            PlaceRole::Register { value, .. } => marked != *value,
            _ => true,
        })
    }

    /// Fires the one enabled transition that takes the token of control and is among the wanted ones.
    #[track_caller]
    pub fn fire(&mut self, wanted: impl Fn(TransitionRole) -> bool) {
        let marked = &self.marked;
        let is_enabled = |step: &&Move| wanted(step.role) && step.needs.iter().all(|&place| marked[place as usize]);
        let mut enabled = self.moves[self.control].iter().filter(is_enabled);
        let (first, second) = (enabled.next(), enabled.next());
        let name = |control: usize| self.system.net.place(PlaceId::at(control)).name;
        let (Some(step), None) = (first, second) else {
            panic!("at `{}` there is not one enabled transition", name(self.control))
        };
        for &place in &step.takes {
            self.marked[place as usize] = false;
        }
        for &place in &step.puts {
            assert!(!self.marked[place as usize], "`{}` gets a second token", name(place as usize));
            self.marked[place as usize] = true;
        }
        self.control = step.to as usize;
        self.firings += 1;
        if let PlaceRole::Hazard(line, hazard) = self.roles[self.control] {
            self.hazards.push((line, hazard));
        }
    }

    /// Fires until control is there.
    #[track_caller]
    pub fn run_to(&mut self, role: PlaceRole) {
        let place = self.system.place(role).index();
        while self.control != place {
            self.fire(|_| true);
        }
    }
}

/// A variable of a type.
pub fn variable(name: &str, role: Role, ty: Type) -> Variable {
    Variable { name: name.to_owned(), role, ty, bits: ty.width, initial: 0, span: None }
}

/// A flat program; it gets a Boolean input if it has none.
pub fn flat(mut variables: Vec<Variable>, code: Vec<Instruction>) -> FlatProgram {
    if variables.iter().all(|variable| variable.role != Role::Input) {
        variables.push(variable("input", Role::Input, Type::BOOL));
    }
    let code = code.into_iter().map(|instruction| Line { instruction, span: Span::default() }).collect();
    FlatProgram {
        name: "flat".to_owned(),
        variables,
        code,
        scan_time: None,
        cycle: 20,
        presets_vary: false,
        restrictions: Default::default(),
        addresses: Default::default(),
        internal: Default::default(),
    }
}

/// One instruction on a variable `x`, to be fed with values of the current result and the variable.
pub struct Bench {
    pub game: Game,
    result: Vec<[PlaceId; 2]>,
    operand: Vec<[PlaceId; 2]>,
}

impl Bench {
    /// `make` makes the instruction from its operand; the operand's type is given.
    pub fn new(operand: Type, make: impl Fn(Operand) -> Instruction) -> Self {
        let instruction = make(Operand::Place(Target::Variable(VarId(0))));
        let program = flat(vec![variable("x", Role::Memory, operand)], vec![instruction]);
        let system = System::new(program, Plant::default());
        let bits = |bit| [false, true].map(|value| system.place(PlaceRole::Result { bit, value }));
        let result = (0..system.result_width()).map(bits).collect();
        let operand = system.bits(VarId(0)).collect();
        Self { game: Game::new(system), result, operand }
    }

    /// What the net makes of the current result, and the hazard it meets.
    #[track_caller]
    pub fn run(&mut self, result: u64, operand: u64, width: u32) -> (u64, Option<Hazard>) {
        self.game.go(PlaceRole::Line(0));
        self.game.set(&self.result, result);
        self.game.set(&self.operand, operand);
        self.game.run_to(PlaceRole::Line(1));
        assert!(self.game.hazards.len() <= 1);
        assert_eq!(self.game.value(VarId(0)), Some(operand), "the operand stays");
        assert!(self.game.registers_are_clear());
        let hazard = self.game.hazards.first().map(|&(_, hazard)| hazard);
        (self.game.result(width).expect("each bit has one value"), hazard)
    }
}

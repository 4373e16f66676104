//! Token game and interpreter do the same on random flat programs over all types: after every instruction, every bit of
//! every variable and of the current result, and every hazard. `PETRIL_PROGRAMS` says how many programs.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::flat::{Function, Hazard, Instruction, Operand, Target};
use petril::interpret::Machine;
use petril::semantics::{Role, Type, VarId};
use petril::translate::{PlaceRole, Plant, System};
use proptest::prelude::*;
use support::agreement::{Inputs, agree, programs, replay};
use support::random_flat::{Choices, program};
use support::token_game::{Game, flat, variable};

/// A scan is not followed any longer.
const STEPS: usize = 200;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(programs(2000)))]

    #[test]
    fn after_every_instruction(numbers in proptest::collection::vec(any::<u32>(), 0..160)) {
        let mut choices = Choices::new(&numbers);
        let system = System::new(program(&mut choices, 8), Plant::default());
        let inputs: Vec<VarId> = system.program.with_role(Role::Input).collect();
        let mut scan = || inputs.iter().map(|&id| (id, choices.pattern(system.program.variable(id).ty))).collect();
        let scans: Vec<Inputs> = (0..3).map(|_| scan()).collect();
        let mut game = Game::new(system.clone());
        let met = agree(&mut game, &system.program, &scans, STEPS)?;
        if met.ended && game.control() == PlaceRole::Idle && numbers.len() % 4 == 0 {
            replay(&system, &scans)?;
        }
    }
}

/// The random programs come to everything there is: otherwise their agreement says little.
#[test]
fn random_programs_do_everything() {
    let mut generator = 1_u64;
    let mut next = || {
        // Numerical Recipes.
        generator = generator.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (generator >> 32) as u32
    };
    let (mut hazards, mut kinds, mut ended, mut elements) = (Vec::new(), Vec::new(), 0, 0);
    for _ in 0..400 {
        let numbers: Vec<u32> = (0..200).map(|_| next()).collect();
        let mut choices = Choices::new(&numbers);
        let program = program(&mut choices, 8);
        for line in &program.code {
            let text = program.text(line.instruction);
            elements += usize::from(text.contains("[i"));
            kinds.push(text.split(' ').next().unwrap_or_default().to_owned());
        }
        let mut machine = Machine::new(&program);
        ended += usize::from(machine.scan().is_ok());
        hazards.extend(machine.hazards().iter().map(|&(_, hazard)| hazard));
    }
    for hazard in Hazard::ALL {
        let count = hazards.iter().filter(|&&met| met == hazard).count();
        assert!(count > 20, "{hazard}: {count}");
    }
    for word in
        ["LD", "LDN", "ST", "STN", "S", "R", "NOT", "ADD", "SUB", "MUL", "DIV", "MOD", "SHL", "ROR", "BOUND", "JMPC"]
    {
        let count = kinds.iter().filter(|&kind| kind == word).count();
        assert!(count > 20, "{word}: {count}");
    }
    assert!(ended > 200 && elements > 100, "{ended} {elements}");
}

/// A net that computes something else than the interpreter, or meets another hazard, is found out by the replay.
#[test]
fn the_replay_notices_what_differs() {
    let usint = Type::named("USINT").unwrap();
    let [x, y] = [0, 1].map(|id| Operand::Place(Target::Variable(VarId(id))));
    let add = |function, ty| Instruction::Combine { function, ty, negated: false, operand: y };
    let code = vec![
        Instruction::Load { ty: usint, negated: false, operand: x },
        add(Function::Add, usint),
        Instruction::Store { ty: usint, negated: false, target: Target::Variable(VarId(2)) },
    ];
    let variables = [("x", Role::Input), ("y", Role::Input), ("z", Role::Output)];
    let variables = variables.map(|(name, role)| variable(name, role, usint)).into();
    let system = System::new(flat(variables, code), Plant::default());
    let told = |instruction, x: u64, y: u64| {
        let mut other = system.clone();
        other.program.code[1].instruction = instruction;
        let inputs = vec![(VarId(0), x), (VarId(1), y)];
        replay(&other, &[inputs]).map_err(|error| error.to_string()).err().unwrap_or_default()
    };
    assert_eq!(told(add(Function::Add, usint), 255, 1), "");
    assert!(told(add(Function::Sub, usint), 2, 1).contains("differ in the current result"));
    assert!(told(add(Function::Mul, usint), 2, 2).is_empty(), "both are 4");
    let byte = Type::named("BYTE").unwrap();
    assert!(told(add(Function::Add, byte), 255, 1).contains("meets the hazards [], the net [overflow]"));
    assert!(told(add(Function::Add, byte), 254, 1).is_empty());
    assert!(told(add(Function::Sub, usint), 0, 1).contains("meets the hazards [overflow], the net []"));
}

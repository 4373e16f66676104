//! The nets of programs over all types are safe by construction: each transition keeps every invariant.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::BTreeSet;

use petril::flat::{Element, FlatProgram, Function, Instruction, Operand, Target};
use petril::net::PlaceId;
use petril::semantics::{Role, Type, VarId};
use petril::translate::{Part, PlaceRole, Plant, System, TransitionRole};
use proptest::prelude::*;
use support::random_flat::{Choices, program};
use support::token_game::{flat, variable};

/// For each place, the invariant it belongs to: control, or a bit.
fn invariants(system: &System) -> Vec<usize> {
    let mut pairs = 0;
    let mut invariants = Vec::new();
    for role in &system.places {
        invariants.push(match role {
            role if role.is_control() => 0,
            // The two places of a bit follow each other.
            PlaceRole::Bit { value, .. } | PlaceRole::Result { value, .. } | PlaceRole::Register { value, .. } => {
                pairs += usize::from(!*value);
                pairs
            }
            other => panic!("{other:?} in a system without a plant"),
        });
    }
    invariants
}

/// A place of control, and the instruction it belongs to.
fn what(system: &System, role: PlaceRole) -> String {
    let line = match role {
        PlaceRole::Line(line) | PlaceRole::Within(line, _) | PlaceRole::Hazard(line, _) => Some(line),
        _ => None,
    };
    let instruction = line.and_then(|line| system.program.code.get(line)).map(|code| code.instruction);
    format!("{role:?} of {instruction:?}")
}

/// Every sum is 1 at the beginning, and no transition changes it or reads what it takes.
fn assert_safe(system: &System) {
    let invariants = invariants(system);
    let mut sums = vec![0; 1 + invariants.iter().max().unwrap()];
    for place in system.net.place_ids() {
        sums[invariants[place.index()]] += u8::from(system.net.place(place).is_marked());
    }
    assert!(sums.iter().all(|&sum| sum == 1));
    for transition in system.net.transitions() {
        let of = |places: &[PlaceId]| {
            let all: Vec<usize> = places.iter().map(|place| invariants[place.index()]).collect();
            let once: BTreeSet<usize> = all.iter().copied().collect();
            assert_eq!(once.len(), all.len(), "{} asks twice for one thing", transition.name);
            once
        };
        let arcs = transition.arcs;
        let (consume, produce, read) = (of(arcs.consume), of(arcs.produce), of(arcs.read));
        assert_eq!(consume, produce, "{}", transition.name);
        assert!(consume.is_disjoint(&read), "{} can never fire", transition.name);
        assert!(consume.contains(&0) || read.contains(&0), "{} is outside of control", transition.name);
    }
    let names = |names: Vec<&str>| {
        let once: BTreeSet<&str> = names.iter().copied().collect();
        assert_eq!(once.len(), names.len(), "a name stands for two nodes");
    };
    names(system.net.places().map(|place| place.name).collect());
    names(system.net.transitions().map(|transition| transition.name).collect());
    // Every place of control but `idle` can be entered, and every one can be left.
    let entered: BTreeSet<PlaceId> =
        system.net.transitions().flat_map(|transition| transition.arcs.produce).copied().collect();
    for place in system.net.place_ids() {
        let role = system.places[place.index()];
        if role.is_control() {
            assert!(!system.moves(place).is_empty(), "{} has no way out", what(system, role));
            assert!(
                matches!(role, PlaceRole::Line(_)) || entered.contains(&place),
                "{} has no way in",
                what(system, role)
            );
        }
    }
    assert!(system.plant_moves().is_empty());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn nets_of_random_programs_are_safe(numbers in proptest::collection::vec(any::<u32>(), 0..160)) {
        assert_safe(&System::new(program(&mut Choices::new(&numbers), 8), Plant::default()));
    }
}

/// `LD x`, `ADD y`, `ST x` as often as wanted.
fn long(times: usize) -> FlatProgram {
    let int = Type::named("INT").unwrap();
    let [x, y] = [0, 1].map(|id| Target::Variable(VarId(id)));
    let triple = [
        Instruction::Load { ty: int, negated: false, operand: Operand::Place(x) },
        Instruction::Combine { function: Function::Add, ty: int, negated: false, operand: Operand::Place(y) },
        Instruction::Store { ty: int, negated: false, target: x },
    ];
    let variables = vec![variable("x", Role::Output, int), variable("y", Role::Input, int)];
    flat(variables, triple.into_iter().cycle().take(3 * times).collect())
}

#[test]
fn nets_grow_with_the_number_of_instructions() {
    let size = |times| System::new(long(times), Plant::default()).size(Part::User);
    let (one, two, hundred) = (size(1), size(2), size(100));
    assert_eq!(hundred.0 - one.0, 99 * (two.0 - one.0));
    assert_eq!(hundred.1 - one.1, 99 * (two.1 - one.1));
    // Loading and storing 16 bits takes 4 transitions a bit, adding 8 for each but the first; two places more a bit for the
    // carries.
    assert_eq!(two.1 - one.1, 64 + 4 + 15 * 8 + 1 + 64);
    assert_eq!(two.0 - one.0, 16 + 1 + 15 * 2 + 1 + 16);
}

/// The elements are bits, so the distance `NOT element` is at least 2 and far beyond: no way leads to a shift by less.
#[test]
fn a_bit_that_no_element_stores_is_known() {
    let byte = Type::named("BYTE").unwrap();
    let mut variables =
        vec![variable("e0", Role::Memory, byte), variable("e1", Role::Memory, byte), variable("i", Role::Buffer, byte)];
    variables.iter_mut().for_each(|variable| variable.bits = 1);
    let element = Element { first: VarId(0), stride: 1, length: 2, index: VarId(2) };
    let operand = Operand::Place(Target::Element(element));
    let shift = Instruction::Combine { function: Function::Shr, ty: byte, negated: true, operand };
    let system = System::new(flat(variables, vec![shift]), Plant::default());
    assert_safe(&system);
    assert_eq!(system.transitions_of(TransitionRole::Line(0)).count(), 8 * 2, "each bit is set to 0 at once");
}

/// Registers are there for those who need them only.
#[test]
fn registers_are_there_if_they_are_needed() {
    let registers = |function, name: &str, operand| {
        let ty = Type::named(name).unwrap();
        let variables = vec![variable("x", Role::Memory, ty)];
        let system = System::new(
            flat(variables, vec![Instruction::Combine { function, ty, negated: false, operand }]),
            Plant::default(),
        );
        system.places.iter().filter(|role| matches!(role, PlaceRole::Register { .. })).count() / 2
    };
    let x = Operand::Place(Target::Variable(VarId(0)));
    assert_eq!(registers(Function::Add, "INT", x), 0);
    assert_eq!(registers(Function::Mul, "UINT", x), 1);
    assert_eq!(registers(Function::Mul, "INT", x), 1 + 17);
    assert_eq!(registers(Function::Mul, "INT", Operand::Constant(10)), 0);
    assert_eq!(registers(Function::Mod, "UINT", x), 0);
    assert_eq!(registers(Function::Div, "UINT", x), 16);
    assert_eq!(registers(Function::Div, "INT", x), 16 + 16 + 1);
}

/// The sizes in `docs/semantics.md`: places within the line and transitions, for signed numbers of 8, 16 and 32 bits.
#[test]
fn subnets_have_the_sizes_that_are_documented() {
    let sizes = |make: &dyn Fn(Type, Operand) -> Instruction| {
        ["SINT", "INT", "DINT"].map(|name| {
            let ty = Type::named(name).unwrap();
            let x = Operand::Place(Target::Variable(VarId(0)));
            let system = System::new(flat(vec![variable("x", Role::Memory, ty)], vec![make(ty, x)]), Plant::default());
            let within = |role: &&PlaceRole| matches!(role, PlaceRole::Within(..) | PlaceRole::Hazard(..));
            (system.places.iter().filter(within).count(), system.transitions_of(TransitionRole::Line(0)).count())
        })
    };
    let combined = |function| sizes(&move |ty, operand| Instruction::Combine { function, ty, negated: false, operand });
    assert_eq!(sizes(&|ty, operand| Instruction::Load { ty, negated: false, operand }), [(7, 32), (15, 64), (31, 128)]);
    assert_eq!(combined(Function::And), [(7, 32), (15, 64), (31, 128)]);
    assert_eq!(combined(Function::Add), [(15, 61), (31, 125), (63, 253)]);
    assert_eq!(combined(Function::Sub), [(15, 61), (31, 125), (63, 253)]);
    assert_eq!(combined(Function::Gt), [(9, 36), (17, 68), (33, 132)]);
    assert_eq!(combined(Function::Mul), [(142, 403), (406, 1307), (1318, 4651)]);
    assert_eq!(combined(Function::Div), [(190, 599), (570, 1959), (1906, 6983)]);
    let (function, negated, operand) = (Function::Add, false, Operand::Constant(10));
    let ten = sizes(&|ty, _| Instruction::Combine { function, ty, negated, operand });
    assert_eq!(ten, [(7, 15), (15, 31), (31, 63)]);
}

//! Inputs of more than one bit: free ones have exactly the values of their domains, driven ones those of the plant.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::BTreeSet;

use petril::exchange::tina;
use petril::flat::{FlatProgram, Instruction, Operand, Target};
use petril::net::{Marking, PlaceId};
use petril::semantics::{Role, Type, VarId};
use petril::source::Source;
use petril::translate::{Domain, Domains, PlaceRole, Plant, System, TransitionRole};
use proptest::prelude::*;
use support::token_game::{flat, variable};

fn ty(name: &str) -> Type {
    Type::named(name).unwrap()
}

/// An input `x` and an output `y` that gets the input's value.
fn program(ty: Type) -> FlatProgram {
    let variables = vec![variable("x", Role::Input, ty), variable("y", Role::Output, ty)];
    let operand = Operand::Place(Target::Variable(VarId(0)));
    let load = Instruction::Load { ty, negated: false, operand };
    let store = Instruction::Store { ty, negated: false, target: Target::Variable(VarId(1)) };
    flat(variables, vec![load, store])
}

/// Every marking that firings lead to from some markings until `stop`. Nothing may end before.
fn reached(system: &System, from: Vec<Marking>, stop: PlaceId) -> BTreeSet<Marking> {
    let mut seen: BTreeSet<Marking> = from.iter().cloned().collect();
    let mut work = from;
    let mut stopped = BTreeSet::new();
    while let Some(marking) = work.pop() {
        if marking.is_marked(stop) {
            stopped.insert(marking);
            continue;
        }
        let enabled: Vec<_> = system.net.enabled(&marking).collect();
        assert!(!enabled.is_empty(), "the way ends");
        for transition in enabled {
            let mut next = marking.clone();
            system.net.fire(&mut next, transition).expect("the net is safe");
            if seen.insert(next.clone()) {
                work.push(next);
            }
        }
    }
    stopped
}

/// The values that the input has at the first line, in the first scan and in the second.
fn values(system: &System) -> [BTreeSet<u64>; 2] {
    let [line, end] = [0, 2].map(|line| system.place(PlaceRole::Line(line)));
    let value = |marking: &Marking, variable| system.value(variable, |place| marking.is_marked(place)).unwrap();
    let first = reached(system, vec![system.net.initial_marking()], line);
    let ended = reached(system, first.iter().cloned().collect(), end);
    assert!(ended.iter().all(|marking| value(marking, VarId(0)) == value(marking, VarId(1))));
    let unblock = system.transitions_of(TransitionRole::Unblock).next().unwrap();
    let idle = ended.into_iter().map(|mut marking| {
        system.net.fire(&mut marking, unblock).expect("the net is safe");
        marking
    });
    let second = reached(system, idle.collect(), line);
    [first, second].map(|markings| markings.iter().map(|marking| value(marking, VarId(0))).collect())
}

fn with_domain(ty: Type, ranges: Vec<(i128, i128)>) -> System {
    let domain = Domain::new(ty, ranges).unwrap();
    System::with_domains(program(ty), Plant::default(), Domains::from([(VarId(0), domain)]))
}

fn assert_exact(ty: Type, ranges: Vec<(i128, i128)>) {
    let system = with_domain(ty, ranges);
    let expected: BTreeSet<u64> = system.domain(VarId(0)).patterns().collect();
    assert_eq!(values(&system), [expected.clone(), expected]);
}

#[test]
fn a_free_input_has_every_value() {
    for name in ["BOOL", "SINT", "USINT", "BYTE"] {
        let system = System::new(program(ty(name)), Plant::default());
        let all: BTreeSet<u64> = (0..=ty(name).mask()).collect();
        assert_eq!(values(&system), [all.clone(), all], "{name}");
    }
}

#[test]
fn a_domain_is_all_there_is() {
    assert_exact(ty("SINT"), vec![(-3, 4)]);
    assert_exact(ty("SINT"), vec![(-128, -128), (127, 127)]);
    assert_exact(ty("BYTE"), vec![(1, 1), (2, 2), (4, 4), (8, 8), (128, 128)]);
    assert_exact(ty("INT"), vec![(-32768, -32760), (-1, 0), (1000, 1002)]);
    assert_exact(ty("ULINT"), vec![(0, 1), (i128::from(u64::MAX), i128::from(u64::MAX))]);
    assert_exact(ty("LINT"), vec![(i128::from(i64::MIN), i128::from(i64::MIN)), (-2, 2)]);
    assert_exact(ty("TIME"), vec![(0, 0), (200, 200)]);
    assert_exact(ty("BOOL"), vec![(1, 1)]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn random_domains_are_all_there_is(signed: bool, ranges in proptest::collection::vec((0..256_i128, 0..20_i128), 1..5)) {
        let ty = ty(if signed { "SINT" } else { "USINT" });
        let fit = |from: i128| (from + ty.least()).min(ty.greatest());
        assert_exact(ty, ranges.into_iter().map(|(from, more)| (fit(from), fit(from + more))).collect());
    }
}

/// Decisions are shared: what is free needs one place a bit, and the two ends of a range one more each.
#[test]
fn a_range_needs_three_places_a_bit() {
    let within = |ranges| {
        let system = with_domain(ty("DINT"), ranges);
        system.places.iter().filter(|role| matches!(role, PlaceRole::Copying(..))).count()
    };
    let all = (ty("DINT").least(), ty("DINT").greatest());
    assert_eq!(within(vec![all]), 31);
    assert!(within(vec![(-5, 1_000)]) <= 93);
}

const TANK: &str = "net tank
pl {level=0} (1)
pl {level=-5}
pl {level=16#7F}
tr fill {level=0} {valve=3}?1 -> {level=-5}
tr more {level=-5} {valve=100}?1 -> {level=16#7F}
";

fn tank(net: &str) -> Result<System, Vec<petril::diagnostic::Diagnostic>> {
    let (sint, usint) = (ty("SINT"), ty("USINT"));
    let variables = vec![variable("level", Role::Input, sint), variable("valve", Role::Output, usint)];
    // The valve is 3 at first, and then 100 if the level is -5.
    let x = Operand::Place(Target::Variable(VarId(0)));
    let y = Target::Variable(VarId(1));
    let code = vec![
        Instruction::Load { ty: sint, negated: false, operand: x },
        Instruction::Combine {
            function: petril::flat::Function::Eq,
            ty: sint,
            negated: false,
            operand: Operand::Constant(0xFB),
        },
        Instruction::Convert { from: Type::BOOL, to: usint },
        Instruction::Combine {
            function: petril::flat::Function::Mul,
            ty: usint,
            negated: false,
            operand: Operand::Constant(97),
        },
        Instruction::Combine {
            function: petril::flat::Function::Add,
            ty: usint,
            negated: false,
            operand: Operand::Constant(3),
        },
        Instruction::Store { ty: usint, negated: false, target: y },
    ];
    let program = flat(variables, code);
    let mut plant = Plant::default();
    let net = tina::read(&Source::new("tank.net", net)).unwrap();
    plant.add(&net, &program)?;
    Ok(System::new(program, plant))
}

/// All combinations of level and valve at the ends of scans.
fn ends(system: &System) -> BTreeSet<(u64, u64)> {
    let end = system.place(PlaceRole::Line(system.program.end()));
    let mut seen = BTreeSet::from([system.net.initial_marking()]);
    let mut work: Vec<Marking> = seen.iter().cloned().collect();
    let mut found = BTreeSet::new();
    while let Some(marking) = work.pop() {
        let value = |id| system.value(VarId(id), |place| marking.is_marked(place)).unwrap();
        if marking.is_marked(end) {
            found.insert((value(0), value(1)));
        }
        for transition in system.net.enabled(&marking) {
            let mut next = marking.clone();
            system.net.fire(&mut next, transition).expect("the net is safe");
            if seen.insert(next.clone()) {
                work.push(next);
            }
        }
    }
    found
}

#[test]
fn a_plant_gives_and_reads_numbers() {
    let system = tank(TANK).unwrap();
    assert_eq!(ends(&system), [(0, 3), (0xFB, 100), (0x7F, 3)].into());
    // Without its test, the last step would be possible; with another value it never is.
    let other = tank(&TANK.replace("valve=100", "valve=101")).unwrap();
    assert_eq!(ends(&other), [(0, 3), (0xFB, 100)].into());
}

#[test]
fn numbers_must_be_of_the_type() {
    for wrong in ["valve=256", "valve=-1", "valve=TRUE", "valve=x"] {
        let errors = tank(&TANK.replace("valve=100", wrong)).unwrap_err();
        let messages: Vec<&str> = errors.iter().map(|error| error.message.as_str()).collect();
        assert_eq!(messages, [format!("`{wrong}` gives no input or output a value")]);
    }
    assert!(tank(&TANK.replace("level=-5", "level=-129")).is_err());
}

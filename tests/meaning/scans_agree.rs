//! The explorer's way to compute scans, many at once by gates, gives what the interpreter gives scan by scan.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::explore::{Budget, ScanSpace, StateSpace, Successors, explore};
use petril::flat::Tolerated;
use petril::semantics::Role;
use petril::translate::{Domain, Domains, Plant, System};
use proptest::prelude::*;
use support::agreement::programs;
use support::random_flat::{Choices, program};
use support::random_program;

/// States of each program that are looked at, about.
const STATES: u64 = 300;

/// The steps out of all states found are the same both ways. Says whether there are gates.
fn agree(space: &ScanSpace<'_>) -> Result<bool, TestCaseError> {
    let graph = explore(space, Budget { states: STATES, ..Budget::default() }, &mut |_| None);
    prop_assert_eq!(space.refusal(), None);
    let words: Vec<u64> = graph.ids().flat_map(|id| graph.state(id)).copied().collect();
    let (mut fast, mut plain) = (Successors::default(), Successors::default());
    space.expand(&words, &mut fast);
    for id in graph.ids() {
        space.successors(graph.state(id), &mut |step| plain.add(step));
        plain.finish();
    }
    prop_assert_eq!(fast, plain);
    Ok(space.has_gates())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(programs(1000)))]

    #[test]
    fn on_random_programs(text in random_program::text(12), device in proptest::option::of(random_program::device())) {
        let system = random_program::system(support::program(&text), device.as_ref());
        agree(&ScanSpace::new(&system))?;
    }

    /// Over all types, with arrays, conversions, and hazards; inputs have two values each.
    #[test]
    fn on_random_flat_programs(numbers in proptest::collection::vec(any::<u32>(), 0..160), tolerated in 0..4) {
        let mut choices = Choices::new(&numbers);
        let program = program(&mut choices, 8);
        let mut domains = Domains::default();
        for input in program.with_role(Role::Input) {
            let ty = program.variable(input).ty;
            let values = [0, 1].map(|_| ty.number(choices.pattern(ty))).map(|number| (number, number));
            domains.insert(input, Domain::new(ty, values.to_vec()).unwrap());
        }
        let system = System::with_domains(program, Plant::default(), domains);
        let tolerated = Tolerated { overflow: tolerated & 1 == 1, division_by_zero: tolerated & 2 == 2 };
        agree(&ScanSpace::tolerating(&system, tolerated))?;
    }
}

/// Random programs are of both kinds: otherwise their agreement says little.
#[test]
fn many_programs_have_gates() {
    let mut generator = 1_u64;
    let mut next = || {
        // Knuth's MMIX.
        generator = generator.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (generator >> 32) as u32
    };
    let with_gates = (0..400).filter(|_| {
        let numbers: Vec<u32> = (0..200).map(|_| next()).collect();
        let system = System::new(program(&mut Choices::new(&numbers), 8), Plant::default());
        ScanSpace::new(&system).has_gates()
    });
    let count = with_gates.count();
    assert!((20..380).contains(&count), "{count}");
    let boolean = "PROGRAM p VAR_INPUT i, j : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR\n\
                   LD i\nJMPC on\nLD j\nST q\non: LD q\nXOR i\nST q\nEND_PROGRAM";
    assert!(ScanSpace::new(&support::systems::system(boolean, &[])).has_gates());
}

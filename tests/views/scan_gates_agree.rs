//! The gates that proofs are made with give what the interpreter gives, products and quotients included.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::explore::ScanGates;
use petril::flat::{FlatProgram, Tolerated};
use petril::interpret::Machine;
use petril::semantics::{Role, VarId};
use proptest::prelude::*;
use support::agreement::programs;
use support::assembler::assemble;
use support::random_flat::{Choices, program};

/// Words like those of a stream of chance (Steele et al., SplitMix64).
fn words(mut seed: u64) -> impl FnMut() -> u64 {
    move || {
        seed = seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = seed;
        z = (z ^ z >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ z >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ z >> 31
    }
}

/// 64 scans from any values are the same both ways; how many of them meet an error.
fn agree(program: &FlatProgram, gates: &ScanGates, tolerated: Tolerated, seed: u64) -> Result<usize, TestCaseError> {
    let mut next = words(seed);
    // A word that is mostly 0 or mostly 1 makes small numbers, and those near the ends.
    let inputs: Vec<u64> =
        gates.inputs.iter().map(|_| [next(), next() & next() & next(), next() | next()][next() as usize % 3]).collect();
    let lanes = gates.evaluate(&inputs);
    let mut errors = 0;
    for scan in 0..64 {
        let mut machine = Machine::new(program);
        for (variable, wires) in gates.beginning.iter().enumerate() {
            machine.set(VarId(variable), lanes.pattern(wires, scan));
        }
        let ended = machine.scan();
        let met = gates.errors.iter().filter(|(wire, ..)| lanes.word(*wire) >> scan & 1 == 1);
        let met: Vec<_> = met.map(|&(_, line, hazard)| (line, hazard)).collect();
        prop_assert_eq!(&met, &tolerated.first_error(machine.hazards()).into_iter().collect::<Vec<_>>());
        errors += met.len();
        // After an error, a scan may be kept from ending.
        prop_assert!(ended.is_ok() || !met.is_empty());
        if met.is_empty() {
            for (variable, wires) in gates.end.iter().enumerate() {
                if program.variables[variable].role != Role::Buffer {
                    prop_assert_eq!(lanes.pattern(wires, scan), machine.value(VarId(variable)), "{}", variable);
                }
            }
        }
    }
    Ok(errors)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(programs(1000)))]

    #[test]
    fn on_random_flat_programs(
        numbers in proptest::collection::vec(any::<u32>(), 0..160), tolerated in 0..4, seed in any::<u64>(),
    ) {
        let program = program(&mut Choices::new(&numbers), 8);
        let tolerated = Tolerated { overflow: tolerated & 1 == 1, division_by_zero: tolerated & 2 == 2 };
        if let Ok(gates) = ScanGates::of(&program, tolerated) {
            agree(&program, &gates, tolerated, seed)?;
        }
    }
}

/// Code of Booleans in which control only goes on: each number is an instruction, one in four a jump to a later line.
fn forward(numbers: &[u32]) -> FlatProgram {
    let lines = numbers.iter().enumerate().map(|(at, &number)| {
        let variable = ["a", "b", "c", "q", "r", "s"][(number >> 8) as usize % 6];
        let written = ["q", "r", "s"][(number >> 8) as usize % 3];
        // Lines count from 1, and the end is one of them.
        let target = at + 3 + (number >> 8) as usize % (numbers.len() - at).min(12);
        match number % 12 {
            0 => format!("JMPC {target}"),
            1 => format!("JMPCN {target}"),
            2 => format!("JMP {target}"),
            3 | 4 => format!("LD {variable}"),
            5 => format!("AND {variable}"),
            6 => format!("XOR {variable}"),
            7 | 8 => format!("ST {written}"),
            9 => format!("STN {written}"),
            10 => format!("S {written}"),
            _ => format!("R {written}"),
        }
    });
    let declarations = "in a BOOL\nin b BOOL\nin c BOOL\nvar q BOOL\nvar r BOOL\nvar s BOOL";
    assemble(declarations, &format!("LD a\n{}", lines.collect::<Vec<_>>().join("\n")))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(programs(1000)))]

    #[test]
    fn where_control_meets(numbers in proptest::collection::vec(any::<u32>(), 1..60), seed in any::<u64>()) {
        let program = forward(&numbers);
        let gates = ScanGates::of(&program, Tolerated::default()).unwrap();
        prop_assert_eq!(agree(&program, &gates, Tolerated::default(), seed)?, 0);
    }
}

/// By hand: ways that come with the same values, and one that goes on where nobody else does.
#[test]
fn where_few_ways_meet() {
    let declarations = "in a BOOL\nin b BOOL\nin c BOOL\nvar q BOOL\nvar r BOOL";
    for code in [
        // q keeps its value if a or b.
        "LD a\nJMPC 7\nLD b\nJMPC 7\nLD c\nST q",
        // q is b, or r is c.
        "LD a\nJMPC 6\nLD b\nST q\nJMP 8\nLD c\nST r",
    ] {
        let program = assemble(declarations, code);
        let gates = ScanGates::of(&program, Tolerated::default()).unwrap();
        for seed in 0..8 {
            agree(&program, &gates, Tolerated::default(), seed).unwrap();
        }
    }
}

/// Every function of two numbers of every kind of type, on numbers that are computed.
#[test]
fn on_every_function() {
    for ty in ["SINT", "USINT", "BYTE", "INT", "UINT", "WORD", "DINT", "TIME"] {
        for function in ["ADD", "SUB", "MUL", "DIV", "MOD", "SHL", "SHR", "ROL", "ROR", "SHLN", "GE", "LT"] {
            let result = if matches!(function, "GE" | "LT") { "t" } else { "r" };
            let program = assemble(
                &format!("in a {ty}\nin b {ty}\nvar r {ty}\nvar t BOOL"),
                &format!("LD a\n{function} b\nST {result}"),
            );
            for bits in 0..4 {
                let tolerated = Tolerated { overflow: bits & 1 == 1, division_by_zero: bits & 2 == 2 };
                let gates = ScanGates::of(&program, tolerated).unwrap();
                let errors: usize = (0..8).map(|seed| agree(&program, &gates, tolerated, seed).unwrap()).sum();
                let can_fail = !matches!(ty, "BYTE" | "WORD") && matches!(function, "MUL") && bits & 1 == 0;
                assert!(errors > 0 || !can_fail, "{ty} {function} {bits}");
            }
        }
    }
}

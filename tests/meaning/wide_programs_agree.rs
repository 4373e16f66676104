//! Random texts over the whole language: the front end accepts them, printing and reading them again changes nothing, and
//! after every scan the net, the interpreter of flat code and an interpreter of the program as it is written
//! (`support/reference.rs`) agree on every variable and every hazard.
//!
//! `PETRIL_PROGRAMS=100000 PROPTEST_RNG_SEED=1` for a long run that can be repeated.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::BTreeSet;

use petril::diagnostic::any_error;
use petril::flat::{FlatProgram, Hazard, Instruction, flatten};
use petril::interpret::Machine;
use petril::semantics::{self, Program, Role, Section, VarId};
use petril::source::Source;
use petril::syntax;
use petril::translate::{Plant, System};
use proptest::prelude::*;
use support::agreement::{Inputs, agree, programs};
use support::constructs::of_program;
use support::indifference::indifferent;
use support::random_flat::Choices;
use support::random_wide_program::text;
use support::reference::Reference;
use support::token_game::Game;

/// A scan is not followed any longer.
const STEPS: usize = 20_000;

/// The checked program, and the text as it is printed.
fn read(text: &str) -> (Program, String) {
    let (unit, errors) = syntax::parse(&Source::new("program", text));
    let (program, more) = semantics::check(&unit, !any_error(&errors));
    (program.unwrap_or_else(|| panic!("{text}\n{errors:#?}\n{more:#?}")), unit.to_string())
}

fn code(program: &FlatProgram) -> Vec<Instruction> {
    program.code.iter().map(|line| line.instruction).collect()
}

/// The values that the interpreter computes, in the full width of their types, fit into the bits that variables have.
fn fit(machine: &Machine<'_>, flat: &FlatProgram) -> Result<(), TestCaseError> {
    for (id, variable) in flat.variables.iter().enumerate() {
        let value = machine.value(VarId(id));
        prop_assert!(
            value <= u64::MAX >> (64 - variable.bits),
            "{} = {value} has {} bits",
            variable.name,
            variable.bits
        );
    }
    Ok(())
}

/// The interpreter of flat code and that of the program as it is written do the same.
fn refer(program: &Program, flat: &FlatProgram, scans: &[Inputs], text: &str) -> Result<Vec<Hazard>, TestCaseError> {
    let mut reference = Reference::new(program, flat.presets_vary);
    let mut machine = Machine::new(flat);
    let entry = &program.pous[&program.entry].variables;
    let globals = program.globals.iter().enumerate().map(|(i, variable)| (entry.len() + i, variable));
    let is_input = |variable: &semantics::Variable| {
        variable.section == Section::Input || variable.area == Some(semantics::Area::Input)
    };
    let inputs: Vec<usize> =
        entry.iter().enumerate().chain(globals).filter(|(_, v)| is_input(v)).map(|(i, _)| i).collect();
    let mut met = Vec::new();
    fit(&machine, flat)?;
    for scan in scans {
        for (&(input, value), &position) in scan.iter().zip(&inputs) {
            machine.set(input, value);
            reference.set(position, value);
        }
        machine.scan().map_err(|fault| TestCaseError::fail(format!("{fault:?}\n{text}")))?;
        reference.scan(STEPS).map_err(|fault| TestCaseError::fail(format!("{fault:?}\n{text}")))?;
        fit(&machine, flat).map_err(|error| TestCaseError::fail(format!("{error}\n{text}")))?;
        let declared: Vec<VarId> = flat.declared().collect();
        let names: Vec<&str> = declared.iter().map(|&id| flat.variable(id).name.as_str()).collect();
        let flat_values: Vec<u64> = declared.iter().map(|&id| machine.value(id)).collect();
        let values = reference.values();
        prop_assert_eq!(values.len(), flat_values.len());
        // How far a clock goes beyond its preset time is its own business.
        let is_clock = |name: &str| name.ends_with(".CLOCK");
        let differ = (0..values.len()).find(|&i| values[i] != flat_values[i] && !is_clock(names[i]));
        let told = differ.map(|i| format!("{}: {} as written, {} in flat code", names[i], values[i], flat_values[i]));
        prop_assert!(told.is_none(), "{}\n{:?}\n{}", told.unwrap_or_default(), scan, text);
        // The order of some operands is that of flat code.
        let mut hazards: Vec<Hazard> = machine.hazards().iter().map(|&(_, hazard)| hazard).collect();
        let count = |hazards: &[Hazard]| Hazard::ALL.map(|kind| hazards.iter().filter(|&&met| met == kind).count());
        prop_assert_eq!(count(&reference.hazards), count(&hazards), "{:?}\n{}", scan, text);
        met.append(&mut hazards);
    }
    Ok(met)
}

/// Six scans with values that the inputs may have.
fn inputs(system: &System, choices: &mut Choices<'_>) -> Vec<Inputs> {
    let mut value = |id: VarId| {
        let domain = system.domain(id);
        let pattern = choices.pattern(domain.ty);
        let is_allowed = domain.contains(domain.ty.number(pattern));
        let others = usize::try_from(domain.size()).unwrap_or(usize::MAX);
        if is_allowed { pattern } else { domain.patterns().nth(pattern as usize % others).unwrap() }
    };
    (0..6).map(|_| system.program.with_role(Role::Input).map(|id| (id, value(id))).collect()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(programs(300)))]

    #[test]
    fn after_every_scan(numbers in proptest::collection::vec(any::<u32>(), 0..400), seed in proptest::collection::vec(any::<u32>(), 48)) {
        let text = text(&mut Choices::new(&numbers));
        let (program, printed) = read(&text);
        let flat = flatten(&program);
        let (again, unchanged) = read(&printed);
        prop_assert_eq!(&unchanged, &printed, "{}", text);
        prop_assert_eq!(code(&flatten(&again)), code(&flat), "{}\n{}", text, printed);
        let system = System::new(flat.clone(), Plant::default());
        let scans = inputs(&system, &mut Choices::new(&seed));
        refer(&program, &flat, &scans, &text)?;
        indifferent(&flat, &scans, &mut Choices::new(&numbers)).map_err(|error| TestCaseError::fail(format!("{error}\n{text}")))?;
        let mut game = Game::new(system);
        let met = agree(&mut game, &flat, &scans[..3], STEPS).map_err(|error| TestCaseError::fail(format!("{error}\n{text}")))?;
        prop_assert!(met.ended, "{}", text);
    }
}

/// Texts that are the same in every run.
fn texts(count: usize) -> impl Iterator<Item = String> {
    let mut generator = 7_u64;
    let mut next = move || {
        // Numerical Recipes.
        generator = generator.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (generator >> 32) as u32
    };
    (0..count).map(move |_| {
        let numbers: Vec<u32> = (0..400).map(|_| next()).collect();
        text(&mut Choices::new(&numbers))
    })
}

/// The random programs come to every construct of a list.
#[test]
fn random_programs_come_to_every_construct() {
    let mut found = BTreeSet::new();
    texts(1500).for_each(|text| of_program(&read(&text).0, &mut found));
    let listed = include_str!("../support/constructs.txt").lines();
    let missing: Vec<&str> = listed.filter(|&construct| !found.contains(construct)).collect();
    assert!(missing.is_empty(), "{missing:#?}");
}

/// The random programs come to everything there is: otherwise their agreement says little.
#[test]
fn random_programs_say_everything() {
    let (mut all, mut hazards) = (String::new(), Vec::new());
    for text in texts(1200) {
        let (program, _) = read(&text);
        let flat = flatten(&program);
        let mut machine = Machine::new(&flat);
        machine.scan().unwrap();
        hazards.extend(machine.hazards().iter().map(|&(_, hazard)| hazard));
        all += &text;
    }
    for hazard in Hazard::ALL {
        assert!(hazards.contains(&hazard), "{hazard}");
    }
    let words = [
        "LD ",
        "LDN ",
        "ST ",
        "STN ",
        "S ",
        "R ",
        "NOT\n",
        "AND ",
        "ANDN ",
        "ORN(",
        "XORN ",
        "& ",
        "&N ",
        "ADD ",
        "SUB(",
        "MUL ",
        "DIV ",
        "MOD ",
        "GT ",
        "GE ",
        "EQ(",
        "NE ",
        "LE ",
        "LT ",
        "SHL ",
        "SHR ",
        "ROL ",
        "ROR ",
        "_TO_",
        "MIN ",
        "MAX(",
        "LIMIT ",
        "LIMIT(",
        "SEL ",
        "SEL(",
        "MUX(",
        "MOVE(",
        "ABS\n",
        "JMPC ",
        "JMPCN ",
        "RETC\n",
        "RETCN\n",
        "CAL ",
        "CALC ",
        "CALCN ",
        "IN ",
        "CLK ",
        "CU ",
        "CD ",
        "PV ",
        "PT ",
        "S1 ",
        "R1 ",
        "EN := ",
        "ENO => ",
        "NOT ENO => ",
        ":= (\n",
        "func0(",
        "func0 ",
        "of_block0 : ",
        "w := ",
        "grid[",
        "row[",
        "pairs[",
        "pair.",
        "Colour#",
        "level",
        "g0",
        "T#",
        "TON",
        "TOF",
        "TP;",
        "CTU;",
        "CTD;",
        "CTUD",
        "SR;",
        "RS;",
        "R_TRIG",
        "F_TRIG",
        "%IX0.3",
        "%QB4",
        "VAR_TEMP",
        "VAR_IN_OUT",
        "VAR CONSTANT",
        "ADD(IN1",
        "AND(IN1",
    ];
    let missing: Vec<&str> = words.into_iter().filter(|word| all.matches(word).count() < 3).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

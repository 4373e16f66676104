//! Value change dumps, read by a parser that others wrote: every variable has every value, at every scan.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::BTreeMap;

use petril::exchange::vcd;
use petril::semantics::{Type, VarId};
use petril::translate::{Plant, System};
use petril::witness::ScanTrace;
use proptest::prelude::*;
use support::agreement::programs;
use support::random_flat::Choices;
use support::random_wide_program;
use support::runs::by_chance;
use support::systems::system;
use vcd_parser::{Command, IdCode, Parser, ScopeItem, TimescaleUnit, Value, VarType};

/// What a dump says: for each variable its kind, its width, and its value at each time that is there.
struct Dump {
    program: String,
    variables: BTreeMap<String, (VarType, u32, IdCode)>,
    times: Vec<(u64, BTreeMap<IdCode, String>)>,
    comments: Vec<String>,
    changes: usize,
}

fn read(text: &str) -> Dump {
    let mut parser = Parser::new(text.as_bytes());
    let header = parser.parse_header().unwrap();
    assert_eq!(header.timescale, Some((1, TimescaleUnit::MS)));
    let scopes =
        header.items.iter().filter_map(|item| if let ScopeItem::Scope(scope) = item { Some(scope) } else { None });
    let [top] = scopes.collect::<Vec<_>>()[..] else { panic!("{text}") };
    let mut dump = Dump {
        program: top.identifier.clone(),
        variables: BTreeMap::new(),
        times: Vec::new(),
        comments: text.lines().filter_map(|line| line.strip_prefix("$comment ")).map(str::to_owned).collect(),
        changes: 0,
    };
    declared(&top.items, "", &mut dump.variables);
    let mut now = BTreeMap::new();
    let mut bits = |code, bits: String| {
        dump.changes += 1;
        now.insert(code, bits);
        now.clone()
    };
    for command in parser {
        let values = match command.unwrap() {
            Command::Timestamp(time) => {
                let values = dump.times.last().map(|(_, values)| values.clone()).unwrap_or_default();
                dump.times.push((time, values));
                continue;
            }
            Command::ChangeScalar(code, value) => bits(code, value.to_string()),
            Command::ChangeVector(code, vector) => {
                bits(code, vector.iter().map(|bit: Value| bit.to_string()).collect())
            }
            Command::Begin(_) | Command::End(_) => continue,
            other => panic!("{other:?}"),
        };
        dump.times.last_mut().unwrap().1 = values;
    }
    dump
}

fn declared(items: &[ScopeItem], path: &str, into: &mut BTreeMap<String, (VarType, u32, IdCode)>) {
    let plain = |name: &str| format!("{path}{}", name.strip_prefix('\\').unwrap_or(name));
    for item in items {
        match item {
            ScopeItem::Scope(scope) => declared(&scope.items, &format!("{}.", plain(&scope.identifier)), into),
            ScopeItem::Var(var) => {
                assert_eq!(var.index, None);
                let twice = into.insert(plain(&var.reference), (var.var_type, var.size, var.code));
                assert!(twice.is_none(), "{}", var.reference);
            }
            _ => {}
        }
    }
}

/// The dump has what the trace has.
fn agrees(system: &System, trace: &ScanTrace) -> Result<Dump, TestCaseError> {
    let program = &system.program;
    let dump = read(&vcd::write(system, trace, "a test"));
    prop_assert_eq!(&dump.program, &program.name);
    prop_assert_eq!(dump.variables.len(), program.declared().count());
    let times: Vec<u64> = dump.times.iter().map(|(time, _)| *time).collect();
    prop_assert_eq!(times, (0..=trace.scans.len() as u64).map(|scan| scan * program.cycle).collect::<Vec<_>>());
    let mut changes = program.declared().count();
    for id in program.declared() {
        let variable = program.variable(id);
        let &(kind, width, code) = &dump.variables[&variable.name];
        prop_assert_eq!((kind, width), (expected(variable.ty), variable.ty.width), "{}", variable.name);
        let mut before = variable.initial;
        for (position, (_, values)) in dump.times.iter().enumerate() {
            let value = match position.checked_sub(1) {
                None => variable.initial,
                Some(scan) => trace.scans[scan].end.as_ref().unwrap().memory[id.0],
            };
            let read = u64::from_str_radix(&values[&code], 2).ok();
            prop_assert_eq!(read, Some(value), "{} at {}", variable.name, position);
            changes += usize::from(value != before);
            before = value;
        }
    }
    prop_assert_eq!(dump.changes, changes, "only what changes is there");
    Ok(dump)
}

fn expected(ty: Type) -> VarType {
    match ty.to_string().as_str() {
        "BOOL" => VarType::Wire,
        "BYTE" | "WORD" | "DWORD" | "LWORD" => VarType::Reg,
        _ => VarType::Integer,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(programs(100)))]

    #[test]
    fn a_dump_has_every_value(numbers in proptest::collection::vec(any::<u32>(), 0..400), seed: u64) {
        let program = support::program(&random_wide_program::text(&mut Choices::new(&numbers)));
        let system = System::new(program, Plant::default());
        agrees(&system, &by_chance(&system, seed, 12))?;
    }
}

#[test]
fn instances_and_structures_are_scopes_and_elements_have_escaped_names() {
    let system = system(
        "TYPE Point : STRUCT x : SINT; ok : BOOL; END_STRUCT; END_TYPE\n\
         FUNCTION_BLOCK pump VAR_INPUT on : BOOL; END_VAR VAR T : TON; END_VAR\n\
         CAL T(IN := on, PT := T#50ms)\nEND_FUNCTION_BLOCK\n\
         PROGRAM p VAR_INPUT go : BOOL; k : SINT; END_VAR\n\
         VAR pump_1 : pump; grid : ARRAY [0..1, -1..0] OF WORD; line : ARRAY [2..3] OF Point; END_VAR\n\
         CAL pump_1(on := go)\nLD k\nST line[2].x\nLD grid[0,-1]\nNOT\nST grid[1,0]\nEND_PROGRAM",
        &[],
    );
    let dump = agrees(&system, &by_chance(&system, 7, 30)).unwrap();
    assert_eq!(dump.times[1].0, 20);
    for name in
        ["go", "k", "pump_1.on", "pump_1.T.Q", "pump_1.T.ET", "grid[0,-1]", "grid[1,0]", "line[2].x", "line[3].ok"]
    {
        assert!(dump.variables.contains_key(name), "{name}: {:?}", dump.variables.keys());
    }
    let text = vcd::write(&system, &by_chance(&system, 7, 1), "");
    assert!(text.contains("$scope module \\line[2] $end\n$var integer 8"), "{text}");
    assert!(text.contains(" \\grid[0,-1] $end\n"), "{text}");
    assert!(text.contains("$comment a scan every 20 ms $end\n"), "{text}");
}

/// Scan 2 never ends: its input is known, the output is not.
#[test]
fn what_is_not_known_is_x() {
    let text = "PROGRAM p VAR_INPUT i : BOOL; END_VAR VAR_OUTPUT q : BOOL; n : INT; END_VAR\n\
                LDN q\nST q\nLD n\nADD 1\nST n\non: LD i\nJMPC on\nEND_PROGRAM";
    let system = system(text, &[]);
    let mut trace = by_chance(&System::new(system.program.clone(), Plant::default()), 3, 0);
    let input = VarId(0);
    for value in [0, 1] {
        let state = trace.scans.last().map_or_else(
            || petril::explore::ScanState::power_on(&system),
            |scan: &petril::witness::Scan| scan.end.clone().unwrap(),
        );
        let plan = petril::simulate::Plan { moves: vec![], inputs: vec![(input, value)] };
        trace.scans.push(petril::simulate::scan(&system, Default::default(), &state, &plan).unwrap().0);
    }
    let dump = read(&vcd::write(&system, &trace, "an end of $end\nand a line"));
    let at = |time: usize, name: &str| dump.times[time].1[&dump.variables[name].2].clone();
    let rows = (0..3).map(|time| ["i", "q", "n"].map(|name| at(time, name))).collect::<Vec<_>>();
    assert_eq!(rows, [["0", "0", "0"], ["0", "1", "1"], ["1", "x", "x"]].map(|row| row.map(str::to_owned)));
    assert_eq!(dump.comments[0], "an end of $ end and a line $end");
}

/// A counterexample that is a lasso, with a plant.
#[test]
fn comments_tell_of_the_plant_and_the_loop() {
    let text = "PROGRAM p VAR_INPUT i : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR\nLD i\nST q\nEND_PROGRAM";
    let plant = "net button\npl {i=0} (1)\npl {i=1}\ntr press {i=0} -> {i=1}\n";
    let system = system(text, &[plant]);
    let report = support::reports::report(&system, "requirement r: AG AF !q;");
    let trace = support::reports::counterexample(&report, "r");
    let dump = agrees(&system, trace).unwrap();
    assert_eq!(
        dump.comments,
        [
            "a test $end",
            "before scan 1: button.press $end",
            "and so on for ever: scan 2 ends in the state in which scan 1 ended $end",
            "a scan every 20 ms $end",
        ]
    );
}

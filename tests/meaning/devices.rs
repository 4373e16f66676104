//! Plants as devices: how a net falls into them, where they can go, and what keeps a net from being a plant.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::diagnostic::Code;
use petril::exchange::tina;
use petril::flat::FlatProgram;
use petril::source::Source;
use petril::translate::plant::{Component, Move};
use petril::translate::{Plant, System};

/// Inputs `a`, `b`, memory `m`, output `q`, which is TRUE at the beginning, output `r`.
const PROGRAM: &str = "PROGRAM p VAR_INPUT a, b : BOOL; END_VAR VAR m : BOOL; END_VAR
VAR_OUTPUT q : BOOL := TRUE; r : BOOL; END_VAR\nLD a\nST m\nSTN q\nST r\nEND_PROGRAM";

fn program() -> FlatProgram {
    support::program(PROGRAM)
}

fn with(plant: &mut Plant, net: &str, name: &str) -> Result<(), Vec<(Code, usize)>> {
    let source = Source::new(format!("{name}.net"), net);
    let net = tina::read(&source).unwrap_or_else(|e| panic!("{e:#?}"));
    let place = |d: &petril::diagnostic::Diagnostic| (d.code, source.line_of(d.span().start));
    plant.add(&net, &program()).map(drop).map_err(|errors| errors.iter().map(place).collect())
}

fn plant(net: &str) -> Plant {
    let mut plant = Plant::default();
    with(&mut plant, net, "n").unwrap_or_else(|e| panic!("{e:?}"));
    plant
}

/// What is wrong with a net, as code and line.
fn errors(net: &str) -> Vec<(Code, usize)> {
    with(&mut Plant::default(), net, "n").unwrap_err()
}

/// The names of the marked places in a device's markings.
fn markings(device: &Component) -> Vec<Vec<&str>> {
    let names = |marked: &Vec<usize>| marked.iter().map(|&place| device.places[place].name.as_str()).collect();
    device.markings.iter().map(|marking| names(&marking.marked)).collect()
}

/// A cylinder that goes out while `q` is TRUE and back while it is FALSE; `a` and `b` are its limit switches.
const CYLINDER: &str = "pl {a=1,b=0} (1)
tr out1 {a=1,b=0} {q=1}?1 -> {a=0,b=0}
tr out2 {a=0,b=0} {q=1}?1 -> {a=0,b=1}
tr in1 {a=0,b=1} {q=0}?1 -> {a=0,b=0}
tr in2 {a=0,b=0} {q=0}?1 -> {a=1,b=0}
";

#[test]
fn a_net_falls_into_devices_that_outputs_do_not_join() {
    let net = "pl {a=0} (1)\ntr t {a=0} {q=1}?1 -> {a=1}\npl {b=0} (1)\ntr u {b=0} {q=1}?1 -> {b=1}\npl {b=1}\n";
    let plant = plant(net);
    let names: Vec<&str> = plant.components.iter().map(|device| device.name.as_str()).collect();
    assert_eq!(names, ["n.1", "n.2"]);
    assert_eq!(markings(&plant.components[0]), [["n.a=0"], ["n.a=1"]]);
    assert_eq!(markings(&plant.components[1]), [["n.b=0"], ["n.b=1"]]);
    let [a, b] = ["a", "b"].map(|name| program().find(name).unwrap());
    assert_eq!((plant.driver(a), plant.driver(b)), (Some(0), Some(1)));
    // A place that is read joins as one that is taken from does.
    let joined = self::plant("pl {a=0} (1)\ntr t {a=0} {b=0}?1 -> {a=1}\npl {b=0} (1)\n");
    assert_eq!(joined.components.iter().map(|device| device.name.as_str()).collect::<Vec<_>>(), ["n"]);
}

#[test]
fn the_closure_follows_the_outputs() {
    let plant = plant(CYLINDER);
    let device = &plant.components[0];
    assert_eq!(markings(device), [["n.a=1,b=0"], ["n.a=0,b=0"], ["n.a=0,b=1"]]);
    let reached = |from, q| -> Vec<usize> { device.closure(from, |_| q).iter().map(|&(marking, _)| marking).collect() };
    assert_eq!(reached(0, 1), [0, 1, 2], "out, nearest first");
    assert_eq!(reached(1, 1), [1, 2]);
    assert_eq!(reached(2, 1), [2], "it is out");
    assert_eq!(reached(2, 0), [2, 1, 0], "in again");
    assert_eq!(reached(0, 0), [0]);
    let (_, by) = device.closure(0, |_| 1)[2];
    assert_eq!(by, Some((1, Move { transition: 1, target: 2 })));
}

#[test]
fn paths_are_shortest_or_there_is_none() {
    let plant = plant(CYLINDER);
    let device = &plant.components[0];
    assert_eq!(device.path(0, 2, |_| 1), Some(vec![0, 1]));
    assert_eq!(device.path(2, 0, |_| 0), Some(vec![2, 3]));
    assert_eq!(device.path(1, 1, |_| 1), Some(vec![]));
    assert_eq!(device.path(0, 2, |_| 0), None);
    assert_eq!(device.path(2, 1, |_| 1), None);
    // Two ways, by a second marking that says the same of the input: the shorter one is taken, though it is defined last.
    let ways = "pl {a=0} (1)\npl new (1)\ntr s {a=0}?1 new -> worn\ntr t {a=0} worn?1 -> {a=1}\ntr u {a=0} new -> {a=1} worn\n";
    let ways = self::plant(ways);
    let device = &ways.components[0];
    assert_eq!(markings(device), [["n.a=0", "n.new"], ["n.a=0", "n.worn"], ["n.worn", "n.a=1"]]);
    assert_eq!(device.path(0, 2, |_| 1), Some(vec![2]));
}

/// What is probably mistyped: the line of each warning.
#[test]
fn doubtful_parts_are_told() {
    use Code::{PlantPlaceUndeclared as Undeclared, PlantTransitionDead as Dead};
    let warnings = |net: &str| {
        let source = Source::new("n.net", net);
        let found = Plant::default().add(&tina::read(&source).unwrap(), &program()).unwrap();
        found.iter().map(|d| (d.code, source.line_of(d.span().start))).collect::<Vec<_>>()
    };
    let there_and_back = "pl {a=0} (1)\ntr t {a=0} -> {a=1}\ntr u {a=1} -> {a=0}\n";
    assert_eq!(warnings(there_and_back), []);
    assert_eq!(warnings("pl {a=0} (1)\ntr t {a=0} -> {a=1}\n"), [(Undeclared, 2)]);
    assert_eq!(warnings("pl {a=0} (1)\npl {a=1}\ntr t {a=0} -> {a=1}\n"), []);
    assert_eq!(warnings(&format!("{there_and_back}tr v {{a=1}} x -> {{a=0}}\n")), [(Dead, 4)]);
    assert_eq!(warnings(&format!("{there_and_back}tr v {{a=1}} {{a=0}}?1 -> {{a=1}}\n")), [(Dead, 4)]);
    // An output has one value at a time; a test of it in two spellings is one test.
    assert_eq!(warnings(&format!("{there_and_back}tr v {{a=1}} {{q=1}}?1 {{q=0}}?1 -> {{a=0}}\n")), [(Dead, 4)]);
    assert_eq!(warnings(&format!("{there_and_back}tr v {{a=1}} {{q=1}}?1 {{Q=TRUE}}?1 -> {{a=0}}\n")), []);
    // Nothing leaves `{a=1}` but a loop.
    assert_eq!(warnings("pl {a=0} (1)\ntr t {a=0} -> {a=1}\ntr u {a=1} -> {a=1}\n"), [(Undeclared, 2)]);
}

#[test]
fn markings_give_each_input_its_value() {
    let plant = plant(CYLINDER);
    let [a, b] = ["a", "b"].map(|name| program().find(name).unwrap());
    let values: Vec<_> = plant.components[0].markings.iter().map(|marking| marking.inputs.clone()).collect();
    assert_eq!(values, [[(a, 1), (b, 0)], [(a, 0), (b, 0)], [(a, 0), (b, 1)]]);
    let tests: Vec<_> = plant.components[0].transitions.iter().map(|t| t.tests[0].1).collect();
    assert_eq!(tests, [1, 1, 0, 0]);
}

#[test]
fn each_check_finds_what_it_is_for() {
    use Code::*;
    let cases: [(&str, &[(Code, usize)]); 23] = [
        ("pl {c=1} (1)\npl {a=1} (1)\n", &[(PlantVariableUnknown, 1)]),
        ("pl {c=1} (1)\npl {c=0}\npl {d=0}\n", &[(PlantVariableUnknown, 1), (PlantVariableUnknown, 3)]),
        ("pl {m=1} (1)\n", &[(PlantVariableUnfit, 1)]),
        ("pl {a=2} (1)\n", &[(PlantVariableUnfit, 1)]),
        ("pl {a=1,b} (1)\n", &[(PlantVariableUnfit, 1)]),
        ("pl {a=1,A=1} (1)\n", &[(PlantVariableUnfit, 1)]),
        ("pl {a=1,q=1} (1)\n", &[(PlantVariableUnfit, 1)]),
        ("pl {q=0} (1)\n", &[(PlantVariableUnfit, 1)]),
        ("pl {r=1} (1)\npl {a=0} (1)\n", &[(PlantVariableUnfit, 1)]),
        ("pl x (1)\n", &[(PlantVariableUnfit, 1)]),
        ("", &[(PlantVariableUnfit, 1)]),
        ("pl {a=0} (1)\ntr t {a=0} -> {a=1} {q=0}\n", &[(PlantWritesProgram, 2)]),
        ("pl {a=0} (1)\ntr t {a=0} {q=1} -> {a=1}\n", &[(PlantWritesProgram, 2)]),
        ("pl {a=0} (1)\ntr t {a=0}?1 -> x\n", &[(PlantNotSafe, 2)]),
        ("pl {a=0} (1)\ntr t -> {a=0}\n", &[(PlantNotSafe, 1)]),
        ("pl {a=0}\n", &[(PlantInputAmbiguous, 1)]),
        ("pl {a=0} (1)\ntr t {a=0} -> x\n", &[(PlantInputAmbiguous, 1)]),
        ("pl {a=0} (1)\npl x (1)\ntr t x {a=0}?1 -> {a=1}\n", &[(PlantInputAmbiguous, 3)]),
        ("pl {a=0} (1)\npl {a=1} (1)\n", &[(PlantInputAmbiguous, 2)]),
        ("pl {a=0} (1)\ntr t {a=0} -> {A=1}\ntr u {a=1} -> {a=0}\n", &[(PlantValuationTwice, 3)]),
        ("pl {a=0} (1)\ntr t {a=0} -> {a=TRUE}\ntr u { a=1} -> {a=0}\n", &[(PlantValuationTwice, 3)]),
        ("pl {a=0,b=0} (1)\ntr t {a=0,b=0} -> {a=1,b=0}\ntr u {b=0,a=1} -> {a=0,b=0}\n", &[(PlantValuationTwice, 3)]),
        ("pl {a=0} (1)\npl {b=0}\ntr t {a=0} {r=1}?1 -> x\n", &[(PlantInputAmbiguous, 1), (PlantInputAmbiguous, 2)]),
    ];
    for (net, expected) in cases {
        assert_eq!(errors(net), expected, "{net}");
    }
}

/// A declaration leaves out values of a type; a plant keeps to it.
#[test]
fn values_are_those_of_subranges_and_enumerations() {
    let program = support::program(
        "TYPE Colour : (Red, Green); END_TYPE
         PROGRAM p VAR_INPUT k : INT (-5..20); c : Colour; END_VAR VAR_OUTPUT q : BOOL; END_VAR
         LD k\nGT 3\nST q\nLD c\nEQ Green\nST q\nEND_PROGRAM",
    );
    let told = |net: &str| {
        let located = tina::read(&Source::new("n", net)).unwrap();
        let added = Plant::default().add(&located, &program);
        added.map(drop).map_err(|errors| errors.iter().map(|error| error.code).collect::<Vec<_>>())
    };
    for (place, expected) in [
        ("{k=20}", Ok(())),
        ("{k=-5}", Ok(())),
        ("{k=21}", Err(vec![Code::PlantVariableUnfit])),
        ("{k=-6}", Err(vec![Code::PlantVariableUnfit])),
        ("{c=1}", Ok(())),
        ("{c=2}", Err(vec![Code::PlantVariableUnfit])),
    ] {
        assert_eq!(told(&format!("pl {place} (1)\n")), expected, "{place}");
    }
}

#[test]
fn what_the_program_begins_with_may_be_marked() {
    assert_eq!(plant("pl {q=1} (1)\npl {a=0} (1)\npl {r=0}\n").components.len(), 1);
}

#[test]
fn a_second_plant_is_held_to_the_first() {
    let mut plant = plant("pl {a=0} (1)\n");
    assert_eq!(with(&mut plant, "pl {b=0} (1)\n", "n"), Err(vec![(Code::PlantNameTwice, 1)]));
    assert_eq!(with(&mut plant, "net o\npl {a=0} (1)\n", "o"), Err(vec![(Code::PlantInputAmbiguous, 2)]));
    assert_eq!(plant.components.len(), 1, "nothing is added of a plant that is refused");
    assert_eq!(with(&mut plant, "net o\npl {b=0} (1)\n", "o"), Ok(()));
    assert_eq!(plant.names(), ["n", "o"]);
    assert_eq!(System::new(program(), plant).free_inputs().count(), 0);
}

/// Outputs have any value here: the device must be right even where this program never drives it.
#[test]
fn checks_do_not_depend_on_what_the_program_does() {
    let never = "pl {a=0} (1)\ntr t {a=0} {q=1,r=1}?1 -> x\n";
    assert_eq!(errors(never), [(Code::PlantInputAmbiguous, 1)]);
}

/// Names of nodes are unique in the composed net, whatever the plants are called: a net `n` of two devices has a device
/// `n.1`, and so has a net of that name.
#[test]
fn names_of_nodes_are_unique() {
    let two_devices = "net n\npl {a=0} (1)\ntr t {a=0} -> {a=1}\npl {1.u} (1)\ntr v {1.u} -> w\n";
    for (net, expected) in [
        ("net {n.1}\npl {b=0} (1)\ntr t {b=0} -> {b=1}\n", Err(vec![(Code::PlantNameTwice, 2)])),
        ("net {n.1}\npl {b=0} (1)\npl u\ntr t {b=0} -> {b=1}\n", Err(vec![(Code::PlantNameTwice, 2)])),
        ("net {n.3}\npl {b=0} (1)\ntr t {b=0} -> {b=1}\n", Ok(())),
    ] {
        let mut plant = plant(two_devices);
        assert_eq!(with(&mut plant, net, "o"), expected, "{net}");
        let system = System::new(program(), plant);
        let mut places: Vec<&str> = system.net.places().map(|place| place.name).collect();
        places.sort_unstable();
        assert!(places.windows(2).all(|pair| pair[0] != pair[1]), "{places:?}");
    }
}

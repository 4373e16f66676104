//! Random Boolean programs with random plants.

use petril::flat::FlatProgram;
use petril::net::{Arcs, Builder, Located};
use petril::source::Span;
use petril::translate::{Plant, System};
use proptest::prelude::*;

/// Variables of every random program, by role.
const INPUTS: [&str; 3] = ["i0", "i1", "i2"];
const WRITTEN: [&str; 5] = ["m0", "m1", "m2", "q0", "q1"];

/// A program text: three inputs, three memory bits, two outputs, up to `statements` statements.
pub fn text(statements: usize) -> impl Strategy<Value = String> {
    let initial = proptest::collection::vec(any::<bool>(), WRITTEN.len());
    (initial, proptest::collection::vec(statement(statements), 0..=statements)).prop_map(|(initial, statements)| {
        let mut text = "PROGRAM random\nVAR_INPUT i0, i1, i2 : BOOL; END_VAR\n".to_owned();
        for (name, value) in WRITTEN.iter().zip(initial) {
            let kind = if name.starts_with('m') { "VAR" } else { "VAR_OUTPUT" };
            text += &format!("{kind} {name} : BOOL := {}; END_VAR\n", if value { "TRUE" } else { "FALSE" });
        }
        for (i, statement) in statements.iter().enumerate() {
            text += &format!("l{i}: {}", statement.replace("?", &statements.len().to_string()));
        }
        text += &format!("l{}:\nEND_PROGRAM\n", statements.len());
        // A jump beyond the last statement goes to the end.
        for beyond in (statements.len() + 1)..=20 {
            text = text.replace(&format!(" l{beyond}\n"), &format!(" l{}\n", statements.len()));
        }
        text
    })
}

fn operand() -> impl Strategy<Value = String> {
    let names = INPUTS.into_iter().chain(WRITTEN).chain(["TRUE", "FALSE"]).collect::<Vec<_>>();
    proptest::sample::select(names).prop_map(str::to_owned)
}

/// A statement loads, combines, and stores, sets, resets, jumps or returns.
fn statement(statements: usize) -> impl Strategy<Value = String> {
    let load = (proptest::sample::select(vec!["LD", "LDN"]), operand()).prop_map(|(op, x)| format!("{op} {x}\n"));
    let writes = proptest::sample::select(vec!["ST", "STN", "S", "R"]);
    let write = (writes, proptest::sample::select(WRITTEN.to_vec())).prop_map(|(op, x)| format!("{op} {x}\n"));
    let jumps = proptest::sample::select(vec!["JMP", "JMPC", "JMPCN", "JMPC", "JMPCN"]);
    let jump = (jumps, 0..=statements).prop_map(|(op, to)| format!("{op} l{to}\n"));
    let ret = proptest::sample::select(vec!["RETC\n", "RETCN\n"]).prop_map(str::to_owned);
    let sink = prop_oneof![6 => write, 1 => jump, 1 => ret];
    let (combines, sinks) = (proptest::collection::vec(combine(), 0..4), proptest::collection::vec(sink, 1..3));
    (load, combines, sinks).prop_map(|(load, combines, sinks)| load + &combines.concat() + &sinks.concat())
}

/// An operator with an operand, `NOT`, or a parenthesis in one of its forms.
fn combine() -> impl Strategy<Value = String> {
    let operator = || proptest::sample::select(vec!["AND", "ANDN", "OR", "ORN", "XOR", "XORN", "&", "&N"]);
    let simple = prop_oneof![
        5 => (operator(), operand()).prop_map(|(op, x)| format!("{op} {x}\n")),
        1 => Just("NOT\n".to_owned()),
    ];
    simple.prop_recursive(3, 12, 3, move |inner| {
        let list = || proptest::collection::vec(inner.clone(), 0..3);
        prop_oneof![
            (operator(), operand(), list()).prop_map(|(op, x, list)| format!("{op}( {x}\n{})\n", list.concat())),
            (operator(), operand(), list()).prop_map(|(op, x, list)| format!("{op}(\nLD {x}\n{})\n", list.concat())),
        ]
    })
}

/// A device that drives `i0` and `i1`: two to four positions, and moves between them that may need a value of `q0`.
pub fn device() -> impl Strategy<Value = Located> {
    let test = || proptest::option::of(any::<bool>());
    let moves = proptest::collection::vec((0..4_usize, 0..4_usize, test()), 0..4);
    // The first moves connect the positions, so that they are one device.
    let chain = proptest::collection::vec(test(), 3);
    (2..=4_usize, chain, moves).prop_map(|(positions, chain, moves)| {
        let chain = (1..positions).zip(chain).map(|(to, test)| (to - 1, to, test));
        let moves: Vec<_> = chain.chain(moves).collect();
        let mut builder = Builder::new("device");
        let places: Vec<_> =
            (0..positions).map(|i| builder.place(format!("i0={},i1={}", i % 2, i / 2), i == 0)).collect();
        let tests = [false, true].map(|value| builder.place(format!("q0={}", u8::from(value)), false));
        for (i, &(from, to, test)) in moves.iter().enumerate() {
            let read = test.map(|value| tests[usize::from(value)]);
            let (consume, produce) = (&[places[from % positions]], &[places[to % positions]]);
            builder.transition(format!("t{i}"), Arcs { consume, produce, read: read.as_slice() });
        }
        let net = builder.build();
        let (places, transitions) = (net.places().len(), net.transitions().len());
        Located {
            net,
            places: vec![Span::default(); places],
            transitions: vec![Span::default(); transitions],
            undeclared: Vec::new(),
            ids: None,
            units: None,
            not_safe: Vec::new(),
            warnings: Vec::new(),
        }
    })
}

/// The system of a program with or without a device.
pub fn system(program: FlatProgram, device: Option<&Located>) -> System {
    let mut plant = Plant::default();
    if let Some(device) = device {
        plant.add(device, &program).unwrap_or_else(|e| panic!("{e:?}"));
    }
    System::new(program, plant)
}

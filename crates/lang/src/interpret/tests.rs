//! Every instruction against its truth table, worked out by hand from IEC 61131-3, table 52.

use super::*;
use crate::flat::flatten;
use crate::semantics::check;
use crate::syntax::parse;
use petril_base::source::Source;

fn program(body: &str) -> FlatProgram {
    let text = format!(
        "PROGRAM p VAR_INPUT a, x : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR VAR m : BOOL; END_VAR\n{body}\nEND_PROGRAM"
    );
    let (unit, errors) = parse(&Source::new("test", text));
    let (program, more) = check(&unit, errors.is_empty());
    flatten(&program.unwrap_or_else(|| panic!("{errors:?} {more:?}")))
}

/// The output `q` after one scan for (a, x) = 00, 01, 10, 11, `q` being `before` at its beginning.
fn table(body: &str, before: bool) -> [u64; 4] {
    let program = program(body);
    let [a, x, q] = ["a", "x", "q"].map(|name| program.find(name).unwrap());
    [(false, false), (false, true), (true, false), (true, true)].map(|values| {
        let mut machine = Machine::new(&program);
        machine.set(a, u64::from(values.0));
        machine.set(x, u64::from(values.1));
        machine.set(q, u64::from(before));
        machine.scan().unwrap();
        machine.value(q)
    })
}

#[test]
fn operators_compute_their_truth_tables() {
    let tables = [
        ("LD x\nST q", [0, 1, 0, 1]),
        ("LDN x\nST q", [1, 0, 1, 0]),
        ("LD x\nSTN q", [1, 0, 1, 0]),
        ("LD a\nAND x\nST q", [0, 0, 0, 1]),
        ("LD a\nANDN x\nST q", [0, 0, 1, 0]),
        ("LD a\n& x\nST q", [0, 0, 0, 1]),
        ("LD a\n&N x\nST q", [0, 0, 1, 0]),
        ("LD a\nOR x\nST q", [0, 1, 1, 1]),
        ("LD a\nORN x\nST q", [1, 0, 1, 1]),
        ("LD a\nXOR x\nST q", [0, 1, 1, 0]),
        ("LD a\nXORN x\nST q", [1, 0, 0, 1]),
        ("LD a\nNOT\nST q", [1, 1, 0, 0]),
        ("LD a\nAND TRUE\nST q", [0, 0, 1, 1]),
        ("LD FALSE\nORN x\nST q", [1, 0, 1, 0]),
    ];
    for (body, expected) in tables {
        assert_eq!(table(body, false), expected, "{body}");
        assert_eq!(table(body, true), expected, "{body}: the old value does not matter");
    }
}

#[test]
fn set_and_reset_act_only_on_true() {
    assert_eq!(table("LD a\nS q", false), [0, 0, 1, 1]);
    assert_eq!(table("LD a\nS q", true), [1, 1, 1, 1]);
    assert_eq!(table("LD a\nR q", false), [0, 0, 0, 0]);
    assert_eq!(table("LD a\nR q", true), [1, 1, 0, 0]);
    assert_eq!(table("LD a\nS m\nR m\nST q", false), [0, 0, 1, 1], "they leave the current result alone");
}

#[test]
fn a_parenthesis_is_computed_before_its_operator() {
    for body in ["LD a\nAND( x\nORN a\n)\nST q", "LD a\nAND(\nLD x\nORN a\n)\nST q"] {
        assert_eq!(table(body, false), [0, 0, 0, 1], "{body}");
    }
    assert_eq!(table("LD a\nANDN( x\nOR a\n)\nST q", false), [0, 0, 0, 0], "a AND NOT (x OR a)");
    assert_eq!(table("LD a\nXORN( x\n)\nST q", false), [1, 0, 0, 1]);
    assert_eq!(
        table("LD a\nOR( x\nAND( a\nXOR( x\nNOT\n)\n)\n)\nST q", false),
        [0, 0, 1, 1],
        "a OR (x AND (a XOR NOT x))"
    );
    assert_eq!(table("LD a\nOR( x\nST m\nNOT\n)\nAND m\nST q", false), [0, 0, 0, 1], "(a OR NOT x) AND x");
}

#[test]
fn jumps_and_returns_look_at_the_current_result() {
    assert_eq!(table("LD a\nJMPC on\nLD x\non: ST q", false), [0, 1, 1, 1]);
    assert_eq!(table("LD a\nJMPCN on\nLD x\non: ST q", false), [0, 0, 0, 1]);
    assert_eq!(table("LD a\nJMP on\nLD x\non: ST q", false), [0, 0, 1, 1]);
    assert_eq!(table("LD a\nRETC\nLD x\nST q", false), [0, 1, 0, 0]);
    assert_eq!(table("LD a\nRETCN\nLD x\nST q", false), [0, 0, 0, 1]);
    assert_eq!(table("LD a\nST q\nRET\nLD x\nST q", false), [0, 0, 1, 1]);
}

#[test]
fn a_loop_ends_or_is_found_out() {
    // m counts to one and ends the loop: two rounds.
    let ending = program("on: LDN m\nST m\nJMPC on\nLD m\nST q");
    assert_eq!(Machine::new(&ending).scan(), Ok(()));
    // An endless loop: after m has flipped twice, the state is the same again.
    let endless = program("on: LDN m\nST m\nJMP on");
    assert_eq!(Machine::new(&endless).scan(), Err(Fault::Endless));
    assert_eq!(Machine::new(&program("on: JMP on")).scan(), Err(Fault::Endless));
}

/// A counter of 30 bits takes a thousand million rounds to come to its end: no state repeats, and the limit of steps is
/// reached.
#[test]
fn a_loop_that_ends_too_late_is_given_up() {
    let bits: Vec<String> = (0..30).map(|i| format!("b{i}")).collect();
    // The lowest bit that is 0 becomes 1, those below it become 0.
    let count: String = bits.iter().map(|b| format!("LD {b}\nSTN {b}\nJMPCN on\n")).collect();
    let text = format!(
        "PROGRAM p VAR {} : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR\non:\n{count}LD TRUE\nST q\nEND_PROGRAM",
        bits.join(", ")
    );
    let (unit, _) = parse(&Source::new("test", text));
    let program = flatten(&check(&unit, true).0.unwrap());
    assert_eq!(Machine::new(&program).scan(), Err(Fault::TooLong));
}

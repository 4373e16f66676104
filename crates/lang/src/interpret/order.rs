//! The order in which a call reads, executes and writes, worked out by hand.

use super::written_out::{Run, flat};
use crate::syntax::parse;
use petril_base::source::Source;

/// Two functions and a function block that read `x` and pass it on.
const HANDED_ON: &str = "FUNCTION f : BOOL\nVAR_INPUT x : BOOL; END_VAR VAR_OUTPUT y : BOOL; END_VAR\nLD x\nST f\nSTN y\nEND_FUNCTION\n\
    FUNCTION moved : INT\nVAR_INPUT x, by : INT := 10; END_VAR VAR_OUTPUT y : INT; END_VAR\nLD x\nST moved\nADD by\nST y\nEND_FUNCTION\n\
    FUNCTION_BLOCK g\nVAR_INPUT x : BOOL; n, m : INT; END_VAR VAR_OUTPUT y : BOOL; END_VAR\nLD x\nST y\nEND_FUNCTION_BLOCK\n";

#[test]
fn eno_is_written_after_the_call_has_read_its_inputs() {
    let calls = [
        "f(x := v, ENO => v)",
        "f(EN := TRUE, x := v, ENO => v)",
        "f(ENO => v, x := v)",
        "CAL b(x := v, ENO => v)\nLD b.y",
        "CAL b(EN := TRUE, ENO => v, x := v)\nLD b.y",
        "AND(IN1 := v, IN2 := TRUE, ENO => v)",
        "MOVE(EN := TRUE, IN := v, ENO => v)",
        "SEL(G := v, IN0 := FALSE, IN1 := TRUE, ENO => v)",
        "EQ(IN1 := v, IN2 := TRUE, ENO => v)",
    ];
    for call in calls {
        let text = format!(
            "{HANDED_ON}PROGRAM p VAR_INPUT a : BOOL; END_VAR VAR v : BOOL; b : g; END_VAR VAR_OUTPUT q : BOOL; END_VAR\n\
             LD a\nST v\n{call}\nST q\nEND_PROGRAM"
        );
        let program = flat(&text);
        let mut run = Run::new(&program);
        for a in [0, 1, 0] {
            run.scan(&[("a", a)]);
            assert_eq!((run.get("q"), run.get("v")), (a, 1), "{call}");
        }
    }
}

#[test]
fn outputs_are_written_in_the_order_of_the_text() {
    // The output `y` is FALSE, `ENO` TRUE; the later one remains.
    for (call, v) in [
        ("f(x := TRUE, y => v, ENO => v)", 1),
        ("f(x := TRUE, ENO => v, y => v)", 0),
        ("f(EN := TRUE, ENO => v, x := TRUE, NOT y => v)", 1),
        ("f(EN := FALSE, x := TRUE, NOT ENO => v, y => v)", 1),
        ("f(EN := FALSE, x := FALSE, y => v, ENO => v)", 0),
        ("CAL b(x := FALSE, ENO => v, y => v)", 0),
        ("CAL b(x := FALSE, y => v, ENO => v)", 1),
    ] {
        let text = format!("{HANDED_ON}PROGRAM p VAR v : BOOL; b : g; END_VAR\n{call}\nEND_PROGRAM");
        let program = flat(&text);
        let mut run = Run::new(&program);
        run.scan(&[]);
        assert_eq!(run.get("v"), v, "{call}");
    }
}

#[test]
fn arguments_are_computed_from_left_to_right() {
    // `moved` returns its input, here 1, and writes 11 to `n`.
    for (call, q, n) in [
        ("ADD(IN1 := n, IN2 := (\nmoved(x := n, y => n)\n))", 2, 11),
        ("ADD(IN1 := (\nmoved(x := n, y => n)\n), IN2 := n)", 12, 11),
        ("SUB(IN1 := (\nmoved(x := n, y => n)\nMUL 5\n), IN2 := (\nLD n\n))", -6, 11),
        ("moved(x := n, by := (\nmoved(x := n, y => n)\n))", 1, 11),
        ("moved(by := (\nmoved(x := n, y => n)\n), x := n)", 11, 11),
        ("moved(x := (\nmoved(x := (\nmoved(x := n, y => n)\nADD n\n), y => n)\nADD n\n))", 34, 22),
        ("CAL b(n := 7, m := (\nLD b.n\n))\nLD b.m", 7, 1),
        ("LD n\nADD(\nmoved(x := n, y => n)\n)", 2, 11),
    ] {
        let text = format!(
            "{HANDED_ON}PROGRAM p VAR n : INT := 1; b : g; END_VAR VAR_OUTPUT q : INT; END_VAR\n{call}\nST q\nEND_PROGRAM"
        );
        let program = flat(&text);
        let mut run = Run::new(&program);
        run.scan(&[]);
        assert_eq!((run.get("q"), run.get("n")), (q, n), "{call}");
    }
}

#[test]
fn the_arguments_of_a_call_that_is_not_enabled_are_not_computed() {
    for call in [
        "moved(EN := FALSE, x := (\nLD 1\nDIV z\n))",
        "ADD(EN := FALSE, IN1 := (\nLD 1\nDIV z\n), IN2 := 1)",
        "CAL b(EN := FALSE, n := (\nLD 1\nDIV z\n))\nLD 0",
    ] {
        let text = format!(
            "{HANDED_ON}PROGRAM p VAR z : INT; b : g; END_VAR VAR_OUTPUT q : INT; END_VAR\n{call}\nST q\nEND_PROGRAM"
        );
        let program = flat(&text);
        let mut run = Run::new(&program);
        assert_eq!(run.scan(&[]), [], "{call}");
    }
}

#[test]
fn a_function_without_arguments_is_printed_with_its_parentheses() {
    let text = format!("{HANDED_ON}PROGRAM p VAR_OUTPUT q : INT; END_VAR\nLD 3\nST q\nmoved()\nST q\nEND_PROGRAM");
    let (unit, _) = parse(&Source::new("test", text));
    for text in [unit.to_string(), parse(&Source::new("test", unit.to_string())).0.to_string()] {
        let program = flat(&text);
        let mut run = Run::new(&program);
        run.scan(&[]);
        // `VAR_INPUT x, by : INT := 10`; without parentheses the current result would be `x`.
        assert_eq!(run.get("q"), 10, "{text}");
    }
}

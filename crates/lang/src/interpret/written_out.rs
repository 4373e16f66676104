//! Execution of inlined calls, arrays and functions.

use super::Machine;
use crate::flat::{FlatProgram, Hazard, flatten, flatten_with};
use crate::semantics::check;
use crate::syntax::parse;
use petril_base::source::Source;

pub(super) fn flat(text: &str) -> FlatProgram {
    flatten(&checked(text))
}

fn checked(text: &str) -> crate::semantics::Program {
    let (unit, errors) = parse(&Source::new("test", text));
    let (program, more) = check(&unit, errors.is_empty());
    program.unwrap_or_else(|| panic!("{text}\n{errors:#?}\n{more:#?}"))
}

/// Machine whose variables are set and read by name, as numbers.
pub(super) struct Run<'p> {
    machine: Machine<'p>,
    program: &'p FlatProgram,
}

impl<'p> Run<'p> {
    pub fn new(program: &'p FlatProgram) -> Self {
        Self { machine: Machine::new(program), program }
    }

    /// Executes one scan with these inputs; returns its hazards.
    pub fn scan(&mut self, inputs: &[(&str, i128)]) -> Vec<Hazard> {
        for (name, number) in inputs {
            let id = self.program.find(name).unwrap_or_else(|| panic!("{name}"));
            self.machine.set(id, self.program.variable(id).ty.pattern(*number));
        }
        self.machine.begin_scan();
        self.machine.scan().unwrap_or_else(|fault| panic!("{fault:?}"));
        self.machine.hazards().iter().map(|(_, hazard)| *hazard).collect()
    }

    pub fn get(&self, name: &str) -> i128 {
        let id = self.program.find(name).unwrap_or_else(|| panic!("{name}"));
        self.program.variable(id).ty.number(self.machine.value(id))
    }
}

/// Value of `q`, of type `result`, after a body has run with inputs `a` and `b` of type `ty`.
fn value(ty: &str, result: &str, body: &str, a: i128, b: i128) -> i128 {
    let text = format!(
        "PROGRAM p VAR_INPUT a, b : {ty}; c : BOOL; k : USINT; END_VAR VAR_OUTPUT q : {result}; END_VAR\n{body}\nST q\nEND_PROGRAM"
    );
    let program = flat(&text);
    let mut run = Run::new(&program);
    run.scan(&[("a", a), ("b", b)]);
    run.get("q")
}

#[test]
fn standard_functions_have_the_values_of_the_standard() {
    assert_eq!(value("INT", "INT", "LD a\nABS", -7, 0), 7);
    assert_eq!(value("INT", "INT", "LD a\nMAX b", -7, 3), 3);
    assert_eq!(value("INT", "INT", "LD a\nMIN b, 2, -9", -7, 3), -9);
    assert_eq!(value("INT", "INT", "MIN(IN1 := a, IN2 := b, IN3 := 0)", 4, 3), 0);
    assert_eq!(value("INT", "INT", "LIMIT(MN := 0, IN := a, MX := b)", 7, 5), 5);
    assert_eq!(value("INT", "INT", "LIMIT(MN := 0, IN := a, MX := b)", -7, 5), 0);
    assert_eq!(value("INT", "INT", "LIMIT(MX := b, MN := 0, IN := a)", 3, 5), 3);
    assert_eq!(value("INT", "INT", "LD a\nGT b\nSEL a, b", 9, 4), 4, "TRUE chooses the second");
    assert_eq!(value("INT", "INT", "LD a\nGT b\nSEL a, b", 4, 9), 4, "FALSE chooses the first");
    assert_eq!(value("INT", "INT", "LD a\nMUX 10, 20, b", 1, 30), 20);
    assert_eq!(value("INT", "INT", "MUX(K := a, IN0 := 10, IN1 := 20, IN2 := b)", 2, 30), 30);
    assert_eq!(value("BYTE", "BYTE", "LD a\nSHL 3", 0b1001_0011, 0), 0b1001_1000);
    assert_eq!(value("BYTE", "BYTE", "ROR(IN := a, N := 1)", 0b1001_0011, 0), 0b1100_1001);
    assert_eq!(value("INT", "SINT", "LD a\nINT_TO_SINT", -5, 0), -5);
    assert_eq!(value("INT", "BOOL", "LD a\nINT_TO_BOOL", 256, 0), 1);
    assert_eq!(value("INT", "INT", "LD a\nADD b, 1", 2, 3), 6);
    assert_eq!(value("INT", "BOOL", "LD a\nGT b, 1", 9, 5), 1);
    assert_eq!(value("INT", "BOOL", "LD a\nGT b, 7", 9, 5), 0);
    assert_eq!(value("INT", "INT", "MAX(IN1 := (\nLD a\nADD 1\n), IN2 := (\nLD b\nMUL 2\n))", 5, 4), 8);
    assert_eq!(value("INT", "INT", "MAX(IN1 := (\nLD a\nMUL( b\nADD( 1\nSUB a\n)\n)\n), IN2 := 0)", 2, 5), 8);
    assert_eq!(value("WORD", "WORD", "NOT(IN := a)", 0x00FF, 0), 0xFF00);
    assert_eq!(value("TIME", "TIME", "LD a\nADD T#1s", 500, 0), 1500);
}

#[test]
fn functions_begin_anew_and_return_early() {
    let text = "FUNCTION f : INT\nVAR_INPUT x, y : INT; END_VAR VAR n : INT := 5; END_VAR\n\
                LD n\nADD x\nST n\nST f\nLD y\nEQ 0\nRETC\nLD 0\nSUB f\nST f\nEND_FUNCTION\n\
                PROGRAM p VAR_INPUT a : INT; END_VAR VAR q, r : INT; END_VAR\n\
                LD a\nf 0\nST q\nf(y := 1, x := a)\nST r\nEND_PROGRAM";
    let program = flat(text);
    let mut run = Run::new(&program);
    for _ in 0..2 {
        run.scan(&[("a", 3)]);
        assert_eq!((run.get("q"), run.get("r")), (8, -8));
    }
}

#[test]
fn a_function_called_in_parentheses_has_parentheses_of_its_own() {
    let body = "FUNCTION f : INT VAR_INPUT x : INT; END_VAR\nLD 100\nADD( x\nADD( 1\n)\n)\nST f\nEND_FUNCTION\n\
                PROGRAM p VAR_INPUT a : INT; END_VAR VAR_OUTPUT q, r : INT; END_VAR\n\
                LD 10\nADD(\nf(x := a)\n)\nST q\n\
                LD 10\nADD( 5\nADD(\nf(x := a)\nADD( 1\n)\n)\n)\nST r\nEND_PROGRAM";
    let program = flat(body);
    let mut run = Run::new(&program);
    run.scan(&[("a", 2)]);
    assert_eq!((run.get("q"), run.get("r")), (10 + 103, 10 + (5 + (103 + 1))));
}

#[test]
fn a_call_whose_enable_calls_the_same_function_is_not_made() {
    let body = "FUNCTION f : BOOL VAR_INPUT x : BOOL; END_VAR\nLD x\nST f\nEND_FUNCTION\n\
                PROGRAM p VAR_INPUT a : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR\n\
                f(EN := (\nLD a\nf\nNOT\n), x := TRUE)\nST q\nEND_PROGRAM";
    let program = flat(body);
    let mut run = Run::new(&program);
    run.scan(&[("a", 1)]);
    assert_eq!(run.get("q"), 0, "`EN` is FALSE, and the function has not been called yet");
    run.scan(&[("a", 0)]);
    assert_eq!(run.get("q"), 1);
}

#[test]
fn instances_keep_their_own_values() {
    let text = "FUNCTION_BLOCK inner\nVAR_INPUT d : INT; END_VAR VAR_OUTPUT sum : INT; END_VAR\n\
                LD sum\nADD d\nST sum\nEND_FUNCTION_BLOCK\n\
                FUNCTION_BLOCK outer\nVAR_INPUT d : INT; END_VAR VAR_OUTPUT s : INT; END_VAR VAR x, y : inner; END_VAR\n\
                CAL x(d := d)\nCAL y(d := x.sum, sum => s)\nEND_FUNCTION_BLOCK\n\
                PROGRAM p VAR a, b : outer; END_VAR\nCAL a(1)\nCAL b(d := 10)\nEND_PROGRAM";
    let program = flat(text);
    let mut run = Run::new(&program);
    run.scan(&[]);
    run.scan(&[]);
    assert_eq!((run.get("a.x.sum"), run.get("a.y.sum"), run.get("a.s")), (2, 3, 3));
    assert_eq!((run.get("b.x.sum"), run.get("b.y.sum"), run.get("b.s")), (20, 30, 30));
}

#[test]
fn conditional_calls_hand_nothing_over() {
    let text = "PROGRAM p VAR_INPUT c, s : BOOL; END_VAR VAR f, g : SR; END_VAR\n\
                LD c\nCALC f(S1 := s)\nLD c\nCALCN g(S1 := s)\nEND_PROGRAM";
    let program = flat(text);
    let mut run = Run::new(&program);
    run.scan(&[("c", 0), ("s", 1)]);
    assert_eq!((run.get("f.S1"), run.get("f.Q1"), run.get("g.S1"), run.get("g.Q1")), (0, 0, 1, 1));
}

#[test]
fn enabled_calls_say_whether_they_were_made() {
    let text = "FUNCTION twice : INT\nVAR_INPUT x : INT; END_VAR\nLD x\nADD x\nST twice\nEND_FUNCTION\n\
                PROGRAM p VAR_INPUT e : BOOL; END_VAR VAR q, r : INT; o, n : BOOL; END_VAR\n\
                twice(EN := e, x := 4, ENO => o)\nST q\nADD(EN := e, IN1 := 1, IN2 := 2, NOT ENO => n)\nST r\nEND_PROGRAM";
    let program = flat(text);
    let mut run = Run::new(&program);
    run.scan(&[("e", 1)]);
    assert_eq!((run.get("q"), run.get("o"), run.get("r"), run.get("n")), (8, 1, 3, 0));
    run.scan(&[("e", 0)]);
    assert_eq!((run.get("q"), run.get("o"), run.get("r"), run.get("n")), (0, 0, 0, 1));
}

#[test]
fn arrays_are_indexed_by_variables() {
    let text = "PROGRAM p VAR_INPUT i : SINT; j : UINT; END_VAR\n\
                VAR m : ARRAY [-1..1, 2..4] OF INT := [1, 2, 3, 4, 5, 6, 7, 8, 9]; q, r : INT; END_VAR\n\
                LD m[i, j]\nST q\nLD m[0, j]\nADD m[i, 3]\nST r\nLD 100\nST m[i, j]\nEND_PROGRAM";
    let program = flat(text);
    for i in -1..=1 {
        for j in 2..=4 {
            let mut run = Run::new(&program);
            let element = |i: i128, j: i128| (i + 1) * 3 + (j - 2) + 1;
            assert_eq!(run.scan(&[("i", i), ("j", j)]), []);
            assert_eq!(run.get("q"), element(i, j));
            assert_eq!(run.get("r"), element(0, j) + element(i, 3));
            assert_eq!(run.get(&format!("m[{i},{j}]")), 100);
            assert_eq!(run.get("m[0,3]"), if (i, j) == (0, 3) { 100 } else { 5 });
        }
    }
    let mut run = Run::new(&program);
    assert_eq!(run.scan(&[("i", 2), ("j", 3)])[0], Hazard::Index);
    assert_eq!(run.get("q"), 2, "it goes on with the least index");
}

#[test]
fn structures_in_arrays_are_indexed_too() {
    let text = "TYPE point : STRUCT x : INT; y : INT := 7; END_STRUCT; END_TYPE\n\
                PROGRAM p VAR_INPUT i : INT; END_VAR VAR a : ARRAY [1..3] OF point := [(x := 5), 2((x := 6, y := 8))]; q, r : INT; END_VAR\n\
                LD a[i].x\nST q\nLD a[i].y\nST r\nLD 0\nST a[i].y\nEND_PROGRAM";
    let program = flat(text);
    let mut run = Run::new(&program);
    run.scan(&[("i", 1)]);
    assert_eq!((run.get("q"), run.get("r"), run.get("a[1].y"), run.get("a[2].y")), (5, 7, 0, 8));
    run.scan(&[("i", 3)]);
    assert_eq!((run.get("q"), run.get("r"), run.get("a[3].x"), run.get("a[3].y")), (6, 8, 6, 0));
}

#[test]
fn in_out_variables_are_the_callers() {
    let text = "FUNCTION_BLOCK inc\nVAR_IN_OUT v : INT; END_VAR\nLD v\nADD 1\nST v\nEND_FUNCTION_BLOCK\n\
                FUNCTION_BLOCK twice\nVAR_IN_OUT w : INT; END_VAR VAR f : inc; END_VAR\n\
                CAL f(v := w)\nCAL f(v := w)\nEND_FUNCTION_BLOCK\n\
                PROGRAM p VAR_INPUT i : INT; END_VAR VAR n : INT; a : ARRAY [0..2] OF INT; f : twice; END_VAR\n\
                CAL f(w := n)\nCAL f(w := a[i])\nEND_PROGRAM";
    let program = flat(text);
    let mut run = Run::new(&program);
    run.scan(&[("i", 1)]);
    run.scan(&[("i", 2)]);
    assert_eq!((run.get("n"), run.get("a[0]"), run.get("a[1]"), run.get("a[2]")), (4, 0, 2, 2));
}

#[test]
fn subranges_and_enumerations_have_their_limits() {
    let text = "TYPE phase : (idle, filling, done) := filling; END_TYPE\n\
                PROGRAM p VAR_INPUT a : INT; END_VAR VAR level : INT (2..9); s : phase; t : phase := done; q : BOOL; END_VAR\n\
                LD a\nST level\nLD s\nEQ filling\nST q\nLD phase#idle\nST s\nEND_PROGRAM";
    let program = flat(text);
    let mut run = Run::new(&program);
    assert_eq!((run.get("level"), run.get("s"), run.get("t")), (2, 1, 2));
    assert_eq!(run.scan(&[("a", 9)]), []);
    assert_eq!((run.get("level"), run.get("q"), run.get("s")), (9, 1, 0));
    assert_eq!(run.scan(&[("a", 10)]), [Hazard::Subrange]);
    assert_eq!(run.get("level"), 10, "it is stored all the same");
    let bits = |name: &str| program.variable(program.find(name).unwrap()).bits;
    assert_eq!(
        (bits("s"), bits("t"), bits("level"), bits("a")),
        (1, 2, 16, 16),
        "only idle and filling are stored in s"
    );
}

#[test]
fn enumerations_are_as_wide_as_their_values() {
    let text = "TYPE Colour : (Red, Green, Blue); END_TYPE\n\
                PROGRAM p VAR_INPUT i : Colour; END_VAR VAR copy, own, next : Colour; END_VAR VAR_OUTPUT q : Colour; END_VAR\n\
                LD i\nST copy\nLD Green\nST own\nLD own\nSEL(G := FALSE, IN0 := i, IN1 := own)\nST next\nLD Green\nST q\nEND_PROGRAM";
    let program = flat(text);
    let bits = |name: &str| program.find(name).map(|id| program.variable(id).bits);
    assert_eq!(["i", "copy", "own", "next", "q"].map(bits), [2, 2, 1, 2, 1].map(Some));
}

#[test]
fn globals_and_addresses_are_one_variable_everywhere() {
    let text = "VAR_GLOBAL total : INT := 3; CONSTANTLY AT %MW2 : INT; END_VAR VAR_GLOBAL CONSTANT step : INT := 2; END_VAR\n\
                FUNCTION_BLOCK f\nVAR_EXTERNAL total : INT; END_VAR VAR_EXTERNAL CONSTANT step : INT; END_VAR\n\
                LD total\nADD step\nST total\nEND_FUNCTION_BLOCK\n\
                PROGRAM p VAR x, y : f; lamp AT %QX0.1 : BOOL; END_VAR VAR_EXTERNAL total : INT; END_VAR\n\
                CAL x\nCAL y\nLD %IX0.0\nST lamp\nST %QX0.2\nLD total\nST %MW2\nEND_PROGRAM";
    let program = flat(text);
    let mut run = Run::new(&program);
    run.scan(&[("%I0.0", 1)]);
    assert_eq!((run.get("total"), run.get("lamp"), run.get("%Q0.2"), run.get("CONSTANTLY")), (7, 1, 1, 7));
}

#[test]
fn an_address_may_stand_wherever_a_variable_may() {
    let uses = ["LD FALSE\nSEL 1, %MW4\nST q", "MOVE(IN := %MW4)\nST q", "MOVE(IN := (\nLD %MW4\n))\nST q"];
    for body in uses {
        let program = flat(&format!("PROGRAM p VAR_OUTPUT q : WORD; END_VAR\n{body}\nEND_PROGRAM"));
        assert!(program.find("%MW4").is_some(), "{body}");
    }
}

#[test]
fn timers_count_scans_whether_called_or_not() {
    let text = "PROGRAM p VAR_INPUT i, c : BOOL; END_VAR VAR t : TON; END_VAR\nLD c\nCALC t(IN := i, PT := T#50ms)\nEND_PROGRAM";
    let program = flatten_with(&checked(text), Some(10));
    let mut run = Run::new(&program);
    run.scan(&[("i", 1), ("c", 1)]);
    for _ in 0..4 {
        run.scan(&[("i", 1), ("c", 0)]);
    }
    assert_eq!((run.get("t.Q"), run.get("t.ET")), (0, 0), "it was not called since");
    run.scan(&[("i", 1), ("c", 1)]);
    assert_eq!((run.get("t.Q"), run.get("t.ET")), (1, 50), "50 ms after the edge");
    run.scan(&[("i", 0), ("c", 1)]);
    assert_eq!((run.get("t.Q"), run.get("t.ET")), (0, 0));
    let bits = |name: &str| program.variable(program.find(name).unwrap()).bits;
    assert_eq!((bits("t.PT"), bits("t.ET"), bits("t.CLOCK")), (6, 6, 6), "up to 50, or 50 + 10");
    assert_eq!(program.scan_time, Some(10));
}

#[test]
fn a_timer_may_set_its_own_preset_time() {
    let program =
        flat("PROGRAM p VAR_INPUT a : BOOL; END_VAR VAR t : TON; END_VAR\nCAL t(IN := a, PT := t.ET)\nEND_PROGRAM");
    let bits = |name: &str| program.find(name).map(|id| program.variable(id).bits);
    assert_eq!([bits("t.PT"), bits("t.CLOCK")], [Some(32); 2]);
    let fixed =
        flat("PROGRAM p VAR_INPUT a : BOOL; END_VAR VAR t : TON; END_VAR\nCAL t(IN := a, PT := T#200ms)\nEND_PROGRAM");
    let bits = |name: &str| fixed.find(name).map(|id| fixed.variable(id).bits);
    assert_eq!([bits("t.PT"), bits("t.CLOCK")], [Some(8); 2]);
}

#[test]
fn a_task_says_how_long_a_scan_is() {
    let text = "PROGRAM p VAR_INPUT i : BOOL; END_VAR VAR t : TP; END_VAR\nLD i\nIN t\nEND_PROGRAM\n\
                CONFIGURATION c RESOURCE r ON plc TASK slow (INTERVAL := T#1s, PRIORITY := 1);\nTASK fast (INTERVAL := T#5ms, PRIORITY := 0);\n\
                PROGRAM one WITH fast : p;\nEND_RESOURCE END_CONFIGURATION";
    assert_eq!(flat(text).scan_time, Some(5));
}

#[test]
fn a_function_called_inside_a_parenthesis_leaves_its_callers_value_alone() {
    let text = "FUNCTION twice : INT\nVAR_INPUT a : INT; END_VAR\nLD a\nADD( a\n)\nST twice\nEND_FUNCTION\n\
                PROGRAM p VAR_INPUT x : INT; END_VAR VAR y, z : INT; END_VAR\n\
                LD 100\nADD( x\ntwice\n)\nST y\nLD 7\nADD( 1\nMUL( x\ntwice\n)\n)\nST z\nEND_PROGRAM";
    let program = flat(text);
    let mut run = Run::new(&program);
    run.scan(&[("x", 3)]);
    assert_eq!((run.get("y"), run.get("z")), (106, 13));
}

#[test]
fn a_function_called_only_inside_the_list_of_a_call_is_called() {
    let text = "FUNCTION twice : INT\nVAR_INPUT n : INT; END_VAR\nLD n\nADD n\nST twice\nEND_FUNCTION\n\
                FUNCTION_BLOCK keep\nVAR_INPUT v : INT; END_VAR VAR_OUTPUT w : INT; END_VAR\nLD v\nST w\nEND_FUNCTION_BLOCK\n\
                PROGRAM p VAR_INPUT x, y : INT; END_VAR VAR k : keep; END_VAR\n\
                CAL k(v := (\nLD x\ntwice\nADD( y\nMUL 2\n)\n))\nEND_PROGRAM";
    let program = flat(text);
    let mut run = Run::new(&program);
    run.scan(&[("x", 3), ("y", 1)]);
    assert_eq!(run.get("k.w"), 8);
}

#[test]
fn an_in_out_variable_stands_for_one_element_until_its_call_ends() {
    let text = "FUNCTION_BLOCK f\nVAR_IN_OUT e : INT; END_VAR VAR_INPUT j : INT; END_VAR VAR b : ARRAY [0..3] OF INT; END_VAR\n\
                LD e\nADD 1\nST e\nLD 100\nST b[j]\nLD e\nADD 1\nST e\nEND_FUNCTION_BLOCK\n\
                PROGRAM p VAR_INPUT i, j : INT; g : BOOL; END_VAR\n\
                VAR a : ARRAY [0..3] OF INT := [10, 20, 30, 40]; x : f; y : INT; END_VAR\n\
                CAL x(e := a[i], j := j)\nLD g\nSEL a[i], a[j]\nST y\nEND_PROGRAM";
    let program = flat(text);
    let mut run = Run::new(&program);
    run.scan(&[("i", 1), ("j", 3), ("g", 0)]);
    let a: Vec<i128> = (0..4).map(|i| run.get(&format!("a[{i}]"))).collect();
    assert_eq!(a, [10, 22, 30, 40]);
    assert_eq!((run.get("y"), run.get("x.b[3]")), (22, 100));
}

#[test]
fn a_timer_goes_on_while_its_preset_time_is_lowered() {
    let text = "PROGRAM p VAR_INPUT i : BOOL; END_VAR VAR t : TON; END_VAR\n\
                CAL t(IN := i, PT := T#60ms)\nLD T#0s\nST t.PT\nEND_PROGRAM";
    let program = flatten_with(&checked(text), Some(20));
    let mut run = Run::new(&program);
    let on: Vec<i128> = (0..5)
        .map(|_| {
            run.scan(&[("i", 1)]);
            run.get("t.Q")
        })
        .collect();
    assert_eq!(on, [0, 0, 0, 1, 1], "60 ms after the first scan");
}

//! Accepted and refused programs, each small.

use crate::semantics::testing::findings;
use petril_base::diagnostic::Code::{self, *};

/// Units and variables that the bodies below use.
const AROUND: &str = "\
TYPE Mode : (Off, Manual, Automatic); Colour : (Red, Amber); Level : INT (0..100);
     Point : STRUCT x : INT; y : INT; hot : BOOL; END_STRUCT; END_TYPE
FUNCTION twice : INT VAR_INPUT n : INT; END_VAR LD n\nADD n\nST twice\nEND_FUNCTION
FUNCTION larger : INT VAR_INPUT a, b : INT; END_VAR LD a\nMAX b\nST larger\nEND_FUNCTION
FUNCTION_BLOCK count VAR_INPUT by : INT; END_VAR VAR_IN_OUT sum : INT; END_VAR VAR_OUTPUT high : BOOL; END_VAR
VAR inner : INT; END_VAR LD sum\nADD by\nST sum\nST inner\nGT 100\nST high\nEND_FUNCTION_BLOCK
PROGRAM p
VAR_INPUT i, j : BOOL; END_VAR VAR CONSTANT k : INT := 7; END_VAR
VAR b, c : BOOL; n, m : INT; d : DINT; s : SINT; u : UINT; w, v : WORD; y : BYTE; t : TIME; mode : Mode; level : Level;
    a : ARRAY [1..3] OF INT; g : ARRAY [0..1, 0..2] OF BOOL; pt : Point; pts : ARRAY [1..2] OF Point;
    timer : TON; up : CTU; latch : SR; edge : R_TRIG; tally : count; END_VAR
";

/// Line of a body's first instruction.
fn first_line() -> usize {
    AROUND.lines().count() + 1
}

/// Errors in a body of the program above: codes, and lines counted from 1.
fn errors(body: &str) -> Vec<(Code, usize)> {
    let found = findings(&format!("{AROUND}{}\nEND_PROGRAM", body.replace("; ", "\n")));
    let errors = found.into_iter().filter(|(code, _)| code.id().starts_with('E'));
    errors.map(|(code, line)| (code, (line + 1).saturating_sub(first_line()))).collect()
}

#[test]
fn bodies_that_are_right() {
    let bodies = [
        // Numbers and bits.
        "LD n; ADD 1; ST n",
        "LD 16#FF; AND w; ST w",
        "LD n; GT m; ST b",
        "LD n; ADD( m; MUL 2; ); ST n",
        "LD 5; GT n; ST b",
        "LD DINT#5; ST d",
        "LD n; INT_TO_DINT; ADD d; ST d",
        "LD w; NOT; ST v",
        "LDN y; ST y",
        "LD t; ADD T#5s; GE T#1m; ST b",
        "LD level; ADD 1; ST level",
        "LD n; EQ m; AND( n; EQ k; ); ST b",
        // Calls in lists.
        "CAL tally(by := (; twice(n := n); ADD 1; ), sum := m)",
        "ADD(IN1 := (; twice(n := (; MAX(IN1 := n, IN2 := m); )); ADD( m; larger(a := n, b := m); ); ), IN2 := n); ST n",
        "AND(NOT ENO => c, IN1 := b, IN2 := c); ST b",
        // Enumerations.
        "LD Manual; ST mode",
        "LD mode; EQ Mode#Automatic; ST b",
        // Arrays and structures.
        "LD a[1]; ADD a[n]; ST a[k]",
        "LD g[1, 2]; ST b",
        "LD pts[2].x; ST pt.y",
        "LD pts[n].x; ST pt.y",
        // Standard functions.
        "LD n; MAX m; ST n",
        "LD 0; LIMIT n, 100; ST n",
        "LIMIT(MN := 0, IN := n, MX := 100); ST n",
        "LD b; SEL n, m; ST n",
        "LD n; MUX m, k, 5; ST m",
        "LD w; SHL 2; ST w",
        "LD n; ABS; ST n",
        "LD n; ADD m, 3; ST n",
        "LD n; GT m, 3; ST b",
        "MAX(n, m, 3); ST n",
        "ADD(IN1 := n, IN2 := m, EN := b, ENO => c); ST n",
        "LD b; BOOL_TO_INT; ST n",
        // Functions and function blocks.
        "LD n; twice; ST n",
        "LD n; larger m; ST n",
        "larger(a := n, b := 3); ST n",
        "larger(n, m); ST n",
        "twice(n := m, EN := b, ENO => c); ST n",
        "CAL timer(IN := i, PT := T#5s, Q => b, ET => t)",
        "CAL timer(i, T#5s)",
        "CAL timer(IN := (LD i\nAND j\n), PT := T#5s)",
        "LD i; CALC timer",
        "LD i; ST timer.IN; CAL timer; LD timer.Q; ST b",
        "LD i; CU up; LD 3; PV up; LD j; R up; LD up.CV; ST n",
        "LD i; S1 latch; LD j; R latch; LD latch.Q1; ST b",
        "LD i; CLK edge; LD edge.Q; ST b",
        "CAL tally(by := 1, sum := n, high => b)",
        "CAL tally(1, n)",
        "CAL tally(sum := a[2], by := 1, NOT high => b)",
        // Control.
        "LD b; JMPC on; LD n; ADD 1; ST n; on: LD c; ST b",
        "LD %IX0.0; ST %QX0.1",
        "CAL timer(IN := %IX0.0, PT := T#1s, Q => %QX0.0)",
    ];
    for body in bodies {
        assert_eq!(errors(body), [], "{body}");
    }
}

#[test]
fn bodies_that_are_refused() {
    let bodies: &[(&str, &[(Code, usize)])] = &[
        // Types that differ.
        ("LD n; ADD d; ST n", &[(TypesDiffer, 2)]),
        ("LD n; ST d", &[(TypesDiffer, 2)]),
        ("LD n; ST b", &[(TypesDiffer, 2)]),
        ("LD n; JMPC on; on: LD b; ST c", &[(TypesDiffer, 2)]),
        ("LD n; S b", &[(TypesDiffer, 2)]),
        ("LD b; S n", &[(TypesDiffer, 2)]),
        ("LD u; EQ n; ST b", &[(TypesDiffer, 2)]),
        ("LD b; AND( n; EQ d; ); ST b", &[(TypesDiffer, 3)]),
        ("LD mode; EQ Red; ST b", &[(TypesDiffer, 2)]),
        ("LD mode; ST n", &[(TypesDiffer, 2)]),
        ("LD T#5s; ST n", &[(TypesDiffer, 2)]),
        // Operators without a meaning.
        ("LD n; AND m; ST n", &[(OperatorUnfit, 2)]),
        ("LD w; ADD v; ST w", &[(OperatorUnfit, 2)]),
        ("LD b; ADD c; ST b", &[(OperatorUnfit, 2)]),
        ("LDN n; ST m", &[(OperatorUnfit, 1)]),
        ("LD n; NOT; ST n", &[(OperatorUnfit, 2)]),
        ("LD n; STN m", &[(OperatorUnfit, 2)]),
        ("LD t; MUL t; ST t", &[(OperatorUnfit, 2)]),
        ("LD mode; GT Off; ST b", &[(OperatorUnfit, 2)]),
        ("LD mode; ADD mode; ST mode", &[(OperatorUnfit, 2)]),
        ("LD n; SHL 1; ST n", &[(OperatorUnfit, 2)]),
        ("LD b; ABS; ST b", &[(OperatorUnfit, 2)]),
        // Literals.
        ("LD s; ADD 128; ST s", &[(LiteralUnfit, 2)]),
        ("LD b; AND 2; ST b", &[(LiteralUnfit, 2)]),
        ("LD t; ADD 5; ST t", &[(LiteralUnfit, 2)]),
        ("LD Mode#Amber; ST mode", &[(LiteralUnfit, 1)]),
        ("LD 99999999999999999999; ST b", &[(LiteralUnfit, 1)]),
        ("LD 1.5; ST n", &[(LiteralUnfit, 1)]),
        ("LD SINT#200; ST s", &[(LiteralUnfit, 1)]),
        ("LD Moode#Off; ST mode", &[(TypeNotDeclared, 1)]),
        // Parts.
        ("LD pt; ST n", &[(OperandUnfit, 1)]),
        ("LD a; ST n", &[(OperandUnfit, 1)]),
        ("LD timer; ST b", &[(OperandUnfit, 1)]),
        ("LD 1; ST 2", &[(OperandUnfit, 2)]),
        ("LD pt.z; ST n", &[(MemberUnknown, 1)]),
        ("LD n.x; ST n", &[(MemberUnknown, 1)]),
        ("LD timer.DN; ST b", &[(MemberUnknown, 1)]),
        ("LD a[1, 2]; ST n", &[(IndexCount, 1)]),
        ("LD n[1]; ST n", &[(IndexCount, 1)]),
        ("LD a[4]; ST n", &[(IndexOutside, 1)]),
        ("LD g[0, -1]; ST b", &[(IndexOutside, 1)]),
        ("LD a[b]; ST n", &[(IndexUnfit, 1)]),
        ("LD a[mode]; ST n", &[(IndexUnfit, 1)]),
        ("LD a[T#1s]; ST n", &[(IndexUnfit, 1)]),
        ("LD tally.inner; ST n", &[(MemberHidden, 1)]),
        ("LD b; ST timer.Q", &[(MemberHidden, 2)]),
        // Calls.
        ("CAL n", &[(NotCallable, 1)]),
        ("CAL twice(n := 1)", &[(NotCallable, 1)]),
        ("LD n; count; ST n", &[(NotCallable, 2)]),
        ("LD i; CLK n", &[(NotCallable, 2)]),
        ("LD i; PT latch", &[(ParameterUnknown, 2)]),
        ("CAL timer(IM := i)", &[(ParameterUnknown, 1)]),
        ("CAL timer(IN := i, IN := j)", &[(ParameterTwice, 1)]),
        ("CAL timer(i, T#1s, j)", &[(ParameterCount, 1)]),
        ("CAL timer(IN := n, PT := T#1s)", &[(TypesDiffer, 1)]),
        ("CAL timer(IN := i, PT := 5)", &[(LiteralUnfit, 1)]),
        ("CAL timer(IN := i, Q => n)", &[(TypesDiffer, 1)]),
        ("CAL timer(IN => b)", &[(ParameterUnfit, 1)]),
        ("CAL timer(Q := b)", &[(ParameterUnfit, 1)]),
        ("CAL timer(ENO => n)", &[(TypesDiffer, 1)]),
        ("CAL tally(by := 1)", &[(ParameterCount, 1)]),
        ("CAL tally(by := 1, sum := 5)", &[(ParameterUnfit, 1)]),
        ("CAL tally(by := 1, sum := (LD n\n))", &[(ParameterUnfit, 1)]),
        ("CAL tally(by := 1, sum := d)", &[(TypesDiffer, 1)]),
        ("CAL tally(by := 1, sum := k)", &[(ConstantWritten, 1)]),
        ("CAL timer(IN := b, Q => i)", &[(InputWritten, 1)]),
        ("CAL timer(IN := (AND b\n), PT := T#1s)", &[(ParenthesisWithoutValue, 1)]),
        ("CAL timer(IN := (LD b\nAND(\nOR b\n)\n), PT := T#1s)", &[(ParenthesisWithoutValue, 3)]),
        ("CAL timer(IN := (LD b\nIN timer\nOR b\n), PT := T#1s)", &[(ControlInsideParentheses, 2)]),
        ("LD b\nAND( b\nIN timer\nOR b\n)\nST b", &[(ControlInsideParentheses, 3)]),
        ("LD n; twice m; ST n", &[(ParameterCount, 2)]),
        ("LD b; twice; ST n", &[(TypesDiffer, 2)]),
        ("LD n; twice; ST b", &[(TypesDiffer, 3)]),
        ("LD n; LIMIT 1; ST n", &[(ParameterCount, 2)]),
        ("MAX(IN1 := n, IN1 := m); ST n", &[(ParameterTwice, 1)]),
        ("MAX(IN1 := n, IM2 := m); ST n", &[(ParameterUnknown, 1)]),
        ("LD n; SEL m, 5; ST n", &[(TypesDiffer, 2)]),
        ("LD n; SQRT; ST n", &[(StandardNotSupported, 2)]),
        ("LD d; INT_TO_WORD; ST w", &[(TypesDiffer, 2)]),
        ("LD n; halve; ST n", &[(UnknownOperator, 2)]),
        // One mistake is one error.
        ("LD n; MAX x; ST n", &[(NameNotDeclared, 2)]),
        ("ADD(IN1 := x, IN2 := m); ST n", &[(NameNotDeclared, 1)]),
        ("CAL tally(by := x, sum := y)", &[(NameNotDeclared, 1), (TypesDiffer, 1)]),
        ("LD x.y[z]; ST n", &[(NameNotDeclared, 1)]),
        // The current result.
        ("CAL timer; ST b", &[(ResultUndefined, 2)]),
        ("LD b; JMPC on; LD n; on: ST n", &[(ResultTypesDiffer, 4)]),
    ];
    for (body, expected) in bodies {
        assert_eq!(errors(body), *expected, "{body}");
    }
}

/// Whole files with the errors that are found in them.
#[test]
fn files_that_are_refused() {
    let files: &[(&str, &[(Code, usize)])] = &[
        ("FUNCTION f : INT VAR\nt : TON; END_VAR LD 1\nST f\nEND_FUNCTION", &[(InstanceUnfit, 2)]),
        ("PROGRAM p VAR_TEMP\nt : TON; END_VAR CAL t\nEND_PROGRAM", &[(InstanceUnfit, 2)]),
        ("PROGRAM p VAR_INPUT\nt : ARRAY [1..2] OF TON; END_VAR CAL t[1]\nEND_PROGRAM", &[(InstanceUnfit, 2)]),
        ("PROGRAM p VAR\nt : TON := (PX := T#5s); END_VAR CAL t\nEND_PROGRAM", &[(MemberUnknown, 2)]),
        ("PROGRAM p VAR\nt : TON := (CLOCK := T#5s); END_VAR CAL t\nEND_PROGRAM", &[(MemberUnknown, 2)]),
        ("PROGRAM p VAR\nt : TON := (PT := 5); END_VAR CAL t\nEND_PROGRAM", &[(InitialValueUnfit, 2)]),
        ("TYPE\nINT : (A, B); END_TYPE PROGRAM p\nEND_PROGRAM", &[(PouDeclaredTwice, 2)]),
        ("TYPE\nP : (A, B); END_TYPE PROGRAM p\nEND_PROGRAM", &[(PouDeclaredTwice, 2)]),
        ("TYPE A : B; B : C;\nC : A; END_TYPE PROGRAM p\nEND_PROGRAM", &[(TypeRecursive, 2)]),
        (
            "VAR_GLOBAL CONSTANT g : INT := 1; END_VAR PROGRAM p VAR_EXTERNAL CONSTANT g : INT; END_VAR LD 1\nST g\nEND_PROGRAM",
            &[(ConstantWritten, 2)],
        ),
        ("VAR_GLOBAL CONSTANT g : INT := 1; END_VAR PROGRAM p LD 1\nST g\nEND_PROGRAM", &[(ConstantWritten, 2)]),
        (
            "VAR_GLOBAL g : INT; END_VAR PROGRAM p VAR_EXTERNAL\ng : BOOL; END_VAR LD g\nST g\nEND_PROGRAM",
            &[(TypesDiffer, 2)],
        ),
        (
            "PROGRAM p VAR\na : ARRAY [-9223372036854775808..9223372036854775807] OF INT; END_VAR\nEND_PROGRAM",
            &[(VariableTooLarge, 2)],
        ),
        ("PROGRAM p VAR\na : ARRAY [1..300, 1..300] OF INT; END_VAR\nEND_PROGRAM", &[(VariableTooLarge, 2)]),
        (
            "FUNCTION f : INT VAR_IN_OUT v : INT; END_VAR LD v\nST f\nEND_FUNCTION PROGRAM p VAR n : INT; END_VAR LD n\nf\nST n\nEND_PROGRAM",
            &[(ParameterUnfit, 4)],
        ),
        (
            "FUNCTION_BLOCK f VAR_OUTPUT v : ARRAY [1..2] OF INT; END_VAR END_FUNCTION_BLOCK PROGRAM p VAR n : INT; x : f; END_VAR\nCAL x(v => n)\nEND_PROGRAM",
            &[(ParameterUnfit, 2)],
        ),
        ("FUNCTION_BLOCK f VAR\nx : f; END_VAR CAL x\nEND_FUNCTION_BLOCK", &[(Recursion, 2)]),
        (
            "FUNCTION f : INT VAR_INPUT v : INT; END_VAR\nMAX(IN1 := (\nLD v\nf\n), IN2 := v)\nST f\nEND_FUNCTION",
            &[(Recursion, 4)],
        ),
    ];
    for (file, expected) in files {
        let errors: Vec<_> = findings(file).into_iter().filter(|(code, _)| code.id().starts_with('E')).collect();
        assert_eq!(errors, *expected, "{file}");
    }
}

#[test]
fn types_are_made_of_types_to_a_depth() {
    let chain: String = (0..2000).map(|i| format!("T{i} : T{};\n", i + 1)).collect();
    let errors = findings(&format!("TYPE\n{chain}T2000 : INT; END_TYPE PROGRAM p\nEND_PROGRAM"));
    assert!(errors.iter().all(|(code, _)| *code == VariableTooLarge) && !errors.is_empty(), "{errors:?}");
    let doubled: String = (0..60).map(|i| format!("T{i} : STRUCT a, b : T{}; END_STRUCT;\n", i + 1)).collect();
    let errors = findings(&format!("TYPE\n{doubled}T60 : INT; END_TYPE PROGRAM p\nEND_PROGRAM"));
    assert!(errors.iter().all(|(code, _)| *code == VariableTooLarge) && !errors.is_empty(), "{errors:?}");
}

#[test]
fn calls_are_written_out_to_a_size() {
    let block = |i| {
        let calls = "CAL a\nCAL b\n";
        format!("FUNCTION_BLOCK F{i} VAR a, b : F{}; END_VAR\n{calls}END_FUNCTION_BLOCK\n", i + 1)
    };
    let blocks: String = (0..40).map(block).collect();
    let last = "FUNCTION_BLOCK F40 VAR n : INT; END_VAR\nLD n\nADD 1\nST n\nEND_FUNCTION_BLOCK\n";
    let errors: Vec<Code> = findings(&format!("{blocks}{last}")).into_iter().map(|(code, _)| code).collect();
    assert_eq!(errors.iter().filter(|&&code| code == ProgramTooLarge).count(), 1, "{errors:?}");
}

/// Literals without a type, where operators of other types would give other values.
#[test]
fn literals_whose_type_makes_a_difference() {
    let doubts = |body: &str| {
        let found = findings(&format!("{AROUND}{}\nEND_PROGRAM", body.replace("; ", "\n")));
        found.into_iter().filter(|(code, _)| *code == LiteralWithoutType).count()
    };
    for body in [
        "LD 1; SHL 8; NE 0; ST b",
        "SHL(IN := 1, N := 8); NE 0; ST b",
        "shl(IN := 1, N := 8); NE 0; ST b",
        "LD 100; ADD 100; GT 5; ST b",
        "LD n; GT 0; ST b; LD 1; ROR 1; EQ 1; ST b",
        "LDN 1; EQ 0; ST b",
        "LD 6; XORN 3; EQ 0; ST b",
        "LD 5; EQ( 2; ADD 3; ); ST b",
        "LD 1; NOT; EQ 0; ST b",
    ] {
        assert_eq!(doubts(body), 1, "{body}");
    }
    for body in [
        // Some operand has a type.
        "LD 1; SHL 8; ST w",
        "LD 1; SHL n; AND w; NE 0; ST b",
        "LD 1; ADD n; ST n",
        "LD DINT#1; ADD 2; GT 2; ST b",
        "LD 2; twice; ST n",
        "LD 1; MUX 100, n; ST n",
        // Every type gives the same value.
        "LD 5; GT 3; ST b",
        "LD 7; AND 3; EQ 3; ST b",
        "LD 7; ANDN 3; EQ 4; ST b",
        "LD 8; SHR 2; EQ 2; ST b",
        "LD w; SHL 8; ST w",
        "MAX(IN1 := 3, IN2 := 4); EQ 4; ST b",
    ] {
        assert_eq!(doubts(body), 0, "{body}");
    }
}

/// Correct files without any diagnostic.
#[test]
fn files_without_a_doubt() {
    let files = [
        // Initial values of instances, of a unit that stands further down too.
        "PROGRAM p VAR t : TON := (PT := T#5s); f : late := (by := 3); END_VAR VAR_INPUT i : BOOL; END_VAR\nLD i\nIN t\nCAL f\nEND_PROGRAM
         FUNCTION_BLOCK late VAR_INPUT by : INT; END_VAR VAR sum : INT; END_VAR\nLD sum\nADD by\nST sum\nEND_FUNCTION_BLOCK",
        // A global constant stays known beside constants of the unit.
        "VAR_GLOBAL CONSTANT g : INT := 3; END_VAR\nPROGRAM p VAR CONSTANT k : INT := 1; END_VAR VAR a : ARRAY [k..g] OF INT; END_VAR\nLD 1\nST a[1]\nEND_PROGRAM",
        // A variable passed to an in-out variable is written by the callee.
        "FUNCTION_BLOCK f VAR_IN_OUT v : INT; END_VAR\nLD v\nADD 1\nST v\nEND_FUNCTION_BLOCK
         PROGRAM p VAR x : f; n : INT; m : INT; END_VAR\nCAL x(v := n)\nCAL x(m)\nLD n\nST m\nEND_PROGRAM",
        // A type of the file hides a function block of the library.
        "TYPE TP : (A, B); END_TYPE\nPROGRAM p VAR x : TP; END_VAR\nLD A\nST x\nEND_PROGRAM",
        // Instances in arrays.
        "PROGRAM p VAR t : ARRAY [1..2] OF TON; END_VAR VAR_INPUT i : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR\nCAL t[1](IN := i, PT := T#1s)\nLD t[1].Q\nST q\nEND_PROGRAM",
        // Variables used in a list in a call, in parentheses too, count as used; addresses in it need no declaration.
        "PROGRAM p VAR_INPUT i, j, k : BOOL; END_VAR VAR x : SR; END_VAR VAR_OUTPUT q : BOOL; END_VAR\nCAL x(S1 := (\nLD %IX0.0\nAND( i\nOR( j\nAND %IX0.1\n)\n)\n), R := k)\nLD x.Q1\nST q\nEND_PROGRAM",
        // A label and a variable may share a name.
        "PROGRAM p VAR_INPUT i : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR\nLD i\nJMPC i\nST q\ni:\nEND_PROGRAM",
    ];
    for file in files {
        assert_eq!(findings(file), [], "{file}");
    }
}

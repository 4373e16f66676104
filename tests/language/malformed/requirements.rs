//! Requirements that are none.

use super::{MANY, refused, run};

const PROGRAM: &[u8] =
    b"PROGRAM p\nVAR_INPUT pressed : BOOL; END_VAR\nVAR_OUTPUT motor : BOOL; END_VAR\nLD pressed\nST motor\nEND_PROGRAM\n";

/// The requirement file is refused at this line and column, with these words.
fn is_refused(text: impl AsRef<[u8]>, place: &str, words: &[&str]) {
    let place = if place.is_empty() { String::new() } else { format!("r.req:{place}") };
    refused(
        &run(&[("p.il", PROGRAM), ("r.req", text.as_ref())], &["check", "p.il", "--require", "r.req"]),
        &place,
        words,
    );
}

fn formula_is_refused(formula: &str, place: &str, words: &[&str]) {
    is_refused(format!("requirement r:\n{formula};"), place, words);
    let place = place.replace("2:", "formula r1:1:");
    refused(&run(&[("p.il", PROGRAM)], &["check", "p.il", "-r", formula]), &place, words);
}

#[test]
fn files_that_cannot_be_read_are_refused() {
    is_refused("", "1:1", &["E0501", "no requirement"]);
    is_refused("// nothing\n(* here *)", "1:1", &["E0501", "no requirement"]);
    is_refused("AG motor;", "1:1", &["E0501", "expected `requirement`"]);
    is_refused("requirement r AG motor;", "1:15", &["E0501", "`:`"]);
    is_refused("requirement r: motor", "1:21", &["E0501", "`;`", "found the end"]);
    is_refused("requirement r: motor; (* oh", "1:23", &["E0501", "comment is never closed"]);
    is_refused("requirement r \"oh\n: motor;", "1:15", &["E0501"]);
    is_refused("requirement r: motor;\nrequirement R: motor;", "2:13", &["E0504", "named `R`"]);
    is_refused(b"requirement r: m\0;", "1:17", &["E0101"]);
    is_refused("requirement r: T\u{fc}r;", "1:17", &["E0501", "the letter `\u{fc}`"]);
    is_refused("x".repeat(10_000_000), "1:1", &["E0501", "xxx…"]);
    is_refused("requirement r: ;\n".repeat(MANY), "1:16", &["E0501", "99900 more in r.req"]);
    is_refused("requirement ".repeat(MANY), "1:12", &["E0501"]);
}

#[test]
fn formulas_that_cannot_be_read_are_refused() {
    formula_is_refused("AG (motor -> )", "2:14", &["E0501", "expected a formula"]);
    formula_is_refused("AG (motor", "2:10", &["E0501", "`)`"]);
    formula_is_refused("motor pressed", "2:7", &["E0501", "operator"]);
    formula_is_refused("A [motor pressed]", "2:10", &["E0501", "`U` or `W`"]);
    formula_is_refused("motor = 99999999999999999999", "2:9", &["E0501", "too large"]);
}

#[test]
fn names_that_mean_nothing_are_refused() {
    formula_is_refused("AG (motro -> pressed)", "2:5", &["E0502", "did you mean `motor`?"]);
    formula_is_refused("motor.Q", "2:1", &["E0502"]);
    formula_is_refused("at line 1", "2:1", &["E0505", "--view transition"]);
    let n = MANY / 5;
    let many: String = (0..n).map(|i| format!("requirement r{i}: AG (x{i} -> y{i} & z{i});\n")).collect();
    is_refused(many, "1:21", &["E0502"]);
}

#[test]
fn mixtures_of_types_are_refused() {
    formula_is_refused("motor + pressed", "2:1", &["E0503", "number"]);
    formula_is_refused("AG (motor -> 1)", "2:14", &["E0503", "`TRUE`"]);
    formula_is_refused("AG motor = pressed", "2:1", &["E0503", "parentheses"]);
    formula_is_refused("EF motor + 1 = 2", "2:1", &["E0503"]);
    let large = ["9223372036854775807"; 4].join(" * ");
    formula_is_refused(&format!("{large} = motor"), "2:1", &["E0503", "too large"]);
}

#[test]
fn deep_formulas_are_refused() {
    let nested = |n: usize| format!("{}motor{}", "(".repeat(n), ")".repeat(n));
    is_refused(format!("requirement r: {};", nested(MANY)), "", &["E0501", "too deeply"]);
    is_refused(format!("requirement r: {};", "(".repeat(MANY)), "", &["E0501", "too deeply"]);
    is_refused(format!("requirement r: {};", "A [".repeat(MANY)), "", &["E0501"]);
    for long in ["!".repeat(MANY) + "motor", "motor & ".repeat(MANY) + "motor", "AG ".repeat(MANY) + "motor"] {
        is_refused(format!("requirement r: {long};"), "1:16", &["E0501", "more than 1000 parts"]);
    }
    refused(&run(&[("p.il", PROGRAM)], &["check", "p.il", "-r", &nested(20_000)]), "", &["E0501", "too deeply"]);
    let accepted = run(&[("p.il", PROGRAM)], &["check", "p.il", "-r", &format!("EF {}", nested(200))]);
    assert_eq!(accepted.code, 0, "{}", accepted.stderr);
}

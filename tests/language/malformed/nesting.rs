//! What is nested too deeply, or grows beyond measure when it is written out.

use super::{MANY, refused, run};

/// The program with these declarations in front is refused at this line and column, with these words.
fn is_refused(declarations: &str, place: &str, words: &[&str]) {
    let text = format!("{declarations}\nPROGRAM p\nVAR a : BOOL; END_VAR\nLD a\nST a\nEND_PROGRAM\n");
    let place = if place.is_empty() { String::new() } else { format!("p.il:{place}") };
    refused(&run(&[("p.il", text.as_bytes())], &["flat", "p.il"]), &place, words);
}

fn is_accepted(declarations: &str, body: &str) {
    let text = format!("{declarations}\nPROGRAM p\n{body}\nEND_PROGRAM\n");
    let run = run(&[("p.il", text.as_bytes())], &["flat", "p.il"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
}

#[test]
fn deep_declarations_are_refused_before_anything_follows_them() {
    let deep = &["E0113", "more than 100 deep"];
    let array = "ARRAY [0..0] OF ";
    is_refused(&format!("VAR_GLOBAL\ng : {}INT;\nEND_VAR", array.repeat(MANY)), "2:1595", deep);
    is_refused(&format!("VAR_GLOBAL\ng : {}", "ARRAY ".repeat(MANY)), "2:605", deep);
    is_refused(&format!("TYPE\nt : {}", "STRUCT\na : ".repeat(MANY)), "102:5", deep);
    for (open, close) in [("[", "]"), ("(a := ", ")"), ("2(", ")"), ("(", "")] {
        let value = format!("{}1{}", open.repeat(MANY), close.repeat(MANY));
        is_refused(&format!("VAR_GLOBAL\ng : INT := {value};\nEND_VAR"), "", deep);
    }
    // What is not too deep is read.
    is_accepted(&format!("TYPE t : {}INT; END_TYPE", array.repeat(99)), "");
}

#[test]
fn types_may_not_be_nested_deeply_through_their_names() {
    let n = 20_000;
    let chain = |of: &dyn Fn(usize) -> String, order: &mut dyn Iterator<Item = usize>| {
        let types: String = order.map(|i| format!("t{i} : {};\n", of(i))).collect();
        format!("TYPE\n{types}t0 : INT;\nEND_TYPE")
    };
    let deep = &["E0211", "more than 100 deep"];
    let structure = |i: usize| format!("STRUCT m : t{}; END_STRUCT", i - 1);
    let array = |i: usize| format!("ARRAY [0..0] OF t{}", i - 1);
    let name = |i: usize| format!("t{}", i - 1);
    for of in [&structure as &dyn Fn(usize) -> String, &array] {
        is_refused(&chain(of, &mut (1..n)), "", deep);
        is_refused(&chain(of, &mut (1..n).rev()), "", deep);
    }
    is_refused(&chain(&name, &mut (1..n).rev()), "", deep);
}

#[test]
fn types_that_double_with_every_name_are_refused() {
    let doubled = |least: &str| {
        let types: String = (1..90).map(|i| format!("t{i} : STRUCT a, b : t{}; END_STRUCT;\n", i - 1)).collect();
        format!("TYPE\nt0 : {least};\n{types}END_TYPE")
    };
    is_refused(&doubled("INT"), "18:7", &["E0211", "more than 65536 values"]);
    is_refused(&doubled("STRUCT END_STRUCT"), "18:7", &["E0211", "more than 65536 values"]);
    let squared = "TYPE\nrow : ARRAY [0..65535] OF INT;\ntwice : STRUCT a, b : row; END_STRUCT;\nEND_TYPE";
    is_refused(squared, "3:9", &["E0211"]);
}

#[test]
fn ranges_and_enumerations_may_be_of_any_size_but_are_refused() {
    let array = |range: &str| format!("VAR_GLOBAL\ng : ARRAY [{range}] OF INT;\nEND_VAR");
    let large = &["E0211", "more than 65536 values"];
    is_refused(&array("-9223372036854775808..9223372036854775807"), "2:5", large);
    is_refused(&array("-9223372036854775808..-9223372036854775807"), "2:5", large);
    is_refused(&array("0..9223372036854775807"), "2:5", large);
    is_refused(&array("0..65535, 0..65535, 0..65535, 0..65535"), "2:5", large);
    is_accepted(&array("1000000000000..1000000000001"), "LD g[1000000000001]\nST g[1000000000000]");
    let values: Vec<String> = (0..MANY).map(|i| format!("v{i}")).collect();
    let enumeration = format!("TYPE\ne : ({});\nEND_TYPE", values.join(",\n"));
    is_refused(&enumeration, "65538:1", &["E0211", "this enumeration has more than 65536 values"]);
}

/// Thousands of large initial values, each a few letters.
#[test]
fn initial_values_take_no_more_memory_than_their_text() {
    let one = |i: usize| format!("g{i} : ARRAY [0..65535] OF ARRAY [0..0] OF INT := [65536([1])];\n");
    let many: String = (0..5000).map(one).collect();
    let declarations = format!("VAR_GLOBAL\n{many}END_VAR");
    is_refused(&declarations, "5003:9", &["E0330", "values with its functions and global variables"]);
}

/// Every element of an enumeration is one of the names, which are kept once.
#[test]
fn large_arrays_of_large_enumerations_are_read() {
    let values: Vec<String> = (0..20_000).map(|i| format!("value_{i}")).collect();
    let declarations =
        format!("TYPE e : ({}); END_TYPE\nVAR_GLOBAL g : ARRAY [1..60000] OF e; END_VAR", values.join(", "));
    is_accepted(&declarations, "LD g[1]\nST g[2]");
}

/// Every declaration may name the constants before it.
#[test]
fn thousands_of_declarations_behind_a_constant_are_read() {
    let many: String = (0..20_000).map(|i| format!("v{i} : INT := n;\n")).collect();
    let constant = "VAR_GLOBAL CONSTANT n : INT := 3; END_VAR\nVAR_GLOBAL m : INT; END_VAR";
    is_accepted(constant, &format!("VAR CONSTANT k : INT := 2; END_VAR\nVAR\n{many}END_VAR\nLD v0\nST v1"));
}

#[test]
fn thousands_of_unfinished_pieces_are_read_once() {
    let head = "CONFIGURATION c\n";
    is_refused(&format!("{head}{}", "PROGRAM a : b (x := y,\n".repeat(MANY / 5)), "", &["E0102"]);
    is_refused(&format!("{head}{}", "TASK t (INTERVAL := T#1ms,\n".repeat(MANY / 5)), "", &["E0102"]);
    is_refused(&format!("VAR_GLOBAL\n{}", "a : (b,\n".repeat(MANY)), "", &["E0113"]);
    is_refused(&format!("VAR_GLOBAL\n{}", "a : INT := \n".repeat(MANY / 5)), "", &["E0102"]);
}

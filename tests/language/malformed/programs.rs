//! Programs that are none.

use super::{MANY, refused, run};

/// Four lines, the body begins in the fifth.
const HEAD: &str = "PROGRAM p\nVAR_INPUT a, b : BOOL; END_VAR\nVAR m : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\n";

fn program(body: &str) -> String {
    format!("{HEAD}{body}\nEND_PROGRAM\n")
}

/// The program with this text is refused at this line and column, with these words.
fn is_refused(text: impl AsRef<[u8]>, place: &str, words: &[&str]) {
    let place = if place.is_empty() { String::new() } else { format!("p.il:{place}") };
    refused(&run(&[("p.il", text.as_ref())], &["flat", "p.il"]), &place, words);
}

fn body_is_refused(body: &str, place: &str, words: &[&str]) {
    is_refused(program(body), place, words);
}

fn is_accepted(text: impl AsRef<[u8]>) -> String {
    let run = run(&[("p.il", text.as_ref())], &["flat", "p.il"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    run.stdout
}

#[test]
fn nothing_is_no_program() {
    is_refused("", "1:1", &["E0108", "holds no program"]);
    is_refused("\n\n  \n", "1:1", &["E0108"]);
    is_refused("(* PROGRAM p END_PROGRAM *)\n// LD a\n", "2:8", &["E0108"]);
}

#[test]
fn bytes_that_are_no_text_are_refused() {
    is_refused(b"PROGRAM p\n\0\0\0", "2:1", &["E0101", "NUL"]);
    is_refused([0; 4096], "1:1", &["E0101", "NUL"]);
    is_refused(b"\xFF\xFEP\0R\0", "", &["E0101", "UTF-16", "UTF-8"]);
    // Any other bytes can be ISO 8859-1.
    let bytes: Vec<u8> = (1..=255).cycle().take(MANY).collect();
    is_refused(bytes, "", &["E0102"]);
}

#[test]
fn every_encoding_and_line_end_means_the_same() {
    let text = program("LD a // ä\nAND b\nST q");
    let plain = is_accepted(text.replace('ä', "a"));
    let latin_1: Vec<u8> = text.chars().map(|c| c as u8).collect();
    assert!(std::str::from_utf8(&latin_1).is_err());
    let bom = [b"\xEF\xBB\xBF", text.as_bytes()].concat();
    let variants =
        [text.clone().into_bytes(), latin_1, bom, text.replace('\n', "\r\n").into(), text.replace('\n', "\r").into()];
    for variant in variants {
        assert_eq!(is_accepted(&variant).replace('ä', "a"), plain);
        let wrong = String::from_utf8_lossy(&variant).replace("ST q", "ST r");
        is_refused(wrong, "7:4", &["E0202", "`r` is not declared"]);
    }
}

#[test]
fn deep_parentheses_are_refused() {
    let (open, close) = ("AND( b\n".repeat(MANY), ")\n".repeat(MANY));
    let deep = &["E0106", "more than 200 deep"];
    body_is_refused(&format!("LD a\n{open}{close}ST q"), "206:1", deep);
    body_is_refused(&format!("LD a\n{open}ST q"), "205:1", &["E0104", "99999 around it are never closed", "E0106"]);
    body_is_refused(&format!("LD a\n{}b{}\nST q", "AND(".repeat(MANY), ")".repeat(MANY)), "6:801", deep);
    body_is_refused(&format!("LD a\n{}\nST q", "AND(".repeat(MANY)), "6:797", &["E0104", "E0106"]);
    body_is_refused(&format!("LD a\n{close}ST q"), "6:1", &["E0105", "closes nothing", "99900 more"]);
    body_is_refused(&format!("LD {}", "(".repeat(MANY)), "5:5", &["E0102"]);
    body_is_refused(&format!("LD a[{}", "[".repeat(MANY)), "5:6", &["E0102"]);
    // What is not too deep is accepted.
    is_accepted(program(&format!("LD a\n{}{}ST q", "AND( b\n".repeat(200), ")\n".repeat(200))));
}

#[test]
fn deep_comments_are_read() {
    let comment = format!("{}{}", "(*".repeat(MANY), "*)".repeat(MANY));
    is_accepted(program(&format!("LD a {comment}\nST q")));
    is_refused("(*".repeat(MANY), "1:1", &["E0103", "comments nest"]);
    body_is_refused(&format!("LD a\nST q (*{comment}"), "6:6", &["E0103", "never closed"]);
    is_refused("(*)".repeat(MANY), "1:1", &["E0103"]);
}

#[test]
fn long_files_of_mistakes_are_refused_with_the_first_hundred() {
    let more = format!("… and {} more in p.il", MANY - 100);
    body_is_refused(&"LD = 3\n".repeat(MANY), "5:4", &["E0102", &more]);
    body_is_refused(&"FOO a\n".repeat(MANY), "5:1", &["E0109", &more]);
    body_is_refused(&"AND\n".repeat(MANY), "5:1", &["E0302"]);
    body_is_refused(&"x: LD a\n".repeat(MANY), "6:1", &["E0307"]);
    is_refused(format!("PROGRAM p\nVAR\n{}END_VAR\nEND_PROGRAM", "x y;\n".repeat(MANY)), "3:3", &["E0102", &more]);
    is_refused(format!("PROGRAM p\nVAR\n{}END_VAR\nEND_PROGRAM", "x : BOOL;\n".repeat(MANY)), "4:1", &["E0201"]);
    is_refused("PROGRAM p END_PROGRAM\n".repeat(MANY), "2:9", &["E0111"]);
    is_refused("FUNCTION f : BOOL END_FUNCTION\n".repeat(MANY), "2:10", &["E0215"]);
    is_refused("VAR\n".repeat(MANY), "1:1", &["E0102"]);
    is_refused(format!("PROGRAM p\n{}", "VAR\n".repeat(MANY)), "2:1", &["E0107"]);
}

/// To suggest a name for each unknown one would take minutes.
#[test]
fn thousands_of_unknown_names_among_thousands_of_known_ones_are_refused() {
    let n = MANY / 5;
    let declared: String = (0..n).map(|i| format!("v{i} : BOOL;\n")).collect();
    let uses: String = (0..n).map(|i| format!("LD w{i}\n")).collect();
    let labels: String = (0..n).map(|i| format!("a{i}: JMP b{i}\n")).collect();
    let words = ["E0202", "did you mean `v0`?", "more in p.il"];
    is_refused(format!("PROGRAM p\nVAR\n{declared}END_VAR\n{uses}END_PROGRAM"), "20004:4", &words);
    is_refused(format!("PROGRAM p\n{labels}END_PROGRAM"), "2:9", &["E0306", "did you mean `a0`?", "more in p.il"]);
}

#[test]
fn long_lines_and_names_are_refused_in_few_words() {
    is_refused("x".repeat(10_000_000), "1:1", &["E0102", "xxx…"]);
    body_is_refused(&"LD a ".repeat(2_000_000), "5:6", &["E0102"]);
    let long = "x".repeat(1_000_000);
    body_is_refused(&format!("LD {long}\nST q"), "5:4", &["E0202", "xxx…"]);
    body_is_refused(&format!("JMP {long}"), "5:5", &["E0306"]);
    body_is_refused(&format!("LD a\n{long}: LD {long}"), "6:1000006", &["E0202"]);
    is_refused(format!("PROGRAM {long}\nLD a\nEND_PROGRAM"), "2:4", &["E0202"]);
    is_refused(format!("PROGRAM p\nVAR {long}, {long} : BOOL; END_VAR\nEND_PROGRAM"), "2:1000007", &["E0201"]);
    body_is_refused(&format!("{}LD x", "LD a;".repeat(MANY)), "5:500004", &["E0202"]);
    body_is_refused(&format!("LD a{} q", "\u{a0}".repeat(MANY)), "5:100006", &["E0102"]);
}

#[test]
fn ends_that_are_missing_are_missed_once() {
    is_refused("PROGRAM", "1:8", &["E0102", "expected a name"]);
    is_refused("PROGRAM p", "1:1", &["E0107", "`PROGRAM` has no end"]);
    is_refused(format!("{HEAD}LD a\nST q\n"), "1:1", &["E0107", "END_PROGRAM"]);
    is_refused("PROGRAM p\nVAR_INPUT a : BOOL;\nLD a\nEND_PROGRAM", "2:1", &["E0107", "END_VAR"]);
    is_refused("PROGRAM p\nVAR\nEND_PROGRAM", "2:1", &["E0107"]);
    body_is_refused("LD a (* oh\nST q", "5:6", &["E0103"]);
    body_is_refused("LD a\nAND( b\nST q", "6:1", &["E0104"]);
    body_is_refused("LD a\nAND( b\nST q ))", "7:7", &["E0105"]);
    is_refused("CONFIGURATION c\nPROGRAM p END_PROGRAM", "1:1", &["E0102"]);
}

#[test]
fn other_languages_are_refused_by_name() {
    body_is_refused("q := a AND b;", "5:1", &["Structured Text"]);
    body_is_refused("  IF a THEN\n    q := TRUE;\n  END_IF;", "5:3", &["Structured Text"]);
    body_is_refused("CASE a OF\n1: q := TRUE;\nEND_CASE;", "5:1", &["Structured Text"]);
    body_is_refused("LD a\nq := b;\nST q", "6:1", &["Structured Text"]);
    body_is_refused("INITIAL_STEP s:\nEND_STEP", "5:1", &["Sequential Function Chart"]);
    is_refused("#include <stdio.h>\nint main(void) { return 0; }\n", "1:1", &["expected `PROGRAM`"]);
    is_refused("      U     E 1.0\n      =     A 4.0\n", "1:7", &["E0114", "Siemens Statement List"]);
    is_refused("<?xml version=\"1.0\"?>\n<project/>\n", "2:1", &["E0108", "holds no program"]);
    is_refused("<html><body>LD a</body></html>", "1:1", &["E0112", "no PLCopen project"]);
    is_refused("{\\rtf1 PROGRAM p}", "", &["E0102"]);
    is_refused("%PDF-1.7\n%\u{e2}\u{e3}\n", "1:1", &["E0102"]);
}

#[test]
fn duplicates_are_refused() {
    is_refused("PROGRAM p VAR a, A : BOOL; END_VAR END_PROGRAM", "1:18", &["E0201"]);
    body_is_refused("x: LD a\nX: ST q\nJMP x", "6:1", &["E0307"]);
    is_refused("PROGRAM p\nEND_PROGRAM\nPROGRAM p\nEND_PROGRAM", "3:9", &["E0111"]);
}

#[test]
fn what_is_not_there_is_refused() {
    body_is_refused("LD c\nST q", "5:4", &["E0202"]);
    body_is_refused("LD a\nJMPC nowhere\nST q", "6:6", &["E0306", "nowhere"]);
    body_is_refused("LD a\nCAL timer", "6:5", &["E0202", "timer"]);
}

//! What a part of the scans shows, and what it does not: proofs under limits, by hand.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::flat::{FlatProgram, Hazard, Tolerated};
use petril::sif::Specification;
use petril::sif::proof::{By, Confirmed, Failure, Options, Outcome, Proof, Subject, prove};
use petril::source::Source;
use support::proofs::{function, program, proved, refuted};

fn proof_with(text: &str, program: &FlatProgram, tolerated: Tolerated, options: &Options) -> Proof {
    let (specification, diagnostics) = Specification::read(&[Source::new("test.sif", text)]);
    let specification = specification.unwrap_or_else(|| panic!("{diagnostics:#?}"));
    let subject = Subject::new(&specification, program, tolerated, &[]).unwrap_or_else(|e| panic!("{e:#?}"));
    prove(&subject, options)
}

/// With this many scans for the interpreter.
fn tried(text: &str, program: &FlatProgram, tries: u64) -> Proof {
    proof_with(text, program, Tolerated::default(), &Options { tries, ..Options::default() })
}

/// The only outcome is unknown, for a reason that says this.
fn unknown(proof: &Proof, reason: &str) {
    let [answer] = proof.answers.as_slice() else { panic!("{proof:#?}") };
    assert!(matches!(&answer.outcome, Outcome::Unknown(why) if why.contains(reason)), "{proof:#?}");
}

/// `n` counts scans up to a hundred, where it stays. What is so at 300 is never so, which induction over a few scans does not see.
const COUNTING: &str = "LD n\nEQ 100\nJMPC there\nLD n\nADD 1\nST n\nthere: ";

/// Of 101 values of `n`, a limit of 100 scans of 8 readings each sees 13: nothing is proved of the others, and nothing wrong.
#[test]
fn a_part_of_the_states_proves_nothing() {
    let text = function("", "y = a & b;");
    let with = |body: &str| program("a, b, c", "y", "VAR n : INT; END_VAR", &format!("{COUNTING}{body}"));
    let told = |program: &FlatProgram, tries: u64| {
        proof_with(&text, program, Tolerated::default(), &Options { scans: 2, tries, ..Options::default() })
    };
    let right = with("LD n\nEQ 300\nOR(\nLD a\nAND b\n)\nST y");
    unknown(&told(&right, 100), "induction over 2 scans does not exclude longer ones");
    unknown(&told(&right, 101 * 8 - 1), "induction over 2 scans does not exclude longer ones");
    assert_eq!(proved(&told(&right, 101 * 8)), (By::EveryScan, None));
    // Wrong as soon as `n` is 100, in the 100th scan.
    let wrong = with("LD n\nEQ 100\nOR(\nLD a\nAND b\n)\nST y");
    unknown(&told(&wrong, 100), "induction over 2 scans does not exclude longer ones");
    assert_eq!(refuted(&told(&wrong, 101 * 8)).len(), 100);
}

/// An error that comes in the 100th scan is neither met nor excluded by what a part of the states shows.
#[test]
fn a_part_of_the_states_excludes_no_error() {
    let text = function("", "y = a & b;");
    let more = "VAR n, k : INT; END_VAR";
    let with = |bad: &str| {
        let body = format!("{COUNTING}LD 100\nDIV(\nLD n\nSUB {bad}\n)\nST k\nLD a\nAND b\nST y");
        program("a, b, c", "y", more, &body)
    };
    let told = |program: &FlatProgram, tries: u64| {
        let tolerated = Tolerated { overflow: true, division_by_zero: false };
        proof_with(&text, program, tolerated, &Options { scans: 2, tries, ..Options::default() })
    };
    for (bad, tries) in [("300", 100), ("300", 101 * 8 - 1), ("100", 100)] {
        let told = told(&with(bad), tries);
        let [(Some(Failure::Hazard(_, Hazard::DivisionByZero)), _)] = told.unknown_failures.as_slice() else {
            panic!("{bad}, {tries}: {told:#?}")
        };
        assert!(told.failures.is_empty(), "{told:#?}");
    }
    let never = told(&with("300"), 101 * 8);
    assert!(never.failures.is_empty() && never.unknown_failures.is_empty(), "{never:#?}");
    let sometimes = told(&with("100"), 101 * 8);
    assert!(matches!(sometimes.failures.as_slice(), [(_, scans)] if scans.len() == 100), "{sometimes:#?}");
    assert!(sometimes.unknown_failures.is_empty(), "{sometimes:#?}");
}

/// The interpreter confirms a proof only if it came to the end of the scans: 2 states with 8 readings each, 16 scans. It has a
/// sixteenth of the tries for this.
#[test]
fn a_part_of_the_states_confirms_nothing() {
    let confirmed = |text: &str, program: &FlatProgram, tries: u64| {
        proved(&proof_with(text, program, Tolerated::default(), &Options { tries, ..Options::default() }))
    };
    let latched = function(" latched until c", "y = a & b;");
    let latch = program("a, b, c", "y", "", "LD c\nR y\nLD a\nAND b\nS y");
    let every = Some(Confirmed::EveryScan { states: 2, scans: 16 });
    assert_eq!(confirmed(&latched, &latch, 16 * 16), (By::Induction(1), every));
    assert_eq!(confirmed(&latched, &latch, 16 * 15), (By::Induction(1), None));
    let plain = program("a, b, c", "y", "", "LD a\nAND b\nST y");
    let text = function("", "y = a & b;");
    let every = Some(Confirmed::EveryScan { states: 1, scans: 8 });
    assert_eq!(confirmed(&text, &plain, 16 * 8), (By::AnyState, every));
    assert_eq!(confirmed(&text, &plain, 16 * 7), (By::AnyState, Some(Confirmed::Diagrams)));
}

/// A search that is stopped at once tells nothing, with gates and without.
#[test]
fn a_stopped_search_proves_nothing() {
    let stopped = Options { stop: std::sync::Arc::new(|| true), ..Options::default() };
    let text = function(" latched until c", "y = a & b;");
    let latch = program("a, b, c", "y", "", "LD c\nR y\nLD a\nAND b\nS y");
    let told = proof_with(&text, &latch, Tolerated::default(), &stopped);
    unknown(&told, "gave up on runs of 1 scans");
    let looping = program("a, b, c", "y", "", &format!("LD FALSE\nback: JMPC back\n{}", "LD c\nR y\nLD a\nAND b\nS y"));
    let told = proof_with(&text, &looping, Tolerated::default(), &stopped);
    unknown(&told, "not all scans were tried: the search was stopped");
    assert!(matches!(told.unknown_failures.as_slice(), [(None, why)] if why.contains("stopped")), "{told:#?}");
}

/// Eight scans are all there are from the one state that is carried; seven of them show nothing of the last.
#[test]
fn seven_scans_do_not_show_the_eighth() {
    let text = function("", "y = a & b & c;");
    let right = program("a, b, c", "y", "", "LD FALSE\nback: JMPC back\nLD a\nAND b\nAND c\nST y");
    assert_eq!(proved(&tried(&text, &right, 8)), (By::EveryScan, None));
    let seven = tried(&text, &right, 7);
    unknown(&seven, "not all scans were tried: the limit of 7 scans was reached");
    assert!(matches!(seven.unknown_failures.as_slice(), [(None, _)]), "{seven:#?}");
}

/// A scan that breaks a restriction of another function is tried all the same.
#[test]
fn only_own_restrictions_leave_scans_out() {
    let text = "function F { interface { input a; input b; output y; } formal { y = a; restriction S: never b; } }
                function G { interface { input c; output z; } formal { z = c; } }";
    // `z` is wrong in scans with b alone. A loop that is never gone round leaves it to the interpreter.
    let body = "LD FALSE\nback: JMPC back\nLD a\nOR b\nST y\nLD c\nXOR b\nST z";
    let told = tried(text, &program("a, b, c", "y, z", "", body), 8);
    assert_eq!(told.answers[0].outcome, Outcome::Proved { by: By::EveryScan, confirmed: None }, "{told:#?}");
    assert!(matches!(&told.answers[1].outcome, Outcome::Refuted(scans) if scans.len() == 1), "{told:#?}");
    // Where the restrictions leave nothing, nothing is proved.
    let nothing = function("", "y = a; restriction R: never a; restriction S: always a;");
    unknown(
        &tried(&nothing, &program("a, b, c", "y", "", "LD FALSE\nback: JMPC back\nLD a\nST y"), 8),
        "no scan that its restrictions allow",
    );
}

/// A delayed output is for others what the program makes of it, for the interpreter, too.
#[test]
fn delayed_outputs_are_used_as_they_are() {
    let text = "function F { interface { input a; output y delayed T#1s; } formal { y = a; } }
                function G { interface { input b; input y; output z; } formal { z = y & b; } }";
    let head = "LD FALSE\nback: JMPC back\nLD a\nAND c\nST y\n";
    let proved = Outcome::Proved { by: By::EveryScan, confirmed: None };
    let right = tried(text, &program("a, b, c", "y, z", "", &format!("{head}AND b\nST z")), 8);
    assert!(right.answers.iter().all(|answer| answer.outcome == proved), "{right:#?}");
    let wrong = tried(text, &program("a, b, c", "y, z", "", &format!("{head}LD a\nAND b\nST z")), 8);
    assert_eq!(wrong.answers[0].outcome, proved);
    assert!(matches!(&wrong.answers[1].outcome, Outcome::Refuted(scans) if scans.len() == 1), "{wrong:#?}");
}

/// 16 bits of inputs are tried, 17 are not, however they are spread.
#[test]
fn too_many_inputs_are_not_tried() {
    let text = function("", "y = a & b;");
    let with = |more: &str| {
        program("a, b, c", "y", &format!("VAR_INPUT {more} END_VAR"), "LD FALSE\nback: JMPC back\nLD a\nAND b\nST y")
    };
    let scans = 1 << 16;
    assert_eq!(proved(&tried(&text, &with("d : SINT; e, f, g, h, i : BOOL;"), scans)), (By::EveryScan, None));
    for more in ["d : SINT; e, f, g, h, i, j : BOOL;", "d : DINT;"] {
        unknown(&tried(&text, &with(more), scans), "its inputs are too many to try all");
    }
}

/// From a state that is never reached, `m` can stay as long as it likes before it makes `y` wrong; but each scan then begins
/// where the one before did.
#[test]
fn induction_looks_at_states_that_differ() {
    let text = function("", "y = a & b;");
    let body = "LD a\nAND b\nXOR k\nST y\nLD m\nAND c\nST k\nLD m\nAND a\nS m";
    let told = tried(&text, &program("a, b, c", "y", "VAR k, m : BOOL; END_VAR", body), 0);
    assert_eq!(proved(&told), (By::Induction(2), None));
}

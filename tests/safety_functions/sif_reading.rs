//! Specifications are read as they are written, and whatever a file holds, the reader comes to an end.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::fmt::Write as _;

use petril::diagnostic::{Diagnostic, Style, any_error, render};
use petril::sif::{Formula, Kind, Operator, SignalId, Specification};
use petril::source::Source;
use proptest::prelude::*;

const F1: &str = include_str!("../../examples/beam-interlock.sif");

fn read(text: &str) -> (Option<Specification>, Vec<Diagnostic>) {
    let source = Source::new("test.sif", text);
    let (specification, mut diagnostics) = Specification::read(std::slice::from_ref(&source));
    let diagnostics = diagnostics.remove(0);
    assert_eq!(specification.is_none(), any_error(&diagnostics), "{text}");
    for diagnostic in diagnostics.iter().take(20) {
        assert!(diagnostic.labels.iter().all(|label| label.span.end <= text.len()), "{diagnostic:?}");
        assert!(!render(diagnostic, &source, Style::default()).is_empty());
    }
    (specification, diagnostics)
}

fn good(text: &str) -> Specification {
    let (specification, diagnostics) = read(text);
    specification.unwrap_or_else(|| panic!("{diagnostics:?}\n{text}"))
}

/// The formula of the only equation of a function with the inputs `s0` to `s9`.
fn formula(text: &str) -> Formula {
    let inputs: String = (0..10).map(|at| format!("input s{at}; ")).collect();
    let text = format!("function F {{ interface {{ {inputs} output F; }} formal {{ F = {text}; }} }}");
    let specification = good(&text);
    let output = specification.functions[0].outputs[0];
    // Outputs come first among the signals.
    specification.definition(output).unwrap().map(&mut |signal: &SignalId| SignalId(signal.0 - 1))
}

fn signal(at: usize) -> Formula {
    Formula::Signal(SignalId(at))
}

#[test]
fn operators_in_every_spelling() {
    let not = |inner: Formula| Formula::Not(Box::new(inner));
    let gate = |operator, of: &[Formula]| Formula::Gate(operator, of.to_vec());
    let or = gate(Operator::Or, &[signal(0), signal(1)]);
    for text in ["s0 | s1", "s0 || s1", "s0 ∨ s1", "s0│s1", "S0 OR s1", "(s0)or(s1)", "at least one of (s0, s1)"] {
        assert_eq!(formula(text), or, "{text}");
    }
    let and = gate(Operator::And, &[not(signal(0)), signal(1)]);
    for text in ["!s0 & s1", "¬s0 && s1", "┐s0 ∧ s1", "~s0 and s1", "NOT s0 AND s1", "!!!s0 &\r\n\ts1", "not(s0)and s1"]
    {
        assert_eq!(formula(text), and, "{text}");
    }
    for text in ["s0 -> s1", "s0 → s1", "s0 ⇒ s1", "s0 implies s1"] {
        assert_eq!(formula(text), gate(Operator::Implies, &[signal(0), signal(1)]), "{text}");
    }
    for text in ["s0 <-> s1", "s0 ↔ s1", "s0 ⇔ s1", "s0 iff s1"] {
        assert_eq!(formula(text), gate(Operator::Iff, &[signal(0), signal(1)]), "{text}");
    }
    for text in ["s0 xor s1", "s0 ⊕ s1"] {
        assert_eq!(formula(text), gate(Operator::Xor, &[signal(0), signal(1)]), "{text}");
    }
    // Strongest first: not, and, xor, or, ->, <->; an implication binds to the right.
    let text = "!s0 & s1 xor s2 | s3 -> s4 -> s5 <-> s6";
    assert_eq!(formula(text), formula("(((((!s0) & s1) xor s2) | s3) -> (s4 -> s5)) <-> s6"));
    assert_eq!(formula("s0 & s1 & s2"), gate(Operator::And, &[signal(0), signal(1), signal(2)]));
    assert_eq!(
        formula("s0 & (s1 & s2)"),
        gate(Operator::And, &[signal(0), gate(Operator::And, &[signal(1), signal(2)])])
    );
}

/// The seed paper's formula, letter by letter, in a file with line ends of another system, and names with other letters.
#[test]
fn other_letters() {
    let text = F1.replace(
        "((MODE_Acc | MODE_TFA | MODE_Tra) & !ACC_Tst & !ACC_TfT & !EISb_Pos) | (!MODE_Acc & !EISa_Safe)",
        "((MODE_Acc│MODE_TFA│MODE_Tra) & ┐ACC_Tst & \n ┐ACC_TfT & ┐EISb_Pos) │ (┐MODE_Acc & ┐EISa_Safe)",
    );
    assert_ne!(text, F1);
    let plain = good(F1);
    let text_of = |specification: &Specification| {
        specification.text(specification.definition(specification.functions[0].outputs[0]).unwrap())
    };
    assert_eq!(text_of(&good(&text)), text_of(&plain));
    assert_eq!(text_of(&good(&F1.replace('\n', "\r\n"))), text_of(&plain));
    assert_eq!(text_of(&good(&format!("\u{FEFF}{F1}"))), text_of(&plain));
    let other = good(&F1.replace("ACC_Tst", "Prüfung_1").replace("EISb_Pos", "ΘΕΣΗ"));
    assert!(text_of(&other).contains("!Prüfung_1 & !ACC_TfT & !ΘΕΣΗ"));
}

#[test]
fn what_a_specification_holds() {
    let specification = good(
        "system \"A  (* no *) // system\"; (* comment ; } \" *) // another \" {
        zone Z \"zone\" { input g normally TRUE; restriction RZ \"why\": never g & a;
            function F \"title\" {
                informal { sil: 3; hazard: \"heat; {\"; redundancy: 1oo2; }
                interface { input a \"first\" at %IX0.1; output F is Block.Out[1, 2] latched until !a delayed T#1s500ms; }
                formal { F = T | g; T = a; restriction RF: at most one of a, g | T, F; } } }",
    );
    assert_eq!(specification.title.as_deref(), Some("A (* no *) // system"));
    let function = &specification.functions[0];
    let said: Vec<(&str, &str)> = function.informal.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
    assert_eq!(said, [("sil", "3"), ("hazard", "heat; {"), ("redundancy", "1oo2")]);
    let output = specification.signal(function.outputs[0]);
    let Kind::Defined { latched: Some(_), delayed: Some(1500), is_output: true, .. } = output.kind else {
        panic!("{output:?}");
    };
    assert!(format!("{:?}", output.binding).contains("Block.Out[1,2]"));
    let texts: Vec<&str> = specification.restrictions.iter().map(|restriction| restriction.text.as_str()).collect();
    assert_eq!(texts, ["never g & a", "at most one of a, g | T, F"]);
    assert!(specification.inputs().any(|input| specification.rest(input)));
}

/// Formulas over ten signals.
fn formulas() -> impl Strategy<Value = Formula> {
    let leaf = prop_oneof![9 => (0..10_usize).prop_map(signal), 1 => any::<bool>().prop_map(Formula::Constant)];
    leaf.prop_recursive(5, 30, 4, |inner| {
        let many = prop::sample::select(vec![Operator::And, Operator::Or, Operator::Xor]);
        let among = prop::sample::select(vec![Operator::AtMostOne, Operator::ExactlyOne]);
        let two = prop::sample::select(vec![Operator::Implies, Operator::Iff]);
        prop_oneof![
            inner.clone().prop_map(|inner| match inner {
                Formula::Not(_) => inner,
                inner => Formula::Not(Box::new(inner)),
            }),
            (many, prop::collection::vec(inner.clone(), 2..5)).prop_map(|(operator, of)| Formula::Gate(operator, of)),
            (among, prop::collection::vec(inner.clone(), 1..5)).prop_map(|(operator, of)| Formula::Gate(operator, of)),
            (two, inner.clone(), inner).prop_map(|(operator, a, b)| Formula::Gate(operator, vec![a, b])),
        ]
    })
}

/// Pieces that a specification is made of.
fn soup() -> impl Strategy<Value = String> {
    let words = [
        "system",
        "zone",
        "function",
        "informal",
        "interface",
        "formal",
        "input",
        "output",
        "restriction",
        "never",
        "always",
        "at",
        "is",
        "normally",
        "latched until",
        "delayed",
        "at most one of",
        "{",
        "}",
        "{",
        "}",
        "(",
        ")",
        ";",
        ";",
        "=",
        ":",
        ",",
        "\"",
        "\"x\"",
        "a",
        "b",
        "F1",
        "&",
        "|",
        "!",
        "│",
        "┐",
        "->",
        "%IX0.0",
        "T#1s",
        "(*",
        "*)",
        "//",
        "\n",
        "\r\n",
        "\0",
        "é",
        "1",
        "TRUE",
        "not",
    ];
    prop::collection::vec(prop::sample::select(words.to_vec()), 0..60).prop_map(|words| words.join(" "))
}

proptest! {
    #[test]
    fn what_is_written_is_read_again(written in formulas()) {
        let names: Vec<String> = (0..10).map(|at| format!("s{at}")).collect();
        let text = written.text(&|signal: SignalId| names[signal.0].as_str());
        prop_assert_eq!(formula(&text), written, "{}", text);
    }

    #[test]
    fn soup_is_refused(text in soup()) {
        read(&text);
    }

    #[test]
    fn a_specification_with_a_hole_or_a_word_too_many(from in 0..1800_usize, length in 0..40_usize, more in soup()) {
        let cut = |at: usize| (0..=at.min(F1.len())).rev().find(|at| F1.is_char_boundary(*at)).unwrap();
        let (from, to) = (cut(from), cut(from + length));
        read(&format!("{}{}", &F1[..from], &F1[to..]));
        read(&format!("{}{more}{}", &F1[..from], &F1[to..]));
    }
}

/// What would take a reader long, or deep, that tries everything.
#[test]
fn large_and_deep() {
    let function = |formal: &str| format!("function F {{ interface {{ input a; output F; }} formal {{ {formal} }} }}");
    let many = 30_000;
    let broken = [
        "{".repeat(90),
        "x {".repeat(90),
        "zone Z {".repeat(90),
        "function F { formal {".repeat(40),
        "{".repeat(many),
        "// \" (((\n".to_owned() + &"(".repeat(many),
        function(&format!("F = {}a;", "(".repeat(many))),
        function(&format!("F = {}a;", "!(".repeat(99))),
        function(&format!("F = {}a;", "at most one of (a, ".repeat(99))),
        function(&format!("F = {}a;", "a -> ".repeat(many))),
        function(&format!("F = {}a;", "a <-> ".repeat(many))),
        "bad ; ".repeat(5000),
        function(&"bad bad; ".repeat(5000)),
        "\"".repeat(many + 1),
        "function F { ".to_owned() + &"informal { } ".repeat(5000),
    ];
    for text in broken {
        let (specification, diagnostics) = read(&text);
        assert!(specification.is_none() && !diagnostics.is_empty(), "{}", &text[..60]);
    }
    let fine = [
        function(&format!("F = {}a;", "!".repeat(many + 1))),
        function(&format!("F = {}a{};", "(".repeat(90), ")".repeat(90))),
        function(&format!("F = {}a;", "a & ".repeat(many))),
        function(&format!("F = {}a;", "a | a & ".repeat(many))),
        format!("(* {} *) {}", "(".repeat(many), function("F = a;")),
        format!("system \"{}\"; {}", "(".repeat(many), function("F = a;")),
    ];
    for text in fine {
        good(&text);
    }
    // Auxiliary values, each of the one before.
    let mut formal = String::from("T0 = a; ");
    (1..5_000).for_each(|at| _ = write!(formal, "T{at} = !T{}; ", at - 1));
    let specification = good(&function(&(formal + "F = T4999;")));
    let output = specification.functions[0].outputs[0];
    assert!(specification.settled(&specification.valuation([])).contains(output.0));
}

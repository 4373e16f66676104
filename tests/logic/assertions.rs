//! Assertions at lines: by hand, and in both views of random programs.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::explore::{Budget, Progress};
use petril::logic::{Assertion, Origin, View, bind_assertion, parse_requirements};
use petril::source::Source;
use petril::syntax::requirements_in_comments;
use petril::translate::{Plant, System};
use petril::verdict::{Answer, Options, Outcome, Trace, Verdict, Witness, check};
use proptest::prelude::*;
use support::{formula, program, random_program};

/// The assertions that stand in the comments of a program.
fn asserted(text: &str, system: &System) -> Result<Vec<Assertion>, Vec<String>> {
    let comments = Source::new("p.il", requirements_in_comments(text).unwrap());
    let (file, errors) = parse_requirements(&comments);
    assert!(errors.is_empty(), "{errors:#?}");
    let bound = file.assertions.iter().map(|assertion| bind_assertion(assertion, text, system, View::Scan));
    bound.collect::<Result<_, _>>().map_err(|errors| errors.into_iter().map(|error| error.message).collect())
}

fn answers(system: &System, view: View, assertions: Vec<Assertion>) -> Vec<Answer> {
    check(system, &[], &Options { view, assertions, ..Options::default() }, &mut |_| None).answers
}

const COUNTED: &str = "PROGRAM p
VAR_INPUT In, Gate : BOOL; END_VAR
VAR Mem : BOOL; END_VAR
VAR_OUTPUT Out : BOOL; END_VAR
//@ assert out_is_old \"Out is still that of the scan before\": Out = pre(Out);
    LD   In
    ST   Mem
(*@ assert copied: Mem = In; *)
    LD   Gate
    JMPCN skip
    LD   Mem
    ST   Out
(*@ assert Out = In; *)
skip: LD Out
(*@ assert gated: Out = (Mem & Gate); *)
    ST   Mem
END_PROGRAM
";

#[test]
fn assertions_are_about_the_moment_before_an_instruction() {
    let system = System::new(program(COUNTED), Plant::default());
    let assertions = asserted(COUNTED, &system).unwrap();
    let lines: Vec<_> = assertions.iter().map(|a| (a.name.as_str(), a.lines.as_slice(), a.origin.line)).collect();
    assert_eq!(
        lines,
        [("out_is_old", [0].as_slice(), 5), ("copied", &[2], 8), ("assert_13", &[6], 13), ("gated", &[7], 15)]
    );
    let told: Vec<_> = answers(&system, View::Scan, assertions)
        .iter()
        .map(|answer| match &answer.outcome {
            Outcome::Violated(witness, _) => match &witness.trace {
                Trace::Scans(trace) => (answer.name.clone(), trace.scans.len(), witness.notes[0].text.clone()),
                Trace::Firings(_) => panic!("firings"),
            },
            outcome => (answer.name.clone(), 0, outcome.verdict().word().to_owned()),
        })
        .collect();
    let told: Vec<_> = told.iter().map(|(name, scans, text)| (name.as_str(), *scans, text.as_str())).collect();
    assert_eq!(
        told,
        [
            ("out_is_old", 0, "holds"),
            ("copied", 0, "holds"),
            // Control comes there by the jump, too, where Out is not In: with In and without Gate.
            ("assert_13", 1, "before line 7 of the flat code (`LD Out`), `Out = In` was false"),
            // Gate is off, and Out still on: a scan before has put it on.
            ("gated", 2, "before line 8 of the flat code (`ST Mem`), `Out = (Mem & Gate)` was false"),
        ]
    );
}

#[test]
fn assertions_stand_before_instructions() {
    let behind = COUNTED.replace("END_PROGRAM", "//@ assert Out;\nEND_PROGRAM");
    let system = System::new(program(&behind), Plant::default());
    assert_eq!(asserted(&behind, &system).unwrap_err(), ["no instruction of the program follows this assertion"]);
    for (text, error) in [
        ("AF Out", "an assertion cannot look ahead"),
        ("once(Out)", "an assertion can look back one scan only"),
        ("pre(pre(Out))", "an assertion can look back one scan only"),
        ("Ouut", "the program `p` has no variable `Ouut`"),
    ] {
        let text = COUNTED.replace("Mem = In", text);
        assert_eq!(asserted(&text, &system).unwrap_err(), [error], "{text}");
    }
}

/// An output that nothing reads before it is written makes no difference to later scans, but to an assertion before it is written.
#[test]
fn values_that_the_program_does_not_carry_are_seen() {
    let text = "PROGRAM p
VAR_INPUT In : BOOL; END_VAR
VAR_OUTPUT Out : BOOL; END_VAR
//@ assert !Out;
    LD In
    ST Out
END_PROGRAM
";
    let system = System::new(program(text), Plant::default());
    let answers = answers(&system, View::Scan, asserted(text, &system).unwrap());
    let Outcome::Violated(witness, _) = &answers[0].outcome else { panic!("{answers:?}") };
    let Trace::Scans(trace) = &witness.trace else { panic!() };
    assert_eq!(trace.scans.len(), 2, "In is on in the first scan, and Out still in the second");
}

#[test]
fn too_many_inputs_are_no_answer() {
    let text = "PROGRAM p
VAR_INPUT A, B : DINT; END_VAR
VAR_OUTPUT Out : DINT; END_VAR
    LD A
    ADD B
//@ assert A < 3;
    ST Out
END_PROGRAM
";
    let system = System::new(program(text), Plant::default());
    let answers = answers(&system, View::Scan, asserted(text, &system).unwrap());
    let Outcome::Unknown(reason) = &answers[0].outcome else { panic!("{answers:?}") };
    assert!(reason.contains("more than 16777216 combinations"), "{reason}");
}

/// A number that goes round from 0 to 7, one more in each scan.
const ROUND: &str = "PROGRAM p
VAR N : INT; END_VAR
VAR_OUTPUT Out : BOOL; END_VAR
    LD  N
    ADD 1
    MOD 8
    ST  N
    GT  3
    ST  Out
END_PROGRAM
";

/// That `N` is less than a bound in some lines.
fn less(bound: u64, lines: &[usize], system: &System) -> Assertion {
    let text = format!("N < {bound}");
    let formula = formula(&text, system, View::Scan);
    Assertion { name: text.clone(), sentence: None, text, origin: Origin::default(), formula, lines: lines.to_vec() }
}

/// At the beginning of scan n, `N` is n - 1.
#[test]
fn only_what_was_explored_is_asserted() {
    let system = System::new(program(ROUND), Plant::default());
    let told = |states: u64, watch: &mut dyn FnMut(&Progress) -> Option<String>| -> Vec<String> {
        let assertions = [1, 5, 8].map(|bound| less(bound, &[0], &system)).to_vec();
        let budget = Budget { states, ..Budget::default() };
        let report = check(&system, &[], &Options { assertions, budget, ..Options::default() }, watch);
        let told = report.answers.iter().map(|answer| match &answer.outcome {
            Outcome::Violated(Witness { trace: Trace::Scans(trace), .. }, _) => format!("{} scans", trace.scans.len()),
            Outcome::Unknown(reason) => reason.split(';').next().unwrap().to_owned(),
            outcome => outcome.verdict().word().to_owned(),
        });
        told.collect()
    };
    assert_eq!(told(100, &mut |_| None), ["2 scans", "6 scans", "holds"]);
    let limit = "the limit of 3 states was reached";
    assert_eq!(told(3, &mut |_| None), ["2 scans", limit, limit]);
    let ended = "the check was ended before all scans were looked at";
    let mut explored = |progress: &Progress| (progress.expanded == 8).then(|| "enough".to_owned());
    assert_eq!(told(100, &mut explored), [ended; 3]);
}

/// Behind the line that counts, `N` is 1 in the first scan already.
#[test]
fn of_many_lines_the_nearest_scan_is_shown() {
    let system = System::new(program(ROUND), Plant::default());
    for lines in [[0, 4], [4, 0]] {
        let answers = answers(&system, View::Scan, vec![less(1, &lines, &system)]);
        let Outcome::Violated(Witness { trace: Trace::Scans(trace), notes }, _) = &answers[0].outcome else { panic!() };
        assert_eq!(trace.scans.len(), 1);
        assert_eq!(notes[0].text, "before line 5 of the flat code (`GT 3`), `N < 1` was false");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, ..ProptestConfig::default() })]

    #[test]
    fn both_views_agree(
        text in random_program::text(6),
        at in any::<prop::sample::Index>(),
        names in prop::sample::subsequence(vec!["i0", "i1", "m0", "m1", "q0", "!i2", "!m2", "!q1"], 1..4),
    ) {
        let system = System::new(program(&text), Plant::default());
        prop_assume!(system.program.end() > 0);
        let said = names.join(" | ");
        let assertion = |view| Assertion {
            name: "a".to_owned(),
            sentence: None,
            text: said.clone(),
            origin: Origin::default(),
            formula: formula(&said, &system, view),
            lines: vec![at.index(system.program.end())],
        };
        let [scans, firings] = [View::Scan, View::Transition].map(|view| {
            answers(&system, view, vec![assertion(view)])[0].outcome.clone()
        });
        if let Outcome::Unknown(reason) = &scans {
            prop_assert!(reason.contains("does not end"), "{}", reason);
            return Ok(());
        }
        prop_assert_eq!(scans.verdict(), firings.verdict(), "{}\n{} in line {}", text, said, at.index(system.program.end()) + 1);
        prop_assert!(scans.verdict() != Verdict::Unknown);
    }
}

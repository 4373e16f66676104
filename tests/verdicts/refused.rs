//! Formulas bound for another view or another system than they are checked with: no verdict comes of them.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::Check;
use petril::logic::{Requirement, View, bind_requirement, parse_requirement};
use petril::source::Source;
use petril::translate::{Plant, System};
use petril::verdict::{Options, Outcome, Verdict, check};

const FOLLOWS: &str = "PROGRAM p VAR_INPUT a : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR\nLD a\nST q\nEND_PROGRAM";

fn system(text: &str) -> System {
    System::new(support::program(text), Plant::default())
}

fn requirement(text: &str) -> Requirement {
    parse_requirement("r", &Source::new("r", text)).unwrap()
}

/// Reason why nothing is known of a requirement that is bound for one system and view, and checked with another.
fn reason(text: &str, (bound, for_view): (&System, View), (checked, view): (&System, View)) -> String {
    let requirement = requirement(text);
    let demand = bind_requirement(&requirement, bound, for_view).unwrap();
    let report = check(checked, &[(requirement, demand)], &Options { view, ..Options::default() }, &mut |_| None);
    assert_eq!((report.verdict(), report.exploration.states), (Verdict::Unknown, 0));
    match report.answers.as_slice() {
        [answer] => match &answer.outcome {
            Outcome::Unknown(reason) => reason.clone(),
            outcome => panic!("{outcome:?}"),
        },
        answers => panic!("{answers:?}"),
    }
}

#[test]
fn formulas_of_one_view_have_no_verdict_in_the_other() {
    let p = system(FOLLOWS);
    // Control comes to line 2 in every scan; in no end of a scan it is there, so the scan view would say that this holds.
    for text in ["AG !at line 2", "AG !at deadlock", "AG !enabled(\"block\")"] {
        let said = reason(text, (&p, View::Transition), (&p, View::Scan));
        assert_eq!(said, "it was bound for the other view: bind it for the view that is checked", "{text}");
    }
    for text in ["AG !q", "AG (pre(a) -> q)"] {
        let said = reason(text, (&p, View::Scan), (&p, View::Transition));
        assert_eq!(said, "it was bound for the other view: bind it for the view that is checked", "{text}");
    }
}

#[test]
fn formulas_of_another_system_have_no_verdict() {
    let p = system(FOLLOWS);
    let more = FOLLOWS.replace("q : BOOL;", "q, r, s, t : BOOL;").replace("ST q", "ST q\nST r\nST s\nST t");
    let other = system(&more);
    let said = reason("AG !t", (&other, View::Scan), (&p, View::Scan));
    assert_eq!(said, "it was bound for another system: bind it for the one that is checked");
    let said = reason("AG !at line 5", (&other, View::Transition), (&p, View::Transition));
    assert_eq!(said, "it was bound for another system: bind it for the one that is checked");
}

#[test]
fn a_check_binds_what_it_runs() {
    let program = Source::new("p", FOLLOWS);
    let verdict = |check: Check| check.run(&mut |_| None).verdict();
    let scan = || Check::of(&program).unwrap();
    assert_eq!(verdict(scan().require("r", "AG (q <-> a)").unwrap()), Verdict::Holds);
    assert_eq!(verdict(scan().require("r", "AG !q").unwrap()), Verdict::Violated);
    // Lines are not there at the ends of scans: the text is refused.
    let errors = scan().require("r", "AG !at line 2").unwrap_err();
    assert!(errors[0].message.contains("a state of the scan view is the end of a scan"), "{errors:?}");
    let transition = Check::in_plants(&program, &[], View::Transition).unwrap();
    assert_eq!(verdict(transition.require("r", "AG !at line 2").unwrap()), Verdict::Violated);
    // A formula without a path quantifier speaks of the first scan alone.
    let doubtful = scan().require("r", "q <-> a").unwrap();
    assert_eq!(doubtful.warnings().iter().map(|warning| warning.code.id()).collect::<Vec<_>>(), ["W0512"]);
    let errors = Check::of(&Source::new("p", "PROGRAM p\nLD x\nST y\nEND_PROGRAM")).unwrap_err();
    assert_eq!(errors.iter().map(|error| error.code.id()).collect::<Vec<_>>(), ["E0202", "E0202"]);
}

//! The patterns of requirements: for each a program where it holds, one where it fails, and the shortest run that shows it, worked
//! out by hand; and formulas that are mistaken for patterns, where they differ.

#![allow(clippy::panic, reason = "a test that panics has failed")]

use petril::logic::{Demand, View, bind_requirement, parse_requirement};
use petril::source::Source;
use petril::translate::{Plant, System};
use petril::verdict::Verdict;
use support::reports::{answer, counterexample, report, values};

fn system(declarations: &str, code: &str) -> System {
    let text = format!("PROGRAM p\n{declarations}\n{code}\nEND_PROGRAM\n");
    System::new(support::program(&text), Plant::default())
}

/// Programs of BOOL variables: inputs, then outputs with the rest, and the instructions between semicolons.
fn bools(inputs: &str, others: &str, code: &str) -> System {
    let declarations = format!("VAR_INPUT {inputs} : BOOL; END_VAR\nVAR_OUTPUT {others} : BOOL; END_VAR");
    system(&declarations, &code.replace(';', "\n"))
}

/// Verdict and shortest run of a pattern, in its short form and as a sentence, which must be the same requirement.
fn check(system: &System, names: &[&str], forms: [&str; 2]) -> (Verdict, Vec<String>) {
    let demands = forms.map(|form| {
        let requirement = parse_requirement("r", &Source::new("r", form)).unwrap_or_else(|e| panic!("{form}: {e:#?}"));
        assert!(requirement.words.is_some(), "`{form}` is no pattern");
        match bind_requirement(&requirement, system, View::Scan) {
            Ok(demand @ (Demand::Formula(_) | Demand::Possible(_))) => demand.text(system).unwrap_or_default(),
            other => format!("{other:?}"),
        }
    });
    assert_eq!(demands[0], demands[1], "the sentence says another thing than the short form");
    let report = report(system, &format!("requirement r: {};", forms[0]));
    let verdict = answer(&report, "r").outcome.verdict();
    let trace = match verdict {
        Verdict::Violated => values(system, counterexample(&report, "r"), names),
        _ => Vec::new(),
    };
    (verdict, trace)
}

/// The pattern holds for the first program, and fails for the second as this run shows: the values of `names` after each scan.
fn pattern(forms: [&str; 2], holds: &System, fails: &System, names: &[&str], run: &[&str]) {
    assert_eq!(check(holds, names, forms), (Verdict::Holds, vec![]), "{forms:?}");
    let run = run.iter().map(|row| (*row).to_owned()).collect();
    assert_eq!(check(fails, names, forms), (Verdict::Violated, run), "{forms:?}");
}

/// Stop wins.
fn starter() -> System {
    bools("Start, Stop", "Motor", "LD Start; OR Motor; ANDN Stop; ST Motor")
}

/// Begun, and in a later scan Done.
fn two_steps() -> System {
    bools("Start, Ack", "Begun, Done", "LD Begun; AND Ack; ST Done; LD Start; OR Begun; ST Begun")
}

/// Begun and Done may come in the same scan.
fn one_step() -> System {
    bools("Start, Ack", "Begun, Done", "LD Start; OR Begun; ST Begun; AND Ack; ST Done")
}

#[test]
fn implication() {
    let start_wins = bools("Start, Stop", "Motor", "LD Motor; ANDN Stop; OR Start; ST Motor");
    let sentence =
        "If Stop is true at the end of the PLC cycle, then !Motor should always be true at the end of the same cycle.";
    // Both buttons in the first scan: OR Start comes last.
    pattern(["implication(Stop, !Motor)", sentence], &starter(), &start_wins, &["Start", "Stop", "Motor"], &["111"]);
}

#[test]
fn invariant() {
    let follows = bools("In", "Mem, Out", "LD In; ST Mem; ST Out");
    let lags = bools("In", "Mem, Out", "LD Mem; ST Out; LD In; ST Mem");
    let sentence = "!In | Out is always true at the end of the PLC cycle.";
    // The first scan puts out the memory of power-on.
    pattern(["invariant(!In | Out)", sentence], &follows, &lags, &["In", "Mem", "Out"], &["110"]);
}

#[test]
fn forbidden() {
    let locked = bools("A, B", "Up, Down", "LD A; ANDN B; ST Up; LD B; ANDN A; ST Down");
    // Up stays on; Down looks at the button only, so that it takes a second scan.
    let half = bools("A, B", "Up, Down", "LD A; OR Up; ST Up; LD B; ANDN A; ST Down");
    let sentence = "Up & Down is impossible at the end of the PLC cycle.";
    let names = ["A", "B", "Up", "Down"];
    pattern(["forbidden(Up & Down)", sentence], &locked, &half, &names, &["1010", "0111"]);
}

#[test]
fn state_change_during_a_cycle() {
    let lags = bools("In", "Mem, Out", "LD Mem; ST Out; LD In; ST Mem");
    let follows = bools("In", "Mem, Out", "LD In; ST Mem; ST Out");
    let sentence =
        "If Mem is true at the beginning of the PLC cycle, then Out is always true at the end of the same cycle.";
    pattern(["statechange-duringcycle(Mem, Out)", sentence], &lags, &follows, &["In", "Mem", "Out"], &["111", "000"]);
}

#[test]
fn at_the_beginning_of_the_first_scan_there_are_the_initial_values() {
    let program = |initial: &str| {
        let declarations = format!(
            "VAR_INPUT In : BOOL; END_VAR\nVAR Mem : BOOL := {initial}; END_VAR\nVAR_OUTPUT Out : BOOL; END_VAR"
        );
        system(&declarations, "LD In\nST Mem\nST Out")
    };
    let short = "statechange_duringcycle(Mem, Out)";
    let sentence = "If Mem is true at the beginning of a scan then Out is true at the end of the same scan";
    assert_eq!(check(&program("TRUE"), &["In", "Out"], [short, sentence]).1, ["00"]);
    assert_eq!(check(&program("FALSE"), &["In", "Out"], [short, sentence]).1, ["11", "00"]);
}

#[test]
fn state_change_between_cycles() {
    let falling = bools("In", "Fall, Last", "LD Last; ANDN In; ST Fall; LD In; ST Last");
    let rising = bools("In", "Fall, Last", "LD In; ANDN Last; ST Fall; LD In; ST Last");
    let sentence = "If In is true at the end of cycle N and !In at the end of cycle N+1, then Fall is always true at the end of cycle N+1.";
    let short = "statechange-betweencycles(In, !In, Fall)";
    pattern([short, sentence], &falling, &rising, &["In", "Fall"], &["11", "00"]);
}

#[test]
fn reachability() {
    let never = bools("Start, Stop", "Motor", "LD Start; AND Stop; ANDN Stop; ST Motor");
    let sentence = "It is possible to have Motor at the end of a cycle.";
    // No run shows that no run does it; the one that is shown is the first state.
    pattern(["reachability(Motor)", sentence], &starter(), &never, &["Start", "Stop", "Motor"], &["000"]);
}

/// `EF a` is required after every first scan, `reachability(a)` of power-on: the first scan may shut the door.
#[test]
fn what_is_possible_from_power_on() {
    // Whoever does not press Key in the first scan never can again.
    let door = bools("Key", "Open, Late", "LD Late; JMPC end; LD Key; ST Open; end: LD TRUE; ST Late");
    let told = |requirement: &str| report(&door, &format!("requirement r: {requirement};"));
    let verdict = |requirement: &str| answer(&told(requirement), "r").outcome.verdict();
    assert_eq!(verdict("EF Open"), Verdict::Violated);
    assert_eq!(verdict("!AG !Open"), Verdict::Violated);
    assert_eq!(verdict("AG !Open"), Verdict::Violated);
    assert_eq!(verdict("reachability(Open & Key)"), Verdict::Holds);
    assert_eq!(verdict("reachability(Open & Late & !Key)"), Verdict::Holds);
    assert_eq!(verdict("reachability(Open & !Late)"), Verdict::Violated);
    assert_eq!(verdict("It is possible to have Open at the end of a cycle."), Verdict::Holds);
    let report = told("reachability(Open & !Key)");
    let witness = answer(&report, "r").outcome.witness().expect("a run");
    let petril::verdict::Trace::Scans(trace) = &witness.trace else { panic!("a run of scans") };
    assert_eq!(values(&door, trace, &["Key", "Open"]), ["11", "01"]);
    let report = told("EF Open");
    let petril::verdict::Outcome::Violated(_, Some(why)) = &answer(&report, "r").outcome else {
        panic!("with a reason")
    };
    let elsewhere = "After other first scans `EF Open` is true, but a requirement must be true after every first scan; \
                     `reachability(Open)` asks whether some run from power-on comes there";
    assert_eq!(why.wanted.last().map(String::as_str), Some(elsewhere));
    // Where no first scan helps, nothing of the kind is said.
    let report = told("EF (Open & !Late)");
    let petril::verdict::Outcome::Violated(_, Some(why)) = &answer(&report, "r").outcome else {
        panic!("with a reason")
    };
    assert!(!why.wanted.iter().any(|sentence| sentence.contains("other first scans")), "{why:?}");
}

#[test]
fn repeatability() {
    let fuse = bools("Start, Stop", "Blown, Motor", "LD Stop; OR Blown; ST Blown; LD Start; ANDN Blown; ST Motor");
    let sentence = "Any time it is possible to have eventually Motor at the end of a cycle.";
    // Once Stop was pressed, the fuse has blown.
    pattern(["repeatability(Motor)", sentence], &starter(), &fuse, &["Start", "Stop", "Motor"], &["010"]);
}

#[test]
fn leads_to() {
    let sentence = "If Done is true at the end of a cycle, Begun was true at the end of an earlier cycle.";
    let names = ["Start", "Ack", "Begun", "Done"];
    pattern(["leadsto(Done, Begun)", sentence], &two_steps(), &one_step(), &names, &["1111"]);
}

#[test]
fn leads_to_trigger() {
    let edge = bools(
        "Start, Stop",
        "Edge, Last, Motor",
        "LD Edge; OR Motor; ANDN Stop; ST Motor; LD Start; ANDN Last; ST Edge; LD Start; ST Last",
    );
    let sentence = "If Motor is true at the end of a cycle, there was a change from !Start to Start at the end of an earlier cycle.";
    let short = "leadsto-trigger(Motor, !Start, Start)";
    // The change is in the same scan, not in an earlier one.
    pattern([short, sentence], &edge, &starter(), &["Start", "Stop", "Motor"], &["101"]);
}

#[test]
fn leads_to_earlier() {
    let sentence =
        "If Done is true at the end of a cycle, Begun was true at the beginning of this or an earlier cycle.";
    let names = ["Start", "Ack", "Begun", "Done"];
    pattern(["leadsto-earlier(Done, Begun)", sentence], &two_steps(), &one_step(), &names, &["1111"]);
}

#[test]
fn timed_trigger() {
    let after = |conditions: &str| {
        let code = format!("LD In; {conditions} ST Alarm; LD M3; ST M4; LD M2; ST M3; LD M1; ST M2; LD In; ST M1");
        bools("In", "Alarm, M1, M2, M3, M4", &code)
    };
    let (three, four) = (after("AND M1; AND M2; AND M3;"), after("AND M1; AND M2; AND M3; AND M4;"));
    let run = ["10", "10", "10", "10"];
    for time in ["3 scans", "T#50ms", "60ms", "T#60ms"] {
        // A scan takes 20 ms: 50 ms are over at the end of the third scan after.
        let short = format!("timed-trigger(In, {time}, Alarm)");
        let sentence = format!("If In is true at the end of a cycle and stays so for {time}, Alarm will be true.");
        pattern([&short, &sentence], &three, &four, &["In", "Alarm"], &run);
    }
    // As tools that speak of the "EoC" write it.
    let short = "timed_trigger(In, 60 ms, Alarm)";
    let eoc = "If In is true at the end of cycle (EoC), and stays true at EoC for 60 ms of time, Alarm will be true.";
    pattern([short, eoc], &three, &four, &["In", "Alarm"], &run);
    let longer = [
        "timed_trigger(In, 61ms, Alarm)",
        "If In is true at the end of a scan and stays so for 61ms Alarm will be true.",
    ];
    assert_eq!(check(&four, &["In", "Alarm"], longer).0, Verdict::Holds);
}

#[test]
fn mutual_exclusion() {
    let locked = bools("A, B, C", "X, Y, Z", "LD A; ST X; LD B; ANDN A; ST Y; LD C; ANDN A; ANDN B; ST Z");
    let half = bools("A, B, C", "X, Y, Z", "LD A; ST X; LD B; ANDN A; ST Y; LD C; ANDN A; ST Z");
    let sentence = "At most one of X, Y and Z is true at the end of a scan.";
    pattern(["mutual_exclusion(X, Y, Z)", sentence], &locked, &half, &["X", "Y", "Z"], &["011"]);
}

#[test]
fn response() {
    let two_later = bools("In", "Out, M1, M2", "LD M1; ST Out; LD M2; ST M1; LD In; ST M2");
    let three_later = bools("In", "Out, M1, M2, M3", "LD M1; ST Out; LD M2; ST M1; LD M3; ST M2; LD In; ST M3");
    let short = "response(In & !pre(In), Out, 2 scans)";
    let sentence = "If In & !pre(In) is true at the end of a scan, Out is true within 2 scans.";
    // Out comes in the scan after the next, or one later.
    let names = ["In", "Out"];
    let (verdict, run) = check(&three_later, &names, [short, sentence]);
    assert_eq!((verdict, run.len()), (Verdict::Violated, 3));
    assert_eq!(run[0], "10");
    assert!(run.iter().all(|row| row.ends_with('0')));
    assert_eq!(check(&two_later, &names, [short, sentence]).0, Verdict::Holds);
}

/// A counter says when Out comes: in scan `after` after the one with In, which then no longer matters.
fn delay(after: u32) -> System {
    let declarations =
        "VAR_INPUT In : BOOL; END_VAR\nVAR N : INT; Busy : BOOL; END_VAR\nVAR_OUTPUT Out : BOOL; END_VAR";
    let code = format!(
        "LD Busy\nJMPCN idle\nLD N\nADD 1\nST N\nidle: LD In\nOR Busy\nST Busy\nLD N\nEQ {after}\nST Out\nR Busy\nJMPCN out\nLD 0\nST N\nout: LD Out"
    );
    system(declarations, &code)
}

#[test]
fn a_long_response_counts_and_a_short_one_looks_ahead() {
    for n in [3, 21, 30] {
        for (after, expected) in [(n, Verdict::Holds), (n + 1, Verdict::Violated)] {
            let system = delay(after);
            let requirements = format!(
                "requirement counted: AG !held((!Out since (In & !Out)), {n} scans);
                 requirement response: response(In, Out, {n} scans);
                 requirement ahead: AG (In -> Out within {n} scans);"
            );
            let report = report(&system, &requirements);
            for name in ["counted", "response", "ahead"] {
                assert_eq!(answer(&report, name).outcome.verdict(), expected, "{name} {n} {after}");
                if expected == Verdict::Violated {
                    // From the scan with In, n + 1 scans end without Out.
                    assert_eq!(counterexample(&report, name).scans.len() as u32, n + 1, "{name}");
                }
            }
        }
    }
}

#[test]
fn changes_only_if() {
    let gated = bools("In, Gate", "Out", "LD Gate; JMPCN end; LD In; ST Out; end: LD Out");
    let open = bools("In, Gate", "Out", "LD In; ST Out");
    let sentence = "Out changes only if Gate is true.";
    // The first scan has nothing to change from.
    let (verdict, run) = check(&open, &["In", "Gate", "Out"], ["changes_only_if(Out, Gate)", sentence]);
    assert_eq!((verdict, run.len()), (Verdict::Violated, 2));
    assert_eq!(check(&gated, &["Out"], ["changes_only_if(Out, Gate)", sentence]).0, Verdict::Holds);
}

#[test]
fn stable_outputs() {
    let inverted = bools("In", "Out", "LDN In; ST Out");
    let blinks = bools("In", "Out", "LDN Out; AND In; ST Out");
    let forms = ["stable_outputs()", "No output changes unless an input does."];
    pattern(forms, &inverted, &blinks, &["In", "Out"], &["11", "10"]);
}

#[test]
fn every_line_is_reachable() {
    let all = bools("In", "Out", "LD In; JMPC end; ST Out; end: LD Out");
    let never = bools("In", "Out, M", "LD M; JMPCN end; LD In; ST Out; end: LD Out");
    let forms = ["every_line_reachable()", "Every line is reachable."];
    assert_eq!(check(&all, &[], forms).0, Verdict::Holds);
    let report = report(&never, "requirement r: every_line_reachable();");
    let witness = answer(&report, "r").outcome.witness().expect("a run");
    let notes: Vec<&str> = witness.notes.iter().map(|note| note.text.as_str()).collect();
    assert_eq!(
        notes,
        [
            "no scan ever comes to line 3 of the flat code (`LD In`)",
            "no scan ever comes to line 4 of the flat code (`ST Out`)"
        ]
    );
}

#[test]
fn a_line_that_no_jump_leads_to_is_not_reachable() {
    let dead = bools("In", "Out", "LD In; ST Out; JMP end; LD Out; ST Out; end: LD In; ST Out");
    let report = report(&dead, "requirement r: every_line_reachable();");
    let witness = answer(&report, "r").outcome.witness().expect("a run");
    let notes: Vec<&str> = witness.notes.iter().map(|note| note.text.as_str()).collect();
    assert_eq!(
        notes,
        [
            "no scan ever comes to line 4 of the flat code (`LD Out`)",
            "no scan ever comes to line 5 of the flat code (`ST Out`)"
        ]
    );
    assert_eq!(report.coverage.and_then(|coverage| coverage.never_executed), Some(vec![3, 4]));
}

/// Formulas that are or have been taken for "if Done, Begun was true at the end of an earlier cycle".
#[test]
fn what_is_mistaken_for_leads_to_is_another_thing() {
    let ours = "leadsto(Done, Begun)";
    let verdict = |system: &System, requirement: &str| {
        answer(&report(system, &format!("requirement r: {requirement};")), "r").outcome.verdict()
    };
    let (good, bad) = (two_steps(), one_step());
    assert_eq!([&good, &bad].map(|system| verdict(system, ours)), [Verdict::Holds, Verdict::Violated]);
    let wrong = [
        // What comes after, not what came before: nobody may ever acknowledge.
        ("AG (Begun -> AF Done)", &good, Verdict::Violated),
        // That it can come is no matter of the past.
        ("AG (Begun -> EF Done)", &bad, Verdict::Holds),
        // Begun in the same scan is let pass.
        ("A [!Done W Begun]", &bad, Verdict::Holds),
        ("!E [!Begun U (Done & !Begun)]", &bad, Verdict::Holds),
        ("AG (Done -> Begun)", &bad, Verdict::Holds),
        ("AG (Done -> once(Begun))", &bad, Verdict::Holds),
        // Begun would have to come.
        ("A [!Done U Begun]", &good, Verdict::Violated),
        // It looks back, but no further than one scan, and forgets that Begun need not last.
    ];
    for (formula, system, expected) in wrong {
        assert_eq!(verdict(system, formula), expected, "{formula}");
        assert_ne!(verdict(system, formula), verdict(system, ours), "{formula}");
    }
    // Begun for one scan only, Done two scans later: `pre` alone has forgotten it.
    let forgets = bools("Start", "Begun, Mid, Done", "LD Mid; ST Done; LD Begun; ST Mid; LD Start; ST Begun");
    assert_eq!(verdict(&forgets, ours), Verdict::Holds);
    assert_eq!(verdict(&forgets, "AG (Done -> pre(Begun))"), Verdict::Violated);
    // Said with the past, it is ours.
    for system in [&good, &bad, &forgets] {
        assert_eq!(verdict(system, "AG (Done -> pre(once(Begun)))"), verdict(system, ours));
    }
}

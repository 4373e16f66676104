//! Proofs that programs compute what is specified: by hand, against every run on random programs, and a system of usual size.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::diagnostic::Code;
use petril::flat::{FlatProgram, Hazard, Tolerated};
use petril::sif::Specification;
use petril::sif::proof::{By, Confirmed, Failure, Form, Options, Outcome, Proof, Scan, Subject, prove};
use petril::source::Source;
use petril::verdict::Verdict;
use support::proofs::{function, program, proved, refuted};

const F1: &str = include_str!("../../examples/beam-interlock.sif");

fn specification(text: &str) -> Specification {
    let (specification, diagnostics) = Specification::read(&[Source::new("test.sif", text)]);
    specification.unwrap_or_else(|| panic!("{diagnostics:#?}"))
}

fn proof(specification: &str, program: &FlatProgram) -> Proof {
    proof_with(specification, program, Tolerated::default(), &Options::default())
}

fn proof_with(text: &str, program: &FlatProgram, tolerated: Tolerated, options: &Options) -> Proof {
    let specification = specification(text);
    let subject = Subject::new(&specification, program, tolerated, &[]).unwrap_or_else(|e| panic!("{e:#?}"));
    prove(&subject, options)
}

const F1_INPUTS: &str = "MODE_Acc, MODE_TFA, MODE_Tra, ACC_Tst, ACC_TfT, EISb_Pos, EISa_Safe";
const F1_BODY: &str = "LD MODE_Acc\nOR MODE_TFA\nOR MODE_Tra\nANDN ACC_Tst\nANDN ACC_TfT\nANDN EISb_Pos\n\
                       OR(\nLDN MODE_Acc\nANDN EISa_Safe\n)\nST F1";

#[test]
fn the_seeds_function_is_proved() {
    let proof = proof(F1, &program(F1_INPUTS, "F1", "", F1_BODY));
    // Of the 128 valuations, all are computed; scans that break a restriction lead nowhere. Nothing is carried.
    assert_eq!(proved(&proof), (By::AnyState, Some(Confirmed::EveryScan { states: 1, scans: 128 })));
    assert_eq!(proof.compared, 1024);
    assert_eq!(proof.assumptions.len(), 1, "{:?}", proof.assumptions);
    assert!(proof.assumptions[0].contains("for function F1, R3: never"), "{:?}", proof.assumptions);
}

/// Each change is seen at a valuation that the restrictions allow.
#[test]
fn mutants_of_the_seeds_function_are_refuted() {
    let mutants = [
        ("OR MODE_TFA", "ORN MODE_TFA"),
        ("OR MODE_TFA", "AND MODE_TFA"),
        ("OR MODE_Tra", ""),
        ("ANDN ACC_Tst", "AND ACC_Tst"),
        ("ANDN ACC_TfT", ""),
        ("ANDN EISb_Pos", "ORN EISb_Pos"),
        ("ANDN EISb_Pos", "ANDN EISa_Safe"),
        ("OR(\nLDN MODE_Acc", "OR(\nLD MODE_Acc"),
        ("OR(\n", "AND(\n"),
        ("OR(\n", "XORN(\n"),
        ("ANDN EISa_Safe", ""),
        ("ST F1", "STN F1"),
        ("ST F1", "S F1"),
        ("ST F1", "LD TRUE\nST F1"),
    ];
    for (from, to) in mutants {
        let proof = proof(F1, &program(F1_INPUTS, "F1", "", &F1_BODY.replace(from, to)));
        let [scan] = refuted(&proof).try_into().unwrap_or_else(|scans: Vec<String>| {
            assert_eq!((to, scans.len()), ("S F1", 2));
            [scans[1].clone()]
        });
        let [acc, tfa, tra, tst, tft, b, a] =
            scan.bytes().map(|bit| bit == b'1').collect::<Vec<_>>().try_into().unwrap();
        assert!(!(acc && (tfa || tra)) && !(tfa && tra) && !(!acc && (tst || tft)), "{to}: {scan}");
        let Outcome::Refuted(scans) = &proof.answers[0].outcome else { panic!() };
        let wanted = (acc || tfa || tra) && !tst && !tft && !b || !acc && !a;
        let last = scans.last().unwrap();
        assert_eq!((last.wanted[proof.answers[0].claim.signal.0], last.broken.len()), (wanted, 0));
        assert_eq!(last.memory[proof.answers[0].claim.variable.0] == 1, !wanted, "{to}");
    }
}

/// OR may take the place of XOR where both are never TRUE together, but only there.
#[test]
fn restrictions_count() {
    let or = program("a, b, c", "y", "", "LD a\nOR b\nST y");
    let text = function("", "y = a xor b;");
    assert_eq!(refuted(&proof(&text, &or)), ["110"]);
    proved(&proof(&text.replace("xor b;", "xor b; restriction R: at most one of a, b;"), &or));
    let contradicting = text.replace("xor b;", "xor b; restriction R: never a; restriction S: always a;");
    let proof = proof(&contradicting, &or);
    assert!(matches!(&proof.answers[0].outcome, Outcome::Unknown(why) if why.contains("contradict")), "{proof:?}");
}

#[test]
fn what_depends_on_the_past_is_refuted_by_two_scans() {
    let text = function("", "y = a & b;");
    let latching = program("a, b, c", "y", "", "LD a\nAND b\nS y");
    assert_eq!(refuted(&proof(&text, &latching)), ["110", "000"]);
    // Whether it was set at the beginning is seen at once.
    let set = support::program(
        "PROGRAM p VAR_INPUT a, b, c : BOOL; END_VAR VAR_OUTPUT y : BOOL := TRUE; END_VAR\nLD a\nAND b\nS y\nEND_PROGRAM",
    );
    assert_eq!(refuted(&proof(&text, &set)), ["000"]);
}

#[test]
fn latches_are_proved_by_induction() {
    let text = function(" latched until c", "y = a & b;");
    let latch = "LD c\nR y\nLD a\nAND b\nS y";
    let proof_of_latch = proof(&text, &program("a, b, c", "y", "", latch));
    assert_eq!(proof_of_latch.answers[0].claim.form, Form::Latched);
    let every = Some(Confirmed::EveryScan { states: 2, scans: 16 });
    assert_eq!(proved(&proof_of_latch), (By::Induction(1), every));
    let block =
        program("a, b, c", "y", "VAR f : SR; END_VAR", "LD a\nAND b\nST f.S1\nLD c\nST f.R\nCAL f\nLD f.Q1\nST y");
    assert!(matches!(proved(&proof(&text, &block)).0, By::Induction(_)));
    // What is reset first is not what is set first.
    let reset_first = "LD a\nAND b\nS y\nLD c\nR y";
    assert_eq!(refuted(&proof(&text, &program("a, b, c", "y", "", reset_first))), ["111"]);
    assert_eq!(refuted(&proof(&text, &program("a, b, c", "y", "", "LD a\nAND b\nST y"))), ["110", "000"]);
    assert_eq!(refuted(&proof(&text, &program("a, b, c", "y", "", "LD a\nAND b\nS y"))), ["110", "001"]);
    let set = "PROGRAM p VAR_INPUT a, b, c : BOOL; END_VAR VAR_OUTPUT y : BOOL := TRUE; END_VAR\n".to_owned();
    assert_eq!(refuted(&proof(&text, &support::program(&(set + latch + "\nEND_PROGRAM")))), ["000"]);
}

/// A function that uses a latched output needs to know that the program's is the same.
#[test]
fn latched_outputs_are_used_by_others() {
    let text = "function F { interface { input a; input c; output y latched until c; } formal { y = a; } }
                function G { interface { input b; input y; output z; } formal { z = y & b; } }";
    let right = program("a, b, c", "y, z", "", "LD y\nANDN c\nOR a\nST y\nAND b\nST z");
    let proof_of_both = proof(text, &right);
    assert!(
        proof_of_both.answers.iter().all(|answer| matches!(answer.outcome, Outcome::Proved { .. })),
        "{proof_of_both:#?}"
    );
    // One scan late: the second output is computed of what the first one was.
    let late = program("a, b, c", "y, z", "", "LD y\nAND b\nST z\nLD y\nANDN c\nOR a\nST y");
    let late = proof(text, &late);
    assert!(matches!(late.answers[0].outcome, Outcome::Proved { .. }));
    assert!(matches!(&late.answers[1].outcome, Outcome::Refuted(scans) if scans.len() == 1));
}

/// An output that others use is what is specified of it, also where the program makes something else of it.
#[test]
fn wrong_outputs_are_used_as_they_are_specified() {
    let text = "function F { interface { input a; output y; } formal { y = a; } }
                function G { interface { input b; input y; output z; } formal { z = y & b; } }";
    let told = |body: &str| -> Vec<String> {
        let proof = proof(text, &program("a, b, c", "y, z", "", body));
        let values = |scan: &Scan| scan.given.inputs.iter().map(|(_, value)| value.to_string()).collect::<String>();
        let told = proof.answers.iter().map(|answer| match &answer.outcome {
            Outcome::Refuted(scans) => scans.iter().map(values).collect::<Vec<_>>().join(" "),
            Outcome::Proved { confirmed, .. } => format!("{confirmed:?}"),
            Outcome::Unknown(reason) => reason.clone(),
        });
        told.collect()
    };
    // z is y & b of what y is, and of what y should be.
    assert_eq!(told("LD a\nAND c\nST y\nAND b\nST z"), ["100", "110"]);
    assert_eq!(told("LD a\nAND c\nST y\nLD a\nAND b\nST z"), ["100", "Some(EveryScan { states: 1, scans: 8 })"],);
}

/// Of the other functions' outputs, a function that is proved alone needs those that are delayed and that it uses.
#[test]
fn functions_are_proved_alone() {
    let alone = |delay: &str, second: &str, outputs: &str, body: &str| -> Vec<Verdict> {
        let first = format!("function F {{ interface {{ input a; output y{delay}; }} formal {{ y = a; }} }}\n");
        let (specification, program) = (specification(&(first + second)), program("a, b, c", outputs, "", body));
        let subject =
            Subject::new(&specification, &program, Tolerated::default(), &[1]).unwrap_or_else(|e| panic!("{e:#?}"));
        prove(&subject, &Options::default()).answers.iter().map(|answer| answer.outcome.verdict()).collect()
    };
    let (delay, holds) = (" delayed T#1s", [Verdict::Holds]);
    let uses = "function G { interface { input b; input y; output z; } formal { z = y & b; } }";
    // y is what the program makes of it, later than `a`; without delay it is `a`, whatever the program has.
    assert_eq!(alone(delay, uses, "y, z", "LD a\nAND c\nST y\nAND b\nST z"), holds);
    assert_eq!(alone(delay, uses, "y, z", "LD a\nAND c\nST y\nLD a\nAND b\nST z"), [Verdict::Violated]);
    assert_eq!(alone("", uses, "z", "LD a\nAND b\nST z"), holds);
    // Where the program puts y on, a and b are.
    let restricted =
        "function G { interface { input a; input y; output z; } formal { z = a; restriction R: always y; } }";
    assert_eq!(alone(delay, restricted, "y, z", "LD a\nAND b\nST y\nST z"), holds);
    assert_eq!(alone("", restricted, "z", "LD a\nST z"), holds);
    // What it does not use need not be there.
    let other = "function G { interface { input b; output z; } formal { z = b; } }";
    assert_eq!(alone(delay, other, "z", "LD b\nST z"), holds);
}

#[test]
fn proofs_say_what_they_assume() {
    let text = "function F { interface { input a; output y delayed T#1s; } formal { y = a; } }
                function G { interface { input b; input y; output z; } formal { z = y & b; } }";
    let unnamed =
        "function F { interface { input a; input b; output y delayed T#1s; output z; } formal { y = a; z = b; } }";
    let right = "LD a\nAND c\nST y\nAND b\nST z\n";
    let told = |text: &str, more: &str, body: &str, tolerated: Tolerated| {
        proof_with(text, &program("a, b, c", "y, z", more, &format!("{right}{body}")), tolerated, &Options::default())
            .assumptions
    };
    let free = "inputs that no formula names have any value: `c`";
    let delayed = "where a formula names a delayed output, it has the value of the program: `y`";
    let (wrap, zero) = ("numbers that do not fit their type wrap around", "a division by zero gives 0");
    let fail = "of scans that fail, and of what comes after them, nothing is claimed";
    let number = "VAR n : INT; END_VAR";
    let all = Tolerated { overflow: true, division_by_zero: true };
    assert_eq!(told(text, "", "", all), [free, delayed]);
    assert_eq!(told(unnamed, "", "", all), [free]);
    assert_eq!(told(text, number, "LD n\nADD 1\nST n", all), [free, delayed, wrap]);
    assert_eq!(told(text, number, "LD 6\nDIV n\nST n", all), [free, delayed, wrap, zero]);
    let none = Tolerated { overflow: false, division_by_zero: false };
    assert_eq!(told(text, number, "LD 6\nDIV n\nST n", none), [free, delayed, fail]);
    let timer = "VAR t : TON; d, e : TIME := T#100ms; END_VAR";
    let clock = "a scan begins every 20 ms; during a scan the clock stands still";
    let preset = "a timer's preset time does not grow while the timer runs and is not called";
    assert_eq!(told(text, timer, "CAL t(IN := a, PT := d)", none), [free, delayed, clock]);
    let computed =
        told(text, timer, "LD T#300ms\nSUB e\nST d\nCAL t(IN := a, PT := d)", Tolerated { overflow: true, ..none });
    assert_eq!(computed, [free, delayed, wrap, clock, preset]);
    let latched = "function F { interface { input a; input c; output y latched until c; } formal { y = a; restriction R: never b; } }
                   function G { interface { input b; input y; output z; } formal { z = y & b; restriction S: never (a & c); } }";
    let scopes = ["in every scan for function F, R: never b", "in every scan for function G, S: never (a & c)"];
    assert_eq!(told(latched, "", "", all), [scopes[0], scopes[1], "before the first scan, nothing is latched"]);
}

/// What is proved of one output where a restriction is kept says nothing about runs that do not keep it.
#[test]
fn proofs_are_used_only_where_they_hold() {
    let text = "function F { interface { input a; input b; output y; } formal { y = a; restriction S: never b; } }
                function G { interface { input c; output z; } formal { z = c; } }";
    // `m` says that `y` was not `a`, which only a scan with b does; then `z` is wrong in the next one.
    let late = program("a, b, c", "y, z", "VAR m : BOOL; END_VAR", "LD c\nXOR m\nST z\nLD a\nOR b\nST y\nXOR a\nST m");
    let told = proof_with(text, &late, Tolerated::default(), &Options { tries: 0, ..Options::default() });
    assert!(matches!(told.answers[0].outcome, Outcome::Proved { .. }), "{told:#?}");
    assert!(matches!(&told.answers[1].outcome, Outcome::Refuted(scans) if scans.len() == 2), "{told:#?}");
}

#[test]
fn what_is_delayed_never_comes_alone() {
    let text = function(" delayed T#1s", "y = a & b;");
    let timer = "LD a\nAND b\nST t.IN\nLD T#1s\nST t.PT\nCAL t\nLD t.Q\nST y";
    let proof_of_timer = proof(&text, &program("a, b, c", "y", "VAR t : TON; END_VAR", timer));
    assert_eq!(proof_of_timer.answers[0].claim.form, Form::NotWithout);
    proved(&proof_of_timer);
    assert!(proof_of_timer.remarks.iter().any(|remark| remark.contains("is not proved")));
    assert!(proof_of_timer.assumptions.iter().any(|assumed| assumed.contains("20 ms")));
    // Off late instead of on late: it is still on a scan after.
    let off = program("a, b, c", "y", "VAR t : TOF; END_VAR", timer);
    assert_eq!(refuted(&proof(&text, &off)), ["110", "000"]);
}

#[test]
fn errors_are_told() {
    let text = function("", "y = a & b;");
    let more = "VAR n : INT; END_VAR";
    // The sum of scans overflows after 32767 scans with a, which no run of a few scans shows.
    let counting = program("a, b, c", "y", more, "LD a\nJMPCN on\nLD n\nADD 1\nST n\non: LD a\nAND b\nST y");
    let few = Options { tries: 5000, ..Options::default() };
    let told = proof_with(&text, &counting, Tolerated::default(), &few);
    assert!(matches!(told.answers[0].outcome, Outcome::Proved { .. }));
    assert!(told.failures.is_empty() && told.unknown_failures.len() == 1, "{told:#?}");
    let nothing_of_failures = "of scans that fail, and of what comes after them, nothing is claimed";
    assert!(told.assumptions.iter().any(|assumed| assumed == nothing_of_failures), "{told:#?}");
    assert_eq!(told.verdict(), Verdict::Unknown);
    let wrapping = Tolerated { overflow: true, division_by_zero: false };
    let told = proof_with(&text, &counting, wrapping, &few);
    assert!(told.unknown_failures.is_empty() && !told.assumptions.iter().any(|it| it == nothing_of_failures));
    assert_eq!(told.verdict(), Verdict::Holds);
    // A division by the number of inputs that are TRUE.
    let dividing = "LD a\nBOOL_TO_INT\nST n\nLD b\nBOOL_TO_INT\nADD n\nST n\nLD 6\nDIV n\nGT 5\nNOT\nST y";
    let told = proof(&text, &program("a, b, c", "y", more, dividing));
    let (failure, scans) = &told.failures[0];
    assert!(matches!(failure, Failure::Hazard(_, Hazard::DivisionByZero)));
    assert!(told.assumptions.iter().any(|assumed| assumed == nothing_of_failures), "{told:#?}");
    assert_eq!(told.verdict(), Verdict::Violated);
    assert_eq!(scans.len(), 1);
    assert_eq!(scans[0].given.inputs.iter().map(|(_, value)| *value).collect::<Vec<_>>(), [0, 0, 0]);
    // 6 / 1 > 5, 6 / 2 is not: but for that error it is proved.
    assert!(matches!(told.answers[0].outcome, Outcome::Proved { .. }), "{told:#?}");
    let restricted = text.replace("function F", "restriction R: at least one of a, b;\nfunction F");
    proved(&proof(&restricted, &program("a, b, c", "y", more, dividing)));
}

#[test]
fn code_with_jumps_blocks_and_numbers_is_proved() {
    let text = function("", "y = (a & b) | (b & c) | (a & c);");
    let jumps = "LD a\nJMPC one\nLD b\nAND c\nST y\nRET\none: LD b\nJMPC two\nLD c\nST y\nRET\ntwo: LD TRUE\nST y";
    proved(&proof(&text, &program("a, b, c", "y", "", jumps)));
    let sum =
        "LD a\nBOOL_TO_INT\nST n\nLD b\nBOOL_TO_INT\nADD n\nST n\nLD c\nBOOL_TO_INT\nADD n\nMUL 3\nDIV 2\nGE 3\nST y";
    proved(&proof(&text, &program("a, b, c", "y", "VAR n : INT; END_VAR", sum)));
    let off_by_one = sum.replace("GE 3", "GE 4");
    assert_eq!(refuted(&proof(&text, &program("a, b, c", "y", "VAR n : INT; END_VAR", &off_by_one))).len(), 1);
    // Edges are FALSE a scan later.
    let edge = program("a, b, c", "y", "VAR r : R_TRIG; END_VAR", "LD a\nST r.CLK\nCAL r\nLD r.Q\nST y");
    assert_eq!(refuted(&proof(&function("", "y = a;"), &edge)), ["100", "100"]);
}

/// A loop has no gates; the interpreter tries everything.
#[test]
fn loops_are_explored() {
    let text = function("", "y = a & b & c;");
    let head = "VAR n : INT; k : ARRAY [0..2] OF BOOL; END_VAR";
    let body = "LD a\nST k[0]\nLD b\nST k[1]\nLD c\nST k[2]\nLD 0\nST n\nLD TRUE\nST y\n\
                next: LD k[n]\nNOT\nR y\nLD n\nADD 1\nST n\nLT 3\nJMPC next";
    assert_eq!(proved(&proof(&text, &program("a, b, c", "y", head, body))), (By::EveryScan, None));
    let two = body.replace("LT 3", "LT 2");
    assert_eq!(refuted(&proof(&text, &program("a, b, c", "y", head, &two))), ["110"]);
    // A scan that never ends.
    let endless = "stay: LD a\nAND b\nJMPC stay\nLD FALSE\nST y";
    let told = proof(&text, &program("a, b, c", "y", "", endless));
    assert_eq!(told.failures.iter().map(|(failure, _)| *failure).collect::<Vec<_>>(), [Failure::Endless]);
}

#[test]
fn names_are_variables_and_addresses() {
    let text = "function F { interface { input door is Gate.Closed; input beam at %ix0.1; output y at %QX1.0; }
                formal { y = beam & !door; } }";
    let with = |inputs: &str, body: &str| {
        support::program(&format!(
            "TYPE G : STRUCT Closed : BOOL; END_STRUCT; END_TYPE PROGRAM p VAR_INPUT Gate : G; {inputs} END_VAR\n{body}\nEND_PROGRAM"
        ))
    };
    proved(&proof(text, &with("BEAM_ON AT %I0.1 : BOOL;", "LD BEAM_ON\nANDN Gate.Closed\nST %Q1.0")));
    let codes = |text: &str, program: &FlatProgram| -> Vec<Code> {
        let specification = specification(text);
        let errors = Subject::new(&specification, program, Tolerated::default(), &[]).unwrap_err();
        errors.iter().map(|(_, diagnostic)| diagnostic.code).collect()
    };
    let unknown = with("BEAM_ON : BOOL;", "LD BEAM_ON\nANDN Gate.Closed\nST %Q1.1");
    assert_eq!(codes(text, &unknown), [Code::SifVariableUnknown; 2]);
    let text = function("", "y = a & b;");
    let unfit = support::program(
        "PROGRAM p VAR_INPUT a : INT; y : BOOL; END_VAR VAR b : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR\n\
         LD a\nGT 0\nAND y\nAND b\nST q\nST b\nEND_PROGRAM",
    );
    assert_eq!(codes(&text, &unfit), [Code::SifVariableUnfit; 3]);
    let shared = text.replace("input b;", "input b is A;");
    assert_eq!(codes(&shared, &program("a, b, c", "y", "", "LD a\nST y")), [Code::SifVariableShared]);
    // An input that only a restriction names may miss, unless it is said what it stands for.
    assert_eq!(codes(&text, &program("a, c", "y", "", "LD a\nST y")), [Code::SifVariableUnknown]);
    let restricted = format!("input e is Nowhere; restriction R: never e; {text}");
    let right = program("a, b, c", "y", "", "LD a\nAND b\nST y");
    assert_eq!(codes(&restricted, &right), [Code::SifVariableUnknown]);
    proved(&proof(&restricted.replace(" is Nowhere", ""), &right));
    // A delayed output that only a restriction names may not.
    let delayed = "function F { interface { input a; output y delayed T#1s; } formal { y = a; } }
                   function G { interface { input a; input y; output z; } formal { z = a; restriction R: always y; } }";
    let delayed = specification(delayed);
    let without = program("a", "z", "", "LD a\nST z");
    let errors = Subject::new(&delayed, &without, Tolerated::default(), &[1]).unwrap_err();
    assert_eq!(errors.iter().map(|(_, told)| told.code).collect::<Vec<_>>(), [Code::SifVariableUnknown]);
    let cycle = function(" latched until y", "y = a & b;");
    assert_eq!(codes(&cycle, &program("a, b, c", "y", "", "LD a\nST y")), [Code::SifCycle]);
}

/// What the program does not have is as restrictions need it; what the specification does not name has any value.
#[test]
fn what_only_one_of_both_has_is_free() {
    let text = "restriction R: always a -> elsewhere; restriction S: always elsewhere -> b; input elsewhere;"
        .to_owned()
        + &function("", "y = a & b;");
    let proof_of_load = proof(&text, &program("a, b, c, d", "y, other", "", "LD a\nST y\nLD d\nST other"));
    assert_eq!(proved(&proof_of_load).0, By::AnyState);
    assert!(proof_of_load.assumptions.iter().any(|assumed| assumed.contains("`elsewhere`")));
    assert!(proof_of_load.assumptions.iter().any(|assumed| assumed.contains("`c`, `d`")), "{proof_of_load:#?}");
    assert!(proof_of_load.remarks.iter().any(|remark| remark.contains("`other`")));
    let free = proof(&function("", "y = a & b;"), &program("a, b, c, d", "y", "", "LD a\nAND b\nANDN d\nST y"));
    assert_eq!(refuted(&free), ["1101"]);
}

/// Inputs with few values have only these; at rest, a subrange has the least.
#[test]
fn inputs_keep_their_ranges() {
    let text = function("", "y = a & b;");
    let head = "TYPE M : (Off, Slow, Fast); END_TYPE PROGRAM p VAR_INPUT a, b, c : BOOL; level : INT (-3..5); mode : M; END_VAR \
                VAR_OUTPUT y : BOOL; END_VAR\n";
    let with = |body: &str| support::program(&format!("{head}{body}\nAND a\nAND b\nST y\nEND_PROGRAM"));
    proved(&proof(&text, &with("LD level\nLE 5")));
    proved(&proof(&text, &with("LD level\nGE -3")));
    proved(&proof(&text, &with("LD mode\nEQ Slow\nOR(\nLD mode\nEQ Fast\n)\nOR(\nLD mode\nEQ Off\n)")));
    let counterexample = |body: &str| {
        let proof = proof(&text, &with(body));
        let Outcome::Refuted(scans) = &proof.answers[0].outcome else { panic!("{proof:#?}") };
        scans[0].given.inputs.iter().map(|(_, value)| *value).collect::<Vec<_>>()
    };
    assert_eq!(counterexample("LD level\nLT 5"), [1, 1, 0, 5, 0]);
    assert_eq!(counterexample("LD level\nGT -3"), [1, 1, 0, 0xFFFD, 0]);
    assert_eq!(counterexample("LD mode\nNE Fast"), [1, 1, 0, 0xFFFD, 2]);
}

/// Each output of a large system, and one of them wrong.
#[test]
fn a_large_system_is_proved() {
    let made = support::sif_system::made(support::sif_system::LARGE, 1);
    let right = proof(&made.specification, &support::program(&made.program));
    assert_eq!(right.answers.len(), 200);
    for answer in &right.answers {
        let by_diagrams = Outcome::Proved { by: By::AnyState, confirmed: Some(Confirmed::Diagrams) };
        assert_eq!(answer.outcome, by_diagrams, "{:?}", answer.claim);
    }
    let specification = specification(&made.specification);
    let name = specification.name(right.answers[77].claim.signal);
    let wrong = made.program.replace(&format!("ST       {name}\n"), &format!("STN      {name}\n"));
    let wrong = proof(&made.specification, &support::program(&wrong));
    let refuted: Vec<usize> = (0..200).filter(|&at| matches!(wrong.answers[at].outcome, Outcome::Refuted(_))).collect();
    // And those that read it.
    assert!(refuted.contains(&77) && refuted.len() < 20, "{refuted:?}");
}

//! Tests of safety functions on the interpreter: by hand, and on random specifications and programs against an evaluation of
//! the formula and runs of the machine that are made here.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::diagnostic::{Code, any_error};
use petril::exchange::Provenance;
use petril::exchange::sif::{Ran, Sheets, plan_csv, reasons};
use petril::flat::{FlatProgram, Tolerated};
use petril::interpret::Machine;
use petril::sif::{
    Coverage, Criterion, Ending, Fate, Formula, Operator, Plan, PlanRun, Runner, SignalId, Specification, Start, Test,
    hunt, mutants,
};
use petril::source::Source;
use proptest::prelude::*;
use support::program;

const F1: &str = include_str!("../../examples/beam-interlock.sif");
const PROGRAM: &str = include_str!("../../examples/beam-interlock.il");
const BROKEN: &str = include_str!("../../examples/beam-interlock-broken.il");

fn read(text: &str) -> Specification {
    let (specification, diagnostics) = Specification::read(&[Source::new("test.sif", text)]);
    assert!(!diagnostics.iter().any(|list| any_error(list)), "{diagnostics:?}");
    specification.unwrap()
}

fn signal(specification: &Specification, name: &str) -> SignalId {
    SignalId(specification.signals.iter().position(|signal| signal.name == name).unwrap())
}

/// A plan for a function: each test names the inputs that are TRUE; everything else is FALSE.
fn plan(specification: &Specification, function: usize, tests: &[&[&str]]) -> Plan {
    let test = |ones: &&[&str]| {
        let ones = specification.valuation(ones.iter().map(|name| signal(specification, name)));
        Test { values: specification.settled(&ones), purpose: Vec::new() }
    };
    Plan {
        function,
        criterion: Criterion::All,
        varied: specification.inputs().collect(),
        touched: specification.outputs().collect(),
        tests: tests.iter().map(test).collect(),
        incomplete: None,
        notes: Vec::new(),
        is_smallest: false,
        cubes: Vec::new(),
        coverage: Coverage::default(),
    }
}

/// All valuations of all inputs that the restrictions allow.
fn every(specification: &Specification, is_kept: impl Fn(&Test) -> bool) -> Plan {
    let inputs: Vec<SignalId> = specification.inputs().collect();
    let mut all = plan(specification, 0, &[]);
    for number in 0..1_u32 << inputs.len() {
        let ones = inputs.iter().enumerate().filter(|(bit, _)| number >> bit & 1 == 1).map(|(_, input)| *input);
        let values = specification.settled(&specification.valuation(ones));
        let can_be = |r: &petril::sif::Restriction| r.allowed.holds(|signal| values.contains(signal.0));
        let test = Test { values: values.clone(), purpose: Vec::new() };
        if specification.restrictions.iter().all(can_be) && is_kept(&test) {
            all.tests.push(test);
        }
    }
    all
}

fn run(specification: &Specification, program: &FlatProgram, start: Start, plan: &Plan) -> PlanRun {
    let plans = std::slice::from_ref(plan);
    let runner = Runner::new(specification, program, Tolerated::default(), start, plans).unwrap();
    runner.run(plans).remove(0)
}

fn words(run: &PlanRun) -> Vec<&'static str> {
    run.tests.iter().map(|test| test.ending.word()).collect()
}

#[test]
fn the_papers_ten_tests_do_not_find_the_fault_that_other_tests_find() {
    let specification = read(F1);
    let f1 = specification.functions[0].outputs[0];
    let (right, broken) = (program(PROGRAM), program(BROKEN));
    let ten = every(&specification, |test| test.values.contains(f1.0));
    assert_eq!(ten.tests.len(), 10);
    let both = every(&specification, |_| true);
    for plan in [&ten, &both] {
        assert!(words(&run(&specification, &right, Start::PowerOn, plan)).iter().all(|word| *word == "passed"));
    }
    assert!(words(&run(&specification, &broken, Start::PowerOn, &ten)).iter().all(|word| *word == "passed"));
    // The program sets F1 with MODE_Tra whatever the beam element says. The formula does not where it is in its safe position and the
    // access elements are safe: by R2 and R3 that leaves one valuation.
    let found = run(&specification, &broken, Start::PowerOn, &both);
    let failed: Vec<&Test> = both
        .tests
        .iter()
        .zip(&found.tests)
        .filter(|(_, made)| made.ending.word() == "failed")
        .map(|(t, _)| t)
        .collect();
    let names = ["MODE_Tra", "EISb_Pos", "EISa_Safe"].map(|name| signal(&specification, name));
    assert_eq!(failed.len(), 1);
    assert_eq!(failed[0].values, specification.valuation(names));
}

const MEMORY: &str = "
    function F {
        interface {
            input door; input reset; input heat;
            output stop latched until reset;
            output warn delayed T#100ms;
            output both;
        }
        formal { stop = door; warn = heat; both = stop & warn; }
    }";

/// A right program of it, with a preset time.
fn memory(time: &str) -> FlatProgram {
    program(&format!(
        "PROGRAM p\nVAR_INPUT door, reset, heat : BOOL; END_VAR\nVAR_OUTPUT stop, warn, both : BOOL; END_VAR\n\
         VAR t : TON; END_VAR\nLD reset\nR stop\nLD door\nS stop\nCAL t(IN := heat, PT := {time})\nLD t.Q\nST warn\n\
         LD stop\nAND warn\nST both\nEND_PROGRAM\n"
    ))
}

#[test]
fn what_comes_late_is_waited_for_and_must_not_come_early() {
    let specification = read(MEMORY);
    let plan = plan(&specification, 0, &[&["heat"], &["heat", "door"], &[]]);
    let made = run(&specification, &memory("T#100ms"), Start::PowerOn, &plan);
    assert_eq!(words(&made), ["passed", "passed", "passed"]);
    // At 20 ms a scan, 100 ms have passed in the sixth.
    assert!(made.tests.iter().all(|test| test.scans == 6), "{made:?}");
    let late = run(&specification, &memory("T#120ms"), Start::PowerOn, &plan);
    assert_eq!(words(&late), ["failed", "failed", "passed"]);
    let early = run(&specification, &memory("T#80ms"), Start::PowerOn, &plan);
    assert_eq!(words(&early), ["failed", "failed", "passed"]);
    let Ending::Failed(deviations) = &early.tests[0].ending else { panic!() };
    assert_eq!(deviations.len(), 1);
    assert_eq!((deviations[0].early, deviations[0].scan, deviations[0].expected), (true, 5, false));
}

#[test]
fn latches_remember_if_tests_are_run_one_after_another() {
    let specification = read(MEMORY);
    let [stop, both] = ["stop", "both"].map(|name| signal(&specification, name));
    let plan = plan(&specification, 0, &[&["door"], &[], &["heat"], &["reset"], &[]]);
    let program = memory("T#100ms");
    assert!(words(&run(&specification, &program, Start::PowerOn, &plan)).iter().all(|word| *word == "passed"));
    let made = run(&specification, &program, Start::Continued, &plan);
    assert!(words(&made).iter().all(|word| *word == "passed"), "{made:?}");
    let remembered: Vec<&[SignalId]> = made.tests.iter().map(|test| test.remembered.as_slice()).collect();
    assert_eq!(remembered, [&[][..], &[stop], &[stop, both], &[], &[]]);
    assert!(made.tests[2].outputs.contains(both.0));

    // A program that forgets is found only so.
    let forgets = support::program(
        "PROGRAM p\nVAR_INPUT door, reset, heat : BOOL; END_VAR\nVAR_OUTPUT stop, warn, both : BOOL; END_VAR\n\
         VAR t : TON; END_VAR\nLD door\nST stop\nCAL t(IN := heat, PT := T#100ms)\nLD t.Q\nST warn\nLD stop\nAND warn\n\
         ST both\nEND_PROGRAM\n",
    );
    assert!(words(&run(&specification, &forgets, Start::PowerOn, &plan)).iter().all(|word| *word == "passed"));
    let made = run(&specification, &forgets, Start::Continued, &plan);
    assert_eq!(words(&made), ["passed", "failed", "failed", "passed", "passed"]);
}

#[test]
fn errors_of_the_program_are_told_with_their_line() {
    let specification = read("function F { interface { input a; input b; output q; } formal { q = a & b; } }");
    let text = "PROGRAM p\nVAR_INPUT a, b : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\nVAR n : INT; END_VAR\n\
                LD a\nANDN b\nJMPC bad\nJMP on\nbad: LD 1\nDIV 0\nST n\non: LD b\nANDN a\nloop: JMPC loop\nLD a\nAND b\nST q\nEND_PROGRAM\n";
    let program = program(text);
    let plan = plan(&specification, 0, &[&[], &["a"], &["b"], &["a", "b"]]);
    let plans = [plan];
    let runner = Runner::new(&specification, &program, Tolerated::default(), Start::Continued, &plans).unwrap();
    let results = runner.run(&plans);
    assert_eq!(words(&results[0]), ["passed", "error", "error", "passed"]);
    let source = Source::new("p.il", text);
    let ran = Ran { runner: &runner, source: &source, results: &results, hunt: None };
    let sheets = Sheets {
        specification: &specification,
        sources: &[],
        plans: &plans,
        origin: None,
        excluded: &[],
        run: Some(ran),
        provenance: &Provenance::default(),
    };
    let told: Vec<String> = results[0].tests.iter().flat_map(|test| reasons(&sheets, &ran, test)).collect();
    assert_eq!(told, ["in scan 1, a number is divided by 0 (p.il:10: DIV 0)", "scan 1 never ends: it repeats a state"]);
}

#[test]
fn signals_are_bound_or_it_is_said_why_not() {
    let text = "function F {
        interface { input a is X; input b at %IX0.1; input c; output q is Out; output r; output s; }
        formal { q = a & b; r = a & c; s = b | c; }
    }";
    let specification = read(text);
    let plan = plan(&specification, 0, &[&["a", "b"]]);
    let plans = std::slice::from_ref(&plan);
    let right = program(
        "PROGRAM p\nVAR_INPUT x : BOOL; C : BOOL; END_VAR\nVAR In2 AT %I0.1 : BOOL; END_VAR\nVAR_OUTPUT out, r, s : BOOL; END_VAR\n\
         LD x\nAND In2\nST out\nLD x\nAND c\nST r\nLD In2\nOR c\nST s\nEND_PROGRAM\n",
    );
    assert_eq!(words(&run(&specification, &right, Start::PowerOn, &plan)), ["passed"]);
    let wrong = program(
        "PROGRAM p\nVAR_INPUT y : BOOL; c : INT; END_VAR\nVAR_OUTPUT q : BOOL; r : BOOL; END_VAR\nVAR_INPUT s : BOOL; END_VAR\n\
         LD y\nST q\nST r\nEND_PROGRAM\n",
    );
    let found = Runner::new(&specification, &wrong, Tolerated::default(), Start::PowerOn, plans).unwrap_err();
    let mut codes: Vec<(Code, &str)> =
        found.iter().map(|(_, diagnostic)| (diagnostic.code, &text[diagnostic.span().range()])).collect();
    codes.sort();
    let (unknown, unfit) = (Code::SifVariableUnknown, Code::SifVariableUnfit);
    assert_eq!(codes, [(unknown, "%IX0.1"), (unknown, "Out"), (unknown, "X"), (unfit, "c"), (unfit, "s")]);
}

#[test]
fn a_plan_is_read_back_as_it_was_written() {
    let specification = read(F1);
    let mut plans = [every(&specification, |_| true)];
    plans[0].tests[3].purpose = vec!["a, \"b\"".to_owned(), "c".to_owned()];
    let sheets = Sheets {
        specification: &specification,
        sources: &[],
        plans: &plans,
        origin: None,
        excluded: &[],
        run: None,
        provenance: &Provenance::default(),
    };
    let text = plan_csv::write(&sheets);
    for text in [text.clone(), text.replace("\"a, \"\"b\"\"; c\"", "x").replace(',', ";")] {
        let read = plan_csv::read(&Source::new("plan.csv", text.as_str()), &specification).unwrap();
        assert_eq!(read.len(), 1);
        let values = |plan: &Plan| plan.tests.iter().map(|test| test.values.clone()).collect::<Vec<_>>();
        assert_eq!(values(&read[0]), values(&plans[0]));
        assert_eq!((&read[0].varied, &read[0].touched), (&plans[0].varied, &plans[0].touched));
    }
    let read = plan_csv::read(&Source::new("plan.csv", text), &specification).unwrap();
    assert_eq!(read[0].tests, plans[0].tests);

    // Somebody expects something else; another one mistypes.
    let changed =
        plan_csv::read(&Source::new("p.csv", "function\tMODE_acc\tF1\nf1\tTRUE\t0\n"), &specification).unwrap();
    assert_eq!(changed[0].tests[0].values, specification.valuation([signal(&specification, "MODE_Acc")]));
    for (text, message) in [
        ("function,MODE_Ac\nF1,1\n", "there is no input or output `MODE_Ac`"),
        ("function,MODE_Acc\nF2,1\n", "there is no function `F2`"),
        ("function,MODE_Acc\nF1,2\n", "`2` is no value of `MODE_Acc`"),
        ("function,MODE_Acc\nF1\n", "this row has 1 values, the first one 2"),
        ("function,MODE_Acc,mode_acc\nF1,1,1\n", "two columns are named `mode_acc`"),
        ("", "this table of tests is empty"),
    ] {
        let errors = plan_csv::read(&Source::new("p.csv", text), &specification).unwrap_err();
        assert_eq!(errors[0].message, message);
    }
}

/// Formulas over four signals.
fn formulas() -> impl Strategy<Value = Formula> {
    let leaf = (0..4_usize).prop_map(|signal| Formula::Signal(SignalId(signal)));
    leaf.prop_recursive(4, 16, 3, |inner| {
        let operators = prop_oneof![Just(Operator::And), Just(Operator::Or), Just(Operator::Xor)];
        prop_oneof![
            inner.clone().prop_map(|formula| Formula::Not(Box::new(formula))),
            (operators, prop::collection::vec(inner, 2..4)).prop_map(|(operator, of)| Formula::Gate(operator, of)),
        ]
    })
}

/// Instructions that leave the value of a formula in a variable, whose number is given.
fn compile(formula: &Formula, body: &mut String, count: &mut usize) -> String {
    let mut kept = |body: &mut String| {
        *count += 1;
        body.push_str(&format!("ST t{count}\n"));
        format!("t{count}")
    };
    match formula {
        Formula::Signal(signal) => format!("i{}", signal.0),
        Formula::Not(inner) => {
            let inner = compile(inner, body, count);
            body.push_str(&format!("LDN {inner}\n"));
            *count += 1;
            body.push_str(&format!("ST t{count}\n"));
            format!("t{count}")
        }
        Formula::Gate(operator, operands) => {
            let operands: Vec<String> = operands.iter().map(|operand| compile(operand, body, count)).collect();
            body.push_str(&format!("LD {}\n", operands[0]));
            let word = match operator {
                Operator::And => "AND",
                Operator::Or => "OR",
                _ => "XOR",
            };
            operands[1..].iter().for_each(|operand| body.push_str(&format!("{word} {operand}\n")));
            *count += 1;
            body.push_str(&format!("ST t{count}\n"));
            format!("t{count}")
        }
        Formula::Constant(_) => {
            body.push_str("LD TRUE\n");
            kept(body)
        }
    }
}

fn program_of(formula: &Formula) -> String {
    let (mut body, mut count) = (String::new(), 0);
    let result = compile(formula, &mut body, &mut count);
    let memory: Vec<String> = (1..=count.max(1)).map(|number| format!("t{number}")).collect();
    format!(
        "PROGRAM p\nVAR_INPUT i0, i1, i2, i3 : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\nVAR {} : BOOL; END_VAR\n{body}LD {result}\nST q\nEND_PROGRAM\n",
        memory.join(", ")
    )
}

/// What the output is after one scan from power-on, by the machine.
fn scanned(program: &FlatProgram, inputs: u32) -> bool {
    let mut machine = Machine::new(program);
    for bit in 0..4 {
        machine.set(program.find(&format!("i{bit}")).unwrap(), u64::from(inputs >> bit & 1));
    }
    machine.scan().unwrap();
    machine.value(program.find("q").unwrap()) == 1
}

proptest! {
    #[test]
    fn verdicts_are_those_of_formula_and_machine(wanted in formulas(), made in formulas()) {
        let text = wanted.text(&|signal| ["i0", "i1", "i2", "i3"][signal.0]);
        let specification = read(&format!(
            "input i0; input i1; input i2; input i3; function F {{ interface {{ output q; }} formal {{ q = {text}; }} }}"
        ));
        let flat = program(&program_of(&made));
        let value = |number: u32| wanted.holds(|signal| number >> signal.0 & 1 == 1);
        let ids = ["i0", "i1", "i2", "i3"].map(|name| signal(&specification, name));
        let mut plan = plan(&specification, 0, &[]);
        for number in 0..16_u32 {
            let ones = ids.iter().enumerate().filter(|(bit, _)| number >> bit & 1 == 1).map(|(_, id)| *id);
            let values = specification.settled(&specification.valuation(ones));
            plan.tests.push(Test { values, purpose: Vec::new() });
        }
        let expected: Vec<&str> = (0..16_u32)
            .map(|number| if scanned(&flat, number) == value(number) { "passed" } else { "failed" })
            .collect();
        prop_assert_eq!(&words(&run(&specification, &flat, Start::PowerOn, &plan)), &expected);
        // Without memory, it makes no difference to go on.
        prop_assert_eq!(&words(&run(&specification, &flat, Start::Continued, &plan)), &expected);
    }

    #[test]
    fn a_fault_is_found_if_a_test_shows_it(wanted in formulas(), chosen in prop::collection::vec(0..16_u32, 0..6)) {
        let text = wanted.text(&|signal| ["i0", "i1", "i2", "i3"][signal.0]);
        let specification = read(&format!(
            "input i0; input i1; input i2; input i3; function F {{ interface {{ output q; }} formal {{ q = {text}; }} }}"
        ));
        let source = Source::new("p.il", program_of(&wanted));
        let flat = program(source.text());
        let ids = ["i0", "i1", "i2", "i3"].map(|name| signal(&specification, name));
        let mut plan = plan(&specification, 0, &[]);
        for &number in &chosen {
            let ones = ids.iter().enumerate().filter(|(bit, _)| number >> bit & 1 == 1).map(|(_, id)| *id);
            plan.tests.push(Test { values: specification.settled(&specification.valuation(ones)), purpose: Vec::new() });
        }
        let plans = [plan];
        let runner = Runner::new(&specification, &flat, Tolerated::default(), Start::PowerOn, &plans).unwrap();
        let all = mutants(&flat, &source);
        prop_assert!(!all.is_empty());
        let value = |number: u32| wanted.holds(|signal| number >> signal.0 & 1 == 1);
        for (mutant, fate) in hunt(&runner, &plans, all, &|_| Fate::Missed, &|| false).mutants {
            let other = mutant.of(&flat);
            let changed = (0..flat.code.len()).filter(|&line| other.code[line].instruction != flat.code[line].instruction);
            prop_assert_eq!(changed.collect::<Vec<_>>(), [mutant.line]);
            let first = chosen.iter().position(|&number| scanned(&other, number) != value(number));
            prop_assert_eq!(fate, first.map_or(Fate::Missed, |test| Fate::Found(0, test)), "{}", mutant.fault);
        }
    }
}

//! Two roads from a specification and a program to a verdict: the proof by gates and solver, and `petril check`'s exploration of
//! the requirements that the specification becomes. They share the reading of both texts and nothing behind that.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::explore::Budget;
use petril::flat::{FlatProgram, Tolerated, flatten};
use petril::logic::{View, bind_assumption, bind_requirement, parse_requirements};
use petril::sif::Specification;
use petril::sif::proof::{Options, Subject, prove};
use petril::source::Source;
use petril::translate::{Plant, System};
use petril::verdict::{self, Verdict};
use petril::{semantics, syntax};
use sif_system::{Size, made};
use support::sif_system;

fn program(text: &str) -> FlatProgram {
    let (unit, _) = syntax::parse(&Source::new("site.il", text));
    let (program, diagnostics) = semantics::check(&unit, true);
    flatten(&program.unwrap_or_else(|| panic!("{text}\n{diagnostics:?}")))
}

/// The verdict on each output, by the proof.
fn proved(specification: &Specification, program: &FlatProgram) -> Vec<(String, Verdict)> {
    let subject = Subject::new(specification, program, Tolerated::default(), &[]).unwrap();
    let proof = prove(&subject, &Options::default());
    let verdicts = proof
        .answers
        .iter()
        .map(|answer| (specification.name(answer.claim.signal).to_owned(), answer.outcome.verdict()));
    verdicts.collect()
}

/// The same by exploration.
fn explored(specification: &Specification, program: FlatProgram) -> Vec<(String, Verdict)> {
    let text = petril::sif::requirements(specification);
    let (file, diagnostics) = parse_requirements(&Source::new("site.req", text.as_str()));
    assert!(diagnostics.is_empty(), "{text}\n{diagnostics:?}");
    let system = System::new(program, Plant::default());
    let bind = |requirement: &petril::logic::Requirement| bind_requirement(requirement, &system, View::Scan).unwrap();
    let requirements: Vec<_> = file.requirements.iter().map(|one| (one.clone(), bind(one))).collect();
    let assumptions = file.assumptions.iter().map(|one| bind_assumption(one, &system, View::Scan).unwrap()).collect();
    let options = verdict::Options { assumptions, budget: Budget::default(), ..verdict::Options::default() };
    let report = verdict::check(&system, &requirements, &options, &mut |_| None);
    let answers = report.answers.iter().filter(|answer| requirements.iter().any(|(one, _)| one.name == answer.name));
    answers.map(|answer| (answer.name.clone(), answer.outcome.verdict())).collect()
}

/// The program with another operator in one of its lines, or without one: number by number, what people get wrong.
fn mutant(program: &str, number: usize) -> String {
    let is_instruction = |line: &&str| line.starts_with("        ") && !line.contains(':');
    let lines: Vec<&str> = program.lines().collect();
    let changeable: Vec<usize> = (0..lines.len())
        .filter(|at| is_instruction(&lines[*at]) && !lines[*at].contains("ST ") && !lines[*at].contains(')'))
        .collect();
    let at = changeable[number * 7 % changeable.len()];
    let words: Vec<&str> = lines[at].split_whitespace().collect();
    let swapped = match words[0] {
        "LD" => "LDN",
        "LDN" => "LD",
        "AND" | "ORN" => "OR",
        "ANDN" | "OR" => "AND",
        "AND(" => "OR(",
        _ => "AND(",
    };
    let changed = format!("        {swapped} {}", words[1..].join(" "));
    let text: Vec<&str> =
        (0..lines.len()).map(|line| if line == at { changed.as_str() } else { lines[line] }).collect();
    text.join("\n")
}

#[test]
fn proof_and_exploration_agree() {
    let (mut holding, mut violated) = (0, 0);
    for seed in 0..12 {
        let made = made(Size { inputs: 7, zones: 1, functions: 4 }, seed);
        let (specification, diagnostics) = Specification::read(&[Source::new("site.sif", made.specification.as_str())]);
        let specification = specification.unwrap_or_else(|| panic!("{diagnostics:?}"));
        for number in 0..5 {
            let text = if number == 0 { made.program.clone() } else { mutant(&made.program, number + seed as usize) };
            let by_proof = proved(&specification, &program(&text));
            assert_eq!(by_proof.len(), 4);
            let by_exploration = explored(&specification, program(&text));
            // A requirement names other outputs as the program has them, a proof as they are specified.
            let alone = |(name, _): &&(String, Verdict)| {
                let signal = specification.outputs().find(|output| specification.name(*output) == name).unwrap();
                let formula = specification.definition(signal).unwrap();
                formula.signals().into_iter().all(|used| specification.definition(used).is_none())
            };
            let all_hold = |list: &[(String, Verdict)]| list.iter().all(|(_, verdict)| *verdict == Verdict::Holds);
            assert_eq!(all_hold(&by_proof), all_hold(&by_exploration), "{}\n{text}", made.specification);
            let (one, other) = (by_proof.iter().filter(alone), by_exploration.iter().filter(alone));
            assert!(one.eq(other), "{by_proof:?} {by_exploration:?}\n{}\n{text}", made.specification);
            holding += by_proof.iter().filter(|(_, verdict)| *verdict == Verdict::Holds).count();
            violated += by_proof.iter().filter(|(_, verdict)| *verdict == Verdict::Violated).count();
            if number == 0 {
                assert!(by_proof.iter().all(|(_, verdict)| *verdict == Verdict::Holds));
            }
        }
    }
    // 48 programs have one wrong line, some of which make no difference.
    assert!(holding > 150 && violated > 30, "{holding} hold, {violated} are violated");
}

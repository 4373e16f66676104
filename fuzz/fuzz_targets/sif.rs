//! Any bytes as a specification of safety functions: reading comes to an end, without a panic. Diagnostics lie in the text, and
//! there is a specification exactly if none of them is an error. Its formulas can be printed and read again, and the solver,
//! the decision diagrams and plain evaluation agree about small functions.
#![no_main]

use libfuzzer_sys::fuzz_target;
use petril::diagnostic::{Style, any_error, render};
use petril::sif::{Answer, Cone, Diagrams, Solver, Specification, requirements};
use petril::source::Source;

fuzz_target!(|bytes: &[u8]| {
    let Ok(source) = Source::decode("fuzz", bytes) else { return };
    let (specification, diagnostics) = Specification::read(std::slice::from_ref(&source));
    let diagnostics = &diagnostics[0];
    for diagnostic in diagnostics.iter().take(100) {
        for label in &diagnostic.labels {
            assert!(source.text().get(label.span.range()).is_some(), "{diagnostic:?}");
        }
        assert!(!render(diagnostic, &source, Style::default()).is_empty() && !diagnostic.message.is_empty());
    }
    assert_eq!(specification.is_none(), any_error(diagnostics), "{diagnostics:?}");
    let Some(specification) = specification else { return };
    let _ = requirements(&specification);
    (0..specification.functions.len().min(4)).for_each(|function| engines_agree(&specification, function));
});

/// Whether an output can be TRUE, as the solver and the diagrams say.
fn engines_agree(specification: &Specification, function: usize) {
    let cone = Cone::of_function(specification, function);
    let inputs: Vec<_> = cone.all_inputs().collect();
    if inputs.len() > 10 {
        return;
    }
    let mut solver = Solver::default();
    let encoded = cone.encode(&mut solver);
    let diagrams = Diagrams::over(inputs, specification.signals.len(), 10_000).expect("they are few");
    let mut sets = vec![None; specification.signals.len()];
    for &signal in &cone.definitions {
        let value = |of: petril::sif::SignalId| diagrams.signal(of).or_else(|| sets[of.0].clone());
        sets[signal.0] = specification.definition(signal).and_then(|formula| diagrams.formula(formula, &value));
    }
    for &output in &specification.functions[function].outputs {
        let Some(set) = &sets[output.0] else { continue };
        let literal = encoded.literals[output.0];
        assert_eq!(solver.solve(&[literal]) == Answer::Satisfiable, !set.is_empty());
        if !set.is_empty() {
            let settled = specification.settled(&encoded.model(&cone, &solver));
            assert!(settled.contains(output.0));
        }
    }
}

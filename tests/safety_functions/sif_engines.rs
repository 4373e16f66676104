//! Solver, decision diagrams and plain evaluation agree on specifications, and on the seed paper's numbers.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use fixedbitset::FixedBitSet;
use petril::sif::{Answer, Cone, Diagrams, Formula, Operator, SignalId, Solver, Specification};
use petril::source::Source;
use proptest::prelude::*;

const F1: &str = include_str!("../../examples/beam-interlock.sif");

fn read(text: &str) -> Specification {
    let (specification, diagnostics) = Specification::read(&[Source::new("test.sif", text)]);
    specification.unwrap_or_else(|| panic!("{diagnostics:?}"))
}

/// All valuations of the inputs, in the order in which they are counted.
fn valuations(inputs: &[SignalId], signals: usize) -> impl Iterator<Item = FixedBitSet> + '_ {
    (0..1_u64 << inputs.len()).map(move |number| {
        let mut set = FixedBitSet::with_capacity(signals);
        let ones = inputs.iter().enumerate().filter(|(bit, _)| number >> bit & 1 == 1);
        ones.for_each(|(_, input)| set.insert(input.0));
        set
    })
}

#[test]
fn the_seed_papers_numbers() {
    let specification = read(F1);
    let cone = Cone::of_function(&specification, 0);
    let f1 = specification.functions[0].outputs[0];
    assert_eq!(cone.inputs.len(), 7);
    let is_kept = |valuation: &FixedBitSet, names: &[&str]| {
        let kept = specification.restrictions.iter().filter(|restriction| names.contains(&restriction.name.as_str()));
        kept.clone().all(|restriction| restriction.allowed.holds(|signal| valuation.contains(signal.0)))
    };
    let all: Vec<FixedBitSet> = valuations(&cone.inputs, specification.signals.len()).collect();
    let is_true: Vec<&FixedBitSet> = all.iter().filter(|v| specification.settled(v).contains(f1.0)).collect();
    assert_eq!((all.len(), is_true.len()), (128, 43));
    assert_eq!(is_true.iter().filter(|v| is_kept(v, &["R3"])).count(), 19);
    assert_eq!(is_true.iter().filter(|v| is_kept(v, &["R1", "R2", "R3"])).count(), 10);

    // The same by decision diagrams.
    let diagrams = Diagrams::over(cone.inputs.clone(), specification.signals.len(), 1000).unwrap();
    let formula = |formula: &Formula| diagrams.formula(formula, &|signal| diagrams.signal(signal)).unwrap();
    let mut set = formula(specification.definition(f1).unwrap());
    assert_eq!(diagrams.count(&set), "43");
    for (restriction, left) in specification.restrictions.iter().zip(["19", "13", "10"]) {
        set = diagrams.and(&set, &formula(&restriction.allowed)).unwrap();
        assert_eq!(diagrams.count(&set), left, "after {}", restriction.name);
    }
    let listed: Vec<FixedBitSet> = diagrams.valuations(&set).collect();
    assert_eq!(listed.len(), 10);
    assert!(listed.iter().all(|valuation| specification.settled(valuation).contains(f1.0)));

    // "Exactly one mode" would leave 8.
    let exactly = F1.replace("never MODE_TFA & MODE_Tra", "exactly one of MODE_Acc, MODE_TFA, MODE_Tra");
    let specification = read(&exactly);
    let cone = Cone::of_function(&specification, 0);
    let count = valuations(&cone.inputs, specification.signals.len())
        .filter(|v| specification.settled(v).contains(f1.0))
        .filter(|v| cone.allows(&|signal| u64::from(v.contains(signal.0))) & 1 == 1)
        .count();
    assert_eq!(count, 8);
}

/// Formulas over six signals.
fn formulas() -> impl Strategy<Value = Formula> {
    let leaf = prop_oneof![
        8 => (0..6_usize).prop_map(|signal| Formula::Signal(SignalId(signal))),
        1 => any::<bool>().prop_map(Formula::Constant),
    ];
    leaf.prop_recursive(4, 24, 4, |inner| {
        let many = prop_oneof![
            Just(Operator::And),
            Just(Operator::Or),
            Just(Operator::Xor),
            Just(Operator::AtMostOne),
            Just(Operator::ExactlyOne),
        ];
        let two = prop_oneof![Just(Operator::Implies), Just(Operator::Iff)];
        prop_oneof![
            inner.clone().prop_map(|formula| Formula::Not(Box::new(formula))),
            (many, prop::collection::vec(inner.clone(), 1..5)).prop_map(|(operator, of)| Formula::Gate(operator, of)),
            (two, inner.clone(), inner).prop_map(|(operator, a, b)| Formula::Gate(operator, vec![a, b])),
        ]
    })
}

proptest! {
    #[test]
    fn engines_agree(formulas in prop::collection::vec(formulas(), 1..4)) {
        let inputs: Vec<SignalId> = (0..6).map(SignalId).collect();
        let wanted: Vec<FixedBitSet> = valuations(&inputs, 6)
            .filter(|v| formulas.iter().all(|formula| formula.holds(|signal| v.contains(signal.0))))
            .collect();
        let diagrams = Diagrams::over(inputs.clone(), 6, 1000).unwrap();
        let mut set = diagrams.constant(true);
        for formula in &formulas {
            set = diagrams.and(&set, &diagrams.formula(formula, &|signal| diagrams.signal(signal)).unwrap()).unwrap();
        }
        prop_assert_eq!(diagrams.count(&set), wanted.len().to_string());
        let mut listed: Vec<FixedBitSet> = diagrams.valuations(&set).collect();
        listed.sort();
        let mut sorted = wanted.clone();
        sorted.sort();
        prop_assert!(listed == sorted);
        let within = |cube: &petril::sif::Cube| 1_u64 << (6 - cube.ones.len() - cube.zeros.len());
        prop_assert_eq!(diagrams.cubes(&set).map(|cube| within(&cube)).sum::<u64>(), wanted.len() as u64);

        // The solver finds each valuation once, and then no more.
        let mut solver = Solver::default();
        let literals: Vec<_> = inputs.iter().map(|_| solver.fresh()).collect();
        let assumed: Vec<_> = formulas.iter().map(|formula| solver.formula(formula, &|signal| literals[signal.0])).collect();
        let mut found = Vec::new();
        while solver.solve(&assumed) == Answer::Satisfiable {
            let mut model = FixedBitSet::with_capacity(6);
            (0..6).filter(|input| solver.value(literals[*input])).for_each(|input| model.insert(input));
            solver.require(literals.iter().enumerate().map(|(input, literal)| {
                if model.contains(input) { !*literal } else { *literal }
            }));
            found.push(model);
            prop_assert!(found.len() <= wanted.len());
        }
        prop_assert_eq!(found.len(), wanted.len());
        prop_assert!(found.iter().all(|model| wanted.contains(model)));
        // What is to blame cannot be satisfied on its own.
        if found.is_empty() {
            let core = solver.core(&assumed);
            prop_assert_eq!(solver.solve(&core), Answer::Unsatisfiable);
        }
    }
}

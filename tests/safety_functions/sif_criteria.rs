//! Tests of safety functions are what their criteria say, and find the faults that their plans say: the seed paper's function, and
//! random specifications against the definitions (`support/naive_faults.rs`).
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use support::naive_faults;

use fixedbitset::FixedBitSet;
use naive_faults::{Naive, every, occurrences, suffices, value};
use petril::sif::{
    Criterion, Formula, Limits, Operator, Plan, SignalId, Specification, Study, coverage_of, excluded, plan,
};
use petril::source::Source;
use proptest::prelude::*;

const F1: &str = include_str!("../../examples/beam-interlock.sif");

fn read(text: &str) -> Specification {
    let (specification, diagnostics) = Specification::read(&[Source::new("test.sif", text)]);
    specification.unwrap_or_else(|| panic!("{text}\n{diagnostics:?}"))
}

/// Faults, those that nothing shows, and those that the tests find.
fn figures(plan: &Plan) -> [usize; 3] {
    let sum = |of: fn(&petril::sif::ClassCoverage) -> usize| plan.coverage.classes.iter().map(of).sum();
    [sum(|class| class.faults), sum(|class| class.equivalent), sum(|class| class.killed)]
}

/// Which valuations show each fault that can be seen.
fn rows(naive: &Naive<'_>) -> Vec<FixedBitSet> {
    let row = |fault| {
        let mut row = FixedBitSet::with_capacity(naive.allowed.len());
        (0..naive.allowed.len()).filter(|at| naive.shows(&naive.allowed[*at], fault)).for_each(|at| row.insert(at));
        row
    };
    naive.faults().iter().map(row).filter(|row| !row.is_clear()).collect()
}

#[test]
fn the_seed_papers_function() {
    let specification = read(F1);
    let naive = Naive::new(&specification, 0);
    let faults = naive.faults();
    let by_naive =
        |tests: &[FixedBitSet]| faults.iter().filter(|fault| tests.iter().any(|test| naive.shows(test, fault))).count();
    let seen = by_naive(&naive.allowed);
    assert_eq!((faults.len(), seen, naive.allowed.len()), (197, 190, 28));

    let mut study = Study::new(&specification, 0, &Limits::default());
    for (criterion, tests, killed, is_smallest) in [
        // The seed's criterion: all of its tests expect TRUE, and 70 of the 190 faults are missed.
        (Criterion::All, 10, 120, true),
        (Criterion::AllBoth, 28, 190, true),
        (Criterion::Mcdc, 10, 185, false),
        (Criterion::Faults, 13, 190, true),
        (Criterion::Pairs, 7, 122, true),
    ] {
        let plan = study.plan(criterion);
        let values: Vec<FixedBitSet> = plan.tests.iter().map(|test| test.values.clone()).collect();
        let what = criterion.name();
        assert_eq!((plan.tests.len(), plan.is_smallest), (tests, is_smallest), "{what}");
        assert_eq!(figures(&plan), [197, 7, killed], "{what}");
        assert_eq!(by_naive(&values), killed, "{what}");
        assert_eq!(plan.coverage.missed.len(), 190 - killed, "{what}");
        assert_eq!((&plan.incomplete, plan.varied.len(), plan.touched.len()), (&None, 7, 1), "{what}");
    }

    // No 12 tests would find every fault.
    let rows = rows(&naive);
    assert!(suffices(&rows, 13) && !suffices(&rows, 12));

    let plan = study.plan(Criterion::All);
    let reason = "all tests expect TRUE, and this fault is only seen where FALSE is right";
    assert!(plan.coverage.missed.iter().all(|missed| missed.why == reason));
    let f1 = specification.functions[0].outputs[0];
    assert!(plan.coverage.missed.iter().all(|missed| !missed.shown_by.contains(f1.0)));
    assert!(plan.tests.iter().all(|test| test.values.contains(f1.0)));
    let fault = "`!ACC_Tst` is missing in `(MODE_Acc | MODE_TFA | MODE_Tra) & !ACC_Tst & !ACC_TfT & !EISb_Pos`";
    assert!(plan.coverage.missed.iter().any(|missed| missed.fault == fault));

    let excluded = excluded(&specification, 0, &Limits::default());
    assert_eq!(excluded.valuations, "128");
    assert_eq!((excluded.triggering.as_deref(), excluded.excluded.as_deref()), (Some("43"), Some("33")));
    let by: Vec<(usize, &str)> =
        excluded.by_restriction.iter().map(|(restriction, count, _)| (*restriction, count.as_str())).collect();
    assert_eq!(by, [(0, "24"), (1, "6"), (2, "11")]);
    assert_eq!(excluded.listed.unwrap().len(), 33);
}

/// The order saves switching: it begins at rest, and no other that does needs less.
#[test]
fn neighbours_differ_little() {
    let specification = read(F1);
    let inputs = specification.valuation(specification.inputs());
    for (criterion, count) in [(Criterion::All, 10), (Criterion::Faults, 13)] {
        let plan = plan(&specification, 0, criterion, &Limits::default());
        let mut values: Vec<FixedBitSet> = plan.tests.iter().map(|test| test.values.clone()).collect();
        values.iter_mut().for_each(|value| value.intersect_with(&inputs));
        assert_eq!((values.len(), values[0].count_ones(..)), (count, 0));
        let switched: usize = values.windows(2).map(|pair| pair[0].symmetric_difference_count(&pair[1])).sum();
        // The fewest, by dynamic programming over sets of tests and the last of each (Held and Karp, 1962).
        let mut fewest = vec![vec![usize::MAX / 2; count]; 1 << count];
        fewest[1][0] = 0;
        for set in 1..1_usize << count {
            for last in (0..count).filter(|last| set >> last & 1 == 1) {
                for next in (0..count).filter(|next| set >> next & 1 == 0) {
                    let cost = fewest[set][last] + values[last].symmetric_difference_count(&values[next]);
                    let place = &mut fewest[set | 1 << next][next];
                    *place = cost.min(*place);
                }
            }
        }
        let best = *fewest[(1 << count) - 1].iter().min().unwrap();
        assert!(switched <= best, "{switched} switches, and {best} would do");
    }
}

/// What is far too much for all valuations ends, and says what it has left out.
#[test]
fn a_gate_of_350_operands() {
    let names: Vec<String> = (0..350).map(|input| format!("x{input}")).collect();
    let inputs: String = names.iter().map(|name| format!("input {name};")).collect();
    let text = format!("function F {{ interface {{ {inputs} output y; }} formal {{ y = {}; }} }}", names.join(" | "));
    let specification = read(&text);
    let mut study = Study::new(&specification, 0, &Limits::default());
    for criterion in [Criterion::All, Criterion::AllBoth] {
        let plan = study.plan(criterion);
        assert_eq!(plan.tests.len(), 0);
        let reason = plan.incomplete.unwrap();
        assert_eq!(reason, "about 2.2e105 valuations are more than the 4096 that are listed");
        assert!(!plan.cubes.is_empty());
    }
    // One input alone, each in its turn, none, and two for `xor`: by hand.
    let plan = study.plan(Criterion::Faults);
    assert_eq!((plan.tests.len(), plan.incomplete), (352, None));
    let [faults, equivalent, killed] = figures(&study.plan(Criterion::Faults));
    // Negation and reference of each literal, two operators, the whole, omissions, opposites as further operands, stuck.
    assert_eq!(faults, 350 + 350 * 349 * 2 + 2 + 1 + 350 + 350 + 2 * 351);
    assert_eq!((equivalent, killed), (0, faults));
    let stopped = Limits { stop: Arc::new(|| true), ..Limits::default() };
    let plan = petril::sif::plan(&specification, 0, Criterion::Faults, &stopped);
    assert!(plan.incomplete.is_some());
}

#[test]
fn what_others_must_be_is_close_to_rest() {
    // `a` needs `b`, which the function does not look at; `c` and `d` cannot be at rest, where both are TRUE, nor `e` and `f`, where
    // both are FALSE. The first of each stays.
    let specification = read(
        "restriction R1: a implies b;
         restriction R2: never c & d;
         restriction R3: at least one of e, f;
         input b; input c normally TRUE; input d normally TRUE; input e; input f; input g normally TRUE;
         function F { interface { input a; output y; } formal { y = a; } }
         function G { interface { output z; } formal { z = b & c; } }",
    );
    let plan = plan(&specification, 0, Criterion::AllBoth, &Limits::default());
    let named = |test: &petril::sif::Test| -> Vec<&str> {
        test.values.ones().map(|id| specification.name(SignalId(id))).collect()
    };
    let mut tests: Vec<BTreeSet<&str>> = plan.tests.iter().map(|test| named(test).into_iter().collect()).collect();
    tests.sort();
    assert_eq!(tests, [BTreeSet::from(["a", "b", "c", "f", "g", "y", "z"]), BTreeSet::from(["c", "f", "g"])]);
    assert_eq!(plan.touched.len(), 1, "`z` does not depend on `a`");
}

/// Then there is no test, and it is said why; inside of the function's inputs or outside, by diagrams or by the solver.
#[test]
fn restrictions_that_contradict_each_other() {
    for restrictions in
        ["restriction R1: never a; restriction R2: always a;", "restriction R1: never b & b | !b & a | TRUE;"]
    {
        let specification = read(&format!(
            "{restrictions} input b;
             function F {{ interface {{ input a; output y; }} formal {{ y = a; }} }}",
        ));
        for limits in [Limits::default(), Limits { nodes: 1, ..Limits::default() }] {
            for criterion in Criterion::ALL {
                let plan = plan(&specification, 0, criterion, &limits);
                assert_eq!((plan.tests.len(), &plan.incomplete), (0, &None));
                assert_eq!(plan.notes, ["no valuation can be: the restrictions contradict each other"]);
                let [faults, equivalent, killed] = figures(&plan);
                assert!(faults > 0 && equivalent == faults && killed == 0);
            }
        }
    }
}

#[test]
fn restrictions_that_exclude_together() {
    // Neither restriction alone speaks against `a`.
    let specification = read(
        "restriction R1: a implies b; restriction R2: never b; input b;
         function F { interface { input a; output y; } formal { y = a; } }",
    );
    let found = excluded(&specification, 0, &Limits::default());
    assert_eq!((found.triggering.as_deref(), found.excluded.as_deref()), (Some("1"), Some("1")));
    let listed = found.listed.unwrap();
    assert_eq!(listed[0].1, [0, 1]);
    assert_eq!(found.by_restriction, [(0, "0".to_owned(), "1".to_owned()), (1, "0".to_owned(), "1".to_owned())]);
}

/// Formulas over these names, as text.
fn formula(names: &'static [&'static str]) -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        12 => (0..names.len()).prop_map(|name| Formula::Signal(SignalId(name))),
        1 => any::<bool>().prop_map(Formula::Constant),
    ];
    let all = leaf.prop_recursive(3, 10, 3, |inner| {
        let many = prop_oneof![
            3 => Just(Operator::And),
            3 => Just(Operator::Or),
            1 => Just(Operator::Xor),
            1 => Just(Operator::AtMostOne),
            1 => Just(Operator::ExactlyOne),
        ];
        let two = prop_oneof![Just(Operator::Implies), Just(Operator::Iff)];
        prop_oneof![
            1 => inner.clone().prop_map(|formula| Formula::Not(Box::new(formula))),
            4 => (many, prop::collection::vec(inner.clone(), 2..4)).prop_map(|(operator, of)| Formula::Gate(operator, of)),
            1 => (two, inner.clone(), inner).prop_map(|(operator, a, b)| Formula::Gate(operator, vec![a, b])),
        ]
    });
    all.prop_map(|formula| formula.text(&|signal| names[signal.0]))
}

/// Two functions, one of which uses the other, with an auxiliary value and restrictions of the system and of one function.
fn specifications() -> impl Strategy<Value = String> {
    let first = (formula(&["a", "b", "c"]), formula(&["a", "b", "c", "d", "help"]));
    let second = (formula(&["c", "d", "e", "y"]), formula(&["e", "y", "z"]));
    let restrictions = prop::collection::vec(formula(&["a", "b", "c", "d", "e", "f"]), 0..3);
    (first, second, restrictions, prop::option::of(formula(&["c", "e", "f", "y"])), any::<[bool; 2]>()).prop_map(
        |((help, y), (z, w), system, own, rest)| {
            let system: String =
                system.iter().enumerate().map(|(at, text)| format!("restriction R{at}: never {text} & a;\n")).collect();
            let own = own.map_or_else(String::new, |text| format!("restriction Own: always {text} | !e;"));
            let rest = rest.map(|rest| if rest { "TRUE" } else { "FALSE" });
            format!(
                "{system}input f normally {};
                 function F {{ interface {{ input a normally {}; input b; input c; input d; output y; }}
                     formal {{ help = {help}; y = {y}; }} }}
                 function G {{ interface {{ input c; input d; input e; input y; output z; output w; }}
                     formal {{ z = {z}; w = {w}; {own} }} }}",
                rest[0], rest[1]
            )
        },
    )
}

/// How a condition can be shown: by unique cause, by masking, not at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Shown {
    UniqueCause,
    Masking,
    Never,
}

/// How tests show each condition of a function at best.
fn shown(naive: &Naive<'_>, tests: &[FixedBitSet]) -> Vec<Shown> {
    let specification = naive.specification;
    let mut found = Vec::new();
    for equation in &naive.equations {
        let formula = specification.definition(*equation).unwrap();
        for (literal, put) in occurrences(formula) {
            let (yes, no) = (put(Formula::Constant(true)), put(Formula::Constant(false)));
            let decides = |inputs: &FixedBitSet| {
                let of = |mutant: &Formula, output: &SignalId| {
                    value(specification, *output, inputs, Some((*equation, mutant)))
                };
                naive.outputs().iter().any(|output| of(&yes, output) != of(&no, output))
            };
            let facts = |inputs: &FixedBitSet| {
                let condition = literal.holds(|signal| value(specification, signal, inputs, None));
                let own = literal.signals()[0];
                let others: Vec<(SignalId, bool)> = formula
                    .signals()
                    .into_iter()
                    .filter(|signal| *signal != own)
                    .map(|signal| (signal, value(specification, signal, inputs, None)))
                    .collect();
                (condition, value(specification, *equation, inputs, None), others)
            };
            let deciding: Vec<_> = tests.iter().filter(|test| decides(test)).map(facts).collect();
            let mut best = Shown::Never;
            for a in &deciding {
                for b in &deciding {
                    if a.0 != b.0 && a.1 != b.1 {
                        best = best.min(if a.2 == b.2 { Shown::UniqueCause } else { Shown::Masking });
                    }
                }
            }
            found.push(best);
        }
    }
    found
}

/// Values of every two inputs.
fn pairs(naive: &Naive<'_>, tests: &[FixedBitSet]) -> BTreeSet<[(SignalId, bool); 2]> {
    let mut found = BTreeSet::new();
    for test in tests {
        for (at, a) in naive.varied.iter().enumerate() {
            for b in &naive.varied[at + 1..] {
                found.insert([a, b].map(|input| (*input, test.contains(input.0))));
            }
        }
    }
    found
}

/// Everything that a plan says, by the definitions.
fn agrees(specification: &Specification, function: usize, limits: &Limits) -> Result<(), TestCaseError> {
    let naive = Naive::new(specification, function);
    let faults = naive.faults();
    let can_be: BTreeSet<FixedBitSet> = naive.allowed.iter().map(|inputs| naive.narrow(inputs)).collect();
    let is_seen: Vec<bool> =
        faults.iter().map(|fault| naive.allowed.iter().any(|inputs| naive.shows(inputs, fault))).collect();
    let mut study = Study::new(specification, function, limits);
    for criterion in Criterion::ALL {
        let plan = study.plan(criterion);
        let what = criterion.name();
        prop_assert_eq!(&plan.incomplete, &None, "{}", what);
        let tests: Vec<FixedBitSet> = plan.tests.iter().map(|test| test.values.clone()).collect();
        let narrow: BTreeSet<FixedBitSet> = tests.iter().map(|test| naive.narrow(test)).collect();
        prop_assert_eq!(narrow.len(), tests.len(), "{}: a test stands twice", what);
        for test in &tests {
            let inputs = specification.valuation(specification.inputs().filter(|input| test.contains(input.0)));
            prop_assert!(naive.allowed.contains(&inputs), "{}: a test cannot be", what);
            for signal in (0..specification.signals.len()).map(SignalId) {
                prop_assert_eq!(test.contains(signal.0), value(specification, signal, &inputs, None), "{}", what);
            }
            let mut resting = inputs.clone();
            let others = specification.inputs().filter(|input| !naive.varied.contains(input));
            others.for_each(|input| resting.set(input.0, specification.rest(input)));
            prop_assert!(!naive.allowed.contains(&resting) || resting == inputs, "{}: not at rest", what);
        }
        let kills = |fault| tests.iter().any(|test| naive.shows(test, fault));
        let mut classes: BTreeMap<&str, [usize; 3]> = BTreeMap::new();
        for (fault, is_seen) in faults.iter().zip(&is_seen) {
            let [all, equivalent, killed] = classes.entry(fault.0).or_default();
            *all += 1;
            *equivalent += usize::from(!is_seen);
            *killed += usize::from(*is_seen && kills(fault));
        }
        for class in &plan.coverage.classes {
            let wanted = classes.get(class.class).copied().unwrap_or_default();
            prop_assert_eq!([class.faults, class.equivalent, class.killed], wanted, "{}: {}", what, class.class);
            prop_assert_eq!(class.undecided, 0);
        }
        let [all, equivalent, killed] = figures(&plan);
        prop_assert_eq!(plan.coverage.missed.len(), all - equivalent - killed);
        for missed in &plan.coverage.missed {
            let inputs =
                specification.valuation(specification.inputs().filter(|input| missed.shown_by.contains(input.0)));
            prop_assert!(naive.allowed.contains(&inputs) && specification.settled(&inputs) == missed.shown_by);
        }
        let triggering = |inputs: &FixedBitSet| naive.triggers(inputs);
        match criterion {
            Criterion::All => {
                prop_assert_eq!(narrow, can_be.iter().filter(|inputs| triggering(inputs)).cloned().collect());
            }
            Criterion::AllBoth => prop_assert_eq!(&narrow, &can_be),
            Criterion::Faults => {
                prop_assert_eq!(killed, all - equivalent);
                let rows = rows(&naive);
                prop_assert!(suffices(&rows, tests.len()));
                if plan.is_smallest && !tests.is_empty() {
                    prop_assert!(!suffices(&rows, tests.len() - 1), "{} tests are not the fewest", tests.len());
                }
            }
            Criterion::Mcdc => {
                let (wanted, found) = (shown(&naive, &naive.allowed), shown(&naive, &tests));
                let never = wanted.iter().filter(|shown| **shown == Shown::Never).count();
                prop_assert_eq!(found, wanted);
                prop_assert_eq!(plan.notes.len(), if can_be.is_empty() { 1 } else { 1 + never });
            }
            Criterion::Pairs => prop_assert_eq!(pairs(&naive, &tests), pairs(&naive, &naive.allowed)),
        }
        let judged = coverage_of(specification, function, &tests, limits);
        let killed_again: usize = judged.classes.iter().map(|class| class.killed).sum();
        prop_assert_eq!(killed_again, killed);
    }
    Ok(())
}

fn counts(specification: &Specification, function: usize) -> Result<(), TestCaseError> {
    let naive = Naive::new(specification, function);
    let all: BTreeSet<FixedBitSet> = every(specification).iter().map(|inputs| naive.narrow(inputs)).collect();
    let can_be: BTreeSet<FixedBitSet> = naive.allowed.iter().map(|inputs| naive.narrow(inputs)).collect();
    let triggering: BTreeSet<&FixedBitSet> = all.iter().filter(|inputs| naive.triggers(inputs)).collect();
    let out: BTreeSet<&FixedBitSet> = triggering.iter().copied().filter(|inputs| !can_be.contains(*inputs)).collect();
    let found = excluded(specification, function, &Limits::default());
    prop_assert_eq!(found.valuations, all.len().to_string());
    prop_assert_eq!(found.triggering, Some(triggering.len().to_string()));
    prop_assert_eq!(found.excluded, Some(out.len().to_string()));
    let listed = found.listed.unwrap();
    prop_assert_eq!(listed.iter().map(|(inputs, _)| inputs).collect::<BTreeSet<_>>(), out);
    // What remains if some restrictions are forgotten.
    let kept = |inputs: &FixedBitSet, is_kept: &dyn Fn(usize) -> bool| {
        let restrictions = specification.restrictions.iter().enumerate().filter(|(at, restriction)| {
            is_kept(*at) && specification.restrictions_of(function).any(|other| std::ptr::eq(other, *restriction))
        });
        let restrictions: Vec<_> = restrictions.map(|(_, restriction)| restriction).collect();
        every(specification).iter().filter(|whole| naive.narrow(whole) == *inputs).any(|whole| {
            restrictions.iter().all(|restriction| restriction.allowed.holds(|of| value(specification, of, whole, None)))
        })
    };
    for (inputs, by) in &listed {
        prop_assert!(!by.is_empty());
        let alone = by.iter().filter(|at| !kept(inputs, &|other| other == **at)).count();
        let without_one = || by.iter().all(|at| kept(inputs, &|other| by.contains(&other) && other != *at));
        let together = !kept(inputs, &|other| by.contains(&other));
        prop_assert!(alone == by.len() || (alone == 0 && together && without_one()), "{by:?}");
    }
    for (restriction, its, only) in &found.by_restriction {
        let excludes = triggering.iter().filter(|inputs| !kept(inputs, &|other| other == *restriction)).count();
        let alone = listed.iter().filter(|(inputs, _)| kept(inputs, &|other| other != *restriction)).count();
        prop_assert_eq!((its, only), (&excludes.to_string(), &alone.to_string()));
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    /// All valuations that can be are known.
    #[test]
    fn plans_are_what_they_say(text in specifications()) {
        let specification = read(&text);
        for function in 0..2 {
            agrees(&specification, function, &Limits::default())?;
            // Of restrictions of other inputs that contradict each other, `petril sif check` tells.
            if !Naive::new(&specification, function).allowed.is_empty() {
                counts(&specification, function)?;
            }
        }
    }

    /// The same where diagrams are no help and a solver finds what is needed.
    #[test]
    fn plans_by_a_solver_are_what_they_say(text in specifications()) {
        let specification = read(&text);
        for function in 0..2 {
            agrees(&specification, function, &Limits { nodes: 1, ..Limits::default() })?;
        }
    }
}

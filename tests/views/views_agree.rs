//! Scan view and transition view are two views of one system.
//!
//! A formula f over scan states has a counterpart f' over markings, read at the markings where control is at `End`:
//!
//! | f | f' |
//! |---|---|
//! | atom, !f, f & g … | the same of the parts |
//! | EX f | E[at End U E[!at End U at End & f']] after one step |
//! | E[f U g] | E[(at End -> f') U at End & g'] |
//! | E[f W g] | E[(at End -> f') W at End & g'], on runs where the PLC keeps scanning |
//! | A … | by duality |
//!
//! f holds in every state after the first scan iff !E[!at End U at End & !f'] holds in the initial marking.
//! Fairness assumptions about inputs and plants mean the same in both.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use fixedbitset::FixedBitSet;
use petril::explore::{Budget, Markings, ScanSpace, explore};
use petril::logic::{
    Bound, Constraints, Dag, Fairness, MarkingValuation, Quantifier, ScanValuation, View, bind_fairness, label,
    parse_fairness,
};
use petril::semantics::VarId;
use petril::source::Source;
use petril::translate::{PlaceRole, System};
use proptest::prelude::*;
use support::naive_ctl::{Fair, Kripke};
use support::{random_formula, random_program};

use Quantifier::Some as Exists;

fn not(f: Bound) -> Bound {
    Bound::Not(Box::new(f))
}

fn and(f: Bound, g: Bound) -> Bound {
    Bound::And(Box::new(f), Box::new(g))
}

fn exists(weak: bool, hold: Bound, release: Bound) -> Bound {
    Bound::Until { quantifier: Exists, weak, hold: Box::new(hold), release: Box::new(release) }
}

/// The counterpart of a formula.
fn counterpart(f: &Bound, system: &System) -> Bound {
    let end = || Bound::Marked(system.place(PlaceRole::Line(system.program.end())));
    let of = |f: &Bound| Box::new(counterpart(f, system));
    match f {
        Bound::Variable(variable) => {
            Bound::Marked(system.place(PlaceRole::Bit { variable: *variable, bit: 0, value: true }))
        }
        Bound::Truth(_) => f.clone(),
        Bound::Compare(comparison, a, b) => Bound::Compare(*comparison, term(a, system), term(b, system)),
        Bound::Not(f) => Bound::Not(of(f)),
        Bound::And(f, g) => Bound::And(of(f), of(g)),
        Bound::Or(f, g) => Bound::Or(of(f), of(g)),
        Bound::Implies(f, g) => Bound::Implies(of(f), of(g)),
        Bound::Iff(f, g) => Bound::Iff(of(f), of(g)),
        Bound::Next(Exists, f) => {
            let next_end = exists(false, not(end()), and(end(), *of(f)));
            Bound::Next(Exists, Box::new(next_end))
        }
        Bound::Until { quantifier: Exists, weak, hold, release } => {
            let hold = Bound::Implies(Box::new(end()), of(hold));
            exists(*weak, hold, and(end(), *of(release)))
        }
        Bound::Next(Quantifier::All, f) => not(counterpart(&Bound::Next(Exists, Box::new(not((**f).clone()))), system)),
        Bound::Until { quantifier: Quantifier::All, weak, hold, release } => {
            // A[f U g] = ¬E[¬g W ¬f ∧ ¬g], A[f W g] = ¬E[¬g U ¬f ∧ ¬g].
            let (f, g) = ((**hold).clone(), (**release).clone());
            not(counterpart(&exists(!weak, not(g.clone()), and(not(f), not(g))), system))
        }
        Bound::Bit(..) => unreachable!("the programs have truth values only"),
        Bound::Marked(_) | Bound::Enabled(_) | Bound::Deadlock | Bound::Ltl(_) => {
            unreachable!("scan states have none of them")
        }
    }
}

fn term(t: &petril::logic::Term, system: &System) -> petril::logic::Term {
    use petril::logic::Term;
    let of = |t: &Term| Box::new(term(t, system));
    match t {
        Term::Number(n) => Term::Number(*n),
        Term::Variable(..) | Term::Bits { .. } | Term::Tokens(_) | Term::Past(_) => {
            unreachable!("the programs have truth values only, and nothing looks back")
        }
        Term::Truth(f) => Term::Truth(Box::new(counterpart(f, system))),
        Term::Sum(a, b) => Term::Sum(of(a), of(b)),
        Term::Difference(a, b) => Term::Difference(of(a), of(b)),
        Term::Product(a, b) => Term::Product(of(a), of(b)),
    }
}

/// Whether f holds after every first scan from which a run counts, in the scan view, by the checker; `None` if some scan never
/// ends. Runs count in which each of these is true again and again.
fn in_scan_view(system: &System, f: &Bound, again: &[Bound]) -> Option<bool> {
    let space = ScanSpace::new(system);
    let graph = explore(&space, Budget::default(), &mut |_| None);
    let mut dag = Dag::default();
    let node = dag.add(f, false);
    let holds = |f: &Bound, id: u32| f.holds_in(&ScanValuation(&space, graph.state(id))).unwrap();
    let weak = again.iter().map(|goal| {
        let mut set = FixedBitSet::with_capacity(graph.len());
        set.extend(graph.ids().filter(|&id| holds(goal, id)).map(|id| id as usize));
        set
    });
    let fairness = Fairness::on(&graph, Constraints { weak: weak.collect(), strong: vec![] });
    let fairness = (!again.is_empty()).then_some(&fairness);
    let labels = label(&graph, &dag, &holds, fairness);
    let counts = |s: usize| fairness.is_none_or(|fairness| fairness.surely().contains(s));
    let everywhere = graph.initial().iter().map(|&s| s as usize).all(|s| !counts(s) || labels.of(node).contains(s));
    graph.is_complete().then_some(everywhere)
}

/// The same in the transition view, by the textbook.
fn in_transition_view(system: &System, f: &Bound, again: &[Bound]) -> bool {
    let space = Markings::explored(&system.net, Budget::default(), &mut |_| None);
    let graph = space.graph();
    assert!(graph.is_complete(), "the net is safe");
    let end = Bound::Marked(system.place(PlaceRole::Line(system.program.end())));
    let idle = system.place(PlaceRole::Idle);
    let successors = graph.ids().map(|s| graph.successors(s).iter().map(|&t| t as usize).collect()).collect();
    let scanning = graph.ids().map(|s| !space.is_marked(graph.state(s), idle)).collect();
    let mut sets: Vec<Vec<bool>> = vec![scanning];
    let atom = |f: &Bound, s: usize| f.holds_in(&MarkingValuation(&space, graph.state(s as u32))).unwrap();
    sets.extend(again.iter().map(|goal| graph.ids().map(|s| atom(goal, s as usize)).collect()));
    let kripke = Kripke::under(Fair::Again(sets), successors);
    let after_first = not(exists(false, not(end.clone()), and(end, not(counterpart(f, system)))));
    kripke.states(&after_first, &atom)[graph.initial()[0] as usize]
}

/// What comes again and again, as far as there is anything it could be about.
fn goals(texts: &[&str], system: &System, view: View) -> Vec<Bound> {
    let read = |text: &&str| parse_fairness(&Source::new("fairness", *text)).unwrap();
    let bound = texts.iter().filter_map(|text| bind_fairness(&read(text), system, view).ok());
    bound.flat_map(|assumed| assumed.constraints).map(|constraint| constraint.goal).collect()
}

fn formula() -> impl Strategy<Value = Bound> {
    // The variables of random programs: three inputs, three memory bits, two outputs.
    random_formula::formula((0..8).map(|v| Bound::Variable(VarId(v))).collect(), true)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn on_random_programs_and_formulas(
        text in random_program::text(5),
        device in proptest::option::of(random_program::device()),
        formula in formula(),
        again in proptest::sample::subsequence(vec!["released(i0)", "pressed(i0)", "pressed(i1)", "released(i2)", "plant"], 0..4),
    ) {
        let system = random_program::system(support::program(&text), device.as_ref());
        if let Some(holds) = in_scan_view(&system, &formula, &goals(&again, &system, View::Scan)) {
            let again = goals(&again, &system, View::Transition);
            prop_assert_eq!(holds, in_transition_view(&system, &formula, &again), "{}", formula.text(&system));
        }
    }

    /// The states at the end of a scan are the projection of the markings with control at `End`.
    #[test]
    fn on_states(text in random_program::text(6), device in proptest::option::of(random_program::device())) {
        let system = random_program::system(support::program(&text), device.as_ref());
        let scans = ScanSpace::new(&system);
        let graph = explore(&scans, Budget::default(), &mut |_| None);
        let mut from_scans: Vec<Vec<bool>> =
            graph.ids().map(|s| system.program.declared().map(|v| scans.value(graph.state(s), v) == 1).collect()).collect();
        let markings = Markings::explored(&system.net, Budget::default(), &mut |_| None);
        let all = markings.graph();
        let end = system.place(PlaceRole::Line(system.program.end()));
        let at_end = all.ids().filter(|&s| markings.is_marked(all.state(s), end));
        let value = |s, variable| markings.is_marked(all.state(s), system.place(PlaceRole::Bit { variable, bit: 0, value: true }));
        let mut from_markings: Vec<Vec<bool>> =
            at_end.map(|s| system.program.declared().map(|v| value(s, v)).collect()).collect();
        for list in [&mut from_scans, &mut from_markings] {
            list.sort_unstable();
            list.dedup();
        }
        prop_assert_eq!(from_scans, from_markings);
    }
}

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
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

mod support;

use petril::explore::{Budget, Markings, ScanSpace, explore};
use petril::logic::{Bound, Dag, MarkingValuation, Quantifier, ScanValuation, label};
use petril::semantics::VarId;
use petril::translate::{PlaceRole, System};
use proptest::prelude::*;
use support::naive_ctl::Kripke;
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
        Bound::Marked(_) | Bound::Enabled(_) | Bound::Deadlock => unreachable!("scan states have none of them"),
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

/// Whether f holds after every first scan, in the scan view, by the checker; `None` if some scan never ends.
fn in_scan_view(system: &System, f: &Bound) -> Option<bool> {
    let space = ScanSpace::new(system);
    let graph = explore(&space, Budget::default(), &mut |_| None);
    let mut dag = Dag::default();
    let node = dag.add(f, false);
    let holds = |f: &Bound, id: u32| f.holds_in(&ScanValuation(&space, graph.state(id))).unwrap();
    let labels = label(&graph, &dag, &holds, None);
    let everywhere = graph.initial().iter().all(|&s| labels.of(node).contains(s as usize));
    graph.is_complete().then_some(everywhere)
}

/// The same in the transition view, by the textbook.
fn in_transition_view(system: &System, f: &Bound) -> bool {
    let space = Markings::explored(&system.net, Budget::default(), &mut |_| None);
    let graph = space.graph();
    assert!(graph.is_complete(), "the net is safe");
    let end = Bound::Marked(system.place(PlaceRole::Line(system.program.end())));
    let idle = system.place(PlaceRole::Idle);
    let successors = graph.ids().map(|s| graph.successors(s).iter().map(|&t| t as usize).collect()).collect();
    let scanning = graph.ids().map(|s| !space.is_marked(graph.state(s), idle)).collect();
    let kripke = Kripke { successors, fair: Some(scanning) };
    let after_first = not(exists(false, not(end.clone()), and(end, not(counterpart(f, system)))));
    let atom = |f: &Bound, s: usize| f.holds_in(&MarkingValuation(&space, graph.state(s as u32))).unwrap();
    kripke.states(&after_first, &atom)[graph.initial()[0] as usize]
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
    ) {
        let system = random_program::system(support::program(&text), device.as_ref());
        if let Some(holds) = in_scan_view(&system, &formula) {
            prop_assert_eq!(holds, in_transition_view(&system, &formula), "{}", formula.text(&system));
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

//! Formulas about paths: what the search finds, or does not find, is what the textbook says, on random graphs whole and in part,
//! with and without constraints on paths. On random programs, verdicts are those of the textbook on the whole graph, however much of
//! it was explored, whether formulas are of LTL or of CTL.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::explore::{Budget, ScanSpace, explore};
use petril::logic::{
    Bound, Constraint, Dag, Demand, FairnessAssumption, Path, Quantifier, Requirement, ScanValuation, Search, label,
    parse_requirement, search,
};
use petril::semantics::VarId;
use petril::source::Source;
use petril::translate::System;
use petril::verdict::{Options, Verdict, check};
use proptest::prelude::*;
use support::naive_ltl::violating;
use support::random_graph::{Given, Masks, given_in_part, given_of, masks};
use support::{random_formula, random_program};

use Quantifier::All;

type Formula = Path<Bound>;

fn formula() -> impl Strategy<Value = Formula> {
    random_formula::path((0..3).map(|v| Bound::Variable(VarId(v))).collect())
}

/// Atoms that a formula has: three variables and the two constants.
fn number(atom: &Bound) -> usize {
    match atom {
        Bound::Variable(variable) => variable.0,
        Bound::Truth(value) => 3 + usize::from(*value),
        _ => unreachable!("the formulas have no others"),
    }
}

fn truth(marks: u8, atom: usize) -> bool {
    if atom < 3 { marks >> atom & 1 == 1 } else { atom == 4 }
}

/// What the search says of the part of a graph with so many states.
fn searched(given: &Given, formula: &Formula, masks: &Masks, states: u64) -> (petril::explore::Graph, Search) {
    let graph = given.explored(states);
    let constraints = masks.sets(given, &graph);
    let states_where = |atom: &Bound| {
        let mut set = fixedbitset::FixedBitSet::with_capacity(graph.len());
        set.extend(graph.ids().filter(|&id| given.atom(atom, given.name(&graph, id))).map(|id| id as usize));
        set
    };
    let found = search(&graph, formula, &constraints, &states_where, Budget::default());
    (graph, found)
}

/// Holds the search to the textbook.
fn agree(given: &Given, formula: &Formula, masks: &Masks, states: u64) -> Result<(), TestCaseError> {
    let lists = given.lists();
    let at = |atom: usize, state: usize| truth(given.marks[state], atom);
    let Some(violating_states) = violating(&lists, formula, (&masks.weak, &masks.strong), 5, &number, &at) else {
        return Err(TestCaseError::reject("too much to guess"));
    };
    let (graph, found) = searched(given, formula, masks, states);
    let violated = graph.initial().iter().any(|&id| violating_states[given.name(&graph, id)]);
    match found {
        Search::Found(found) => {
            prop_assert!(violated);
            prop_assert!(graph.initial().contains(&found.states[0]));
            let closing = found.loop_start.map(|start| found.states[start]);
            for (from, to) in found.states.iter().zip(found.states.iter().skip(1).copied().chain(closing)) {
                prop_assert!(graph.successors(*from).contains(&to));
            }
            let names: Vec<usize> = found.states.iter().map(|&id| given.name(&graph, id)).collect();
            match found.loop_start {
                Some(start) => prop_assert!(masks.are_met_by(&names[start..])),
                None => prop_assert!(lists[names[names.len() - 1]].is_empty()),
            }
            for (position, atom, value) in &found.atoms {
                prop_assert_eq!(truth(given.marks[names[*position]], number(atom)), *value);
            }
            // The run alone makes the formula false, by the textbook and by the checker's own reading of runs.
            let mut run: Vec<Vec<usize>> = (1..names.len()).map(|next| vec![next]).collect();
            run.push(found.loop_start.into_iter().collect());
            let on_run = |atom: usize, position: usize| truth(given.marks[names[position]], atom);
            prop_assert!(violating(&run, formula, (&[], &[]), 5, &number, &on_run).unwrap()[0]);
            let holds = |atom: &Bound, position: usize| on_run(number(atom), position);
            prop_assert!(!formula.holds_on(names.len(), found.loop_start, &holds));
        }
        Search::None => prop_assert!(!violated || !graph.knows_initial()),
        Search::Open => prop_assert!(!graph.is_complete()),
        other => prop_assert!(false, "{:?}", other),
    }
    Ok(())
}

/// The formula of CTL that says the same, if the formula is one of those that have one.
fn label_says(given: &Given, graph: &petril::explore::Graph, masks: &Masks, formula: &Bound) -> bool {
    let mut dag = Dag::default();
    let node = dag.add(formula, false);
    let fairness = masks.on(given, graph);
    let labels = label(graph, &dag, &|f, id| given.atom(f, given.name(graph, id)), Some(&fairness));
    graph.initial().iter().all(|&id| labels.of(node).contains(id as usize))
}

fn until(weak: bool, f: Bound, g: Bound) -> Bound {
    Bound::Until { quantifier: All, weak, hold: Box::new(f), release: Box::new(g) }
}

/// The whole graph of a program's scans, as the textbook takes it.
struct Whole {
    successors: Vec<Vec<usize>>,
    initial: Vec<usize>,
    /// The variables of random programs, by state.
    values: Vec<[bool; 8]>,
}

impl Whole {
    /// Nothing if some scan never ends, or the masks of the textbook do not hold all states.
    fn of(system: &System) -> Option<Self> {
        let space = ScanSpace::new(system);
        let graph = explore(&space, Budget::default(), &mut |_| None);
        let value = |id: u32, v| Bound::Variable(VarId(v)).holds_in(&ScanValuation(&space, graph.state(id))).unwrap();
        (graph.is_complete() && graph.len() <= 64).then(|| Self {
            successors: graph.ids().map(|id| graph.successors(id).iter().map(|&to| to as usize).collect()).collect(),
            initial: graph.initial().iter().map(|&id| id as usize).collect(),
            values: graph.ids().map(|id| std::array::from_fn(|v| value(id, v))).collect(),
        })
    }

    fn holds(&self, formula: &Bound, state: usize) -> bool {
        match formula {
            Bound::Variable(variable) => self.values[state][variable.0],
            Bound::Truth(value) => *value,
            Bound::Not(f) => !self.holds(f, state),
            _ => unreachable!("there are no others"),
        }
    }

    /// The verdict by the definition: holds, is violated, or says nothing since from some initial state no path counts.
    fn verdict(&self, formula: &Formula, assumed: &FairnessAssumption) -> Option<Verdict> {
        let mask = |goal: &Bound| {
            (0..self.values.len()).filter(|&s| self.holds(goal, s)).fold(0, |mask: u64, s| mask | 1 << s)
        };
        let (mut weak, mut strong) = (Vec::new(), Vec::new());
        for Constraint { premise, goal, .. } in &assumed.constraints {
            match premise {
                Some(premise) => strong.push((mask(premise), mask(goal))),
                None => weak.push(mask(goal)),
            }
        }
        let number = |atom: &Bound| match atom {
            Bound::Variable(variable) => variable.0,
            _ => 8 + usize::from(*atom == Bound::Truth(true)),
        };
        let truth = |atom: usize, state: usize| if atom < 8 { self.values[state][atom] } else { atom == 9 };
        let violating = |formula: &Formula| violating(&self.successors, formula, (&weak, &strong), 3, &number, &truth);
        let (violated, counting) = (violating(formula)?, violating(&Path::State(Bound::Truth(false)))?);
        Some(match self.initial.as_slice() {
            initial if initial.iter().any(|&s| violated[s]) => Verdict::Violated,
            initial if initial.iter().all(|&s| counting[s]) => Verdict::Holds,
            _ => Verdict::Unknown,
        })
    }
}

/// Two variables of random programs, or constants, perhaps negated; and what runs do again and again.
fn constraint() -> impl Strategy<Value = Constraint> {
    let literal = || {
        ((0..8_usize), any::<bool>()).prop_map(|(v, negated)| {
            let variable = Bound::Variable(VarId(v));
            if negated { Bound::Not(Box::new(variable)) } else { variable }
        })
    };
    (proptest::option::of(literal()), literal()).prop_map(|(premise, goal)| Constraint {
        premise,
        goal,
        words: String::new(),
    })
}

/// Formulas of LTL, some with the formula of CTL that says the same.
fn said_twice() -> impl Strategy<Value = (Formula, Option<Bound>)> {
    let atoms = || (0..8).map(|v| Bound::Variable(VarId(v))).collect::<Vec<_>>();
    let (yes, no) = (Bound::Truth(true), Bound::Truth(false));
    let pair = (proptest::sample::select(atoms()), proptest::sample::select(atoms()), 0..7_usize);
    let pair = pair.prop_map(move |(a, b, which)| {
        let [p, q] = [&a, &b].map(|f| Box::new(Path::State(f.clone())));
        let not = |f: &Bound| Bound::Not(Box::new(f.clone()));
        let next = |f: Bound| Bound::Next(All, Box::new(f));
        match which {
            0 => (Path::Globally(p), until(true, a, no.clone())),
            1 => (Path::Finally(q), until(false, yes.clone(), b)),
            2 => (Path::Until(p, q), until(false, a, b)),
            3 => (Path::WeakUntil(p, q), until(true, a, b)),
            4 => (Path::Next(Box::new(Path::Not(p))), next(not(&a))),
            5 => (Path::Next(Box::new(Path::Next(p))), next(next(a))),
            _ => (Path::Not(p), not(&a)),
        }
    });
    prop_oneof![
        pair.prop_map(|(path, formula)| (path, Some(formula))),
        random_formula::path(atoms()).prop_map(|path| (path, None)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: support::agreement::programs(300), max_global_rejects: 100_000, ..ProptestConfig::default() })]

    /// A verdict on a part of the states is one on all of them, and a verdict on all of them is the textbook's.
    #[test]
    fn verdicts_on_parts_of_programs(
        text in random_program::text(4),
        device in proptest::option::of(random_program::device()),
        formulas in proptest::collection::vec(said_twice(), 6),
        constraints in proptest::collection::vec(constraint(), 0..3),
        states in 1..24_u64,
    ) {
        let system = random_program::system(support::program(&text), device.as_ref());
        let Some(whole) = Whole::of(&system) else { return Err(TestCaseError::reject("too large")) };
        let words = "assumed".to_owned();
        let assumed = FairnessAssumption { words, constraints, speaks_of_time: false };
        let named = parse_requirement("r", &Source::new("formula", "TRUE")).unwrap();
        let asked = |formula: Bound| (named.clone(), Demand::Formula(formula));
        let requirements: Vec<(Requirement, Demand)> = formulas
            .iter()
            .flat_map(|(path, twin)| {
                let path = Bound::Ltl(Box::new(path.clone()));
                [asked(path.clone()), asked(twin.clone().unwrap_or(path))]
            })
            .collect();
        let judged = |states: u64| {
            let budget = Budget { states, ..Budget::default() };
            let options = Options { fairness: vec![assumed.clone()], budget, ..Options::default() };
            let report = check(&system, &requirements, &options, &mut |_| None);
            report.answers.iter().map(|answer| answer.outcome.verdict()).collect::<Vec<_>>()
        };
        let (part, all) = (judged(states), judged(u64::MAX));
        for (i, (path, _)) in formulas.iter().enumerate() {
            let Some(expected) = whole.verdict(path, &assumed) else { continue };
            prop_assert_eq!(all[2 * i], expected, "of LTL, {:?}", path);
            prop_assert_eq!(all[2 * i + 1], expected, "of CTL, {:?}", path);
            // What follows a formula along the paths has the same limit of states, so CTL may know more, but not the other way round.
            prop_assert!(part[2 * i] == Verdict::Unknown || part[2 * i] == part[2 * i + 1], "LTL and CTL, {:?}", path);
            prop_assert!(part[2 * i] == Verdict::Unknown || part[2 * i] == expected, "on a part, {:?}", path);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, max_global_rejects: 100_000, ..ProptestConfig::default() })]

    #[test]
    fn on_whole_graphs(given in given_of(5, 3), formula in formula()) {
        agree(&given, &formula, &Masks { weak: vec![], strong: vec![] }, u64::MAX)?;
    }

    #[test]
    fn under_fairness(given in given_of(5, 3), formula in formula(), masks in masks()) {
        agree(&given, &formula, &masks, u64::MAX)?;
    }

    #[test]
    fn on_parts_of_graphs((given, states) in given_in_part(5, 3), formula in formula(), masks in masks()) {
        agree(&given, &formula, &masks, states)?;
    }

    /// Some formulas say the same in CTL.
    #[test]
    fn as_ctl_does(given in given_of(8, 4), masks in masks()) {
        let [a, b] = [0, 1].map(|v| Bound::Variable(VarId(v)));
        let [p, q] = [&a, &b].map(|f| Box::new(Path::State(f.clone())));
        let (yes, no) = (Bound::Truth(true), Bound::Truth(false));
        let eventually = until(false, yes.clone(), b.clone());
        let response = Bound::Implies(Box::new(a.clone()), Box::new(eventually.clone()));
        let next = Bound::Next(All, Box::new(b.clone()));
        let pairs = [
            (Path::Globally(p.clone()), until(true, a.clone(), no.clone())),
            (Path::Finally(q.clone()), eventually),
            (Path::Until(p.clone(), q.clone()), until(false, a.clone(), b.clone())),
            (Path::WeakUntil(p.clone(), q.clone()), until(true, a, b)),
            (Path::Globally(Box::new(Path::Implies(p, Box::new(Path::Finally(q.clone()))))), until(true, response, no)),
            (Path::Next(q), next),
        ];
        for (path, formula) in pairs {
            let (graph, found) = searched(&given, &path, &masks, u64::MAX);
            let holds = matches!(found, Search::None);
            prop_assert_eq!(holds, label_says(&given, &graph, &masks, &formula), "{:?}", path);
        }
    }
}

/// F G p is not AF AG p: from a state with p one can always still go through one without it, but then never again.
#[test]
fn what_holds_on_every_path_need_not_hold_in_any_state_of_it() {
    let marks = vec![1, 0, 1];
    let successors = vec![vec![0, 1], vec![2], vec![2]];
    let given = Given { flavours: 1, successors, marks, initial: vec![0], shared: false, hidden: vec![false; 3] };
    let p = Bound::Variable(VarId(0));
    let path = Path::Finally(Box::new(Path::Globally(Box::new(Path::State(p.clone())))));
    let none = Masks { weak: vec![], strong: vec![] };
    let (graph, found) = searched(&given, &path, &none, u64::MAX);
    assert!(matches!(found, Search::None), "{found:?}");
    let always = until(true, p, Bound::Truth(false));
    assert!(!label_says(&given, &graph, &none, &until(false, Bound::Truth(true), always)));
}

/// In the last state of a path X f is true, whatever f is, as AX f is in CTL.
#[test]
fn a_path_may_end() {
    let given = Given {
        flavours: 1,
        successors: vec![vec![]],
        marks: vec![0],
        initial: vec![0],
        shared: false,
        hidden: vec![false],
    };
    let p = || Box::new(Path::State(Bound::Variable(VarId(0))));
    let none = Masks { weak: vec![1 << 5], strong: vec![] };
    let holds = |path: Formula| matches!(searched(&given, &path, &none, u64::MAX).1, Search::None);
    assert!(holds(Path::Next(p())));
    assert!(!holds(Path::Not(Box::new(Path::Next(p())))));
    assert!(!holds(Path::Finally(p())));
    assert!(holds(Path::Globally(Box::new(Path::Not(p())))));
    assert!(!holds(Path::Until(p(), p())));
}

/// The shortest run to where a request is never answered: p comes, and q never again.
#[test]
fn a_counterexample_has_the_shortest_way_to_its_cycle() {
    // 0 -> 0, 0 -> 1 (p) -> 2 -> 2, 2 -> 3 (q) -> 0
    let (marks, successors) = (vec![0, 1, 0, 2], vec![vec![0, 1], vec![2], vec![2, 3], vec![0]]);
    let given = Given { flavours: 1, successors, marks, initial: vec![0], shared: false, hidden: vec![false; 4] };
    let [p, q] = [0, 1].map(|v| Box::new(Path::State(Bound::Variable(VarId(v)))));
    let response = Path::Globally(Box::new(Path::Implies(p, Box::new(Path::Finally(q)))));
    let none = Masks { weak: vec![], strong: vec![] };
    let (graph, Search::Found(found)) = searched(&given, &response, &none, u64::MAX) else { panic!("it is violated") };
    let names: Vec<usize> = found.states.iter().map(|&id| given.name(&graph, id)).collect();
    assert_eq!((names, found.loop_start), (vec![0, 1, 2], Some(2)));
    // Where state 3 comes again and again, so does q, and nothing is left unanswered.
    let again = Masks { weak: vec![1 << 3], strong: vec![] };
    assert!(matches!(searched(&given, &response, &again, u64::MAX).1, Search::None));
    // So it is if whoever waits for ever is answered; staying in 0 remains possible.
    let strong = Masks { weak: vec![], strong: vec![(1 << 2, 1 << 3)] };
    assert!(matches!(searched(&given, &response, &strong, u64::MAX).1, Search::None));
}

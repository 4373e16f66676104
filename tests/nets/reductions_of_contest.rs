//! Properties of the Model Checking Contest, each answered on a net reduced for it: the answers are those that others agreed
//! on, and what is found is lifted to the original. `PETRIL_DATA` names the folder that holds the data, with the contest's
//! archives in `mcc/`; without it nothing is tested.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::exchange::mcc::Query;
use petril::explore::engine::{Model, Options, View, explore};
use petril::explore::{Budget, Stop};
use petril::logic::{Bound, Quantifier, Term, Valuation, bind_in_net};
use petril::net::{Net, PlaceId, Tokens, TransitionId};
use petril::semantics::VarId;
use petril::structure::reduce::{Keep, Property, Reduced, Size, reduce};
use support::contest::{Instance, instances};

/// What a formula about one state sees.
fn seen(formula: &Bound, keep: &mut Keep) {
    match formula {
        Bound::Marked(place) => keep.places.push(*place),
        Bound::Enabled(transition) => keep.transitions.push(*transition),
        Bound::Deadlock => keep.property = Property::Deadlock,
        Bound::Compare(_, left, right) => [left, right].into_iter().for_each(|term| seen_by_term(term, keep)),
        Bound::Not(f) => seen(f, keep),
        Bound::And(f, g) | Bound::Or(f, g) | Bound::Implies(f, g) | Bound::Iff(f, g) => {
            [f, g].into_iter().for_each(|f| seen(f, keep));
        }
        Bound::Truth(_) => {}
        Bound::Variable(_) | Bound::Bit(..) | Bound::Next(..) | Bound::Until { .. } | Bound::Ltl(_) => {
            panic!("not about one marking")
        }
    }
}

fn seen_by_term(term: &Term, keep: &mut Keep) {
    match term {
        Term::Number(_) => {}
        Term::Tokens(place) => keep.places.push(*place),
        Term::Truth(f) => seen(f, keep),
        Term::Sum(a, b) | Term::Difference(a, b) | Term::Product(a, b) => {
            [a, b].into_iter().for_each(|term| seen_by_term(term, keep));
        }
        Term::Variable(..) | Term::Bits { .. } | Term::Past(_) => panic!("a net has no variables"),
    }
}

/// A state of the reduced net, for formulas about the original.
struct Through<'a>(&'a Net, &'a Reduced<'a>, &'a View<'a>);

impl Valuation for Through<'_> {
    fn value(&self, _: VarId) -> u64 {
        0
    }
    fn is_marked(&self, place: PlaceId) -> bool {
        self.tokens(place) > 0
    }
    fn tokens(&self, place: PlaceId) -> u64 {
        self.2.tokens(self.1.place(place).unwrap().index())
    }
    fn is_enabled(&self, transition: TransitionId) -> bool {
        match self.1.transition(transition) {
            Some(reduced) => self.2.is_enabled(reduced.index()),
            None => self.0.pre(transition).all(|(place, weight)| self.tokens(place) >= weight),
        }
    }
    fn is_deadlock(&self) -> bool {
        self.2.is_deadlock()
    }
}

/// A marking of the original.
struct Played<'a>(&'a Net, &'a Tokens);

impl Valuation for Played<'_> {
    fn value(&self, _: VarId) -> u64 {
        0
    }
    fn is_marked(&self, place: PlaceId) -> bool {
        self.tokens(place) > 0
    }
    fn tokens(&self, place: PlaceId) -> u64 {
        self.1.on(place)
    }
    fn is_enabled(&self, transition: TransitionId) -> bool {
        self.0.has_concession(self.1, transition)
    }
    fn is_deadlock(&self) -> bool {
        self.0.transition_ids().all(|transition| !self.is_enabled(transition))
    }
}

/// States of the original and of the reduced net, at most.
const MOST: u64 = 100_000;

/// The figures of an answer: nodes of the reduced net, states searched there, firings found there and lifted.
struct Answer {
    word: &'static str,
    size: Size,
    states: u64,
    firings: Option<(usize, usize)>,
}

/// Whether a marking is reachable where a formula is `wanted`; nothing if there are too many states.
fn is_reachable(net: &Net, formula: &Bound, wanted: bool) -> Option<Answer> {
    let mut keep = Keep::nothing(Property::Reachability);
    seen(formula, &mut keep);
    let reduced = reduce(net, &keep);
    let options = Options { budget: Budget { states: MOST, ..Budget::default() }, keep: true, ..Options::default() };
    let is_wanted = |view: &View<'_>| formula.holds_in(&Through(net, &reduced, view)) == Some(wanted);
    let exploration = explore(&Model::from(&reduced.net), &options, &mut |_| None, Some(&is_wanted));
    let (size, states) = (Size::of(&reduced.net), exploration.figures.states);
    let Some(marking) = &exploration.found else {
        let word = if wanted { "FALSE" } else { "TRUE" };
        return (exploration.stop == Stop::Complete).then_some(Answer { word, size, states, firings: None });
    };
    let run: Vec<TransitionId> = exploration.firings(marking).unwrap().into_iter().map(TransitionId::at).collect();
    let lifted = reduced.lift(&run).unwrap_or_else(|error| panic!("{error}"));
    let mut tokens = net.initial_tokens();
    for &id in &lifted {
        assert!(net.has_concession(&tokens, id));
        net.play(&mut tokens, id).unwrap();
    }
    assert_eq!(formula.holds_in(&Played(net, &tokens)), Some(wanted));
    let firings = Some((run.len(), lifted.len()));
    Some(Answer { word: if wanted { "TRUE" } else { "FALSE" }, size, states, firings })
}

#[test]
fn answers_on_reduced_nets_are_those_of_the_contest() {
    let folder = tempfile::TempDir::new().unwrap();
    let (all, mut checked) = (instances(folder.path()), 0);
    for instance in all.iter().map(|folder| Instance::of(folder)) {
        let (name, net, nodes) = (&instance.name, &instance.located.net, instance.nodes());
        let mut questions: Vec<(String, Bound, bool, String)> = Vec::new();
        for (file, short) in [("ReachabilityCardinality", "RC"), ("ReachabilityFireability", "RF")] {
            for (property, expected) in instance.properties(file).iter().zip(instance.answers(short)) {
                let Query::Holds(formula) = &property.query else { continue };
                match bind_in_net(formula, &nodes).unwrap() {
                    Bound::Until { quantifier: Quantifier::Some, release, .. } => {
                        questions.push((property.id.clone(), *release, true, expected));
                    }
                    Bound::Until { hold, .. } => {
                        questions.push((property.id.clone(), *hold, false, expected));
                    }
                    _ => {}
                }
            }
        }
        let expected = instance.answers("RD").into_iter();
        questions.extend(expected.map(|expected| ("deadlock".to_owned(), Bound::Deadlock, true, expected)));
        let before = Size::of(net);
        for (id, formula, wanted, expected) in questions {
            let Some(answer) = is_reachable(net, &formula, wanted) else { continue };
            assert_eq!(answer.word, expected, "{name}: {id}");
            checked += 1;
            let after = answer.size;
            println!(
                "{name} {id} {} {} of {} places, {} of {} transitions, {} states {:?}",
                answer.word,
                after.places,
                before.places,
                after.transitions,
                before.transitions,
                answer.states,
                answer.firings
            );
        }
    }
    assert!(all.is_empty() || checked > 300, "{checked}");
}

//! Automaton of an LTL formula: a generalised Büchi automaton by the tableau of Couvreur (1999). Its states, called
//! modes, are the ways in which a set of formulas can be true in one state and continue.

use std::collections::{BTreeMap, BTreeSet};

use super::formula::Path;
use crate::bound::Bound;

/// Position of a formula in negation normal form.
type Id = usize;

/// A formula in negation normal form.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Part {
    Truth(bool),
    /// An atom or its negation.
    Literal(usize, bool),
    And(Id, Id),
    Or(Id, Id),
    /// Next; `strong` if there must be a next state.
    Next {
        strong: bool,
        f: Id,
    },
    Until(Id, Id),
    WeakUntil(Id, Id),
}

/// Mode: a state of the automaton.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Mode {
    /// Atoms that must be true or false in the state.
    pub literals: BTreeMap<usize, bool>,
    /// Obligations from the next state on, as a position in [`Automaton::ways`].
    pub next: u32,
    /// Whether the path may end in the state.
    pub may_end: bool,
    /// Untils postponed to a later state.
    pub put_off: BTreeSet<usize>,
}

/// Generalised Büchi automaton that also accepts finite paths. A path satisfies the formula if it ends in a mode that
/// may end, or is infinite and postpones no until for ever.
#[derive(Debug)]
pub struct Automaton {
    /// Distinct atoms.
    pub atoms: Vec<Bound>,
    /// Distinct modes.
    pub modes: Vec<Mode>,
    /// Modes that satisfy each set of obligations. The whole formula comes first.
    pub ways: Vec<Vec<u32>>,
    /// Untils, each an acceptance condition.
    pub untils: BTreeSet<usize>,
}

/// Maximum number of modes. Formulas written by hand have tens.
const MAX_MODES: usize = 20_000;

impl Automaton {
    /// Builds the automaton of a formula, or of its negation; `None` if it would be too large.
    pub fn of(formula: &Path<Bound>, negated: bool) -> Option<Self> {
        let mut parts = Parts::default();
        let root = parts.add(formula, negated);
        let mut automaton = Self { atoms: Vec::new(), modes: Vec::new(), ways: Vec::new(), untils: BTreeSet::new() };
        let mut wanted: Vec<BTreeSet<Id>> = vec![BTreeSet::from([root])];
        let mut modes: BTreeMap<Mode, u32> = BTreeMap::new();
        let mut known: BTreeMap<BTreeSet<Id>, u32> = BTreeMap::from([(wanted[0].clone(), 0)]);
        while let Some(wants) = wanted.get(automaton.ways.len()).cloned() {
            let mut ways = Vec::new();
            for way in parts.ways(&wants)? {
                let number = *known.entry(way.next.clone()).or_insert_with(|| {
                    wanted.push(way.next.clone());
                    wanted.len() as u32 - 1
                });
                let Way { literals, may_end, put_off, .. } = way;
                let mode = Mode { literals, next: number, may_end, put_off };
                let new = automaton.modes.len() as u32;
                let mode_number = *modes.entry(mode.clone()).or_insert(new);
                if mode_number == new {
                    automaton.modes.push(mode);
                }
                ways.push(mode_number);
            }
            automaton.ways.push(ways);
            if automaton.modes.len() > MAX_MODES {
                return None;
            }
        }
        automaton.untils = automaton.modes.iter().flat_map(|mode| mode.put_off.iter().copied()).collect();
        automaton.atoms = parts.atoms;
        Some(automaton)
    }
}

/// A mode under construction, with its obligations as formulas.
#[derive(Clone, Debug)]
struct Way {
    literals: BTreeMap<usize, bool>,
    next: BTreeSet<Id>,
    may_end: bool,
    put_off: BTreeSet<Id>,
    /// Formulas that have been expanded.
    done: BTreeSet<Id>,
}

impl Way {
    /// Whether every path accepted by this way is accepted by the other one.
    fn asks_no_less_than(&self, other: &Self) -> bool {
        let literals = other.literals.iter().all(|(atom, value)| self.literals.get(atom) == Some(value));
        let rest = other.next.is_subset(&self.next) && other.put_off.is_subset(&self.put_off);
        literals && rest && (other.may_end || !self.may_end)
    }
}

#[derive(Default)]
struct Parts {
    parts: Vec<Part>,
    known: BTreeMap<Part, Id>,
    /// Formulas that were added, by address, which does not change meanwhile.
    added: BTreeMap<(*const Path<Bound>, bool), Id>,
    atoms: Vec<Bound>,
}

impl Parts {
    fn put(&mut self, part: Part) -> Id {
        let next = self.parts.len();
        let id = *self.known.entry(part).or_insert(next);
        if id == next {
            self.parts.push(part);
        }
        id
    }

    /// Adds an until or its negation: ¬(f U g) = ¬g W (¬f ∧ ¬g), and ¬(f W g) = ¬g U (¬f ∧ ¬g).
    fn until(&mut self, weak: bool, negated: bool, f: Id, g: Id) -> Id {
        let (f, g) = if negated { (g, self.put(Part::And(f, g))) } else { (f, g) };
        self.put(if weak == negated { Part::Until(f, g) } else { Part::WeakUntil(f, g) })
    }

    fn add(&mut self, formula: &Path<Bound>, negated: bool) -> Id {
        let key = (std::ptr::from_ref(formula), negated);
        if let Some(&id) = self.added.get(&key) {
            return id;
        }
        let id = self.add_new(formula, negated);
        self.added.insert(key, id);
        id
    }

    fn add_new(&mut self, formula: &Path<Bound>, negated: bool) -> Id {
        let junction = |and: bool, f, g| if and { Part::And(f, g) } else { Part::Or(f, g) };
        match formula {
            Path::State(Bound::Truth(value)) => self.put(Part::Truth(*value != negated)),
            Path::State(atom) => {
                let known = self.atoms.iter().position(|known| known == atom);
                let number = known.unwrap_or(self.atoms.len());
                if known.is_none() {
                    self.atoms.push(atom.clone());
                }
                self.put(Part::Literal(number, !negated))
            }
            Path::Not(f) => self.add(f, !negated),
            Path::And(f, g) | Path::Or(f, g) => {
                let and = matches!(formula, Path::And(..)) != negated;
                let (f, g) = (self.add(f, negated), self.add(g, negated));
                self.put(junction(and, f, g))
            }
            Path::Implies(f, g) => {
                let (f, g) = (self.add(f, !negated), self.add(g, negated));
                self.put(junction(negated, f, g))
            }
            Path::Iff(f, g) => {
                // f <-> g is (f ∧ g) ∨ (¬f ∧ ¬g); its negation (f ∧ ¬g) ∨ (¬f ∧ g).
                let (both, neither) =
                    ((self.add(f, false), self.add(g, negated)), (self.add(f, true), self.add(g, !negated)));
                let (both, neither) = (self.put(Part::And(both.0, both.1)), self.put(Part::And(neither.0, neither.1)));
                self.put(Part::Or(both, neither))
            }
            Path::Next(f) => {
                let f = self.add(f, negated);
                self.put(Part::Next { strong: negated, f })
            }
            Path::Finally(f) | Path::Globally(f) => {
                let weak = matches!(formula, Path::Globally(_));
                let (f, constant) = (self.add(f, negated), self.put(Part::Truth(weak == negated)));
                let (hold, release) = if weak { (f, constant) } else { (constant, f) };
                self.until(weak, negated, hold, release)
            }
            Path::Until(f, g) | Path::WeakUntil(f, g) => {
                let (f, g) = (self.add(f, negated), self.add(g, negated));
                self.until(matches!(formula, Path::WeakUntil(..)), negated, f, g)
            }
            Path::Release(f, g) => {
                // f R g is g W (f ∧ g).
                let (f, g) = (self.add(f, negated), self.add(g, negated));
                let both = self.put(junction(!negated, f, g));
                self.until(true, negated, g, both)
            }
        }
    }

    /// Ways in which a set of formulas can be true in a state and continue, without those subsumed by another one.
    /// `None` if there are too many.
    fn ways(&self, wanted: &BTreeSet<Id>) -> Option<Vec<Way>> {
        let none = BTreeSet::new();
        let start =
            Way { literals: BTreeMap::new(), next: none.clone(), may_end: true, put_off: none.clone(), done: none };
        let mut work = vec![(start, wanted.iter().rev().copied().collect::<Vec<Id>>())];
        let mut found: Vec<Way> = Vec::new();
        while let Some((mut way, mut wanted)) = work.pop() {
            let Some(id) = wanted.pop() else {
                if !found.iter().any(|other| way.asks_no_less_than(other)) {
                    found.retain(|other| !other.asks_no_less_than(&way));
                    found.push(way);
                }
                continue;
            };
            if work.len() + found.len() > MAX_MODES {
                return None;
            }
            if !way.done.insert(id) {
                work.push((way, wanted));
                continue;
            }
            match self.parts[id] {
                Part::Truth(false) => continue,
                Part::Truth(true) => {}
                Part::Literal(atom, value) => {
                    if way.literals.insert(atom, value).is_some_and(|before| before != value) {
                        continue;
                    }
                }
                Part::And(f, g) => wanted.extend([g, f]),
                Part::Or(f, g) => {
                    let other = [wanted.as_slice(), &[g]].concat();
                    work.push((way.clone(), other));
                    wanted.push(f);
                }
                Part::Next { strong, f } => {
                    way.next.insert(f);
                    way.may_end &= !strong;
                }
                Part::Until(f, g) | Part::WeakUntil(f, g) => {
                    let mut later = way.clone();
                    later.next.insert(id);
                    if matches!(self.parts[id], Part::Until(..)) {
                        later.may_end = false;
                        later.put_off.insert(id);
                    }
                    let other = [wanted.as_slice(), &[f]].concat();
                    work.push((later, other));
                    wanted.push(g);
                }
            }
            work.push((way, wanted));
        }
        Some(found)
    }
}

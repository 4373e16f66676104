//! Random specifications.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use petril::sif::sanity::{Doubt, Finding, check, counts, never};
use petril::sif::{Formula, Kind, Scope, SignalId, Specification};
use proptest::prelude::*;

use super::textbook::{Change, State, Textbook, holds};
use super::{message, read};

/// A formula as text over these names.
fn formula(names: Vec<&'static str>, depth: u32) -> BoxedStrategy<String> {
    let leaf = prop_oneof![
        20 => prop::sample::select(names).prop_map(str::to_owned),
        1 => Just("TRUE".to_owned()),
        1 => Just("FALSE".to_owned()),
    ];
    leaf.prop_recursive(depth, 12, 3, |inner| {
        let two = prop::sample::select(vec!["&", "&", "&", "|", "|", "|", "xor", "->", "<->"]);
        let among = prop::sample::select(vec!["at most one of", "exactly one of", "at least one of"]);
        prop_oneof![
            3 => inner.clone().prop_map(|inner| format!("!({inner})")),
            6 => (two, inner.clone(), inner.clone()).prop_map(|(operator, a, b)| format!("({a}) {operator} ({b})")),
            1 => (among, prop::collection::vec(inner, 1..4)).prop_map(|(among, of)| format!("{among} ({})", of.join(", "))),
        ]
    })
    .boxed()
}

fn restriction() -> BoxedStrategy<String> {
    let names = vec!["a", "b", "c", "d"];
    let pair = (prop::sample::select(names.clone()), prop::sample::select(names.clone()));
    prop_oneof![
        4 => pair.clone().prop_map(|(a, b)| format!("never {a} & {b}")),
        2 => pair.clone().prop_map(|(a, b)| format!("always {a} -> {b}")),
        1 => pair.prop_map(|(a, b)| format!("exactly one of {a}, {b}")),
        2 => formula(names, 2).prop_map(|formula| format!("always {formula}")),
        1 => formula(vec!["a", "b", "P", "x"], 2).prop_map(|formula| format!("never {formula}")),
    ]
    .boxed()
}

fn specification() -> impl Strategy<Value = String> {
    let first = (
        formula(vec!["a", "b", "c", "T"], 3),
        formula(vec!["a", "b", "d"], 2),
        formula(vec!["a", "b", "c", "T"], 3),
        // A reset that names what it resets may leave open what is kept.
        prop::option::weighted(0.3, formula(vec!["c", "d", "a"], 1)),
        prop::collection::vec(restriction(), 0..2),
    );
    let second = (
        formula(vec!["a", "b", "P", "d"], 3),
        any::<bool>(),
        prop::collection::vec(restriction(), 0..2),
        formula(vec!["P", "c", "Q", "Q", "a"], 2),
    );
    let outer = (prop::collection::vec(restriction(), 0..3), prop::collection::vec(restriction(), 0..2));
    (first, second, outer).prop_map(|(first, second, (system, zone))| {
        let (p, t, p2, reset, own) = first;
        let (q, is_delayed, own_of_q, r) = second;
        let mut text = String::from("input x; input d;\n");
        let mut count = 0;
        let mut say = |text: &mut String, all: &[String]| {
            for restriction in all {
                count += 1;
                let _ = writeln!(text, "restriction R{count}: {restriction};");
            }
        };
        say(&mut text, &system);
        text += "zone Z {\n";
        say(&mut text, &zone);
        let latched = reset.map(|reset| format!(" latched until {reset}")).unwrap_or_default();
        let _ =
            writeln!(text, "function F {{ interface {{ input a; input b; input c; output P{latched}; output P2; }}");
        let _ = writeln!(text, "formal {{ P = {p}; P2 = {p2}; T = {t};");
        say(&mut text, &own);
        let delayed = if is_delayed { " delayed T#1s" } else { "" };
        let _ = writeln!(text, "}} }}\nfunction G {{ interface {{ output Q{delayed}; }} formal {{ Q = {q};");
        say(&mut text, &own_of_q);
        text += "} } }\n";
        let _ = writeln!(text, "function H {{ interface {{ input a; input P; output R; }} formal {{ R = {r}; }} }}");
        text
    })
}

/// Whether a state has what an example says, where it says something.
fn fits(state: &State, finding: &Finding) -> bool {
    let example = finding.example.as_ref().unwrap();
    example.values.iter().all(|(id, value)| state.seen[id.0] == *value)
}

struct Judge<'s> {
    book: Textbook<'s>,
    findings: Vec<Finding>,
    text: &'s str,
}

impl Judge<'_> {
    fn specification(&self) -> &Specification {
        self.book.specification
    }

    fn found(&self, doubt: Doubt) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(move |finding| finding.doubt == doubt)
    }

    fn fail(&self, why: &str) -> ! {
        let said: Vec<String> = self.findings.iter().map(|finding| message(self.specification(), finding)).collect();
        panic!("{why}\n{}\nsaid: {said:#?}", self.text);
    }

    fn check(&self, is_so: bool, why: &str) {
        if !is_so {
            self.fail(why);
        }
    }

    /// A finding says that something cannot be: its core is one, and its example shows what it says.
    fn explains(&self, finding: &Finding, core: &[usize], so: impl Fn(&State) -> bool, within: &[usize]) {
        let said = message(self.specification(), finding);
        self.check(self.book.is_core(core, &so), &format!("the core of {said}"));
        let Some(example) = &finding.example else {
            return self.check(core.is_empty(), &format!("no example of {said}"));
        };
        self.check(example.is_excluded != core.is_empty(), &format!("the kind of example of {said}"));
        let shows = |state: &State| {
            fits(state, finding)
                && if core.is_empty() {
                    self.book.keeps(state, within)
                } else {
                    so(state) && !self.book.keeps(state, core)
                }
        };
        self.check(self.book.states.iter().any(shows), &format!("the example of {said}: {example:?}"));
    }

    fn is_sound(&self, function: usize) -> bool {
        self.book.can(&self.book.of(Scope::Function(function)), |_| true)
    }

    /// Restrictions, all kinds. Whether anything else is to be looked at.
    fn restrictions(&self) -> bool {
        let specification = self.specification();
        let mut broken = Vec::new();
        if !self.book.can(&self.book.of(Scope::System), |_| true) {
            broken.push(Scope::System);
        } else {
            broken.extend(
                (0..specification.zones.len())
                    .map(Scope::Zone)
                    .filter(|scope| !self.book.can(&self.book.of(*scope), |_| true)),
            );
            for function in 0..specification.functions.len() {
                let zone = specification.functions[function].zone;
                let is_zone_broken = zone.is_some_and(|zone| broken.contains(&Scope::Zone(zone)));
                if !is_zone_broken && !self.is_sound(function) {
                    broken.push(Scope::Function(function));
                }
            }
        }
        self.check(self.found(Doubt::Contradiction).count() == broken.len(), "contradictions");
        for finding in self.found(Doubt::Contradiction) {
            self.check(self.book.is_core(&finding.restrictions, |_| true), "the core of a contradiction");
            let scope = finding.function.map(Scope::Function);
            self.check(scope.is_none_or(|scope| broken.contains(&scope)), "whose contradiction it is");
            if let Some(example) = &finding.example {
                let (_, others) = finding.restrictions.split_last().unwrap();
                let shows = |state: &State| fits(state, finding) && self.book.keeps(state, others);
                self.check(self.book.states.iter().any(shows), &format!("the example {example:?}"));
            }
        }
        if broken.contains(&Scope::System) {
            self.check(self.findings.len() == 1, "more than the contradiction is said");
            return false;
        }
        // Implied: the last first.
        let mut left: Vec<usize> = (0..specification.restrictions.len()).collect();
        let mut implied = BTreeSet::new();
        for at in (0..specification.restrictions.len()).rev() {
            let restriction = &specification.restrictions[at];
            let mut others = self.book.of(restriction.scope);
            if !self.book.can(&others, |_| true) {
                continue;
            }
            others.retain(|other| *other != at && left.contains(other));
            if !self.book.can(&others, |state| !holds(&restriction.allowed, &state.seen)) {
                implied.insert(at);
                left.retain(|other| *other != at);
            }
        }
        let found: BTreeSet<usize> = self.found(Doubt::Implied).map(|finding| finding.restrictions[0]).collect();
        self.check(found == implied, &format!("implied: {implied:?}"));
        for finding in self.found(Doubt::Implied) {
            let allowed = &specification.restrictions[finding.restrictions[0]].allowed;
            let core = &finding.restrictions[1..];
            self.check(self.book.is_core(core, |state| !holds(allowed, &state.seen)), "the core of an implied one");
            self.check(finding.example.is_some() != core.is_empty(), "the example of an implied one");
            if finding.example.is_some() {
                let shows = |state: &State| fits(state, finding) && !holds(allowed, &state.seen);
                self.check(self.book.states.iter().any(shows), "the example of an implied one");
            }
        }
        true
    }

    fn constants(&self) -> Vec<SignalId> {
        let specification = self.specification();
        let mut constant = Vec::new();
        for (at, function) in specification.functions.iter().enumerate().filter(|(at, _)| self.is_sound(*at)) {
            let kept = self.book.of(Scope::Function(at));
            for &output in &function.outputs {
                let of = self.found(Doubt::Constant).find(|finding| finding.signals == [output]);
                let is = |value: bool| !self.book.can(&kept, |state| state.formula[output.0] != value);
                let expected = [false, true].into_iter().find(|value| is(*value));
                self.check(of.map(|finding| finding.value) == expected, "constant outputs");
                let Some(finding) = of else { continue };
                self.explains(finding, &finding.restrictions, |s| s.formula[output.0] != finding.value, &kept);
                constant.push(output);
            }
        }
        let total = self.found(Doubt::Constant).count();
        self.check(total == constant.len(), "constants of functions without valuations");
        constant
    }

    fn resets(&self, constant: &[SignalId]) {
        for (at, function) in self.specification().functions.iter().enumerate() {
            let kept = self.book.of(Scope::Function(at));
            for &output in &function.outputs {
                let is_latched =
                    matches!(&self.specification().signal(output).kind, Kind::Defined { latched: Some(_), .. });
                let resets = |state: &State| state.reset[output.0] && !state.formula[output.0];
                let expected =
                    is_latched && self.is_sound(at) && !constant.contains(&output) && !self.book.can(&kept, resets);
                let of = self.found(Doubt::ResetNever).find(|finding| finding.signals == [output]);
                self.check(of.is_some() == expected, "resets");
                if let Some(finding) = of {
                    self.explains(finding, &finding.restrictions, resets, &kept);
                }
            }
        }
    }

    /// The inputs without effect, and those that are not used.
    fn inputs(&self, constant: &[SignalId]) -> Vec<SignalId> {
        let specification = self.specification();
        let mut used = BTreeSet::new();
        for signal in &specification.signals {
            if let Kind::Defined { formula, latched, .. } = &signal.kind {
                used.extend(formula.signals());
                used.extend(latched.iter().flat_map(Formula::signals));
            }
        }
        let unused: Vec<SignalId> = specification.inputs().filter(|input| !used.contains(input)).collect();
        let found: Vec<SignalId> = self.found(Doubt::InputNotUsed).map(|finding| finding.signals[0]).collect();
        self.check(found == unused, "unused inputs");
        let mut without = Vec::new();
        for input in specification.inputs().filter(|input| used.contains(input)) {
            let has_effect = |function: usize| {
                if !self.below_function(function).contains(&input) {
                    return false;
                }
                let outputs = &specification.functions[function].outputs;
                if !self.is_sound(function) || outputs.iter().any(|output| constant.contains(output)) {
                    return true;
                }
                let kept = self.book.of(Scope::Function(function));
                self.book.can(&kept, |state| self.book.differs(state, outputs, Change::Input(input)))
            };
            if !(0..specification.functions.len()).any(has_effect) {
                without.push(input);
            }
        }
        let found: Vec<SignalId> = self.found(Doubt::InputWithoutEffect).map(|finding| finding.signals[0]).collect();
        self.check(BTreeSet::from_iter(&found) == BTreeSet::from_iter(&without), "inputs without effect");
        without
    }

    /// All that a function is computed from, resets too.
    fn below_function(&self, function: usize) -> BTreeSet<SignalId> {
        self.below(self.specification().functions[function].equations.clone())
    }

    fn below(&self, mut left: Vec<SignalId>) -> BTreeSet<SignalId> {
        let mut found = BTreeSet::new();
        while let Some(id) = left.pop() {
            if found.insert(id)
                && let Kind::Defined { formula, latched, .. } = &self.specification().signal(id).kind
            {
                left.extend(formula.signals());
                left.extend(latched.iter().flat_map(Formula::signals));
            }
        }
        found
    }

    /// Causes, and the signals in those that are removed.
    fn causes(&self, constant: &[SignalId]) -> BTreeSet<SignalId> {
        let mut removed = BTreeSet::new();
        for function in (0..self.specification().functions.len()).filter(|at| self.is_sound(*at)) {
            let kept = self.book.of(Scope::Function(function));
            for &output in self.specification().functions[function].outputs.iter().filter(|o| !constant.contains(o)) {
                let mut expected: BTreeSet<Vec<bool>> = BTreeSet::new();
                let causes = self.book.causes(function, output);
                let mut gone = vec![false; causes.len()];
                let table =
                    |formula: &Formula| self.book.states.iter().map(|s| holds(formula, &s.seen)).collect::<Vec<_>>();
                for (at, (cause, beside, within)) in causes.iter().enumerate() {
                    if within.iter().any(|outer| gone[*outer]) {
                        continue;
                    }
                    let with_output = |state: &State| holds(cause, &state.seen) && state.formula[output.0];
                    let makes = |state: &State| {
                        holds(cause, &state.seen) && beside.iter().all(|other| holds(other, &state.seen))
                    };
                    let all: Vec<Formula> = std::iter::once(cause).chain(beside).cloned().collect();
                    if !self.book.can(&kept, with_output) && self.book.can(&[], with_output) {
                        gone[at] = true;
                        expected.insert(table(cause));
                    } else if !self.book.can(&kept, makes) && self.book.can(&[], makes) {
                        gone[at] = true;
                        expected.insert(table(&Formula::Gate(petril::sif::Operator::And, all)));
                    }
                    if gone[at] {
                        removed.extend(self.book.below(cause));
                    }
                }
                let found = self.found(Doubt::CauseRemoved).filter(|finding| finding.signals == [output]);
                let found: BTreeSet<Vec<bool>> =
                    found.map(|finding| table(finding.formula.as_ref().unwrap())).collect();
                self.check(found == expected, &format!("causes of {}", self.specification().name(output)));
            }
        }
        for finding in self.found(Doubt::CauseRemoved) {
            let (output, cause) = (finding.signals[0], finding.formula.as_ref().unwrap());
            let kept = self.book.of(Scope::Function(finding.function.unwrap()));
            let makes = |state: &State| holds(cause, &state.seen) && state.formula[output.0];
            self.explains(finding, &finding.restrictions, makes, &kept);
            removed.extend(self.book.below(cause));
        }
        removed
    }

    fn literals(&self, constant: &[SignalId], without: &[SignalId], removed: &BTreeSet<SignalId>) {
        let specification = self.specification();
        let mut findings = self.found(Doubt::NeverDecides).count();
        for function in (0..specification.functions.len()).filter(|at| self.is_sound(*at)) {
            let kept = self.book.of(Scope::Function(function));
            let outputs = specification.functions[function].outputs.iter().copied();
            let roots: Vec<SignalId> = outputs.filter(|output| !constant.contains(output)).collect();
            for (occurrence, signal) in self.book.occurrences(function) {
                let decides = |state: &State| self.book.differs(state, &roots, Change::Occurrence(occurrence));
                let is_so = !self.book.can(&kept, decides) && self.book.can(&[], decides);
                let same: Vec<_> = self
                    .book
                    .occurrences(function)
                    .into_iter()
                    .filter(|(other, of)| (other.0, other.1) == (occurrence.0, occurrence.1) && *of == signal)
                    .collect();
                let nth =
                    (same.len() > 1).then(|| 1 + same.iter().position(|(other, _)| *other == occurrence).unwrap());
                let is_it = |finding: &&Finding| finding.signals == [occurrence.0, signal] && finding.nth == nth;
                // A reset and a formula may have the same literal.
                let found: Vec<&Finding> = self
                    .found(Doubt::NeverDecides)
                    .filter(is_it)
                    .filter(|finding| self.book.is_core(&finding.restrictions, decides))
                    .collect();
                if is_so && found.is_empty() {
                    let is_explained =
                        removed.contains(&signal) || removed.contains(&occurrence.0) || without.contains(&signal);
                    self.check(
                        is_explained,
                        &format!("{} of {}", specification.name(signal), specification.name(occurrence.0)),
                    );
                }
                if let (true, Some(finding)) = (is_so, found.first()) {
                    self.explains(finding, &finding.restrictions, decides, &kept);
                    findings = findings.saturating_sub(1);
                }
            }
        }
        self.check(findings == 0, "literals that do decide");
    }

    fn same(&self, constant: &[SignalId]) {
        let specification = self.specification();
        let mut plain = Vec::new();
        for (at, function) in specification.functions.iter().enumerate().filter(|(at, _)| self.is_sound(*at)) {
            for &output in function.outputs.iter().filter(|output| !constant.contains(output)) {
                if let Kind::Defined { latched: None, delayed: None, .. } = &specification.signal(output).kind {
                    plain.push((output, at));
                }
            }
        }
        let told: Vec<SignalId> = self.found(Doubt::Same).map(|finding| finding.signals[1]).collect();
        for (at, &(a, of_a)) in plain.iter().enumerate() {
            for &(b, of_b) in &plain[at + 1..] {
                let zone = specification.functions[of_a].zone;
                let scope = match zone {
                    _ if of_a == of_b => Scope::Function(of_a),
                    Some(zone) if specification.functions[of_b].zone == Some(zone) => Scope::Zone(zone),
                    _ => Scope::System,
                };
                let kept = self.book.of(scope);
                let otherwise = |same: bool| move |state: &State| (state.formula[a.0] == state.formula[b.0]) != same;
                let found = self.found(Doubt::Same).find(|finding| finding.signals == [a, b]);
                for value in [true, false] {
                    if !self.book.can(&kept, otherwise(value)) {
                        self.check(
                            found.is_some() || told.contains(&a) || told.contains(&b),
                            "outputs that are the same",
                        );
                    }
                }
                if let Some(finding) = found {
                    self.explains(finding, &finding.restrictions, otherwise(finding.value), &kept);
                }
            }
        }
    }

    /// What is a matter of names only: interfaces, and restrictions apart.
    fn names(&self) {
        let specification = self.specification();
        let mut apart = BTreeSet::new();
        for (at, restriction) in specification.restrictions.iter().enumerate() {
            let inputs = |formula: &Formula| {
                let below = self.book.below(formula);
                below.into_iter().filter(|id| specification.definition(*id).is_none()).collect::<BTreeSet<_>>()
            };
            let is_about = |function: &usize| self.book.of(Scope::Function(*function)).contains(&at);
            let reaches = |function: usize| {
                let mut seen: BTreeSet<SignalId> = self.below_function(function);
                loop {
                    let before = seen.len();
                    for other in self.book.of(Scope::Function(function)) {
                        let allowed = &specification.restrictions[other].allowed;
                        if inputs(allowed).iter().any(|input| seen.contains(input)) {
                            seen.extend(self.below(allowed.signals()));
                        }
                    }
                    if seen.len() == before {
                        break;
                    }
                }
                inputs(&restriction.allowed).iter().any(|input| seen.contains(input))
            };
            let has_inputs = !inputs(&restriction.allowed).is_empty();
            if has_inputs && !(0..specification.functions.len()).filter(is_about).any(reaches) {
                apart.insert(at);
            }
        }
        let found: BTreeSet<usize> = self.found(Doubt::Apart).map(|finding| finding.restrictions[0]).collect();
        self.check(found == apart, &format!("restrictions apart: {apart:?}"));
        // Whatever F and H list and do not use.
        let unused: Vec<SignalId> = self.found(Doubt::InputNotUsed).map(|finding| finding.signals[0]).collect();
        for (at, function) in specification.functions.iter().enumerate() {
            let mut uses = BTreeSet::new();
            for &id in &function.equations {
                let Kind::Defined { formula, latched, .. } = &specification.signal(id).kind else { continue };
                uses.extend(formula.signals());
                uses.extend(latched.iter().flat_map(Formula::signals));
            }
            let own = specification.restrictions.iter().filter(|other| other.scope == Scope::Function(at));
            let restricted: BTreeSet<SignalId> = own.flat_map(|other| other.allowed.signals()).collect();
            let is_idle = |id: &&SignalId| !uses.contains(id) && !restricted.contains(id) && !unused.contains(id);
            let idle: BTreeSet<&SignalId> = function.inputs.iter().filter(is_idle).collect();
            let of = self.found(Doubt::InputListed).filter(|finding| finding.function == Some(at));
            self.check(of.flat_map(|finding| &finding.signals).collect::<BTreeSet<_>>() == idle, "listed, not used");
            let is_missing = |id: &&SignalId| !function.inputs.contains(id) && !function.equations.contains(id);
            let missing: BTreeSet<&SignalId> =
                if function.inputs.is_empty() { BTreeSet::new() } else { uses.iter().filter(is_missing).collect() };
            let of = self.found(Doubt::InputNotListed).filter(|finding| finding.function == Some(at));
            self.check(of.flat_map(|finding| &finding.signals).collect::<BTreeSet<_>>() == missing, "used, not listed");
        }
    }

    /// How many valuations there are: of the output's own inputs, whatever the others are.
    fn counts(&self) {
        let specification = self.specification();
        let inputs: Vec<SignalId> = specification.inputs().collect();
        let settled: Vec<_> = (0..1_u32 << inputs.len())
            .map(|number| {
                let ones = inputs.iter().enumerate().filter(|(at, _)| number >> at & 1 == 1);
                specification.settled(&specification.valuation(ones.map(|(_, input)| *input)))
            })
            .collect();
        // Where restrictions contradict each other, those that have nothing to do with a function are not counted.
        for function in (0..specification.functions.len()).filter(|at| self.is_sound(*at)) {
            let kept = self.book.of(Scope::Function(function));
            for counts in counts(specification, function, &never()) {
                let own: BTreeSet<SignalId> = self
                    .book
                    .below(specification.definition(counts.output).unwrap())
                    .into_iter()
                    .filter(|id| specification.definition(*id).is_none())
                    .collect();
                let different = |so: &dyn Fn(&fixedbitset::FixedBitSet) -> bool| {
                    let those = settled.iter().filter(|all| all.contains(counts.output.0) && so(all));
                    those
                        .map(|all| own.iter().map(|id| all.contains(id.0)).collect::<Vec<_>>())
                        .collect::<BTreeSet<_>>()
                        .len()
                };
                let keeps = |all: &fixedbitset::FixedBitSet, at: &usize| {
                    specification.restrictions[*at].allowed.holds(|id| all.contains(id.0))
                };
                let triggers = different(&|_| true);
                self.check(counts.inputs == own.len(), "inputs that are counted");
                self.check(counts.triggers == Some(triggers.to_string()), "valuations that are TRUE");
                let left = different(&|all| kept.iter().all(|at| keeps(all, at)));
                self.check(counts.left == Some(left.to_string()), &format!("{left} are left, not {:?}", counts.left));
                for excluded in &counts.excluded {
                    let alone = triggers - different(&|all| keeps(all, &excluded.restriction));
                    self.check(excluded.by_itself == Some(alone.to_string()), "excluded by one");
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]
    #[test]
    fn all_that_is_so_is_said_and_nothing_else(text in specification()) {
        let specification = read(&text);
        let findings = check(&specification, &never());
        let judge = Judge { book: Textbook::new(&specification), findings, text: &text };
        prop_assert!(judge.found(Doubt::NotDecided).next().is_none());
        judge.counts();
        if judge.restrictions() {
            let constant = judge.constants();
            judge.resets(&constant);
            let without = judge.inputs(&constant);
            let removed = judge.causes(&constant);
            judge.literals(&constant, &without, &removed);
            judge.same(&constant);
            judge.names();
        }
    }
}

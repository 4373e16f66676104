//! Expected and actual behaviour at a violation, in words: the requirement as its author wrote it is followed along the
//! run to the state formula that decides.

use super::Broken;
use super::decisive::{Literal, decisive};
use petril_lang::semantics::VarId;
use petril_logic::{Bound, Dag, Past, Quantifier, Term, along};

/// Upper bound on sentences, and on values in one sentence.
const MOST: usize = 4;

/// Explanation of a violation: sentences, and the variables it depends on, each with the position in the run where its
/// value counts.
#[derive(Default)]
pub struct Wanted {
    pub sentences: Vec<String>,
    pub literals: Vec<(usize, VarId)>,
}

/// Explains the violation of a requirement.
pub fn wanted(broken: &Broken<'_>) -> Wanted {
    let mut teller = Teller { broken, leads: Vec::new(), told: Wanted::default() };
    teller.tell(broken.formula, false, 0);
    teller.told
}

struct Teller<'a> {
    broken: &'a Broken<'a>,
    /// Reasons for the expectation: facts, each with its position.
    leads: Vec<(usize, String)>,
    told: Wanted,
}

impl Teller<'_> {
    fn length(&self) -> usize {
        self.broken.evidence.states.len()
    }

    /// Successor of a position, if the run continues.
    fn next(&self, at: usize) -> Option<usize> {
        if at + 1 < self.length() { Some(at + 1) } else { self.broken.evidence.loop_start }
    }

    /// Whether a state formula holds at a position.
    fn holds(&self, formula: &Bound, at: usize) -> bool {
        self.broken.view.holds(formula, self.broken.graph.state(self.broken.evidence.states[at]))
    }

    /// Positions at which the run shows that a formula has this value. Subformulas about all paths are looked up in the
    /// labelling of the whole requirement.
    fn shown(&self, formula: &Bound, value: bool) -> Vec<bool> {
        let Broken { dag: whole, labels, evidence, .. } = *self.broken;
        let mut dag = Dag::default();
        let node = dag.add(formula, !value);
        let everywhere = |id, at: usize| {
            let claim = dag.formula(id);
            let mut same = whole.ids().filter(|&known| whole.is_universal(known) && whole.formula(known) == claim);
            same.next().is_some_and(|known| labels.of(known).contains(evidence.states[at] as usize))
        };
        let run = (self.length(), evidence.loop_start);
        let mut truths = along(&dag, run, &|formula, at| self.holds(formula, at), &everywhere);
        truths.swap_remove(node.index())
    }

    fn text(&self, formula: &Bound) -> String {
        formula.text(self.broken.view.system())
    }

    /// A formula without its negations, and the word for its value when the whole has this one.
    fn stripped(&self, formula: &Bound, value: bool) -> (String, &'static str) {
        match formula {
            Bound::Not(inner) => self.stripped(inner, !value),
            _ => (format!("`{}`", self.text(formula)), truth(value)),
        }
    }

    /// Explains why a formula should not have this value at a position.
    fn tell(&mut self, formula: &Bound, value: bool, at: usize) {
        if formula.is_state_formula() {
            return self.tell_state(formula, value, at);
        }
        match (formula, value) {
            (Bound::Not(f), _) => self.tell(f, !value, at),
            (Bound::Implies(premise, conclusion), false) => {
                self.lead(premise, at);
                self.tell(conclusion, false, at);
            }
            // One operand suffices; take one that the run shows.
            (Bound::And(f, g), false) | (Bound::Or(f, g), true) => {
                let part = if self.shown(f, value)[at] || !self.shown(g, value)[at] { f } else { g };
                self.tell(part, value, at);
            }
            (Bound::And(f, g), true) if f.is_state_formula() => {
                self.lead(f, at);
                self.tell(g, true, at);
            }
            (Bound::Or(f, g), false) if f.is_state_formula() => {
                self.lead(&Bound::Not(f.clone()), at);
                self.tell(g, false, at);
            }
            (Bound::Next(quantifier, f), _) if one_run_shows(*quantifier, value) => match self.next(at) {
                Some(next) => self.tell(f, value, next),
                None => self.tell_whole(formula, value, at),
            },
            (Bound::Until { quantifier, weak, hold, release }, false) if one_run_shows(*quantifier, false) => {
                self.tell_until(formula, (hold, release, *weak), at);
            }
            (Bound::Until { quantifier, release, .. }, true) if one_run_shows(*quantifier, true) => {
                let released = self.shown(release, true);
                match self.onward(at).into_iter().find(|&at| released[at]) {
                    Some(at) => self.tell(release, true, at),
                    None => self.tell_whole(formula, true, at),
                }
            }
            _ => self.tell_whole(formula, value, at),
        }
    }

    /// Positions reachable from one on, each once, in order of time.
    fn onward(&self, at: usize) -> Vec<usize> {
        // A loop leads back to earlier positions, once.
        let again = self.broken.evidence.loop_start.map_or(at, |start| start.min(at));
        (at..self.length()).chain(again..at).collect()
    }

    /// Explains why `A [hold U release]` or `A [hold W release]` is false.
    fn tell_until(&mut self, formula: &Bound, (hold, release, weak): (&Bound, &Bound, bool), at: usize) {
        let (ended, unreleased) = (self.shown(hold, false), self.shown(release, false));
        let way = self.onward(at);
        let is_open = *release != Bound::Truth(false);
        match way.iter().copied().find(|&at| ended[at]) {
            Some(end) if way.iter().take_while(|&&at| at != end).chain([&end]).all(|&at| unreleased[at]) => {
                if is_open {
                    let (text, value) = self.stripped(release, true);
                    self.leads.push((end, format!("{text} has not become {value}")));
                }
                self.tell(hold, false, end);
            }
            None if !weak && way.iter().all(|&at| unreleased[at]) => {
                let last = self.length() - 1;
                let (text, value) = self.stripped(release, true);
                self.say(at, &format!("{text} had to become {value}"), "it never does");
                self.rest(release, last);
            }
            _ => self.tell_whole(formula, false, at),
        }
    }

    /// Explains a formula that no single run can show.
    fn tell_whole(&mut self, formula: &Bound, value: bool, at: usize) {
        let text = self.text(formula);
        match (formula, value) {
            (Bound::Until { quantifier: Quantifier::Some, weak: false, hold, release }, false)
                if **hold == Bound::Truth(true) =>
            {
                let (text, becomes) = self.stripped(release, true);
                let wanted = format!("it had to be possible that {text} becomes {becomes}");
                self.say(at, &wanted, "it is not, whatever happens");
                self.rest(release, at);
            }
            (_, false) => self.say(at, &format!("`{text}` had to hold"), "it does not"),
            (_, true) => self.say(at, &format!("`{text}` was not to hold"), "it does"),
        }
    }

    /// Adds a reason for the expectation.
    fn lead(&mut self, formula: &Bound, at: usize) {
        if !matches!(formula, Bound::Truth(_)) {
            let (text, value) = self.stripped(formula, true);
            self.leads.push((at, format!("{text} is {value}")));
        }
        if formula.is_state_formula() && self.broken.evidence.states.len() == at + 1 {
            self.rest(formula, at);
        }
    }

    /// Records the decisive variables of a formula at a position.
    fn rest(&mut self, formula: &Bound, at: usize) {
        if formula.is_state_formula() {
            for literal in decisive(formula, &|part| self.holds(part, at)) {
                match literal {
                    Literal::Now(variable) => self.told.literals.push((at, variable)),
                    Literal::Before(variable) if at > 0 => self.told.literals.push((at - 1, variable)),
                    Literal::Before(_) => {}
                    Literal::Past(formula) => {
                        let variables = formula.mentions().variables;
                        self.told.literals.extend(variables.into_iter().map(|variable| (at, variable)));
                    }
                }
            }
        }
    }

    /// Explains why a state formula should not have this value.
    fn tell_state(&mut self, formula: &Bound, value: bool, at: usize) {
        match (formula, value) {
            (Bound::Not(f), _) => self.tell_state(f, !value, at),
            (Bound::Implies(premise, conclusion), false) if **conclusion != Bound::Truth(false) => {
                let leads = self.leads.len();
                self.lead(premise, at);
                self.rest(premise, at);
                self.tell_state(conclusion, false, at);
                self.leads.truncate(leads);
            }
            (Bound::And(f, g), false) | (Bound::Or(f, g), true) => {
                for part in [f, g] {
                    if self.holds(part, at) == value {
                        self.tell_state(part, value, at);
                    }
                }
            }
            _ => self.tell_literal(formula, value, at),
        }
    }

    /// Explains a formula that does not get its value from one operand.
    fn tell_literal(&mut self, formula: &Bound, value: bool, at: usize) {
        self.rest(formula, at);
        let text = self.text(formula);
        if is_atom(formula) {
            let (had, is) = if value { ("FALSE", "TRUE") } else { ("TRUE", "FALSE") };
            return self.say(at, &format!("`{text}` had to be {had}"), &format!("it is {is}"));
        }
        let wanted = if value { format!("`{text}` was not to hold") } else { format!("`{text}` had to hold") };
        let facts = self.facts(formula, at);
        self.say(at, &wanted, if facts.is_empty() { "that cannot be" } else { &facts });
    }

    /// Decisive values of a formula in words: "`a` is TRUE and `Level` is 80".
    fn facts(&self, formula: &Bound, at: usize) -> String {
        let literals = decisive(formula, &|part| self.holds(part, at));
        let mut facts: Vec<String> = literals.iter().take(MOST).filter_map(|literal| self.fact(literal, at)).collect();
        if literals.len() > MOST {
            facts.push(format!("{} more", literals.len() - MOST));
        }
        enumerated(&facts)
    }

    fn fact(&self, literal: &Literal, at: usize) -> Option<String> {
        let program = &self.broken.view.system().program;
        let words = |id: VarId, value: u64| match (program.variable(id).ty.is_bool(), value) {
            (true, value) => truth(value == 1).to_owned(),
            (false, value) => program.value_text(id, value),
        };
        let value = |id: VarId, at: usize| {
            let scans = self.broken.view.scans()?;
            let (end, _) = scans.parts(self.broken.graph.state(self.broken.evidence.states[at]));
            Some(words(id, scans.base().space.value(end, id)))
        };
        Some(match literal {
            Literal::Now(id) => format!("`{}` is {}", program.variable(*id).name, value(*id, at)?),
            Literal::Before(id) => {
                let variable = program.variable(*id);
                let earlier = match at.checked_sub(1) {
                    Some(earlier) => value(*id, earlier)?,
                    None => words(*id, variable.initial),
                };
                format!("`{}` was {earlier}", variable.name)
            }
            Literal::Past(formula) => format!("`{}` is {}", self.text(formula), truth(self.holds(formula, at))),
        })
    }

    /// Adds a sentence: reasons, expected value, actual value. Each scan is named once.
    fn say(&mut self, at: usize, wanted: &str, there_was: &str) {
        if self.told.sentences.len() >= MOST {
            return;
        }
        let mut named = None;
        let mut place = |first: usize, last: usize| match named.replace((first, last)) {
            Some(before) if before == (first, last) => String::new(),
            _ if first == last => format!("after scan {} ", first + 1),
            _ => format!("after scans {} to {} ", first + 1, last + 1),
        };
        // A fact about consecutive scans is stated once.
        let mut leads: Vec<(usize, usize, &str)> = Vec::new();
        for (at, what) in &self.leads {
            match leads.last_mut() {
                Some((_, last, said)) if said == what && *last + 1 == *at => *last = *at,
                _ => leads.push((*at, *at, what)),
            }
        }
        let leads: Vec<String> =
            leads.into_iter().map(|(first, last, what)| format!("{}{what}", place(first, last))).collect();
        let so = if leads.is_empty() { String::new() } else { format!("{}, so ", enumerated(&leads)) };
        let sentence = format!("{so}{}{wanted}, but {there_was}", place(at, at));
        let mut letters = sentence.chars();
        let first = letters.next().map(|letter| letter.to_uppercase().to_string()).unwrap_or_default();
        self.told.sentences.push(first + letters.as_str());
    }
}

/// Whether a formula is stated as something true or false by itself.
fn is_atom(formula: &Bound) -> bool {
    match formula {
        Bound::Variable(_) | Bound::Bit(..) => true,
        Bound::Compare(_, Term::Past(past), Term::Number(_)) => past.is_truth() || matches!(**past, Past::Run { .. }),
        _ => false,
    }
}

fn truth(value: bool) -> &'static str {
    if value { "TRUE" } else { "FALSE" }
}

/// Whether one run can show that a formula with this quantifier has this value.
fn one_run_shows(quantifier: Quantifier, value: bool) -> bool {
    (quantifier == Quantifier::All) != value
}

/// "a", "a and b", "a, b and c".
fn enumerated(parts: &[String]) -> String {
    match parts {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

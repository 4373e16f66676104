//! Requirements that hold whatever the program does, such as tautologies.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

use crate::requirement::Assumption;
use crate::translate::System;
use petril_lang::semantics::Role;
use petril_logic::Bound;

/// Reason why a requirement holds independently of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Independence {
    /// Tautology: true of every system, as `a | !a` is.
    OfEverything,
    /// Property of the plant alone: only inputs are mentioned, and they do not depend on the program's outputs.
    OfTheProgram,
}

/// Upper bound on the number of propositional parts whose valuations are all tried.
const MOST: usize = 12;

/// Independence of a requirement that holds, judged from its formula.
pub fn independence(formula: &Bound, system: &System, assumptions: &[Assumption]) -> Option<Independence> {
    if is_always_true(formula) {
        return Some(Independence::OfEverything);
    }
    let variables = formula.mentions().variables;
    // An assumption about inputs may mention outputs, too.
    let assumed = assumptions.iter().flat_map(|assumption| assumption.formula.mentions().variables);
    let alone = variables.iter().copied().chain(assumed).all(|variable| {
        let devices = system.plant.driver(variable).map(|device| &system.plant.components[device]);
        let reacts = devices.is_some_and(|device| device.transitions.iter().any(|t| !t.tests.is_empty()));
        system.program.variable(variable).role == Role::Input && !reacts
    });
    (alone && !variables.is_empty()).then_some(Independence::OfTheProgram)
}

/// Whether a formula is a tautology, by its structure. Every state of a system has a step, so no path ends.
fn is_always_true(formula: &Bound) -> bool {
    match formula {
        Bound::Next(_, f) => is_always_true(f),
        Bound::Until { weak, hold, release, .. } => is_always_true(release) || (*weak && is_always_true(hold)),
        Bound::And(f, g) => is_always_true(f) && is_always_true(g),
        Bound::Implies(_, g) if is_always_true(g) => true,
        Bound::Or(f, g) if is_always_true(f) || is_always_true(g) => true,
        _ => {
            let mut parts = BTreeMap::new();
            collect(formula, &mut parts);
            let count = parts.len();
            count <= MOST && (0..1_u32 << count).all(|values| value(formula, &parts, values))
        }
    }
}

/// Numbers the maximal subformulas without an outer Boolean operator.
fn collect(formula: &Bound, parts: &mut BTreeMap<String, usize>) {
    match formula {
        Bound::Truth(_) => {}
        Bound::Not(f) => collect(f, parts),
        Bound::And(f, g) | Bound::Or(f, g) | Bound::Implies(f, g) | Bound::Iff(f, g) => {
            collect(f, parts);
            collect(g, parts);
        }
        _ => {
            let number = parts.len();
            parts.entry(format!("{formula:?}")).or_insert(number);
        }
    }
}

/// Value of a formula under a valuation of its parts.
fn value(formula: &Bound, parts: &BTreeMap<String, usize>, values: u32) -> bool {
    let of = |f: &Bound| value(f, parts, values);
    match formula {
        Bound::Truth(truth) => *truth,
        Bound::Not(f) => !of(f),
        Bound::And(f, g) => of(f) && of(g),
        Bound::Or(f, g) => of(f) || of(g),
        Bound::Implies(f, g) => !of(f) || of(g),
        Bound::Iff(f, g) => of(f) == of(g),
        _ => parts.get(&format!("{formula:?}")).is_some_and(|number| values >> number & 1 == 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use petril_lang::semantics::VarId;
    use petril_logic::Quantifier;

    fn not(f: &Bound) -> Bound {
        Bound::Not(Box::new(f.clone()))
    }

    fn and(f: &Bound, g: &Bound) -> Bound {
        Bound::And(Box::new(f.clone()), Box::new(g.clone()))
    }

    fn or(f: &Bound, g: &Bound) -> Bound {
        Bound::Or(Box::new(f.clone()), Box::new(g.clone()))
    }

    fn implies(f: &Bound, g: &Bound) -> Bound {
        Bound::Implies(Box::new(f.clone()), Box::new(g.clone()))
    }

    fn until(weak: bool, hold: &Bound, release: &Bound) -> Bound {
        let (hold, release) = (Box::new(hold.clone()), Box::new(release.clone()));
        Bound::Until { quantifier: Quantifier::All, weak, hold, release }
    }

    #[test]
    fn a_formula_is_true_of_everything_if_its_parts_make_no_difference() {
        let [a, b] = [0, 1].map(|id| Bound::Variable(VarId(id)));
        let (yes, no) = (Bound::Truth(true), Bound::Truth(false));
        let iff = |f: &Bound, g: &Bound| Bound::Iff(Box::new(f.clone()), Box::new(g.clone()));
        let next = |f: &Bound| Bound::Next(Quantifier::Some, Box::new(f.clone()));
        let (either, globally) = (or(&a, &not(&a)), |f: &Bound| until(true, f, &no));
        let always = globally(&or(&b, &not(&b)));
        let true_of_everything = [
            yes.clone(),
            or(&no, &yes),
            either.clone(),
            implies(&a, &a),
            implies(&and(&a, &b), &b),
            implies(&and(&a, &b), &a),
            implies(&a, &or(&b, &a)),
            iff(&a, &a),
            iff(&and(&a, &b), &and(&b, &a)),
            or(&and(&a, &b), &or(&not(&a), &not(&b))),
            // Temporal parts are true of everything, or they are parts like others.
            always.clone(),
            and(&either, &always),
            or(&always, &a),
            or(&a, &always),
            implies(&a, &always),
            next(&either),
            until(false, &a, &either),
            until(true, &either, &a),
            or(&globally(&a), &not(&globally(&a))),
        ];
        for formula in &true_of_everything {
            assert!(is_always_true(formula), "{formula:?}");
        }
        let true_of_some = [
            no.clone(),
            and(&yes, &no),
            a.clone(),
            not(&a),
            or(&a, &b),
            implies(&a, &b),
            implies(&or(&a, &b), &b),
            implies(&or(&a, &b), &a),
            iff(&a, &b),
            iff(&a, &not(&a)),
            and(&either, &b),
            and(&b, &either),
            and(&always, &globally(&a)),
            or(&globally(&a), &b),
            implies(&a, &globally(&b)),
            next(&a),
            until(false, &either, &a),
            until(true, &a, &b),
        ];
        for formula in &true_of_some {
            assert!(!is_always_true(formula), "{formula:?}");
        }
    }

    /// The values of 12 parts are tried, those of 13 are not.
    #[test]
    fn the_values_of_many_parts_are_not_tried() {
        let all_imply_the_first = |count: usize| {
            let parts: Vec<Bound> = (0..count).map(|id| Bound::Variable(VarId(id))).collect();
            let all = parts[1..].iter().fold(parts[0].clone(), |all, part| and(&all, part));
            implies(&all, &parts[0])
        };
        assert!(is_always_true(&all_imply_the_first(MOST)));
        assert!(!is_always_true(&all_imply_the_first(MOST + 1)));
    }
}

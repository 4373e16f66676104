//! Representative values of inputs: one for each class of values that neither the program nor the requirements
//! distinguish.
//!
//! Two values of a free input with the same result in every comparison made with it lead to the same values of all
//! other variables, and make the same formulas true: states that differ only in them are bisimilar. So one of them is
//! enough (data abstraction).

use crate::translate::{Domain, Domains, System};
use petril_lang::flat::{Cuts, FlatProgram};
use petril_lang::semantics::VarId;
use petril_logic::{Bound, Term};
use petril_logic::{Comparison, Past};

/// Computes representative values for each free input without a domain that the program and the formulas, which are
/// bound for the scan view, only compare with constants.
#[must_use]
pub fn representatives(system: &System, formulas: &[&Bound]) -> Domains {
    let program = &system.program;
    let open = system.free_inputs().filter(|&input| {
        let variable = program.variable(input);
        !variable.ty.is_bool() && variable.bits == variable.ty.width && !system.domains.contains_key(&input)
    });
    let tested: Vec<VarId> = system.plant.tested().collect();
    open.filter(|input| !tested.contains(input))
        .filter_map(|input| Some((input, domain(program, input, &cuts(program, input, formulas)?)?)))
        .collect()
}

/// Cuts between distinguishable values of an input; `None` if it is not only compared with constants.
fn cuts(program: &FlatProgram, input: VarId, formulas: &[&Bound]) -> Option<Cuts> {
    let mut cuts = program.compared(input)?;
    formulas.iter().all(|formula| add(formula, input, &mut cuts)).then_some(cuts)
}

/// Domain of the value nearest to 0 of each interval between two cuts.
fn domain(program: &FlatProgram, input: VarId, cuts: &Cuts) -> Option<Domain> {
    let ty = program.variable(input).ty;
    let mut values = Vec::new();
    let mut from = ty.least();
    let ends = cuts.iter().copied().filter(|&cut| ty.holds(cut) && cut < ty.greatest());
    for to in ends.chain([ty.greatest()]) {
        let nearest = 0.clamp(from, to);
        values.push((nearest, nearest));
        from = to + 1;
    }
    Domain::new(ty, values).map(Domain::standing_for_all)
}

/// Adds the cuts of an input by a formula; returns whether the formula only compares it with constants.
fn add(formula: &Bound, input: VarId, cuts: &mut Cuts) -> bool {
    match formula {
        Bound::Truth(_) | Bound::Marked(_) | Bound::Enabled(_) | Bound::Deadlock => true,
        Bound::Variable(variable) | Bound::Bit(variable, _) => *variable != input,
        Bound::Compare(comparison, left, right) => {
            let compared = match (left, right) {
                (term, other) if is_input(term, input) => Some((*comparison, other)),
                (other, term) if is_input(term, input) => Some((mirrored(*comparison), other)),
                _ => None,
            };
            match compared {
                Some((comparison, other)) => match constant(other) {
                    Some(number) => {
                        cuts.extend(told_apart(comparison, number));
                        true
                    }
                    None => false,
                },
                None => add_term(left, input, cuts) && add_term(right, input, cuts),
            }
        }
        Bound::Not(f) | Bound::Next(_, f) => add(f, input, cuts),
        Bound::And(f, g) | Bound::Or(f, g) | Bound::Implies(f, g) | Bound::Iff(f, g) => {
            add(f, input, cuts) && add(g, input, cuts)
        }
        Bound::Until { hold, release, .. } => add(hold, input, cuts) && add(release, input, cuts),
        Bound::Ltl(path) => path.atoms().into_iter().all(|atom| add(atom, input, cuts)),
    }
}

/// Whether a term is the current or an earlier value of the input; the same cuts apply to both.
fn is_input(term: &Term, input: VarId) -> bool {
    match term {
        Term::Variable(variable, _) => *variable == input,
        Term::Past(past) => matches!(&**past, Past::Before(before) if is_input(before, input)),
        _ => false,
    }
}

/// Adds the cuts of an input by a term that is not the input itself; returns whether the term only compares it with
/// constants.
fn add_term(term: &Term, input: VarId, cuts: &mut Cuts) -> bool {
    match term {
        Term::Number(_) | Term::Tokens(_) => true,
        Term::Variable(variable, _) | Term::Bits { variable, .. } => *variable != input,
        Term::Truth(f) => add(f, input, cuts),
        Term::Past(past) => match &**past {
            Past::First => true,
            Past::Before(term) => add_term(term, input, cuts),
            Past::Since(f, g) => add(f, input, cuts) && add(g, input, cuts),
            Past::Run { of, .. } => add(of, input, cuts),
        },
        Term::Sum(a, b) | Term::Difference(a, b) | Term::Product(a, b) => {
            add_term(a, input, cuts) && add_term(b, input, cuts)
        }
    }
}

/// Value of a constant term.
fn constant(term: &Term) -> Option<i128> {
    match term {
        Term::Number(number) => Some(*number),
        Term::Variable(..) | Term::Bits { .. } | Term::Tokens(_) | Term::Truth(_) | Term::Past(_) => None,
        Term::Sum(a, b) => constant(a)?.checked_add(constant(b)?),
        Term::Difference(a, b) => constant(a)?.checked_sub(constant(b)?),
        Term::Product(a, b) => constant(a)?.checked_mul(constant(b)?),
    }
}

/// Cuts by the comparison of a number with a constant on its right. Constants of formulas have about 64 bits, products
/// of them at most 126.
fn told_apart(comparison: Comparison, number: i128) -> Vec<i128> {
    match comparison {
        Comparison::Greater | Comparison::AtMost => vec![number],
        Comparison::AtLeast | Comparison::Less => vec![number - 1],
        Comparison::Equal | Comparison::Unequal => vec![number - 1, number],
    }
}

/// Comparison with its sides exchanged.
fn mirrored(comparison: Comparison) -> Comparison {
    match comparison {
        Comparison::Greater => Comparison::Less,
        Comparison::AtLeast => Comparison::AtMost,
        Comparison::Less => Comparison::Greater,
        Comparison::AtMost => Comparison::AtLeast,
        Comparison::Equal | Comparison::Unequal => comparison,
    }
}

//! Faults, tests and coverage by their definitions: every mutant is a formula of its own, every valuation is tried.

use std::collections::BTreeSet;

use fixedbitset::FixedBitSet;
use petril::sif::{Formula, Kind, Operator, SignalId, Specification};

/// A formula in which nothing is negated twice.
pub fn plain(formula: &Formula) -> Formula {
    match formula {
        Formula::Not(inner) => match plain(inner) {
            Formula::Not(twice) => *twice,
            other => Formula::Not(Box::new(other)),
        },
        Formula::Gate(operator, operands) => Formula::Gate(*operator, operands.iter().map(plain).collect()),
        other => other.clone(),
    }
}

/// The opposite, not negated twice.
fn not(formula: &Formula) -> Formula {
    plain(&Formula::Not(Box::new(formula.clone())))
}

fn is_literal(formula: &Formula) -> bool {
    matches!(formula, Formula::Signal(_))
        || matches!(formula, Formula::Not(inner) if matches!(**inner, Formula::Signal(_)))
}

/// All faults of a formula: the class, and the formula with it. `names` may be put in.
pub fn mutants(formula: &Formula, names: &[SignalId]) -> Vec<(&'static str, Formula)> {
    let mut found = Vec::new();
    let whole = plain(formula);
    inside(&whole, names, true, &|with| with, &mut |class, mutant| {
        if mutant != whole && !found.contains(&(class, mutant.clone())) {
            found.push((class, mutant));
        }
    });
    found
}

type Context<'c> = &'c dyn Fn(Formula) -> Formula;

/// The faults of a part, which stands in a context.
fn inside(
    part: &Formula,
    names: &[SignalId],
    is_whole: bool,
    around: Context<'_>,
    found: &mut dyn FnMut(&'static str, Formula),
) {
    if matches!(part, Formula::Constant(_))
        || matches!(part, Formula::Not(inner) if matches!(**inner, Formula::Constant(_)))
    {
        return;
    }
    if is_whole {
        found("expression negation", around(not(part)));
    }
    found("stuck at FALSE", around(Formula::Constant(false)));
    found("stuck at TRUE", around(Formula::Constant(true)));
    if is_literal(part) {
        found("literal negation", around(not(part)));
        for name in names.iter().filter(|name| part.signals()[0] != **name) {
            found("literal reference", around(Formula::Signal(*name)));
            found("literal reference", around(Formula::Not(Box::new(Formula::Signal(*name)))));
        }
        return;
    }
    if !is_whole {
        found("term negation", around(not(part)));
    }
    if let Formula::Not(inner) = part {
        // What is done to the gate is done below the negation.
        gate(inner, names, &|with| around(Formula::Not(Box::new(with))), found);
    } else {
        gate(part, names, around, found);
    }
}

fn gate(part: &Formula, names: &[SignalId], around: Context<'_>, found: &mut dyn FnMut(&'static str, Formula)) {
    use Operator::{And, AtMostOne, ExactlyOne, Iff, Implies, Or, Xor};
    let Formula::Gate(operator, operands) = part else { return };
    let make = |operator: Operator, operands: Vec<Formula>| around(Formula::Gate(operator, operands));
    let turned: Vec<Formula> = operands.iter().rev().cloned().collect();
    if operands.len() > 1 {
        match operator {
            And => found("operator", make(Or, operands.clone())),
            Or => [And, Xor].iter().for_each(|other| found("operator", make(*other, operands.clone()))),
            Xor => {
                let two = [Or, And, Iff];
                let others = if operands.len() == 2 { &two[..] } else { &two[..2] };
                others.iter().for_each(|other| found("operator", make(*other, operands.clone())));
            }
            Implies => {
                [Iff, And, Or].iter().for_each(|other| found("operator", make(*other, operands.clone())));
                found("operator", make(Implies, turned));
            }
            Iff => {
                [Xor, Implies].iter().for_each(|other| found("operator", make(*other, operands.clone())));
                found("operator", make(Implies, turned));
            }
            AtMostOne => [ExactlyOne, Or].iter().for_each(|other| found("operator", make(*other, operands.clone()))),
            ExactlyOne => {
                [AtMostOne, Or, Xor].iter().for_each(|other| found("operator", make(*other, operands.clone())));
            }
        }
    }
    for (at, operand) in operands.iter().enumerate() {
        if matches!(operator, And | Or | Xor) && operands.len() > 1 {
            let class = if is_literal(operand) { Some("literal omission") } else { Some("term omission") };
            let mut fewer = operands.clone();
            fewer.remove(at);
            class.into_iter().for_each(|class| found(class, make(*operator, fewer.clone())));
        }
        let there = |with: Formula| {
            let mut all = operands.clone();
            all[at] = with;
            make(*operator, all)
        };
        inside(operand, names, false, &there, found);
    }
    if matches!(operator, And | Or) {
        for name in names {
            for literal in [Formula::Signal(*name), Formula::Not(Box::new(Formula::Signal(*name)))] {
                if !operands.contains(&literal) {
                    let more = operands.iter().cloned().chain([literal]).collect();
                    found("literal insertion", make(*operator, more));
                }
            }
        }
    }
}

/// Puts something into a place of a formula.
type Put = Box<dyn Fn(Formula) -> Formula>;

/// The occurrences of literals in a formula: each as what makes of a constant the formula with this in its place.
pub fn occurrences(formula: &Formula) -> Vec<(Formula, Put)> {
    fn walk(part: &Formula, found: &mut Vec<(Formula, Vec<usize>)>, path: &mut Vec<usize>) {
        if is_literal(part) {
            found.push((part.clone(), path.clone()));
            return;
        }
        match part {
            Formula::Not(inner) => {
                path.push(0);
                walk(inner, found, path);
                path.pop();
            }
            Formula::Gate(_, operands) => {
                for (at, operand) in operands.iter().enumerate() {
                    path.push(at);
                    walk(operand, found, path);
                    path.pop();
                }
            }
            _ => {}
        }
    }
    fn replaced(part: &Formula, path: &[usize], with: &Formula) -> Formula {
        match (path, part) {
            ([], _) => with.clone(),
            ([_, rest @ ..], Formula::Not(inner)) => Formula::Not(Box::new(replaced(inner, rest, with))),
            ([at, rest @ ..], Formula::Gate(operator, operands)) => {
                let mut all = operands.clone();
                all[*at] = replaced(&operands[*at], rest, with);
                Formula::Gate(*operator, all)
            }
            _ => part.clone(),
        }
    }
    let whole = plain(formula);
    let mut found = Vec::new();
    walk(&whole, &mut found, &mut Vec::new());
    found
        .into_iter()
        .map(|(literal, path)| {
            let whole = whole.clone();
            let put = move |with: Formula| replaced(&whole, &path, &with);
            (literal, Box::new(put) as Put)
        })
        .collect()
}

/// What a signal is where these inputs are TRUE, if one equation is another one.
pub fn value(
    specification: &Specification,
    of: SignalId,
    inputs: &FixedBitSet,
    instead: Option<(SignalId, &Formula)>,
) -> bool {
    let formula = match instead {
        Some((signal, formula)) if signal == of => Some(formula),
        _ => specification.definition(of),
    };
    match formula {
        None => inputs.contains(of.0),
        Some(formula) => formula.holds(|signal| value(specification, signal, inputs, instead)),
    }
}

/// The inputs that a signal is computed from, and everything on the way.
pub fn needs(specification: &Specification, of: SignalId) -> BTreeSet<SignalId> {
    let mut found = BTreeSet::from([of]);
    if let Some(formula) = specification.definition(of) {
        for signal in formula.signals() {
            found.extend(needs(specification, signal));
        }
    }
    found
}

fn is_input(specification: &Specification, signal: SignalId) -> bool {
    matches!(specification.signal(signal).kind, Kind::Input { .. })
}

/// A function as the definitions see it.
pub struct Naive<'s> {
    pub specification: &'s Specification,
    pub function: usize,
    /// The inputs that its outputs are computed from.
    pub varied: Vec<SignalId>,
    /// Valuations of all inputs that the restrictions allow.
    pub allowed: Vec<FixedBitSet>,
    /// The equations that outputs are computed from.
    pub equations: Vec<SignalId>,
}

impl<'s> Naive<'s> {
    pub fn new(specification: &'s Specification, function: usize) -> Self {
        let of = &specification.functions[function];
        let reached: BTreeSet<SignalId> = of.outputs.iter().flat_map(|output| needs(specification, *output)).collect();
        let varied = reached.iter().copied().filter(|signal| is_input(specification, *signal)).collect();
        let equations = of.equations.iter().copied().filter(|signal| reached.contains(signal)).collect();
        let allowed = every(specification)
            .into_iter()
            .filter(|inputs| {
                specification
                    .restrictions_of(function)
                    .all(|restriction| restriction.allowed.holds(|signal| value(specification, signal, inputs, None)))
            })
            .collect();
        Self { specification, function, varied, allowed, equations }
    }

    pub fn outputs(&self) -> &'s [SignalId] {
        &self.specification.functions[self.function].outputs
    }

    /// The values of the inputs that vary.
    pub fn narrow(&self, inputs: &FixedBitSet) -> FixedBitSet {
        self.specification.valuation(self.varied.iter().copied().filter(|input| inputs.contains(input.0)))
    }

    /// Whether an output is TRUE.
    pub fn triggers(&self, inputs: &FixedBitSet) -> bool {
        self.outputs().iter().any(|output| value(self.specification, *output, inputs, None))
    }

    /// The names that may be put into an equation.
    fn names(&self, equation: SignalId) -> Vec<SignalId> {
        let of = &self.specification.functions[self.function];
        let used = of.equations.iter().filter_map(|id| self.specification.definition(*id)).flat_map(Formula::signals);
        let all: BTreeSet<SignalId> =
            of.inputs.iter().chain(&of.outputs).chain(&of.equations).copied().chain(used).collect();
        let known = |name: &SignalId| {
            let needed = needs(self.specification, *name);
            let inside = |id: &SignalId| !is_input(self.specification, *id) || self.varied.contains(id);
            !needed.contains(&equation) && needed.iter().all(inside)
        };
        all.into_iter().filter(known).collect()
    }

    /// All faults: class, equation, and what it is then.
    pub fn faults(&self) -> Vec<(&'static str, SignalId, Formula)> {
        let of = |equation: &SignalId| {
            let formula = self.specification.definition(*equation).unwrap();
            let found = mutants(formula, &self.names(*equation));
            found.into_iter().map(|(class, mutant)| (class, *equation, mutant)).collect::<Vec<_>>()
        };
        self.equations.iter().flat_map(of).collect()
    }

    /// Whether inputs show a fault.
    pub fn shows(&self, inputs: &FixedBitSet, fault: &(&'static str, SignalId, Formula)) -> bool {
        let right = |output: &SignalId| value(self.specification, *output, inputs, None);
        let wrong = |output: &SignalId| value(self.specification, *output, inputs, Some((fault.1, &fault.2)));
        self.outputs().iter().any(|output| right(output) != wrong(output))
    }
}

/// All valuations of all inputs.
pub fn every(specification: &Specification) -> Vec<FixedBitSet> {
    let inputs: Vec<SignalId> = specification.inputs().collect();
    (0..1_u32 << inputs.len())
        .map(|number| {
            let ones = inputs.iter().enumerate().filter(|(bit, _)| number >> bit & 1 == 1);
            specification.valuation(ones.map(|(_, input)| *input))
        })
        .collect()
}

/// Whether so many of the columns have one of each row, by trying.
pub fn suffices(rows: &[FixedBitSet], columns: usize) -> bool {
    fn tries(rows: &[FixedBitSet], left: usize, taken: &mut Vec<usize>) -> bool {
        let open = |row: &&FixedBitSet| !taken.iter().any(|column| row.contains(*column));
        let Some(row) = rows.iter().filter(open).min_by_key(|row| row.count_ones(..)) else { return true };
        left > 0
            && row.clone().ones().any(|column| {
                taken.push(column);
                let found = tries(rows, left - 1, taken);
                taken.pop();
                found
            })
    }
    let mut fewest: Vec<FixedBitSet> = Vec::new();
    let mut sorted = rows.to_vec();
    sorted.sort_by_key(|row| row.count_ones(..));
    for row in sorted {
        if !fewest.iter().any(|other| other.is_subset(&row)) {
            fewest.push(row);
        }
    }
    tries(&fewest, columns, &mut Vec::new())
}

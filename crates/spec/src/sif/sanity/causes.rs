//! Causes for which no allowed test is left.
//!
//! A cause is a condition that makes an output TRUE by itself: an operand of a disjunction in the negation normal form
//! of its formula. Auxiliary values are expanded; operands of `at most one of`, `exactly one of` or an `xor` of more
//! than two stay together.

use rustc_hash::FxHashSet;

use super::super::formula::{Formula, Operator, SignalId};
use super::super::solver::{Answer, Literal};
use super::super::specification::{Kind, Place};
use super::finding::{Doubt, Finding};
use super::model::{Model, Occurrence};
use super::outputs::equation;

/// Upper bound on subformulas examined per output, auxiliary values counted at each use.
const MAX_PARTS: usize = 5000;

/// Causes of a function's outputs that the restrictions exclude, and all occurrences of signals in these. Constant
/// outputs are skipped.
pub fn removed(model: &mut Model<'_>, function: usize, constant: &[SignalId]) -> (Vec<Finding>, FxHashSet<Occurrence>) {
    let specification = model.specification;
    let mut search = Search {
        model,
        function,
        output: SignalId(0),
        left: 0,
        depth: 0,
        findings: Vec::new(),
        removed: FxHashSet::default(),
    };
    for &output in specification.functions[function].outputs.iter().filter(|output| !constant.contains(output)) {
        let Kind::Defined { formula, .. } = &specification.signal(output).kind else { continue };
        search.output = output;
        search.left = MAX_PARTS;
        search.look(&Part { formula, is_true: true, of: output, at: 0 }, &mut Vec::new());
        if search.left == 0 {
            let question =
                format!("the restrictions remove all tests of some cause of `{}`", specification.name(output));
            search.findings.push(Finding::open(equation(specification, output), question).of(function));
        }
    }
    (search.findings, search.removed)
}

/// Upper bound on the recursion depth, through auxiliary values.
const MAX_DEPTH: usize = 300;

/// Subformula with the value it is required to have.
#[derive(Clone, Copy)]
struct Part<'f> {
    formula: &'f Formula,
    is_true: bool,
    /// Signal whose formula contains it.
    of: SignalId,
    /// Number of signal occurrences to its left.
    at: usize,
}

impl<'f> Part<'f> {
    /// The operands, each with its required value.
    fn operands(&self, operands: &'f [Formula], is_true: impl Fn(usize) -> bool) -> Vec<Self> {
        let mut at = self.at;
        let mut parts = Vec::new();
        for (position, formula) in operands.iter().enumerate() {
            parts.push(Part { formula, is_true: is_true(position), of: self.of, at });
            at += size(formula);
        }
        parts
    }

    fn written(&self) -> Formula {
        if self.is_true { self.formula.clone() } else { self.formula.clone().negated() }
    }
}

/// Decomposition of a subformula in negation normal form.
enum Shape<'f> {
    All(Vec<Part<'f>>),
    /// Disjunction of conjunctions.
    Any(Vec<Vec<Part<'f>>>),
    Whole,
}

struct Search<'m, 's> {
    model: &'m mut Model<'s>,
    function: usize,
    output: SignalId,
    /// Number of subformulas that may still be examined.
    left: usize,
    depth: usize,
    findings: Vec<Finding>,
    removed: FxHashSet<Occurrence>,
}

impl<'s> Search<'_, 's> {
    /// Searches a subformula for causes; `beside` are the other conjuncts it depends on.
    fn look(&mut self, part: &Part<'s>, beside: &mut Vec<(Literal, Formula)>) {
        self.left = if self.depth == MAX_DEPTH { 0 } else { self.left.saturating_sub(1) };
        if self.left == 0 {
            return;
        }
        self.depth += 1;
        self.look_into(part, beside);
        self.depth -= 1;
    }

    fn look_into(&mut self, part: &Part<'s>, beside: &mut Vec<(Literal, Formula)>) {
        match self.shape(part) {
            Shape::Whole => {}
            Shape::All(parts) => self.all(&parts, beside),
            Shape::Any(causes) => {
                for cause in causes {
                    if !self.is_removed(&cause, beside) {
                        self.all(&cause, beside);
                    }
                }
            }
        }
    }

    fn all(&mut self, parts: &[Part<'s>], beside: &mut Vec<(Literal, Formula)>) {
        if let [only] = parts {
            return self.look(only, beside);
        }
        let written: Vec<Formula> = parts.iter().map(Part::written).collect();
        let all: Vec<(Literal, Formula)> = written.into_iter().map(|part| (self.model.literal(&part), part)).collect();
        let before = beside.len();
        for (position, part) in parts.iter().enumerate() {
            if !matches!(self.shape(part), Shape::Whole) {
                let others = all.iter().enumerate().filter(|(at, _)| *at != position);
                beside.extend(others.map(|(_, other)| other.clone()));
                self.look(part, beside);
                beside.truncate(before);
            }
        }
    }

    fn shape(&self, part: &Part<'s>) -> Shape<'s> {
        let specification = self.model.specification;
        match part.formula {
            Formula::Constant(_) => Shape::Whole,
            Formula::Signal(signal) => match &specification.signal(*signal).kind {
                Kind::Defined { function, formula, is_output: false, .. } if *function == self.function => {
                    Shape::All(vec![Part { formula, is_true: part.is_true, of: *signal, at: 0 }])
                }
                _ => Shape::Whole,
            },
            Formula::Not(inner) => self.shape(&Part { formula: inner, is_true: !part.is_true, ..*part }),
            Formula::Gate(operator, operands) => {
                let same = || part.operands(operands, |_| part.is_true);
                match (operator, part.is_true) {
                    (Operator::And, true) | (Operator::Or, false) => Shape::All(same()),
                    (Operator::And, false) | (Operator::Or, true) => {
                        Shape::Any(same().into_iter().map(|cause| vec![cause]).collect())
                    }
                    (Operator::Implies, true) => {
                        let parts = part.operands(operands, |position| position > 0);
                        Shape::Any(parts.into_iter().map(|cause| vec![cause]).collect())
                    }
                    (Operator::Implies, false) => Shape::All(part.operands(operands, |position| position == 0)),
                    (Operator::Xor | Operator::Iff, is_true) if operands.len() == 2 => {
                        // Both equal, or both different.
                        let is_same = (*operator == Operator::Iff) == is_true;
                        let either = |first: bool| {
                            part.operands(operands, |at| if is_same { first } else { (at == 0) == first })
                        };
                        Shape::Any(vec![either(true), either(false)])
                    }
                    _ => Shape::Whole,
                }
            }
        }
    }

    /// Whether the restrictions exclude all tests in which a cause is true together with the output, or makes it true.
    fn is_removed(&mut self, cause: &[Part<'s>], beside: &[(Literal, Formula)]) -> bool {
        let written: Vec<Formula> = cause.iter().map(Part::written).collect();
        let literals: Vec<Literal> = written.iter().map(|part| self.model.literal(part)).collect();
        let with_output = [literals.as_slice(), &[self.model.values.formula[self.output.0]]].concat();
        let with_beside: Vec<Literal> = literals.iter().copied().chain(beside.iter().map(|other| other.0)).collect();
        let by_itself = || joined(written.iter().cloned());
        let together = || joined(written.iter().cloned().chain(beside.iter().map(|other| other.1.clone())));
        let place = cause.first().map(|part| equation(self.model.specification, part.of)).unwrap_or_default();
        for (wanted, formula) in [(with_output, by_itself()), (with_beside, together())] {
            match self.model.ask_allowed(&wanted) {
                Answer::Satisfiable => {}
                Answer::Unsatisfiable => {
                    let about = self.model.cone.inputs.clone();
                    let (core, example) = self.model.explained(&wanted, &about);
                    if !core.is_empty() {
                        cause.iter().for_each(|part| self.forget(part));
                        self.find(place, formula, core, example);
                        return true;
                    }
                }
                Answer::Stopped => {
                    let name = self.model.specification.name(self.output);
                    let cause = self.model.specification.text(&formula);
                    let question = format!("a test is left in which `{cause}` makes `{name}` TRUE");
                    self.findings.push(Finding::open(place, question).of(self.function));
                }
            }
        }
        false
    }

    fn find(&mut self, place: Place, formula: Formula, core: Vec<usize>, example: Option<super::Example>) {
        let finding = Finding::new(Doubt::CauseRemoved, place).of(self.function).signals([self.output]);
        let finding = finding.formula(formula).because(core, example);
        let is_same = |other: &Finding| other.signals == finding.signals && other.formula == finding.formula;
        if !self.findings.iter().any(is_same) {
            self.findings.push(finding);
        }
    }

    /// Records all occurrences in a subformula, and in its auxiliary values.
    fn forget(&mut self, part: &Part<'s>) {
        let mut left = vec![*part];
        while let Some(Part { formula, of, at, .. }) = left.pop() {
            for (nth, signal) in named(formula).into_iter().enumerate() {
                let is_new = self.removed.insert(Occurrence { of, in_reset: false, at: at + nth });
                if let Kind::Defined { function, formula, is_output: false, .. } =
                    &self.model.specification.signal(signal).kind
                    && *function == self.function
                    && is_new
                {
                    left.push(Part { formula, is_true: true, of: signal, at: 0 });
                }
            }
        }
    }
}

/// Signals of a formula, with repetitions.
fn named(formula: &Formula) -> Vec<SignalId> {
    let mut all = Vec::new();
    formula.each_signal(&mut |signal| all.push(signal));
    all
}

fn size(formula: &Formula) -> usize {
    let mut count = 0;
    formula.each_signal(&mut |_| count += 1);
    count
}

/// Flattened conjunction.
fn joined(parts: impl Iterator<Item = Formula>) -> Formula {
    let mut all = Vec::new();
    for part in parts {
        match part {
            Formula::Gate(Operator::And, more) => all.extend(more),
            other => all.push(other),
        }
    }
    match all.len() {
        1 => all.remove(0),
        _ => Formula::Gate(Operator::And, all),
    }
}

//! Causes of which no test is left.
//!
//! A cause is what can make an output TRUE by itself: an operand of a disjunction in the negation normal form of its formula.
//! Auxiliary values are looked into; what stands under `at most one of`, `exactly one of` or an `xor` of more than two is taken
//! as a whole.

use rustc_hash::FxHashSet;

use super::super::formula::{Formula, Operator, SignalId};
use super::super::solver::{Answer, Literal};
use super::super::specification::{Kind, Place};
use super::finding::{Doubt, Finding};
use super::model::{Model, Occurrence};
use super::outputs::equation;

/// So many parts of a formula are looked at, with its auxiliary values as often as they are used.
const MAX_PARTS: usize = 5000;

/// The causes of a function's outputs that the restrictions remove, and all occurrences of signals in these. Outputs that never
/// change are left out.
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

/// And so deep, from one auxiliary value to the next.
const MAX_DEPTH: usize = 300;

/// A part of a formula, to be TRUE or to be FALSE.
#[derive(Clone, Copy)]
struct Part<'f> {
    formula: &'f Formula,
    is_true: bool,
    /// In the formula of this signal.
    of: SignalId,
    /// So many signals are named to its left.
    at: usize,
}

impl<'f> Part<'f> {
    /// The operands, each to be what this says for its position.
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

/// What a part is made of in negation normal form.
enum Shape<'f> {
    All(Vec<Part<'f>>),
    /// One of these conjunctions.
    Any(Vec<Vec<Part<'f>>>),
    Whole,
}

struct Search<'m, 's> {
    model: &'m mut Model<'s>,
    function: usize,
    output: SignalId,
    /// Parts that may still be looked at.
    left: usize,
    depth: usize,
    findings: Vec<Finding>,
    removed: FxHashSet<Occurrence>,
}

impl<'s> Search<'_, 's> {
    /// Looks for causes in a part; `beside` has to be true too for it to count.
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
                        // Both the same, or not.
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

    /// Whether the restrictions remove all tests in which a cause is true with the output, or makes it true.
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

    /// Notes all that is named in a part, and in the auxiliary values there.
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

/// All that a formula names, as often as it does.
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

/// A conjunction without conjunctions in it.
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

//! Boolean formulas over the signals of a specification.

/// Signal of a [`Specification`](super::Specification): its position among the signals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SignalId(pub usize);

/// Boolean formula over signals; before name resolution, `S` is a name.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Formula<S = SignalId> {
    /// Boolean constant.
    Constant(bool),
    /// Signal.
    Signal(S),
    /// Negation.
    Not(Box<Formula<S>>),
    /// Gate: an operator with its operands; two for `Implies` and `Iff`, one or more for the others.
    Gate(Operator, Vec<Formula<S>>),
}

/// Boolean operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Operator {
    /// Conjunction.
    And,
    /// Disjunction.
    Or,
    /// Exclusive or: an odd number of operands is true.
    Xor,
    /// Implication of the second operand by the first.
    Implies,
    /// Equivalence.
    Iff,
    /// At most one operand is true.
    AtMostOne,
    /// Exactly one operand is true.
    ExactlyOne,
}

impl Operator {
    /// Binding strength; operators written with parentheses bind strongest.
    fn strength(self) -> u8 {
        match self {
            Self::Iff => 1,
            Self::Implies => 2,
            Self::Or => 3,
            Self::Xor => 4,
            Self::And => 5,
            Self::AtMostOne | Self::ExactlyOne => 7,
        }
    }

    /// Spelling, between the operands or before all of them.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Self::And => "&",
            Self::Or => "|",
            Self::Xor => "xor",
            Self::Implies => "->",
            Self::Iff => "<->",
            Self::AtMostOne => "at most one of",
            Self::ExactlyOne => "exactly one of",
        }
    }

    /// Applies the operator to its operands, bit by bit.
    pub(super) fn apply(self, mut operands: impl Iterator<Item = u64>) -> u64 {
        match self {
            Self::And => operands.fold(u64::MAX, |all, word| all & word),
            Self::Or => operands.fold(0, |any, word| any | word),
            Self::Xor => operands.fold(0, |odd, word| odd ^ word),
            Self::Implies => {
                let first = operands.next().unwrap_or(u64::MAX);
                !first | operands.fold(0, |any, word| any | word)
            }
            Self::Iff => !operands.fold(0, |odd, word| odd ^ word),
            Self::AtMostOne | Self::ExactlyOne => {
                let (one, two) = operands.fold((0, 0), |(one, two), word| (one | word, two | one & word));
                if self == Self::AtMostOne { !two } else { one & !two }
            }
        }
    }
}

impl<S> Formula<S> {
    /// Replaces the signals of the formula.
    pub fn map<T>(&self, of: &mut impl FnMut(&S) -> T) -> Formula<T> {
        match self {
            Self::Constant(value) => Formula::Constant(*value),
            Self::Signal(signal) => Formula::Signal(of(signal)),
            Self::Not(inner) => Formula::Not(Box::new(inner.map(of))),
            Self::Gate(operator, operands) => {
                Formula::Gate(*operator, operands.iter().map(|operand| operand.map(of)).collect())
            }
        }
    }

    /// Negation, without double negation.
    #[must_use]
    pub fn negated(self) -> Self {
        match self {
            Self::Not(inner) => *inner,
            Self::Constant(value) => Self::Constant(!value),
            other => Self::Not(Box::new(other)),
        }
    }
}

impl Formula {
    /// Evaluates the formula on 64 valuations at once, one per bit of the words given by `value`.
    pub fn evaluate(&self, value: &impl Fn(SignalId) -> u64) -> u64 {
        match self {
            Self::Constant(true) => u64::MAX,
            Self::Constant(false) => 0,
            Self::Signal(signal) => value(*signal),
            Self::Not(inner) => !inner.evaluate(value),
            Self::Gate(operator, operands) => operator.apply(operands.iter().map(|operand| operand.evaluate(value))),
        }
    }

    /// Whether the formula is true under a valuation.
    pub fn holds(&self, value: impl Fn(SignalId) -> bool) -> bool {
        self.evaluate(&|signal| u64::from(value(signal))) & 1 == 1
    }

    /// Calls `see` for every occurrence of a signal, from left to right.
    pub fn each_signal(&self, see: &mut impl FnMut(SignalId)) {
        match self {
            Self::Constant(_) => {}
            Self::Signal(signal) => see(*signal),
            Self::Not(inner) => inner.each_signal(see),
            Self::Gate(_, operands) => operands.iter().for_each(|operand| operand.each_signal(see)),
        }
    }

    /// Signals of the formula, each once, in the order of first occurrence.
    #[must_use]
    pub fn signals(&self) -> Vec<SignalId> {
        let (mut found, mut seen) = (Vec::new(), rustc_hash::FxHashSet::default());
        self.each_signal(&mut |signal| {
            if seen.insert(signal) {
                found.push(signal);
            }
        });
        found
    }

    /// Text of the formula, with the fewest parentheses.
    pub fn text<'n>(&self, name: &impl Fn(SignalId) -> &'n str) -> String {
        let mut text = String::new();
        self.write(&mut text, 0, name);
        text
    }

    fn write<'n>(&self, text: &mut String, around: u8, name: &impl Fn(SignalId) -> &'n str) {
        match self {
            Self::Constant(value) => text.push_str(if *value { "TRUE" } else { "FALSE" }),
            Self::Signal(signal) => text.push_str(name(*signal)),
            Self::Not(inner) => {
                text.push('!');
                inner.write(text, 6, name);
            }
            Self::Gate(operator @ (Operator::AtMostOne | Operator::ExactlyOne), operands) => {
                text.push_str(operator.symbol());
                text.push_str(" (");
                for (position, operand) in operands.iter().enumerate() {
                    text.push_str(if position == 0 { "" } else { ", " });
                    operand.write(text, 0, name);
                }
                text.push(')');
            }
            Self::Gate(operator, operands) => {
                let strength = operator.strength();
                let enclosed = strength <= around;
                text.push_str(if enclosed { "(" } else { "" });
                for (position, operand) in operands.iter().enumerate() {
                    if position > 0 {
                        text.push(' ');
                        text.push_str(operator.symbol());
                        text.push(' ');
                    }
                    operand.write(text, strength, name);
                }
                text.push_str(if enclosed { ")" } else { "" });
            }
        }
    }
}

//! Boolean formulas over the signals of a specification.

/// A signal of a [`Specification`](super::Specification): its position among the signals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SignalId(pub usize);

/// A Boolean formula; before names are resolved, `S` is a name.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Formula<S = SignalId> {
    /// TRUE or FALSE.
    Constant(bool),
    /// What a signal has.
    Signal(S),
    /// The opposite.
    Not(Box<Formula<S>>),
    /// An operator and its operands: two for `Implies` and `Iff`, one or more for the others.
    Gate(Operator, Vec<Formula<S>>),
}

/// What joins formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Operator {
    /// All are true.
    And,
    /// One at least is true.
    Or,
    /// An odd number of them is true.
    Xor,
    /// If the first is true, so is the second.
    Implies,
    /// Both are the same.
    Iff,
    /// No two are true.
    AtMostOne,
    /// One is true, and no other.
    ExactlyOne,
}

impl Operator {
    /// How strongly it binds; what stands in parentheses anyway binds strongest.
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

    /// How it is written, between its operands or before all of them.
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

    /// What it makes of its operands, bit by bit.
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
    /// The same formula about other signals.
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

    /// The opposite, without a second negation.
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
    /// What it is on 64 valuations at once: one per bit of the words that `value` gives.
    pub fn evaluate(&self, value: &impl Fn(SignalId) -> u64) -> u64 {
        match self {
            Self::Constant(true) => u64::MAX,
            Self::Constant(false) => 0,
            Self::Signal(signal) => value(*signal),
            Self::Not(inner) => !inner.evaluate(value),
            Self::Gate(operator, operands) => operator.apply(operands.iter().map(|operand| operand.evaluate(value))),
        }
    }

    /// Whether it is true where a signal has what `value` says.
    pub fn holds(&self, value: impl Fn(SignalId) -> bool) -> bool {
        self.evaluate(&|signal| u64::from(value(signal))) & 1 == 1
    }

    /// Calls this for every signal that is named, as often as it is, from left to right.
    pub fn each_signal(&self, see: &mut impl FnMut(SignalId)) {
        match self {
            Self::Constant(_) => {}
            Self::Signal(signal) => see(*signal),
            Self::Not(inner) => inner.each_signal(see),
            Self::Gate(_, operands) => operands.iter().for_each(|operand| operand.each_signal(see)),
        }
    }

    /// The signals that are named, each once, in the order in which they come first.
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

    /// The formula as it is written, with the fewest parentheses.
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

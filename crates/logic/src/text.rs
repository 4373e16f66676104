//! Text of bound formulas and nodes, with the names of the program and its net, or of a net alone.

use super::bound::{Bound, Term};
use super::dag::{Dag, Node, NodeId};
use super::formula::{Comparison, Quantifier};
use super::ltl::Path;
use super::past::Past;
use petril_base::{PlaceId, TransitionId, VarId};

/// Names of atoms, in the terms of a program and its net, or of a net alone.
pub trait Names {
    /// Name of a variable.
    fn variable(&self, variable: VarId) -> String;
    /// A number as a literal of a variable's type, if it is one: `16#8001`, `T#1s`.
    fn literal(&self, variable: VarId, number: i128) -> Option<String>;
    /// The formula that a place is marked.
    fn marked(&self, place: PlaceId) -> String;
    /// The number of tokens on a place.
    fn tokens(&self, place: PlaceId) -> String;
    /// The formula that a transition is enabled.
    fn enabled(&self, transition: TransitionId) -> String;
}

/// Binding strengths, weakest first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Strength {
    Iff,
    Implies,
    Or,
    And,
    Compare,
    Sum,
    Product,
    Prefix,
}

impl Bound {
    /// Text of the formula, in the syntax of requirements.
    #[must_use]
    pub fn text(&self, names: &dyn Names) -> String {
        self.set(names, Strength::Iff)
    }

    /// The text, in parentheses if it binds more weakly than what stands around it.
    fn set(&self, words: &dyn Names, around: Strength) -> String {
        // Each operand with its minimum binding strength: all operators but `->` are left-associative.
        let two = |(f, left): (&Self, Strength), sign: &str, (g, right): (&Self, Strength), strength: Strength| {
            let text = format!("{} {sign} {}", f.set(words, left), g.set(words, right));
            parenthesise(text, strength < around)
        };
        match self {
            Self::Truth(value) => if *value { "TRUE" } else { "FALSE" }.to_owned(),
            Self::Variable(variable) => words.variable(*variable),
            Self::Bit(variable, bit) => format!("{}.{bit}", words.variable(*variable)),
            Self::Marked(place) => words.marked(*place),
            Self::Enabled(transition) => words.enabled(*transition),
            Self::Deadlock => "at deadlock".to_owned(),
            Self::Compare(Comparison::Unequal, Term::Past(past), Term::Number(0)) if past.is_truth() => past.set(words),
            Self::Compare(Comparison::AtLeast, Term::Past(past), Term::Number(n)) if past.is_run_of(*n) => {
                past.set(words)
            }
            Self::Compare(Comparison::Unequal, now, Term::Past(past)) if **past == Past::Before(now.clone()) => {
                format!("changed({})", now.set(words, Strength::Iff))
            }
            Self::Compare(comparison, left, right) => {
                let sign = match comparison {
                    Comparison::Equal => "=",
                    Comparison::Unequal => "!=",
                    Comparison::Less => "<",
                    Comparison::AtMost => "<=",
                    Comparison::Greater => ">",
                    Comparison::AtLeast => ">=",
                };
                let sides = (left.beside(right, words), right.beside(left, words));
                parenthesise(format!("{} {sign} {}", sides.0, sides.1), Strength::Compare < around)
            }
            Self::Not(f) => format!("!{}", f.set(words, Strength::Prefix)),
            Self::And(f, g) => two((f, Strength::And), "&", (g, Strength::Compare), Strength::And),
            Self::Or(f, g) => two((f, Strength::Or), "|", (g, Strength::And), Strength::Or),
            Self::Implies(f, g) => two((f, Strength::Or), "->", (g, Strength::Implies), Strength::Implies),
            Self::Iff(f, g) => two((f, Strength::Iff), "<->", (g, Strength::Implies), Strength::Iff),
            Self::Next(quantifier, f) => format!("{}X {}", letter(*quantifier), f.set(words, Strength::Prefix)),
            Self::Until { quantifier, weak, hold, release } => match (weak, &**hold, &**release) {
                (false, Self::Truth(true), f) => {
                    format!("{}F {}", letter(*quantifier), f.set(words, Strength::Prefix))
                }
                (true, f, Self::Truth(false)) => {
                    format!("{}G {}", letter(*quantifier), f.set(words, Strength::Prefix))
                }
                _ => format!(
                    "{} [{} {} {}]",
                    letter(*quantifier),
                    hold.set(words, Strength::Iff),
                    if *weak { "W" } else { "U" },
                    release.set(words, Strength::Iff)
                ),
            },
            Self::Ltl(path) => parenthesise(format!("LTL {}", path.set(words)), Strength::Iff < around),
        }
    }
}

impl Path<Bound> {
    fn set(&self, words: &dyn Names) -> String {
        let operand = |f: &Self| match f {
            Self::State(f) => f.set(words, Strength::Prefix),
            Self::Not(_) | Self::Next(_) | Self::Finally(_) | Self::Globally(_) => f.set(words),
            _ => format!("({})", f.set(words)),
        };
        let two = |f: &Self, sign: &str, g: &Self| format!("{} {sign} {}", operand(f), operand(g));
        match self {
            Self::State(f) => f.set(words, Strength::Iff),
            Self::Not(f) => format!("!{}", operand(f)),
            Self::And(f, g) => two(f, "&", g),
            Self::Or(f, g) => two(f, "|", g),
            Self::Implies(f, g) => two(f, "->", g),
            Self::Iff(f, g) => two(f, "<->", g),
            Self::Next(f) => format!("X {}", operand(f)),
            Self::Finally(f) => format!("F {}", operand(f)),
            Self::Globally(f) => format!("G {}", operand(f)),
            Self::Until(f, g) => two(f, "U", g),
            Self::WeakUntil(f, g) => two(f, "W", g),
            Self::Release(f, g) => two(f, "R", g),
        }
    }
}

impl Term {
    /// One side of a comparison. A number beside a variable is written as a value of this variable: `16#8001`, `T#1s`.
    fn beside(&self, other: &Self, words: &dyn Names) -> String {
        if let (Self::Number(number), Self::Variable(variable, _) | Self::Bits { variable, .. }) = (self, other)
            && let Some(literal) = words.literal(*variable, *number)
        {
            return literal;
        }
        self.set(words, Strength::Sum)
    }

    fn set(&self, words: &dyn Names, around: Strength) -> String {
        let two = |a: &Self, sign: &str, b: &Self, strength: Strength| {
            let text = format!("{} {sign} {}", a.set(words, strength), b.set(words, Strength::Prefix));
            parenthesise(text, strength < around)
        };
        match self {
            Self::Number(number) => number.to_string(),
            Self::Variable(variable, _) | Self::Bits { variable, .. } => words.variable(*variable),
            Self::Tokens(place) => words.tokens(*place),
            Self::Past(past) => past.set(words),
            Self::Truth(f) => f.set(words, Strength::Prefix),
            Self::Sum(a, b) => two(a, "+", b, Strength::Sum),
            Self::Difference(a, b) => two(a, "-", b, Strength::Sum),
            Self::Product(a, b) => two(a, "*", b, Strength::Product),
        }
    }
}

impl Past {
    /// Whether the term is a count with this upper bound.
    fn is_run_of(&self, n: i128) -> bool {
        matches!(self, Self::Run { most, .. } if i128::from(*most) == n)
    }

    /// As a truth value, if it stands for one.
    fn set(&self, words: &dyn Names) -> String {
        match self {
            Self::First => "at first scan".to_owned(),
            Self::Before(Term::Truth(f)) => format!("pre({})", f.set(words, Strength::Iff)),
            Self::Before(term) => format!("pre({})", term.set(words, Strength::Iff)),
            Self::Since(Bound::Truth(true), g) => format!("once({})", g.set(words, Strength::Iff)),
            Self::Since(f, g) => format!("({} since {})", f.set(words, Strength::Iff), g.set(words, Strength::Iff)),
            Self::Run { of, most } => {
                let scans = most.saturating_sub(1);
                let unit = if scans == 1 { "scan" } else { "scans" };
                format!("held({}, {scans} {unit})", of.set(words, Strength::Iff))
            }
        }
    }
}

fn parenthesise(text: String, needed: bool) -> String {
    if needed { format!("({text})") } else { text }
}

fn letter(quantifier: Quantifier) -> &'static str {
    match quantifier {
        Quantifier::All => "A",
        Quantifier::Some => "E",
    }
}

impl Dag {
    /// Sentence about a state that a node expresses: "`f` is true", "`f` is false", or that the temporal formula holds.
    #[must_use]
    pub fn sentence(&self, id: NodeId, words: &dyn Names) -> String {
        let Node::State { formula, negated } = self.node(id) else {
            return format!("`{}` holds", self.set(id, words));
        };
        let (mut formula, mut truth) = (formula, !negated);
        while let Bound::Not(inner) = formula {
            (formula, truth) = (inner, !truth);
        }
        format!("`{}` is {truth}", formula.set(words, Strength::Iff))
    }

    fn set(&self, id: NodeId, words: &dyn Names) -> String {
        let operand = |id: &NodeId| match self.node(*id) {
            Node::And(..) | Node::Or(..) => format!("({})", self.set(*id, words)),
            _ => self.set(*id, words),
        };
        match self.node(id) {
            Node::State { formula, negated: false } => formula.set(words, Strength::Prefix),
            Node::State { formula, negated: true } => format!("!{}", formula.set(words, Strength::Prefix)),
            Node::And(f, g) => format!("{} & {}", operand(f), operand(g)),
            Node::Or(f, g) => format!("{} | {}", operand(f), operand(g)),
            Node::Next(q, f) => format!("{}X {}", letter(*q), operand(f)),
            Node::Until(q, f, g) if self.is_constant(*f, true) => format!("{}F {}", letter(*q), operand(g)),
            Node::WeakUntil(q, f, g) if self.is_constant(*g, false) => format!("{}G {}", letter(*q), operand(f)),
            Node::Until(q, f, g) => format!("{} [{} U {}]", letter(*q), self.set(*f, words), self.set(*g, words)),
            Node::WeakUntil(q, f, g) => format!("{} [{} W {}]", letter(*q), self.set(*f, words), self.set(*g, words)),
        }
    }

    /// Whether a node is a constant, as far as its outermost operators show.
    #[must_use]
    pub fn is_constant(&self, id: NodeId, value: bool) -> bool {
        match self.node(id) {
            Node::State { formula: Bound::Truth(truth), negated } => (truth != negated) == value,
            Node::And(f, g) if value => self.is_constant(*f, true) && self.is_constant(*g, true),
            Node::And(f, g) => self.is_constant(*f, false) || self.is_constant(*g, false),
            _ => false,
        }
    }
}

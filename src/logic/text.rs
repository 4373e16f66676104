//! Bound formulas and nodes as text, in the terms of the program and its net.

use super::bound::{Bound, Term};
use super::dag::{Dag, Node, NodeId};
use super::formula::{Comparison, Quantifier};
use crate::flat::value_text;
use crate::semantics::Role;
use crate::translate::{PlaceRole, System};

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
    /// The formula as one would write it.
    #[must_use]
    pub fn text(&self, system: &System) -> String {
        self.set(system, Strength::Iff)
    }

    /// The text, in parentheses if it binds more weakly than what stands around it.
    fn set(&self, system: &System, around: Strength) -> String {
        // Each operand with what it must bind at least as strongly as: all but `->` take their operands from the left.
        let two = |(f, left): (&Self, Strength), sign: &str, (g, right): (&Self, Strength), strength: Strength| {
            let text = format!("{} {sign} {}", f.set(system, left), g.set(system, right));
            parenthesise(text, strength < around)
        };
        match self {
            Self::Truth(value) => if *value { "TRUE" } else { "FALSE" }.to_owned(),
            Self::Variable(variable) => system.program.variable(*variable).name.clone(),
            Self::Marked(place) => match system.places[place.index()] {
                PlaceRole::Bit { variable, bit: 0, value: true }
                    if system.program.variable(variable).role != Role::Buffer =>
                {
                    system.program.variable(variable).name.clone()
                }
                PlaceRole::Line(line) if line == system.program.end() => "at End".to_owned(),
                PlaceRole::Line(line) => format!("at line {}", line + 1),
                PlaceRole::Idle => "at idle".to_owned(),
                _ => format!("marked(\"{}\")", system.net.place(*place).name),
            },
            Self::Enabled(transition) => format!("enabled(\"{}\")", system.net.transition(*transition).name),
            Self::Compare(comparison, left, right) => {
                let sign = match comparison {
                    Comparison::Equal => "=",
                    Comparison::Unequal => "!=",
                    Comparison::Less => "<",
                    Comparison::AtMost => "<=",
                    Comparison::Greater => ">",
                    Comparison::AtLeast => ">=",
                };
                let sides = (left.beside(right, system), right.beside(left, system));
                parenthesise(format!("{} {sign} {}", sides.0, sides.1), Strength::Compare < around)
            }
            Self::Not(f) => format!("!{}", f.set(system, Strength::Prefix)),
            Self::And(f, g) => two((f, Strength::And), "&", (g, Strength::Compare), Strength::And),
            Self::Or(f, g) => two((f, Strength::Or), "|", (g, Strength::And), Strength::Or),
            Self::Implies(f, g) => two((f, Strength::Or), "->", (g, Strength::Implies), Strength::Implies),
            Self::Iff(f, g) => two((f, Strength::Iff), "<->", (g, Strength::Implies), Strength::Iff),
            Self::Next(quantifier, f) => format!("{}X {}", letter(*quantifier), f.set(system, Strength::Prefix)),
            Self::Until { quantifier, weak, hold, release } => match (weak, &**hold, &**release) {
                (false, Self::Truth(true), f) => {
                    format!("{}F {}", letter(*quantifier), f.set(system, Strength::Prefix))
                }
                (true, f, Self::Truth(false)) => {
                    format!("{}G {}", letter(*quantifier), f.set(system, Strength::Prefix))
                }
                _ => format!(
                    "{} [{} {} {}]",
                    letter(*quantifier),
                    hold.text(system),
                    if *weak { "W" } else { "U" },
                    release.text(system)
                ),
            },
        }
    }
}

impl Term {
    /// One side of a comparison. A number beside a variable is written as a value of this variable: `16#8001`, `T#1s`.
    fn beside(&self, other: &Self, system: &System) -> String {
        if let (Self::Number(number), Self::Variable(variable, _) | Self::Bits { variable, .. }) = (self, other) {
            let ty = system.program.variable(*variable).ty;
            if ty.holds(*number) {
                return value_text(ty, ty.pattern(*number));
            }
        }
        self.set(system, Strength::Sum)
    }

    fn set(&self, system: &System, around: Strength) -> String {
        let two = |a: &Self, sign: &str, b: &Self, strength: Strength| {
            let text = format!("{} {sign} {}", a.set(system, strength), b.set(system, Strength::Prefix));
            parenthesise(text, strength < around)
        };
        match self {
            Self::Number(number) => number.to_string(),
            Self::Variable(variable, _) | Self::Bits { variable, .. } => {
                system.program.variable(*variable).name.clone()
            }
            Self::Truth(f) => f.set(system, Strength::Prefix),
            Self::Sum(a, b) => two(a, "+", b, Strength::Sum),
            Self::Difference(a, b) => two(a, "-", b, Strength::Sum),
            Self::Product(a, b) => two(a, "*", b, Strength::Product),
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
    /// What a node says, as a sentence about a state: "`f` is true", "`f` is false", or the temporal formula.
    #[must_use]
    pub fn sentence(&self, id: NodeId, system: &System) -> String {
        let Node::State { formula, negated } = self.node(id) else {
            return format!("`{}` holds", self.set(id, system));
        };
        let (mut formula, mut truth) = (formula, !negated);
        while let Bound::Not(inner) = formula {
            (formula, truth) = (inner, !truth);
        }
        format!("`{}` is {truth}", formula.text(system))
    }

    fn set(&self, id: NodeId, system: &System) -> String {
        let operand = |id: &NodeId| match self.node(*id) {
            Node::And(..) | Node::Or(..) => format!("({})", self.set(*id, system)),
            _ => self.set(*id, system),
        };
        match self.node(id) {
            Node::State { formula, negated: false } => formula.set(system, Strength::Prefix),
            Node::State { formula, negated: true } => format!("!{}", formula.set(system, Strength::Prefix)),
            Node::And(f, g) => format!("{} & {}", operand(f), operand(g)),
            Node::Or(f, g) => format!("{} | {}", operand(f), operand(g)),
            Node::Next(q, f) => format!("{}X {}", letter(*q), operand(f)),
            Node::Until(q, f, g) if self.is_constant(*f, true) => format!("{}F {}", letter(*q), operand(g)),
            Node::WeakUntil(q, f, g) if self.is_constant(*g, false) => format!("{}G {}", letter(*q), operand(f)),
            Node::Until(q, f, g) => format!("{} [{} U {}]", letter(*q), self.set(*f, system), self.set(*g, system)),
            Node::WeakUntil(q, f, g) => format!("{} [{} W {}]", letter(*q), self.set(*f, system), self.set(*g, system)),
        }
    }

    /// Whether a node is this constant, as far as its outermost operators show.
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

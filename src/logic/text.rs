//! Text of bound formulas and nodes, with the names of the program and its net, or of a net alone.

use super::bound::{Bound, Term};
use super::dag::{Dag, Node, NodeId};
use super::formula::{Comparison, Quantifier};
use super::ltl::Path;
use super::past::Past;
use crate::flat::value_text;
use crate::net::{Net, PlaceId, TransitionId};
use crate::semantics::{Role, VarId};
use crate::translate::{PlaceRole, System};

/// Source of names for atoms.
#[derive(Clone, Copy)]
enum Words<'a> {
    Program(&'a System),
    /// A net alone, which has no variables.
    Net(&'a Net),
}

impl Words<'_> {
    fn net(&self) -> &Net {
        match self {
            Self::Program(system) => &system.net,
            Self::Net(net) => net,
        }
    }

    fn variable(&self, variable: VarId) -> String {
        match self {
            Self::Program(system) => system.program.variable(variable).name.clone(),
            Self::Net(_) => format!("variable {}", variable.0),
        }
    }

    fn marked(&self, place: PlaceId) -> String {
        if let Self::Program(system) = self {
            match system.places[place.index()] {
                PlaceRole::Bit { variable, bit: 0, value: true }
                    if system.program.variable(variable).role != Role::Buffer =>
                {
                    return self.variable(variable);
                }
                PlaceRole::Line(line) if line == system.program.end() => return "at End".to_owned(),
                PlaceRole::Line(line) => return format!("at line {}", line + 1),
                PlaceRole::Idle => return "at idle".to_owned(),
                _ => {}
            }
        }
        format!("marked(\"{}\")", self.net().place(place).name)
    }

    fn tokens(&self, place: PlaceId) -> String {
        format!("tokens(\"{}\")", self.net().place(place).name)
    }

    fn enabled(&self, transition: TransitionId) -> String {
        format!("enabled(\"{}\")", self.net().transition(transition).name)
    }
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
    pub fn text(&self, system: &System) -> String {
        self.set(Words::Program(system), Strength::Iff)
    }

    /// Text of a formula about a net alone.
    #[must_use]
    pub fn text_in_net(&self, net: &Net) -> String {
        self.set(Words::Net(net), Strength::Iff)
    }

    /// Text of the formula, in parentheses if it binds more weakly than its context.
    fn set(&self, words: Words<'_>, around: Strength) -> String {
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
    fn set(&self, words: Words<'_>) -> String {
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
    /// Text of one side of a comparison. A number beside a variable is written as a value of its type: `16#8001`,
    /// `T#1s`.
    fn beside(&self, other: &Self, words: Words<'_>) -> String {
        if let (
            Self::Number(number),
            Self::Variable(variable, _) | Self::Bits { variable, .. },
            Words::Program(system),
        ) = (self, other, words)
        {
            let ty = system.program.variable(*variable).ty;
            if ty.holds(*number) {
                return value_text(ty, ty.pattern(*number));
            }
        }
        self.set(words, Strength::Sum)
    }

    fn set(&self, words: Words<'_>, around: Strength) -> String {
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

    /// Text of the term, as a truth value if it is one.
    fn set(&self, words: Words<'_>) -> String {
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
    pub fn sentence(&self, id: NodeId, system: &System) -> String {
        self.say(id, Words::Program(system))
    }

    /// Sentence of a node about a net alone.
    #[must_use]
    pub fn sentence_in_net(&self, id: NodeId, net: &Net) -> String {
        self.say(id, Words::Net(net))
    }

    fn say(&self, id: NodeId, words: Words<'_>) -> String {
        let Node::State { formula, negated } = self.node(id) else {
            return format!("`{}` holds", self.set(id, words));
        };
        let (mut formula, mut truth) = (formula, !negated);
        while let Bound::Not(inner) = formula {
            (formula, truth) = (inner, !truth);
        }
        format!("`{}` is {truth}", formula.set(words, Strength::Iff))
    }

    fn set(&self, id: NodeId, words: Words<'_>) -> String {
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

//! Formulas as they are written, before their names mean anything.

use super::ltl::Path;
use petril_base::source::Span;

/// A formula or a part of one, and where it stands.
#[derive(Clone, Debug)]
pub struct Formula {
    /// What it says.
    pub expression: Expression,
    /// Where it stands.
    pub span: Span,
}

/// What a formula says. Truth values and numbers are not told apart yet.
#[derive(Clone, Debug)]
pub enum Expression {
    /// `TRUE`, `FALSE`
    Truth(bool),
    /// A number, of at most 64 bits.
    Number(i128),
    /// A variable.
    Name(String),
    /// `at line 12`, the line counted from 1 as `petril flat` prints it.
    AtLine(usize),
    /// `at idle`
    AtIdle,
    /// `at End`
    AtEnd,
    /// `at deadlock`: no transition is enabled.
    Deadlock,
    /// `at first scan`: no scan came before this one.
    FirstScan,
    /// Some input has another value than at the end of the scan before.
    InputChanges,
    /// Some output has.
    OutputChanges,
    /// `pre(f)` and its like: about this scan and those before it.
    Past(Past, Vec<Formula>),
    /// `held(f, t)`: f is true, and was at the ends of all scans in the time t before.
    Held(Box<Formula>, Duration),
    /// `f within t`: f is true now, or will be at the end of one of the scans in the time t that comes.
    Within(Box<Formula>, Duration),
    /// Always, if the first is true, the second is true within the time.
    Response(Box<Formula>, Box<Formula>, Duration),
    /// `marked("place")`
    Marked(String),
    /// `tokens("place")`: how many tokens the place holds.
    Tokens(String),
    /// `enabled("transition")`
    Enabled(String),
    /// `!f`
    Not(Box<Formula>),
    /// `f & g`
    And(Box<Formula>, Box<Formula>),
    /// `f | g`
    Or(Box<Formula>, Box<Formula>),
    /// `f -> g`
    Implies(Box<Formula>, Box<Formula>),
    /// `f <-> g`
    Iff(Box<Formula>, Box<Formula>),
    /// `a < b` and its like.
    Compare(Comparison, Box<Formula>, Box<Formula>),
    /// `a + b`
    Sum(Box<Formula>, Box<Formula>),
    /// `a - b`
    Difference(Box<Formula>, Box<Formula>),
    /// `a * b`
    Product(Box<Formula>, Box<Formula>),
    /// `AG f` and its like.
    Temporal(Quantifier, Temporal, Box<Formula>),
    /// `A[f U g]`, `E[f U g]`, and with W if `weak`.
    Until {
        /// On all paths or on some.
        quantifier: Quantifier,
        /// g need not come if f holds for ever.
        weak: bool,
        /// f
        hold: Box<Formula>,
        /// g
        release: Box<Formula>,
    },
    /// `LTL …`: a formula about every path. It is no part of another formula.
    Ltl(Box<Path<Formula>>),
}

/// The operators that look back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Past {
    /// `pre(f)`: what f was at the end of the scan before; in the first scan, at power-on.
    Pre,
    /// `rising(f)`: f is true and was not before.
    Rising,
    /// `falling(f)`: f was true before and is not.
    Falling,
    /// `changed(f)`: f has another value than before.
    Changed,
    /// `once(f)`: f is true, or was at the end of some scan.
    Once,
    /// `so_far(f)`: f is true, and was at the ends of all scans.
    SoFar,
    /// `since(f, g)`: g is or was true, and f has been true ever since.
    Since,
}

impl Past {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Pre, Self::Rising, Self::Falling, Self::Changed, Self::Once, Self::SoFar, Self::Since];

    /// As it is written.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Pre => "pre",
            Self::Rising => "rising",
            Self::Falling => "falling",
            Self::Changed => "changed",
            Self::Once => "once",
            Self::SoFar => "so_far",
            Self::Since => "since",
        }
    }

    /// How many formulas it takes.
    #[must_use]
    pub fn arity(self) -> usize {
        if self == Self::Since { 2 } else { 1 }
    }
}

/// How long, and where that stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Duration {
    /// In scans, or in milliseconds.
    pub amount: Amount,
    /// Where it stands.
    pub span: Span,
}

/// A number of scans, or of milliseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Amount {
    /// Scans.
    Scans(u32),
    /// Milliseconds.
    Milliseconds(u64),
}

/// On all paths, or on some path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantifier {
    /// A
    All,
    /// E
    Some,
}

impl Quantifier {
    /// The other one.
    #[must_use]
    pub fn dual(self) -> Self {
        match self {
            Self::All => Self::Some,
            Self::Some => Self::All,
        }
    }
}

/// When along a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Temporal {
    /// X: in the next state.
    Next,
    /// F: in this state or a later one.
    Finally,
    /// G: in this state and all later ones.
    Globally,
}

/// The comparisons of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "named by their signs")]
pub enum Comparison {
    Equal,
    Unequal,
    Less,
    AtMost,
    Greater,
    AtLeast,
}

impl Comparison {
    /// Whether two numbers compare so.
    #[must_use]
    pub fn holds(self, left: i128, right: i128) -> bool {
        match self {
            Self::Equal => left == right,
            Self::Unequal => left != right,
            Self::Less => left < right,
            Self::AtMost => left <= right,
            Self::Greater => left > right,
            Self::AtLeast => left >= right,
        }
    }
}

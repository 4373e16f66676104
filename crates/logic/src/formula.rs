//! Formulas as written, not yet bound.

use super::ltl::Path;
use petril_base::source::Span;

/// A formula, or a part of one, with its span.
#[derive(Clone, Debug)]
pub struct Formula {
    /// Operator and operands.
    pub expression: Expression,
    /// Position in the text.
    pub span: Span,
}

/// Expression of a formula. Truth values and numbers are not distinguished yet.
#[derive(Clone, Debug)]
pub enum Expression {
    /// Truth constant: `TRUE` or `FALSE`.
    Truth(bool),
    /// A number, of at most 64 bits.
    Number(i128),
    /// A variable.
    Name(String),
    /// `at line 12`: control is at the line, counted from 1 as `petril flat` prints it.
    AtLine(usize),
    /// `at idle`: the PLC is idle.
    AtIdle,
    /// `at End`: control is at the end of the program.
    AtEnd,
    /// `at deadlock`: no transition is enabled.
    Deadlock,
    /// `at first scan`: there was no earlier scan.
    FirstScan,
    /// Some input has changed since the end of the previous scan.
    InputChanges,
    /// Some output has changed since the end of the previous scan.
    OutputChanges,
    /// Past operator, like `pre(f)`: about this scan and earlier ones.
    Past(Past, Vec<Formula>),
    /// `held(f, t)`: f is true, and was at the ends of all scans in the preceding time t.
    Held(Box<Formula>, Duration),
    /// `f within t`: f is true now, or will be at the end of a scan in the following time t.
    Within(Box<Formula>, Duration),
    /// `response(f, g, t)`: whenever f is true, g is true within the time t.
    Response(Box<Formula>, Box<Formula>, Duration),
    /// `marked("place")`: the place is marked.
    Marked(String),
    /// `tokens("place")`: number of tokens on the place.
    Tokens(String),
    /// `enabled("transition")`: the transition is enabled.
    Enabled(String),
    /// Negation `!f`.
    Not(Box<Formula>),
    /// Conjunction `f & g`.
    And(Box<Formula>, Box<Formula>),
    /// Disjunction `f | g`.
    Or(Box<Formula>, Box<Formula>),
    /// Implication `f -> g`.
    Implies(Box<Formula>, Box<Formula>),
    /// Equivalence `f <-> g`.
    Iff(Box<Formula>, Box<Formula>),
    /// Comparison, like `a < b`.
    Compare(Comparison, Box<Formula>, Box<Formula>),
    /// Sum `a + b`.
    Sum(Box<Formula>, Box<Formula>),
    /// Difference `a - b`.
    Difference(Box<Formula>, Box<Formula>),
    /// Product `a * b`.
    Product(Box<Formula>, Box<Formula>),
    /// Temporal operator with one operand, like `AG f`.
    Temporal(Quantifier, Temporal, Box<Formula>),
    /// Until: `A[f U g]` or `E[f U g]`, and with W if `weak`.
    Until {
        /// Path quantifier.
        quantifier: Quantifier,
        /// Whether g need not become true if f is true for ever (W).
        weak: bool,
        /// Operand f.
        hold: Box<Formula>,
        /// Operand g.
        release: Box<Formula>,
    },
    /// `LTL …`: LTL formula about all paths. Never a part of another formula.
    Ltl(Box<Path<Formula>>),
}

/// Past operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Past {
    /// `pre(f)`: value of f at the end of the previous scan; in the first scan, at power-on.
    Pre,
    /// `rising(f)`: rising edge: f is true and was not at the end of the previous scan.
    Rising,
    /// `falling(f)`: falling edge: f is not true and was at the end of the previous scan.
    Falling,
    /// `changed(f)`: the value of f differs from that at the end of the previous scan.
    Changed,
    /// `once(f)`: f is true, or was at the end of some earlier scan.
    Once,
    /// `so_far(f)`: f is true, and was at the ends of all earlier scans.
    SoFar,
    /// `since(f, g)`: g is true, or was at the end of some earlier scan, and f has been true ever since.
    Since,
}

impl Past {
    /// All past operators.
    pub const ALL: [Self; 7] =
        [Self::Pre, Self::Rising, Self::Falling, Self::Changed, Self::Once, Self::SoFar, Self::Since];

    /// Name of the operator in formulas.
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

    /// Number of operands.
    #[must_use]
    pub fn arity(self) -> usize {
        if self == Self::Since { 2 } else { 1 }
    }
}

/// A duration with its span.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Duration {
    /// Length in scans or in milliseconds.
    pub amount: Amount,
    /// Position in the text.
    pub span: Span,
}

/// Length of a duration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Amount {
    /// Number of scans.
    Scans(u32),
    /// Time in milliseconds.
    Milliseconds(u64),
}

/// Path quantifier.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantifier {
    /// A: on all paths.
    All,
    /// E: on some path.
    Some,
}

impl Quantifier {
    /// The dual quantifier.
    #[must_use]
    pub fn dual(self) -> Self {
        match self {
            Self::All => Self::Some,
            Self::Some => Self::All,
        }
    }
}

/// Temporal operator with one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Temporal {
    /// X: in the next state.
    Next,
    /// F: in this state or a later one.
    Finally,
    /// G: in this state and all later ones.
    Globally,
}

/// Comparison operators.
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
    /// Evaluates the comparison.
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

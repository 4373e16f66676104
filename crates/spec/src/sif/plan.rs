//! Test plans as data: valuations to set, expected outputs, mutation score, and what is left out.

use fixedbitset::FixedBitSet;

use super::diagram::Cube;
use super::formula::SignalId;

/// Test selection criterion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Criterion {
    /// Every allowed valuation that makes an output of the function TRUE: the seed paper's criterion.
    All,
    /// Every allowed valuation.
    AllBoth,
    /// MC/DC: each condition of a formula decides its outcome alone, once TRUE and once FALSE.
    Mcdc,
    /// A near-minimum set of tests that shows every detectable single fault.
    Faults,
    /// Pairwise: any two inputs take all value combinations that are allowed.
    Pairs,
}

impl Criterion {
    /// All criteria.
    pub const ALL: [Self; 5] = [Self::All, Self::AllBoth, Self::Mcdc, Self::Faults, Self::Pairs];

    /// Name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::All => "all",
            Self::AllBoth => "all-both",
            Self::Mcdc => "mcdc",
            Self::Faults => "faults",
            Self::Pairs => "pairs",
        }
    }
}

/// Test plan of one function.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Position of the function.
    pub function: usize,
    /// Criterion by which the tests were selected.
    pub criterion: Criterion,
    /// Inputs that the outputs are computed from, in the order of the function's sheet: the ones that tests vary. All
    /// other inputs have their rest values, or values that the restrictions require.
    pub varied: Vec<SignalId>,
    /// Outputs of any function that depend on these inputs, the function's own first. A test states the expected value
    /// of each.
    pub touched: Vec<SignalId>,
    /// Tests, ordered so that few inputs are switched from one to the next.
    pub tests: Vec<Test>,
    /// Reason why the tests do not satisfy the criterion completely, if so: their number, or what was not decided.
    pub incomplete: Option<String>,
    /// Further remarks: conditions that decide nothing, pairs of values that are not allowed.
    pub notes: Vec<String>,
    /// Whether the number of tests is proved to be minimum.
    pub is_smallest: bool,
    /// If the valuations are too many to list: some cubes of them, over the varied inputs.
    pub cubes: Vec<Cube>,
    /// Mutation score of the tests.
    pub coverage: Coverage,
}

/// Test: inputs to set, outputs to expect.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Test {
    /// Signals that are TRUE: inputs as set, outputs as expected.
    pub values: FixedBitSet,
    /// Purposes in a few words each: the condition decided, faults found by no other test. May be empty.
    pub purpose: Vec<String>,
}

/// Mutation score of a set of tests, for the single faults of a function's formulas.
#[derive(Clone, Debug, Default)]
pub struct Coverage {
    /// Scores by class of faults, in the order of the table in the documents.
    pub classes: Vec<ClassCoverage>,
    /// Detectable faults that no test finds.
    pub missed: Vec<Missed>,
}

/// Mutation score for one class of faults.
#[derive(Clone, Debug)]
pub struct ClassCoverage {
    /// Name of the class: `literal negation`.
    pub class: &'static str,
    /// Number of faults of the class.
    pub faults: usize,
    /// Number of equivalent faults: no allowed valuation shows them.
    pub equivalent: usize,
    /// Number of faults found.
    pub killed: usize,
    /// Number of faults whose detectability was not decided within the limits.
    pub undecided: usize,
}

/// Detectable fault that the tests do not find.
#[derive(Clone, Debug)]
pub struct Missed {
    /// Name of the class.
    pub class: &'static str,
    /// Fault in words: "`ACC_Tst` negated in `… & !ACC_Tst & …`".
    pub fault: String,
    /// Allowed valuation that shows the fault: signals that are TRUE.
    pub shown_by: FixedBitSet,
    /// Reason why no test finds it: "all tests expect TRUE, and this fault only makes FALSE to TRUE".
    pub why: String,
}

/// Triggering valuations of a function (an output is TRUE), and those of them that restrictions exclude.
#[derive(Clone, Debug)]
pub struct Excluded {
    /// Inputs that the function's outputs are computed from.
    pub varied: Vec<SignalId>,
    /// Number of valuations of these inputs, in decimal.
    pub valuations: String,
    /// Number of triggering valuations; `None` if it could not be counted.
    pub triggering: Option<String>,
    /// Number of triggering valuations that are excluded.
    pub excluded: Option<String>,
    /// For each restriction that excludes any: its position among all restrictions, the number of triggering valuations
    /// it excludes, and the number it excludes alone.
    pub by_restriction: Vec<(usize, String, String)>,
    /// Excluded valuations with the positions of all restrictions that exclude them, if they are few. Where no single
    /// restriction does, because further inputs are involved, these exclude the valuation jointly.
    pub listed: Option<Vec<(FixedBitSet, Vec<usize>)>>,
    /// Some cubes of the excluded valuations, if they are not listed.
    pub cubes: Vec<Cube>,
}

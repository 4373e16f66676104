//! Test plans as data: which valuations are set, what is expected of all outputs, which faults that finds, what is left out.

use fixedbitset::FixedBitSet;

use super::diagram::Cube;
use super::formula::SignalId;

/// By which rule tests are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Criterion {
    /// Every valuation that can be and makes an output of the function TRUE: the seed paper's criterion.
    All,
    /// Every valuation that can be.
    AllBoth,
    /// Each condition of a formula decides its outcome alone, once TRUE and once FALSE.
    Mcdc,
    /// A near-smallest set on which every single fault that can be seen at all is seen.
    Faults,
    /// Every two inputs have all values together that they can have.
    Pairs,
}

impl Criterion {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::All, Self::AllBoth, Self::Mcdc, Self::Faults, Self::Pairs];

    /// What it is called on the command line.
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

/// The tests of one function.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The position of the function.
    pub function: usize,
    /// How its tests were chosen.
    pub criterion: Criterion,
    /// The inputs that its outputs are computed from, in the order of its sheet: what differs from test to test. All others
    /// have their rest value, or what the restrictions need beside that.
    pub varied: Vec<SignalId>,
    /// All outputs, of any function, that depend on these inputs: its own first. A test tells what each of them has to be.
    pub touched: Vec<SignalId>,
    /// The tests, ordered so that few inputs are switched from one to the next.
    pub tests: Vec<Test>,
    /// Why these are not all tests of the criterion, if they are not: how many they are, what was not decided.
    pub incomplete: Option<String>,
    /// What is to be said besides: conditions that decide nothing, values that two inputs cannot have together.
    pub notes: Vec<String>,
    /// Whether it is proved that no fewer tests would do.
    pub is_smallest: bool,
    /// Where the valuations are too many to be listed: some of the cubes that they make up, of the inputs that vary.
    pub cubes: Vec<Cube>,
    /// Which single faults the tests find.
    pub coverage: Coverage,
}

/// One test: inputs to set, outputs to expect.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Test {
    /// All signals that are TRUE: inputs as they are set, outputs as they are expected.
    pub values: FixedBitSet,
    /// What it is for, in a few words each: the condition it decides, the faults that only it finds. May be empty.
    pub purpose: Vec<String>,
}

/// How many single faults of a function's formulas a set of tests finds.
#[derive(Clone, Debug, Default)]
pub struct Coverage {
    /// For each class of faults, in the order of the table in the documents.
    pub classes: Vec<ClassCoverage>,
    /// The faults that can be seen and are not found.
    pub missed: Vec<Missed>,
}

/// The same for one class.
#[derive(Clone, Debug)]
pub struct ClassCoverage {
    /// What the class is called: `literal negation`.
    pub class: &'static str,
    /// How many faults of it there are.
    pub faults: usize,
    /// How many of them no valuation that can be shows.
    pub equivalent: usize,
    /// How many of them the tests find.
    pub killed: usize,
    /// Of how many it was not decided, within the limits, whether they can be seen.
    pub undecided: usize,
}

/// A fault that the tests do not find, though others would.
#[derive(Clone, Debug)]
pub struct Missed {
    /// What the class is called.
    pub class: &'static str,
    /// The fault in words: "`ACC_Tst` negated in `… & !ACC_Tst & …`".
    pub fault: String,
    /// A valuation that can be and shows it: all signals that are TRUE.
    pub shown_by: FixedBitSet,
    /// Why no test does: "all tests expect TRUE, and this fault only makes FALSE to TRUE".
    pub why: String,
}

/// The valuations of a function that make an output TRUE, and which of them cannot be.
#[derive(Clone, Debug)]
pub struct Excluded {
    /// The inputs that the function's outputs are computed from.
    pub varied: Vec<SignalId>,
    /// How many valuations its inputs have, as a decimal number.
    pub valuations: String,
    /// How many make an output TRUE; nothing if that could not be counted.
    pub triggering: Option<String>,
    /// How many of these cannot be.
    pub excluded: Option<String>,
    /// For each restriction that excludes any: its position among all restrictions, how many of the triggering valuations it
    /// excludes, and how many no other restriction does.
    pub by_restriction: Vec<(usize, String, String)>,
    /// The excluded valuations with the positions of all restrictions that exclude them; only if they are few. If no restriction
    /// does alone, because they speak of further inputs, these exclude it together.
    pub listed: Option<Vec<(FixedBitSet, Vec<usize>)>>,
    /// Some of the cubes that the excluded valuations make up, if they are not listed.
    pub cubes: Vec<Cube>,
}

//! Free inputs: those that no plant drives. Enumerates the combinations of values that a scan may read.

use smallvec::{SmallVec, smallvec};

use crate::translate::{Domain, System};
use petril_lang::semantics::VarId;

/// Maximum number of successors of a state per marking of the plant; more would take minutes and gigabytes for one
/// state.
pub const MAX_FAN_OUT: u128 = 1 << 24;

/// Free inputs of a system, with their values.
pub struct FreeInputs {
    inputs: Vec<FreeInput>,
}

/// A free input and its possible values.
struct FreeInput {
    variable: VarId,
    name: String,
    domain: Domain,
    /// Bit patterns of the values in the order in which they are tried: 0 comes before negative numbers.
    patterns: Vec<u64>,
}

impl FreeInputs {
    /// Collects the free inputs of a system.
    pub fn new(system: &System) -> Self {
        let free = system.free_inputs().map(|variable| FreeInput {
            variable,
            name: system.program.variable(variable).name.clone(),
            domain: system.domain(variable),
            patterns: Vec::new(),
        });
        let mut free = Self { inputs: free.collect() };
        // With more combinations the patterns are never used.
        if free.combinations() <= MAX_FAN_OUT {
            for input in &mut free.inputs {
                input.patterns = input.domain.patterns().collect();
                input.patterns.sort_unstable();
            }
        }
        free
    }

    /// Number of combinations of values.
    pub fn combinations(&self) -> u128 {
        self.inputs.iter().fold(1, |product, input| product.saturating_mul(input.domain.size()))
    }

    /// Explains why there are too many combinations to try, and what to do about it; `None` if there are not.
    pub fn refusal(&self) -> Option<String> {
        if self.combinations() <= MAX_FAN_OUT {
            return None;
        }
        let mut wide: Vec<&FreeInput> = self.inputs.iter().collect();
        // The widest first; those of one size stay in their order.
        wide.sort_by_key(|input| std::cmp::Reverse(input.domain.size()));
        let values = |input: &&FreeInput| format!("`{}` ({} values)", input.name, input.domain.size());
        let mut names: Vec<String> = wide.iter().take(4).map(values).collect();
        if wide.len() > 4 {
            names.push(format!("{} more", wide.len() - 4));
        }
        let widest = wide.first().map_or("x", |input| input.name.as_str());
        let advice = if wide.first().is_some_and(|input| input.domain.size() > 2) {
            format!("say which values matter, as with `--domain '{widest}: 0..100'`, or what a plant can give them")
        } else {
            format!(
                "say with a plant or an assumption what cannot happen, or which values matter: `--domain '{widest}: FALSE'` \
                 keeps one as it is"
            )
        };
        let names = names.join(", ");
        Some(format!("a scan can read more than {MAX_FAN_OUT} combinations of values of the inputs {names}: {advice}"))
    }

    /// Calls `each` with each combination once. The last input changes fastest.
    pub fn for_each(&self, mut each: impl FnMut(&Setting<'_>)) {
        let mut digits: SmallVec<[usize; 16]> = smallvec![0; self.inputs.len()];
        let mut turned = 0;
        loop {
            each(&Setting { inputs: &self.inputs, digits: &digits, turned });
            let more = |(&digit, input): (&usize, &FreeInput)| digit + 1 < input.patterns.len();
            let Some(turn) = digits.iter().zip(&self.inputs).rposition(more) else { return };
            digits[turn] += 1;
            digits[turn + 1..].fill(0);
            turned = turn;
        }
    }
}

/// A combination of values.
pub struct Setting<'f> {
    inputs: &'f [FreeInput],
    digits: &'f [usize],
    /// Position of the first input whose value differs from the previous combination.
    turned: usize,
}

impl Setting<'_> {
    /// The inputs with their values.
    pub fn values(&self) -> impl Iterator<Item = (VarId, u64)> {
        let inputs = self.inputs.iter().zip(self.digits);
        inputs.map(|(input, &digit)| (input.variable, input.patterns[digit]))
    }

    /// The inputs from the first whose value differs from the previous combination, with their values; all of them in
    /// the first.
    pub fn changed(&self) -> impl Iterator<Item = (VarId, u64)> {
        self.values().skip(self.turned)
    }
}

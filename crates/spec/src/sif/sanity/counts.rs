//! Number of valuations of a function, and of those that restrictions leave for tests.
//!
//! Restrictions exclude a valuation of the inputs a function is computed from if they exclude it whatever the other
//! inputs are. Latched or delayed outputs count as their formulas.

use super::super::cone::Cone;
use super::super::diagram::{Diagram, Diagrams};
use super::super::formula::SignalId;
use super::super::solver::Stop;
use super::super::specification::{Restriction, Specification};

/// Node limit of the diagrams. Beyond it, counts are missing.
const NODES: usize = 20_000;

/// Counts for one output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Counts {
    /// Output.
    pub output: SignalId,
    /// Number of inputs the output is computed from.
    pub inputs: usize,
    /// Number of valuations that make it TRUE; here and below, `None` if it cannot be counted.
    pub triggers: Option<String>,
    /// Restrictions that exclude some of these valuations.
    pub excluded: Vec<Excluded>,
    /// Number of valuations left.
    pub left: Option<String>,
}

/// Effect of a restriction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Excluded {
    /// Position of the restriction.
    pub restriction: usize,
    /// Number of valuations that it excludes by itself.
    pub by_itself: Option<String>,
    /// Number of valuations left under this restriction and all before it.
    pub left: Option<String>,
}

/// Counts for all outputs of a function.
#[must_use]
pub fn counts(specification: &Specification, function: usize, stop: &Stop) -> Vec<Counts> {
    let cone = Cone::of_function(specification, function);
    let mut counting = Counting::new(&cone, stop);
    let outputs = specification.functions[function].outputs.iter();
    outputs.map(|output| counting.counts(*output)).collect()
}

struct Counting<'c, 's> {
    cone: &'c Cone<'s>,
    diagrams: Option<Diagrams>,
    /// Diagram of each signal, if not too large.
    signals: Vec<Option<Diagram>>,
    stop: &'c Stop,
}

impl<'c, 's> Counting<'c, 's> {
    fn new(cone: &'c Cone<'s>, stop: &'c Stop) -> Self {
        let count = cone.specification.signals.len();
        let diagrams = Diagrams::over(cone.all_inputs().collect(), count, NODES);
        let mut counting = Self { cone, diagrams, signals: vec![None; count], stop };
        let Some(diagrams) = &counting.diagrams else { return counting };
        for input in cone.all_inputs() {
            counting.signals[input.0] = diagrams.signal(input);
        }
        for &id in &cone.definitions {
            if stop() {
                break;
            }
            let formula = cone.specification.definition(id);
            counting.signals[id.0] =
                formula.and_then(|formula| diagrams.formula(formula, &|signal| counting.signals[signal.0].clone()));
        }
        counting
    }

    fn counts(&mut self, output: SignalId) -> Counts {
        // Inputs of this output only.
        let specification = self.cone.specification;
        let own = Cone::of(specification, &[output], Vec::new()).inputs;
        let mut counts = Counts { output, inputs: own.len(), triggers: None, excluded: Vec::new(), left: None };
        let (Some(diagrams), Some(is_true)) = (&self.diagrams, self.signals[output.0].clone()) else { return counts };
        let others: Vec<SignalId> = self.cone.all_inputs().filter(|input| !own.contains(input)).collect();
        let count = |set: &Diagram| diagrams.count_without(set, &others);
        counts.triggers = Some(count(&is_true));
        // Cumulative: the valuations left are projected onto this output's own inputs.
        let mut allowed = Some(diagrams.constant(true));
        for (at, restriction) in self.restrictions() {
            if (self.stop)() {
                return Counts { excluded: Vec::new(), left: None, ..counts };
            }
            let word = diagrams.formula(&restriction.allowed, &|signal| self.signals[signal.0].clone());
            let excluded = word.as_ref().and_then(|word| {
                let possible = diagrams.whatever(word, &others)?;
                diagrams.and(&is_true, &possible.complement())
            });
            allowed = allowed.zip(word).and_then(|(allowed, word)| diagrams.and(&allowed, &word));
            if excluded.as_ref().is_some_and(Diagram::is_empty) {
                continue;
            }
            let left = allowed.as_ref().and_then(|allowed| diagrams.whatever(allowed, &others));
            let left = left.and_then(|possible| diagrams.and(&is_true, &possible));
            counts.excluded.push(Excluded {
                restriction: at,
                by_itself: excluded.as_ref().map(count),
                left: left.as_ref().map(count),
            });
        }
        let left = allowed.and_then(|allowed| diagrams.whatever(&allowed, &others));
        counts.left = left.and_then(|possible| diagrams.and(&is_true, &possible)).as_ref().map(count);
        counts
    }

    /// Restrictions of the cone, with their positions.
    fn restrictions(&self) -> Vec<(usize, &'s Restriction)> {
        let mut kept = self.cone.restrictions.iter().peekable();
        let all = self.cone.specification.restrictions.iter().enumerate();
        all.filter(|(_, restriction)| kept.next_if(|kept| std::ptr::eq(**kept, *restriction)).is_some()).collect()
    }
}

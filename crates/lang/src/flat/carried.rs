//! Live variables at the beginning of a scan: those that carry a value from one scan to the next.

use std::collections::BTreeMap;

use fixedbitset::FixedBitSet;

use super::{Condition, FlatProgram, Instruction, Target};
use crate::semantics::{Role, VarId};

impl FlatProgram {
    /// Variables, as positions, whose values at the beginning of a scan can make a difference in it or after it.
    ///
    /// The others are written before they are read on every path from the first line to the end, like an output that is
    /// computed anew in every scan, or are inputs or buffers. Two states that differ only in these have the same
    /// future.
    #[must_use]
    pub fn carried(&self) -> FixedBitSet {
        let variables = self.variables.len();
        let mut carried = FixedBitSet::with_capacity(variables);
        let meetings = self.meetings();
        // For lines yet to be visited, in their order: the variables written on every known path to the line. The set
        // goes from line to line, and is copied only where control branches.
        let mut waiting = BTreeMap::from([(0, FixedBitSet::with_capacity(variables))]);
        let mut known: BTreeMap<usize, FixedBitSet> = BTreeMap::new();
        // Unreachable lines make no difference.
        while let Some((line, mut written)) = waiting.pop_first() {
            if meetings.contains(line) {
                let before = known.get(&line);
                before.iter().for_each(|before| written.intersect_with(before));
                if before == Some(&written) {
                    continue;
                }
                known.insert(line, written.clone());
            }
            let Some(code) = self.code.get(line) else {
                carried.extend((0..variables).filter(|&id| !written.contains(id)));
                continue;
            };
            carried.extend(reads(code.instruction).map(|id| id.0).filter(|&id| !written.contains(id)));
            if let Instruction::Store { target: Target::Variable(variable), .. } = code.instruction {
                written.insert(variable.0);
            }
            let [next, other] = successors(line, code.instruction);
            if let Some(other) = other {
                meet(&mut waiting, other, written.clone());
            }
            if let Some(next) = next {
                meet(&mut waiting, next, written);
            }
        }
        // Inputs are copied before the first line; a buffer is read only right after it was written.
        self.with_role(Role::Input).chain(self.with_role(Role::Buffer)).for_each(|id| carried.set(id.0, false));
        carried
    }

    /// Targets of jumps that may be visited again, because a jump back leads over them: their sets have to be kept. All
    /// other lines are visited once if lines are taken in their order.
    fn meetings(&self) -> FixedBitSet {
        let jumps = self.code.iter().enumerate().filter_map(|(line, code)| match code.instruction {
            Instruction::Jump { target, .. } => Some((line, target)),
            _ => None,
        });
        let mut lines = FixedBitSet::with_capacity(self.end() + 1);
        let mut again = FixedBitSet::with_capacity(self.end() + 1);
        for (line, target) in jumps {
            lines.insert(target);
            if target <= line {
                again.insert_range(target..line + 1);
            }
        }
        lines.intersect_with(&again);
        lines
    }
}

/// Adds a path to a line: of the variables written, only those written on the known paths, too, remain.
fn meet(waiting: &mut BTreeMap<usize, FixedBitSet>, line: usize, written: FixedBitSet) {
    match waiting.get_mut(&line) {
        Some(known) => known.intersect_with(&written),
        None => drop(waiting.insert(line, written)),
    }
}

/// Variables whose old values an instruction may need. Set and reset keep the old value if the current result is FALSE.
fn reads(instruction: Instruction) -> impl Iterator<Item = VarId> {
    let kept = if let Instruction::Set(kept) | Instruction::Reset(kept) = instruction { Some(kept) } else { None };
    let index = match instruction.writes() {
        Some(Target::Element(element)) => Some(Target::Variable(element.index)),
        _ => None,
    };
    instruction.reads().into_iter().chain(kept).chain(index).flat_map(variables)
}

/// Variables that reading an operand may access.
fn variables(target: Target) -> Vec<VarId> {
    match target {
        Target::Variable(variable) => vec![variable],
        Target::Element(element) => element.all().chain([element.index]).collect(),
    }
}

/// Lines that can be executed next.
fn successors(line: usize, instruction: Instruction) -> [Option<usize>; 2] {
    match instruction {
        Instruction::Jump { condition: Condition::Always, target } => [Some(target), None],
        Instruction::Jump { target, .. } => [Some(target), Some(line + 1)],
        _ => [Some(line + 1), None],
    }
}

#[cfg(test)]
mod tests {
    use crate::flat::{FlatProgram, flatten};
    use crate::semantics::check;
    use crate::syntax::parse;
    use petril_base::source::Source;

    /// Names of the variables that a program with inputs i, j, memory m, n and outputs p, q carries over.
    fn carried(body: &str) -> Vec<String> {
        let text = format!(
            "PROGRAM x VAR_INPUT i, j : BOOL; END_VAR VAR m, n : BOOL; END_VAR VAR_OUTPUT p, q : BOOL; END_VAR\n{body}\nEND_PROGRAM"
        );
        let (unit, errors) = parse(&Source::new("test", text));
        let (program, more) = check(&unit, errors.is_empty());
        let program: FlatProgram = flatten(&program.unwrap_or_else(|| panic!("{errors:?} {more:?}")));
        program.carried().ones().map(|id| program.variables[id].name.clone()).collect()
    }

    #[test]
    fn what_is_written_first_on_every_way_is_not_carried() {
        assert_eq!(carried("LD i\nST m\nST n\nST p\nST q"), [""; 0]);
        assert_eq!(carried("LD m\nST m\nST n\nST p\nST q"), ["m"], "it is read first");
        assert_eq!(carried("LD i\nST m\nST n\nST p"), ["q"], "it keeps its value");
        assert_eq!(carried("LD i\nST m\nS n\nST p\nR q"), ["n", "q"], "they may keep their values");
        assert_eq!(
            carried("LD i\nST m\nS m\nST n\nR n\nST p\nST q"),
            [""; 0],
            "they are set and reset after they are written"
        );
    }

    #[test]
    fn every_way_counts() {
        let start = "LD i\nST n\nST p\nST q\n";
        assert_eq!(carried(&format!("{start}JMPC on\nST m\non: LD m\nST p")), ["m"], "one way leaves it out");
        assert_eq!(carried(&format!("{start}JMPC on\nST m\nJMP off\non: STN m\noff: LD m\nST p")), [""; 0]);
        assert_eq!(carried(&format!("{start}JMPC on\nST m\nRET\non: LD j\nST m\nRET\nLD m\nST p")), [""; 0]);
        assert_eq!(carried(&format!("back: {start}ST m\nJMPC back\nLD m\nST q")), [""; 0], "a loop");
        let twice = "JMPC off\nST m\noff: LD j\nJMPC in\nLD m\nST p\nin: STN n\nLD j\nJMPC off\n";
        assert_eq!(carried(&format!("{start}{twice}")), ["m"], "in a loop, two ways meet");
        assert_eq!(carried(&format!("{start}ST m\n{twice}")), [""; 0], "in a loop, two ways meet");
        let later = "JMPC in\nback: LD m\nST p\nin: LD i\nJMPC out\nLD j\nJMPC back\nout: LD i\nST m\n";
        assert_eq!(carried(&format!("{start}{later}")), ["m"], "a loop is entered in its middle");
    }

    #[test]
    fn buffers_are_not_carried() {
        let start = "LD i\nST m\nST n\nST p\nST q\nJMPC on\n";
        assert_eq!(carried(&format!("{start}AND( j\nOR( i\n)\n)\nST q\non:")), [""; 0]);
    }
}

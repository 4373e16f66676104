//! Which variables carry something from one scan to the next.

use fixedbitset::FixedBitSet;

use super::{Condition, FlatProgram, Instruction, Target};
use crate::semantics::{Role, VarId};

impl FlatProgram {
    /// The variables whose values at the beginning of a scan can make a difference in it or after it, as positions.
    ///
    /// The others are written before they are read on every way from the first line to the end, like an output that is
    /// computed anew in every scan, or are inputs or buffers. Two states that differ in them only have the same future.
    #[must_use]
    pub fn carried(&self) -> FixedBitSet {
        let variables = self.variables.len();
        let mut carried = FixedBitSet::with_capacity(variables);
        for (line, written) in self.written_before().iter().enumerate() {
            // A line that control never comes to makes no difference.
            let Some(written) = written else { continue };
            match self.code.get(line) {
                Some(code) => {
                    carried.extend(reads(code.instruction).map(|id| id.0).filter(|&id| !written.contains(id)));
                }
                None => carried.extend((0..variables).filter(|&id| !written.contains(id))),
            }
        }
        // Inputs are copied before the first line; a buffer is read only right after it was written.
        self.with_role(Role::Input).chain(self.with_role(Role::Buffer)).for_each(|id| carried.set(id.0, false));
        carried
    }

    /// For each line and the end, the variables that are written on every way to it; `None` if there is no way.
    fn written_before(&self) -> Vec<Option<FixedBitSet>> {
        let mut before: Vec<Option<FixedBitSet>> = vec![None; self.end() + 1];
        before[0] = Some(FixedBitSet::with_capacity(self.variables.len()));
        let mut work = vec![0];
        while let Some(line) = work.pop() {
            let (Some(code), Some(written)) = (self.code.get(line), &before[line]) else { continue };
            let mut after = written.clone();
            if let Instruction::Store { target: Target::Variable(variable), .. } = code.instruction {
                after.insert(variable.0);
            }
            for next in successors(line, code.instruction).into_iter().flatten() {
                let joined = match &before[next] {
                    None => after.clone(),
                    Some(known) => known & &after,
                };
                if before[next].as_ref() != Some(&joined) {
                    before[next] = Some(joined);
                    work.push(next);
                }
            }
        }
        before
    }
}

/// The variables whose old values an instruction may need. Setting and resetting keep the old value if the current result
/// is FALSE.
fn reads(instruction: Instruction) -> impl Iterator<Item = VarId> {
    let kept = if let Instruction::Set(kept) | Instruction::Reset(kept) = instruction { Some(kept) } else { None };
    let index = match instruction.writes() {
        Some(Target::Element(element)) => Some(Target::Variable(element.index)),
        _ => None,
    };
    instruction.reads().into_iter().chain(kept).chain(index).flat_map(variables)
}

/// The variables that reading an operand may look at.
fn variables(target: Target) -> Vec<VarId> {
    match target {
        Target::Variable(variable) => vec![variable],
        Target::Element(element) => element.all().chain([element.index]).collect(),
    }
}

/// The lines control can go to.
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
    use crate::source::Source;
    use crate::syntax::parse;

    /// The names of the variables that a program with inputs i, j, memory m, n and outputs p, q carries over.
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
    }

    #[test]
    fn buffers_are_not_carried() {
        let start = "LD i\nST m\nST n\nST p\nST q\nJMPC on\n";
        assert_eq!(carried(&format!("{start}AND( j\nOR( i\n)\n)\nST q\non:")), [""; 0]);
    }
}

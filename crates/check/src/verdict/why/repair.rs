//! Repair of a counterexample: a smallest set of input changes with which the repeated run satisfies the requirement.

use std::cell::Cell;

use super::Broken;
use super::candidates::{Candidates, Slot, candidates};
use super::rerun::{Again, Rerun};
use crate::scans::Position;
use crate::verdict::views::{ScanStates, SystemView};
use crate::verdict::{Change, Repair};
use crate::witness::{Disagreement, ScanTrace};
use petril_lang::semantics::VarId;
use petril_logic::{Bound, Node, Quantifier, along};

/// Upper bound on the size of a repair found by trying all sets; larger ones explain little.
const MOST: usize = 4;
/// Upper bound on a set found by shrinking, so that all its subsets can be tried.
const FEW: usize = 6;
/// Approximate upper bound on instructions executed for one requirement.
const WORK: usize = 20_000_000;
/// Upper bound on alternative repairs reported.
const OTHERS: usize = 3;

/// Outcome of a run with changed inputs.
enum Trial {
    /// The run still violates the requirement.
    Breaks,
    /// The run satisfies the requirement.
    Repaired(Again),
    /// The system has no such run, or its outcome is not known.
    Impossible,
}

/// Searches for a repair; the error is the reason why there is none.
pub fn repair(broken: &Broken<'_>, scans: &dyn ScanStates, trace: &ScanTrace) -> Result<Repair, String> {
    let again = || "the run cannot be made again with given inputs".to_owned();
    let scan_length = scans.base().space.system().program.end() + 16;
    if trace.scans.len().saturating_mul(scan_length) > WORK {
        return Err("it is too long to be made again with other inputs".to_owned());
    }
    let rerun = Rerun::new(scans, trace).ok_or_else(again)?;
    let universal = broken.dag.is_universal(broken.negation);
    if universal && !broken.graph.is_complete() {
        return Err("not all states were explored".to_owned());
    }
    let itself = rerun.itself();
    let ends: Vec<Position> = itself.ends.iter().map(|end| end.position.clone()).collect();
    let space = &scans.base().space;
    let search = Search { broken, scans, rerun, universal, scan_length, judged: Cell::default() };
    if !matches!(search.judged(itself), Trial::Breaks) {
        return Err("one run alone does not show that the requirement is broken".to_owned());
    }
    let initial = broken.labels.of(broken.negation);
    let on_all_paths = matches!(
        broken.dag.node(broken.negation),
        Node::Next(Quantifier::All, _) | Node::Until(Quantifier::All, ..) | Node::WeakUntil(Quantifier::All, ..)
    );
    if on_all_paths && broken.graph.initial().iter().all(|&id| initial.contains(id as usize)) {
        return Err(in_common());
    }
    let candidates = candidates(broken, space, trace, &ends);
    search.smallest(&candidates)
}

/// Reason when every run violates the requirement.
fn in_common() -> String {
    "it is broken by what all runs have in common, not by the inputs of this one".to_owned()
}

struct Search<'a> {
    broken: &'a Broken<'a>,
    scans: &'a dyn ScanStates,
    rerun: Rerun<'a>,
    /// Whether the violation depends on a claim about all paths.
    universal: bool,
    /// Cost of a scan, in instructions.
    scan_length: usize,
    /// Evaluations of formulas at positions. Each costs about an instruction.
    judged: Cell<usize>,
}

impl Search<'_> {
    fn is_exhausted(&self, work: usize) -> bool {
        self.rerun.computed() * self.scan_length + self.judged.get() > work
    }

    /// Repeats the run with changes.
    fn tried(&self, changes: &[Change]) -> Trial {
        self.rerun.with(changes).map_or(Trial::Impossible, |again| self.judged(again))
    }

    /// Decides whether a run violates the requirement.
    fn judged(&self, again: Again) -> Trial {
        let Broken { dag, labels, .. } = *self.broken;
        let mut ids = Vec::new();
        if self.universal {
            let packed = self.packed_run(&again);
            let closes = again.loop_start.is_none_or(|start| packed.get(start) == packed.last());
            let Some(numbers) = self.numbers(&packed, &again).filter(|_| closes) else { return Trial::Impossible };
            ids = numbers;
        }
        let run = (again.length(), again.loop_start);
        self.judged.set(self.judged.get() + again.length() * dag.nodes().len());
        let everywhere = |node, at: usize| self.universal && labels.of(node).contains(ids[at] as usize);
        let truths = along(dag, run, &|formula, at| self.holds(formula, &again, at), &everywhere);
        if truths[self.broken.negation.index()][0] { Trial::Breaks } else { Trial::Repaired(again) }
    }

    fn packed_run(&self, again: &Again) -> Vec<Vec<u64>> {
        let ends: Vec<Position> = again.ends.iter().map(|end| end.position.clone()).collect();
        self.scans.base().space.packed_run(&ends)
    }

    fn holds(&self, formula: &Bound, again: &Again, at: usize) -> bool {
        self.scans.holds_after(formula, &again.ends[at].packed, &again.ends[at].memory)
    }

    /// Numbers of the run's states in the graph.
    fn numbers(&self, packed: &[Vec<u64>], again: &Again) -> Option<Vec<u32>> {
        let graph = self.broken.graph;
        let mut ids: Vec<u32> = Vec::with_capacity(packed.len());
        for (state, end) in packed.iter().zip(&again.ends) {
            let next = ids.last().map_or(graph.initial(), |&id| graph.successors(id));
            let same = |&id: &u32| self.scans.parts(graph.state(id)) == (state.as_slice(), end.memory.as_slice());
            ids.push(next.iter().copied().find(same)?);
        }
        Some(ids)
    }

    /// Tries sets of one change, then of two, and so on.
    fn smallest(&self, candidates: &Candidates) -> Result<Repair, String> {
        let mut found: Vec<Vec<Change>> = Vec::new();
        for size in 1..=MOST {
            self.choose(&candidates.slots, size, &mut Vec::new(), &mut found);
            if !found.is_empty() {
                // All smaller sets were tried: the budget is checked before each size.
                let is_smallest = candidates.are_all && !self.universal && !self.rerun.gave_up();
                return self.confirmed(found, is_smallest);
            }
            if self.is_exhausted(WORK) {
                break;
            }
        }
        let all_tried = candidates.are_all && !self.is_exhausted(WORK) && !self.rerun.gave_up();
        let enough = self.shrunk(&candidates.slots).ok_or_else(|| match all_tried {
            true => "this run would break it with any other values of up to four of its inputs, too".to_owned(),
            false => {
                "among other values of its inputs, as far as they were tried, none keep this run from it".to_owned()
            }
        })?;
        self.confirmed(vec![enough], false)
    }

    /// Tries every set of exactly `size` changes: within one slot first, then across slots.
    fn choose(&self, slots: &[Slot], size: usize, chosen: &mut Vec<Change>, found: &mut Vec<Vec<Change>>) {
        let of = |slot: &'_ Slot, fits: &dyn Fn(usize) -> bool| -> Vec<Vec<Change>> {
            slot.alternatives.iter().filter(|changes| fits(changes.len())).cloned().collect()
        };
        for slot in slots {
            for changes in of(slot, &|length| length == size) {
                if self.is_exhausted(WORK) || found.len() > OTHERS {
                    return;
                }
                chosen.extend_from_slice(&changes);
                let repairs = matches!(self.tried(chosen), Trial::Repaired(_));
                found.extend(repairs.then(|| chosen.clone()));
                chosen.truncate(chosen.len() - size);
                if repairs {
                    break;
                }
            }
        }
        for (position, slot) in slots.iter().enumerate() {
            for changes in of(slot, &|length| length < size) {
                if !found.is_empty() {
                    return;
                }
                chosen.extend_from_slice(&changes);
                self.choose(&slots[position + 1..], size - changes.len(), chosen, found);
                chosen.truncate(chosen.len() - changes.len());
            }
        }
    }

    /// A sufficient set of changes found by shrinking a large one: inputs held at their values before some scan, in
    /// this scan only or from then on. Unneeded changes are removed one by one (as in delta debugging).
    fn shrunk(&self, slots: &[Slot]) -> Option<Vec<Change>> {
        for scan in (0..self.rerun.trace().scans.len()).rev() {
            if self.is_exhausted(2 * WORK) {
                return None;
            }
            // Selecting the slots has a cost, too.
            self.judged.set(self.judged.get() + 2 * slots.len());
            let before = self.before(scan);
            for for_ever in [false, true] {
                let concerned = slots.iter().filter(|slot| slot.scan == scan || (for_ever && slot.scan > scan));
                let held = concerned.map(|slot| slot.changed_to(&before)).filter(|changes| !changes.is_empty());
                let mut set: Vec<Vec<Change>> = held.collect();
                if set.is_empty() || !self.is_enough(&set) {
                    continue;
                }
                for position in (0..set.len()).rev() {
                    let part = set.remove(position);
                    if !self.is_enough(&set) {
                        set.insert(position, part);
                    }
                }
                if set.len() <= FEW {
                    return self.part_that_is_enough(&set).map(|set| set.concat());
                }
            }
        }
        None
    }

    /// A smallest sufficient subset.
    fn part_that_is_enough(&self, set: &[Vec<Change>]) -> Option<Vec<Vec<Change>>> {
        let part = |bits: u32| set.iter().enumerate().filter(move |(i, _)| bits >> i & 1 == 1).map(|(_, c)| c.clone());
        let mut parts: Vec<u32> = (1..1 << set.len()).collect();
        parts.sort_by_key(|bits: &u32| bits.count_ones());
        parts.into_iter().map(|bits| part(bits).collect::<Vec<_>>()).find(|part| self.is_enough(part))
    }

    fn is_enough(&self, set: &[Vec<Change>]) -> bool {
        !self.is_exhausted(2 * WORK) && matches!(self.tried(&set.concat()), Trial::Repaired(_))
    }

    /// Inputs of the preceding scan; before the first scan, those the plant gives at power-on, and initial values.
    fn before(&self, scan: usize) -> Vec<(VarId, u64)> {
        if let Some(earlier) = scan.checked_sub(1) {
            return self.rerun.trace().scans[earlier].inputs.clone();
        }
        let system = self.scans.base().system();
        let given = system.plant.components.iter().filter_map(|component| component.markings.first());
        let given = given.flat_map(|marking| marking.inputs.iter().copied());
        let free = system.free_inputs().map(|input| (input, system.program.variable(input).initial));
        given.chain(free).collect()
    }

    /// The first repair with its alternatives, each confirmed by a replay of the repaired run.
    fn confirmed(&self, found: Vec<Vec<Change>>, is_smallest: bool) -> Result<Repair, String> {
        let mut sets = Vec::new();
        for mut changes in found {
            let Trial::Repaired(again) = self.tried(&changes) else { continue };
            self.replay(&again).map_err(|disagreement| {
                format!("the replay refutes a run with other inputs, which is an error in Petril: {disagreement}")
            })?;
            changes.sort_by_key(|change| (change.scan, change.input));
            sets.push(changes);
        }
        let mut sets = sets.into_iter();
        let changes = sets.next().ok_or("it cannot be confirmed")?;
        Ok(Repair { is_smallest: is_smallest || changes.len() == 1, changes, others: sets.collect() })
    }

    /// Replays a run on the net and compares the value of every state formula.
    fn replay(&self, again: &Again) -> Result<(), Disagreement> {
        let packed = self.packed_run(again);
        let states: Vec<&[u64]> = packed.iter().map(Vec::as_slice).collect();
        let Broken { view, dag, .. } = *self.broken;
        self.scans.base().replayed(&states, None, &|position, holds| {
            for node in dag.nodes() {
                let Node::State { formula, .. } = node else { continue };
                if holds(formula) != Some(self.holds(formula, again, position)) {
                    let text = formula.text(view.system());
                    return Err(Disagreement(format!("after scan {}, `{text}`", position + 1)));
                }
            }
            Ok(())
        })?;
        Ok(())
    }
}

//! Which inputs matter: other values of as few of them as can be with which the run, made again, breaks nothing.

use std::cell::Cell;

use super::Broken;
use super::candidates::{Candidates, Slot, candidates};
use super::rerun::{Again, Rerun};
use crate::explore::Position;
use crate::logic::{Bound, Node, Quantifier, along};
use crate::verdict::views::{ScanStates, SystemView};
use crate::verdict::{Change, Repair};
use crate::witness::{Disagreement, ScanTrace};
use petril_lang::semantics::VarId;

/// More inputs than these tell nobody anything.
const MOST: usize = 4;
/// A set found by shrinking a large one may have so many parts, so that all parts of it can be tried.
const FEW: usize = 6;
/// Instructions executed for one requirement, at most about.
const WORK: usize = 20_000_000;
/// Other repairs that are told.
const OTHERS: usize = 3;

/// What becomes of a run with other inputs.
enum Trial {
    /// It still breaks the requirement.
    Breaks,
    /// It does not.
    Repaired(Again),
    /// The system has no such run, or it is not known what becomes of it.
    Impossible,
}

/// The inputs that matter, or why none are told.
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

/// The reason where no run does better.
fn in_common() -> String {
    "it is broken by what all runs have in common, not by the inputs of this one".to_owned()
}

struct Search<'a> {
    broken: &'a Broken<'a>,
    scans: &'a dyn ScanStates,
    rerun: Rerun<'a>,
    /// Whether the break rests on something that is so on all paths.
    universal: bool,
    /// What a scan costs, in instructions.
    scan_length: usize,
    /// Positions at which formulas were looked at. Each costs about an instruction.
    judged: Cell<usize>,
}

impl Search<'_> {
    fn is_exhausted(&self, work: usize) -> bool {
        self.rerun.computed() * self.scan_length + self.judged.get() > work
    }

    /// Makes the run again.
    fn tried(&self, changes: &[Change]) -> Trial {
        self.rerun.with(changes).map_or(Trial::Impossible, |again| self.judged(again))
    }

    /// Whether a run breaks the requirement.
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

    /// The numbers of the states in the graph.
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

    /// Tries one input, then two, and so on.
    fn smallest(&self, candidates: &Candidates) -> Result<Repair, String> {
        let mut found: Vec<Vec<Change>> = Vec::new();
        for size in 1..=MOST {
            self.choose(&candidates.slots, size, &mut Vec::new(), &mut found);
            if !found.is_empty() {
                // All smaller sets were tried: the work is looked at before each size.
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

    /// Tries every choice of changes to so many inputs: of one slot, then of several.
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

    /// A set of changes that is enough, found from a large one: the inputs as if they had stayed what they were before some scan, in
    /// this scan only or from then on. What is not needed is left out.
    fn shrunk(&self, slots: &[Slot]) -> Option<Vec<Change>> {
        for scan in (0..self.rerun.trace().scans.len()).rev() {
            if self.is_exhausted(2 * WORK) {
                return None;
            }
            // Looking for what is concerned costs something, too.
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

    /// A smallest part of a set that is enough.
    fn part_that_is_enough(&self, set: &[Vec<Change>]) -> Option<Vec<Vec<Change>>> {
        let part = |bits: u32| set.iter().enumerate().filter(move |(i, _)| bits >> i & 1 == 1).map(|(_, c)| c.clone());
        let mut parts: Vec<u32> = (1..1 << set.len()).collect();
        parts.sort_by_key(|bits: &u32| bits.count_ones());
        parts.into_iter().map(|bits| part(bits).collect::<Vec<_>>()).find(|part| self.is_enough(part))
    }

    fn is_enough(&self, set: &[Vec<Change>]) -> bool {
        !self.is_exhausted(2 * WORK) && matches!(self.tried(&set.concat()), Trial::Repaired(_))
    }

    /// The inputs of the scan before one; before the first one, those that the plant gives at power-on, and initial values.
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

    /// The first repair, and the others, after a replay of the runs with them.
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

    /// Replays a run on the net, and compares what it is said to show with what the replay shows.
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

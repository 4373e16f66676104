//! Runs as the page plays them: changes, line by line, in a compact form.
//!
//! Variables are positions in the list of shown ones, lines count from 0, values are 0 and 1 or texts.

use std::collections::BTreeMap;

use serde_json::{Map, Value, json};

use super::nets::Nets;
use crate::exchange::checked::{Checked, Purpose};
use petril_check::translate::{System, TransitionRole};
use petril_check::verdict::{Answer, Focus, Trace, Witness};
use petril_check::witness::{Executed, FiringTrace, Piece, ScanTrace, ToldScan, firing_story, story};
use petril_lang::flat::value_text;
use petril_lang::semantics::{Role, VarId};
use petril_net::net::TransitionId;

/// Upper bound on the instructions of a run listed completely.
const MAX_INSTRUCTIONS: usize = 20_000;

/// Remaining capacity of the page.
pub struct Room {
    /// Number of instructions.
    pub instructions: usize,
    /// Number of firings.
    pub firings: usize,
}

impl Default for Room {
    fn default() -> Self {
        Self { instructions: 150_000, firings: 250_000 }
    }
}

/// Writer of runs, one by one.
pub struct Runs<'a> {
    checked: Checked<'a>,
    /// Position of each variable in the list of shown ones.
    shown: BTreeMap<VarId, usize>,
    room: Room,
    /// Nets on which the tokens of the runs move.
    pub nets: Nets<'a>,
}

impl<'a> Runs<'a> {
    pub fn new(checked: Checked<'a>) -> Self {
        let shown = shown(checked.system).enumerate().map(|(position, id)| (id, position)).collect();
        Self { checked, shown, room: Room::default(), nets: Nets::new(checked.system) }
    }

    pub fn run(&mut self, answer: &Answer, purpose: Purpose, witness: &Witness) -> Value {
        let mut run = match &witness.trace {
            Trace::Scans(trace) => self.scans(trace),
            Trace::Firings(trace) => self.firings(trace),
        };
        run["purpose"] = purpose.word().into();
        self.shorten(&mut run, &Focus::of(answer, witness), &witness.trace);
        let view = self.checked.view();
        run["notes"] = witness.notes.iter().map(|n| json!([n.first, n.last, n.text, n.sentence(view)])).collect();
        run
    }

    /// Adds the variables a run is about (`about`), the shown variables in groups (`columns`), and the folded
    /// stretches: first scan, last scan, length in words, changes.
    fn shorten(&self, run: &mut Value, focus: &Focus, trace: &Trace) {
        let system = self.checked.system;
        let columns = focus.columns(system);
        let folds = focus.pieces(system, trace, &columns).into_iter().filter_map(|piece| match piece {
            Piece::Fold(fold) => {
                let movements = fold.movements(&system.program, "→");
                Some(json!([fold.first, fold.last, fold.title(), movements]))
            }
            Piece::Scan(_) => None,
        });
        run["folds"] = folds.collect();
        let positions = |ids: &[VarId]| ids.iter().filter_map(|id| self.shown.get(id)).copied().collect::<Vec<_>>();
        run["columns"] = columns.groups.iter().map(|group| positions(group)).collect();
        run["about"] = positions(&focus.variables.iter().copied().collect::<Vec<_>>()).into();
    }

    fn scans(&mut self, trace: &ScanTrace) -> Value {
        let system = self.checked.system;
        let limit = MAX_INSTRUCTIONS.min(self.room.instructions);
        // A trace that does not replay has no verdict, and does not get here.
        let tell = |from| match limit {
            0 => None,
            _ => story(system, trace, from, limit).unwrap_or_default(),
        };
        let last = trace.scans.len().saturating_sub(1);
        let (from, told) = match tell(0) {
            Some(told) => (0, told),
            None => tell(last).map_or((last + 1, Vec::new()), |told| (last, told)),
        };
        self.room.instructions -= told.iter().map(|scan| scan.instructions.len()).sum::<usize>();
        let firings: usize = told.iter().map(firings).sum();
        let with_tokens = from == 0 && firings <= self.room.firings;
        self.room.firings -= if with_tokens { firings } else { 0 };

        let mut memory: Vec<u64> = system.program.variables.iter().map(|variable| variable.initial).collect();
        let mut scans = Vec::new();
        for (position, scan) in trace.scans.iter().enumerate() {
            let names = scan.moves.iter().map(|m| {
                let component = &system.plant.components[m.component];
                component.transitions[m.transition].name.as_str()
            });
            let mut one = json!({});
            let (moves, read) = (names.collect::<Vec<_>>(), self.changes(&mut memory, &scan.inputs));
            // Empty members are left out, since runs may have many scans.
            if !moves.is_empty() {
                one["moves"] = moves.into();
            }
            if read.as_array().is_some_and(|read| !read.is_empty()) {
                one["in"] = read;
            }
            if let Some(end) = &scan.end {
                let values: Vec<(VarId, u64)> = self.shown.keys().map(|&id| (id, end.memory[id.0])).collect();
                one["end"] = self.changes(&mut memory, &values);
            }
            if let Some((line, hazard)) = scan.hazard {
                one["hazard"] = json!([line, hazard.to_string()]);
            }
            if let Some(told) = position.checked_sub(from).and_then(|position| told.get(position)) {
                one["lines"] = self.lines(&told.instructions, with_tokens);
                if with_tokens {
                    one["before"] = self.fired(&told.opening);
                    one["after"] = self.fired(&told.closing);
                }
            }
            scans.push(one);
        }
        json!({ "kind": "scans", "loop": trace.loop_start, "tokens": with_tokens, "scans": scans })
    }

    /// Variables whose values differ from `memory`, each with its new value; updates `memory`.
    fn changes(&self, memory: &mut [u64], values: &[(VarId, u64)]) -> Value {
        let mut changes = Vec::new();
        for &(id, value) in values {
            if let (true, Some(&position)) = (memory[id.0] != value, self.shown.get(&id)) {
                memory[id.0] = value;
                changes.extend([position.into(), self.value(id, value)]);
            }
        }
        changes.into()
    }

    fn value(&self, id: VarId, value: u64) -> Value {
        let program = &self.checked.system.program;
        if program.variable(id).ty.is_bool() { value.into() } else { program.value_text(id, value).into() }
    }

    /// Instructions in compact form: lines as straight stretches with their lengths, results, and by position the
    /// writes, hazards and firings.
    fn lines(&mut self, instructions: &[Executed], with_tokens: bool) -> Value {
        let mut pieces: Vec<usize> = Vec::new();
        let mut next = None;
        for executed in instructions {
            match pieces.last_mut() {
                Some(length) if next == Some(executed.line) => *length += 1,
                _ => pieces.extend([executed.line, 1]),
            }
            next = Some(executed.line + 1);
            self.nets.draw(executed.line, with_tokens);
        }
        let result = |e: &Executed| match e.ty.is_bool() {
            true => Value::from(e.result),
            false => value_text(e.ty, e.result).into(),
        };
        let mut writes = Map::new();
        let mut hazards = Map::new();
        for (i, executed) in instructions.iter().enumerate() {
            if let Some((id, value)) = executed.writes
                && let Some(&position) = self.shown.get(&id)
            {
                writes.insert(i.to_string(), json!([position, self.value(id, value), u8::from(executed.changes)]));
            }
            if let Some(hazard) = executed.hazard {
                hazards.insert(i.to_string(), hazard.to_string().into());
            }
        }
        let mut lines = json!({
            "at": pieces,
            "cr": instructions.iter().map(result).collect::<Vec<_>>(),
            "writes": writes,
            "hazards": hazards,
        });
        if with_tokens {
            lines["fired"] = instructions.iter().map(|executed| self.fired(&executed.firings)).collect();
        }
        lines
    }

    fn fired(&mut self, firings: &[TransitionId]) -> Value {
        firings.iter().map(|&transition| self.nets.transition(transition)).collect()
    }

    fn firings(&mut self, trace: &FiringTrace) -> Value {
        let system = self.checked.system;
        let told = firing_story(system, trace).unwrap_or_default();
        let with_tokens = told.len() <= self.room.firings;
        self.room.firings -= if with_tokens { told.len() } else { 0 };
        let mut scan = 0;
        let firings = told.iter().map(|firing| {
            let role = system.transitions[firing.transition.index()];
            scan += usize::from(role == TransitionRole::Block);
            let mut one = json!({ "name": system.net.transition(firing.transition).name, "scan": scan });
            if with_tokens {
                one["fired"] = self.nets.transition(firing.transition).into();
            }
            if let TransitionRole::Line(line) = role {
                one["line"] = line.into();
                self.nets.draw(line, with_tokens);
            }
            let mut written = firing.copied;
            if let Some(executed) = &firing.executed {
                one["cr"] = match executed.ty.is_bool() {
                    true => executed.result.into(),
                    false => value_text(executed.ty, executed.result).into(),
                };
                written = executed.writes.or(written);
            }
            if let Some((id, value)) = written
                && let Some(&position) = self.shown.get(&id)
            {
                one["set"] = json!([position, self.value(id, value)]);
            }
            one
        });
        let firings: Vec<Value> = firings.collect();
        json!({ "kind": "firings", "loop": trace.loop_start, "tokens": with_tokens, "firings": firings })
    }
}

/// Variables shown: inputs, memory, outputs.
pub fn shown(system: &System) -> impl Iterator<Item = VarId> {
    [Role::Input, Role::Memory, Role::Output].into_iter().flat_map(|role| system.program.with_role(role))
}

fn firings(scan: &ToldScan) -> usize {
    let within: usize = scan.instructions.iter().map(|executed| executed.firings.len()).sum();
    scan.opening.len() + within + scan.closing.len()
}

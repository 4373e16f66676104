//! A scan under way: the token game and the interpreter side by side.

use super::plan::{self, Impossible, Plan};
use crate::scans::ScanState;
use crate::translate::{PlaceRole, System, TransitionRole};
use crate::witness::{Disagreement, PlantMove, Replay, Scan};
use petril_lang::flat::{Hazard, Tolerated};
use petril_lang::semantics::VarId;
use petril_net::net::TransitionId;

/// Scan that has begun with a firing of the plant or the PLC's cycle.
#[derive(Clone, Debug)]
pub struct Within<'s> {
    pub replay: Replay<'s>,
    /// Number of transitions fired, the plant's included.
    pub fired: usize,
    /// Transitions that fire before the first line.
    prelude: Vec<TransitionRole>,
    /// Line after the last one.
    end: usize,
    plant: Vec<usize>,
    inputs: Vec<(VarId, u64)>,
}

impl<'s> Within<'s> {
    /// Prepares the scan from a state. Nothing has fired yet.
    pub fn new(system: &'s System, from: &ScanState, plan: &Plan) -> Result<Self, Impossible> {
        let plant = plan::moved(system, from, &plan.moves)?;
        let inputs = plan::inputs(system, from, &plant, plan);
        let moves = plan.moves.iter();
        let mut prelude: Vec<TransitionRole> =
            moves.map(|&PlantMove { component, transition }| TransitionRole::Plant { component, transition }).collect();
        prelude.push(TransitionRole::Block);
        for &(variable, pattern) in &inputs {
            let bits = (0..system.program.variable(variable).bits).rev();
            prelude.extend(bits.map(|bit| TransitionRole::Copy { variable, bit, value: pattern >> bit & 1 == 1 }));
        }
        let (replay, end) = (Replay::after(system, from), system.program.end());
        Ok(Self { replay, fired: 0, prelude, end, plant, inputs })
    }

    /// Fires the next transition; returns whether it has ended the scan.
    pub fn fire(&mut self) -> Result<bool, Disagreement> {
        self.fire_next().map(|(_, ends)| ends)
    }

    /// Transition that fires next.
    pub fn next(&self) -> Result<TransitionId, Disagreement> {
        self.clone().fire_next().map(|(transition, _)| transition)
    }

    fn fire_next(&mut self) -> Result<(TransitionId, bool), Disagreement> {
        let ends = self.replay.control() == PlaceRole::Line(self.end);
        let fired = match self.prelude.get(self.fired) {
            Some(&next) => self.replay.fire_only(|role| role == next)?,
            None if ends => self.replay.fire_only(|role| role == TransitionRole::Unblock)?,
            None => self.replay.fire_only(|role| matches!(role, TransitionRole::Line(_)))?,
        };
        self.fired += 1;
        Ok((fired, ends))
    }

    /// Whether control is at a line, the end included.
    pub fn is_at_line(&self) -> bool {
        matches!(self.replay.control(), PlaceRole::Line(_))
    }

    /// The scan, which has ended, and the error it met.
    pub fn end(self, tolerated: Tolerated, moves: Vec<PlantMove>) -> (Scan, Option<(usize, Hazard)>) {
        let hazard = tolerated.first_error(self.replay.hazards());
        let end = Some(ScanState { plant: self.plant, memory: self.replay.memory() });
        (Scan { moves, inputs: self.inputs, end, hazard }, hazard)
    }
}

//! Random walk of a plant device towards random goals.
//!
//! Undirected random moves seldom lead far: a tank that may be drained at any time stays almost empty. So a walk picks
//! a random marking of the device as its goal and moves towards it for a while, as far as the program's outputs allow.

use super::lots::Lots;
use crate::scans::ScanState;
use crate::translate::System;
use crate::witness::PlantMove;
use petril_lang::semantics::VarId;

/// Upper bound on the number of scans for which a goal is pursued.
const LASTS: u32 = 32;

/// Random walk of one device.
#[derive(Clone, Debug, Default)]
pub struct Walk {
    /// Distance of each marking from the goal in moves, ignoring outputs; `None` if it cannot reach the goal.
    distances: Vec<Option<u32>>,
    /// Number of scans left for the goal.
    left: u32,
}

impl Walk {
    /// Moves of a component before the scan from a state: none with probability 1/4, one random enabled move with 1/4,
    /// else as many as lead it nearest to its goal.
    pub fn go(&mut self, system: &System, component: usize, from: &ScanState, lots: &mut Lots) -> Vec<PlantMove> {
        let own = &system.plant.components[component];
        let at = from.plant[component];
        let output = |id: VarId| from.memory[id.0];
        if self.left == 0 || self.distances.get(at) == Some(&Some(0)) {
            let goal = lots.below(own.markings.len() as u128) as usize;
            self.distances = distances(system, component, goal);
            self.left = 1 + lots.below(u128::from(LASTS)) as u32;
        }
        self.left -= 1;
        let reached = own.closure(at, output);
        let target = match lots.below(4) {
            0 => return Vec::new(),
            1 => {
                let near: Vec<usize> = reached
                    .iter()
                    .filter(|(_, step)| step.is_some_and(|(before, _)| before == at))
                    .map(|&(to, _)| to)
                    .collect();
                lots.one_of(&near).copied()
            }
            _ => {
                let known = reached.iter().filter_map(|&(marking, _)| Some((self.distances[marking]?, marking)));
                known.min_by_key(|&(distance, _)| distance).map(|(_, marking)| marking)
            }
        };
        let path = target.and_then(|target| own.path(at, target, output)).unwrap_or_default();
        path.into_iter().map(|transition| PlantMove { component, transition }).collect()
    }
}

/// Distance of each marking of a component from a goal, by its moves.
fn distances(system: &System, component: usize, goal: usize) -> Vec<Option<u32>> {
    let markings = &system.plant.components[component].markings;
    let mut before = vec![Vec::new(); markings.len()];
    for (from, marking) in markings.iter().enumerate() {
        marking.moves.iter().for_each(|step| before[step.target].push(from));
    }
    let mut distances = vec![None; markings.len()];
    distances[goal] = Some(0);
    let mut queue = vec![(goal, 0)];
    let mut next = 0;
    while let Some(&(marking, distance)) = queue.get(next) {
        next += 1;
        for &earlier in &before[marking] {
            if distances[earlier].is_none() {
                distances[earlier] = Some(distance + 1);
                queue.push((earlier, distance + 1));
            }
        }
    }
    distances
}

//! Reconstruction of firing sequences along parent edges: undoing the transition by which a state was first reached
//! gives its predecessor.

use super::exploration::Exploration;

impl Exploration {
    /// Finds a shortest firing sequence from the initial marking to a marking. `None` if the marking was not reached,
    /// or states were not kept.
    #[must_use]
    pub fn firings(&self, marking: &[u64]) -> Option<Vec<usize>> {
        let mut words = self.machine.packing.pack(marking)?;
        let levels = self.shards.first()?.levels.len();
        let via = |words: &[u64], distance| self.shards.iter().find_map(|shard| shard.via(words, distance));
        // States may have been found of a level that was not begun.
        let mut distance = (0..=levels).find(|&distance| via(&words, distance).is_some())?;
        let mut firings = Vec::with_capacity(distance);
        while distance > 0 {
            let transition = via(&words, distance)? as usize;
            firings.push(transition);
            self.machine.unfire(transition, &mut words);
            distance -= 1;
        }
        firings.reverse();
        (words == self.machine.initial).then_some(firings)
    }
}

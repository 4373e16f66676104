//! Reading of the tokens of some places, state after state.

use std::collections::BTreeMap;

use super::exploration::Exploration;
use super::view::View;

/// Reads the tokens of some places. Consecutive states agree on most of them, so chunks with the value of the previous
/// state are skipped.
pub struct Reader {
    /// Chunks with the places to read there, and the last value read.
    chunks: Vec<(usize, Vec<usize>, Option<u64>)>,
    /// Places whose tokens depend on other chunks too.
    others: Vec<usize>,
}

impl Exploration {
    /// Returns a reader of some places.
    #[must_use]
    pub fn reader(&self, places: impl Iterator<Item = usize>) -> Reader {
        let packing = &self.machine.packing;
        let mut reader = Reader { chunks: Vec::new(), others: Vec::new() };
        let mut known = BTreeMap::new();
        for place in places {
            let chunk = packing.chunk_of(place);
            if !packing.elsewhere(place).is_empty() {
                reader.others.push(place);
            } else {
                let at = *known.entry(chunk).or_insert(reader.chunks.len());
                if at == reader.chunks.len() {
                    reader.chunks.push((chunk, Vec::new(), None));
                }
                reader.chunks[at].1.push(place);
            }
        }
        reader
    }
}

impl Reader {
    /// Writes the tokens of the places into `tokens`, which must be the same list each time.
    pub fn read(&mut self, view: &View<'_>, tokens: &mut [u64]) {
        for (chunk, places, last) in &mut self.chunks {
            let value = Some(view.packing.chunks[*chunk].get(view.words));
            if *last != value {
                places.iter().for_each(|&place| tokens[place] = view.tokens(place));
                *last = value;
            }
        }
        self.others.iter().for_each(|&place| tokens[place] = view.tokens(place));
    }
}

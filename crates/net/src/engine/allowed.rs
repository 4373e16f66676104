//! The transitions that a marking allows, by rows of bits or, if these would take too much memory, by lists of
//! candidates.

use super::candidates::Candidates;
use super::conditions::Conditions;
use super::packing::Packing;
use super::rows::Rows;

/// The transitions allowed by a marking, in one of two representations.
pub(super) enum Allowed {
    Rows(Rows),
    Candidates(Candidates),
}

/// Total size of all rows, in words, above which candidates are listed: 2 MiB, about a processor's cache.
const ROWS: u64 = 1 << 18;

impl Allowed {
    /// Builds the tables; sets of transitions have `width` words. If not `listed`, [`Self::put`] must not be called.
    pub(super) fn of(packing: &Packing, conditions: &Conditions, width: usize, listed: bool) -> Self {
        let asked = packing.chunks.iter().filter(|chunk| !conditions.touching(chunk).is_empty());
        let rows: u64 = asked.map(|chunk| conditions.values(chunk).len() as u64).sum();
        if rows * width as u64 <= ROWS {
            Self::Rows(Rows::of(packing, conditions, width))
        } else {
            Self::Candidates(Candidates::of(packing, conditions, listed))
        }
    }

    /// Writes the transitions that the marking allows into `set`.
    #[inline(always)]
    pub(super) fn put(&self, words: &[u64], set: &mut [u64]) {
        match self {
            Self::Rows(rows) => rows.put(words, set),
            Self::Candidates(candidates) => candidates.put(words, set),
        }
    }

    /// Whether the marking allows all transitions of a set.
    #[inline(always)]
    pub(super) fn allows(&self, words: &[u64], set: &[u64]) -> bool {
        match self {
            Self::Rows(rows) => rows.is_empty() || rows.allows(words, set),
            Self::Candidates(candidates) => candidates.allows(words, set),
        }
    }

    /// Memory in use, in bytes.
    pub(super) fn bytes(&self) -> u64 {
        match self {
            Self::Rows(rows) => rows.bytes(),
            Self::Candidates(candidates) => candidates.bytes(),
        }
    }
}

//! The names of nodes, stored in one string, since a net may have millions.

use petril_base::printable::{is_printable, line};

/// Names of nodes, by position.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Names {
    text: String,
    /// End offset of each name. A name begins where the one before it ends.
    ends: Vec<usize>,
}

impl Names {
    pub fn push(&mut self, name: &str) {
        self.text.push_str(name);
        self.ends.push(self.text.len());
    }

    /// Returns the names made printable.
    pub fn into_printable(self) -> Self {
        if self.text.chars().all(is_printable) {
            return self;
        }
        let mut names = Self::default();
        (0..self.ends.len()).for_each(|position| names.push(&line(self.get(position))));
        names
    }

    pub fn get(&self, position: usize) -> &str {
        let start = position.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.text[start..self.ends[position]]
    }
}

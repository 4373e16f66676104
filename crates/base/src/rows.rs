//! Compressed rows: many lists in one allocation.

use std::ops::Index;

/// Lists, numbered from 0. Invariant: `items[starts[i]..starts[i + 1]]` is list i.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rows<T> {
    starts: Vec<usize>,
    items: Vec<T>,
}

impl<T: Copy> Rows<T> {
    /// Groups pairs by key: list `k`, for each key below `keys`, holds the items paired with it, in the order of the
    /// pairs.
    pub fn group(keys: usize, pairs: impl Iterator<Item = (usize, T)> + Clone) -> Self {
        let mut starts = vec![0; keys + 1];
        pairs.clone().for_each(|(key, _)| starts[key + 1] += 1);
        for key in 0..keys {
            starts[key + 1] += starts[key];
        }
        let Some((_, any)) = pairs.clone().next() else { return Self { starts, items: Vec::new() } };
        let mut next = starts.clone();
        let mut items = vec![any; starts[keys]];
        for (key, item) in pairs {
            items[next[key]] = item;
            next[key] += 1;
        }
        Self { starts, items }
    }
}

impl<T> Index<usize> for Rows<T> {
    type Output = [T];

    fn index(&self, list: usize) -> &[T] {
        &self.items[self.starts[list]..self.starts[list + 1]]
    }
}

#[cfg(test)]
mod tests {
    use super::Rows;

    #[test]
    fn pairs_are_grouped_by_key_in_their_order() {
        let grouped = Rows::group(4, [(2, 'a'), (0, 'b'), (2, 'c')].into_iter());
        assert_eq!([0, 1, 2, 3].map(|key| grouped[key].to_vec()), [vec!['b'], vec![], vec!['a', 'c'], vec![]]);
        assert!(Rows::<u8>::group(1, std::iter::empty())[0].is_empty());
    }
}

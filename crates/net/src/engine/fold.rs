//! Tree compression: markings of several words as keys of one word.
//!
//! The words are the leaves of a binary tree. Each leaf, and each inner node except the root, has a table that numbers
//! its words, where the word of an inner node is the pair of its children's numbers; the key is the pair at the root.
//! Parts of a marking have few values compared with the whole, so the tables stay small, and a marking takes little
//! more memory than its key. The method is recursive indexing (Holzmann 1997), as a tree database (Blom, Lisser, van de
//! Pol and Weber 2011). A firing that changes one word looks up only the nodes above it.

use super::intern::Interner;
use super::machine::Changes;

/// Tree compression: the tables of all nodes but the root.
pub(super) struct Fold {
    /// Tables of the leaves, then of the inner nodes, children before parents.
    tables: Vec<Interner>,
    leaves: usize,
    /// Left and right child of each inner node; the root is last.
    children: Vec<(usize, usize)>,
    /// Parent of each node but the root.
    parents: Vec<usize>,
}

/// Inner nodes above some words, children before parents, without the root.
pub(super) type Above = Vec<usize>;

impl Fold {
    /// Makes an empty tree for markings of `words` words, at least two.
    pub(super) fn new(words: usize) -> Self {
        let mut level: Vec<usize> = (0..words).collect();
        let mut children = Vec::new();
        while level.len() > 1 {
            let pairs = level.chunks(2).map(|pair| match *pair {
                [left, right] => {
                    children.push((left, right));
                    words + children.len() - 1
                }
                _ => pair[0],
            });
            level = pairs.collect();
        }
        let tables = (0..words + children.len() - 1).map(|_| Interner::default()).collect();
        let mut parents = vec![0; words + children.len() - 1];
        for (parent, &(left, right)) in (words..).zip(&children) {
            (parents[left], parents[right]) = (parent, parent);
        }
        Self { tables, leaves: words, children, parents }
    }

    /// Number of nodes with tables.
    pub(super) fn nodes(&self) -> usize {
        self.tables.len()
    }

    /// Inner nodes whose numbers can change when these words do.
    pub(super) fn above(&self, words: impl Iterator<Item = usize>) -> Above {
        let up = |word| std::iter::successors(self.parents.get(word), |&&node| self.parents.get(node));
        let mut above: Above = words.flat_map(up).copied().filter(|&node| node < self.nodes()).collect();
        above.sort_unstable();
        above.dedup();
        above
    }

    /// Numbers a leaf.
    #[inline(always)]
    pub(super) fn leaf(&mut self, leaf: usize, word: u64, numbers: &mut [u32]) {
        numbers[leaf] = self.tables[leaf].number(word);
    }

    /// Numbers an inner node whose children are numbered.
    #[inline(always)]
    pub(super) fn inner(&mut self, node: usize, numbers: &mut [u32]) {
        let (left, right) = self.children[node - self.leaves];
        numbers[node] = self.tables[node].number(pair(numbers[left], numbers[right]));
    }

    /// Key of a marking whose nodes are numbered.
    #[inline(always)]
    pub(super) fn root(&self, numbers: &[u32]) -> u64 {
        let (left, right) = self.children[self.children.len() - 1];
        pair(numbers[left], numbers[right])
    }

    /// Computes the key of a marking, and numbers its new parts.
    pub(super) fn key(&mut self, words: &[u64], numbers: &mut [u32]) -> u64 {
        words.iter().enumerate().for_each(|(leaf, &word)| self.leaf(leaf, word, numbers));
        (self.leaves..self.nodes()).for_each(|node| self.inner(node, numbers));
        self.root(numbers)
    }

    /// Finds the key of a marking, if all its parts have numbers.
    pub(super) fn find(&self, words: &[u64]) -> Option<u64> {
        let mut numbers = Vec::with_capacity(self.nodes());
        for (table, &word) in self.tables.iter().zip(words) {
            numbers.push(table.find(word)?);
        }
        for node in self.leaves..self.nodes() {
            let (left, right) = self.children[node - self.leaves];
            numbers.push(self.tables[node].find(pair(numbers[left], numbers[right]))?);
        }
        Some(self.root(&numbers))
    }

    /// Finds the key of a marking, if all its parts have numbers; `numbers` are those of a marking that differs by
    /// `changes`.
    pub(super) fn find_after(&self, words: &[u64], changes: &Changes, numbers: &mut [u32]) -> Option<u64> {
        for &(leaf, _) in &changes.words {
            numbers[leaf] = self.tables[leaf].find(words[leaf])?;
        }
        for &node in &changes.above {
            let (left, right) = self.children[node - self.leaves];
            numbers[node] = self.tables[node].find(pair(numbers[left], numbers[right]))?;
        }
        Some(self.root(numbers))
    }

    /// Decodes a key to the words and the numbers of the nodes.
    #[inline]
    pub(super) fn unfold(&self, key: u64, words: &mut [u64], numbers: &mut [u32]) {
        let (left, right) = self.children[self.children.len() - 1];
        (numbers[left], numbers[right]) = (key as u32, (key >> 32) as u32);
        for node in (self.leaves..self.nodes()).rev() {
            let (left, right) = self.children[node - self.leaves];
            let pair = self.tables[node].word(numbers[node]);
            (numbers[left], numbers[right]) = (pair as u32, (pair >> 32) as u32);
        }
        for ((word, table), &number) in words.iter_mut().zip(&self.tables).zip(&*numbers) {
            *word = table.word(number);
        }
    }

    /// Numbers of values of the left and of the right half of a key.
    pub(super) fn numbers(&self) -> (usize, usize) {
        let (left, right) = self.children[self.children.len() - 1];
        (self.tables[left].len(), self.tables[right].len())
    }

    /// Memory in use, in bytes.
    pub(super) fn bytes(&self) -> u64 {
        self.tables.iter().map(Interner::bytes).sum()
    }
}

fn pair(left: u32, right: u32) -> u64 {
    u64::from(left) | u64::from(right) << 32
}

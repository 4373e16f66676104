//! Ordering of two columns of nodes so that few arcs cross.

/// Length up to which columns are ordered by trying every permutation; instructions on single bits are within it.
const SMALL: usize = 4;
/// Maximum number of passes over longer columns.
const PASSES: usize = 8;

/// Three columns of nodes with arcs between neighbouring columns. The first column keeps its order.
pub struct Columns {
    /// For each node in the middle, its neighbours on the left, as positions there.
    pub left: Vec<Vec<usize>>,
    /// For each node in the middle, its neighbours on the right.
    pub right: Vec<Vec<usize>>,
    /// Number of nodes on the right.
    pub right_count: usize,
}

/// Returns the order of the middle and of the right column, each as nodes from top to bottom. Ties keep the given
/// order.
pub fn order(columns: &Columns) -> (Vec<usize>, Vec<usize>) {
    if columns.left.len() <= SMALL && columns.right_count <= SMALL { best(columns) } else { good(columns) }
}

/// An order with the minimum number of crossings, by exhaustive search.
fn best(columns: &Columns) -> (Vec<usize>, Vec<usize>) {
    let rights = permutations(columns.right_count);
    let of_right = columns.seen_from_right();
    let mut least = usize::MAX;
    let mut result = Default::default();
    for middle in permutations(columns.left.len()) {
        let at_middle = heights(&middle);
        let left = total(&middle, |a, b| crossings(&columns.left[a], &columns.left[b], None));
        for right in &rights {
            let crossings = left + total(right, |a, b| crossings(&of_right[a], &of_right[b], Some(&at_middle)));
            if crossings < least {
                least = crossings;
                result = (middle.clone(), right.clone());
            }
        }
    }
    result
}

/// An order with few crossings: nodes on the right are sorted by the mean height of their neighbours (barycentre), then
/// adjacent nodes are swapped as long as that saves a crossing.
fn good(columns: &Columns) -> (Vec<usize>, Vec<usize>) {
    let mut middle: Vec<usize> = (0..columns.left.len()).collect();
    let mut right: Vec<usize> = (0..columns.right_count).collect();
    let of_right = columns.seen_from_right();
    // Means are scaled by the number of nodes in the middle, then rounded down.
    right.sort_by_key(|&node| {
        let neighbours = &of_right[node];
        neighbours.iter().sum::<usize>() * columns.left.len() / neighbours.len().max(1)
    });
    for _ in 0..PASSES {
        let at_right = heights(&right);
        let mut changed = improve(&mut middle, |a, b| {
            crossings(&columns.left[a], &columns.left[b], None)
                + crossings(&columns.right[a], &columns.right[b], Some(&at_right))
        });
        let at_middle = heights(&middle);
        changed |= improve(&mut right, |a, b| crossings(&of_right[a], &of_right[b], Some(&at_middle)));
        if !changed {
            break;
        }
    }
    (middle, right)
}

impl Columns {
    /// For each node on the right, its neighbours in the middle.
    fn seen_from_right(&self) -> Vec<Vec<usize>> {
        let mut neighbours = vec![Vec::new(); self.right_count];
        for (node, places) in self.right.iter().enumerate() {
            places.iter().for_each(|&place| neighbours[place].push(node));
        }
        neighbours
    }
}

/// The height of each node in an order.
fn heights(order: &[usize]) -> Vec<usize> {
    let mut heights = vec![0; order.len()];
    for (height, &node) in order.iter().enumerate() {
        heights[node] = height;
    }
    heights
}

/// The sum over all pairs, the first above the second.
fn total(order: &[usize], cost: impl Fn(usize, usize) -> usize) -> usize {
    let pairs = order.iter().enumerate().flat_map(|(i, &a)| order[i + 1..].iter().map(move |&b| (a, b)));
    pairs.map(|(a, b)| cost(a, b)).sum()
}

/// Swaps adjacent nodes where that saves crossings; `cost` counts the crossings of two nodes, the first above the
/// second.
fn improve(order: &mut [usize], cost: impl Fn(usize, usize) -> usize) -> bool {
    let mut changed = false;
    for i in 1..order.len() {
        if cost(order[i], order[i - 1]) < cost(order[i - 1], order[i]) {
            order.swap(i - 1, i);
            changed = true;
        }
    }
    changed
}

/// Number of crossings between the arcs of two nodes, the first above the second.
fn crossings(above: &[usize], below: &[usize], heights: Option<&[usize]>) -> usize {
    let height = |node: usize| heights.map_or(node, |heights| heights[node]);
    let lower_ends = |a: usize| below.iter().filter(|&&b| height(b) < height(a)).count();
    above.iter().map(|&a| lower_ends(a)).sum()
}

/// All permutations of `0..n`, the identity first.
fn permutations(n: usize) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new()];
    for _ in 0..n {
        let longer = |start: Vec<usize>| {
            let rest: Vec<usize> = (0..n).filter(|node| !start.contains(node)).collect();
            rest.into_iter().map(move |node| start.iter().copied().chain([node]).collect())
        };
        all = all.into_iter().flat_map(longer).collect();
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Number of crossings on the right side.
    fn count(columns: &Columns, (middle, right): &(Vec<usize>, Vec<usize>)) -> usize {
        let heights = heights(right);
        total(middle, |a, b| crossings(&columns.right[a], &columns.right[b], Some(&heights)))
    }

    #[test]
    fn an_instruction_on_two_bits_has_three_crossings() {
        // LD: the rows are the old values (CR, x) = 00, 10, 01, 11; the places CR=0, CR=1, x=0, x=1. The four transitions
        // and places are a cycle of eight arcs, which cannot be drawn between two columns with fewer than three crossings.
        let right = vec![vec![0, 2], vec![1, 2, 0], vec![0, 3, 1], vec![1, 3]];
        let columns = Columns { left: vec![vec![]; 4], right, right_count: 4 };
        let orders = order(&columns);
        assert_eq!(orders, (vec![0, 1, 2, 3], vec![2, 0, 1, 3]));
        assert_eq!(count(&columns, &orders), 3);
    }

    #[test]
    fn long_columns_are_untangled() {
        // Node i is joined to node 9 - i and to 9 - i - 1: a path, which needs no crossing.
        let right = (0..10).map(|i| if i == 9 { vec![0] } else { vec![9 - i, 8 - i] }).collect();
        let columns = Columns { left: vec![vec![]; 10], right, right_count: 10 };
        assert_eq!(count(&columns, &order(&columns)), 0);
    }
}

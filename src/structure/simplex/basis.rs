//! The inverse of a basis as a product of elementary matrices, each the identity but for one column.

/// A column that takes the place of a unit vector: its entries, that of the place itself apart.
struct Eta {
    row: usize,
    pivot: f64,
    others: Vec<(u32, f64)>,
}

/// What of a number is lost in computation.
const DUST: f64 = 1e-11;

/// The inverse of a matrix that began as the identity and had columns replaced.
#[derive(Default)]
pub struct Inverse {
    etas: Vec<Eta>,
    /// Numbers kept.
    size: usize,
}

impl Inverse {
    /// Replaces the unit vector in `row` by a column, which has gone through [`Self::times_column`] already.
    pub fn replace(&mut self, row: usize, column: &[f64]) {
        let others: Vec<(u32, f64)> = column
            .iter()
            .enumerate()
            .filter(|&(i, value)| i != row && value.abs() > DUST)
            .map(|(i, &value)| (i as u32, value))
            .collect();
        self.size += others.len() + 1;
        self.etas.push(Eta { row, pivot: column[row], others });
    }

    /// The inverse times a column, in place.
    pub fn times_column(&self, column: &mut [f64]) {
        for eta in &self.etas {
            let value = column[eta.row];
            if value != 0.0 {
                let scaled = value / eta.pivot;
                column[eta.row] = scaled;
                eta.others.iter().for_each(|&(i, entry)| column[i as usize] -= entry * scaled);
            }
        }
    }

    /// A row times the inverse, in place.
    pub fn times_row(&self, row: &mut [f64]) {
        for eta in self.etas.iter().rev() {
            let sum: f64 = eta.others.iter().map(|&(i, entry)| entry * row[i as usize]).sum();
            let value = (row[eta.row] - sum) / eta.pivot;
            row[eta.row] = if value.abs() > DUST { value } else { 0.0 };
        }
    }

    /// How many columns were replaced.
    pub fn len(&self) -> usize {
        self.etas.len()
    }

    /// Numbers kept: what a product takes.
    pub fn size(&self) -> usize {
        self.size
    }
}

/// An order in which columns are best entered: those that a row has alone first, since they change no other; those with one
/// row left to them last, since then nothing is changed by them. `rows` are those that are free.
pub fn triangular(columns: &[&[(u32, f64)]], is_free: &[bool]) -> Vec<usize> {
    let mut rows: Vec<Vec<usize>> = vec![Vec::new(); is_free.len()];
    let free = |column: usize| columns[column].iter().map(|&(row, _)| row as usize).filter(|&row| is_free[row]);
    (0..columns.len()).for_each(|column| free(column).for_each(|row| rows[row].push(column)));
    let mut row_counts: Vec<usize> = rows.iter().map(Vec::len).collect();
    let mut column_counts: Vec<usize> = (0..columns.len()).map(|column| free(column).count()).collect();
    let mut row_done: Vec<bool> = is_free.iter().map(|free| !free).collect();
    let mut column_done = vec![false; columns.len()];
    let (mut first, mut last) = (Vec::new(), Vec::new());
    let mut single_rows: Vec<usize> = (0..rows.len()).filter(|&row| row_counts[row] == 1).collect();
    let mut single_columns: Vec<usize> = (0..columns.len()).filter(|&column| column_counts[column] == 1).collect();
    loop {
        let (row, column) = if let Some(row) = single_rows.pop() {
            if row_done[row] {
                continue;
            }
            let Some(&column) = rows[row].iter().find(|&&column| !column_done[column]) else { continue };
            first.push(column);
            (row, column)
        } else if let Some(column) = single_columns.pop() {
            if column_done[column] {
                continue;
            }
            let Some(row) = free(column).find(|&row| !row_done[row]) else { continue };
            last.push(column);
            (row, column)
        } else {
            break;
        };
        row_done[row] = true;
        column_done[column] = true;
        for row in free(column).filter(|&row| !row_done[row]) {
            row_counts[row] -= 1;
            if row_counts[row] == 1 {
                single_rows.push(row);
            }
        }
        for &column in rows[row].iter().filter(|&&column| !column_done[column]) {
            column_counts[column] -= 1;
            if column_counts[column] == 1 {
                single_columns.push(column);
            }
        }
    }
    let mut rest: Vec<usize> = (0..columns.len()).filter(|&column| !column_done[column]).collect();
    rest.sort_by_key(|&column| column_counts[column]);
    first.into_iter().chain(rest).chain(last.into_iter().rev()).collect()
}

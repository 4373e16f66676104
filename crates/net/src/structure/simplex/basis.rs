//! The inverse of a basis: LU factors, and a product of elementary (eta) matrices for the columns replaced since.
//!
//! Each column belongs to the row in which it was pivoted. Rows without a column have a unit vector.

/// A column of a factor, or an eta column: its entry in its own row, and those in other rows.
struct Column {
    row: usize,
    pivot: f64,
    others: Vec<(u32, f64)>,
}

/// Magnitude below which a computed number counts as 0.
const DUST: f64 = 1e-11;

/// Inverse of a matrix that began as the identity and had columns entered, then replaced.
#[derive(Default)]
pub struct Inverse {
    /// Columns of L in order of entering: multiples that each pivot subtracts from rows without a pivot.
    lower: Vec<Column>,
    /// Columns of U in the same order: entries in rows that had a pivot before.
    upper: Vec<Column>,
    replaced: Vec<Column>,
    /// Number of entries stored.
    size: usize,
}

impl Inverse {
    /// Reduces a column by L in place, before it is entered. `touched` are the rows with entries that may not be 0.
    pub fn reduce(&self, column: &mut [f64], touched: &mut Vec<u32>) {
        for factor in &self.lower {
            let value = column[factor.row];
            if value != 0.0 {
                for &(i, entry) in &factor.others {
                    column[i as usize] -= entry * value;
                    touched.push(i);
                }
            }
        }
        touched.sort_unstable();
        touched.dedup();
    }

    /// Enters a reduced column with its pivot in `row`; `is_free` marks the rows that have no pivot yet and are to have
    /// one.
    pub fn enter(&mut self, row: usize, column: &[f64], touched: &[u32], is_free: &[bool]) {
        let pivot = column[row];
        let (mut lower, mut upper) = (Vec::new(), Vec::new());
        for (i, value) in touched.iter().map(|&i| (i, column[i as usize])) {
            if i as usize != row && value.abs() > DUST {
                if is_free[i as usize] { lower.push((i, value / pivot)) } else { upper.push((i, value)) }
            }
        }
        self.size += lower.len() + upper.len() + 2;
        if !lower.is_empty() {
            self.lower.push(Column { row, pivot: 1.0, others: lower });
        }
        self.upper.push(Column { row, pivot, others: upper });
    }

    /// Replaces the column of a row by another one, to which [`Self::times_column`] has been applied.
    pub fn replace(&mut self, row: usize, column: &[f64]) {
        let others: Vec<(u32, f64)> = column
            .iter()
            .enumerate()
            .filter(|&(i, value)| i != row && value.abs() > DUST)
            .map(|(i, &value)| (i as u32, value))
            .collect();
        self.size += others.len() + 1;
        self.replaced.push(Column { row, pivot: column[row], others });
    }

    /// Multiplies the inverse by a column, in place.
    pub fn times_column(&self, column: &mut [f64]) {
        for factor in &self.lower {
            let value = column[factor.row];
            if value != 0.0 {
                factor.others.iter().for_each(|&(i, entry)| column[i as usize] -= entry * value);
            }
        }
        for factor in self.upper.iter().rev().chain(&self.replaced) {
            let value = column[factor.row];
            if value != 0.0 {
                let scaled = value / factor.pivot;
                column[factor.row] = scaled;
                factor.others.iter().for_each(|&(i, entry)| column[i as usize] -= entry * scaled);
            }
        }
    }

    /// Multiplies a row by the inverse, in place.
    pub fn times_row(&self, row: &mut [f64]) {
        for factor in self.replaced.iter().rev().chain(&self.upper).chain(self.lower.iter().rev()) {
            let sum: f64 = factor.others.iter().map(|&(i, entry)| entry * row[i as usize]).sum();
            let value = (row[factor.row] - sum) / factor.pivot;
            row[factor.row] = if value.abs() > DUST { value } else { 0.0 };
        }
    }

    /// Number of columns replaced since the matrix was factored.
    pub fn replaced(&self) -> usize {
        self.replaced.len()
    }

    /// Number of entries stored: the cost of a product.
    pub fn size(&self) -> usize {
        self.size
    }
}

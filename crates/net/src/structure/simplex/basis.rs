//! The inverse of a basis: triangular factors, and a product of elementary matrices for the columns replaced since.
//!
//! Each column stands for a row: the one it was pivoted in. Rows that have no column of their own have a unit vector.

/// A column of a factor, or one that replaced another: its entry in its own row, and those in other rows.
struct Column {
    row: usize,
    pivot: f64,
    others: Vec<(u32, f64)>,
}

/// What of a number is lost in computation.
const DUST: f64 = 1e-11;

/// The inverse of a matrix that began as the identity and had columns entered, then replaced.
#[derive(Default)]
pub struct Inverse {
    /// In the order of their entering: what each pivot subtracts from rows without one.
    lower: Vec<Column>,
    /// In the same order: columns with entries in rows that had a pivot before.
    upper: Vec<Column>,
    replaced: Vec<Column>,
    /// Numbers kept.
    size: usize,
}

impl Inverse {
    /// A column as it is when it is to be entered, in place. `touched` are the rows where it may not be 0.
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

    /// Enters a column that has been reduced, with its pivot in `row`; `is_free` are rows without a pivot that shall have one.
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

    /// Replaces what stands for a row by a column, which has gone through [`Self::times_column`] already.
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

    /// The inverse times a column, in place.
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

    /// A row times the inverse, in place.
    pub fn times_row(&self, row: &mut [f64]) {
        for factor in self.replaced.iter().rev().chain(&self.upper).chain(self.lower.iter().rev()) {
            let sum: f64 = factor.others.iter().map(|&(i, entry)| entry * row[i as usize]).sum();
            let value = (row[factor.row] - sum) / factor.pivot;
            row[factor.row] = if value.abs() > DUST { value } else { 0.0 };
        }
    }

    /// How many columns were replaced since the matrix was taken apart.
    pub fn replaced(&self) -> usize {
        self.replaced.len()
    }

    /// Numbers kept: what a product takes.
    pub fn size(&self) -> usize {
        self.size
    }
}

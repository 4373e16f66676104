//! The revised dual simplex algorithm: the inverse of the basis is kept as a product, rows are computed when needed.

use std::sync::atomic::{AtomicBool, Ordering};

use super::basis::Inverse;
use super::order::triangular;
use super::{Program, Solved, TOLERANCE, choice};

/// Number of columns replaced before the basis is factored anew.
const REPLACED: usize = 64;

/// Solves a program in at most `steps` elementary steps, unless `stopping` is set meanwhile.
pub fn minimise(program: &Program, steps: u64, stopping: &AtomicBool) -> Solved {
    let mut search = Search::new(program, steps, stopping);
    // An answer is given only with a fresh inverse, since errors add up.
    let mut fresh = true;
    loop {
        if search.inverse.replaced() >= REPLACED {
            search.refactor();
            fresh = true;
        }
        if search.is_over(0) {
            return Solved::GaveUp;
        }
        let Some(row) = choice::row(&search.values, &search.lengths) else {
            if fresh {
                return Solved::Optimal(search.solution());
            }
            search.refactor();
            fresh = true;
            continue;
        };
        search.look_at(row);
        let Some(entering) = choice::column(search.candidates()) else {
            if fresh {
                return Solved::Infeasible(search.row.iter().map(|&value| value.max(0.0)).collect());
            }
            search.refactor();
            fresh = true;
            continue;
        };
        let done = search.pivot(row, entering);
        if !done && fresh {
            return Solved::GaveUp;
        }
        if done {
            fresh = false;
        } else {
            search.refactor();
            fresh = true;
        }
    }
}

/// State of the algorithm. The variables are those of the program, then a slack variable for each row.
struct Search<'p> {
    program: &'p Program,
    /// Columns of the program.
    columns: Vec<Vec<(u32, f64)>>,
    /// Basic variable of each row.
    heads: Vec<usize>,
    is_basic: Vec<bool>,
    inverse: Inverse,
    /// Value of each row's basic variable.
    values: Vec<f64>,
    /// Approximate squared norm of each row of the inverse.
    lengths: Vec<f64>,
    /// Costs, raised where a reduced cost would have become negative.
    costs: Vec<f64>,
    reduced: Vec<f64>,
    /// The current row of the inverse, followed by the entries of the non-basic variables in it.
    row: Vec<f64>,
    entries: Vec<f64>,
    touched: Vec<usize>,
    /// Elementary steps left.
    steps: u64,
    stopping: &'p AtomicBool,
}

impl<'p> Search<'p> {
    fn new(program: &'p Program, steps: u64, stopping: &'p AtomicBool) -> Self {
        let (rows, variables) = (program.rows.len(), program.costs.len());
        let mut columns = vec![Vec::new(); variables];
        for (row, entries) in program.rows.iter().enumerate() {
            entries.iter().for_each(|&(variable, entry)| columns[variable as usize].push((row as u32, -entry)));
        }
        let mut costs = program.costs.clone();
        costs.resize(variables + rows, 0.0);
        let mut is_basic = vec![false; variables];
        is_basic.resize(variables + rows, true);
        Self {
            program,
            columns,
            heads: (variables..variables + rows).collect(),
            is_basic,
            inverse: Inverse::default(),
            values: program.least.iter().map(|&least| -least).collect(),
            lengths: vec![1.0; rows],
            reduced: costs.clone(),
            costs,
            row: vec![0.0; rows],
            entries: vec![0.0; variables + rows],
            touched: Vec::new(),
            steps,
            stopping,
        }
    }

    fn variables(&self) -> usize {
        self.program.costs.len()
    }

    /// Whether no steps are left after `spent` more, or the search was cancelled.
    fn is_over(&self, spent: usize) -> bool {
        self.steps <= spent as u64 || self.stopping.load(Ordering::Relaxed)
    }

    fn spend(&mut self, steps: usize) {
        self.steps = self.steps.saturating_sub(steps as u64);
    }

    /// Computes a row of the inverse, and its product with the non-basic columns.
    fn look_at(&mut self, row: usize) {
        self.row.fill(0.0);
        self.row[row] = 1.0;
        self.inverse.times_row(&mut self.row);
        self.touched.iter().for_each(|&variable| self.entries[variable] = 0.0);
        self.touched.clear();
        let variables = self.variables();
        let mut add = |variable: usize, value: f64| {
            if !self.is_basic[variable] {
                if self.entries[variable] == 0.0 {
                    self.touched.push(variable);
                }
                self.entries[variable] += value;
            }
        };
        let mut steps = 2 * self.row.len() + self.inverse.size();
        for (i, &value) in self.row.iter().enumerate().filter(|(_, value)| **value != 0.0) {
            add(variables + i, value);
            self.program.rows[i].iter().for_each(|&(variable, entry)| add(variable as usize, -value * entry));
            steps += 4 * self.program.rows[i].len();
        }
        // A variable is touched twice if its entry was 0 in between.
        self.touched.sort_unstable();
        self.touched.dedup();
        self.spend(steps);
    }

    fn candidates(&self) -> impl Iterator<Item = (usize, f64, f64)> + Clone {
        self.touched.iter().map(|&variable| (variable, self.entries[variable], self.reduced[variable]))
    }

    /// Pivots: lets a variable enter in a row. Returns false and does nothing if the pivot computed in two ways differs
    /// too much.
    fn pivot(&mut self, row: usize, entering: usize) -> bool {
        let mut column = vec![0.0; self.heads.len()];
        match entering.checked_sub(self.variables()) {
            Some(slack) => column[slack] = 1.0,
            None => self.columns[entering].iter().for_each(|&(i, entry)| column[i as usize] = entry),
        }
        self.inverse.times_column(&mut column);
        let pivot = column[row];
        if (pivot - self.entries[entering]).abs() > 1e-6 * (1.0 + pivot.abs()) || pivot > -1e-9 {
            return false;
        }
        let mut lengths = self.row.clone();
        self.inverse.times_column(&mut lengths);
        self.spend(6 * column.len() + 2 * self.inverse.size());

        let leaving = self.heads[row];
        let step = self.reduced[entering].max(0.0) / pivot;
        for &variable in &self.touched {
            let cost = self.reduced[variable] - step * self.entries[variable];
            self.reduced[variable] = cost.max(0.0);
            self.costs[variable] += cost.max(0.0) - cost;
        }
        self.reduced[entering] = 0.0;
        self.reduced[leaving] = -step;

        let own = self.lengths[row];
        let gain = self.values[row] / pivot;
        for (i, &entry) in column.iter().enumerate().filter(|&(i, entry)| *entry != 0.0 && i != row) {
            self.values[i] -= gain * entry;
            let ratio = entry / pivot;
            let length = self.lengths[i] - 2.0 * ratio * lengths[i] + ratio * ratio * own;
            self.lengths[i] = length.max(1e-4);
        }
        self.values[row] = gain;
        self.lengths[row] = (own / (pivot * pivot)).max(1e-4);

        self.inverse.replace(row, &column);
        self.heads[row] = entering;
        self.is_basic[entering] = true;
        self.is_basic[leaving] = false;
        true
    }

    /// Factors the basis anew, and recomputes all values. A column that depends on others leaves the basis. If this
    /// takes more steps than are left, none are left, and the state must not be used any more.
    fn refactor(&mut self) {
        let variables = self.variables();
        let mut length_of = vec![1.0; self.is_basic.len()];
        self.heads.iter().zip(&self.lengths).for_each(|(&variable, &length)| length_of[variable] = length);
        let entering: Vec<usize> = self.heads.iter().copied().filter(|&variable| variable < variables).collect();
        let mut is_free: Vec<bool> = (0..self.heads.len()).map(|row| !self.is_basic[variables + row]).collect();
        let columns: Vec<&[(u32, f64)]> = entering.iter().map(|&variable| self.columns[variable].as_slice()).collect();
        let order = triangular(&columns, &is_free);
        self.heads = (variables..variables + self.heads.len()).collect();
        self.inverse = Inverse::default();
        let mut column = vec![0.0; self.heads.len()];
        let mut spent = 0;
        let mut touched: Vec<u32> = Vec::new();
        for (variable, row) in order.into_iter().map(|(position, row)| (entering[position], row)) {
            touched.clear();
            if self.is_over(spent) {
                self.steps = 0;
                return;
            }
            for &(i, entry) in &self.columns[variable] {
                column[i as usize] = entry;
                touched.push(i);
            }
            self.inverse.reduce(&mut column, &mut touched);
            spent += touched.len() + self.inverse.size() / 8;
            let fitting = row.filter(|&row| is_free[row] && column[row].abs() > 0.01);
            let row = fitting.or_else(|| {
                let free = touched.iter().map(|&row| row as usize).filter(|&row| is_free[row]);
                free.max_by(|&a, &b| column[a].abs().total_cmp(&column[b].abs()))
            });
            match row.filter(|&row| column[row].abs() > 1e-7) {
                Some(row) => {
                    is_free[row] = false;
                    self.inverse.enter(row, &column, &touched, &is_free);
                    self.heads[row] = variable;
                }
                None => self.is_basic[variable] = false,
            }
            touched.iter().for_each(|&row| column[row as usize] = 0.0);
        }
        for row in (0..is_free.len()).filter(|&row| is_free[row]) {
            self.is_basic[variables + row] = true;
        }
        self.lengths = self.heads.iter().map(|&variable| length_of[variable]).collect();
        self.values = self.program.least.iter().map(|&least| -least).collect();
        self.inverse.times_column(&mut self.values);
        self.price();
        self.spend(spent + 4 * self.inverse.size());
    }

    /// Computes all reduced costs; where one would be negative, the cost is raised.
    fn price(&mut self) {
        let variables = self.variables();
        let mut prices: Vec<f64> = self.heads.iter().map(|&variable| self.costs[variable]).collect();
        self.inverse.times_row(&mut prices);
        for variable in 0..self.is_basic.len() {
            let cost = match variable.checked_sub(variables) {
                _ if self.is_basic[variable] => 0.0,
                Some(slack) => self.costs[variable] - prices[slack],
                None => {
                    let column = &self.columns[variable];
                    self.costs[variable] - column.iter().map(|&(i, entry)| prices[i as usize] * entry).sum::<f64>()
                }
            };
            self.reduced[variable] = cost.max(0.0);
            self.costs[variable] += cost.max(0.0) - cost;
        }
        self.spend(2 * self.is_basic.len());
    }

    /// Values of the program's variables.
    fn solution(&self) -> Vec<f64> {
        let mut solution = vec![0.0; self.variables()];
        for (&variable, &value) in self.heads.iter().zip(&self.values) {
            if variable < solution.len() {
                solution[variable] = if value > TOLERANCE { value } else { 0.0 };
            }
        }
        solution
    }
}

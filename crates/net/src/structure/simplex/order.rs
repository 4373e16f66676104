//! Pivot order for factoring a sparse matrix.

/// Order in which to enter columns, for most of them with the row of the pivot: row singletons first, since they change
/// no other column; column singletons last, since they change nothing then.
pub fn triangular(columns: &[&[(u32, f64)]], is_free: &[bool]) -> Vec<(usize, Option<usize>)> {
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
            first.push((column, Some(row)));
            (row, column)
        } else if let Some(column) = single_columns.pop() {
            if column_done[column] {
                continue;
            }
            let Some(row) = free(column).find(|&row| !row_done[row]) else { continue };
            last.push((column, Some(row)));
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
    let rest = rest.into_iter().map(|column| (column, None));
    first.into_iter().chain(rest).chain(last.into_iter().rev()).collect()
}

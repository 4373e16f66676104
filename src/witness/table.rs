//! Plain tables with groups of columns.

use std::fmt;

/// A column: its head, and the side its cells lean to.
#[derive(Clone, Debug)]
pub struct Column {
    head: String,
    left: bool,
}

impl Column {
    /// A column of values.
    pub fn right(head: impl Into<String>) -> Self {
        Self { head: head.into(), left: false }
    }

    /// A column of text.
    pub fn left(head: impl Into<String>) -> Self {
        Self { head: head.into(), left: true }
    }

    fn pad(&self, cell: &str, width: usize) -> String {
        if self.left { format!("{cell:<width$}") } else { format!("{cell:>width$}") }
    }
}

/// A table: groups of columns, separated by a bar, and rows of cells.
#[derive(Clone, Debug, Default)]
pub struct Table {
    groups: Vec<Vec<Column>>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with these groups of columns; groups without columns are left out.
    #[must_use]
    pub fn new(groups: Vec<Vec<Column>>) -> Self {
        Self { groups: groups.into_iter().filter(|group| !group.is_empty()).collect(), rows: Vec::new() }
    }

    /// Adds a row: one cell for each column.
    pub fn row(&mut self, cells: Vec<String>) {
        self.rows.push(cells);
    }

    /// Sets the cells of a row, group by group.
    fn line(&self, widths: &[usize], separator: &str, cell: impl Fn(usize, &Column) -> String) -> String {
        let mut column = 0;
        let groups = self.groups.iter().map(|group| {
            let cells = group.iter().map(|c| {
                column += 1;
                c.pad(&cell(column - 1, c), widths[column - 1])
            });
            cells.collect::<Vec<_>>().join(if separator.contains('+') { "-" } else { " " })
        });
        groups.collect::<Vec<_>>().join(separator).trim_end().to_owned()
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let heads = self.groups.iter().flatten().map(|column| column.head.as_str());
        let widths: Vec<usize> = heads
            .enumerate()
            .map(|(i, head)| {
                let cells = self.rows.iter().map(|row| row[i].as_str());
                cells.chain([head]).map(|cell| cell.chars().count()).max().unwrap_or(0)
            })
            .collect();
        writeln!(f, "{}", self.line(&widths, " | ", |_, column| column.head.clone()))?;
        writeln!(f, "{}", self.line(&widths, "-+-", |i, _| "-".repeat(widths[i])))?;
        self.rows.iter().try_for_each(|row| writeln!(f, "{}", self.line(&widths, " | ", |i, _| row[i].clone())))
    }
}

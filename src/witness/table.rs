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

    /// The table as a text no wider than this, where it can be: what does not fit stands below, in another block of columns
    /// that begins with the first group again.
    #[must_use]
    pub fn in_blocks(&self, width: usize) -> String {
        let widths = self.widths();
        let fixed = self.groups.first().map_or(0, Vec::len);
        let own = |columns: &[usize]| columns.iter().map(|&column| widths[column] + 1).sum::<usize>();
        let head = own(&(0..fixed).collect::<Vec<_>>());
        let mut blocks: Vec<Vec<usize>> = vec![Vec::new()];
        let (mut taken, mut last) = (head, 0);
        let columns = self.groups.iter().enumerate().flat_map(|(group, columns)| columns.iter().map(move |_| group));
        for (column, group) in columns.enumerate().skip(fixed) {
            // A bar with two spaces stands between groups, a space between columns.
            let needed = widths[column] + if group == last { 1 } else { 3 };
            if taken + needed > width + 1 && blocks.last().is_some_and(|block| !block.is_empty()) {
                blocks.push(Vec::new());
                taken = head;
                last = 0;
            }
            taken += widths[column] + if group == last { 1 } else { 3 };
            last = group;
            blocks.last_mut().expect("there is a first block").push(column);
        }
        let texts: Vec<String> = blocks.iter().map(|block| self.part(fixed, block).to_string()).collect();
        texts.join("\n")
    }

    /// The first columns, and some others.
    fn part(&self, fixed: usize, columns: &[usize]) -> Self {
        let is_in = |column: usize| column < fixed || columns.contains(&column);
        let mut position = 0..;
        let groups = self
            .groups
            .iter()
            .map(|group| group.iter().filter(|_| position.next().is_some_and(is_in)).cloned().collect());
        let mut part = Self::new(groups.collect());
        part.rows = self
            .rows
            .iter()
            .map(|row| {
                row.iter().enumerate().filter(|(column, _)| is_in(*column)).map(|(_, cell)| cell.clone()).collect()
            })
            .collect();
        part
    }

    /// How wide each column is.
    fn widths(&self) -> Vec<usize> {
        let heads = self.groups.iter().flatten().map(|column| column.head.as_str());
        heads
            .enumerate()
            .map(|(i, head)| {
                let cells = self.rows.iter().map(|row| row[i].as_str());
                cells.chain([head]).map(|cell| cell.chars().count()).max().unwrap_or(0)
            })
            .collect()
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
        let widths = self.widths();
        writeln!(f, "{}", self.line(&widths, " | ", |_, column| column.head.clone()))?;
        writeln!(f, "{}", self.line(&widths, "-+-", |i, _| "-".repeat(widths[i])))?;
        self.rows.iter().try_for_each(|row| writeln!(f, "{}", self.line(&widths, " | ", |i, _| row[i].clone())))
    }
}

#[cfg(test)]
mod tests {
    use super::{Column, Table};

    #[test]
    fn what_does_not_fit_stands_below() {
        let right = |heads: &[&str]| heads.iter().map(|&head| Column::right(head)).collect::<Vec<_>>();
        let mut table = Table::new(vec![right(&["scan"]), right(&["S1", "Start"]), right(&["Motor"])]);
        table.row(["1", "0", "1", "-300"].map(str::to_owned).into());
        table.row(["2", "1", "0", "7"].map(str::to_owned).into());
        let whole =
            "scan | S1 Start | Motor\n-----+----------+------\n   1 |  0     1 |  -300\n   2 |  1     0 |     7\n";
        assert_eq!(table.to_string(), whole);
        assert_eq!(table.in_blocks(23), whole);
        let halves = "scan | S1 Start\n-----+---------\n   1 |  0     1\n   2 |  1     0\n\n\
                      scan | Motor\n-----+------\n   1 |  -300\n   2 |     7\n";
        assert_eq!(table.in_blocks(22), halves);
        assert_eq!(table.in_blocks(15), halves);
        assert_eq!(table.in_blocks(14).lines().filter(|line| line.starts_with("scan")).count(), 3);
        assert_eq!(table.in_blocks(1).lines().filter(|line| line.starts_with("scan")).count(), 3);
    }
}

//! Plain tables with groups of columns.

use std::fmt;

use petril_base::printable;

/// A column: head and alignment.
#[derive(Clone, Debug)]
pub struct Column {
    head: String,
    left: bool,
}

impl Column {
    /// Right-aligned column, for values.
    pub fn right(head: impl Into<String>) -> Self {
        Self { head: printable::line(&head.into()), left: false }
    }

    /// Left-aligned column, for text.
    pub fn left(head: impl Into<String>) -> Self {
        Self { head: printable::line(&head.into()), left: true }
    }

    fn pad(&self, cell: &str, width: usize) -> String {
        if self.left { format!("{cell:<width$}") } else { format!("{cell:>width$}") }
    }
}

/// Table: groups of columns, separated by a bar, and rows of cells.
#[derive(Clone, Debug, Default)]
pub struct Table {
    groups: Vec<Vec<Column>>,
    rows: Vec<Row>,
}

/// A row of a table.
#[derive(Clone, Debug)]
enum Row {
    /// Row with one cell per column.
    Cells(Vec<String>),
    /// Text across all columns.
    Across(String),
}

impl Table {
    /// Creates a table with these groups of columns; groups without columns are left out.
    #[must_use]
    pub fn new(groups: Vec<Vec<Column>>) -> Self {
        Self { groups: groups.into_iter().filter(|group| !group.is_empty()).collect(), rows: Vec::new() }
    }

    /// Adds a row of one cell per column. Each cell is made one line of printable text.
    pub fn row(&mut self, cells: &[String]) {
        self.rows.push(Row::Cells(cells.iter().map(|cell| printable::line(cell)).collect()));
    }

    /// Adds a line of text across all columns.
    pub fn across(&mut self, text: &str) {
        self.rows.push(Row::Across(printable::line(text)));
    }

    /// The table in blocks of columns that fit into `width` characters where possible: one below another, separated by
    /// an empty line, each with the first group of columns.
    #[must_use]
    pub fn within(&self, width: usize) -> String {
        let widths = self.widths();
        let first = self.groups.first().map_or(0, Vec::len);
        let own: usize = widths[..first].iter().sum::<usize>() + first.saturating_sub(1);
        let mut blocks: Vec<Vec<usize>> = Vec::new();
        let (mut used, mut column) = (0, 0);
        for (group, columns) in self.groups.iter().enumerate() {
            for place in 0..columns.len() {
                let gap = if place == 0 { 3 } else { 1 };
                match blocks.last_mut() {
                    _ if group == 0 => {}
                    Some(block) if used + gap + widths[column] <= width => {
                        block.push(column);
                        used += gap + widths[column];
                    }
                    _ => {
                        blocks.push((0..first).chain([column]).collect());
                        used = own + 3 + widths[column];
                    }
                }
                column += 1;
            }
        }
        let texts: Vec<String> =
            blocks.iter().map(|block| self.block(&widths, width, &|column| block.contains(&column))).collect();
        if texts.is_empty() { self.block(&widths, width, &|_| true) } else { texts.join("\n") }
    }

    /// Width of each column, in characters.
    fn widths(&self) -> Vec<usize> {
        let heads = self.groups.iter().flatten().map(|column| column.head.as_str());
        let width = |(i, head): (usize, &str)| {
            let cells = self.rows.iter().filter_map(|row| match row {
                Row::Cells(cells) => Some(cells[i].as_str()),
                Row::Across(_) => None,
            });
            cells.chain([head]).map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        heads.enumerate().map(width).collect()
    }

    /// Block of some columns. Texts across the table are wrapped at `width` characters.
    fn block(&self, widths: &[usize], width: usize, shown: &dyn Fn(usize) -> bool) -> String {
        let mut text = self.line(widths, shown, " | ", |_, column| column.head.clone());
        text += &self.line(widths, shown, "-+-", |i, _| "-".repeat(widths[i]));
        for row in &self.rows {
            match row {
                Row::Cells(cells) => text += &self.line(widths, shown, " | ", |i, _| cells[i].clone()),
                Row::Across(across) => text += &broken(across, width),
            }
        }
        text
    }

    /// Joins the cells of a row, group by group.
    fn line(
        &self,
        widths: &[usize],
        shown: &dyn Fn(usize) -> bool,
        separator: &str,
        cell: impl Fn(usize, &Column) -> String,
    ) -> String {
        let mut number = 0;
        let mut groups = Vec::with_capacity(self.groups.len());
        for group in &self.groups {
            let columns = group.iter().zip(number..).filter(|(_, column)| shown(*column));
            let cells: Vec<String> = columns.map(|(column, i)| column.pad(&cell(i, column), widths[i])).collect();
            number += group.len();
            if !cells.is_empty() {
                groups.push(cells.join(if separator.contains('+') { "-" } else { " " }));
            }
        }
        format!("{}\n", groups.join(separator).trim_end())
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.block(&self.widths(), usize::MAX, &|_| true))
    }
}

/// Wraps a text at words into lines of at most `width` characters; continuation lines are indented.
fn broken(text: &str, width: usize) -> String {
    const HANG: usize = 4;
    let (mut out, mut used) = (String::new(), 0);
    for word in text.split(' ') {
        let length = word.chars().count();
        if used > HANG && used.saturating_add(1 + length) > width {
            out += &format!("\n{:HANG$}", "");
            used = HANG;
        } else if used > 0 {
            out.push(' ');
            used += 1;
        }
        out += word;
        used += length;
    }
    out + "\n"
}

#[cfg(test)]
mod tests {
    use super::{Column, Table};

    #[test]
    fn a_narrow_table_is_split_into_blocks() {
        let groups = [vec!["scan"], vec!["In", "Stop"], vec!["Motor"]];
        let mut table = Table::new(groups.map(|group| group.into_iter().map(Column::right).collect()).into());
        table.row(&["1", "*1", "0", "*1"].map(String::from));
        let whole = "scan | In Stop | Motor\n-----+---------+------\n   1 | *1    0 |    *1\n";
        assert_eq!(table.to_string(), whole);
        assert_eq!(table.within(22), whole);
        let split = "scan | In Stop\n-----+--------\n   1 | *1    0\n\nscan | Motor\n-----+------\n   1 |    *1\n";
        assert_eq!(table.within(21), split);
        let apart = "scan | In\n-----+---\n   1 | *1\n\nscan | Stop\n-----+-----\n   1 |    0\n\nscan | Motor\n-----+------\n   1 |    *1\n";
        assert_eq!(table.within(5), apart, "what does not fit stands alone");
    }

    #[test]
    fn a_text_across_a_table_is_broken_at_words() {
        let mut table = Table::new(vec![vec![Column::right("scan")], vec![Column::right("n")]]);
        table.row(&["1".to_owned(), "7".to_owned()]);
        table.across("… 40 scans: n 7 → 47 …");
        let head = "scan | n\n-----+--\n   1 | 7\n";
        assert_eq!(table.to_string(), format!("{head}… 40 scans: n 7 → 47 …\n"));
        assert_eq!(table.within(14), format!("{head}… 40 scans: n\n    7 → 47 …\n"));
    }
}

//! Tables as CSV (RFC 4180) in which every cell is one line of printable text, and none is a formula to a spreadsheet.
//!
//! Spreadsheets evaluate cells that begin with `=`, `+`, `-` or `@`; a `'` before it makes the cell a text (OWASP, *CSV
//! Injection*). Numbers stay as they are.

use std::io;

use petril_base::printable::line;
use petril_base::to_text;

/// Characters that begin a formula, including their full-width forms.
const BEGINNINGS: [char; 8] = ['=', '+', '-', '@', '＝', '＋', '－', '＠'];

/// Writes rows, which may differ in length.
pub fn write(rows: impl IntoIterator<Item = Vec<String>>) -> String {
    to_text(|out| {
        let mut writer = csv::WriterBuilder::new().flexible(true).from_writer(out);
        for row in rows {
            let cells = row.iter().map(|text| cell(text));
            writer.write_record(cells).map_err(io::Error::other)?;
        }
        writer.flush()
    })
}

/// Encodes a text as a cell.
fn cell(text: &str) -> String {
    let text = line(text);
    let is_formula = text.trim_start().starts_with(BEGINNINGS) && text.parse::<f64>().is_err();
    if is_formula { format!("'{text}") } else { text }
}

/// Decodes a cell written by [`write`].
pub fn uncovered(cell: &str) -> &str {
    cell.strip_prefix('\'').filter(|text| text.trim_start().starts_with(BEGINNINGS)).unwrap_or(cell)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spreadsheets_have_nothing_to_compute() {
        let row = ["=cmd()", " +1+1", "-5", "-5.5", "@x", "a\nb", "'x", "", "a,b\"", "＝1"];
        let written = write([row.map(str::to_owned).to_vec()]);
        assert_eq!(written, "'=cmd(),' +1+1,-5,-5.5,'@x,a\\nb,'x,,\"a,b\"\"\",'＝1\n");
        assert_eq!(row.map(|text| uncovered(&cell(text)).to_owned()), row.map(line));
    }
}

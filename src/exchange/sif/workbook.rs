//! Workbooks (XLSX) as rows of text, within limits: a small file can unpack to any size, and name a cell anywhere.

use std::io::Cursor;

use calamine::{Data, Reader as _, Xlsx};

/// Upper bounds on rows and columns of a list, and on cells counted in each row up to the last one used.
const MAX_ROWS: usize = 100_000;
const MAX_COLUMNS: usize = 1000;
const MAX_POSITIONS: usize = 4_000_000;

/// Upper bound on the unpacked size of a workbook in bytes: a small file can unpack to any size.
const MAX_UNPACKED: u64 = 256 << 20;

/// Rows of the first sheet of a workbook (XLSX), read cell by cell.
///
/// # Errors
/// The bytes are not a workbook, a cell is too far out, or the workbook is too large when unpacked.
pub fn rows(bytes: &[u8]) -> Result<Vec<Vec<String>>, String> {
    if unpacked(bytes).is_some_and(|size| size > MAX_UNPACKED) {
        return Err(format!("unpacked, the workbook has more than {} MiB", MAX_UNPACKED >> 20));
    }
    let mut book: Xlsx<_> = Xlsx::new(Cursor::new(bytes)).map_err(|error| error.to_string())?;
    let name = book.sheet_names().first().cloned().ok_or("the workbook has no sheet")?;
    let mut cells = book.worksheet_cells_reader(&name).map_err(|error| error.to_string())?;
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut positions = 0;
    while let Some(cell) = cells.next_cell().map_err(|error| error.to_string())? {
        let (row, column) = (cell.get_position().0 as usize, cell.get_position().1 as usize);
        let text = Data::from(cell.get_value().clone()).to_string().trim().to_owned();
        if text.is_empty() {
            continue;
        }
        let wider = (column + 1).saturating_sub(rows.get(row).map_or(0, Vec::len));
        positions += wider;
        if row >= MAX_ROWS || column >= MAX_COLUMNS || positions > MAX_POSITIONS {
            return Err(format!(
                "the cell in row {}, column {} is too far out: a list has at most {MAX_ROWS} rows and {MAX_COLUMNS} columns",
                row + 1,
                column + 1
            ));
        }
        if rows.len() <= row {
            rows.resize_with(row + 1, Vec::new);
        }
        if rows[row].len() <= column {
            rows[row].resize_with(column + 1, String::new);
        }
        rows[row][column] = text;
    }
    Ok(rows)
}

/// Total unpacked size according to the directory of a ZIP archive; `None` without a directory, which the reader will
/// report.
fn unpacked(bytes: &[u8]) -> Option<u64> {
    let number = |at: usize, length: usize| -> Option<u64> {
        let digits = bytes.get(at..at.checked_add(length)?)?;
        Some(digits.iter().rev().fold(0, |number, &digit| number << 8 | u64::from(digit)))
    };
    let end = bytes.windows(4).rposition(|word| word == b"PK\x05\x06")?;
    let (count, mut at) = (number(end + 10, 2)?, usize::try_from(number(end + 16, 4)?).ok()?);
    let mut sum = 0;
    for _ in 0..count {
        // For a part of 4 GiB or more this field is 2³² − 1, and the size is elsewhere.
        sum += number(at + 24, 4)?;
        at += 46 + (number(at + 28, 2)? + number(at + 30, 2)? + number(at + 32, 2)?) as usize;
    }
    Some(sum)
}

//! Import of I/O lists, as engineers keep them in tables (CSV, XLSX), as the skeleton of a specification.
//!
//! The first row with a column for names is the head. Columns are recognised by their titles; only a name, and whether
//! it is an input or an output, is required.

use super::plan_csv::separator;
use petril_lang::syntax::standard_address;

/// Titles of columns, in lower case.
const HEADS: [(&str, &[&str]); 8] = [
    ("name", &["name", "signal", "tag", "symbol", "signal name", "tag name"]),
    ("direction", &["direction", "i/o", "io", "in/out", "kind", "type", "i/o type", "io type"]),
    ("description", &["description", "comment", "text", "meaning", "designation"]),
    ("address", &["address", "variable", "channel", "plc address", "plc variable"]),
    ("zone", &["zone", "area", "group"]),
    ("function", &["function", "sif", "safety function"]),
    (
        "rest",
        &["rest", "normally", "normal", "rest value", "normal value", "contact", "contact type", "nc/no", "no/nc"],
    ),
    ("data type", &["data type", "datatype", "signal type"]),
];

/// Kinds of signals, and data types, that are not Boolean.
const ANALOGUE: [&str; 26] = [
    "ai",
    "ao",
    "analog",
    "analogue",
    "analog input",
    "analogue input",
    "analog output",
    "analogue output",
    "analog in",
    "analog out",
    "sint",
    "int",
    "dint",
    "lint",
    "usint",
    "uint",
    "udint",
    "ulint",
    "byte",
    "word",
    "dword",
    "lword",
    "real",
    "lreal",
    "time",
    "string",
];

/// Rows of a text with values separated by commas, semicolons or tabs.
///
/// # Errors
/// The text is not a table.
pub fn rows_of_text(text: &str) -> Result<Vec<Vec<String>>, String> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .delimiter(separator(text))
        .from_reader(text.as_bytes());
    let rows = reader.records().map(|record| Ok(record?.iter().map(str::to_owned).collect()));
    rows.collect::<Result<_, csv::Error>>().map_err(|error| error.to_string())
}

/// Declaration of the list.
struct Line {
    is_output: bool,
    declaration: String,
    name: String,
}

/// Functions by zone, with their declarations, in the order of the list. Inputs without function precede them.
#[derive(Default)]
struct Frame {
    inputs: Vec<String>,
    functions: Vec<(String, String, Vec<Line>)>,
}

/// Writes the skeleton of a specification, in which only the formulas are missing.
///
/// # Errors
/// A sentence for each incomplete row.
pub fn frame(title: &str, rows: &[Vec<String>]) -> Result<String, Vec<String>> {
    let head = rows.iter().position(|row| column(row, 0).is_some());
    let Some(head) = head else {
        let message = "no row is a head with a column `name`, and one `direction` or `address`";
        return Err(vec![message.to_owned()]);
    };
    let columns: [Option<usize>; 8] = std::array::from_fn(|kind| column(&rows[head], kind));
    let mut frame = Frame::default();
    let mut errors = Vec::new();
    for (number, row) in rows.iter().enumerate().skip(head + 1) {
        let cell = |kind: usize| columns[kind].and_then(|at| row.get(at)).map_or("", String::as_str);
        if !cell(0).is_empty()
            && let Err(message) = frame.add(&cell)
        {
            errors.push(format!("row {}: {message}", number + 1));
        }
    }
    if errors.is_empty() { Ok(frame.text(title)) } else { Err(errors) }
}

/// Column of a kind, in a row that may be the head.
fn column(row: &[String], kind: usize) -> Option<usize> {
    row.iter().position(|cell| HEADS[kind].1.contains(&cell.to_lowercase().as_str()))
}

impl Frame {
    fn add<'c>(&mut self, cell: &impl Fn(usize) -> &'c str) -> Result<(), String> {
        let [said, direction, description, address, zone, function, rest, data] = std::array::from_fn(cell);
        let standard = standard_address(address).filter(|_| is_address(address));
        let is_wide = standard.as_ref().is_some_and(|address| address[2..].starts_with(['B', 'W', 'D']));
        if is_wide || [direction, data].iter().any(|kind| ANALOGUE.contains(&kind.to_lowercase().as_str())) {
            let message = format!("`{said}` is not Boolean, and safety functions are");
            return Err(format!("{message}: leave it out, or give the signal that the program makes of it"));
        }
        let address = standard.as_deref().unwrap_or(address);
        let is_output = output(direction, address)
            .ok_or_else(|| format!("nothing says whether `{said}` is an input or an output"))?;
        let name = identifier(said);
        let mut words: Vec<&str> = vec![description];
        if name != said {
            words.push(said);
        }
        words.retain(|word| !word.is_empty());
        let mut declaration = format!("{} {name}", if is_output { "output" } else { "input" });
        if !words.is_empty() {
            declaration += &format!(" {}", quoted(&words.join(", ")));
        }
        declaration += &match address {
            "" => String::new(),
            address if address.starts_with('%') => format!(" at {address}"),
            variable => format!(" is {variable}"),
        };
        let is_at_rest = at_rest(rest)
            .ok_or_else(|| format!("`{rest}` does not say what `{said}` is at rest: write NC or TRUE, NO or FALSE"))?;
        if !is_output && is_at_rest {
            declaration += " normally TRUE";
        }
        declaration += ";";
        if function.is_empty() && !is_output {
            self.inputs.push(declaration);
            return Ok(());
        }
        let function = if function.is_empty() { "Unassigned".to_owned() } else { identifier(function) };
        let zone = if zone.is_empty() { String::new() } else { identifier(zone) };
        let found = self.functions.iter().position(|(z, f, _)| *z == zone && *f == function);
        let position = found.unwrap_or_else(|| {
            self.functions.push((zone, function, Vec::new()));
            self.functions.len() - 1
        });
        self.functions[position].2.push(Line { is_output, declaration, name });
        Ok(())
    }

    fn text(mut self, title: &str) -> String {
        let mut out =
            format!("// The frame of a specification. Its formulas are to be written in.\nsystem {};\n", quoted(title));
        for input in &self.inputs {
            out += &format!("{input}\n");
        }
        // Zones may be continued, so the order of the list is kept.
        let mut open = String::new();
        for (zone, function, lines) in &mut self.functions {
            if *zone != open {
                out += if open.is_empty() { "" } else { "}\n" };
                out += &if zone.is_empty() { String::new() } else { format!("\nzone {zone} {{\n") };
                open.clone_from(zone);
            }
            let indent = if zone.is_empty() { "" } else { "    " };
            lines.sort_by_key(|line| line.is_output);
            let declarations: String =
                lines.iter().map(|line| format!("{indent}        {}\n", line.declaration)).collect();
            let outputs = lines.iter().filter(|line| line.is_output);
            let missing: String = outputs.map(|line| format!("{indent}        // {} = \n", line.name)).collect();
            out += &format!(
                "\n{indent}function {function} {{\n{indent}    interface {{\n{declarations}{indent}    }}\n\
                 {indent}    formal {{\n{missing}{indent}    }}\n{indent}}}\n"
            );
        }
        out + if open.is_empty() { "" } else { "}\n" }
    }
}

/// Whether a text is an address rather than a variable: `%IX0.0`, `%I0.0`, `I0.0`, or Siemens' `E0.0` and `A4.0`.
fn is_address(text: &str) -> bool {
    text.starts_with('%') || text.contains('.') || text.get(1..2).is_some_and(|size| size.eq_ignore_ascii_case("W"))
}

/// Value at rest of a contact; a normally closed one is TRUE.
fn at_rest(text: &str) -> Option<bool> {
    match text.to_lowercase().as_str() {
        "true" | "1" | "yes" | "on" | "nc" | "n.c." | "n/c" | "normally closed" | "closed" => Some(true),
        "" | "-" | "false" | "0" | "off" | "no" | "n.o." | "n/o" | "normally open" | "open" => Some(false),
        _ => None,
    }
}

/// Whether a signal is an output, by its direction or else by its address.
fn output(direction: &str, address: &str) -> Option<bool> {
    match direction.to_lowercase().as_str() {
        "input" | "in" | "i" | "di" | "digital input" => Some(false),
        "output" | "out" | "o" | "q" | "do" | "digital output" => Some(true),
        _ => match address.to_uppercase().get(..2) {
            Some("%I") => Some(false),
            Some("%Q") => Some(true),
            _ => None,
        },
    }
}

/// Reserved words of formulas.
const RESERVED: [&str; 8] = ["not", "and", "or", "xor", "implies", "iff", "true", "false"];

/// Converts a text to an identifier: characters other than letters and digits become `_`.
fn identifier(text: &str) -> String {
    let plain: String = text.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
    let begins = plain.starts_with(|c: char| c.is_alphabetic() || c == '_');
    if begins && !RESERVED.contains(&plain.to_lowercase().as_str()) { plain } else { format!("_{plain}") }
}

/// Quotes a text; the language has no escape for quotation marks.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.split_whitespace().collect::<Vec<_>>().join(" ").replace('"', "'"))
}

//! Conversion of texts to markup: the only place where user texts enter the page.

use quick_xml::escape::escape;

use petril_base::printable;

/// Escapes a text, on one line.
pub fn escaped(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    escape(printable::line(&line)).into_owned()
}

/// Markup of a name or formula.
pub fn code(text: &str) -> String {
    format!("<code>{}</code>", escaped(text))
}

/// Table row from cells in markup.
pub fn row(cells: impl IntoIterator<Item = String>) -> String {
    let cells: Vec<String> = cells.into_iter().map(|cell| format!("<td>{cell}</td>")).collect();
    format!("<tr>{}</tr>\n", cells.concat())
}

/// Table from rows in markup, with plain texts as heads. Scrolls in a box of its own where it is too wide for the
/// screen.
pub fn table(class: &str, heads: &[&str], rows: impl IntoIterator<Item = String>) -> String {
    let heads: Vec<String> = heads.iter().map(|head| format!("<th scope=\"col\">{}</th>", escaped(head))).collect();
    let rows: String = rows.into_iter().collect();
    format!(
        "<div class=\"scroll\"><table class=\"{class}\">\n<thead><tr>{}</tr></thead>\n<tbody>\n{rows}</tbody>\n</table></div>\n",
        heads.concat()
    )
}

/// Checkbox: ticked, not ticked, or to be ticked by hand.
pub fn tick(what: &str, is_on: Option<bool>) -> String {
    let (class, sign, state) = match is_on {
        Some(true) => (" on", "✓", "yes"),
        Some(false) => ("", "", "no"),
        None => ("", "", "to be ticked"),
    };
    format!("<span class=\"box{class} {what}\" role=\"img\" aria-label=\"{what}: {state}\">{sign}</span>")
}

/// A count with its noun: `1 test`, `2 tests`.
pub fn counted(count: usize, thing: &str) -> String {
    if count == 1 { format!("1 {thing}") } else { format!("{count} {thing}s") }
}

/// Markup of a text in which backticks enclose code.
pub fn ticked(text: &str) -> String {
    let pieces = text.split('`').enumerate();
    pieces.map(|(at, piece)| if at % 2 == 1 { code(piece) } else { spaced(piece) }).collect()
}

/// A piece of text with the blanks at its ends.
fn spaced(text: &str) -> String {
    let blank = |is: bool| if is { " " } else { "" };
    let inner = escaped(text);
    format!("{}{inner}{}", blank(text.starts_with(' ')), blank(text.ends_with(' ') && !inner.is_empty()))
}

//! Texts as markup: the only place where what users wrote becomes part of the page.

use quick_xml::escape::escape;

use petril_base::printable;

/// A text on one line, with nothing in it that could be read as markup.
pub fn escaped(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    escape(printable::line(&line)).into_owned()
}

/// A name or formula.
pub fn code(text: &str) -> String {
    format!("<code>{}</code>", escaped(text))
}

/// A row of markup.
pub fn row(cells: impl IntoIterator<Item = String>) -> String {
    let cells: Vec<String> = cells.into_iter().map(|cell| format!("<td>{cell}</td>")).collect();
    format!("<tr>{}</tr>\n", cells.concat())
}

/// A table of markup, with heads that are plain words. It scrolls in its own box where it is too wide for a screen.
pub fn table(class: &str, heads: &[&str], rows: impl IntoIterator<Item = String>) -> String {
    let heads: Vec<String> = heads.iter().map(|head| format!("<th scope=\"col\">{}</th>", escaped(head))).collect();
    let rows: String = rows.into_iter().collect();
    format!(
        "<div class=\"scroll\"><table class=\"{class}\">\n<thead><tr>{}</tr></thead>\n<tbody>\n{rows}</tbody>\n</table></div>\n",
        heads.concat()
    )
}

/// A box to tick, or ticked already.
pub fn tick(what: &str, is_on: Option<bool>) -> String {
    let (class, sign, state) = match is_on {
        Some(true) => (" on", "✓", "yes"),
        Some(false) => ("", "", "no"),
        None => ("", "", "to be ticked"),
    };
    format!("<span class=\"box{class} {what}\" role=\"img\" aria-label=\"{what}: {state}\">{sign}</span>")
}

/// A number of things: `1 test`, `2 tests`.
pub fn counted(count: usize, thing: &str) -> String {
    if count == 1 { format!("1 {thing}") } else { format!("{count} {thing}s") }
}

/// A text in which backticks enclose code.
pub fn ticked(text: &str) -> String {
    let pieces = text.split('`').enumerate();
    pieces.map(|(at, piece)| if at % 2 == 1 { code(piece) } else { spaced(piece) }).collect()
}

/// A piece of a text, with the blanks at its ends.
fn spaced(text: &str) -> String {
    let blank = |is: bool| if is { " " } else { "" };
    let inner = escaped(text);
    format!("{}{inner}{}", blank(text.starts_with(' ')), blank(text.ends_with(' ') && !inner.is_empty()))
}

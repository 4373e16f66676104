//! Paragraphs and indentation of reports.

use petril::printable;

/// Indentation of the details of an answer.
pub const INDENT: &str = "    ";

/// Indents all non-empty lines.
pub fn indent(text: &str) -> String {
    text.lines().map(|line| if line.is_empty() { "\n".to_owned() } else { format!("{INDENT}{line}\n") }).collect()
}

/// Paragraph wrapped to `width` where its words allow. The first line begins with `first`, all others are indented by
/// `hang`. Control characters of the text are made visible, so that it cannot start a line or hide anything.
pub fn paragraph(first: &str, hang: usize, text: &str, width: usize) -> String {
    let mut lines = vec![first.to_owned()];
    let mut used = first.chars().count();
    let mut is_empty = true;
    for word in words(&printable::line(text)) {
        let length = word.chars().count();
        if !is_empty && used + 1 + length > width {
            lines.push(" ".repeat(hang));
            (used, is_empty) = (hang, true);
        }
        if let Some(line) = lines.last_mut() {
            line.push_str(if is_empty { "" } else { " " });
            line.push_str(word);
        }
        used += length + usize::from(!is_empty);
        is_empty = false;
    }
    lines.iter().map(|line| format!("{}\n", line.trim_end())).collect()
}

/// Words of a text; runs of blanks within it are kept.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(' ')
}

/// Count with its noun: `1 scan`, `2 scans`.
pub fn counted(n: usize, thing: &str) -> String {
    if n == 1 { format!("1 {thing}") } else { format!("{n} {thing}s") }
}

/// Joined list: "a", "a or b", "a, b or c".
pub fn joined(parts: &[String], word: &str) -> String {
    match parts {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} {word} {last}", first.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::paragraph;

    #[test]
    fn a_paragraph_hangs_below_its_first_line() {
        assert_eq!(paragraph("note: ", 6, "one two three", 13), "note: one two\n      three\n");
        assert_eq!(paragraph("note: ", 6, "one two", usize::MAX), "note: one two\n");
        assert_eq!(paragraph("", 2, "longerthanthat word", 5), "longerthanthat\n  word\n");
        assert_eq!(paragraph("x", 0, "", 5), "x\n");
    }
}

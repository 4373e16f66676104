//! Plant places named by a valuation, like `S1=1,level=-5`: while the place is marked, these variables have these
//! values.

/// Variable and value, as they are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Assignment<'a> {
    /// Whole text, as in `level = -5`.
    pub text: &'a str,
    /// Name of the variable.
    pub variable: &'a str,
    /// Value of the variable.
    pub value: Value,
}

/// Value as it is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    /// `TRUE`, `FALSE`
    Truth(bool),
    /// `0`, `1`, `-5`, `16#FF`, `1_000`
    Number(i128),
}

/// Parses a name as a valuation. `None` if it is not one: an internal place of the plant. Blanks and one pair of braces
/// around the whole do not count.
///
/// # Errors
/// The piece that is not of the form `name=value`.
pub fn parse(name: &str) -> Option<Result<Vec<Assignment<'_>>, &str>> {
    let name = name.trim();
    let name = name.strip_prefix('{').and_then(|name| name.strip_suffix('}')).unwrap_or(name);
    name.contains('=').then(|| name.split(',').map(assignment).collect())
}

fn assignment(piece: &str) -> Result<Assignment<'_>, &str> {
    let text = piece.trim();
    let (variable, value) = piece.split_once('=').ok_or(text)?;
    let value = match value.trim() {
        word if word.eq_ignore_ascii_case("FALSE") => Value::Truth(false),
        word if word.eq_ignore_ascii_case("TRUE") => Value::Truth(true),
        digits => Value::Number(number(digits).ok_or(text)?),
    };
    Ok(Assignment { text, variable: variable.trim(), value })
}

/// Parses an integer literal (IEC 61131-3, B.1.2.1): with a sign, in base 2, 8, 10 or 16, underscores between digits.
fn number(text: &str) -> Option<i128> {
    let (negative, text) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text),
    };
    let (base, digits) = match text.split_once('#') {
        Some((base, digits)) => (base.parse().ok().filter(|base| [2, 8, 16].contains(base))?, digits),
        None => (10, text),
    };
    // A number longer than any type has no value anyway.
    let is_digit = |c: char| c.is_digit(base) || c == '_';
    if digits.len() > 80 || !digits.starts_with(|c: char| c.is_digit(base)) || !digits.chars().all(is_digit) {
        return None;
    }
    let magnitude = i128::from_str_radix(&digits.replace('_', ""), base).ok()?;
    Some(if negative { -magnitude } else { magnitude })
}

#[cfg(test)]
mod tests {
    use super::{Assignment, Value, parse};

    /// Variables and values; a truth value as T or F.
    fn read(name: &str) -> Option<Result<Vec<(String, String)>, &str>> {
        let value = |value| match value {
            Value::Truth(truth) => if truth { "T" } else { "F" }.to_owned(),
            Value::Number(number) => number.to_string(),
        };
        let pair = |a: Assignment<'_>| (a.variable.to_owned(), value(a.value));
        parse(name).map(|list| list.map(|list| list.into_iter().map(pair).collect()))
    }

    #[test]
    fn names_are_valuations_or_not() {
        let of = |pairs: &[(&str, &str)]| {
            Some(Ok(pairs.iter().map(|&(name, value)| (name.to_owned(), value.to_owned())).collect()))
        };
        assert_eq!(read("S1=1,O1=0"), of(&[("S1", "1"), ("O1", "0")]));
        assert_eq!(read(" { S1 = TRUE } "), of(&[("S1", "T")]));
        assert_eq!(read("moving"), None);
        assert_eq!(read("level=-1_000, mask = 16#fF"), of(&[("level", "-1000"), ("mask", "255")]));
        assert_eq!(read("S1=1,O1"), Some(Err("O1")));
        for wrong in ["S1=", "S1=a", "S1=1.5", "S1=_1", "S1=3#1", "S1=2#2", "S1=--1", "S1=-", "S1=+1"] {
            assert_eq!(read(wrong), Some(Err(wrong)), "{wrong}");
        }
        let long = format!("x={}", "9".repeat(60));
        assert_eq!(read(&long), Some(Err(long.as_str())));
    }
}

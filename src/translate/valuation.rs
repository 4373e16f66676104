//! Plant places named by a valuation, like `S1=1,O1=0`: while the place is marked, these variables have these values.

/// Reads a name as a valuation. `None` if it is none: an internal place of the plant. Blanks and one pair of braces
/// around the whole do not count.
///
/// # Errors
/// The piece that is no `name=value` with a value 0, 1, FALSE or TRUE.
pub fn parse(name: &str) -> Option<Result<Vec<(&str, bool)>, &str>> {
    let name = name.trim();
    let name = name.strip_prefix('{').and_then(|name| name.strip_suffix('}')).unwrap_or(name);
    name.contains('=').then(|| name.split(',').map(assignment).collect())
}

fn assignment(piece: &str) -> Result<(&str, bool), &str> {
    let (variable, value) = piece.split_once('=').ok_or(piece.trim())?;
    let value = match value.trim() {
        "0" => false,
        "1" => true,
        word if word.eq_ignore_ascii_case("FALSE") => false,
        word if word.eq_ignore_ascii_case("TRUE") => true,
        _ => return Err(piece.trim()),
    };
    Ok((variable.trim(), value))
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn names_are_valuations_or_not() {
        assert_eq!(parse("S1=1,O1=0"), Some(Ok(vec![("S1", true), ("O1", false)])));
        assert_eq!(parse(" { S1 = TRUE } "), Some(Ok(vec![("S1", true)])));
        assert_eq!(parse("moving"), None);
        assert_eq!(parse("S1=2"), Some(Err("S1=2")));
        assert_eq!(parse("S1=1,O1"), Some(Err("O1")));
    }
}

//! The nearest existing name, for "did you mean …?".

/// Maximum number of candidates compared.
const MAX_CANDIDATES: usize = 10_000;

/// Candidate closest to `written`, if it is close enough to be a typing error: at most one edit (insertion, deletion,
/// replacement, swap: the Damerau–Levenshtein distance) in three letters, and never all of them. Case does not count.
/// Of several that are as close, the first one that begins with the same letter is taken, else the first one.
pub fn nearest<'a>(written: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let written = written.to_lowercase();
    let letters = written.chars().count();
    let allowed = letters.div_ceil(3).min(letters.saturating_sub(1));
    let near = candidates.into_iter().take(MAX_CANDIDATES).filter_map(|name| {
        let candidate = name.to_lowercase();
        // The distance is at least the difference in length, which costs nothing.
        if candidate.chars().count().abs_diff(letters) > allowed {
            return None;
        }
        let distance = strsim::damerau_levenshtein(&written, &candidate);
        let begins_otherwise = candidate.chars().next() != written.chars().next();
        (distance <= allowed).then_some((distance, begins_otherwise, name))
    });
    near.min_by_key(|&(distance, begins_otherwise, _)| (distance, begins_otherwise)).map(|(_, _, name)| name)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn slips_are_mended_and_strangers_are_not() {
        let names = ["Output", "Step_0", "Step_1", "S1"];
        assert_eq!(nearest("Ouptut", names), Some("Output"));
        assert_eq!(nearest("step1", names), Some("Step_1"));
        assert_eq!(nearest("S3", names), Some("S1"));
        assert_eq!(nearest("Pressure", names), None);
        assert_eq!(nearest("ADN", ["LDN", "AND"]), Some("AND"));
    }
}

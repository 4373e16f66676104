//! The nearest of the names that exist, for "did you mean …?".

/// The candidate closest to `written`, if it is close enough to be a slip of the pen: at most one edit (insertion,
/// deletion, replacement, swap) in three letters, and never all of them. Case does not count.
pub fn nearest<'a>(written: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let written = written.to_lowercase();
    let letters = written.chars().count();
    let allowed = letters.div_ceil(3).min(letters.saturating_sub(1));
    candidates
        .into_iter()
        .map(|name| (strsim::damerau_levenshtein(&written, &name.to_lowercase()), name))
        .filter(|&(distance, _)| distance <= allowed)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, name)| name)
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
    }
}

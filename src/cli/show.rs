//! `--show`: selection of the variables shown in traces.

use glob::{MatchOptions, Pattern};
use petril::diagnostic::nearest;
use petril::flat::FlatProgram;
use petril::semantics::VarId;
use petril::witness::Columns;

use super::Failure;

/// Keyword for all variables.
const ALL: &str = "all";

/// Columns of the variables matching any pattern.
pub fn columns(program: &FlatProgram, patterns: &[String]) -> Columns {
    let patterns: Vec<Wanted> = words(patterns).map(Wanted::new).collect();
    Columns::chosen(program, &|id| patterns.iter().any(|pattern| pattern.names(program, id)))
}

/// Rejects patterns that match no variable of the program.
pub fn refuse_unknown(program: &FlatProgram, patterns: &[String]) -> Result<(), Failure> {
    let all: Vec<VarId> = Columns::chosen(program, &|_| true).iter().collect();
    let names_some = |word: &&str| all.iter().any(|&id| Wanted::new(word).names(program, id));
    let Some(unknown) = words(patterns).find(|word| !names_some(word)) else { return Ok(()) };
    let names: Vec<&str> = all.iter().map(|&id| program.variable(id).name.as_str()).collect();
    let help = nearest(unknown, names.iter().copied());
    let help = help.map_or_else(|| "`all` shows every variable".to_owned(), |name| format!("did you mean `{name}`?"));
    Err(Failure::Message(format!("--show: no variable of the program is called `{unknown}`\n  {help}")))
}

/// Items of comma-separated lists; commas within brackets belong to array indices.
fn words(patterns: &[String]) -> impl Iterator<Item = &str> {
    let split = |pattern| {
        let mut depth = 0_usize;
        str::split(pattern, move |c| {
            match c {
                '[' => depth += 1,
                ']' => depth = depth.saturating_sub(1),
                _ => {}
            }
            c == ',' && depth == 0
        })
    };
    patterns.iter().map(String::as_str).flat_map(split).map(str::trim).filter(|word| !word.is_empty())
}

/// Item of `--show`.
struct Wanted {
    is_all: bool,
    /// None if it is not a valid pattern.
    pattern: Option<Pattern>,
}

impl Wanted {
    /// A name, or a pattern with `*` and `?`; brackets are literal, for array indices.
    fn new(text: &str) -> Self {
        Self { is_all: text.eq_ignore_ascii_case(ALL), pattern: Pattern::new(&text.replace('[', "[[]")).ok() }
    }

    fn names(&self, program: &FlatProgram, id: VarId) -> bool {
        let options = MatchOptions { case_sensitive: false, ..MatchOptions::new() };
        let name = &program.variable(id).name;
        self.is_all || self.pattern.as_ref().is_some_and(|pattern| pattern.matches_with(name, options))
    }
}

#[cfg(test)]
mod tests {
    use super::words;

    #[test]
    fn commas_within_brackets_do_not_separate() {
        let given = ["a[1,2], Timer.*".to_owned(), "q".to_owned()];
        assert_eq!(words(&given).collect::<Vec<_>>(), ["a[1,2]", "Timer.*", "q"]);
    }
}

//! Provenance of a report: the tool, the command, and the hashes of everything read.

use serde_json::{Value, json};

use petril_base::printable::line;

/// Version of Petril.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Full commit of the build, with the suffix `-modified` if there were uncommitted changes; `None` if not known, and in
/// a debug build.
pub const COMMIT: Option<&str> = if env!("PETRIL_COMMIT").is_empty() { None } else { Some(env!("PETRIL_COMMIT")) };

/// Provenance data that the caller supplies. The library reads neither files nor command line.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Provenance {
    /// Words of the command line.
    pub command: Vec<String>,
    /// Files read, in the order of reading, with their SHA-256 in hexadecimal digits.
    pub inputs: Vec<(String, String)>,
    /// SHA-256 of all options as parsed, in hexadecimal digits.
    pub options: String,
}

impl Provenance {
    /// Name, version and commit of the program.
    #[must_use]
    pub fn tool() -> String {
        format!("petril {}", env!("PETRIL_VERSION"))
    }

    /// Command line quoted for a shell, on one line.
    #[must_use]
    pub fn command_line(&self) -> String {
        let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=:,+@%".contains(c);
        let quoted = |word: &String| match word.chars().all(is_plain) && !word.is_empty() {
            true => word.clone(),
            false => format!("'{}'", line(word).replace('\'', "'\\''")),
        };
        self.command.iter().map(quoted).collect::<Vec<_>>().join(" ")
    }

    /// Files read, each with its hash, on one line.
    #[must_use]
    pub fn files(&self) -> String {
        let inputs = self.inputs.iter().map(|(file, hash)| format!("{} {hash}", line(file)));
        inputs.collect::<Vec<_>>().join("; ")
    }

    /// Data as a JSON object.
    #[must_use]
    pub fn json(&self) -> Value {
        let input = |(file, hash): &(String, String)| json!({ "file": file, "sha256": hash });
        json!({
            "tool": "petril",
            "version": VERSION,
            "commit": COMMIT,
            "command": self.command,
            "inputs": self.inputs.iter().map(input).collect::<Vec<_>>(),
            "options": self.options,
        })
    }

    /// Data as pairs of a label and a line of text.
    #[must_use]
    pub fn pairs(&self) -> Vec<(&'static str, String)> {
        let inputs = self.inputs.iter().map(|(file, hash)| ("input", format!("{}, sha256 {hash}", line(file))));
        let made = [("made by", Self::tool()), ("command", self.command_line())];
        made.into_iter().chain(inputs).chain([("options", format!("sha256 {}", self.options))]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_can_be_given_again() {
        let words = ["petril", "check", "a b.il", "-r", "AG (it's)", "", "x\n"].map(str::to_owned).to_vec();
        let made = Provenance { command: words, ..Provenance::default() };
        assert_eq!(made.command_line(), "petril check 'a b.il' -r 'AG (it'\\''s)' '' 'x\\n'");
    }
}

//! Files and patterns used by a check, for `--watch` and provenance.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use sha2::{Digest as _, Sha256};

/// Files read and glob patterns expanded.
#[derive(Debug, Default)]
pub struct Seen {
    /// Files with their SHA-256; `None` if unreadable.
    files: Vec<(PathBuf, Option<String>)>,
    /// Glob patterns with the files they matched.
    patterns: Vec<(String, Vec<PathBuf>)>,
}

impl Seen {
    /// Records a file, with `None` if it was unreadable.
    pub fn file(&mut self, path: &Path, bytes: Option<&[u8]>) {
        self.files.push((path.to_owned(), bytes.map(sha256)));
    }

    /// Readable files, each once, with their SHA-256.
    pub fn inputs(&self) -> Vec<(String, String)> {
        let mut known = BTreeSet::new();
        let read = self.files.iter().filter_map(|(path, hash)| Some((path, hash.as_ref()?)));
        let read = read.filter(|(path, _)| known.insert(*path));
        read.map(|(path, hash)| (path.display().to_string(), hash.clone())).collect()
    }

    /// Records a glob pattern and its matches.
    pub fn pattern(&mut self, pattern: &str, files: &[PathBuf]) {
        self.patterns.push((pattern.to_owned(), files.to_owned()));
    }

    /// Adds the records of another check.
    pub fn extend(&mut self, other: Self) {
        self.files.extend(other.files);
        self.patterns.extend(other.patterns);
    }

    /// Count of distinct files, without standard input.
    pub fn count(&self) -> usize {
        self.files.iter().map(|(path, _)| path).filter(|path| !is_standard_input(path)).collect::<BTreeSet<_>>().len()
    }

    /// Whether a file or the matches of a pattern changed since.
    pub fn is_other_now(&self) -> bool {
        let file = |(path, then): &(PathBuf, Option<String>)| {
            !is_standard_input(path) && fs::read(path).ok().map(|bytes| sha256(&bytes)) != *then
        };
        self.files.iter().any(file) || self.patterns.iter().any(|(pattern, then)| matching(pattern) != *then)
    }

    /// Parent directories of the files. Editors may replace a file instead of writing it, so directories are watched.
    pub fn folders(&self) -> BTreeSet<PathBuf> {
        let folder = |(file, _): &(PathBuf, _)| {
            let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
            folder.map_or_else(|| PathBuf::from("."), Path::to_owned)
        };
        self.files.iter().map(folder).collect()
    }
}

/// SHA-256 in lowercase hexadecimal, as printed by `sha256sum`.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Whether a path means standard input, which can be read only once.
fn is_standard_input(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Files matching a glob pattern, in alphabetical order; none if the pattern is invalid.
pub fn matching(pattern: &str) -> Vec<PathBuf> {
    let paths = glob::glob(pattern).into_iter().flatten();
    paths.filter_map(Result::ok).filter(|path| path.is_file()).collect()
}

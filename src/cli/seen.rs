//! What a check has seen of the file system, for whoever waits for something to change.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use sha2::{Digest as _, Sha256};

/// Files that were read and patterns that were followed.
#[derive(Debug, Default)]
pub struct Seen {
    /// Each file, with what was in it; nothing if it could not be read.
    files: Vec<(PathBuf, Option<String>)>,
    /// Each pattern, with the files it matched.
    patterns: Vec<(String, Vec<PathBuf>)>,
}

impl Seen {
    /// A file was read, or could not be.
    pub fn file(&mut self, path: &Path, bytes: Option<&[u8]>) {
        self.files.push((path.to_owned(), bytes.map(sha256)));
    }

    /// The files that were read, each once, with their SHA-256.
    pub fn inputs(&self) -> Vec<(String, String)> {
        let mut known = BTreeSet::new();
        let read = self.files.iter().filter_map(|(path, hash)| Some((path, hash.as_ref()?)));
        let read = read.filter(|(path, _)| known.insert(*path));
        read.map(|(path, hash)| (path.display().to_string(), hash.clone())).collect()
    }

    /// A pattern matched these files.
    pub fn pattern(&mut self, pattern: &str, files: &[PathBuf]) {
        self.patterns.push((pattern.to_owned(), files.to_owned()));
    }

    /// What another one has seen.
    pub fn extend(&mut self, other: Self) {
        self.files.extend(other.files);
        self.patterns.extend(other.patterns);
    }

    /// How many files were read.
    pub fn count(&self) -> usize {
        self.files.iter().map(|(path, _)| path).filter(|path| !is_standard_input(path)).collect::<BTreeSet<_>>().len()
    }

    /// Whether a file or what a pattern matches is not what it was.
    pub fn is_other_now(&self) -> bool {
        let file = |(path, then): &(PathBuf, Option<String>)| {
            !is_standard_input(path) && fs::read(path).ok().map(|bytes| sha256(&bytes)) != *then
        };
        self.files.iter().any(file) || self.patterns.iter().any(|(pattern, then)| matching(pattern) != *then)
    }

    /// The folders of files: an editor may put a new file in the place of an old one.
    pub fn folders(&self) -> BTreeSet<PathBuf> {
        let folder = |(file, _): &(PathBuf, _)| {
            let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
            folder.map_or_else(|| PathBuf::from("."), Path::to_owned)
        };
        self.files.iter().map(folder).collect()
    }
}

/// A hash in hexadecimal digits, as `sha256sum` prints it.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Whether a path stands for standard input, which is read once.
fn is_standard_input(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// The files that a pattern matches, in the order of their names; none if it is no pattern.
pub fn matching(pattern: &str) -> Vec<PathBuf> {
    let paths = glob::glob(pattern).into_iter().flatten();
    paths.filter_map(Result::ok).filter(|path| path.is_file()).collect()
}

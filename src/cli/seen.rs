//! What a check has seen of the file system, for whoever waits for something to change.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use blake3::Hash;

/// Files that were read and patterns that were followed.
#[derive(Debug, Default)]
pub struct Seen {
    /// Each file, with what was in it; nothing if it could not be read.
    files: Vec<(PathBuf, Option<Hash>)>,
    /// Each pattern, with the files it matched.
    patterns: Vec<(String, Vec<PathBuf>)>,
}

impl Seen {
    /// A file was read, or could not be.
    pub fn file(&mut self, path: &Path, bytes: Option<&[u8]>) {
        self.files.push((path.to_owned(), bytes.map(blake3::hash)));
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
        self.files.iter().map(|(path, _)| path).collect::<BTreeSet<_>>().len()
    }

    /// Whether a file or what a pattern matches is not what it was.
    pub fn is_other_now(&self) -> bool {
        let file =
            |(path, then): &(PathBuf, Option<Hash>)| fs::read(path).ok().map(|bytes| blake3::hash(&bytes)) != *then;
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

/// The files that a pattern matches, in the order of their names; none if it is no pattern.
pub fn matching(pattern: &str) -> Vec<PathBuf> {
    let paths = glob::glob(pattern).into_iter().flatten();
    paths.filter_map(Result::ok).filter(|path| path.is_file()).collect()
}

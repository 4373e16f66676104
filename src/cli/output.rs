//! Output files: written completely or not at all, and never over an input.

use std::collections::BTreeSet;
use std::fs::{self, File, Metadata};
use std::io::{self, BufWriter, Error, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

use super::{Failure, guard, reason, shown};

/// Writer of a file's content, piece by piece: it may be too large to hold in memory.
type Content<'c> = &'c dyn Fn(&mut dyn Write) -> io::Result<()>;

/// Inputs read.
static READ: Mutex<BTreeSet<Identity>> = Mutex::new(BTreeSet::new());

/// Temporary files not yet renamed.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Identity of a file, by whatever path or link it is reached.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Identity {
    /// Device and inode number of an existing file.
    #[cfg(unix)]
    Node(u64, u64),
    /// Path without links of a file that does not exist yet; path as typed of anything but a file.
    Path(PathBuf),
}

impl Identity {
    fn of(path: &Path) -> Self {
        match fs::metadata(path) {
            Ok(known) if known.is_file() => Self::of_file(path, &known),
            Ok(_) => Self::Path(path.to_owned()),
            Err(_) => {
                let path = target(path);
                let folder = fs::canonicalize(folder(&path)).ok();
                Self::Path(
                    folder.zip(path.file_name()).map_or_else(|| path.clone(), |(folder, name)| folder.join(name)),
                )
            }
        }
    }

    #[cfg(unix)]
    fn of_file(_: &Path, known: &Metadata) -> Self {
        use std::os::unix::fs::MetadataExt;
        Self::Node(known.dev(), known.ino())
    }

    #[cfg(not(unix))]
    fn of_file(path: &Path, _: &Metadata) -> Self {
        Self::Path(fs::canonicalize(path).unwrap_or_else(|_| path.to_owned()))
    }
}

/// Records an input, so that no output overwrites it. `-` is standard input, which may be a file.
pub fn has_read(path: &Path) {
    let path = if path == Path::new("-") { Path::new("/dev/stdin") } else { path };
    if path.is_file() {
        lock(&READ).insert(Identity::of(path));
    }
}

/// Rejects outputs that are the same file, or an input.
pub fn refuse<'p>(outputs: impl IntoIterator<Item = &'p PathBuf>) -> Result<(), Failure> {
    let mut seen = BTreeSet::new();
    for path in outputs {
        refuse_input(path)?;
        if !seen.insert(Identity::of(path)) {
            let message = format!("`{}` cannot be two things: give each form a file of its own", shown(path));
            return Err(Failure::Message(message));
        }
    }
    Ok(())
}

fn refuse_input(path: &Path) -> Result<(), Failure> {
    if lock(&READ).contains(&Identity::of(path)) {
        let message = format!("`{}` is an input, and is not overwritten: name another file to write", shown(path));
        return Err(Failure::Message(message));
    }
    Ok(())
}

/// Writes a file: to a temporary file beside it first, which is then renamed, so that no partial file appears. A
/// replaced file keeps its mode. A device or a pipe is written to, a link is followed.
pub fn write(path: &Path, content: Content<'_>) -> Result<(), Failure> {
    refuse_input(path)?;
    let cannot = |error: Error| Failure::Message(format!("cannot write `{}`: {}", shown(path), reason(&error)));
    match fs::metadata(path) {
        Ok(known) if known.is_dir() => Err(cannot(ErrorKind::IsADirectory.into())),
        Ok(known) if known.is_file() => {
            fs::canonicalize(path).and_then(|path| replace(&path, Some(&known), content)).map_err(cannot)
        }
        // The reader may take any time.
        Ok(_) => guard::pause(|| File::create(path).and_then(|file| buffered(file, content).map(drop))).map_err(cannot),
        Err(_) => replace(&target(path), None, content).map_err(cannot),
    }
}

/// As [`write`], for a text in memory.
pub fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    write(path, &|out| out.write_all(text.as_bytes()))
}

/// Removes unfinished files, before the process ends in the middle of its work.
pub fn discard_unfinished() {
    for path in &*lock(&UNFINISHED) {
        let _ = fs::remove_file(path);
    }
}

fn replace(path: &Path, known: Option<&Metadata>, content: Content<'_>) -> io::Result<()> {
    if known.is_some_and(|known| known.permissions().readonly()) {
        return Err(ErrorKind::PermissionDenied.into());
    }
    let file = temporary(folder(path))?;
    let unfinished = Unfinished::new(file.path());
    let file = buffered(file, content)?;
    if let Some(known) = known {
        file.as_file().set_permissions(known.permissions())?;
    }
    file.persist(path)?;
    drop(unfinished);
    Ok(())
}

/// Temporary file registered for removal.
struct Unfinished(PathBuf);

impl Unfinished {
    fn new(path: &Path) -> Self {
        lock(&UNFINISHED).insert(path.to_owned());
        Self(path.to_owned())
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        lock(&UNFINISHED).remove(&self.0);
    }
}

/// Folder of a file.
fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Target of a link to a file that does not exist.
fn target(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    // Links may be cyclic; the system also follows 40 at most.
    for _ in 0..40 {
        let Ok(next) = fs::read_link(&path) else { break };
        path = folder(&path).join(next);
    }
    path
}

/// Writes through a buffer and flushes it: an error in the last bytes would be lost when the buffer is dropped.
fn buffered<W: Write>(file: W, content: Content<'_>) -> io::Result<W> {
    let mut out = BufWriter::with_capacity(1 << 16, file);
    content(&mut out)?;
    out.into_inner().map_err(io::IntoInnerError::into_error)
}

/// Creates a temporary file with the usual permissions of new files.
#[cfg(unix)]
fn temporary(folder: &Path) -> io::Result<NamedTempFile> {
    use std::os::unix::fs::PermissionsExt;
    tempfile::Builder::new().permissions(fs::Permissions::from_mode(0o666)).tempfile_in(folder)
}

#[cfg(not(unix))]
fn temporary(folder: &Path) -> io::Result<NamedTempFile> {
    NamedTempFile::new_in(folder)
}

fn lock<T>(of: &Mutex<T>) -> MutexGuard<'_, T> {
    of.lock().unwrap_or_else(PoisonError::into_inner)
}

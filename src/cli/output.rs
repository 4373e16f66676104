//! Files out: whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, Error, ErrorKind, Write};
use std::path::Path;

use tempfile::NamedTempFile;

use super::{Failure, reason, shown};

/// What writes a file, piece by piece: it may be larger than is good to hold in memory.
type Content<'c> = &'c dyn Fn(&mut dyn Write) -> io::Result<()>;

/// Writes a file: to a temporary beside it first, which then takes its name. So there is never half a file. A device or a
/// pipe is not replaced but written to, a link is followed.
pub fn write(path: &Path, content: Content<'_>) -> Result<(), Failure> {
    let cannot = |error: Error| Failure::Message(format!("cannot write `{}`: {}", shown(path), reason(&error)));
    match fs::metadata(path) {
        Ok(known) if known.is_dir() => Err(cannot(ErrorKind::IsADirectory.into())),
        Ok(known) if known.is_file() => fs::canonicalize(path).and_then(|path| replace(&path, content)).map_err(cannot),
        Ok(_) => File::create(path).and_then(|file| buffered(file, content).map(drop)).map_err(cannot),
        Err(_) => replace(path, content).map_err(cannot),
    }
}

/// As [`write`], what is in memory already.
pub fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    write(path, &|out| out.write_all(text.as_bytes()))
}

fn replace(path: &Path, content: Content<'_>) -> io::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let file = buffered(NamedTempFile::new_in(folder)?, content)?;
    share(&file)?;
    file.persist(path)?;
    Ok(())
}

/// The last bytes are written here: what goes wrong with them would be lost when the buffer is dropped.
fn buffered<W: Write>(file: W, content: Content<'_>) -> io::Result<W> {
    let mut out = BufWriter::with_capacity(1 << 16, file);
    content(&mut out)?;
    out.into_inner().map_err(io::IntoInnerError::into_error)
}

/// A temporary is private; the file it becomes should be as readable as any other.
#[cfg(unix)]
fn share(file: &NamedTempFile) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.as_file().set_permissions(fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn share(_: &NamedTempFile) -> io::Result<()> {
    Ok(())
}

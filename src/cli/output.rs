//! Files out: whole or not at all.

use std::fs;
use std::io::{Error, ErrorKind, Write};
use std::path::Path;

use tempfile::NamedTempFile;

use super::{Failure, reason};

/// Writes a file: to a temporary beside it first, which then takes its name. So there is never half a file. A device or a
/// pipe is not replaced but written to, a link is followed.
pub fn write(path: &Path, text: &str) -> Result<(), Failure> {
    let cannot = |error: Error| Failure::Message(format!("cannot write `{}`: {}", path.display(), reason(&error)));
    match fs::metadata(path) {
        Ok(known) if known.is_dir() => Err(cannot(ErrorKind::IsADirectory.into())),
        Ok(known) if known.is_file() => fs::canonicalize(path).and_then(|path| replace(&path, text)).map_err(cannot),
        Ok(_) => fs::write(path, text).map_err(cannot),
        Err(_) => replace(path, text).map_err(cannot),
    }
}

fn replace(path: &Path, text: &str) -> Result<(), Error> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = NamedTempFile::new_in(folder)?;
    file.write_all(text.as_bytes())?;
    share(&file)?;
    file.persist(path)?;
    Ok(())
}

/// A temporary is private; the file it becomes should be as readable as any other.
#[cfg(unix)]
fn share(file: &NamedTempFile) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.as_file().set_permissions(fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn share(_: &NamedTempFile) -> std::io::Result<()> {
    Ok(())
}

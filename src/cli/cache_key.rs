//! Key that signs the cache: from `PETRIL_CACHE_KEY`, or from a file of the user's own.
//!
//! A verdict `holds` cannot be replayed, so it is accepted only if signed with the user's key. The key file is never
//! inside the cache folder or the project: whoever copies those must not get the key with them.

use std::env;
use std::fs;
use std::io::{self, ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::{reason, shown};

/// Context string of the derived key (BLAKE3, mode `derive_key`).
const PURPOSE: &str = "petril 2026 what is known from earlier runs";

/// Lower bound on the length of a secret; shorter ones can be guessed.
const SHORTEST: usize = 16;

/// Key for BLAKE3's keyed mode.
#[derive(Clone, Debug)]
pub struct Key([u8; 32]);

impl Key {
    /// Finds the key, which must lie outside these folders; the error says why there is none.
    pub fn find(outside: &[&Path]) -> Result<Self, String> {
        if let Some(secret) = env::var_os("PETRIL_CACHE_KEY").filter(|secret| !secret.is_empty()) {
            let secret = secret.into_encoded_bytes();
            if secret.len() < SHORTEST {
                return Err(format!("PETRIL_CACHE_KEY is too short: {SHORTEST} characters at least"));
            }
            return Ok(Self::derived(&secret));
        }
        let folder = state_folder().ok_or("there is no home folder to keep a key in")?;
        let cannot = |error: io::Error| format!("the key in `{}` cannot be used: {}", shown(&folder), reason(&error));
        private_folder(&folder).map_err(cannot)?;
        let place = fs::canonicalize(&folder).map_err(cannot)?;
        if outside.iter().filter_map(|other| fs::canonicalize(other).ok()).any(|other| place.starts_with(other)) {
            return Err(format!("the place of the key, `{}`, is inside what it signs", shown(&folder)));
        }
        own(&folder.join("cache-key")).map(|secret| Self::derived(&secret)).map_err(cannot)
    }

    fn derived(secret: &[u8]) -> Self {
        Self(blake3::derive_key(PURPOSE, secret))
    }

    /// Message authentication code of a text.
    pub fn sign(&self, text: &str) -> blake3::Hash {
        blake3::keyed_hash(&self.0, text.as_bytes())
    }
}

/// Folder for state that programs keep between runs.
fn state_folder() -> Option<PathBuf> {
    let folder = |name: &str| env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let base = if cfg!(windows) {
        folder("LOCALAPPDATA")
    } else {
        folder("XDG_STATE_HOME").or_else(|| Some(folder("HOME")?.join(".local/state")))
    };
    Some(base?.join("petril"))
}

fn private_folder(folder: &Path) -> io::Result<()> {
    let mut builder = fs::DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(folder)
}

/// Secret in a file that nobody else can read; created if the file does not exist.
fn own(path: &Path) -> io::Result<Vec<u8>> {
    match read(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => make(path).and_then(|()| read(path)),
        read => read,
    }
}

fn read(path: &Path) -> io::Result<Vec<u8>> {
    let about = fs::symlink_metadata(path)?;
    #[cfg(unix)]
    let is_shared = std::os::unix::fs::PermissionsExt::mode(&about.permissions()) & 0o077 != 0;
    #[cfg(not(unix))]
    let is_shared = false;
    if !about.is_file() || is_shared {
        return Err(io::Error::other("it is not a file that its owner alone can read"));
    }
    let secret = fs::read(path)?;
    if secret.len() < SHORTEST { Err(io::Error::other("it is too short")) } else { Ok(secret) }
}

/// Writes a random secret. If another process is faster, its secret stays.
fn make(path: &Path) -> io::Result<()> {
    let mut secret = [0; 32];
    getrandom::fill(&mut secret).map_err(io::Error::other)?;
    // Temporary files are readable by their owner only.
    let mut file = NamedTempFile::new_in(path.parent().unwrap_or(Path::new("")))?;
    writeln!(file, "{}", blake3::Hash::from_bytes(secret).to_hex())?;
    match file.persist_noclobber(path) {
        Err(error) if error.error.kind() != ErrorKind::AlreadyExists => Err(error.error),
        _ => Ok(()),
    }
}

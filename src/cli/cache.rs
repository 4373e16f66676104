//! Cache of outcomes from earlier checks, in files: one for each system under given options.
//!
//! A file is accepted only if it was written by this very program, about this very system, with the same key; any other
//! file is ignored. A file that cannot be written is not an error: more is computed the next time.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock};
use std::time::{Duration, SystemTime};

use petril::verdict::Known;

use super::cache_key::Key;
use super::console::Console;
use super::output;

/// Default name of the cache folder, beside the project file.
const NAME: &str = ".petril-cache";

/// Upper bound in bytes on a cache file; larger results are not kept.
const MOST: u64 = 64 << 20;

/// Time after which an unused file is removed.
const PATIENCE: Duration = Duration::from_secs(30 * 24 * 60 * 60);

/// Cache in a folder.
#[derive(Debug)]
pub struct Cache {
    folder: PathBuf,
    /// Files read so far. Results of this run are kept for the next one only: otherwise the output would depend on the
    /// order in which equal programs are checked.
    read: Mutex<BTreeMap<PathBuf, Option<String>>>,
    /// Hash of this program: another version may come to other results.
    petril: &'static str,
    key: Key,
}

impl Cache {
    /// Opens the folder named by `PETRIL_CACHE`, or else the one beside a project file. Without a key there is no
    /// cache.
    pub fn open(project: Option<&Path>, console: &Console) -> Option<Self> {
        let named = std::env::var_os("PETRIL_CACHE").filter(|name| !name.is_empty()).map(PathBuf::from);
        let home = project.map(|project| project.parent().filter(|path| !path.as_os_str().is_empty()));
        let home = home.map(|home| home.unwrap_or(Path::new(".")));
        let folder = named.or_else(|| home.map(|home| home.join(NAME)))?;
        let outside: Vec<&Path> = home.into_iter().chain([folder.as_path()]).collect();
        match Key::find(&outside) {
            Ok(key) => Some(Self { folder, read: Mutex::default(), petril: this_program()?, key }),
            Err(reason) => {
                console.message(&format!("note: everything is computed, and nothing is kept: {reason}\n"));
                None
            }
        }
    }

    /// Looks up the outcomes for a system.
    pub fn recall(&self, fingerprint: &str) -> Option<Known> {
        let path = self.path(fingerprint);
        let text = self.read.lock().ok()?.entry(path.clone()).or_insert_with(|| text(&path)).clone()?;
        let (head, body) = text.split_once('\n')?;
        let (about, code) = head.rsplit_once(' ')?;
        let signed = self.key.sign(&format!("{about}\n{body}"));
        // Hashes are compared in constant time.
        let is_own = about == self.about(fingerprint) && blake3::Hash::from_hex(code).is_ok_and(|code| code == signed);
        let known = is_own.then(|| serde_json::from_str(body).ok())??;
        // The time of last use is updated.
        let _ = File::open(&path).and_then(|file| file.set_modified(SystemTime::now()));
        Some(known)
    }

    /// Stores the outcomes for a system.
    pub fn keep(&self, fingerprint: &str, known: &Known) {
        let Ok(body) = serde_json::to_string(known) else { return };
        if body.len() as u64 <= MOST && self.prepare().is_ok() {
            let text = format!("{}\n{body}", self.head(fingerprint, &body));
            let _ = output::write_text(&self.path(fingerprint), &text);
        }
    }

    fn path(&self, fingerprint: &str) -> PathBuf {
        let name = blake3::hash(format!("{} {fingerprint}", self.petril).as_bytes());
        self.folder.join(&name.to_hex()[..32])
    }

    /// First line of a file: signs the body together with what it is about, so that no file can stand for another.
    fn head(&self, fingerprint: &str, body: &str) -> String {
        let about = self.about(fingerprint);
        let code = self.key.sign(&format!("{about}\n{body}"));
        format!("{about} {code}")
    }

    fn about(&self, fingerprint: &str) -> String {
        format!("petril {} {fingerprint}", self.petril)
    }

    /// Creates the folder if necessary, and removes old files.
    fn prepare(&self) -> io::Result<()> {
        static PREPARED: OnceLock<()> = OnceLock::new();
        fs::create_dir_all(&self.folder)?;
        if PREPARED.set(()).is_ok() {
            // The cache does not belong under version control.
            let _ = output::write_text(&self.folder.join(".gitignore"), "*\n");
            for entry in fs::read_dir(&self.folder)?.filter_map(Result::ok) {
                let is_ours = entry.file_name().to_str().is_some_and(|name| name.len() == 32);
                let age = entry.metadata().and_then(|about| about.modified()).map(|then| then.elapsed());
                if is_ours && matches!(age, Ok(Ok(age)) if age > PATIENCE) {
                    let _ = fs::remove_file(entry.path());
                }
            }
        }
        Ok(())
    }
}

/// Text of a file that is not too large.
fn text(path: &Path) -> Option<String> {
    (fs::metadata(path).ok()?.len() <= MOST).then(|| fs::read_to_string(path).ok())?
}

/// Hash of this program's own executable.
fn this_program() -> Option<&'static str> {
    static HASH: OnceLock<Option<String>> = OnceLock::new();
    let hash = || {
        let mut hasher = blake3::Hasher::new();
        hasher.update_reader(File::open(std::env::current_exe().ok()?).ok()?).ok()?;
        Some(hasher.finalize().to_string())
    };
    HASH.get_or_init(hash).as_deref()
}

//! Writers of bytes as writers of text.

use std::io;

/// The text that a writer writes.
#[must_use]
pub fn to_text(write: impl FnOnce(&mut Vec<u8>) -> io::Result<()>) -> String {
    let mut bytes = Vec::new();
    write(&mut bytes).expect("memory takes everything that is written to it");
    String::from_utf8_lossy(&bytes).into_owned()
}

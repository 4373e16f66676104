//! Names that ignore case.

/// A name as IEC 61131-3 compares it: upper case and lower case are equal (2.1.2).
#[must_use]
pub fn key(name: &str) -> String {
    name.to_ascii_uppercase()
}

//! The figures of safety functions in docs/performance.md: `cargo bench --bench sif`. `cargo bench --bench sif -- write FOLDER` writes
//! the generated system: `site.sif`, and `site.il` that computes it.
#![allow(clippy::unwrap_used, reason = "figures that cannot be made are of no use")]

#[path = "../tests/support/sif_system.rs"]
mod sif_system;

use std::fs;
use std::path::Path;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if !arguments.iter().any(|argument| argument == "--bench") {
        return;
    }
    if let Some(folder) = arguments.iter().skip_while(|argument| *argument != "write").nth(1) {
        write_site(Path::new(folder));
    }
}

/// The generated system of 350 inputs, 19 zones and 200 functions.
fn write_site(folder: &Path) {
    let made = sif_system::made(sif_system::LARGE, 1);
    fs::write(folder.join("site.sif"), made.specification).unwrap();
    fs::write(folder.join("site.il"), made.program).unwrap();
}

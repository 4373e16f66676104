//! The figures of safety functions in docs/performance.md: `cargo bench --bench sif`. `cargo bench --bench sif -- write FOLDER` writes
//! the generated system: `site.sif`, and `site.il` that computes it.
#![allow(clippy::unwrap_used, reason = "figures that cannot be made are of no use")]

#[path = "../tests/support/sif_system.rs"]
mod sif_system;

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// Runs of each measurement, of which the shortest counts.
const RUNS: usize = 3;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if !arguments.iter().any(|argument| argument == "--bench") {
        return;
    }
    if let Some(folder) = arguments.iter().skip_while(|argument| *argument != "write").nth(1) {
        write_site(Path::new(folder));
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    write_site(folder.path());
    let petril = |words: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_petril"));
        let begin = Instant::now();
        let output = command.arg("sif").args(words.split(' ')).current_dir(folder.path()).output().unwrap();
        (begin.elapsed(), String::from_utf8(output.stdout).unwrap())
    };
    println!("| command | seconds |\n|---|--:|");
    let commands = [
        "check site.sif",
        "tests site.sif --criterion all --csv all.csv",
        "tests site.sif --criterion mcdc --csv mcdc.csv",
        "tests site.sif --criterion faults --csv faults.csv",
        "tests site.sif --criterion pairs --csv pairs.csv",
        "tests site.sif --criterion faults --html faults.html",
        "run site.sif site.il",
        "prove site.sif site.il",
        "prove site.sif wrong.il",
    ];
    for words in commands {
        let time = (0..RUNS).map(|_| petril(words).0).min().unwrap();
        println!("| `{words}` | {:.2} |", time.as_secs_f64());
    }
    println!("\n{}", petril("tests site.sif --compare").1);
}

/// The generated system of 350 inputs, 19 zones and 200 functions, and a program with one wrong line.
fn write_site(folder: &Path) {
    let made = sif_system::made(sif_system::LARGE, 1);
    fs::write(folder.join("site.sif"), made.specification).unwrap();
    let wrong = made.program.replacen("        OR(", "        AND(", 1);
    fs::write(folder.join("wrong.il"), wrong).unwrap();
    fs::write(folder.join("site.il"), made.program).unwrap();
}

//! The copy of the repository, with all faults that compile.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use crate::find::{self, Found};
use crate::splice::{Spliced, splice};

/// Flags of all builds of the copy: lints are not about code that nobody reads.
pub const LINTS: &str = "--cap-lints=allow";

/// Folder of the repository: the one that holds this project.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Writes what is not there yet, so that nothing else is compiled anew.
pub fn write(path: &Path, bytes: &[u8]) {
    if fs::read(path).is_ok_and(|old| old == bytes) {
        return;
    }
    fs::create_dir_all(path.parent().expect("a file stands in a folder")).expect("a folder can be made");
    fs::write(path, bytes).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
}

fn files() -> Vec<String> {
    let output = Command::new("git").arg("-C").arg(root()).args(["ls-files", "-co", "--exclude-standard"]).output();
    let text = String::from_utf8(output.expect("git lists files").stdout).expect("names are UTF-8");
    let exists = |name: &&str| root().join(name).is_file();
    text.lines().filter(exists).filter(|name| !name.starts_with("mutants/")).map(str::to_owned).collect()
}

pub fn plant(copy: &Path, wanted: &[String]) {
    let mut found: Vec<Found> = Vec::new();
    let mut sources = BTreeMap::new();
    for name in files() {
        let bytes = fs::read(root().join(&name)).expect("a file can be read");
        let is_chosen =
            |wanted: &String| name == *wanted || name.starts_with(&format!("{}/", wanted.trim_end_matches('/')));
        let is_tests = name.ends_with("/tests.rs") || name.contains("/tests/");
        let is_source = ["src/", "crates/"].iter().any(|folder| name.starts_with(folder)) && name.ends_with(".rs");
        if is_source && !is_tests && wanted.iter().any(is_chosen) {
            let source = String::from_utf8(bytes).expect("sources are UTF-8");
            found.extend(find::faults(&name, &source));
            sources.insert(name, source);
        } else if name == "crates/base/src/lib.rs" {
            // All other crates stand on this one.
            let text = String::from_utf8(bytes).expect("sources are UTF-8");
            write(&copy.join(name), format!("{text}\n#[doc(hidden)]\npub mod mutant;\n").as_bytes());
        } else {
            write(&copy.join(name), &bytes);
        }
    }
    for (number, found) in (1..).zip(&mut found) {
        found.fault.number = number;
    }
    let switch = format!("{}\nconst COUNT: usize = {};\n", include_str!("switch.in"), found.len() + 1);
    write(&copy.join("crates/base/src/mutant.rs"), switch.as_bytes());
    let faults: Vec<_> = found.iter().map(|found| &found.fault).collect();
    let faults = serde_json::to_vec(&faults).expect("faults are plain data");
    let is_known = fs::read(copy.join("faults.json")).is_ok_and(|old| old == faults);
    write(&copy.join("faults.json"), &faults);

    let known = fs::read(copy.join("unviable.json")).ok().filter(|_| is_known);
    let mut unviable: BTreeSet<u32> =
        known.map_or_else(BTreeSet::new, |bytes| serde_json::from_slice(&bytes).expect("a list of numbers"));
    loop {
        let spliced: BTreeMap<_, _> = sources
            .iter()
            .map(|(name, source)| {
                let here = |found: &&Found| found.fault.file == *name && !unviable.contains(&found.fault.number);
                let spliced = splice(source, &found.iter().filter(here).collect::<Vec<_>>());
                write(&copy.join(name), spliced.text.as_bytes());
                (name.as_str(), spliced)
            })
            .collect();
        let blamed = compile(copy, &spliced);
        println!("{} faults, {} unviable, {} more", found.len(), unviable.len(), blamed.len());
        if blamed.is_empty() {
            break;
        }
        unviable.extend(blamed);
        write(&copy.join("unviable.json"), &serde_json::to_vec(&unviable).expect("numbers are plain data"));
    }
}

/// The faults that the compiler objects to.
fn compile(copy: &Path, spliced: &BTreeMap<&str, Spliced>) -> BTreeSet<u32> {
    let mut command = Command::new("cargo");
    // With a test, so that dependencies have the features that tests are built with.
    command
        .args(["build", "--offline", "--workspace", "--lib", "--test", "layers", "--message-format=json", "--quiet"])
        .env("RUSTFLAGS", LINTS)
        .current_dir(copy);
    let output = command.output().expect("cargo runs");
    let mut blamed = BTreeSet::new();
    let mut unknown = Vec::new();
    for line in String::from_utf8_lossy(&output.stdout).lines() {
        let Ok(value) = serde_json::from_str::<Value>(line) else { continue };
        let message = &value["message"];
        if message["level"] != "error" {
            continue;
        }
        let children = message["children"].as_array().into_iter().flatten();
        let spans = [message].into_iter().chain(children).filter_map(|part| part["spans"].as_array()).flatten();
        let place = |span: &&Value| {
            let byte = |key: &str| span[key].as_u64().and_then(|byte| usize::try_from(byte).ok()).unwrap_or(0);
            let spliced = spliced.get(span["file_name"].as_str().unwrap_or_default());
            spliced.map(|spliced| (spliced, byte("byte_start")..byte("byte_end")))
        };
        let (primary, others): (Vec<&Value>, Vec<_>) = spans.partition(|span| span["is_primary"] == true);
        let at: Vec<_> = primary.iter().chain(&others).filter_map(place).collect();
        let exact = at.iter().map(|(spliced, at)| spliced.blamed(at)).find(|blamed| !blamed.is_empty());
        let near = || {
            let wider = [0, 8, 32].into_iter().flat_map(|lines| at.iter().map(move |place| (place, lines)));
            wider.map(|((spliced, at), lines)| spliced.near(at, lines)).find(|blamed| !blamed.is_empty())
        };
        match exact.or_else(near) {
            Some(numbers) => blamed.extend(numbers),
            None => unknown.push(message["rendered"].as_str().unwrap_or_default().to_owned()),
        }
    }
    assert!(
        output.status.success() || !blamed.is_empty(),
        "{}{}",
        unknown.join("\n"),
        String::from_utf8_lossy(&output.stderr)
    );
    blamed
}

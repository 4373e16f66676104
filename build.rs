//! Names the commit that the program is built from, for `--version` and reports; nothing if it is not known, and in debug builds.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Files and folders the program is made of. Uncommitted changes of these are named.
const MADE_OF: [&str; 7] = ["src", "crates", "grammar", "docs/codes", "Cargo.toml", "Cargo.lock", "build.rs"];

fn main() {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    println!("cargo:rerun-if-changed={}", root.join("build.rs").display());
    let version = env::var("CARGO_PKG_VERSION").unwrap_or_default();
    // To look for changes would build everything anew with every commit.
    let is_release = env::var("PROFILE").is_ok_and(|profile| profile == "release");
    let commit = if is_release { of_repository(&root).or_else(|| of_package(&root)) } else { None };
    let named = match &commit {
        Some(commit) => format!("{version} ({commit})"),
        None if is_release => version,
        None => format!("{version} (debug build)"),
    };
    let commit = commit.unwrap_or_default();
    println!("cargo:rustc-env=PETRIL_COMMIT={commit}");
    println!("cargo:rustc-env=PETRIL_VERSION={named}");
}

/// The commit of the repository that this folder is the root of. Behind it stands `-modified` if something is not committed.
fn of_repository(root: &Path) -> Option<String> {
    let top = fs::canonicalize(git(root, &["rev-parse", "--show-toplevel"])?).ok()?;
    if top != fs::canonicalize(root).ok()? {
        return None;
    }
    let branch = git(root, &["symbolic-ref", "-q", "HEAD"]);
    for name in ["HEAD", "logs/HEAD", "packed-refs"].into_iter().map(str::to_owned).chain(branch) {
        let path = git(root, &["rev-parse", "--git-path", &name]).map(|path| root.join(path));
        if let Some(path) = path.filter(|path| path.exists()) {
            println!("cargo:rerun-if-changed={}", path.display());
        }
    }
    let commit = git(root, &["rev-parse", "HEAD"])?;
    for path in MADE_OF.iter().map(|name| root.join(name)).filter(|path| path.exists()) {
        println!("cargo:rerun-if-changed={}", path.display());
    }
    let changes = git(root, &[&["status", "--porcelain", "--"], &MADE_OF[..]].concat())?;
    Some(if changes.is_empty() { commit } else { format!("{commit}-modified") })
}

/// The commit that `cargo package` wrote beside the sources.
fn of_package(root: &Path) -> Option<String> {
    let path = root.join(".cargo_vcs_info.json");
    let text = fs::read_to_string(&path).ok()?;
    println!("cargo:rerun-if-changed={}", path.display());
    let (_, rest) = text.split_once("\"sha1\"")?;
    let commit = rest.split('"').nth(1)?;
    (commit.len() >= 40 && commit.bytes().all(|digit| digit.is_ascii_hexdigit())).then(|| commit.to_owned())
}

fn git(root: &Path, arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").arg("-C").arg(root).args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}

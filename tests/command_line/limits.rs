//! Limits on time and memory hold whatever the work is; an output never takes the place of an input.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use support::process::{Run, petril, run};
use tempfile::TempDir;

const PROGRAM: &str = "PROGRAM p\nVAR_INPUT a : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\nLD a\nST q\nEND_PROGRAM\n";
const SPECIFICATION: &str = "function F { interface { input a; output q; } formal { q = a; } }\n";

/// A folder with an input of every kind.
fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    let files = [
        ("p.il", PROGRAM),
        ("n.net", "pl {a=1} (1)\npl {a=0} (0)\ntr t {a=1} -> {a=0}\n"),
        ("r.req", "requirement follows: AG (q = a);\n"),
        ("in.csv", "a\n1\n0\n"),
        ("s.sif", SPECIFICATION),
        ("list.csv", "name,direction\na,in\nq,out\n"),
        ("project/petril.toml", "[[check]]\nprogram = \"p.il\"\nformulas = [\"AG (q = a)\"]\n"),
        ("project/p.il", PROGRAM),
    ];
    fs::create_dir(folder.path().join("project")).unwrap();
    for (name, text) in files {
        fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

/// Refuses to write into a file that it reads, and leaves it as it was.
fn refuses(folder: &Path, input: &str, line: &[&str]) {
    let before = fs::read(folder.join(input)).unwrap();
    let run = petril(folder, line);
    assert_eq!(run.code, 2, "{line:?}\n{}{}", run.stdout, run.stderr);
    assert!(run.stderr.contains("is an input, and is not overwritten"), "{line:?}\n{}", run.stderr);
    assert_eq!(fs::read(folder.join(input)).unwrap(), before, "{line:?}");
}

#[test]
fn no_verb_writes_into_its_inputs() {
    let folder = folder();
    let folder = folder.path();
    for form in ["--html", "--junit", "--sarif", "--csv"] {
        refuses(folder, "p.il", &["check", "p.il", "-r", "AG (q = a)", form, "p.il"]);
        refuses(folder, "r.req", &["check", "p.il", "--require", "r.req", form, "./r.req"]);
        refuses(folder, "n.net", &["check", "p.il", "--plant", "n.net", "-r", "AG (q = a)", form, "n.net"]);
    }
    let plan = petril(folder, &["sif", "tests", "s.sif", "--csv", "plan.csv"]);
    assert_eq!(plan.code, 0, "{}", plan.stderr);
    refuses(folder, "n.net", &["translate", "p.il", "--plant", "n.net", "-o", "n.net"]);
    refuses(folder, "in.csv", &["simulate", "p.il", "--inputs", "in.csv", "-o", "in.csv"]);
    refuses(folder, "n.net", &["net", "convert", "n.net", "-o", "n.net"]);
    refuses(folder, "list.csv", &["sif", "import", "list.csv", "-o", "list.csv"]);
    refuses(folder, "s.sif", &["sif", "requirements", "s.sif", "-o", "s.sif"]);
    for form in ["--html", "--csv"] {
        refuses(folder, "s.sif", &["sif", "tests", "s.sif", form, "s.sif"]);
        refuses(folder, "plan.csv", &["sif", "tests", "s.sif", "--tests", "plan.csv", form, "plan.csv"]);
    }
    for form in ["--html", "--junit", "--csv"] {
        refuses(folder, "p.il", &["sif", "run", "s.sif", "p.il", form, "p.il"]);
        refuses(folder, "plan.csv", &["sif", "run", "s.sif", "p.il", "--tests", "plan.csv", form, "plan.csv"]);
    }
    let project = folder.join("project");
    for (form, input) in [("--junit", "petril.toml"), ("--sarif", "p.il")] {
        refuses(&project, input, &["check", "--no-cache", form, input]);
    }
}

#[cfg(unix)]
#[test]
fn inputs_are_known_by_every_name() {
    let folder = folder();
    let folder = folder.path();
    std::os::unix::fs::symlink("p.il", folder.join("link.csv")).unwrap();
    fs::hard_link(folder.join("p.il"), folder.join("hard.csv")).unwrap();
    let absolute = folder.join("p.il").display().to_string();
    for name in ["link.csv", "hard.csv", "project/../p.il", &absolute] {
        refuses(folder, "p.il", &["check", "p.il", "-r", "AG (q = a)", "--csv", name]);
        refuses(folder, "p.il", &["check", name, "-r", "AG (q = a)", "--csv", "p.il"]);
    }
    // Standard input is a file, too.
    fs::copy(folder.join("n.net"), folder.join("m.net")).unwrap();
    let mut command = Command::new("sh");
    let line = "\"$0\" translate - -o p.net < p.net";
    fs::copy(folder.join("p.il"), folder.join("p.net")).unwrap();
    command.args(["-c", line, env!("CARGO_BIN_EXE_petril")]).current_dir(folder);
    let run = run(command);
    assert!(run.code == 2 && run.stderr.contains("is an input"), "{}", run.stderr);
    assert_eq!(fs::read_to_string(folder.join("p.net")).unwrap(), PROGRAM);
}

#[test]
fn two_outputs_are_two_files() {
    let folder = folder();
    for other in ["x.csv", "./x.csv", "project/../x.csv"] {
        let line = ["check", "p.il", "-r", "AG (q = a)", "--csv", "x.csv", "--html", other];
        let run = petril(folder.path(), &line);
        assert!(run.code == 2 && run.stderr.contains("cannot be two things"), "{other}: {}", run.stderr);
        assert!(!folder.path().join("x.csv").exists());
    }
}

#[cfg(unix)]
#[test]
fn what_is_replaced_keeps_its_mode_and_links_are_followed() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = folder();
    let folder = folder.path();
    let mode = |name: &str| fs::metadata(folder.join(name)).unwrap().permissions().mode() & 0o777;
    let write = |name: &str| petril(folder, &["check", "p.il", "-r", "AG (q = a)", "--csv", name]);
    for bits in [0o600, 0o664, 0o755] {
        fs::write(folder.join("old.csv"), "old").unwrap();
        fs::set_permissions(folder.join("old.csv"), fs::Permissions::from_mode(bits)).unwrap();
        assert_eq!(write("old.csv").code, 0);
        assert_eq!(mode("old.csv"), bits);
        assert!(fs::read_to_string(folder.join("old.csv")).unwrap().starts_with("kind,name"));
    }
    symlink("old.csv", folder.join("link.csv")).unwrap();
    symlink("none.csv", folder.join("loose.csv")).unwrap();
    for (link, file) in [("link.csv", "old.csv"), ("loose.csv", "none.csv")] {
        assert_eq!(write(link).code, 0);
        assert!(fs::symlink_metadata(folder.join(link)).unwrap().is_symlink());
        assert!(fs::read_to_string(folder.join(file)).unwrap().starts_with("kind,name"));
    }
    fs::set_permissions(folder.join("old.csv"), fs::Permissions::from_mode(0o444)).unwrap();
    let run = write("old.csv");
    assert!(run.code == 2 && run.stderr.contains("permission denied"), "{}", run.stderr);
    // A new file is as readable as the system makes it.
    let mut command = Command::new("sh");
    let line = "umask 027; \"$0\" check p.il -r 'AG (q = a)' --csv new.csv";
    command.args(["-c", line, env!("CARGO_BIN_EXE_petril")]).current_dir(folder);
    assert_eq!(support::process::run(command).code, 0);
    assert_eq!(mode("new.csv"), 0o640);
    assert!(write("/dev/stdout").stdout.contains("kind,name"));
}

/// Instances within instances: 2 of each, so that a program of 2 kB has 2ⁿ of the innermost.
fn nested(depth: usize) -> String {
    let mut text = String::from(
        "FUNCTION_BLOCK f0\nVAR_INPUT x : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\nLD x\nST q\nEND_FUNCTION_BLOCK\n",
    );
    for level in 1..=depth {
        let _ = write!(
            text,
            "FUNCTION_BLOCK f{level}\nVAR_INPUT x : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\nVAR a, b : f{}; END_VAR\n\
             LD x\nST a.x\nCAL a\nLD x\nST b.x\nCAL b\nLD a.q\nST q\nEND_FUNCTION_BLOCK\n",
            level - 1
        );
    }
    let _ = write!(
        text,
        "PROGRAM p\nVAR_INPUT x : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\nVAR a : f{depth}; END_VAR\nLD x\nST a.x\nCAL a\n\
         LD a.q\nST q\nEND_PROGRAM\n"
    );
    text
}

/// A specification of one function with this many terms.
fn terms(count: usize) -> String {
    let inputs: String = (0..300).map(|input| format!("input i{input}; ")).collect();
    let terms: Vec<String> =
        (0..count).map(|term| format!("(i{} & !i{})", term * 7 % 300, (term * 31 + 11) % 300)).collect();
    format!("function F {{ interface {{ {inputs}output f; }} formal {{ f = {}; }} }}\n", terms.join(" | "))
}

/// Runs with a limit of half a second. The rest is the patience of a busy machine.
fn within(folder: &Path, line: &[&str]) -> Run {
    let started = Instant::now();
    let run = petril(folder, line);
    assert!(started.elapsed() < Duration::from_secs(20), "{line:?} takes {:?}", started.elapsed());
    run
}

#[test]
fn time_is_kept_in_every_phase() {
    let folder = TempDir::new().unwrap();
    let folder = folder.path();
    fs::write(folder.join("nested.il"), nested(16)).unwrap();
    fs::write(folder.join("terms.sif"), terms(20_000)).unwrap();
    for verb in ["flat", "translate"] {
        let mut line = vec![verb, "nested.il", "--timeout", "0.1"];
        line.extend(if verb == "translate" { &["-o", "x.net"][..] } else { &[] });
        let run = within(folder, &line);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{}", run.stderr);
        assert!(run.stderr.contains("error: the time limit of 0.1 s was reached, while "), "{}", run.stderr);
    }
    let run = within(folder, &["check", "nested.il", "-r", "AG (q -> q)", "--timeout", "0.5", "--json"]);
    assert_eq!(run.code, 3, "{}", run.stderr);
    assert!(run.stderr.contains("unknown: the time limit of 0.5 s was reached, while "), "{}", run.stderr);
    assert!(run.stdout.contains("\"verdict\": \"unknown\""), "{}", run.stdout);
    for verb in ["check", "tests"] {
        let run = within(folder, &["sif", verb, "terms.sif", "--timeout", "0.5"]);
        assert_eq!(run.code, 3, "{verb}: {}", run.stderr);
    }
    let left: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left.len(), 2, "nothing is left behind: {left:?}");
}

#[cfg(target_os = "linux")]
#[test]
fn memory_is_kept_in_every_phase() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("nested.il"), nested(16)).unwrap();
    let run = within(folder.path(), &["check", "nested.il", "-r", "AG (q -> q)", "--max-memory", "100"]);
    assert_eq!(run.code, 3, "{}", run.stderr);
    assert!(run.stderr.contains("unknown: the limit of 100 MiB was reached: "), "{}", run.stderr);
    let run = within(folder.path(), &["translate", "nested.il", "-o", "x.net", "--max-memory", "100"]);
    assert_eq!(run.code, 2, "{}", run.stderr);
    assert!(run.stderr.contains("error: the limit of 100 MiB was reached: "), "{}", run.stderr);
    assert!(!folder.path().join("x.net").exists());
}

#[cfg(target_os = "linux")]
#[test]
fn a_small_address_space_is_no_abort() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("nested.il"), nested(16)).unwrap();
    let mut command = Command::new("sh");
    let line = "ulimit -v 700000; \"$0\" check nested.il -r 'AG (q -> q)' --threads 1";
    command.args(["-c", line, env!("CARGO_BIN_EXE_petril")]).current_dir(folder.path());
    let run = run(command);
    assert!(run.code == 3 && run.stderr.contains("unknown: the limit of "), "{} {}", run.code, run.stderr);
}

#[test]
fn threads_have_a_limit() {
    let run = petril(folder().path(), &["check", "p.il", "-r", "AG (q = a)", "--threads", "1000000"]);
    assert!(run.code == 2 && run.stderr.contains("--threads: at most 1024"), "{}", run.stderr);
}

#[test]
fn any_time_of_a_build_is_written() {
    let folder = folder();
    for (seconds, date) in [("18446744073709551615", "9999-12-31T23:59:59"), ("0", "1970-01-01T00:00:00")] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_petril"));
        command.args(["check", "p.il", "-r", "AG (q = a)", "--junit", "x.xml"]).current_dir(folder.path());
        command.env("SOURCE_DATE_EPOCH", seconds);
        assert_eq!(run(command).code, 0);
        assert!(fs::read_to_string(folder.path().join("x.xml")).unwrap().contains(date));
    }
}

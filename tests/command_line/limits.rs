//! Limits on time and memory hold whatever the work is; an output never takes the place of an input.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
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

#[test]
fn a_project_refuses_its_inputs_before_any_work() {
    let folder = folder();
    let project = folder.path().join("project");
    let text = "[[check]]\nprogram = \"p.il\"\nrequirements = \"p.csv\"\nplants = \"n.net\"\n";
    fs::write(project.join("petril.toml"), text).unwrap();
    fs::write(project.join("p.csv"), "requirement follows: AG (q = a);\n").unwrap();
    fs::write(project.join("n.net"), "pl {a=1} (1)\n").unwrap();
    // Work would find this.
    fs::write(project.join("p.il"), "PROGRAM p\n").unwrap();
    for (form, output, input) in [
        ("--junit", "p.il", "p.il"),
        ("--sarif", "n.net", "n.net"),
        ("--junit", "p.csv", "p.csv"),
        // The table of the program `p` in this folder.
        ("--csv", ".", "p.csv"),
    ] {
        let line = ["check", "--no-cache", form, output];
        refuses(&project, input, &line);
        let run = petril(&project, &line);
        assert_eq!(run.stderr.lines().count(), 1, "{line:?}\n{}", run.stderr);
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

#[cfg(unix)]
#[test]
fn another_name_of_what_is_replaced_keeps_the_old_content() {
    let folder = folder();
    let folder = folder.path();
    fs::write(folder.join("old.csv"), "old").unwrap();
    fs::hard_link(folder.join("old.csv"), folder.join("copy.csv")).unwrap();
    assert_eq!(petril(folder, &["check", "p.il", "-r", "AG (q = a)", "--csv", "old.csv"]).code, 0);
    assert!(fs::read_to_string(folder.join("old.csv")).unwrap().starts_with("kind,name"));
    assert_eq!(fs::read_to_string(folder.join("copy.csv")).unwrap(), "old");
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

/// A net in TINA's format: a token goes around so many places.
fn ring(places: usize) -> String {
    (0..places).fold(String::from("pl p0 (1)\n"), |mut text, at| {
        let _ = writeln!(text, "tr t{at} p{at} -> p{}", (at + 1) % places);
        text
    })
}

/// A PLCopen project whose one program has so many lines.
fn plcopen(lines: usize) -> String {
    format!(
        "<?xml version=\"1.0\"?><project xmlns=\"http://www.plcopen.org/xml/tc6_0201\"><types><dataTypes/><pous>\
         <pou name=\"p\" pouType=\"program\"><interface><inputVars><variable name=\"a\"><type><BOOL/></type></variable>\
         </inputVars><outputVars><variable name=\"q\"><type><BOOL/></type></variable></outputVars></interface><body><IL>\
         <xhtml xmlns=\"http://www.w3.org/1999/xhtml\">{}</xhtml></IL></body></pou></pous></types></project>",
        "LD a\nST q\n".repeat(lines / 2)
    )
}

#[test]
fn time_is_kept_while_nets_and_long_programs_are_read() {
    let folder = TempDir::new().unwrap();
    let folder = folder.path();
    fs::write(folder.join("ring.net"), ring(100_000)).unwrap();
    fs::write(folder.join("p.xml"), plcopen(600_000)).unwrap();
    for verb in ["convert", "reduce"] {
        for limit in [["--timeout", "0.1"], ["--max-memory", "20"]] {
            let run = within(folder, &[&["net", verb, "ring.net", "-o", "x.net"], &limit[..]].concat());
            assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{verb} {limit:?} {}", run.stderr);
            let said = ["error: the time limit of 0.1 s was reached", "error: the limit of 20 MiB was reached"];
            assert!(said.iter().any(|said| run.stderr.contains(said)), "{}", run.stderr);
            assert!(!folder.join("x.net").exists());
        }
    }
    let run = within(folder, &["check", "p.xml", "-r", "AG (q = a)", "--timeout", "0.1"]);
    assert_eq!(run.code, 3, "{}", run.stderr);
    assert!(run.stderr.contains("unknown: the time limit of 0.1 s was reached, while reading the program"));
}

#[test]
fn a_report_that_is_ended_says_where_it_comes_from() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("nested.il"), nested(16)).unwrap();
    let line = ["check", "nested.il", "-r", "AG (q -> q)", "--timeout", "0.2", "--json"];
    let run = within(folder.path(), &line);
    let document: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!((run.code, document["verdict"].as_str()), (3, Some("unknown")), "{}", run.stdout);
    let provenance = &document["provenance"];
    let words: Vec<&str> = provenance["command"].as_array().unwrap().iter().filter_map(|word| word.as_str()).collect();
    assert_eq!(words[1..], line);
    assert_eq!(provenance["inputs"][0]["file"], "nested.il");
    assert_eq!(provenance["inputs"][0]["sha256"].as_str().map(str::len), Some(64));
}

/// A project of `nested.il`, which takes long to flatten, and `p.il`, which does not.
fn slow_project() -> TempDir {
    let folder = folder();
    let text = "[defaults]\ntimeout = 0.4\nformulas = [\"AG (q -> q)\"]\n[[check]]\nprogram = \"nested.il\"\n[[check]]\nprogram = \"p.il\"\n";
    fs::write(folder.path().join("petril.toml"), text).unwrap();
    fs::write(folder.path().join("nested.il"), nested(16)).unwrap();
    folder
}

#[test]
fn a_program_of_a_project_that_takes_too_long_is_not_waited_for() {
    let folder = slow_project();
    // One thread: the second program is checked though the first one still takes the worker.
    for threads in ["1", "2"] {
        let run = within(folder.path(), &["check", "--no-cache", "--threads", threads]);
        assert_eq!(run.code, 3, "{}{}", run.stdout, run.stderr);
        assert!(
            run.stderr.starts_with("unknown: nested: the time limit of 0.4 s was reached, while "),
            "{}",
            run.stderr
        );
        assert!(run.stdout.contains("2 programs: 1 hold, 1 unknown\n1 requirement: 1 hold\n"), "{}", run.stdout);
    }
    let run = within(folder.path(), &["check", "--no-cache", "--json"]);
    let document: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!((run.code, &document["verdict"]), (3, &"unknown".into()));
    let verdicts = [0, 1].map(|at| document["programs"][at]["verdict"].as_str());
    assert_eq!(verdicts, [Some("unknown"), Some("holds")]);
}

#[test]
fn time_is_kept_while_files_are_watched() {
    let folder = slow_project();
    let line = ["check", "nested.il", "-r", "AG (q -> q)", "--watch", "--timeout", "0.4", "--no-cache"];
    let run = within(folder.path(), &line);
    assert_eq!(run.code, 3, "{}", run.stderr);
    assert!(run.stderr.contains("unknown: the time limit of 0.4 s was reached, while "), "{}", run.stderr);
}

/// Runs, sends a signal after half a second, and gives the exit code and standard error.
#[cfg(unix)]
fn signalled(folder: &Path, signal: &str, line: &[&str]) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_petril"));
    command.args(line).current_dir(folder).env("PETRIL_PROGRESS", "0").stdout(Stdio::null()).stderr(Stdio::piped());
    let child = command.spawn().unwrap();
    let started = Instant::now();
    std::thread::sleep(Duration::from_millis(500));
    assert!(Command::new("kill").args([&format!("-{signal}"), &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert!(started.elapsed() < Duration::from_secs(20), "{line:?} takes {:?}", started.elapsed());
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_what_does_not_ask() {
    let folder = slow_project();
    let (code, said) = signalled(folder.path(), "INT", &["check", "nested.il", "-r", "AG (q -> q)", "--no-cache"]);
    assert!(code == Some(3) && said.starts_with("unknown: interrupted, while "), "{code:?} {said}");
    let text = fs::read_to_string(folder.path().join("petril.toml")).unwrap().replace("timeout = 0.4", "timeout = 900");
    fs::write(folder.path().join("petril.toml"), text).unwrap();
    let (code, said) = signalled(folder.path(), "INT", &["check", "--no-cache"]);
    assert!(code == Some(3) && said.starts_with("unknown: nested: interrupted, while "), "{code:?} {said}");
}

/// The standard library aborts where an allocation fails.
#[cfg(unix)]
#[test]
fn an_abort_is_an_end_with_an_exit_code() {
    let folder = slow_project();
    let (code, said) = signalled(folder.path(), "ABRT", &["check", "nested.il", "-r", "AG (q -> q)", "--no-cache"]);
    assert_eq!(code, Some(2), "{said}");
}

#[cfg(target_os = "linux")]
#[test]
fn memory_is_kept_in_every_phase() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("nested.il"), nested(16)).unwrap();
    let run = within(folder.path(), &["check", "nested.il", "-r", "AG (q -> q)", "--max-memory", "100"]);
    assert_eq!(run.code, 3, "{}", run.stderr);
    let used = run.stderr.strip_prefix("unknown: the limit of 100 MiB was reached: ");
    let used: u64 = used.unwrap_or_else(|| panic!("{}", run.stderr)).split(' ').next().unwrap().parse().unwrap();
    assert!((101..=214).contains(&used), "{used} MiB");
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
    let line = "ulimit -v 700000; \"$0\" check nested.il -r 'AG (q -> q)' --threads 1 --max-memory 100000";
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

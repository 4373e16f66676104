//! Projects: the example that `petril init` writes, project files, what is kept from one run to the next, and `--watch`.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use serde_json::Value;
use support::document::replay;
use support::process::{KEY, Run, petril, run};
use tempfile::TempDir;

/// What `petril init` writes.
fn example() -> TempDir {
    let folder = TempDir::new().unwrap();
    assert_eq!(petril(folder.path(), &["init"]).code, 0);
    folder
}

fn edit(path: &Path, from: &str, to: &str) {
    let text = fs::read_to_string(path).unwrap();
    assert!(text.contains(from), "{from}");
    fs::write(path, text.replacen(from, to, 1)).unwrap();
}

/// Moves `AND Clear` below `OR Lower`, as the comment in the program says.
fn mend(folder: &Path) {
    edit(&folder.join("gate.il"), "    AND  Clear\n    OR   Lower\n", "    OR   Lower\n    AND  Clear\n");
}

fn json(run: &Run) -> Value {
    serde_json::from_str(&run.stdout).unwrap_or_else(|error| panic!("{error}\n{}{}", run.stderr, run.stdout))
}

/// The requirements of the only program of a project run, as (name, verdict, known from before).
fn requirements(document: &Value) -> Vec<(String, String, bool)> {
    let answers = document["programs"][0]["report"]["requirements"].as_array().unwrap();
    let one = |answer: &Value| {
        let text = |key: &str| answer[key].as_str().unwrap().to_owned();
        (text("name"), text("verdict"), answer["cached"].as_bool().unwrap())
    };
    answers.iter().map(one).collect()
}

fn check(folder: &Path) -> Vec<(String, String, bool)> {
    requirements(&json(&petril(folder, &["check", "--json"])))
}

fn all_known(answers: &[(String, String, bool)]) -> bool {
    answers.iter().all(|(_, _, known)| *known)
}

fn none_known(answers: &[(String, String, bool)]) -> bool {
    !answers.iter().any(|(_, _, known)| *known)
}

#[test]
fn the_example_has_one_fault_that_can_be_mended() {
    let folder = example();
    let first = petril(folder.path(), &["check"]);
    assert_eq!(first.code, 1, "{}", first.stdout);
    assert!(first.stdout.contains("6 requirements: 5 hold, 1 violated\n"), "{}", first.stdout);
    assert!(first.stdout.contains("VIOLATED barrier: "), "{}", first.stdout);
    assert!(first.stdout.contains("`ST Lower`, gate.il:"), "who wrote the value is told\n{}", first.stdout);
    assert_eq!(first.stderr, "");
    mend(folder.path());
    let second = petril(folder.path(), &["check"]);
    assert_eq!(second.code, 0, "{}", second.stdout);
    assert!(second.stdout.contains("6 requirements: 6 hold\n"), "{}", second.stdout);
}

#[test]
fn an_example_overwrites_nothing() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("gate.req"), "mine").unwrap();
    let refused = petril(folder.path(), &["init"]);
    assert_eq!((refused.code, refused.stdout.as_str()), (2, ""));
    assert!(refused.stderr.contains("`gate.req` exists already"), "{}", refused.stderr);
    assert_eq!(fs::read_to_string(folder.path().join("gate.req")).unwrap(), "mine");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "nothing else was written");
    assert_eq!(petril(folder.path(), &["init", "new/gate"]).code, 0);
    assert_eq!(petril(&folder.path().join("new/gate"), &["check"]).code, 1);
}

#[test]
fn a_project_is_found_from_below() {
    let folder = example();
    fs::create_dir_all(folder.path().join("a/b")).unwrap();
    let below = petril(&folder.path().join("a/b"), &["check"]);
    assert_eq!(below.code, 1);
    assert!(below.stdout.starts_with("project ../../petril.toml, 1 program\n"), "{}", below.stdout);
    let elsewhere = TempDir::new().unwrap();
    let named = petril(elsewhere.path(), &["check", "--project", folder.path().join("petril.toml").to_str().unwrap()]);
    assert_eq!(named.code, 1);
    let nothing = petril(elsewhere.path(), &["check"]);
    assert_eq!(nothing.code, 2);
    assert!(nothing.stderr.contains("petril init"), "{}", nothing.stderr);
}

#[test]
fn what_is_known_is_not_computed_again() {
    let folder = example();
    let path = |name: &str| folder.path().join(name);
    let first = petril(folder.path(), &["check", "--json"]);
    assert!(none_known(&requirements(&json(&first))));
    let second = petril(folder.path(), &["check", "--json"]);
    assert!(all_known(&requirements(&json(&second))));
    // Nothing but that is different.
    assert_eq!(first.stdout.replace("\"cached\": false", "\"cached\": true"), second.stdout);
    assert!(petril(folder.path(), &["check"]).stdout.contains("(6 known from an earlier run)"));

    // Neither comments nor the layout change what a program does.
    edit(&path("gate.il"), "PROGRAM gate", "(* a word *)\n\nPROGRAM gate");
    assert!(all_known(&check(folder.path())));

    // A new requirement is computed, the others are not.
    edit(&path("gate.req"), "requirement closes", "requirement opens: repeatability(Top);\nrequirement closes");
    let known = check(folder.path()).into_iter().filter(|(_, _, known)| !known).map(|(name, ..)| name);
    assert_eq!(known.collect::<Vec<_>>(), ["opens"]);
    assert!(all_known(&check(folder.path())));
    // Its name and its words are nothing that is computed; the formula is.
    edit(&path("gate.req"), "requirement opens:", "requirement goes_up \"It goes up\":");
    assert!(all_known(&check(folder.path())));
    edit(&path("gate.req"), "repeatability(Top)", "AG EF Raise");
    let known = check(folder.path()).into_iter().filter(|(_, _, known)| !known).map(|(name, ..)| name);
    assert_eq!(known.collect::<Vec<_>>(), ["goes_up"]);

    assert!(none_known(&requirements(&json(&petril(folder.path(), &["check", "--json", "--no-cache"])))));
}

#[test]
fn what_matters_for_a_verdict_matters_for_what_is_known() {
    let change: [(&str, &str, &str); 8] = [
        ("gate.il", "    AND  Stop\n    ANDN Lower\n", "    AND  Stop\n"),
        ("gate.il", "Raise, Lower : BOOL;", "Raise, Lower : BOOL := TRUE;"),
        ("gate.net", "{Top=0,Bottom=1} (1)\npl {Top=0,Bottom=0}", "{Top=0,Bottom=1}\npl {Top=0,Bottom=0} (1)"),
        ("gate.req", "plant \"gate.net\";", "plant \"gate.net\"; assume calm: !(Up & Down);"),
        ("gate.req", "plant \"gate.net\";", "plant \"gate.net\"; domain Stop: 1;"),
        ("petril.toml", "timeout = 60", "view = \"transition\"\ntimeout = 60"),
        ("petril.toml", "timeout = 60", "max-states = 50\ntimeout = 60"),
        ("gate.il", "END_VAR\n    LD", "END_VAR\nVAR new : BOOL; END_VAR\n    LD"),
    ];
    for (file, from, to) in change {
        let folder = example();
        if to.contains("transition") {
            // What looks back is for the scan view.
            edit(&folder.path().join("gate.req"), "rising(Lower) -> Down", "Lower -> Lower");
        }
        check(folder.path());
        assert!(all_known(&check(folder.path())));
        edit(&folder.path().join(file), from, to);
        let answers = check(folder.path());
        assert!(none_known(&answers), "{file}: {to}: {answers:?}");
    }
}

#[test]
fn another_petril_knows_nothing() {
    let folder = example();
    let cache = folder.path().join(".petril-cache");
    assert!(none_known(&check(folder.path())));
    // The same program in another file is the same; with one byte more it is another.
    let other = folder.path().join("petril-copy");
    let mut bytes = fs::read(env!("CARGO_BIN_EXE_petril")).unwrap();
    let with = |bytes: &[u8]| {
        fs::write(&other, bytes).unwrap();
        #[cfg(unix)]
        fs::set_permissions(&other, std::os::unix::fs::PermissionsExt::from_mode(0o755)).unwrap();
        let mut command = Command::new(&other);
        command.args(["check", "--json"]).current_dir(folder.path()).env("PETRIL_CACHE_KEY", KEY);
        requirements(&json(&run(command)))
    };
    assert!(all_known(&with(&bytes)));
    bytes.push(0);
    assert!(none_known(&with(&bytes)));
    assert_eq!(kept(&cache).len(), 2);
    assert!(all_known(&check(folder.path())));
}

/// The files of what is known.
fn kept(cache: &Path) -> Vec<PathBuf> {
    let paths = fs::read_dir(cache).unwrap().map(|entry| entry.unwrap().path());
    paths.filter(|path| path.file_name().unwrap() != ".gitignore").collect()
}

#[test]
fn a_spoilt_file_is_as_if_it_were_not_there() {
    let folder = example();
    let right = petril(folder.path(), &["check", "--json"]);
    let file = kept(&folder.path().join(".petril-cache")).remove(0);
    let good = fs::read(&file).unwrap();
    let middle = good.len() / 2;
    let mut flipped = good.clone();
    flipped[middle] ^= 1;
    let spoilt: [&[u8]; 6] =
        [b"", b"\n", b"\xFF\xFE\n{}", &good[..middle], &flipped, b"petril\n{\"exploration\":null}"];
    for bytes in spoilt {
        fs::write(&file, bytes).unwrap();
        assert_eq!(petril(folder.path(), &["check", "--json"]).stdout, right.stdout);
        assert!(all_known(&check(folder.path())), "it was written anew");
    }
    fs::remove_file(&file).unwrap();
    fs::create_dir(&file).unwrap();
    assert_eq!(petril(folder.path(), &["check", "--json"]).stdout, right.stdout, "nothing can be written");
}

/// Changes what is known, as somebody would who knows how it is written; `sign` makes the code of a text.
fn forge(file: &Path, change: impl Fn(&mut Value), sign: impl Fn(&str) -> blake3::Hash) {
    let text = fs::read_to_string(file).unwrap();
    let (head, body) = text.split_once('\n').unwrap();
    let mut known: Value = serde_json::from_str(body).unwrap();
    change(&mut known);
    let (head, _) = head.rsplit_once(' ').unwrap();
    fs::write(file, format!("{head} {}\n{known}", sign(&format!("{head}\n{known}")))).unwrap();
}

/// The code that whoever has a secret signs a text with.
fn signed(secret: &str, text: &str) -> blake3::Hash {
    let key = blake3::derive_key("petril 2026 what is known from earlier runs", secret.as_bytes());
    blake3::keyed_hash(&key, text.as_bytes())
}

/// Changes what is known, as somebody would who has the key.
fn tamper(file: &Path, change: impl Fn(&mut Value)) {
    forge(file, change, |text| signed(KEY, text));
}

/// Everything holds, and nothing shows it.
fn all_hold(known: &mut Value) {
    let holds = serde_json::json!({ "Holds": { "vacuous": null, "witness": null, "example": null } });
    known["outcomes"].as_object_mut().unwrap().values_mut().for_each(|outcome| *outcome = holds.clone());
}

#[test]
fn what_is_forged_without_the_key_is_found_anew() {
    let signatures: [fn(&str) -> blake3::Hash; 3] = [
        |text| blake3::hash(text.as_bytes()),
        |text| blake3::hash(text.split_once('\n').unwrap().1.as_bytes()),
        |text| signed("the key of somebody else", text),
    ];
    for sign in signatures {
        let folder = example();
        let right = petril(folder.path(), &["check", "--json"]);
        let file = kept(&folder.path().join(".petril-cache")).remove(0);
        forge(&file, all_hold, sign);
        let again = petril(folder.path(), &["check", "--json"]);
        assert_eq!((again.code, &again.stdout), (1, &right.stdout));
    }
    // Whoever has the key is believed: this is what the key is for.
    let folder = example();
    check(folder.path());
    tamper(&kept(&folder.path().join(".petril-cache")).remove(0), all_hold);
    let again = petril(folder.path(), &["check", "--json"]);
    assert!(again.code == 0 && all_known(&requirements(&json(&again))));
}

#[test]
fn what_is_known_of_one_program_is_not_known_of_another() {
    let folder = example();
    check(folder.path());
    let cache = folder.path().join(".petril-cache");
    let of_first = kept(&cache).remove(0);
    let (name, text) = (of_first.file_name().unwrap().to_owned(), fs::read_to_string(&of_first).unwrap());
    fs::remove_file(&of_first).unwrap();
    mend(folder.path());
    check(folder.path());
    let of_mended = kept(&cache).remove(0);
    assert_ne!(of_mended.file_name().unwrap(), name);
    // The signed text of the faulty program in the place of that of the mended one, and with its name in it.
    let other = fs::read_to_string(&of_mended).unwrap();
    fs::write(&of_mended, &text).unwrap();
    assert!(none_known(&check(folder.path())));
    fs::write(&of_mended, format!("{}\n{}", other.split_once('\n').unwrap().0, text.split_once('\n').unwrap().1))
        .unwrap();
    assert!(none_known(&check(folder.path())));
}

/// A run of somebody who has this home folder.
fn at_home(folder: &Path, home: &Path, secret: Option<&str>) -> (bool, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_petril"));
    command.args(["check", "--json"]).current_dir(folder).env_remove("XDG_STATE_HOME").env_remove("PETRIL_CACHE_KEY");
    command.env("HOME", home).envs(secret.map(|secret| ("PETRIL_CACHE_KEY", secret)));
    let run = run(command);
    let answers = requirements(&json(&run));
    assert!(all_known(&answers) || none_known(&answers));
    (all_known(&answers), run.stderr)
}

#[test]
#[cfg(unix)]
fn the_key_is_a_file_of_its_owner_alone() {
    use std::os::unix::fs::PermissionsExt as _;
    let (folder, home, other) = (example(), TempDir::new().unwrap(), TempDir::new().unwrap());
    assert_eq!(at_home(folder.path(), home.path(), None), (false, String::new()));
    assert_eq!(at_home(folder.path(), home.path(), None), (true, String::new()));
    let key = home.path().join(".local/state/petril/cache-key");
    let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
    assert_eq!((mode(&key), mode(key.parent().unwrap())), (0o600, 0o700));
    let secret = fs::read_to_string(&key).unwrap();
    // Somebody else, to whom the folder is carried, and back.
    assert_eq!(at_home(folder.path(), other.path(), None), (false, String::new()));
    assert_ne!(fs::read_to_string(other.path().join(".local/state/petril/cache-key")).unwrap(), secret);
    assert_eq!(at_home(folder.path(), home.path(), None), (false, String::new()));
    // A secret of several machines.
    let team = Some("0123456789abcdef");
    assert_eq!(at_home(folder.path(), home.path(), team), (false, String::new()));
    assert_eq!(at_home(folder.path(), other.path(), team), (true, String::new()));
    let is_noted = |(known, messages): (bool, String), reason: &str| {
        assert!(
            !known && messages.starts_with("note: everything is computed") && messages.contains(reason),
            "{messages}"
        );
    };
    is_noted(at_home(folder.path(), home.path(), Some("too short")), "16 characters at least");
    // Others can read it; it is elsewhere; it lies in the project; it cannot be made.
    fs::set_permissions(&key, fs::Permissions::from_mode(0o644)).unwrap();
    is_noted(at_home(folder.path(), home.path(), None), "its owner alone can read");
    fs::set_permissions(&key, fs::Permissions::from_mode(0o600)).unwrap();
    fs::rename(&key, home.path().join("key")).unwrap();
    std::os::unix::fs::symlink(home.path().join("key"), &key).unwrap();
    is_noted(at_home(folder.path(), home.path(), None), "its owner alone can read");
    is_noted(at_home(folder.path(), folder.path(), None), "inside what it signs");
    is_noted(at_home(folder.path(), &folder.path().join("gate.il"), None), "cannot be used");
}

/// The scans of the one run that is kept.
fn scans(known: &mut Value) -> &mut Vec<Value> {
    let outcomes = known["outcomes"].as_object_mut().unwrap();
    let violated = outcomes.values_mut().find(|outcome| outcome.get("Violated").is_some()).unwrap();
    violated["Violated"][0]["trace"]["Scans"]["scans"].as_array_mut().unwrap()
}

#[test]
fn a_run_that_does_not_replay_is_found_anew() {
    let changes: [fn(&mut Value); 9] = [
        // Another input, another end, a scan less, no scan at all, a plant that jumps, things that do not exist.
        |known| scans(known)[2]["inputs"][3][1] = 1.into(),
        |known| scans(known)[2]["end"]["memory"][6] = 1.into(),
        |known| drop(scans(known).pop()),
        |known| scans(known).clear(),
        |known| scans(known)[1]["moves"] = Value::Array(vec![]),
        |known| scans(known)[0]["inputs"][0][0] = 999.into(),
        |known| scans(known)[0]["end"]["plant"][0] = 77.into(),
        |known| scans(known)[0]["end"]["memory"] = Value::Array(vec![]),
        |known| scans(known)[0]["moves"] = serde_json::json!([{ "component": 9, "transition": 9 }]),
    ];
    for change in changes {
        let folder = example();
        let right = json(&petril(folder.path(), &["check", "--json"]));
        let file = kept(&folder.path().join(".petril-cache")).remove(0);
        tamper(&file, change);
        let again = json(&petril(folder.path(), &["check", "--json"]));
        let answers = requirements(&again);
        assert!(answers.iter().all(|(name, _, known)| *known == (name != "barrier")), "{answers:?}");
        let run = |document: &Value| document["programs"][0]["report"]["requirements"][1]["trace"].clone();
        assert_eq!(run(&again), run(&right));
        assert!(all_known(&check(folder.path())));
    }
}

#[test]
fn a_run_that_replays_but_breaks_nothing_is_found_anew() {
    let folder = example();
    check(folder.path());
    let file = kept(&folder.path().join(".petril-cache")).remove(0);
    // The run of another requirement, which is one of the system.
    tamper(&file, |known| {
        let outcomes = known["outcomes"].as_object_mut().unwrap();
        let violated = outcomes.values().find(|outcome| outcome.get("Violated").is_some()).unwrap().clone();
        for outcome in outcomes.values_mut() {
            *outcome = violated.clone();
        }
    });
    let answers = check(folder.path());
    let violated: Vec<&str> =
        answers.iter().filter(|(_, verdict, _)| verdict == "violated").map(|(name, ..)| name.as_str()).collect();
    // No run shows that something is not possible: that rests on the check that found it, as what holds does.
    assert_eq!(violated, ["barrier", "closes"]);
}

/// A project of all examples, and of programs with errors of every kind.
fn examples(folder: &Path) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for from in ["examples", "nets"] {
        fs::create_dir(folder.join(from)).unwrap();
        for entry in fs::read_dir(root.join(from)).unwrap() {
            let entry = entry.unwrap();
            fs::copy(entry.path(), folder.join(from).join(entry.file_name())).unwrap();
        }
    }
    let project = "
        [[check]]
        programs = [\"examples/t*.il\", \"examples/*d*.il\"]
        formulas = [\"AG TRUE\", \"AG EF TRUE\", \"EF FALSE\"]
        scan-time = \"100ms\"
        max-states = 20000
        [[check]]
        program = \"examples/latching-starter.il\"
        plants = [\"nets/{name}.net\"]
        requirements = [\"{stem}.req\"]
    ";
    fs::write(folder.join("petril.toml"), project).unwrap();
}

#[test]
fn a_project_that_is_known_is_told_as_it_was_found() {
    let folder = TempDir::new().unwrap();
    examples(folder.path());
    let first = petril(folder.path(), &["check", "--json", "--by-line"]);
    let second = petril(folder.path(), &["check", "--json", "--by-line"]);
    assert!(first.stdout.contains("\"cached\": false") && second.stdout.contains("\"cached\": true"));
    assert_eq!(first.stdout.replace("\"cached\": false", "\"cached\": true"), second.stdout);
    assert_eq!((first.code, &first.stderr), (second.code, &second.stderr));
    let one = petril(folder.path(), &["check", "--json", "--by-line", "--no-cache", "--threads", "1"]);
    // The command line is another one, and so are its options; those of each program are not.
    let unnamed = |run: &Run| {
        let mut report: Value = serde_json::from_str(&run.stdout).unwrap();
        for program in report["programs"].as_array_mut().unwrap() {
            let command = program["report"]["provenance"].as_object_mut().unwrap().remove("command");
            assert_eq!(command.unwrap()[1], "check");
        }
        for of_the_command in ["command", "options"] {
            report["provenance"].as_object_mut().unwrap().remove(of_the_command).unwrap();
        }
        report
    };
    assert_eq!(unnamed(&one), unnamed(&first));
    let text = petril(folder.path(), &["check", "--only", "examples/tank*", "--only", "examples/latching-starter"]);
    assert!(text.stdout.starts_with("project petril.toml, 3 programs\n"), "{}", text.stdout);
    let unknown = petril(folder.path(), &["check", "--only", "examples/tanc"]);
    assert!(unknown.code == 2 && unknown.stderr.contains("did you mean `examples/tank`?"), "{}", unknown.stderr);
}

#[test]
fn two_at_once_do_each_other_no_harm() {
    let folder = TempDir::new().unwrap();
    examples(folder.path());
    let right = petril(folder.path(), &["check", "--no-cache"]).stdout;
    let runs: Vec<Run> = thread::scope(|scope| {
        let start = |_| scope.spawn(|| petril(folder.path(), &["check"]));
        let threads: Vec<_> = (0..3).map(start).collect();
        threads.into_iter().map(|thread| thread.join().unwrap()).collect()
    });
    // How much is known is the only thing that may differ.
    let without = |text: &str| -> Vec<String> {
        let plain = text.lines().filter(|line| !line.contains("known from an earlier run") && !line.contains(" | "));
        plain
            .filter(|line| !line.starts_with("program") && !line.contains("requirements:"))
            .map(str::to_owned)
            .collect()
    };
    for run in runs {
        assert_eq!(without(&run.stdout), without(&right));
    }
    assert!(petril(folder.path(), &["check"]).stdout.contains("known from an earlier run"));
}

#[test]
fn what_the_clock_has_ended_is_not_kept() {
    let folder = TempDir::new().unwrap();
    examples(folder.path());
    fs::write(folder.path().join("petril.toml"), "[[check]]\nprogram = \"examples/tank.il\"\ntimeout = 0.0").unwrap();
    let first = petril(folder.path(), &["check"]);
    assert_eq!(first.code, 3, "{}", first.stdout);
    assert!(!folder.path().join(".petril-cache").exists() || kept(&folder.path().join(".petril-cache")).is_empty());
}

/// To write what is printed now into the guide: `PETRIL_BLESS=1 cargo test --test command_line projects`. Then read it.
#[test]
fn the_guide_shows_what_is_printed() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/projects.md");
    let text = fs::read_to_string(&path).unwrap();
    let now = replay(&text);
    if std::env::var_os("PETRIL_BLESS").is_some() {
        fs::write(path, now).unwrap();
    } else {
        assert_eq!(text, now);
    }
}

#[test]
fn the_example_in_the_guide_is_the_one_that_is_written() {
    let (written, folder) = (example(), TempDir::new().unwrap());
    mend(written.path());
    let guide = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/projects.md")).unwrap();
    let shown = guide.split("```il gate.il\n").nth(1).unwrap().split("```").next().unwrap();
    fs::write(folder.path().join("shown.il"), shown).unwrap();
    let flat = |folder: &Path, file: &str| {
        let lines = petril(folder, &["flat", file]).stdout;
        let code = |line: &str| line.split(';').next().unwrap().to_owned();
        lines.lines().map(code).collect::<Vec<_>>()
    };
    assert_eq!(flat(folder.path(), "shown.il").len(), flat(written.path(), "gate.il").len());
}

#[test]
fn shells_take_the_completions() {
    let here = Path::new(".");
    for (shell, word) in [("bash", "complete "), ("zsh", "#compdef petril"), ("fish", "complete -c petril")] {
        let script = petril(here, &["completions", shell]);
        assert_eq!(script.code, 0);
        assert!(script.stdout.contains(word) && script.stdout.contains("completions"), "{shell}");
        // Only if there is such a shell.
        let folder = TempDir::new().unwrap();
        fs::write(folder.path().join("script"), &script.stdout).unwrap();
        let read = Command::new(shell).arg("-n").arg(folder.path().join("script")).output();
        assert!(read.is_err() || read.is_ok_and(|read| read.status.success()), "{shell}");
    }
    assert_eq!(petril(here, &["completions", "dos"]).code, 2);
}

#[test]
fn every_verb_has_a_manual_page() {
    let folder = TempDir::new().unwrap();
    assert_eq!(petril(folder.path(), &["man", "-o", "man1"]).code, 0);
    let page = |name: &str| fs::read_to_string(folder.path().join("man1").join(format!("{name}.1"))).unwrap();
    for name in ["petril", "petril-check", "petril-init", "petril-simulate", "petril-net", "petril-net-check"] {
        let text = page(name);
        let heads: Vec<&str> = text.lines().filter(|line| line.starts_with(".SH ")).collect();
        assert!(text.contains(".TH "), "{name}");
        assert!(heads.starts_with(&[".SH NAME", ".SH SYNOPSIS", ".SH DESCRIPTION"]), "{name}: {heads:?}");
        // Requests have names; what begins otherwise would vanish.
        let is_request = |line: &str| line[1..].starts_with(|c: char| c.is_ascii_alphabetic());
        let strange: Vec<&str> =
            text.lines().filter(|line| line.starts_with(['.', '\'']) && !is_request(line)).collect();
        let known = |line: &&str| !line.starts_with(".\\\"") && !line.starts_with(".ie") && !line.starts_with(".el");
        assert_eq!(strange.into_iter().filter(known).collect::<Vec<_>>(), Vec::<&str>::new(), "{name}");
    }
    assert!(page("petril-check").contains("\\-\\-watch"));
    assert_eq!(petril(folder.path(), &["man"]).stdout, page("petril"));
}

#[test]
fn a_project_has_reports_of_every_form() {
    let folder = TempDir::new().unwrap();
    examples(folder.path());
    let options = "--junit all.xml --sarif all.sarif --html pages --csv tables --trace-csv runs --vcd waves --json";
    let options: Vec<&str> = ["check", "--no-cache"].into_iter().chain(options.split(' ')).collect();
    let document = json(&petril(folder.path(), &options));
    let names: Vec<&str> =
        document["programs"].as_array().unwrap().iter().map(|program| program["name"].as_str().unwrap()).collect();
    let text = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    let suites = text("all.xml");
    let sarif: Value = serde_json::from_str(&text("all.sarif")).unwrap();
    assert_eq!(sarif["runs"].as_array().unwrap().len(), names.len());
    assert_eq!(suites.matches("<testsuite ").count(), names.len());
    for name in names {
        assert!(suites.contains(&format!("<testsuite name=\"{name}\"")), "{name}");
        assert!(text(&format!("pages/{name}.html")).contains("<html"));
        assert!(text(&format!("tables/{name}.csv")).starts_with("kind,"));
        assert!(folder.path().join("runs").join(name).is_dir() && folder.path().join("waves").join(name).is_dir());
    }
    let schema = |name: &str| -> Value {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/schema").join(name);
        serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
    };
    let (mut project, report) = (schema("project.schema.json"), schema("report.schema.json"));
    // Each report by itself: the validator knows no schema by its name.
    project["properties"]["programs"]["items"]["properties"]["report"] = Value::Bool(true);
    let errors = |schema: &Value, document: &Value| -> Vec<String> {
        let validator = jsonschema::draft202012::new(schema).unwrap();
        validator.iter_errors(document).map(|error| error.to_string()).collect()
    };
    assert_eq!(errors(&project, &document), Vec::<String>::new());
    for program in document["programs"].as_array().unwrap() {
        assert_eq!(errors(&report, &program["report"]), Vec::<String>::new(), "{}", program["name"]);
    }
}

/// Lines as a process prints them.
fn lines(output: impl Read + Send + 'static) -> mpsc::Receiver<String> {
    let (say, said) = mpsc::channel();
    thread::spawn(move || {
        for line in BufReader::new(output).lines().map_while(Result::ok) {
            if say.send(line).is_err() {
                return;
            }
        }
    });
    said
}

/// Waits for a line.
fn until(said: &mpsc::Receiver<String>, text: &str) {
    let started = Instant::now();
    while started.elapsed() < Duration::from_secs(60) {
        if said.recv_timeout(Duration::from_millis(100)).is_ok_and(|line| line.contains(text)) {
            return;
        }
    }
    panic!("nobody says `{text}`");
}

#[test]
#[cfg(unix)]
fn files_are_watched() {
    let folder = example();
    let mut command = Command::new(env!("CARGO_BIN_EXE_petril"));
    command.args(["check", "--watch"]).current_dir(folder.path());
    let mut child = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let (out, messages) = (lines(child.stdout.take().unwrap()), lines(child.stderr.take().unwrap()));
    until(&out, "6 requirements: 5 hold, 1 violated");
    until(&messages, "watching 4 files");
    mend(folder.path());
    until(&out, "6 requirements: 6 hold");
    until(&messages, "watching 4 files");
    // A file that goes and comes again.
    fs::remove_file(folder.path().join("gate.net")).unwrap();
    until(&messages, "cannot read `gate.net`");
    until(&messages, "watching");
    petril(folder.path(), &["init", "again"]);
    fs::copy(folder.path().join("again/gate.net"), folder.path().join("gate.net")).unwrap();
    until(&out, "6 requirements: 6 hold");
    until(&messages, "watching");
    // A file that is new, and matches a pattern.
    edit(&folder.path().join("petril.toml"), "program = \"gate.il\"", "programs = \"*.il\"");
    until(&out, "1 program: 1 hold");
    until(&messages, "watching");
    fs::copy(folder.path().join("again/gate.il"), folder.path().join("second.il")).unwrap();
    until(&out, "2 programs: 1 hold, 1 violated");
    until(&messages, "watching");
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    let started = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if started.elapsed() > Duration::from_secs(60) {
            child.kill().unwrap();
            panic!("it does not end");
        }
        thread::sleep(Duration::from_millis(20));
    };
    assert_eq!(status.code(), Some(130));
}

//! Hostile texts in every place that a text comes from, against every form that something is printed or written in: none
//! begins a line, reaches a terminal raw, becomes markup or a formula of a spreadsheet; programs get them back unchanged.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]
#![cfg(unix)]

use std::fs;
use std::path::Path;

use petril::printable::is_printable;
use serde_json::Value;
use support::process::{Run, petril};
use tempfile::TempDir;

/// A forged line, escape sequences, characters that reorder and hide, markup, the control sequence of one byte.
const EVIL: &str = "x\nFORGED TRUE\r\u{1b}[2K\u{1b}[32mHOLDS\u{1b}[0m\u{202e}\u{2066}\u{200b}\u{9b}2J\u{85}\u{2028}\"><script>FORGED()</script>";

/// The same for a text that has to stand on its line, without the quotation mark that would end it.
fn on_a_line() -> String {
    EVIL.replace(['\n', '\r', '\u{85}', '\u{2028}', '"'], "~")
}

/// Nothing of a text of others reached this raw.
fn must_be_safe(what: &str, text: &str) {
    for (number, line) in text.lines().enumerate() {
        assert!(!line.trim_start().starts_with("FORGED"), "{what}:{}: {line:?}", number + 1);
        let odd = line.chars().find(|&c| !is_printable(c) && c != '\t');
        assert_eq!(odd, None, "{what}:{}: {line:?}", number + 1);
    }
}

fn must_be_silent(what: &str, run: &Run) {
    must_be_safe(&format!("{what}, results"), &run.stdout);
    must_be_safe(&format!("{what}, messages"), &run.stderr);
}

/// With colours, the only escapes are those of colours, and no text has one within it.
fn must_be_coloured(what: &str, run: &Run) {
    for text in [&run.stdout, &run.stderr] {
        assert!(!text.contains("[32mHOLDS\u{1b}") && !text.contains("\u{1b}[2K"), "{what}: {text:?}");
        let plain: String = text
            .split('\u{1b}')
            .enumerate()
            .map(|(at, piece)| match at {
                0 => piece,
                _ => piece.strip_prefix('[').and_then(|rest| rest.split_once('m')).map_or("\u{1b}", |(_, rest)| rest),
            })
            .collect();
        must_be_safe(what, &plain);
    }
}

fn write(folder: &Path, name: &str, text: &str) {
    fs::write(folder.join(name), text).unwrap();
}

fn read(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn json(run: &Run) -> Value {
    serde_json::from_str(&run.stdout).unwrap_or_else(|error| panic!("{error}\n{}{}", run.stderr, run.stdout))
}

fn xml(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            // XML cannot hold it at all.
            '\u{1b}' => {}
            c if c.is_ascii_alphanumeric() => out.push(c),
            c => out += &format!("&#{};", u32::from(c)),
        }
    }
    out
}

/// What an XML file can hold of the hostile text.
fn evil_in_xml() -> String {
    EVIL.replace('\u{1b}', "")
}

/// A net with hostile names, in TINA's format and in PNML, and properties with hostile ids.
fn net(folder: &Path) {
    let name = |suffix: &str| format!("{{{}}}", format!("{EVIL}{suffix}").replace('\\', "\\\\"));
    let tina = format!(
        "net {}\npl {} (1)\npl {}\ntr {} {} -> {}\n",
        name("n"),
        name("a"),
        name("b"),
        name("t"),
        name("a"),
        name("b")
    );
    write(folder, "evil.net", &tina);
    let label = |suffix: &str| format!("<name><text>{}{suffix}</text></name>", xml(EVIL));
    let pnml = format!(
        "<pnml xmlns=\"http://www.pnml.org/version-2009/grammar/pnml\"><net id=\"n\" \
         type=\"http://www.pnml.org/version-2009/grammar/ptnet\">{}<page id=\"g\"><place id=\"a\">{}<initialMarking>\
         <text>1</text></initialMarking></place><place id=\"b\">{}</place><transition id=\"t\">{}</transition>\
         <arc id=\"x\" source=\"a\" target=\"t\"/><arc id=\"y\" source=\"t\" target=\"b\"/></page></net></pnml>",
        label("n"),
        label("a"),
        label("b"),
        label("t")
    );
    write(folder, "evil.pnml", &pnml);
    let properties = format!(
        "<property-set xmlns=\"http://mcc.lip6.fr/\"><property><id>{}</id><description>d</description><formula>\
         <all-paths><globally><integer-le><tokens-count><place>a</place></tokens-count><integer-constant>1\
         </integer-constant></integer-le></globally></all-paths></formula></property></property-set>",
        xml(&format!("{EVIL} TRUE TECHNIQUES EXPLICIT"))
    );
    write(folder, "evil.xml", &properties);
}

#[test]
fn nets_say_nothing_of_their_own() {
    let folder = TempDir::new().unwrap();
    let folder = folder.path();
    net(folder);
    for model in ["evil.net", "evil.pnml"] {
        for arguments in [
            vec!["net", "info", model, "--invariants", "--siphons", "--traps"],
            vec!["net", "explore", model],
            vec!["net", "check", model, "-r", "EF at deadlock", "--trace"],
            vec!["net", "check", model, "-r", "EF at deadlock", "--trace=tapaal"],
            vec!["net", "reduce", model, "-o", "smaller.net", "--keep", "FORGED\nFORGED"],
            vec!["net", "reduce", model, "-o", "smaller.net"],
        ] {
            let run = petril(folder, &arguments);
            must_be_silent(&arguments.join(" "), &run);
            let coloured: Vec<&str> = arguments.iter().copied().chain(["--color", "always"]).collect();
            must_be_coloured(&arguments.join(" "), &petril(folder, &coloured));
        }
        for ending in ["pnml", "lola", "andl", "pnt", "dot"] {
            let output = format!("made.{ending}");
            let run = petril(folder, &["net", "convert", model, "-o", &output]);
            assert_eq!(run.code, 0, "{}", run.stderr);
            must_be_silent(&output, &run);
            must_be_safe(&output, &read(folder, &output));
            // Nothing takes the other formats for markup.
            assert!(ending != "pnml" || !read(folder, &output).contains("<script>"), "{output}");
        }
        // Whoever reads a format gets the names back: all of them, or all that XML can hold.
        petril(folder, &["net", "convert", model, "-o", "again.pnml"]);
        let document = json(&petril(folder, &["net", "explore", "again.pnml", "--json"]));
        // A carriage return in a text file is a line end like others.
        let of_text = EVIL.replace('\r', "\n");
        let kept = if model == "evil.net" { of_text.replace('\u{1b}', "\\u{1b}") } else { evil_in_xml() };
        assert_eq!(document["net"], format!("{kept}n"));
        let document = json(&petril(folder, &["net", "explore", model, "--json"]));
        let kept = if model == "evil.net" { of_text } else { evil_in_xml() };
        assert_eq!(document["never_enabled"], serde_json::json!([]));
        assert_eq!(document["deadlock"], serde_json::json!({ format!("{kept}b"): 1 }));
        must_be_silent(model, &petril(folder, &["net", "info", model, "--json"]));
    }
    let run = petril(folder, &["net", "check", "evil.pnml", "--properties", "evil.xml"]);
    must_be_silent("properties", &run);
    let lines: Vec<&str> = run.stdout.lines().collect();
    assert_eq!(lines.len(), 1, "{lines:?}");
    // An id cannot hold an answer: what it is made of is one word.
    assert_eq!(lines[0].split(' ').filter(|word| *word == "TRUE").count(), 1, "{lines:?}");
    let document = json(&petril(folder, &["net", "check", "evil.pnml", "--properties", "evil.xml", "--json"]));
    assert_eq!(document["formulas"][0]["name"], format!("{} TRUE TECHNIQUES EXPLICIT", evil_in_xml()));
}

/// A program with a plant of hostile names and requirements with hostile sentences and tags.
fn program(folder: &Path) {
    let line = on_a_line();
    let text = format!(
        "PROGRAM p (* {line} *)\nVAR_INPUT a : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\nLD a (* {line} *)\nST q\nEND_PROGRAM\n"
    );
    write(folder, "p.il", &text);
    let name = |what: &str| format!("{{{what}{}}}", EVIL.replace('\\', "\\\\"));
    let plant = format!(
        "net {}\npl {{a=0}} (1)\npl {{a=1}}\ntr {} {{a=0}} -> {{a=1}}\ntr {} {{a=1}} -> {{a=0}}\n",
        name("n"),
        name("on"),
        name("off")
    );
    write(folder, "p.net", &plant);
    let requirements = format!(
        "requirement one \"={line}\" [author: \"{line}\"]: AG !q;\nrequirement two \"{line}\": AG (q <-> a);\n\
         requirement three \"{line}\": EF q;\n"
    );
    write(folder, "p.req", &requirements);
}

#[test]
fn reports_say_nothing_of_their_own() {
    let folder = TempDir::new().unwrap();
    let folder = folder.path();
    program(folder);
    for view in ["scan", "transition"] {
        let options =
            ["check", "p.il", "--plant", "p.net", "--require", "p.req", "--view", view, "--details", "--witnesses"];
        // What looks at ends of scans is for the scan view.
        let run = petril(folder, &options);
        assert!(run.code < 2, "{}{}", run.stdout, run.stderr);
        must_be_silent(view, &run);
        assert!(run.stdout.contains("VIOLATED one: ="), "{}", run.stdout);
        let coloured = petril(folder, &[&options[..], &["--color", "always"]].concat());
        must_be_coloured(view, &coloured);
        let files = [
            "--html",
            "r.html",
            "--junit",
            "r.xml",
            "--sarif",
            "r.sarif",
            "--csv",
            "r.csv",
            "--vcd",
            "v",
            "--trace-csv",
            "t",
        ];
        let run = petril(folder, &[&options[..], &files[..], &["--json"]].concat());
        must_be_silent(view, &run);
        let sentence = format!("={}", on_a_line());
        assert_eq!(json(&run)["requirements"][0]["sentence"], sentence.as_str(), "programs get the text back");
        for file in ["r.html", "r.xml", "r.sarif", "r.csv"] {
            let text = read(folder, file);
            must_be_safe(file, &text);
            assert!(file == "r.sarif" || file == "r.csv" || !text.contains("<script>FORGED"), "{file}");
        }
        for entry in ["v", "t"].iter().flat_map(|name| fs::read_dir(folder.join(name)).unwrap()) {
            must_be_safe("runs", &fs::read_to_string(entry.unwrap().path()).unwrap());
        }
        let mut rows = csv::ReaderBuilder::new().from_path(folder.join("r.csv")).unwrap();
        for row in rows.records().map(Result::unwrap) {
            let formula = row
                .iter()
                .find(|cell| cell.trim_start().starts_with(['=', '+', '-', '@']) && cell.parse::<f64>().is_err());
            assert_eq!(formula, None);
        }
        must_be_safe("sarif", &petril::printable::json(&read(folder, "r.sarif")));
    }
    for arguments in [
        vec!["flat", "p.il"],
        vec!["translate", "p.il", "--plant", "p.net", "-o", "p.pnml"],
        vec!["translate", "p.il", "--plant", "p.net", "-o", "p.svg"],
        vec!["translate", "p.il", "--plant", "p.net", "-o", "p.dot"],
        vec!["draw", "p.il", "--line", "1", "-o", "d.svg"],
        vec!["simulate", "p.il", "--plant", "p.net", "--random", "1", "--by-line", "2"],
        vec!["simulate", "p.il", "--plant", "p.net", "--random", "1", "--format", "vcd"],
        vec!["simulate", "p.il", "--random", "1", "--format", "csv", "--until", "a\n\u{1b}[31m"],
    ] {
        must_be_silent(&arguments.join(" "), &petril(folder, &arguments));
    }
    for file in ["p.pnml", "p.svg", "p.dot", "d.svg"] {
        must_be_safe(file, &read(folder, file));
        assert!(file == "p.dot" || !read(folder, file).contains("<script>"), "{file}");
    }
}

#[test]
fn projects_and_safety_functions_say_nothing_of_their_own() {
    let folder = TempDir::new().unwrap();
    let folder = folder.path();
    program(folder);
    let key = EVIL.replace('\u{1b}', "").replace('"', "~");
    let quoted = serde_json::to_string(&key).unwrap();
    write(
        folder,
        "petril.toml",
        &format!("[[check]]\nprogram = \"p.il\"\nname = {quoted}\nrequirements = [\"p.req\"]\n"),
    );
    must_be_silent("project", &petril(folder, &["check"]));
    must_be_silent("project", &petril(folder, &["check", "--only", &key]));
    write(folder, "petril.toml", &format!("[[check]]\nprogram = {quoted}\n[{quoted}]\nx = 1\n"));
    must_be_silent("project", &petril(folder, &["check"]));
    let line = on_a_line();
    let specification = format!(
        "system \"{line}\";\nzone z \"{line}\" {{\nfunction f \"{line}\" {{ interface {{ input a \"{line}\"; output q \"{line}\"; }} formal {{ q = a; }} }}\n}}\n"
    );
    write(folder, "s.sif", &specification);
    for arguments in [
        vec!["sif", "check", "s.sif"],
        vec!["sif", "check", "s.sif", "--json"],
        vec!["sif", "requirements", "s.sif", "-o", "out.req"],
        vec!["sif", "tests", "s.sif", "--html", "t.html", "--csv", "t.csv"],
        vec!["sif", "tests", "s.sif", "--json"],
        vec!["sif", "run", "s.sif", "p.il", "--html", "r.html", "--csv", "r.csv", "--junit", "r.xml"],
        vec!["sif", "prove", "s.sif", "p.il"],
        vec!["sif", "excluded", "s.sif"],
        vec!["sif", "tests", "s.sif", "--function", EVIL],
    ] {
        let run = petril(folder, &arguments);
        must_be_silent(&arguments.join(" "), &run);
        assert!(run.code == 0 || arguments.contains(&EVIL), "{arguments:?} {}", run.stderr);
    }
    for file in ["t.html", "t.csv", "r.html", "r.csv", "r.xml"] {
        must_be_safe(file, &read(folder, file));
        assert!(!read(folder, file).contains("<script>FORGED"), "{file}");
    }
    // A list of inputs and outputs.
    write(folder, "list.csv", &format!("name,direction,description\n\"=a {line}\",input,\"{line}\"\n"));
    must_be_silent("import", &petril(folder, &["sif", "import", "list.csv"]));
}

#[test]
fn names_of_files_and_arguments_say_nothing_of_their_own() {
    let folder = TempDir::new().unwrap();
    let folder = folder.path();
    program(folder);
    let evil = EVIL.replace('/', "_");
    let file = |ending: &str| format!("{evil}.{ending}");
    for (from, ending) in [("p.il", "il"), ("p.net", "net"), ("p.req", "req")] {
        fs::copy(folder.join(from), folder.join(file(ending))).unwrap();
    }
    let (il, net, req) = (file("il"), file("net"), file("req"));
    let wrong = file("wrong");
    for arguments in [
        vec!["check", &il, "--plant", &net, "--require", &req],
        vec!["check", &il, "--plant", &net, "--require", &req, "--json"],
        vec!["check", &il, "-r", "AG nothing", "-r", EVIL, "--domain", EVIL, "--fairness", EVIL],
        vec!["check", &il, "--overflow", EVIL],
        vec!["check", &il, "--scan-time", EVIL],
        vec!["check", &il, EVIL],
        vec![EVIL],
        vec!["check", &format!("--{EVIL}")],
        vec!["check", "--project", &wrong],
        vec!["check", &wrong],
        vec!["check", &il, "--pou", EVIL],
        vec!["check", &il, "--html", &wrong, "--csv", &wrong],
        vec!["check", &il, "--html", &format!("{wrong}/x")],
        vec!["translate", &il, "-o", &wrong],
        vec!["translate", &il, "-o", &file("dot")],
        vec!["flat", &il],
        vec!["flat", &net],
        vec!["simulate", &il, "--inputs", &il],
        vec!["simulate", &il, "--replay", &il],
        vec!["simulate", &il, "--until", EVIL],
        vec!["draw", "--instruction", EVIL, "-o", &wrong],
        vec!["net", "info", &il],
        vec!["net", "convert", &net, "-o", &file("pnml")],
        vec!["net", "check", &net, "-r", EVIL],
        vec!["net", "check", &net, "--examination", EVIL],
        vec!["net", "check", &net, "--properties", &il],
        vec!["sif", "check", &il],
        vec!["sif", "import", &il],
        vec!["sif", "prove", &il],
        vec!["explain", EVIL],
        vec!["init", &il],
        vec!["man", "-o", &il],
        vec!["completions", EVIL],
    ] {
        let run = petril(folder, &arguments);
        must_be_silent(&format!("{arguments:?}"), &run);
        let coloured: Vec<&str> = arguments.iter().copied().chain(["--color", "always"]).collect();
        must_be_coloured(&format!("{arguments:?}"), &petril(folder, &coloured));
    }
}

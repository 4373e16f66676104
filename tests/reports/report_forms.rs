//! The forms of a report, against their schemas: JSON against the project's own; JUnit and SARIF, if `PETRIL_SCHEMAS` names a
//! folder with `sarif.json` and `junit-*.xsd`, against those that are published. CSV is read back.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use petril::exchange::{Checked, Provenance, Stamp, html, sarif};
use petril::source::Source;
use serde_json::Value;
use support::forms::{EXAMPLES, example, root, schema, situations};
use support::process::{Run, petril, run};

fn read_json(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

fn json(run: &Run) -> Value {
    serde_json::from_str(&run.stdout).unwrap_or_else(|e| panic!("{e}\n{}", run.stdout))
}

fn must_be_valid(schema: &jsonschema::Validator, document: &Value, what: &str) {
    let errors: Vec<String> =
        schema.iter_errors(document).map(|error| format!("{}: {error}", error.instance_path())).collect();
    assert!(errors.is_empty(), "{what}\n{}", errors.join("\n"));
}

/// Everything that is checked here, with its exit code if that is known.
fn all() -> Vec<(Option<i32>, Vec<String>)> {
    let examples = EXAMPLES.iter().map(|(program, plant)| (None, example(program, plant)));
    examples.chain(situations().into_iter().map(|(code, arguments)| (Some(code), arguments))).collect()
}

#[test]
fn json_is_as_the_schema_says() {
    let schema = schema("report");
    for (code, mut arguments) in all() {
        arguments.push("--json".to_owned());
        let run = petril(&root(), &arguments);
        let (what, document) = (arguments.join(" "), json(&run));
        assert!(code.is_none_or(|code| code == run.code), "{what}: {}\n{}", run.code, run.stderr);
        must_be_valid(&schema, &document, &what);
        let verdict = document["verdict"].as_str().unwrap();
        let expected = ["holds", "violated", "error", "unknown"][run.code as usize];
        assert_eq!(verdict, expected, "{what}");
    }
}

/// The last scan line by line is the run of an interpreter: in each line CR and what is written are worked out by hand.
#[test]
fn the_last_scan_is_told_line_by_line() {
    let folder = tempfile::tempdir().unwrap();
    let text =
        "PROGRAM p\nVAR_INPUT a : BOOL; END_VAR\nVAR_OUTPUT q, r : BOOL; END_VAR\nLDN a\nST q\nS r\nR q\nEND_PROGRAM\n";
    fs::write(folder.path().join("p.il"), text).unwrap();
    let run = petril(folder.path(), &["check", "p.il", "-r", "AG !r", "--json", "--by-line"]);
    let document = json(&run);
    must_be_valid(&schema("report"), &document, "by line");
    let lines = document["requirements"][0]["trace"]["last_scan"].as_array().unwrap();
    let told: Vec<String> = lines
        .iter()
        .map(|line| {
            let writes = &line["writes"];
            format!(
                "{} {} {} {} {}",
                line["source_line"], line["instruction"], line["result"], writes["variable"], writes["changed"]
            )
        })
        .collect();
    // With a = 0 at power-on: CR is 1, q becomes 1, r becomes 1, q becomes 0.
    assert_eq!(
        told,
        [
            "4 \"LDN a\" true null null",
            "5 \"ST q\" true \"q\" true",
            "6 \"S r\" true \"r\" true",
            "7 \"R q\" true \"q\" true",
        ]
    );
}

/// Two addresses that may be one place, a transition that never fires, a requirement about the first scan: each stands in every form of
/// the report, not only among the messages of the command.
#[test]
fn what_a_verdict_rests_on_stands_in_every_form() {
    let folder = tempfile::tempdir().unwrap();
    let program = "PROGRAM p\nVAR_INPUT a : BOOL; END_VAR\nVAR w AT %MW1 : WORD; b AT %MB1 : BYTE; END_VAR\n\
                   VAR_OUTPUT q : BOOL; END_VAR\nLD 16#FF\nST w\nLD b\nEQ 0\nAND a\nST q\nEND_PROGRAM\n";
    let plant = "net n\npl {a=0} (1)\ntr on {a=0} -> {a=1}\ntr off {a=1} never -> {a=0}\n";
    fs::write(folder.path().join("p.il"), program).unwrap();
    fs::write(folder.path().join("n.net"), plant).unwrap();
    let check = ["check", "p.il", "--plant", "n.net", "-r", "!q | a"];
    let files = ["--junit", "f.xml", "--sarif", "f.sarif", "--csv", "f.csv", "--html", "f.html"];
    let told = petril(folder.path(), &[&check[..], &files[..]].concat());
    let json = petril(folder.path(), &[&check[..], &["--json"]].concat());
    assert_eq!((told.code, json.code), (0, 0), "{}", told.stderr);
    let mut forms = vec![("text", told.stdout), ("json", json.stdout)];
    forms.extend(
        files[1..].iter().step_by(2).map(|file| (*file, fs::read_to_string(folder.path().join(file)).unwrap())),
    );
    for (form, text) in &forms {
        let plain = text.replace("&apos;", "'").replace("\\\"", "\"").replace("\\u0026", "&");
        for part in [
            "every address is a place of its own, though on some controllers, `%MB1` lies in the same place as `%MW1`",
            "`n.off` never fires: nothing enables it",
            "it speaks of the end of the first scan only; for every scan, write `AG (!q | a)`",
        ] {
            assert!(plain.contains(part), "{form} lacks {part}\n{text}");
        }
        if *form != "text" {
            for code in ["W0227", "W0413", "W0512"] {
                assert!(text.contains(code), "{form} lacks {code}\n{text}");
            }
        }
    }
}

/// Runs a check that writes every form, and gives the folder with the files.
fn forms(arguments: &[String]) -> (Run, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let mut arguments = arguments.to_vec();
    for (option, file) in [
        ("--junit", "junit.xml"),
        ("--sarif", "report.sarif"),
        ("--csv", "report.csv"),
        ("--trace-csv", "traces"),
        ("--vcd", "waves"),
        ("--html", "report.html"),
    ] {
        arguments.extend([option.to_owned(), folder.path().join(file).display().to_string()]);
    }
    (petril(&root(), &arguments), folder)
}

fn schemas() -> Option<PathBuf> {
    let folder = std::env::var_os("PETRIL_SCHEMAS").map(PathBuf::from);
    if folder.is_none() {
        eprintln!("PETRIL_SCHEMAS is not set: JUnit and SARIF are not held against the published schemas");
    }
    folder
}

#[test]
fn every_form_is_valid_and_says_the_same() {
    let sarif_schema = schemas().map(|folder| {
        let mut schema = read_json(&folder.join("sarif.json"));
        // Languages are no members of ours, and their pattern, as it was published, is a regular expression only in JavaScript.
        for definition in ["run", "toolComponent"] {
            let language = &mut schema["definitions"][definition]["properties"]["language"];
            language.as_object_mut().unwrap().remove("pattern");
        }
        jsonschema::validator_for(&schema).unwrap()
    });
    for (_, arguments) in all() {
        let (run, folder) = forms(&arguments);
        let what = arguments.join(" ");
        if run.code == 2 {
            assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "{what}: files in spite of an error");
            continue;
        }
        let report = json(&petril(&root(), &[arguments, vec!["--json".to_owned()]].concat()));
        let answers: Vec<Value> =
            ["requirements", "checks"].iter().flat_map(|list| report[list].as_array().unwrap().clone()).collect();
        let with = |verdict: &str| answers.iter().filter(|answer| answer["verdict"] == verdict).count();

        let sarif = read_json(&folder.path().join("report.sarif"));
        if let Some(schema) = &sarif_schema {
            must_be_valid(schema, &sarif, &what);
        }
        sarif_agrees(&sarif, &answers, &what);

        let junit = fs::read_to_string(folder.path().join("junit.xml")).unwrap();
        let document = roxmltree::Document::parse(&junit).unwrap();
        let count = |name: &str| document.descendants().filter(|node| node.has_tag_name(name)).count();
        assert_eq!(
            (count("testcase"), count("failure"), count("error")),
            (answers.len(), with("violated"), with("unknown"))
        );
        if let Some(schemas) = schemas() {
            validate_xml(&folder.path().join("junit.xml"), &schemas, &what);
        }

        let mut csv = csv::Reader::from_path(folder.path().join("report.csv")).unwrap();
        let rows = csv.records().map(Result::unwrap);
        let (rows, said): (Vec<_>, Vec<_>) = rows.partition(|row| ["requirement", "check"].contains(&&row[0]));
        assert_eq!(rows.len(), answers.len(), "{what}");
        let of_kind = |kind: &str| said.iter().filter(|row| &row[0] == kind).map(|row| row[10].to_owned()).collect();
        let assumed: Vec<String> = of_kind("assumption");
        assert_eq!(Value::from(assumed), report["assumptions"], "{what}");
        let warned: Vec<String> = of_kind("warning");
        assert_eq!(warned.len(), report["diagnostics"].as_array().unwrap().len(), "{what}");
        for (row, answer) in rows.iter().zip(&answers) {
            assert_eq!((&row[1], &row[2]), (answer["name"].as_str().unwrap(), answer["verdict"].as_str().unwrap()));
            assert_eq!(&row[12], answer["formula"].as_str().unwrap());
        }
        let files = |name: &str| fs::read_dir(folder.path().join(name)).unwrap().count();
        let scans = |answer: &&Value| answer["verdict"] == "violated" && answer["trace"]["kind"] == "scans";
        assert_eq!(files("traces"), with("violated"), "{what}");
        assert_eq!(files("waves"), answers.iter().filter(scans).count(), "{what}");
    }
}

fn sarif_agrees(sarif: &Value, answers: &[Value], what: &str) {
    let run = &sarif["runs"][0];
    let rules = run["tool"]["driver"]["rules"].as_array().unwrap();
    assert_eq!(rules.len(), answers.len());
    let results = run["results"].as_array().unwrap();
    let open: Vec<&Value> = answers.iter().filter(|answer| answer["verdict"] != "holds").collect();
    assert_eq!(results.len(), open.len(), "{what}");
    for (result, answer) in results.iter().zip(open) {
        assert_eq!(result["ruleId"], answer["name"]);
        assert_eq!(rules[result["ruleIndex"].as_u64().unwrap() as usize]["id"], answer["name"]);
        assert_eq!(result["kind"], if answer["verdict"] == "violated" { "fail" } else { "open" });
        if answer["verdict"] == "violated" && answer["trace"]["kind"] == "scans" {
            let flow = &result["codeFlows"][0]["threadFlows"][0]["locations"];
            assert!(!flow.as_array().unwrap().is_empty(), "{what}: {result:#}");
        }
    }
}

fn validate_xml(file: &Path, schemas: &Path, what: &str) {
    let found = fs::read_dir(schemas).unwrap().map(|entry| entry.unwrap().path());
    let found: Vec<PathBuf> = found.filter(|path| path.extension().is_some_and(|ending| ending == "xsd")).collect();
    assert!(!found.is_empty());
    for schema in found {
        let mut command = Command::new("xmllint");
        command.arg("--noout").arg("--schema").args([&schema, file]);
        let run = run(command);
        assert_eq!(run.code, 0, "{what}: {}\n{}", schema.display(), run.stderr);
    }
}

/// The inputs of a counterexample, fed to the simulation, give its outputs again.
#[test]
fn the_inputs_of_a_counterexample_can_be_simulated() {
    let mut simulated = 0;
    for (program, plant) in EXAMPLES {
        let (_, folder) = forms(&example(program, plant));
        let report = json(&petril(&root(), &[example(program, plant), vec!["--json".to_owned()]].concat()));
        for answer in report["requirements"].as_array().unwrap().iter().filter(|a| a["verdict"] == "violated") {
            let name = answer["name"].as_str().unwrap();
            let table = folder.path().join("traces").join(format!("{name}.csv")).display().to_string();
            let file = format!("examples/{program}.il");
            let run = petril(&root(), &["simulate", &file, "--inputs", &table, "--format", "csv"]);
            let mut reader = csv::Reader::from_reader(run.stdout.as_bytes());
            let head = reader.headers().unwrap().clone();
            let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
            let scans = answer["trace"]["scans"].as_array().unwrap();
            assert_eq!(rows.len(), scans.len(), "{program} {name}: {}", run.stderr);
            for (row, scan) in rows.iter().zip(scans) {
                for group in ["inputs", "memory", "outputs"] {
                    for (variable, value) in scan[group].as_object().unwrap() {
                        let column = head.iter().position(|name| name == variable).unwrap();
                        let number = value.as_bool().map_or_else(|| value.to_string(), |v| u8::from(v).to_string());
                        assert_eq!(row[column], number, "{program} {name}: {variable} in scan {}", scan["scan"]);
                        simulated += 1;
                    }
                }
            }
        }
    }
    assert!(simulated > 100, "{simulated}");
}

#[test]
fn two_forms_do_not_share_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("report").display().to_string();
    let mut arguments = example("latching-starter", "latching-starter");
    arguments.extend(["--csv", &file, "--sarif", &file].map(str::to_owned));
    let run = petril(&root(), &arguments);
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("give each form a file of its own"), "{}", run.stderr);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

/// Five hundred requirements with long runs make a page that can still be mailed.
#[test]
fn a_page_stays_small() {
    let read = |file: &str| fs::read_to_string(root().join(file)).unwrap();
    let program = read("examples/star-delta-broken.il");
    let system = support::systems::system(&program, &[&read("nets/star-delta.net")]);
    let mut report = support::reports::report(&system, &read("examples/star-delta.req"));
    report.answers = report.answers.iter().cycle().take(500).cloned().collect();
    for (i, answer) in report.answers.iter_mut().enumerate() {
        answer.name = format!("{}_{i}", answer.name);
    }
    let source = Source::new("star-delta-broken.il", program);
    let checked = Checked { system: &system, source: &source, report: &report, provenance: &Provenance::default() };
    let page = html::write(&checked, Stamp::default());
    assert!(page.len() < 5_000_000, "{} bytes", page.len());
    for answer in &report.answers {
        assert!(page.contains(&format!("<h2>{}: {}</h2>", answer.outcome.verdict().word(), answer.name)));
    }
    assert!(sarif::write(&checked, Stamp::default()).to_string().len() < 10_000_000);
}

/// Names of requirements are user text, wherever they go.
#[test]
fn what_users_write_cannot_break_a_form() {
    let folder = tempfile::tempdir().unwrap();
    let text = "PROGRAM p\nVAR_INPUT a : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\nLD a\nST q\nEND_PROGRAM\n";
    fs::write(folder.path().join("a & b <c>.il"), text).unwrap();
    let sentence = "</script><img src=x onerror=alert(1)> ]]> \u{1} & ; , =1+1";
    fs::write(folder.path().join("r.req"), format!("requirement x \"{sentence}\": AG !q;")).unwrap();
    let arguments =
        ["check", "a & b <c>.il", "--require", "r.req", "--junit", "j.xml", "--sarif", "s.json", "--csv", "c.csv"];
    let run = petril(folder.path(), &[&arguments[..], &["--html", "h.html"]].concat());
    assert_eq!(run.code, 1, "{}", run.stderr);
    let junit = fs::read_to_string(folder.path().join("j.xml")).unwrap();
    let document = roxmltree::Document::parse(&junit).unwrap();
    let failure = document.descendants().find(|node| node.has_tag_name("failure")).unwrap();
    assert!(failure.text().unwrap().contains("</script><img src=x onerror=alert(1)> ]]>"));
    // People read this, too.
    let shown = sentence.replace('\u{1}', "\\u{1}");
    let sarif = read_json(&folder.path().join("s.json"));
    assert_eq!(sarif["runs"][0]["tool"]["driver"]["rules"][0]["shortDescription"]["text"], shown);
    assert_eq!(sarif["runs"][0]["artifacts"][0]["location"]["uri"], "a%20%26%20b%20%3Cc%3E.il");
    let mut csv = csv::Reader::from_path(folder.path().join("c.csv")).unwrap();
    assert_eq!(&csv.records().next().unwrap().unwrap()[10], shown);
    let html = fs::read_to_string(folder.path().join("h.html")).unwrap();
    assert!(!html.contains("<img"), "the sentence is markup");
}

/// An assumption, a warning and a requirement, each with the words of the command.
#[test]
fn every_row_of_a_table_says_where_it_comes_from() {
    let folder = tempfile::tempdir().unwrap();
    let text = "PROGRAM p\nVAR_INPUT a : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\nLD a\nST q\nEND_PROGRAM\n";
    fs::write(folder.path().join("p.il"), text).unwrap();
    let run = petril(folder.path(), &["check", "p.il", "-r", "!q | a", "--csv", "f.csv"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let mut table = csv::Reader::from_path(folder.path().join("f.csv")).unwrap();
    let heads = table.headers().unwrap().clone();
    let column = |name| heads.iter().position(|head| head == name).unwrap();
    let [kind, tool, inputs, options, command] = ["kind", "tool", "inputs", "options", "command"].map(column);
    let mut kinds = Vec::new();
    for row in table.records() {
        let row = row.unwrap();
        assert!(row[tool].starts_with("petril 0."), "{row:?}");
        assert!(row[inputs].starts_with("p.il ") && row[inputs].len() == "p.il ".len() + 64, "{row:?}");
        assert_eq!(row[options].len(), 64, "{row:?}");
        assert_eq!(&row[command], "petril check p.il -r '!q | a' --csv f.csv");
        kinds.push(row[kind].to_owned());
    }
    kinds.dedup();
    assert_eq!(kinds, ["requirement", "check", "assumption", "warning"]);
}

#[cfg(unix)]
#[test]
fn texts_about_nets_say_in_a_file_where_they_come_from() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("n.net"), "pl a (1)\ntr t a -> b\n").unwrap();
    for (verb, options) in
        [("info", ""), ("explore", ""), ("check", "-r 'EF marked(\"b\")'"), ("reduce", "--keep b -o m.net")]
    {
        let command = format!("net {verb} n.net {options}");
        let mut shell = Command::new("sh");
        shell.args(["-c", &format!("\"$0\" {command} > f.txt"), env!("CARGO_BIN_EXE_petril")]);
        let ran = run({
            shell.current_dir(folder.path());
            shell
        });
        assert_eq!(ran.code, 0, "{verb}: {}", ran.stderr);
        let text = fs::read_to_string(folder.path().join("f.txt")).unwrap();
        let command = format!("\ncommand: petril {}\n", command.trim());
        for part in ["\nmade by: petril 0.", &command, "\ninput: n.net, sha256 ", "\noptions: sha256 "] {
            assert!(text.contains(part), "{verb} lacks {part}\n{text}");
        }
        let words = text.lines().find_map(|line| line.strip_prefix("command: petril ")).unwrap();
        let mut again = Command::new("sh");
        again.args(["-c", &format!("\"$0\" {words}"), env!("CARGO_BIN_EXE_petril")]).current_dir(folder.path());
        let piped = run(again).stdout;
        assert!(!piped.contains("made by"), "{verb}\n{piped}");
        assert_eq!(text.strip_prefix(&piped).map(|rest| rest.starts_with("\nmade by: ")), Some(true), "{verb}\n{text}");
    }
}

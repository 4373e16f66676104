//! Tests of safety functions in their forms: JSON against its schema, JUnit against the published ones if `PETRIL_SCHEMAS` names
//! them, tables read back, and the protocol as a page, which needs `PETRIL_BROWSER` and `chromedriver` to be opened.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use base64::Engine as _;
use serde_json::{Value, json};
use support::browser::Browser;
use support::forms::{root, schema};
use support::process::{Run, petril, run};
use support::sif_system::{LARGE, made};

const F1: [&str; 2] = ["examples/beam-interlock.sif", "examples/beam-interlock.il"];
const BROKEN: [&str; 2] = ["examples/beam-interlock.sif", "examples/beam-interlock-broken.il"];

/// Latches, delays, an address, a function that uses another one, and outputs that the program does not have.
const OVEN: [&str; 2] = ["tests/forms/oven.sif", "tests/forms/oven.il"];

/// A run of tests that writes every form, and the folder with the files.
fn forms(what: &[&str]) -> (Run, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let mut arguments = [&["sif", "run"], what].concat().into_iter().map(str::to_owned).collect::<Vec<_>>();
    for (option, file) in [("--html", "protocol.html"), ("--junit", "junit.xml"), ("--csv", "results.csv")] {
        arguments.extend([option.to_owned(), folder.path().join(file).display().to_string()]);
    }
    arguments.push("--json".to_owned());
    (petril(&root(), &arguments), folder)
}

fn situations() -> Vec<(i32, Vec<&'static str>)> {
    vec![
        (0, [&F1[..], &["--criterion", "all", "--mutants"]].concat()),
        (0, [&F1[..], &["--criterion", "pairs", "--continue"]].concat()),
        (1, [&BROKEN[..], &["--criterion", "faults", "--function", "f1"]].concat()),
        (0, [&OVEN[..], &["--criterion", "mcdc"]].concat()),
        (0, [&OVEN[..], &["--continue", "--mutants"]].concat()),
        (2, [&OVEN[..], &["--function", "nothing"]].concat()),
        (2, vec![F1[0], OVEN[1]]),
        (2, vec!["tests/forms/gate.il", OVEN[1]]),
    ]
}

fn json(run: &Run) -> Value {
    serde_json::from_str(&run.stdout).unwrap_or_else(|e| panic!("{e}\n{}\n{}", run.stdout, run.stderr))
}

#[test]
fn every_form_is_valid_and_says_the_same() {
    let schema = schema("sif-tests");
    for (code, arguments) in situations() {
        let (made, folder) = forms(&arguments);
        let what = arguments.join(" ");
        assert_eq!(made.code, code, "{what}\n{}", made.stderr);
        let document = json(&made);
        let errors: Vec<String> =
            schema.iter_errors(&document).map(|error| format!("{}: {error}", error.instance_path())).collect();
        assert!(errors.is_empty(), "{what}\n{}", errors.join("\n"));
        assert_eq!(document["verdict"], ["passed", "failed", "error"][code as usize], "{what}");
        if code == 2 {
            assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "{what}: files in spite of an error");
            continue;
        }
        let functions = document["functions"].as_array().unwrap();
        let tests: Vec<&Value> = functions.iter().flat_map(|f| f["tests"].as_array().unwrap()).collect();
        let with = |verdict: &str| tests.iter().filter(|test| test["result"]["verdict"] == verdict).count();
        assert!(!tests.is_empty());
        assert_eq!(document["run"]["passed"], with("passed"));

        let junit = folder.path().join("junit.xml");
        let text = fs::read_to_string(&junit).unwrap();
        let parsed = roxmltree::Document::parse(&text).unwrap();
        let count = |name: &str| parsed.descendants().filter(|node| node.has_tag_name(name)).count();
        assert_eq!((count("testsuite"), count("testcase")), (functions.len(), tests.len()), "{what}");
        assert_eq!((count("failure"), count("error")), (with("failed"), with("error")), "{what}");
        if let Some(schemas) = std::env::var_os("PETRIL_SCHEMAS") {
            let schemas = fs::read_dir(schemas).unwrap().map(|entry| entry.unwrap().path());
            for schema in schemas.filter(|path| path.extension().is_some_and(|end| end == "xsd")) {
                let mut command = Command::new("xmllint");
                command.arg("--noout").arg("--schema").args([&schema, &junit]);
                let checked = run(command);
                assert_eq!(checked.code, 0, "{what}: {}\n{}", schema.display(), checked.stderr);
            }
        }

        let mut table = csv::Reader::from_path(folder.path().join("results.csv")).unwrap();
        let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
        let results: Vec<&str> = tests.iter().map(|test| test["result"]["verdict"].as_str().unwrap()).collect();
        assert_eq!(rows.iter().map(|row| &row[2]).collect::<Vec<_>>(), results, "{what}");

        let page = fs::read_to_string(folder.path().join("protocol.html")).unwrap();
        assert_eq!(page.matches("<tbody><tr><th scope=\"row\">").count(), with("passed"), "{what}");
        assert_eq!(page.matches("<tbody class=\"not-passed\">").count(), tests.len() - with("passed"), "{what}");
        assert_eq!(page.matches("box on passed").count(), with("passed"), "{what}");
        assert!(!page.contains("<script") && !page.contains("http://") && !page.contains("https://"));
    }
}

/// What people wrote is text wherever it goes.
#[test]
fn hostile_texts_are_only_texts() {
    let folder = tempfile::tempdir().unwrap();
    let evil = "</style><img src=x onerror=alert(1)> <b>&amp; ]]> \u{1} {{x}} =1+1";
    let specification = format!(
        "system \"{evil}\"; zone Z \"{evil}\" {{ function F \"{evil}\" {{ informal {{ hazard: \"{evil}\"; }}
         interface {{ input a \"{evil}\"; output q \"{evil}\"; }}
         formal {{ q = a; restriction R \"{evil}\": always a | !a; }} }} }}"
    );
    fs::write(folder.path().join("s & <i>.sif"), specification).unwrap();
    let program = "PROGRAM p\nVAR_INPUT a : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\nLDN a\nST q\nEND_PROGRAM\n";
    fs::write(folder.path().join("p <u>.il"), program).unwrap();
    let files = ["--html", "h.html", "--junit", "j.xml", "--csv", "c.csv"];
    let made = petril(folder.path(), &[&["sif", "run", "s & <i>.sif", "p <u>.il", "--json"][..], &files].concat());
    assert_eq!(made.code, 1, "{}", made.stderr);
    assert_eq!(json(&made)["system"], evil);
    let page = fs::read_to_string(folder.path().join("h.html")).unwrap();
    for markup in ["<img", "<b>&amp;", "<i>", "<u>", "\u{1}"] {
        assert!(!page.contains(markup), "{markup}");
    }
    assert_eq!(page.matches("</style>").count(), 1);
    assert!(page.contains("&lt;img src=x onerror=alert(1)&gt;"));
    roxmltree::Document::parse(&fs::read_to_string(folder.path().join("j.xml")).unwrap()).unwrap();
    let Some(browser) = Browser::start() else { return };
    browser.open(&folder.path().join("h.html"));
    let shown = browser
        .run("return [document.querySelector('h1').textContent, document.querySelectorAll('img, b, i, u').length]");
    let line = evil.replace('\u{1}', "\\u{1}");
    // One word is in bold letters: the result.
    assert_eq!(shown, json!([line, 1]));
}

/// Written for the page and opened there.
fn page(folder: &Path, name: &str, arguments: &[&str]) -> PathBuf {
    let file = folder.join(format!("{name}.html"));
    let made = petril(&root(), &[&["sif", "run"], arguments, &["--html", &file.display().to_string()]].concat());
    assert_ne!(made.code, 2, "{}", made.stderr);
    file
}

/// Nothing is fetched, nothing is said on the console, nothing is wider than a phone, and on paper every test is whole, with
/// the head of its table above it.
#[test]
fn the_protocol_fits_screens_and_paper() {
    let Some(browser) = Browser::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let large = made(LARGE, 7);
    let (specification, program) = (folder.path().join("large.sif"), folder.path().join("large.il"));
    fs::write(&specification, &large.specification).unwrap();
    fs::write(&program, &large.program).unwrap();
    let text = |path: &PathBuf| path.display().to_string();
    let one = large.specification.split("function ").nth(1).unwrap().split_whitespace().next().unwrap().to_owned();
    let pages = [
        page(folder.path(), "f1", &[&F1[..], &["--criterion", "all", "--mutants"]].concat()),
        page(folder.path(), "broken", &[&BROKEN[..], &["--criterion", "all-both"]].concat()),
        page(folder.path(), "oven", &OVEN),
        page(folder.path(), "large", &[&text(&specification), &text(&program), "--function", &one]),
    ];
    for file in &pages {
        let what = file.display();
        for width in [360, 1280] {
            browser.resize(width, 740);
            browser.open(file);
            let wide = browser.run("return document.documentElement.scrollWidth");
            assert!(wide.as_u64().unwrap() <= u64::from(width), "{what}: {wide} of {width}");
        }
        assert_eq!(browser.console(), Vec::<String>::new(), "{what}");
        let fetched = browser.run("return performance.getEntriesByType('resource').map((entry) => entry.name)");
        assert_eq!(fetched, json!([]), "{what}");
        let colours = |theme: &str| {
            let feature = json!({ "features": [{ "name": "prefers-color-scheme", "value": theme }] });
            browser.devtools("Emulation.setEmulatedMedia", &feature);
            browser.run("const style = getComputedStyle(document.body); return [style.backgroundColor, style.color]")
        };
        assert_ne!(colours("light"), colours("dark"), "{what}");
        let options = json!({ "preferCSSPageSize": true, "printBackground": true });
        let printed = browser.devtools("Page.printToPDF", &options);
        let bytes = base64::engine::general_purpose::STANDARD.decode(printed["data"].as_str().unwrap()).unwrap();
        let paper = file.with_extension("pdf");
        fs::write(&paper, &bytes).unwrap();
        let mut command = Command::new("pdftotext");
        command.arg("-layout").arg(&paper).arg("-");
        let paper = run(command).stdout;
        let sheets: Vec<&str> = paper.split('\u{C}').filter(|page| !page.trim().is_empty()).collect();
        // A cover, a data sheet and a sheet of tests at least.
        assert!(sheets.len() >= 3, "{what}: {} pages", sheets.len());
        let boxes = |page: &&&str| page.contains("inputs to set");
        assert!(sheets.iter().filter(boxes).all(|page| page.contains("Remark") && page.contains("passed")), "{what}");
    }
}

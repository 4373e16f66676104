//! The report as a page, in a real browser: needs `PETRIL_BROWSER` (the path of Chromium) and `chromedriver`.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use support::browser::Browser;
use support::forms::{EXAMPLES, example, root, situations};
use support::process::petril;

/// WebDriver's codes of keys.
const LEFT: char = '\u{E012}';
const RIGHT: char = '\u{E014}';

/// Makes the page of a check in a folder, and gives its file and the report as JSON.
fn page(folder: &Path, arguments: &[String]) -> (PathBuf, Value) {
    let file = folder.join("report.html");
    let more = ["--html", &file.display().to_string(), "--json", "--by-line"].map(str::to_owned);
    let own: Vec<String> = arguments.iter().filter(|argument| *argument != "--by-line").cloned().collect();
    let run = petril(&root(), &[&own[..], &more].concat());
    assert_ne!(run.code, 2, "{}", run.stderr);
    (file, serde_json::from_str(&run.stdout).unwrap())
}

fn words(arguments: &str) -> Vec<String> {
    arguments.split(' ').map(str::to_owned).collect()
}

/// The page says nothing on the console and fetches nothing.
fn assert_quiet(browser: &Browser, what: &str) {
    assert_eq!(browser.console(), Vec::<String>::new(), "{what}");
    let fetched = browser.run("return performance.getEntriesByType('resource').map((entry) => entry.name)");
    assert_eq!(fetched, json!([]), "{what}");
}

/// Every answer is on the page with its verdict, whatever was checked, and nothing is wider than a phone.
#[test]
fn pages_open_from_a_file_without_network_and_fit_a_phone() {
    let Some(browser) = Browser::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let examples = EXAMPLES.iter().map(|(program, plant)| example(program, plant));
    let others = situations().into_iter().filter(|(code, _)| *code != 2).map(|(_, arguments)| arguments);
    for arguments in examples.chain(others) {
        let what = arguments.join(" ");
        let (file, report) = page(folder.path(), &arguments);
        browser.resize(360, 740);
        browser.open(&file);
        let shown = browser.run(
            "return [...document.querySelectorAll('.answer')].map((e) => [e.dataset.name, e.dataset.verdict]).sort()",
        );
        let lists = ["requirements", "checks"].into_iter().flat_map(|list| report[list].as_array().unwrap());
        let mut expected: Vec<Value> = lists.map(|answer| json!([answer["name"], answer["verdict"]])).collect();
        expected.sort_by_key(|pair| pair[0].as_str().unwrap().to_owned());
        assert_eq!(shown, Value::Array(expected), "{what}");
        browser.run("for (const head of document.querySelectorAll('.answer-head[aria-expanded=false]')) head.click()");
        browser.wait_for("document.querySelectorAll('.answer-panel[hidden]').length === 0");
        for width in [360, 1280] {
            browser.resize(width, 740);
            let wide = browser.run("return document.documentElement.scrollWidth");
            assert!(wide.as_u64().unwrap() <= u64::from(width), "{what}: {wide} of {width}");
        }
        assert_quiet(&browser, &what);
    }
}

/// What the page shows of the moment it is at.
fn moment(browser: &Browser) -> Value {
    browser.run(
        "const stage = document.querySelector('.answer.open .stage');
         const one = (selector) => stage.querySelector(selector);
         const marked = (net) => Object.fromEntries([...stage.querySelectorAll(net + ' [data-place]')]
             .map((token) => [token.dataset.place, token.classList.contains('on')]));
         const cursor = one('.cursor').getAttribute('transform').match(/[\\d.]+/)[0];
         return {
             tick: Number(stage.dataset.tick), scan: stage.dataset.scan, kind: stage.dataset.kind,
             line: one('.source-line.now')?.dataset.line ?? null,
             notes: [...(one('.source-line.now .left')?.children ?? [])].map((note) => note.textContent),
             row: one('.run-table [aria-current]').dataset.scan,
             column: Number(cursor) / one('.waves').getAttribute('width') * stage.querySelectorAll('.run-table tbody tr').length,
             values: Object.fromEntries([...stage.querySelectorAll('.lane-name')]
                 .map((lane) => [lane.querySelector('.name').textContent, lane.querySelector('.value').textContent])),
             instruction: marked('.instruction'), cycle: marked('.cycle'),
             slider: Number(one('input[type=range]').value), where: one('.where').textContent,
         };",
    )
}

/// A value as the page writes it.
fn text(value: &Value) -> String {
    value.as_bool().map_or_else(|| value.to_string(), |value| u8::from(value).to_string())
}

/// One key moves source line, table row, cursor and tokens together, to where the interpreter was.
#[test]
fn stepping_moves_everything_together() {
    let Some(browser) = Browser::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let (file, report) = page(folder.path(), &example("two-hand-switch", "two-hand-switch"));
    let answer = report["requirements"].as_array().unwrap().iter().find(|a| a["verdict"] == "violated").unwrap();
    browser.open(&file);
    // The only requirement that is violated is open, where the value was written that breaks it.
    let writer = answer["why"]["writers"].as_array().unwrap().last().unwrap();
    let first = moment(&browser);
    assert_eq!((text(&first["line"]), &first["scan"]), (format!("\"{}\"", writer["source_line"]), &json!("2")));

    // To the beginning of the last scan, which is told line by line in JSON.
    let scans = answer["trace"]["scans"].as_array().unwrap();
    browser.click(".stage .bar button[aria-label^='One scan back']");
    let begin = moment(&browser);
    assert_eq!((&begin["kind"], &begin["row"]), (&json!("begin"), &json!("2")));
    let mut values: BTreeMap<String, String> = BTreeMap::new();
    for group in ["inputs", "memory", "outputs"] {
        let scan = if group == "inputs" { &scans[scans.len() - 1] } else { &scans[scans.len() - 2] };
        values.extend(scan[group].as_object().unwrap().iter().map(|(name, value)| (name.clone(), text(value))));
    }
    assert_eq!(begin["values"], json!(values));
    assert_eq!(begin["cycle"]["line_1"], true, "control is at the first line");

    let lines = answer["trace"]["last_scan"].as_array().unwrap();
    let mut column = begin["column"].as_f64().unwrap();
    for (i, executed) in lines.iter().enumerate() {
        browser.press(&[RIGHT]);
        let now = moment(&browser);
        assert_eq!(now["line"].as_str().unwrap(), executed["source_line"].to_string());
        assert_eq!(now["notes"][0], format!("CR {}", text(&executed["result"])));
        let writes = &executed["writes"];
        if let (Some(name), true) =
            (writes["variable"].as_str(), values.contains_key(writes["variable"].as_str().unwrap_or_default()))
        {
            values.insert(name.to_owned(), text(&writes["value"]));
            assert_eq!(now["notes"][1], format!("{name} := {}", text(&writes["value"])));
        }
        assert_eq!(now["values"], json!(values), "after line {}", executed["line"]);
        assert_eq!((&now["row"], &now["scan"]), (&json!("2"), &json!("2")));
        assert_eq!(
            (now["tick"].as_i64(), now["slider"].as_i64()),
            (Some(begin["tick"].as_i64().unwrap() + i as i64 + 1), now["tick"].as_i64())
        );
        assert!(now["where"].as_str().unwrap().contains(executed["instruction"].as_str().unwrap()), "{now:#}");
        let at = now["column"].as_f64().unwrap();
        assert!(column < at && at < 2.0, "the cursor goes from {column} to {at}");
        column = at;
        // The tokens: control has left the line, and each bit that is drawn has its token where its value says.
        let next = lines.get(i + 1).map_or("End".to_owned(), |next| format!("line_{}", next["line"]));
        assert_eq!(now["instruction"][&next], true, "after line {}: {now:#}", executed["line"]);
        assert_eq!(now["instruction"][&format!("line_{}", executed["line"])], false);
        for (place, marked) in now["instruction"].as_object().unwrap().iter().chain(now["cycle"].as_object().unwrap()) {
            let Some((name, bit)) = place.split_once('=').filter(|(_, bit)| !bit.contains(',')) else { continue };
            let value = if name == "CR" { Some(text(&executed["result"])) } else { values.get(name).cloned() };
            if let Some(value) = value {
                assert_eq!(marked, value == bit, "{place} after line {}", executed["line"]);
            }
        }
    }
    browser.press(&[RIGHT]);
    let end = moment(&browser);
    assert_eq!((&end["kind"], &end["cycle"]["idle"]), (&json!("end"), &json!(true)));
    browser.press(&[RIGHT]);
    assert_eq!(moment(&browser), end, "behind the end there is nothing");
    browser.press(&[LEFT]);
    let back = moment(&browser);
    assert_eq!(back["tick"].as_i64().unwrap() + 1, end["tick"].as_i64().unwrap());
    assert_eq!(back["cycle"]["End"], true, "tokens go back, too");
    // A click on a row, and on the diagram.
    browser.click(".run-table tr[data-scan='1'] button");
    assert_eq!(moment(&browser)["scan"], "1");
    browser.run("document.querySelector('.waves').scrollIntoView({block: 'center'})");
    browser.click(".waves");
    let middle = moment(&browser);
    assert!((0.9..1.1).contains(&middle["column"].as_f64().unwrap()), "{middle:#}");
    assert_quiet(&browser, "stepping");
}

/// The play button goes on by itself and stops at the end.
#[test]
fn runs_play_by_themselves() {
    let Some(browser) = Browser::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("p.il"), "PROGRAM p\nVAR_OUTPUT q : BOOL; END_VAR\nLD TRUE\nST q\nEND_PROGRAM\n")
        .unwrap();
    let program = folder.path().join("p.il").display().to_string();
    let (file, _) = page(folder.path(), &["check", &program, "-r", "AG !q"].map(str::to_owned));
    browser.open(&file);
    browser.click(".bar .main");
    browser.wait_for("document.querySelector('.bar .main').getAttribute('aria-label') === 'Pause'");
    browser.wait_for("document.querySelector('.bar .main').getAttribute('aria-label') === 'Play'");
    assert_eq!(moment(&browser)["kind"], "end");
    assert_quiet(&browser, "playing");
}

/// In the transition view each step is a firing; control has one token all the time.
#[test]
fn firings_are_stepped_through_too() {
    let Some(browser) = Browser::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut arguments =
        words("check examples/two-hand-switch.il --plant nets/two-hand-switch.net --view transition -r");
    arguments.push("AG !at line 3".to_owned());
    let (file, report) = page(folder.path(), &arguments);
    browser.open(&file);
    let firings = report["requirements"][0]["trace"]["firings"].as_array().unwrap();
    for firing in firings.iter().rev() {
        let shown = browser.run(
            "const stage = document.querySelector('.answer.open .stage');
             const fired = [...stage.querySelectorAll('.box.fired title')].map((title) => title.textContent);
             return [stage.querySelector('.run-table [aria-current] .text').textContent, fired.length > 0 ? fired[0] : null,
                 stage.querySelector('.source-line.now')?.dataset.line ?? null]",
        );
        assert_eq!((&shown[0], &shown[1]), (&firing["transition"], &firing["transition"]));
        assert_eq!(shown[2].is_null(), firing["line"].is_null());
        browser.press(&[LEFT]);
    }
    let start = browser.run("return document.querySelector('.run-table [aria-current]').textContent");
    assert!(start.as_str().unwrap().contains("the initial marking"));
    let idle =
        "[...document.querySelectorAll('.cycle [data-place=idle]')].every((token) => token.classList.contains('on'))";
    assert_eq!(browser.run(&format!("return {idle}")), true);
    assert_quiet(&browser, "firings");
}

/// What narrows the list, and the colours.
#[test]
fn the_list_is_filtered_and_colours_are_chosen() {
    let Some(browser) = Browser::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let (file, report) = page(folder.path(), &example("star-delta-broken", "star-delta"));
    browser.open(&file);
    let names = || {
        let names =
            browser.run("return [...document.querySelectorAll('.answer:not([hidden])')].map((e) => e.dataset.name)");
        names.as_array().unwrap().iter().map(|name| name.as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    let violated: Vec<&str> = (report["requirements"].as_array().unwrap().iter())
        .filter(|answer| answer["verdict"] == "violated")
        .map(|answer| answer["name"].as_str().unwrap())
        .collect();
    browser.click(".filters [data-verdict=violated]");
    assert_eq!(names(), violated);
    browser.click(".filters [data-verdict=all]");
    assert_eq!(names().len(), 12);
    browser.click(".filters input");
    browser.press(&"short circuit".chars().collect::<Vec<_>>());
    assert_eq!(names(), Vec::<String>::new());
    browser.run("const field = document.querySelector('.filters input'); field.value = 'SAME TIME'; field.dispatchEvent(new Event('input'))");
    assert_eq!(names(), ["no_short_circuit", "one_coil"], "sentences are searched, in any case of letters");

    let colours =
        || browser.run("const style = getComputedStyle(document.body); return [style.backgroundColor, style.color]");
    let theme = |theme: &str| {
        let feature = json!({ "features": [{ "name": "prefers-color-scheme", "value": theme }] });
        browser.devtools("Emulation.setEmulatedMedia", &feature);
    };
    theme("light");
    let light = colours();
    theme("dark");
    let dark = colours();
    assert_ne!(light, dark, "the page follows the system");
    browser.click("[data-choice=light]");
    assert_eq!(colours(), light, "but what is chosen comes first");
    theme("light");
    browser.click("[data-choice=dark]");
    assert_eq!(colours(), dark);
    browser.click("[data-choice=auto]");
    assert_eq!(colours(), light);
    assert_quiet(&browser, "filters");
}

/// Names and sentences are user text: shown as they are, never read as markup.
#[test]
fn hostile_texts_are_only_texts() {
    let Some(browser) = Browser::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let evil = "</script><img src=x onerror='document.title=1'><svg onload=alert(1)> {{script}} <!--";
    let program = format!(
        "(* {evil} *)\nPROGRAM p\nVAR_INPUT a : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\nLD a (* {evil} *)\nST q\nEND_PROGRAM\n"
    );
    let name = "<b onclick=x>&amp;.il";
    fs::write(folder.path().join(name), program).unwrap();
    fs::write(folder.path().join("r.req"), format!("requirement x \"{evil}\":\n    AG !q;\n")).unwrap();
    let run = petril(folder.path(), &["check", name, "--require", "r.req", "--html", "h.html"]);
    assert_eq!(run.code, 1, "{}", run.stderr);
    browser.open(&folder.path().join("h.html"));
    let shown = browser.run(
        "return [document.querySelector('.answer-sentence').textContent, document.querySelector('.meta span').textContent,
             document.querySelector('.source-line code').textContent, document.querySelectorAll('img, b[onclick], [onload]').length, document.title]",
    );
    assert_eq!(shown, json!([evil, name, format!("(* {evil} *)"), 0, "p: violated"]));
    assert_quiet(&browser, "hostile texts");
}

/// A run of 2001 scans has few rows and shapes until somebody wants to see them, and then only those that can be seen.
#[test]
fn long_runs_are_folded_until_they_are_opened() {
    let Some(browser) = Browser::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let text = "PROGRAM p\nVAR_INPUT a : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\nVAR t : TON; END_VAR\n\
        CAL t(IN := a, PT := T#40s)\nLD t.Q\nST q\nEND_PROGRAM\n";
    fs::write(folder.path().join("p.il"), text).unwrap();
    let program = folder.path().join("p.il").display().to_string();
    let (file, report) = page(folder.path(), &["check", &program, "-r", "AG !q"].map(str::to_owned));
    let scans = report["requirements"][0]["trace"]["scans"].as_array().unwrap();
    assert_eq!(scans.len(), 2001, "20 ms a scan, and the clock begins to run after the first one");
    browser.open(&file);
    let rows =
        "[...document.querySelectorAll('.run-table tbody tr')].map((row) => row.dataset.scan ?? row.textContent)";
    let shown = browser.run(&format!("return {rows}"));
    assert_eq!(shown, json!(["1", "2", "… 1998 scanst.ET T#20ms → T#39s980ms …", "2001"]));
    assert!(browser.run("return document.querySelectorAll('*').length").as_u64().unwrap() < 1500);
    let heads = "[...document.querySelectorAll('.run-table thead tr:last-child th')].map((head) => head.textContent)";
    assert_eq!(browser.run(&format!("return {heads}")), json!(["a", "t.IN", "t.PT", "t.Q", "t.ET", "q"]));
    assert_eq!(browser.run("return document.querySelectorAll('.waves .folded').length"), 1);

    // Open: the rows around the place where one looks, with the values of the run.
    browser.click("tr.fold button");
    let rows = browser.run(
        "const box = document.querySelector('.table-box');
         box.scrollTop = box.scrollHeight / 2;
         return new Promise((done) => setTimeout(() => done([...document.querySelectorAll('.run-table tr[data-scan]')].map((row) =>
             [Number(row.dataset.scan), row.children[5].textContent])), 300))",
    );
    let rows = rows.as_array().unwrap();
    assert!((50..250).contains(&rows.len()), "{}", rows.len());
    for row in rows {
        let scan = row[0].as_u64().unwrap();
        let clock = scans[scan as usize - 1]["memory"]["t.ET"].as_u64().unwrap();
        let milliseconds = |text: &str| {
            let text = text.trim_start_matches("T#").trim_end_matches("ms");
            let (seconds, rest) = text.split_once('s').unwrap_or(("0", text));
            seconds.parse::<u64>().unwrap() * 1000 + rest.parse::<u64>().unwrap_or(0)
        };
        assert_eq!(milliseconds(row[1].as_str().unwrap()), clock, "scan {scan}");
    }
    assert!(rows.iter().any(|row| row[0] == 1000), "{rows:?}");
    // The present moment is still the last one, and stepping goes on from there.
    assert_eq!(moment_of(&browser), json!(["2001", null]), "its row is not where one looks");
    browser.click(".stage .bar button[aria-label^='One scan back']");
    browser.click(".stage .bar button[aria-label^='One scan back']");
    assert_eq!(moment_of(&browser), json!(["2000", "2000"]));
    browser.run("[...document.querySelectorAll('.extra button')].find((b) => b.textContent === 'fold again').click()");
    assert_eq!(browser.run("return document.querySelector('.run-table [aria-current]').className"), "fold");
    browser.click(".extra button[aria-pressed=false]:last-child");
    let all = browser.run(&format!("return {heads}"));
    assert_eq!(all, json!(["a", "t.IN", "t.PT", "t.Q", "t.ET", "t.RUNNING", "t.CLOCK", "q"]));
    assert_quiet(&browser, "a long run");
}

/// The scan of the stage, and the row that is marked.
fn moment_of(browser: &Browser) -> Value {
    browser.run(
        "return [document.querySelector('.stage').dataset.scan,
             document.querySelector('.run-table [aria-current]')?.dataset.scan ?? null]",
    )
}

/// A check that nobody asked for says what led to the error, and opens on the instruction that met it.
#[test]
fn checks_say_why_and_open_on_the_instruction() {
    let Some(browser) = Browser::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let text = "PROGRAM p\nVAR_INPUT a : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\nVAR n : SINT := 120; step : SINT; END_VAR\n\
        LD 4\nST step\nLD n\nADD step\nST n\nLD a\nST q\nEND_PROGRAM\n";
    fs::write(folder.path().join("p.il"), text).unwrap();
    let program = folder.path().join("p.il").display().to_string();
    let (file, report) = page(folder.path(), &["check", &program, "-r", "AG (q -> q)"].map(str::to_owned));
    let check = report["checks"].as_array().unwrap().iter().find(|check| check["name"] == "overflow").unwrap();
    // 120, after scan 1 it is 124, and 124 + 4 is too large.
    let wanted =
        "In scan 2, `ADD step` had to give a number from -128 to 127, but 124 + 4 is 128: `n` is 124 and `step` is 4";
    assert_eq!(check["why"]["wanted"], json!([wanted]));
    let writers: Vec<Value> = check["why"]["writers"]
        .as_array()
        .unwrap()
        .iter()
        .map(|w| json!([w["variable"], w["scan"], w["line"]]))
        .collect();
    assert_eq!(writers, [json!(["n", 1, 5]), json!(["step", 2, 2])]);
    browser.open(&file);
    let shown = browser.run(
        "return [document.querySelector('.why li').textContent, document.querySelector('.source-line.now').dataset.line,
             document.querySelector('.source-line.now .hazard').textContent, document.querySelector('.stage').dataset.scan]",
    );
    assert_eq!(shown, json!([wanted.replace('`', ""), "8", "overflow", "2"]));
    assert_quiet(&browser, "a check");
}

/// A large net opens on the variables that the requirement speaks of.
#[test]
fn nets_open_on_what_the_requirement_is_about() {
    let Some(browser) = Browser::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let names: Vec<String> = (0..12).map(|i| format!("i{i}")).collect();
    let text = format!(
        "PROGRAM p\nVAR_INPUT {} : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\nLD i11\nST q\nEND_PROGRAM\n",
        names.join(", ")
    );
    fs::write(folder.path().join("p.il"), text).unwrap();
    let program = folder.path().join("p.il").display().to_string();
    let (file, _) = page(folder.path(), &["check", &program, "-r", "AG !i11"].map(str::to_owned));
    browser.open(&file);
    let shown = browser.run(
        "const box = document.querySelector('.cycle .net-box'), frame = box.getBoundingClientRect();
         const at = document.querySelector('.cycle [data-place=\"i11=1\"]').getBoundingClientRect();
         return [box.scrollTop > 0, at.top >= frame.top && at.bottom <= frame.bottom, at.left >= frame.left && at.right <= frame.right]",
    );
    assert_eq!(shown, json!([true, true, true]));
}

//! Cover page: what was tested, how, by whom, and a list of the functions.

use sha2::{Digest as _, Sha256};

use super::markup::{code, counted, escaped, row, table};
use crate::exchange::Provenance;
use crate::exchange::sif::told::made_by;
use crate::exchange::sif::{Ran, Sheets};
use petril_base::source::Source;
use petril_spec::sif::{Criterion, Start};

/// The cover page.
pub fn cover(sheets: &Sheets<'_>, title: &str) -> String {
    let mut facts = Vec::new();
    let mut fact = |name: &str, value: String| facts.push(format!("<dt>{name}</dt><dd>{value}</dd>\n"));
    sheets.sources.iter().for_each(|source| fact("Specification", file(source)));
    if let Some(ran) = &sheets.run {
        fact("Program", file(ran.source));
    }
    fact("Tests by", by(sheets));
    let functions = counted(sheets.plans.len(), "function");
    fact("Contents", format!("{functions}, {}", counted(sheets.tests(), "test")));
    fact("Made with", escaped(&Provenance::tool()));
    fact("Command", code(&sheets.provenance.command_line()));
    fact("Options", format!("<small>SHA-256 <code>{}</code></small>", escaped(&sheets.provenance.options)));
    let blanks = ["Installation", "Program version", "Place", "Date", "Tester", "Signature", "Witness", "Signature"];
    let blanks = blanks.map(|name| format!("<div class=\"blank\"><span>{name}</span></div>\n")).concat();
    let result = sheets.run.as_ref().map(result).unwrap_or_default();
    format!(
        "<header class=\"cover\">\n<p class=\"brand\"><span class=\"mark\"></span>Test protocol of safety functions</p>\n\
         <h1>{}</h1>\n{result}<dl class=\"facts\">\n{}</dl>\n<div class=\"blanks\">\n{blanks}</div>\n{}</header>\n",
        escaped(title),
        facts.concat(),
        contents(sheets)
    )
}

/// File name with the hash that identifies its version.
fn file(source: &Source) -> String {
    let hash: String = Sha256::digest(source.text()).iter().map(|byte| format!("{byte:02x}")).collect();
    format!("{} <small>SHA-256 <code>{hash}</code></small>", code(source.name()))
}

fn by(sheets: &Sheets<'_>) -> String {
    let mut names: Vec<String> = sheets.plans.iter().map(|plan| made_by(sheets, plan)).collect();
    names.dedup();
    names.sort();
    names.dedup();
    if sheets.origin.is_some() {
        return names.iter().map(|name| escaped(name)).collect();
    }
    let explained =
        sheets.plans.iter().map(|plan| plan.criterion).max_by_key(|one| *one as usize).map_or("", |one| match one {
            Criterion::All => "every situation that can be and makes an output TRUE",
            Criterion::AllBoth => "every situation that can be",
            Criterion::Mcdc => "each condition decides alone, once TRUE and once FALSE",
            Criterion::Faults => "every single fault of the formulas that can be seen is seen",
            Criterion::Pairs => "every two inputs have all values together that they can have",
        });
    format!("criterion {}: {explained}", names.iter().map(|name| code(name)).collect::<Vec<_>>().join(", "))
}

fn result(ran: &Ran<'_>) -> String {
    let [passed, failed, errors] = ran.counts();
    let (class, word) = if failed + errors == 0 { ("good", "passed") } else { ("bad", "not passed") };
    let how = match ran.runner.start() {
        Start::PowerOn => "each test from power-on",
        Start::Continued => "one test after another without a restart",
    };
    format!(
        "<p class=\"result {class}\"><b>{word}</b> on the interpreter: {passed} passed, {failed} failed, {}; {how}</p>\n",
        counted(errors, "error")
    )
}

fn contents(sheets: &Sheets<'_>) -> String {
    let specification = sheets.specification;
    let zones = specification.functions.iter().any(|function| function.zone.is_some());
    let mut heads = vec!["Function", "What it is for", "SIL", "Tests"];
    if zones {
        heads.insert(0, "Zone");
    }
    if sheets.run.is_some() {
        heads.push("Passed");
    }
    let rows = sheets.plans.iter().enumerate().map(|(position, plan)| {
        let function = &specification.functions[plan.function];
        let sil = function.informal.iter().find(|(word, _)| word.eq_ignore_ascii_case("sil"));
        let mut cells = vec![
            format!("<a href=\"#f{}\">{}</a>", position + 1, code(&function.name)),
            escaped(function.title.as_deref().unwrap_or_default()),
            sil.map(|(_, sil)| escaped(sil)).unwrap_or_default(),
            plan.tests.len().to_string(),
        ];
        if zones {
            let zone = function.zone.map(|zone| escaped(&specification.zones[zone].name));
            cells.insert(0, zone.unwrap_or_default());
        }
        if let Some(ran) = &sheets.run {
            let passed = ran.results[position].tests.iter().filter(|test| test.ending.word() == "passed").count();
            let class = if passed == plan.tests.len() { "good" } else { "bad" };
            cells.push(format!("<span class=\"{class}\">{passed}</span>"));
        }
        row(cells)
    });
    table("plain contents", &heads, rows)
}

//! Reports as one page for a browser: a file that needs nothing else, to be mailed and kept.
//!
//! The page is made of the files beside this one. What was found stands in it as JSON (`document`), and its script makes all
//! markup of it, by names and texts that are never read as markup. A content security policy lets nothing run but that script
//! and nothing be fetched.

mod document;
mod fallback;
mod nets;
mod runs;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use quick_xml::escape::escape;
use serde_json::Value;
use sha2::{Digest as _, Sha256};

use super::checked::Checked;
use super::stamp::Stamp;
use petril_base::printable;

/// The frame, with a name in double braces for each of its parts.
const PAGE: &str = include_str!("page.html");
/// Style sheets in their order.
const STYLES: [&str; 3] = [include_str!("page.css"), include_str!("run.css"), include_str!("print.css")];
/// Scripts in their order; each may use what those before it define.
const SCRIPTS: [&str; 9] = [
    include_str!("elements.js"),
    include_str!("playback.js"),
    include_str!("items.js"),
    include_str!("diagram.js"),
    include_str!("net.js"),
    include_str!("source.js"),
    include_str!("table.js"),
    include_str!("stage.js"),
    include_str!("page.js"),
];

/// Writes a report.
#[must_use]
pub fn write(checked: &Checked<'_>, stamp: Stamp) -> String {
    let style = STYLES.concat();
    let script = format!("(() => {{\n\"use strict\";\n{}}})();\n", SCRIPTS.concat());
    let title = format!("{}: {}", checked.system.program.name, checked.report.verdict().word());
    let parts = [
        ("policy", policy(&style, &script)),
        ("title", markup_line(&title)),
        ("style", style),
        ("fallback", fallback::fallback(checked)),
        ("data", data(checked, stamp)),
        ("script", script),
    ];
    // The parts are put in from front to back, so what stands in one is never taken for a name.
    let mut page = String::new();
    let mut rest = PAGE;
    for (name, text) in parts {
        let (before, after) = rest.split_once(&format!("{{{{{name}}}}}")).unwrap_or((rest, ""));
        page.extend([before, &text]);
        rest = after;
    }
    page + rest
}

/// Nothing is fetched, and nothing runs but this script, which is known by its hash.
fn policy(style: &str, script: &str) -> String {
    let hash = |text: &str| STANDARD.encode(Sha256::digest(text));
    format!(
        "default-src 'none'; style-src 'sha256-{}'; script-src 'sha256-{}'; base-uri 'none'; form-action 'none'",
        hash(style),
        hash(script)
    )
}

/// A text without markup, on one line.
fn markup_line(text: &str) -> String {
    escape(printable::line(text)).into_owned()
}

/// A text without markup, on its own lines.
fn markup(text: &str) -> String {
    escape(printable::lines(text)).into_owned()
}

/// The document, with no character in it that could end the element it stands in. All it says is for people.
fn data(checked: &Checked<'_>, stamp: Stamp) -> String {
    let mut document = document::document(checked, stamp);
    make_printable(&mut document);
    let text = document.to_string();
    text.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
}

/// Every text of a document on one line. Tabs, which sources are indented by, stay.
fn make_printable(value: &mut Value) {
    match value {
        Value::String(text) if !text.chars().all(printable::is_printable) => {
            *text = text.split('\t').map(printable::line).collect::<Vec<_>>().join("\t");
        }
        Value::Array(values) => values.iter_mut().for_each(make_printable),
        Value::Object(members) => members.values_mut().for_each(make_printable),
        _ => {}
    }
}

//! Reports as a self-contained HTML page, to be mailed and archived.
//!
//! The page is assembled from the files beside this one. Results are embedded as JSON (`document`); the script creates
//! all elements from it, and no text is ever parsed as markup. A content security policy allows only this script, and
//! no requests.

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

/// Page template, with a name in double braces for each of its parts.
const PAGE: &str = include_str!("page.html");
/// Style sheets, in order.
const STYLES: [&str; 3] = [include_str!("page.css"), include_str!("run.css"), include_str!("print.css")];
/// Scripts, in order; each may use definitions of those before it.
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

/// Writes a report as a page.
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
    // Parts are inserted from front to back, so that no part's text is taken for a name.
    let mut page = String::new();
    let mut rest = PAGE;
    for (name, text) in parts {
        let (before, after) = rest.split_once(&format!("{{{{{name}}}}}")).unwrap_or((rest, ""));
        page.extend([before, &text]);
        rest = after;
    }
    page + rest
}

/// Content security policy: no requests, and no script or style but these, identified by hash.
fn policy(style: &str, script: &str) -> String {
    let hash = |text: &str| STANDARD.encode(Sha256::digest(text));
    format!(
        "default-src 'none'; style-src 'sha256-{}'; script-src 'sha256-{}'; base-uri 'none'; form-action 'none'",
        hash(style),
        hash(script)
    )
}

/// Escapes a text, on one line.
fn markup_line(text: &str) -> String {
    escape(printable::line(text)).into_owned()
}

/// Escapes a text, keeping its lines.
fn markup(text: &str) -> String {
    escape(printable::lines(text)).into_owned()
}

/// The document as JSON, without characters that could end the enclosing element.
fn data(checked: &Checked<'_>, stamp: Stamp) -> String {
    let mut document = document::document(checked, stamp);
    make_printable(&mut document);
    let text = document.to_string();
    text.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
}

/// Puts every text of a document on one line. Tabs, used for indentation in sources, stay.
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

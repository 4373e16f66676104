//! The page for readers in which no script runs, such as the previews of mail programs: every answer, runs as plain tables.

use std::fmt::Write as _;

use quick_xml::escape::escape;

use crate::exchange::checked::{Checked, runs, tags, why};

/// Runs are left out when the text has become as long as this.
const MAX_TEXT: usize = 500_000;

/// The report as plain markup.
pub fn fallback(checked: &Checked<'_>) -> String {
    let report = checked.report;
    let mut out = format!(
        "<h1>{} <small>{}</small></h1>\n<p>{}</p>\n<ul>\n",
        escape(&checked.system.program.name),
        report.verdict().word(),
        escape(checked.source.name())
    );
    for assumption in &report.assumptions {
        let _ = writeln!(out, "<li>assumed: {}</li>", escape(assumption));
    }
    for warning in &report.warnings {
        let _ = writeln!(out, "<li>warning: {}</li>", escape(warning));
    }
    out += "</ul>\n";
    for answer in checked.answers() {
        let verdict = answer.outcome.verdict().word();
        let _ = writeln!(out, "<h2>{verdict}: {}</h2>", escape(&answer.name));
        let said = [answer.sentence.as_ref(), answer.words.as_ref()];
        said.into_iter().flatten().for_each(|text| out += &format!("<p>{}</p>\n", escape(text)));
        let _ = writeln!(out, "<p><code>{}</code></p>", escape(&answer.formula));
        let tags = tags(answer).collect::<Vec<_>>().join(", ");
        let more = Some(tags).filter(|tags| !tags.is_empty()).into_iter().chain(checked.reason(answer));
        more.chain(why(answer).map(|why| checked.explained(why)).unwrap_or_default())
            .for_each(|text| out += &format!("<p>{}</p>\n", escape(&text)));
        for (purpose, witness) in runs(answer) {
            if out.len() < MAX_TEXT {
                let told = checked.told(answer, witness);
                let _ = writeln!(out, "<p>{}:</p>\n<pre>{}</pre>", purpose.word(), escape(&told));
            }
        }
    }
    out
}

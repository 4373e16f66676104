//! Fallback page for readers without scripts, such as the previews of mail programs: all answers, with runs as plain
//! tables.

use std::fmt::Write as _;

use super::{markup, markup_line};
use crate::exchange::checked::{Checked, runs, tags, why};

/// Length of the text beyond which runs are left out.
const MAX_TEXT: usize = 500_000;

/// The report as plain markup.
pub fn fallback(checked: &Checked<'_>) -> String {
    let report = checked.report;
    let mut out = format!(
        "<h1>{} <small>{}</small></h1>\n<p>{}</p>\n<ul>\n",
        markup_line(&checked.system.program.name),
        report.verdict().word(),
        markup_line(checked.source.name())
    );
    for assumption in &report.assumptions {
        let _ = writeln!(out, "<li>assumed: {}</li>", markup_line(assumption));
    }
    for warning in &report.warnings {
        let _ = writeln!(out, "<li>warning: {}</li>", markup_line(warning));
    }
    out += "</ul>\n";
    for answer in checked.answers() {
        let verdict = answer.outcome.verdict().word();
        let _ = writeln!(out, "<h2>{verdict}: {}</h2>", markup_line(&answer.name));
        let said = [answer.sentence.as_ref(), answer.words.as_ref()];
        said.into_iter().flatten().for_each(|text| out += &format!("<p>{}</p>\n", markup_line(text)));
        let _ = writeln!(out, "<p><code>{}</code></p>", markup_line(&answer.formula));
        out += if answer.recalled { "<p>known from an earlier run</p>\n" } else { "" };
        let tags = tags(answer).collect::<Vec<_>>().join(", ");
        let more = Some(tags).filter(|tags| !tags.is_empty()).into_iter().chain(checked.reason(answer));
        more.chain(why(answer).map(|why| checked.explained(why)).unwrap_or_default())
            .for_each(|text| out += &format!("<p>{}</p>\n", markup_line(&text)));
        for (purpose, witness) in runs(answer) {
            if out.len() < MAX_TEXT {
                let told = checked.told(answer, witness);
                let _ = writeln!(out, "<p>{}:</p>\n<pre>{}</pre>", purpose.word(), markup(&told));
            }
        }
    }
    for (what, text) in checked.provenance.pairs() {
        let _ = writeln!(out, "<p>{what}: {}</p>", markup_line(&text));
    }
    out
}

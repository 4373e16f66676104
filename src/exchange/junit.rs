//! JUnit XML for continuous integration: the program is a test suite, each requirement and each check a test case.
//!
//! A violation is a failure, an unknown verdict an error: neither passes unnoticed. Documents are valid under both
//! schemas in use, that of Apache Ant and that of Jenkins, which allow tags only as properties of the suite.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};

use super::checked::{Checked, tags, why};
use super::stamp::Stamp;
use petril_base::printable::{self, line};
use petril_base::to_text;
use petril_check::verdict::{Answer, Outcome, Verdict};

type Xml<'o> = Writer<&'o mut Vec<u8>>;

/// Writes a report as one test suite.
#[must_use]
pub fn write(checked: &Checked<'_>, stamp: Stamp) -> String {
    write_all(&[(&checked.system.program.name, *checked, stamp)])
}

/// Writes each report as a test suite with a name.
#[must_use]
pub fn write_all(reports: &[(&str, Checked<'_>, Stamp)]) -> String {
    to_text(|out| {
        let mut xml = Writer::new_with_indent(out, b' ', 2);
        xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
        xml.create_element("testsuites").write_inner_content(|xml| {
            let mut numbered = reports.iter().enumerate();
            numbered.try_for_each(|(id, (name, checked, stamp))| suite(xml, id, name, checked, *stamp))
        })?;
        xml.get_mut().push(b'\n');
        Ok(())
    })
}

fn suite(xml: &mut Xml<'_>, id: usize, name: &str, checked: &Checked<'_>, stamp: Stamp) -> io::Result<()> {
    let count = |verdict| checked.answers().filter(|a| a.outcome.verdict() == verdict).count().to_string();
    let (name, time) = (line(name), format!("{:.3}", stamp.took.max(0.0)));
    let attributes = [
        ("name", name.as_str()),
        ("package", "petril"),
        ("id", &id.to_string()),
        ("tests", &checked.answers().count().to_string()),
        ("failures", &count(Verdict::Violated)),
        ("errors", &count(Verdict::Unknown)),
        ("time", &time),
        ("timestamp", &stamp.to_string()),
        ("hostname", "localhost"),
    ];
    xml.create_element("testsuite").with_attributes(attributes).write_inner_content(|xml| {
        xml.create_element("properties").write_inner_content(|xml| properties(xml, checked))?;
        for answer in checked.answers() {
            case(xml, &name, checked, answer)?;
        }
        let remarks = BytesText::new(&lines(&output(checked))).into_owned();
        xml.create_element("system-out").write_text_content(remarks)?;
        xml.create_element("system-err").write_text_content(BytesText::new(""))?;
        Ok(())
    })?;
    Ok(())
}

fn properties(xml: &mut Xml<'_>, checked: &Checked<'_>) -> io::Result<()> {
    let mut property = |name: &str, value: &str| {
        let attributes = [("name", line(name)), ("value", line(value))];
        let attributes = attributes.iter().map(|(name, value)| (*name, value.as_str()));
        xml.create_element("property").with_attributes(attributes).write_empty().map(drop)
    };
    property("petril", env!("PETRIL_VERSION"))?;
    for (what, text) in checked.provenance.pairs().iter().skip(1) {
        property(what, text)?;
    }
    property("file", checked.source.name())?;
    property("verdict", checked.report.verdict().word())?;
    for assumption in &checked.report.assumptions {
        property("assumed", assumption)?;
    }
    for warning in &checked.report.warnings {
        property("warning", warning)?;
    }
    for answer in checked.answers() {
        if answer.recalled {
            property(&format!("{}.known", answer.name), "from an earlier run")?;
        }
        for tag in &answer.tags {
            property(&format!("{}.{}", answer.name, tag.name), tag.value.as_deref().unwrap_or("true"))?;
        }
    }
    Ok(())
}

fn case(xml: &mut Xml<'_>, class: &str, checked: &Checked<'_>, answer: &Answer) -> io::Result<()> {
    let name = line(&answer.name);
    let attributes = [("name", name.as_str()), ("classname", class), ("time", "0")];
    let element = xml.create_element("testcase").with_attributes(attributes);
    let (kind, body) = match &answer.outcome {
        Outcome::Holds { .. } => return element.write_empty().map(drop),
        Outcome::Unknown(_) => ("error", head(answer)),
        Outcome::Violated(witness, _) => {
            let mut body = head(answer) + "\n" + &checked.told(answer, witness);
            let why = why(answer).map(|why| checked.explained(why)).unwrap_or_default();
            body.extend(why.into_iter().map(|sentence| sentence + "\n"));
            ("failure", body)
        }
    };
    let reason = line(&checked.reason(answer).unwrap_or_default());
    element
        .write_inner_content(|xml| {
            let attributes = [("type", answer.outcome.verdict().word()), ("message", reason.as_str())];
            let body = BytesText::new(&lines(&body)).into_owned();
            xml.create_element(kind).with_attributes(attributes).write_text_content(body).map(drop)
        })
        .map(drop)
}

/// Requirement in all its wordings.
fn head(answer: &Answer) -> String {
    let mut head = String::new();
    let said = [answer.sentence.as_ref(), answer.words.as_ref(), Some(&answer.formula)];
    head.extend(said.into_iter().flatten().map(|text| line(text) + "\n"));
    let tags = tags(answer).collect::<Vec<_>>().join(", ");
    if !tags.is_empty() {
        head += &format!("[{}]\n", line(&tags));
    }
    if let Some(origin) = &answer.origin {
        head += &format!("{}:{}:{}\n", line(&origin.file), origin.line, origin.column);
    }
    head
}

/// Remarks on requirements that hold.
fn output(checked: &Checked<'_>) -> String {
    let holds = checked.answers().filter(|answer| answer.outcome.verdict() == Verdict::Holds);
    holds.filter_map(|answer| Some(format!("{}: {}\n", line(&answer.name), checked.reason(answer)?))).collect()
}

/// A text of several lines without characters that XML cannot represent.
fn lines(text: &str) -> String {
    printable::lines(text).into_owned()
}

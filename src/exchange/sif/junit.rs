//! Test run as JUnit XML: a suite for each function, a case for each test. A test that is not passed is a failure; a
//! run-time error is an error.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};

use super::told::{brief, reasons};
use super::{Ran, Sheets};
use crate::exchange::Stamp;
use petril_base::printable::line;
use petril_base::to_text;
use petril_spec::sif::{Plan, PlanRun, Test, TestRun};

type Xml<'o> = Writer<&'o mut Vec<u8>>;

/// Writes the results of a run.
#[must_use]
pub fn write(sheets: &Sheets<'_>, ran: &Ran<'_>, stamp: Stamp) -> String {
    to_text(|out| {
        let mut xml = Writer::new_with_indent(out, b' ', 2);
        xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
        xml.create_element("testsuites").write_inner_content(|xml| {
            let mut numbered = sheets.plans.iter().zip(ran.results).enumerate();
            numbered.try_for_each(|(id, (plan, run))| suite(xml, id, sheets, ran, plan, run, stamp))
        })?;
        xml.get_mut().push(b'\n');
        Ok(())
    })
}

fn suite(
    xml: &mut Xml<'_>,
    id: usize,
    sheets: &Sheets<'_>,
    ran: &Ran<'_>,
    plan: &Plan,
    run: &PlanRun,
    stamp: Stamp,
) -> io::Result<()> {
    let count = |word| run.tests.iter().filter(|test| test.ending.word() == word).count().to_string();
    let name = line(&sheets.specification.functions[plan.function].name);
    let time = format!("{:.3}", if id == 0 { stamp.took.max(0.0) } else { 0.0 });
    let attributes = [
        ("name", name.as_str()),
        ("package", "petril"),
        ("id", &id.to_string()),
        ("tests", &run.tests.len().to_string()),
        ("failures", &count("failed")),
        ("errors", &count("error")),
        ("time", &time),
        ("timestamp", &stamp.to_string()),
        ("hostname", "localhost"),
    ];
    xml.create_element("testsuite").with_attributes(attributes).write_inner_content(|xml| {
        xml.create_element("properties").write_inner_content(|xml| properties(xml, sheets, ran, plan))?;
        for (number, (test, made)) in plan.tests.iter().zip(&run.tests).enumerate() {
            case(xml, &name, number, sheets, ran, test, made)?;
        }
        xml.create_element("system-out").write_text_content(BytesText::new(""))?;
        xml.create_element("system-err").write_text_content(BytesText::new(""))?;
        Ok(())
    })?;
    Ok(())
}

fn properties(xml: &mut Xml<'_>, sheets: &Sheets<'_>, ran: &Ran<'_>, plan: &Plan) -> io::Result<()> {
    let files: Vec<&str> = sheets.sources.iter().map(petril_base::source::Source::name).collect();
    let said = [
        ("petril", env!("PETRIL_VERSION").to_owned()),
        ("specification", files.join(", ")),
        ("program", ran.source.name().to_owned()),
        ("criterion", super::told::made_by(sheets, plan)),
        ("start", ran.mode().to_owned()),
    ];
    for (name, value) in said.into_iter().chain(sheets.provenance.pairs().into_iter().skip(1)) {
        let value = line(&value);
        xml.create_element("property").with_attributes([("name", name), ("value", value.as_str())]).write_empty()?;
    }
    Ok(())
}

fn case(
    xml: &mut Xml<'_>,
    class: &str,
    number: usize,
    sheets: &Sheets<'_>,
    ran: &Ran<'_>,
    test: &Test,
    made: &TestRun,
) -> io::Result<()> {
    let name = line(&format!("test {}: {}", number + 1, brief(sheets, test)));
    let attributes = [("name", name.as_str()), ("classname", class), ("time", "0")];
    let element = xml.create_element("testcase").with_attributes(attributes);
    let kind = match made.ending.word() {
        "passed" => return element.write_empty().map(drop),
        "failed" => "failure",
        _ => "error",
    };
    let reason = line(&reasons(sheets, ran, made).join("; "));
    let body = line(&test.purpose.join("; "));
    element
        .write_inner_content(|xml| {
            let attributes = [("type", made.ending.word()), ("message", reason.as_str())];
            xml.create_element(kind).with_attributes(attributes).write_text_content(BytesText::new(&body)).map(drop)
        })
        .map(drop)
}

//! Projects in XML: they say what the same text would say, and whatever is in them, nothing worse than a diagnostic comes
//! of it.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::diagnostic::{Code, Diagnostic, Style, any_error, render};
use petril::flat::{FlatProgram, flatten};
use petril::semantics::{check, check_unit};
use petril::source::Source;
use petril::syntax::parse;

const TEXT: &str = include_str!("../plcopen/filling.il");
const PROJECT: &str = include_str!("../plcopen/filling.xml");

/// The program of a text, and what is said about it.
fn read(text: &str, pou: Option<&str>) -> (Option<FlatProgram>, Vec<Diagnostic>) {
    let source = Source::new("program", text);
    let (unit, mut diagnostics) = parse(&source);
    let (program, more) = check_unit(&unit, !any_error(&diagnostics), pou);
    diagnostics.extend(more);
    for diagnostic in &diagnostics {
        assert!(!render(diagnostic, &source, Style::default()).is_empty());
    }
    (program.as_ref().map(flatten), diagnostics)
}

/// Everything a program is, but for its places in the text.
fn content(program: &FlatProgram) -> Vec<String> {
    let variables =
        program.variables.iter().map(|v| format!("{} {:?} {} {} {}", v.name, v.role, v.ty, v.bits, v.initial));
    let code = program.code.iter().map(|line| program.text(line.instruction));
    let head = format!("{} every {:?}", program.name, program.scan_time);
    std::iter::once(head).chain(variables).chain(code).collect()
}

/// A project of one program with this body and interface.
fn project(interface: &str, body: &str) -> String {
    format!(
        "<project xmlns='http://www.plcopen.org/xml/tc6_0200' xmlns:xhtml='http://www.w3.org/1999/xhtml'><types><pous>\
         <pou name='p' pouType='program'><interface>{interface}</interface><body>{body}</body></pou></pous></types></project>"
    )
}

/// The codes of what is said about a text, each with what it points at.
fn said(text: &str) -> Vec<(Code, String)> {
    let place = |diagnostic: &Diagnostic| (diagnostic.code, text[diagnostic.span().range()].to_owned());
    read(text, None).1.iter().map(place).collect()
}

const AB: &str = "<inputVars><variable name='a'><type><BOOL/></type></variable></inputVars>\
                  <outputVars><variable name='q'><type><BOOL/></type></variable></outputVars>";

#[test]
fn a_project_is_what_its_text_is() {
    let (text, no_errors) = read(TEXT, None);
    let (project, _) = read(PROJECT, None);
    assert!(no_errors.is_empty(), "{no_errors:?}");
    let (text, project) = (text.unwrap(), project.unwrap());
    assert_eq!(text.scan_time, Some(20));
    assert_eq!(content(&project), content(&text));
    for block in ["Edge", "LIMIT_TO"] {
        assert_eq!(
            content(&read(PROJECT, Some(block)).0.unwrap()),
            content(&read(TEXT, Some(block)).0.unwrap()),
            "{block}"
        );
    }
}

#[test]
fn the_lines_of_the_code_are_lines_of_the_project() {
    let source = Source::new("filling.xml", PROJECT);
    let (unit, errors) = parse(&source);
    let program = flatten(&check(&unit, errors.is_empty()).0.unwrap());
    let listing = program.listing(&source);
    let line = 1 + PROJECT.lines().position(|line| line == "EQ Draining").unwrap();
    assert!(listing.contains(&format!("{line} | EQ Draining")), "{listing}");
}

#[test]
fn a_body_is_the_same_however_it_is_written() {
    let expected =
        content(&read(&project(AB, "<IL><xhtml:p><![CDATA[LD a\n& TRUE\nST q]]></xhtml:p></IL>"), None).0.unwrap());
    let bodies = [
        "<IL>LD a\n&amp; TRUE\nST q</IL>",
        "<IL>LD a&#10;&#38; TRUE&#xA;ST q</IL>",
        "<IL><xhtml:p>LD a</xhtml:p><xhtml:p>&amp; TRUE</xhtml:p><xhtml:p>ST q</xhtml:p></IL>",
        "<IL><html xmlns='http://www.w3.org/1999/xhtml'><p>LD a<br/>&amp; TRUE<br/>ST q</p></html></IL>",
        "<IL><![CDATA[LD a]]>\n<!-- LD q -->&amp; TRUE (* &lt;p&gt; *)\nST q</IL>",
        "<IL>LD a\r\n&amp; TRUE\r\nST q\r\n</IL><addData><data name='x'>LD q</data></addData>",
    ];
    for body in bodies {
        let (program, diagnostics) = read(&project(AB, body), None);
        assert!(diagnostics.is_empty(), "{body}: {diagnostics:?}");
        assert_eq!(content(&program.unwrap()), expected, "{body}");
    }
    let without_namespace = project(AB, bodies[0]).replace(" xmlns='http://www.plcopen.org/xml/tc6_0200'", "");
    assert_eq!(content(&read(&without_namespace, None).0.unwrap()), expected);
}

#[test]
fn a_chosen_unit_is_checked_without_the_rest() {
    let others = "<dataType name='text'><baseType><string/></baseType></dataType>\
        <globalVars><variable name='x'><type><derived name='text'/></type></variable></globalVars>\
        <pou name='r' pouType='program'><interface/><body><LD/></body></pou>";
    let text = project(AB, "<IL>LD a\nST q</IL>").replace("<types>", &format!("<types>{others}"));
    assert!(read(&text, None).0.is_none());
    let (program, diagnostics) = read(&text, Some("p"));
    assert!(diagnostics.is_empty(), "{diagnostics:?}");
    assert_eq!(program.unwrap().code.len(), 2);
    let (program, diagnostics) = read(&text, Some("r"));
    assert!(program.is_none() && diagnostics[0].code == Code::OtherLanguage, "{diagnostics:?}");
}

#[test]
fn a_value_without_members_is_the_value_of_the_type() {
    let project = "<project xmlns='http://www.plcopen.org/xml/tc6_0201'><types><dataTypes><dataType name='R'><baseType><struct>\
        <variable name='k'><type><BYTE/></type><initialValue><simpleValue value='3'/></initialValue></variable>\
        </struct></baseType></dataType></dataTypes><pous><pou name='p' pouType='program'><interface><localVars>\
        <variable name='r'><type><derived name='R'/></type><initialValue><structValue/></initialValue></variable>\
        <variable name='a'><type><array><dimension lower='0' upper='1'/><baseType><derived name='R'/></baseType></array></type>\
        <initialValue><arrayValue><value><structValue><value member='k'><simpleValue value='5'/></value></structValue></value>\
        <value><structValue></structValue></value></arrayValue></initialValue></variable>\
        </localVars></interface><body><IL>LD r.k\nST a[1].k</IL></body></pou></pous></types></project>";
    let program = read(project, None).0.unwrap();
    let initial: Vec<u64> = program.variables.iter().map(|variable| variable.initial).collect();
    assert_eq!(initial, [3, 5, 3]);
    let printed = parse(&Source::new("project", project)).0.to_string();
    assert_eq!(content(&read(&printed, None).0.unwrap()), content(&program), "{printed}");
}

#[test]
fn an_interval_is_read_in_the_ways_of_the_tools() {
    for (interval, scan_time) in [
        ("T#20ms", Some(20)),
        ("t#1s500ms", Some(1500)),
        ("20ms", Some(20)),
        ("PT0.05S", Some(50)),
        ("PT10S", Some(10_000)),
        ("00:00:00.100000", Some(100)),
    ] {
        let text = PROJECT.replace("T#20ms", interval);
        assert_eq!(read(&text, None).0.unwrap().scan_time, scan_time, "{interval}");
        let printed = parse(&Source::new("project", text)).0.to_string();
        let task = printed.find("INTERVAL := T#");
        assert!(task.is_some(), "printed as a text it says the same: {printed}");
    }
    let unfit = PROJECT.replace("T#20ms", "5 apples");
    assert!(said(&unfit).contains(&(Code::TaskUnfit, "5 apples".to_owned())));
}

#[test]
fn mistakes_are_shown_where_they_are() {
    let cases = [
        (project(AB, "<IL>LD a\nLD\nST &lt;q</IL>"), (Code::Syntax, "&")),
        (project(AB, "<IL>LD a (* here &lt;\nST q</IL>"), (Code::CommentNotClosed, "(*")),
        (project(AB, "<IL>LD a\nST q\nEND_PROGRAM\nLD a</IL>"), (Code::Syntax, "END_PROGRAM")),
        (project(AB, "<IL/>").replace("<BOOL/>", "<REAL/>"), (Code::TypeNotSupported, "REAL")),
        (project(AB, "<IL>LD a\nST q</IL>").replace("'q'", "'q 1'"), (Code::Syntax, "q 1")),
        (project(AB, "<IL>LD a\nST q</IL>").replace("name='q'", ""), (Code::XmlSyntax, "<variable")),
    ];
    for (text, (code, place)) in cases {
        assert!(said(&text).iter().any(|(c, p)| *c == code && p.starts_with(place)), "{text}\n{:?}", said(&text));
    }
}

#[test]
fn initial_values_that_cannot_be_read_harm_nothing_else() {
    for value in ["3 + 4", "'open", "(a := ", "[1, 2", "(* x", "$#!", "&lt;", "LD a"] {
        let local = format!(
            "<localVars><variable name='n'><type><INT/></type><initialValue><simpleValue value=\"{value}\"/></initialValue>\
             </variable></localVars>"
        );
        let text = project(&format!("{AB}{local}"), "<IL>LD a\nST q</IL>");
        let (program, diagnostics) = read(&text, None);
        assert!(program.is_none(), "{value}");
        let start = text.find(value).unwrap();
        let errors: Vec<_> = diagnostics.iter().filter(|diagnostic| diagnostic.is_error()).collect();
        assert_eq!(errors.len(), 1, "{value}: {errors:?}");
        assert!((start..=start + value.len()).contains(&errors[0].span().start), "{value}: {errors:?}");
    }
}

#[test]
fn a_project_may_break_off_anywhere() {
    for (end, _) in PROJECT.char_indices().step_by(7) {
        let (program, diagnostics) = read(&PROJECT[..end], Some("filling"));
        assert!(program.is_none() && any_error(&diagnostics), "{end}");
    }
}

#[test]
fn any_line_may_be_missing() {
    for i in 0..PROJECT.lines().count() {
        let text: String =
            PROJECT.lines().enumerate().filter(|(n, _)| *n != i).map(|(_, line)| format!("{line}\n")).collect();
        let (program, diagnostics) = read(&text, None);
        assert_eq!(program.is_none(), any_error(&diagnostics), "without line {}", i + 1);
    }
}

#[test]
fn depth_and_entities_do_no_harm() {
    let nested =
        |begin: &str, end: &str, inner: &str| format!("{}{inner}{}", begin.repeat(100_000), end.repeat(100_000));
    let array = nested("<array><dimension lower='0' upper='1'/><baseType>", "</baseType></array>", "<INT/>");
    let values = nested("<arrayValue><value>", "</value></arrayValue>", "<simpleValue value='1'/>");
    let deep = |ty: &str, value: &str| {
        format!(
            "<localVars><variable name='n'><type>{ty}</type><initialValue>{value}</initialValue></variable></localVars>"
        )
    };
    for text in [
        project(&deep(&array, ""), "<IL/>"),
        project(&deep("<INT/>", &values), "<IL/>"),
        project(AB, &nested("<x>", "</x>", "")),
        nested("<project>", "</project>", ""),
        format!("<!DOCTYPE x [<!ENTITY a 'aaaa'><!ENTITY b '&a;&a;&a;'>]>{}", project(AB, "<IL>&b;</IL>")),
    ] {
        let (program, diagnostics) = read(&text, None);
        assert!(program.is_none() && any_error(&diagnostics), "{}", &text[..200]);
    }
    let list = nested("AND(\n", ")\n", "LD a\n");
    assert!(
        said(&project(AB, &format!("<IL>LD a\n{list}ST q</IL>"))).iter().any(|(c, _)| *c == Code::ParenthesisTooDeep)
    );
}

#[test]
fn many_units_are_read_in_a_moment() {
    let pou = |i: usize| {
        format!(
            "<pou name='b{i}' pouType='functionBlock'><interface>{AB}</interface><body><IL>LD a\nST q</IL></body></pou>"
        )
    };
    let pous: String = (0..5000).map(pou).collect();
    let started = std::time::Instant::now();
    let (unit, errors) = parse(&Source::new("many", format!("<project><types><pous>{pous}</pous></types></project>")));
    assert!(errors.is_empty() && unit.pous.iter().all(|pou| pou.body.len() == 2));
    assert!(started.elapsed().as_secs() < 20, "{:?}", started.elapsed());
}

//! PLCopen TC6 projects in XML (versions 1.0 to 2.01), as engineering tools export them, to the same tree that the text
//! of their units would give.
//!
//! Data types, interfaces and configurations are made of elements; a body in Instruction List and the initial values
//! are text inside the XML and are read by the grammar of the language ([`pieces`]). Every span points into the XML.
//! Vendors' additions (`addData`) are searched for units, types and global variables, which some tools put there;
//! pictures, documentation and the actions of charts are ignored.

mod characters;
mod configurations;
mod pieces;
mod pous;
mod types;
mod values;

use roxmltree::Node;

use super::ast::{Name, Unit};
use petril_base::diagnostic::{Code, Diagnostic, any_error};
use petril_base::source::{Source, Span};
use petril_base::xml::{self, attribute, tag, tag_span};
use pieces::Pieces;

/// Common beginning of the namespaces of all versions.
const NAMESPACE: &str = "http://www.plcopen.org/xml/tc6";

/// Maximum nesting depth of types and values; the limit keeps recursion over the tree within its stack.
const MAX_DEPTH: usize = 64;

/// Whether a text is XML: by its first character, which begins no text of the language, or by the ending of its file
/// name.
pub fn is_xml(source: &Source) -> bool {
    let ending = source.name().len().checked_sub(".xml".len()).and_then(|at| source.name().get(at..));
    source.text().trim_start().starts_with('<') || ending.is_some_and(|ending| ending.eq_ignore_ascii_case(".xml"))
}

/// Reads a project. Whatever cannot be read is reported and left out of the tree.
pub fn read(source: &Source) -> (Unit, Vec<Diagnostic>) {
    if !source.text().trim_start().starts_with('<') {
        let diagnostic = Diagnostic::new(Code::XmlSyntax, Span::default(), "this is no XML");
        let help =
            "a file whose name ends with .xml is read as a project of PLCopen; a program's text has the ending .il";
        return (Unit::default(), vec![diagnostic.help(help)]);
    }
    let document = match xml::document(source, Code::XmlSyntax, "PLCopen XML") {
        Ok(document) => document,
        Err(diagnostic) => return (Unit::default(), vec![diagnostic]),
    };
    let root = document.root_element();
    if let Some(diagnostic) = not_a_project(root) {
        return (Unit::default(), vec![diagnostic]);
    }
    let (pieces, diagnostics) = Pieces::of(root, source.text());
    let mut reader = Reader { text: source.text(), pieces, diagnostics };
    let mut unit = Unit::default();
    let mut skip_to = 0;
    for node in root.descendants().filter(Node::is_element) {
        if node.range().start < skip_to {
            continue;
        }
        match tag(node) {
            "pou" => unit.pous.extend(reader.pou(node)),
            "dataType" => unit.types.extend(reader.data_type(node)),
            "globalVars" | "accessVars" | "configVars" => unit.globals.extend(reader.block(node)),
            "configuration" => {
                unit.configurations.extend(reader.configuration(node));
                continue;
            }
            _ => continue,
        }
        skip_to = node.range().end;
    }
    let mut diagnostics = reader.diagnostics;
    if unit.pous.is_empty() && !any_error(&diagnostics) {
        diagnostics.push(
            Diagnostic::new(Code::NothingToCheck, tag_span(root), "this project holds no program")
                .help("export it with its program organisation units: each is an element `<pou>`"),
        );
    }
    diagnostics.sort_by_key(Diagnostic::span);
    (unit, diagnostics)
}

fn not_a_project(root: Node<'_, '_>) -> Option<Diagnostic> {
    let refuse = |message: String| {
        Diagnostic::new(Code::XmlSyntax, tag_span(root), message)
            .help(format!("a project begins with `<project xmlns=\"{NAMESPACE}_0201\">`"))
    };
    match root.tag_name().namespace() {
        _ if tag(root) != "project" => Some(refuse(format!("this is no PLCopen project but `<{}>`", tag(root)))),
        Some(other) if !other.starts_with(NAMESPACE) => {
            Some(refuse(format!("this is a project of another kind than PLCopen's: `{other}`")))
        }
        _ => None,
    }
}

/// Reader of the parts of a project, which collects their diagnostics.
struct Reader<'a> {
    /// Text of the whole file.
    text: &'a str,
    pieces: Pieces,
    diagnostics: Vec<Diagnostic>,
}

impl Reader<'_> {
    fn report(&mut self, code: Code, span: Span, message: impl Into<String>, help: &str) {
        let diagnostic = Diagnostic::new(code, span, message);
        self.diagnostics.push(if help.is_empty() { diagnostic } else { diagnostic.help(help) });
    }

    /// Value of a required attribute; reports a missing one.
    fn required(&mut self, node: Node<'_, '_>, name: &str) -> Option<Name> {
        let found = attribute(node, name);
        if found.is_none() {
            let message = format!("this `<{}>` has no attribute `{name}`", tag(node));
            self.report(Code::XmlSyntax, tag_span(node), message, "");
        }
        found.map(|found| Name { text: found.text, span: found.span })
    }

    /// Name that an element declares; reports one that IL does not allow.
    fn declared(&mut self, node: Node<'_, '_>) -> Option<Name> {
        let name = self.required(node, "name")?;
        let plain = name.text.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_');
        let starts = name.text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
        if !plain || !starts || name.is("TRUE") || name.is("FALSE") {
            let message = format!("`{}` cannot be a name", name.text);
            self.report(
                Code::Syntax,
                name.span,
                message,
                "a name begins with a letter A to Z and goes on with these, digits and `_`",
            );
        }
        Some(name)
    }
}

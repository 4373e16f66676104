//! Program organisation units: their interfaces and their bodies.

use roxmltree::Node;

use super::{Reader, characters};
use crate::syntax::ast::{Instruction, Name, Operation, Pou, PouKind, TypeSpec, VarBlock, VarKind};
use petril_base::diagnostic::Code;
use petril_base::source::Span;
use petril_base::xml::{attribute, child, elements, tag, tag_span};

impl Reader<'_> {
    /// Reads an element `<pou>`.
    pub fn pou(&mut self, node: Node<'_, '_>) -> Option<Pou> {
        let known = self.diagnostics.len();
        let name = self.declared(node)?;
        let kind = self.required(node, "pouType")?;
        let kind = match kind.text.as_str() {
            "program" => PouKind::Program,
            "function" => PouKind::Function,
            "functionBlock" => PouKind::FunctionBlock,
            other => {
                let help = "there are `program`, `function` and `functionBlock`";
                self.report(Code::XmlSyntax, kind.span, format!("`{other}` is no kind of unit"), help);
                return None;
            }
        };
        let mut pou = Pou { kind, name, result: None, blocks: Vec::new(), body: Vec::new(), foreign: None };
        for part in child(node, "interface").into_iter().flat_map(elements) {
            if tag(part) == "returnType" {
                pou.result = self.result(part);
            } else {
                pou.blocks.extend(self.block(part));
            }
        }
        self.body(node, &mut pou);
        if pou.foreign.is_some() {
            // The unit is refused as a whole if it is needed; how another language declares its variables is not a
            // mistake.
            self.diagnostics.truncate(known);
        }
        Some(pou)
    }

    fn result(&mut self, node: Node<'_, '_>) -> Option<Name> {
        let inner = elements(node).next()?;
        Some(match self.type_of(inner, 0)? {
            TypeSpec::Named(name) => name,
            other => Name { text: tag(inner).to_owned(), span: other.span() },
        })
    }

    /// Reads an element like `<inputVars>`; `None` if it is not a block of declarations.
    pub fn block(&mut self, node: Node<'_, '_>) -> Option<VarBlock> {
        let kind = match tag(node) {
            "localVars" => VarKind::Local,
            "inputVars" => VarKind::Input,
            "outputVars" => VarKind::Output,
            "inOutVars" => VarKind::InOut,
            "tempVars" => VarKind::Temp,
            "externalVars" => VarKind::External,
            "globalVars" => VarKind::Global,
            "accessVars" | "configVars" => VarKind::Access,
            _ => return None,
        };
        let is = |name: &str| attribute(node, name).filter(|value| matches!(value.text.as_str(), "true" | "1"));
        let kept = ["retain", "nonretain", "persistent"].into_iter().find_map(|name| Some((name, is(name)?.span)));
        let retain = kept.map(|(name, span)| {
            let text = if name == "nonretain" { "NON_RETAIN".to_owned() } else { name.to_ascii_uppercase() };
            Name { text, span }
        });
        let is_variable = |part: &Node<'_, '_>| tag(*part) == "variable";
        if kind == VarKind::Access && elements(node).next().is_none() {
            return None;
        }
        let declarations = if kind == VarKind::Access {
            Vec::new()
        } else {
            elements(node).filter(is_variable).filter_map(|variable| self.variable(variable, 0)).collect()
        };
        Some(VarBlock { kind, constant: is("constant").is_some(), retain, declarations, span: tag_span(node) })
    }

    /// Reads the body of a unit, or the language of a body that is not in IL.
    fn body(&mut self, node: Node<'_, '_>, pou: &mut Pou) {
        let mut bodies = elements(node).filter(|&part| tag(part) == "body");
        let Some(first) = bodies.next() else {
            pou.foreign = Some((String::new(), pou.name.span));
            return;
        };
        let written = elements(first).find_map(|part| Some((part, language(tag(part))?)));
        let list = match written {
            Some((list, "")) => list,
            Some((part, language)) => {
                pou.foreign = Some((language.to_owned(), tag_span(part)));
                return;
            }
            None => {
                pou.foreign = Some(("a language of its vendor".to_owned(), tag_span(first)));
                return;
            }
        };
        if let Some(second) = bodies.find(|&body| elements(body).next().is_some()) {
            let message = format!("`{}` has a second body", pou.name.text);
            let help = "put all its instructions into one";
            self.report(Code::DeclarationNotSupported, tag_span(second), message, help);
        }
        let content = characters::content(list, self.text);
        if let Some(piece) = content.and_then(|content| self.pieces.take(content.start)) {
            self.diagnostics.extend(piece.diagnostics);
            pou.body = piece.body;
            pou.blocks.extend(piece.blocks);
            pou.foreign = piece.foreign;
        }
        self.actions(node, &mut pou.body);
    }

    /// Refuses calls of actions: these belong to the unit, but are not part of its list.
    fn actions(&mut self, node: Node<'_, '_>, body: &mut [Instruction]) {
        let actions = child(node, "actions").into_iter().flat_map(elements);
        let actions: Vec<_> = actions.filter_map(|action| attribute(action, "name")).collect();
        for instruction in body {
            let Some(Operation::Call { callee, .. }) = &instruction.operation else { continue };
            let Some(action) = actions.iter().find(|action| callee.root.is(&action.text)) else { continue };
            if callee.parts.is_empty() {
                let span: Span = callee.span;
                let message = format!("`{}` is an action, and calls of actions are not supported", action.text);
                let help = "make it a function block, and call an instance";
                self.report(Code::DeclarationNotSupported, span, message, help);
                instruction.operation = Some(Operation::Broken);
            }
        }
    }
}

/// Language of a body by its tag, empty for Instruction List; `None` if the tag does not name a language.
fn language(tag: &str) -> Option<&'static str> {
    Some(match tag {
        "IL" => "",
        "ST" => "Structured Text",
        "FBD" => "a Function Block Diagram",
        "LD" => "a Ladder Diagram",
        "SFC" => "a Sequential Function Chart",
        _ => return None,
    })
}

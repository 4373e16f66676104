//! Call graph: the units that a program needs, and the check that no unit calls itself.

use std::collections::BTreeSet;

use super::project::Project;
use super::shape::{PouId, Shape};
use crate::syntax::ast::{Name, Operation, with_nested};
use petril_base::diagnostic::{Code, Diagnostic};

impl Project<'_> {
    /// Units that a unit calls, each with the name that calls it.
    pub fn calls(&self, id: PouId) -> Vec<(PouId, &Name)> {
        let pou = self.pou(id);
        let mut calls = Vec::new();
        for (instruction, _) in with_nested(&pou.body) {
            if let Some(Operation::Function { name, .. }) = &instruction.operation {
                calls.extend(self.find(&name.text).map(|callee| (callee, name)));
            }
        }
        for declaration in pou.blocks.iter().flat_map(|block| &block.declarations) {
            let shape = declaration.names.first().and_then(|name| self.symbols(id).find(&name.text)?.1.shape.as_ref());
            let inside = shape.map(Shape::instances).unwrap_or_default();
            calls.extend(inside.into_iter().zip(declaration.names.iter().cycle()));
        }
        calls
    }

    /// Units that a unit needs, callees first and the unit itself last; reports recursion.
    pub fn reachable(&self, entry: PouId, found: &mut Vec<Diagnostic>) -> Vec<PouId> {
        let mut done = Vec::new();
        let mut open = Vec::new();
        // Global variables may be instances too.
        let global = self.globals.list().iter().filter_map(|symbol| symbol.shape.as_ref());
        let global: BTreeSet<PouId> = global.flat_map(Shape::instances).collect();
        global.into_iter().for_each(|id| self.visit(id, &mut open, &mut done, found));
        self.visit(entry, &mut open, &mut done, found);
        done
    }

    fn visit(&self, id: PouId, open: &mut Vec<PouId>, done: &mut Vec<PouId>, found: &mut Vec<Diagnostic>) {
        if done.contains(&id) {
            return;
        }
        open.push(id);
        for (callee, name) in self.calls(id) {
            match open.iter().position(|&outer| outer == callee) {
                Some(first) => {
                    let way: Vec<&str> = open[first..].iter().map(|&id| self.pou(id).name.text.as_str()).collect();
                    let message = format!("`{}` calls itself", self.pou(callee).name.text);
                    let help = format!("{} → {}: recursion is forbidden (IEC 61131-3, 2.5)", way.join(" → "), way[0]);
                    let known = found.iter().any(|d| d.code == Code::Recursion && d.span() == name.span);
                    if !known {
                        found.push(Diagnostic::new(Code::Recursion, name.span, message).help(help));
                    }
                }
                // Maximum nesting depth of calls; the limit keeps recursion over calls within its stack.
                None if open.len() < 100 => self.visit(callee, open, done, found),
                None => {
                    let message = "calls are nested more than 100 deep here";
                    found.push(Diagnostic::new(Code::ProgramTooLarge, name.span, message));
                }
            }
        }
        open.pop();
        if !done.contains(&id) {
            done.push(id);
        }
    }
}

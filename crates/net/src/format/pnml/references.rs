//! Resolution of ids: a reference node stands for the node at the end of its chain.

use super::contents::{Contents, Item, Kind};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::{Source, Span};
use petril_base::xml::attribute_at;

/// Resolved references.
pub struct References<'a, 's> {
    source: &'s Source,
    contents: &'a Contents<'s>,
    /// Place or transition that each item is or stands for; `None` if an error was reported.
    ends: Vec<Option<u32>>,
}

/// State of the traversal of a reference node.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Progress {
    Untouched,
    /// The item is on the current chain.
    OnChain,
    Done,
}

impl<'a, 's> References<'a, 's> {
    pub fn of(contents: &'a Contents<'s>, source: &'s Source, diagnostics: &mut Vec<Diagnostic>) -> Self {
        let items = &contents.items;
        let mut references = Self { source, contents, ends: vec![None; items.len()] };
        let mut progress = vec![Progress::Untouched; items.len()];
        let mut chain = Vec::new();
        for start in 0..items.len() {
            let mut at = start;
            let end = loop {
                match progress[at] {
                    Progress::Done => break references.ends[at],
                    Progress::OnChain => {
                        diagnostics.push(references.circle(&items[at]));
                        break None;
                    }
                    Progress::Untouched => {}
                }
                progress[at] = Progress::OnChain;
                chain.push(at);
                let Some(target) = items[at].stands_for else { break Some(at as u32) };
                match references.target(&items[at], target) {
                    Ok(next) => at = next,
                    Err(diagnostic) => {
                        diagnostics.push(*diagnostic);
                        break None;
                    }
                }
            };
            for item in chain.drain(..) {
                progress[item] = Progress::Done;
                references.ends[item] = end;
            }
        }
        references
    }

    /// Item that the id at a position refers to: `Err` if there is none, `Ok(None)` if an error in it was reported
    /// before.
    pub fn find(&self, id: Span) -> Result<Option<usize>, Box<Diagnostic>> {
        match self.contents.ids.find(&attribute_at(self.source, id)) {
            Some(Some(item)) => Ok(self.ends[item].map(|end| end as usize)),
            _ => Err(self.unknown(id)),
        }
    }

    /// Item that a reference node refers to.
    fn target(&self, from: &Item<'_>, target: Span) -> Result<usize, Box<Diagnostic>> {
        let id = attribute_at(self.source, target);
        let next = self.contents.ids.find(&id).flatten().ok_or_else(|| self.unknown(target))?;
        if self.contents.items[next].kind == from.kind {
            return Ok(next);
        }
        let (own, other) = match from.kind {
            Kind::Place => ("place", "transition"),
            Kind::Transition => ("transition", "place"),
        };
        let message = format!("a reference {own} cannot stand for the {other} `{id}`");
        Err(Box::new(Diagnostic::new(Code::NetReference, target, message)))
    }

    fn unknown(&self, id: Span) -> Box<Diagnostic> {
        let message = format!("there is no place or transition with the id `{}`", attribute_at(self.source, id));
        Box::new(Diagnostic::new(Code::NetReference, id, message))
    }

    fn circle(&self, item: &Item<'_>) -> Diagnostic {
        let id = attribute_at(self.source, item.id);
        let message = format!("the reference node `{id}` stands for itself in a circle");
        Diagnostic::new(Code::NetReference, item.stands_for.unwrap_or(item.id), message)
            .help("let the last reference of the chain name a place or transition")
    }
}

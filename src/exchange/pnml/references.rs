//! Ids to nodes: each is unique, and reference nodes stand for what is at the end of their chain.

use std::collections::HashMap;

use super::contents::{Contents, Item, Kind};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::xml::Text;

/// Whom an id means.
pub struct References<'a> {
    by_id: HashMap<&'a str, usize>,
    /// For each item the place or transition it is or stands for; `None` if that is reported.
    ends: Vec<Option<usize>>,
}

/// How far a reference node has been followed.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Progress {
    Untouched,
    /// It is on the chain that is being followed.
    OnChain,
    Done,
}

impl<'a> References<'a> {
    pub fn of(contents: &'a Contents, diagnostics: &mut Vec<Diagnostic>) -> Self {
        let items = &contents.items;
        let mut references = Self { by_id: ids(contents, diagnostics), ends: vec![None; items.len()] };
        let mut progress = vec![Progress::Untouched; items.len()];
        for start in 0..items.len() {
            let mut chain = Vec::new();
            let mut at = start;
            let end = loop {
                match progress[at] {
                    Progress::Done => break references.ends[at],
                    Progress::OnChain => {
                        diagnostics.push(circle(&items[at]));
                        break None;
                    }
                    Progress::Untouched => {}
                }
                progress[at] = Progress::OnChain;
                chain.push(at);
                let Some(target) = &items[at].stands_for else { break Some(at) };
                match references.target(items, &items[at], target) {
                    Ok(next) => at = next,
                    Err(diagnostic) => {
                        diagnostics.push(*diagnostic);
                        break None;
                    }
                }
            };
            for item in chain {
                progress[item] = Progress::Done;
                references.ends[item] = end;
            }
        }
        references
    }

    /// The item an id means: `Err` if there is none, `Ok(None)` if there is one and what is wrong with it is reported.
    pub fn find(&self, id: &Text) -> Result<Option<usize>, Box<Diagnostic>> {
        match self.by_id.get(id.text.as_str()) {
            Some(&item) => Ok(self.ends[item]),
            None => Err(unknown(id)),
        }
    }

    fn target(&self, items: &[Item], from: &Item, target: &Text) -> Result<usize, Box<Diagnostic>> {
        let &next = self.by_id.get(target.text.as_str()).ok_or_else(|| unknown(target))?;
        if items[next].kind == from.kind {
            return Ok(next);
        }
        let (own, other) = match from.kind {
            Kind::Place => ("place", "transition"),
            Kind::Transition => ("transition", "place"),
        };
        let message = format!("a reference {own} cannot stand for the {other} `{}`", target.text);
        Err(Box::new(Diagnostic::new(Code::NetReference, target.span, message)))
    }
}

fn ids<'a>(contents: &'a Contents, diagnostics: &mut Vec<Diagnostic>) -> HashMap<&'a str, usize> {
    let mut first: HashMap<&str, Span> = HashMap::new();
    let mut by_id = HashMap::new();
    let items = contents.items.iter().enumerate().map(|(i, item)| (&item.id, Some(i)));
    for (id, item) in items.chain(contents.other_ids.iter().map(|id| (id, None))) {
        let earlier = *first.entry(&id.text).or_insert(id.span);
        if earlier != id.span {
            let message = format!("the id `{}` is given twice", id.text);
            diagnostics.push(
                Diagnostic::new(Code::NetReference, id.span, message)
                    .here("given again")
                    .also(earlier, "first given here"),
            );
        } else if let Some(item) = item {
            by_id.insert(id.text.as_str(), item);
        }
    }
    by_id
}

fn unknown(id: &Text) -> Box<Diagnostic> {
    let message = format!("there is no place or transition with the id `{}`", id.text);
    Box::new(Diagnostic::new(Code::NetReference, id.span, message))
}

fn circle(item: &Item) -> Diagnostic {
    let message = format!("the reference node `{}` stands for itself in a circle", item.id.text);
    let span = item.stands_for.as_ref().map_or(item.id.span, |target| target.span);
    Diagnostic::new(Code::NetReference, span, message)
        .help("let the last reference of the chain name a place or transition")
}

//! A source file with switches in it, and which faults a place in it belongs to.

use std::iter::Peekable;
use std::ops::Range;

use crate::find::{Found, Place};

/// An instrumented text.
#[derive(Default)]
pub struct Spliced {
    pub text: String,
    /// Where the code of each fault stands.
    faulty: Vec<(Range<usize>, u32)>,
    /// Where switches stand, with what they leave as it was.
    switches: Vec<(Range<usize>, Vec<u32>)>,
}

impl Spliced {
    /// Faults to leave out because of an error that the compiler sees at this place.
    pub fn blamed(&self, at: &Range<usize>) -> Vec<u32> {
        let inside = self.faulty.iter().filter(|(range, _)| range.start <= at.start && at.end <= range.end);
        if let Some((_, number)) = inside.min_by_key(|(range, _)| range.len()) {
            return vec![*number];
        }
        let around = self.switches.iter().filter(|(range, _)| range.start <= at.start && at.end <= range.end);
        around.min_by_key(|(range, _)| range.len()).map(|(_, numbers)| numbers.clone()).unwrap_or_default()
    }

    /// Faults on the lines of this place, and on this many before and after them.
    pub fn near(&self, at: &Range<usize>, lines: usize) -> Vec<u32> {
        let start = self.text[..at.start].rmatch_indices('\n').nth(lines).map_or(0, |(found, _)| found);
        let end = self.text[at.end..].match_indices('\n').nth(lines);
        let end = end.map_or(self.text.len(), |(found, _)| at.end + found);
        let near = self.switches.iter().filter(|(range, _)| range.start < end && start < range.end);
        near.flat_map(|(_, numbers)| numbers.iter().copied()).collect()
    }
}

/// Switches of one place, in the order of the faults.
struct Switch<'f> {
    range: Range<usize>,
    place: Place,
    found: Vec<&'f Found>,
}

pub fn splice(source: &str, found: &[&Found]) -> Spliced {
    let mut sorted = found.to_vec();
    sorted.sort_by_key(|found| (found.range.start, usize::MAX - found.range.end, found.place, found.fault.number));
    let mut switches: Vec<Switch<'_>> = Vec::new();
    for found in sorted {
        match switches.last_mut() {
            Some(last) if last.range == found.range && last.place == found.place => last.found.push(found),
            _ => switches.push(Switch { range: found.range.clone(), place: found.place, found: vec![found] }),
        }
    }
    let mut spliced = Spliced::default();
    write(&mut spliced, source, 0..source.len(), &mut switches.into_iter().peekable());
    spliced
}

fn write<'f>(
    out: &mut Spliced,
    source: &str,
    range: Range<usize>,
    switches: &mut Peekable<impl Iterator<Item = Switch<'f>>>,
) {
    let mut at = range.start;
    while let Some(switch) = switches.next_if(|next| next.range.end <= range.end) {
        out.text += &source[at..switch.range.start];
        at = switch.range.end;
        let start = out.text.len();
        match switch.place {
            Place::Guard => {
                let on = switch.found.iter().map(|found| format!("!petril_base::mutant::on({})", found.fault.number));
                out.text += &format!(" if {} ", on.collect::<Vec<_>>().join(" && "));
            }
            Place::Entry => choices(out, &switch, "if", ""),
            Place::Expression | Place::Statement => {
                choices(out, &switch, if switch.place == Place::Expression { "(if" } else { "if" }, " else ");
                out.text += "{ ";
                write(out, source, switch.range.clone(), switches);
                out.text += if switch.place == Place::Expression { " })" } else { " }" };
            }
        }
        let numbers = switch.found.iter().map(|found| found.fault.number).collect();
        out.switches.push((start..out.text.len(), numbers));
    }
    out.text += &source[at..range.end];
}

fn choices(out: &mut Spliced, switch: &Switch<'_>, first: &str, last: &str) {
    for (i, found) in switch.found.iter().enumerate() {
        let word = if i == 0 { first } else { " else if" };
        out.text += &format!("{word} petril_base::mutant::on({}) {{ ", found.fault.number);
        let start = out.text.len();
        out.text += &found.text;
        out.faulty.push((start..out.text.len(), found.fault.number));
        out.text += " }";
    }
    out.text += last;
}

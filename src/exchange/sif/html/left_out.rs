//! Excluded valuations, with the restrictions that exclude them.

use fixedbitset::FixedBitSet;

use super::markup::{code, escaped, row, table};
use crate::exchange::sif::Sheets;
use petril_spec::sif::{Excluded, SignalId};

/// Section on what is left out of the tests of a function.
pub fn left_out(sheets: &Sheets<'_>, excluded: &Excluded) -> String {
    let specification = sheets.specification;
    let name = |at: usize| specification.restrictions[at].name.as_str();
    let triggering = match &excluded.triggering {
        Some(count) => format!("; {count} of them make an output TRUE"),
        None => String::new(),
    };
    let mut out = format!(
        "<div class=\"left-out\">\n<h3>What is left out</h3>\n<p>The inputs of the function have {} valuations{triggering}. \
         Restrictions exclude some of these, as they cannot be:</p>\n",
        excluded.valuations
    );
    if excluded.by_restriction.is_empty() {
        return out + "<p class=\"hint\">Nothing is excluded.</p>\n</div>\n";
    }
    let rows = excluded.by_restriction.iter().map(|(at, count, alone)| {
        let restriction = &specification.restrictions[*at];
        row([code(&restriction.name), code(&restriction.text), count.clone(), alone.clone()])
    });
    out += &table("plain counts", &["Restriction", "What cannot be, or always is", "Excluded", "By it alone"], rows);
    if let Some(listed) = excluded.listed.as_ref().filter(|listed| !listed.is_empty()) {
        let line = |(ones, by): &(FixedBitSet, Vec<usize>)| {
            let inputs: Vec<SignalId> = specification.inputs().filter(|id| ones.contains(id.0)).collect();
            let names: Vec<String> = inputs.iter().map(|&id| escaped(specification.name(id))).collect();
            let names = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
            let by: Vec<String> = by.iter().map(|at| code(name(*at))).collect();
            row([names, by.join(", ")])
        };
        out += "<h4>Each of them</h4>\n";
        out += &table("plain listed", &["Inputs that are TRUE", "Excluded by"], listed.iter().map(line));
    }
    out + "</div>\n"
}

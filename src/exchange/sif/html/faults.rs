//! Mutation score of tests: faults of the formulas and, if the tests were run, of the program.

use super::markup::{counted, escaped, row, table, ticked};
use crate::exchange::sif::Ran;
use petril_spec::sif::{Coverage, Fate, Hunt, Mutant, SignalId, Specification};

/// Upper bound on faults listed.
const MAX_LISTED: usize = 60;

/// Section on faults of the formulas of a function.
pub fn coverage(specification: &Specification, coverage: &Coverage) -> String {
    if coverage.classes.is_empty() {
        return String::new();
    }
    let sum = |of: fn(&petril_spec::sif::ClassCoverage) -> usize| coverage.classes.iter().map(of).sum::<usize>();
    let undecided = sum(|class| class.undecided);
    let seen = sum(|class| class.faults) - sum(|class| class.equivalent) - undecided;
    let killed = sum(|class| class.killed);
    let rows = coverage.classes.iter().map(|class| {
        let missed = (class.faults - class.equivalent - class.undecided).saturating_sub(class.killed);
        let counts = [class.faults, class.equivalent, class.killed, missed].map(|count| count.to_string());
        row(std::iter::once(escaped(class.class)).chain(counts))
    });
    let heads = ["Kind of fault", "Faults", "Cannot be seen", "Found", "Missed"];
    let mut out = format!(
        "<div class=\"coverage\">\n<h3>Faults that these tests find</h3>\n<p>{killed} of {} that can be seen are found{}.</p>\n{}",
        counted(seen, "single fault"),
        if undecided > 0 { format!("; of {undecided} it is not decided") } else { String::new() },
        table("plain counts", &heads, rows)
    );
    if !coverage.missed.is_empty() {
        let line = |missed: &petril_spec::sif::Missed| {
            let inputs: Vec<SignalId> = specification.inputs().filter(|id| missed.shown_by.contains(id.0)).collect();
            let names: Vec<&str> = inputs.iter().map(|&id| specification.name(id)).collect();
            let names = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
            row([escaped(missed.class), ticked(&missed.fault), escaped(&names), escaped(&missed.why)])
        };
        out += "<h4>Missed</h4>\n";
        let heads = ["Kind", "Fault", "Seen where these inputs are TRUE", "Why no test finds it"];
        out += &table("plain missed", &heads, coverage.missed.iter().take(MAX_LISTED).map(line));
        out += &more(coverage.missed.len());
    }
    out + "</div>\n"
}

/// Section on faults of the program.
pub fn hunt(ran: &Ran<'_>, hunt: &Hunt) -> String {
    let line =
        |name: &str, counts: [usize; 5]| row(std::iter::once(escaped(name)).chain(counts.map(|c| c.to_string())));
    let classes = Mutant::CLASSES.iter().map(|class| (*class, hunt.counts(Some(class))));
    let classes = classes.filter(|(_, counts)| counts[0] > 0).map(|(class, counts)| line(class, counts));
    let all = std::iter::once(line("all", hunt.counts(None)));
    let heads = ["Kind of fault", "Faults", "Found", "Makes no difference", "Missed", "Not decided"];
    let mut out = format!(
        "<section class=\"function mutants\">\n<h2>Faults of the program <span>{}, one at a time</span></h2>\n{}",
        escaped(ran.source.name()),
        table("plain counts", &heads, classes.chain(all))
    );
    let left: Vec<&(Mutant, Fate)> = hunt.mutants.iter().filter(|(_, fate)| !matches!(fate, Fate::Found(..))).collect();
    let rows = left.iter().take(MAX_LISTED).map(|(mutant, fate)| {
        let fate = match fate {
            Fate::Equivalent => "makes no difference".to_owned(),
            Fate::Undecided(why) => format!("not decided: {}", escaped(why)),
            Fate::Missed | Fate::Found(..) => "missed".to_owned(),
        };
        let number = ran.source.line_of(ran.program().code[mutant.line].span.start);
        row([number.to_string(), ticked(&mutant.fault), fate])
    });
    if !left.is_empty() {
        out += "<h4>Not found</h4>\n";
        out += &table("plain missed", &["Line", "Fault", "What is known of it"], rows);
        out += &more(left.len());
    }
    out + "</section>\n"
}

fn more(count: usize) -> String {
    let more = count.saturating_sub(MAX_LISTED);
    if more == 0 { String::new() } else { format!("<p class=\"hint\">… and {more} more</p>\n") }
}

//! Assertions in the scan view: every scan is executed again and the formula evaluated where control reaches the line.

use super::failing::what_is_missing;
use super::views::ScanView;
use super::{Answer, Note, Outcome, Trace, Witness};
use crate::requirement::{Assertion, Moment};
use crate::scans::{ScanRun, Seen, first_at_lines};
use crate::translate::PlaceRole;
use crate::witness::{Disagreement, replay_lines, scan_trace_to};
use petril_lang::semantics::VarId;
use petril_logic::Bound;
use petril_search::Stop;

/// Checks all assertions on the explored scans.
pub fn answers(view: &ScanView<'_>, assertions: &[Assertion], stopped: &mut dyn FnMut() -> bool) -> Vec<Answer> {
    if assertions.is_empty() {
        return Vec::new();
    }
    // Each pair of an assertion and a line is watched separately.
    let watched: Vec<(&Assertion, usize)> =
        assertions.iter().flat_map(|assertion| assertion.lines.iter().map(move |&line| (assertion, line))).collect();
    let lines: Vec<usize> = watched.iter().map(|&(_, line)| line).collect();
    let is_wrong = |position: usize, before: &dyn Fn(VarId) -> u64, now: &dyn Fn(VarId) -> u64| {
        watched[position].0.formula.holds_in(&Moment { before, now }) != Some(true)
    };
    let found = first_at_lines(&view.space, &view.graph, &lines, &is_wrong, stopped);
    let outcome = |assertion: &Assertion| {
        let Some(found) = &found else {
            return Outcome::Unknown(match view.graph.stop() {
                Stop::Complete => "the check was ended before all scans were looked at".to_owned(),
                _ => what_is_missing(&view.graph),
            });
        };
        let own = |seen: &&Seen| std::ptr::eq(watched[seen.watched].0, assertion);
        // States are numbered by distance (breadth-first); the scan from power-on (`None`) comes before them.
        match found.iter().flatten().filter(own).min_by_key(|seen| seen.from) {
            Some(seen) => shown(view, &assertion.formula, watched[seen.watched].1, seen)
                .unwrap_or_else(|disagreement| Outcome::refuted(&disagreement.to_string())),
            None if view.graph.is_complete() && view.graph.knows_initial() => Outcome::holds(),
            None => Outcome::Unknown(what_is_missing(&view.graph)),
        }
    };
    assertions.iter().map(|assertion| answer(assertion, outcome(assertion))).collect()
}

/// Builds the answer to an assertion.
pub fn answer(assertion: &Assertion, outcome: Outcome) -> Answer {
    Answer {
        name: assertion.name.clone(),
        sentence: assertion.sentence.clone(),
        words: Some(format!("Whenever control comes to source line {}, this is so.", assertion.origin.line)),
        tags: Vec::new(),
        formula: assertion.text.clone(),
        origin: Some(assertion.origin.clone()),
        variables: assertion.formula.mentions().variables.into_iter().collect(),
        outcome,
        independent: None,
        remark: None,
        recalled: false,
    }
}

/// Replays the run whose last scan reaches the line with the formula false.
fn shown(view: &ScanView<'_>, formula: &Bound, line: usize, seen: &Seen) -> Result<Outcome, Disagreement> {
    let (space, graph) = (&view.space, &view.graph);
    let path = seen.from.map(|state| graph.path_to(state)).unwrap_or_default();
    let states: Vec<&[u64]> = path.iter().map(|&state| graph.state(state)).collect();
    let reads = |run: &ScanRun<'_>| {
        run.plant == seen.plant && seen.inputs.iter().all(|&(input, value)| run.machine.value(input) == value)
    };
    let Some(trace) = scan_trace_to(space, &states, &reads) else {
        return Err(Disagreement("a scan that was seen cannot be found again".to_owned()));
    };
    let system = space.system();
    let (last, there) = (trace.scans.len() - 1, system.place(PlaceRole::Line(line)));
    let mut is_broken = false;
    let at_line = |scan: usize, replay: &crate::witness::Replay<'_>, recalled: &crate::witness::Recalled| {
        if scan == last && replay.marking().is_marked(there) {
            let (before, now) = (|id| recalled.value(id), |id| replay.value(id));
            is_broken |= formula.holds_in(&Moment { before: &before, now: &now }) == Some(false);
        }
    };
    replay_lines(system, &trace, at_line, |_, recalled| view.check_assumptions(recalled))?;
    if !is_broken {
        return Err(Disagreement("the replay comes to the line and finds what was asserted".to_owned()));
    }
    let words = system.program.text(system.program.code[line].instruction);
    let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
    let text = format!("before line {} of the flat code (`{words}`), `{}` was false", line + 1, formula.text(system));
    let notes = vec![Note { first: last, last, text }];
    Ok(Outcome::Violated(Witness { trace: Trace::Scans(trace), notes }, None))
}

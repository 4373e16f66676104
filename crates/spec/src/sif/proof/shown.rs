//! Reported results: replayed and simplified runs, assumptions, and remarks.

use fixedbitset::FixedBitSet;

use super::disagreement;
use super::run::{Failure, Given, Scan, run};
use super::subject::Subject;
use crate::sif::{Kind, Scope};
use petril_lang::circuit::NoGates;
use petril_lang::flat::Hazard;
use petril_lang::semantics::Role;

/// Longest run whose scans are simplified one by one.
const MAX_SCANS: usize = 32;

/// Evidence in the last scan of a run.
#[derive(Clone, Copy, Debug)]
pub(super) enum Shown {
    /// The claim at this position is violated.
    Wrong(usize),
    /// The scan fails.
    Failure(Failure),
}

impl Shown {
    /// Replays the run with these inputs by the interpreter, and sets as many inputs to rest as possible.
    ///
    /// # Errors
    /// The run does not show the evidence.
    pub(super) fn replayed(self, subject: &Subject<'_>, given: &[Given]) -> Result<Vec<Scan>, String> {
        let scans = run(subject, given);
        if !self.is_shown(subject, &scans) {
            return Err(disagreement("the interpreter does not do what the solver says"));
        }
        Ok(self.at_rest(subject, given.to_vec(), scans))
    }

    fn is_shown(self, subject: &Subject<'_>, scans: &[Scan]) -> bool {
        let Some((last, before)) = scans.split_last() else { return false };
        let kept = match self {
            Self::Wrong(claim) => &subject.claims[claim].restrictions,
            Self::Failure(_) => &subject.everywhere,
        };
        let keeps = |scan: &Scan| scan.broken.iter().all(|broken| !kept.contains(broken));
        let is_shown = match self {
            Self::Wrong(claim) => {
                let claim = &subject.claims[claim];
                let is = last.memory[claim.variable.0] == 1;
                last.failure.is_none() && !claim.form.fits(is, last.wanted[claim.signal.0])
            }
            Self::Failure(failure) => last.failure == Some(failure),
        };
        is_shown && scans.iter().all(keeps) && before.iter().all(|scan| scan.failure.is_none())
    }

    /// Simplifies a run: sets inputs to rest one by one, in all scans or in one, where the evidence persists.
    fn at_rest(self, subject: &Subject<'_>, mut given: Vec<Given>, mut scans: Vec<Scan>) -> Vec<Scan> {
        let inputs = given.first().map_or(0, |given| given.inputs.len() + given.outside.len());
        let mut rests = vec![0; inputs];
        let specification = subject.specification;
        for (rest, &(variable, _)) in rests.iter_mut().zip(given.iter().flat_map(|given| &given.inputs)) {
            let own = subject.inputs().find(|(_, own)| *own == variable);
            *rest = match own {
                Some((id, _)) => u64::from(specification.rest(id)),
                None => subject.program.variable(variable).initial,
            };
        }
        let outside = subject.outside.iter().map(|&id| u64::from(specification.rest(id)));
        let first = inputs - subject.outside.len().min(inputs);
        rests.splice(first.., outside);
        let every = 0..given.len();
        // Each attempt costs a run of the full length.
        let each = if scans.len() <= MAX_SCANS { every.clone() } else { 0..0 };
        let choices = std::iter::once(every).chain(each.map(|scan| scan..scan + 1));
        for (choice, input) in choices.flat_map(|choice| (0..inputs).map(move |input| (choice.clone(), input))) {
            let mut tried = given.clone();
            for given in &mut tried[choice] {
                match given.inputs.get_mut(input) {
                    Some((_, value)) => *value = rests[input],
                    None => given.outside[input - first].1 = rests[input] == 1,
                }
            }
            if tried == given {
                continue;
            }
            let run = run(subject, &tried);
            if self.is_shown(subject, &run) {
                (given, scans) = (tried, run);
            }
        }
        scans
    }
}

/// Assumptions of the proofs, in words.
pub(super) fn assumptions(subject: &Subject<'_>) -> Vec<String> {
    let (specification, program) = (subject.specification, subject.program);
    let mut assumptions = Vec::new();
    for scope in scopes(subject) {
        let of = match scope {
            Scope::System => String::new(),
            Scope::Zone(zone) => format!(" for zone {}", specification.zones[zone].name),
            Scope::Function(function) => format!(" for function {}", specification.functions[function].name),
        };
        let own = subject.restrictions.iter().map(|&at| &specification.restrictions[at]);
        let own = own.filter(|own| own.scope == scope).map(|own| format!("{}: {}", own.name, own.text));
        assumptions.push(format!("in every scan{of}, {}", own.collect::<Vec<_>>().join("; ")));
    }
    let bound: Vec<_> = subject.inputs().map(|(_, variable)| variable).collect();
    let free: Vec<&str> = program
        .with_role(Role::Input)
        .filter(|input| !bound.contains(input))
        .map(|input| program.variable(input).name.as_str())
        .collect();
    if !free.is_empty() {
        assumptions.push(format!("inputs that no formula names have any value: {}", few(&free)));
    }
    if !subject.outside.is_empty() {
        let names: Vec<&str> = subject.outside.iter().map(|&id| specification.name(id)).collect();
        assumptions
            .push(format!("inputs that the program does not have are as restrictions need them: {}", few(&names)));
    }
    let named = named(subject);
    let delayed = subject.definitions.iter().filter(|id| subject.is_delayed(**id) && named.contains(id.0));
    let delayed: Vec<&str> = delayed.map(|&id| specification.name(id)).collect();
    if !delayed.is_empty() {
        let names = few(&delayed);
        assumptions.push(format!("where a formula names a delayed output, it has the value of the program: {names}"));
    }
    if subject.claims.iter().any(|claim| subject.latch(claim.signal).is_some()) {
        assumptions.push("before the first scan, nothing is latched".to_owned());
    }
    let hazards = program.hazards();
    if subject.tolerated.overflow && hazards.contains(&Hazard::Overflow) {
        assumptions.push("numbers that do not fit their type wrap around".to_owned());
    }
    if subject.tolerated.division_by_zero && hazards.contains(&Hazard::DivisionByZero) {
        assumptions.push("a division by zero gives 0".to_owned());
    }
    if let Some(time) = program.scan_time {
        assumptions.push(format!("a scan begins every {time} ms; during a scan the clock stands still"));
        if program.presets_vary {
            assumptions.push("a timer's preset time does not grow while the timer runs and is not called".to_owned());
        }
    }
    assumptions
}

/// Signals that restrictions and definitions mention.
fn named(subject: &Subject<'_>) -> FixedBitSet {
    let mut named = FixedBitSet::with_capacity(subject.specification.signals.len());
    let restrictions = subject.restrictions.iter().map(|&at| &subject.specification.restrictions[at].allowed);
    let definitions = subject.definitions.iter().filter_map(|&id| subject.specification.definition(id));
    let resets = subject.definitions.iter().filter_map(|&id| subject.latch(id));
    for formula in restrictions.chain(definitions).chain(resets) {
        formula.each_signal(&mut |id| named.insert(id.0));
    }
    named
}

/// Scopes of the restrictions, in their order.
fn scopes(subject: &Subject<'_>) -> Vec<Scope> {
    let mut scopes: Vec<Scope> = Vec::new();
    for &position in &subject.restrictions {
        let scope = subject.specification.restrictions[position].scope;
        if !scopes.contains(&scope) {
            scopes.push(scope);
        }
    }
    scopes
}

/// Further remarks.
pub(super) fn remarks(subject: &Subject<'_>) -> Vec<String> {
    let (specification, program) = (subject.specification, subject.program);
    let claimed: Vec<_> = subject.claims.iter().map(|claim| claim.variable).collect();
    let others = program.with_role(Role::Output).filter(|output| !claimed.contains(output));
    let others: Vec<&str> = others.map(|output| program.variable(output).name.as_str()).collect();
    let mut remarks = Vec::new();
    if !others.is_empty() {
        remarks.push(format!("nothing is claimed of these outputs of the program: {}", few(&others)));
    }
    for claim in &subject.claims {
        if let Kind::Defined { delayed: Some(delay), .. } = specification.signal(claim.signal).kind {
            let name = specification.name(claim.signal);
            remarks.push(format!(
                "of `{name}` nothing is claimed but that it is never TRUE without its formula; that it comes after {delay} ms is \
                 not proved: `petril sif requirements` says it for `petril check`"
            ));
        }
    }
    remarks
}

/// Some names, and the number of the others.
fn few(names: &[&str]) -> String {
    let shown: Vec<String> = names.iter().take(8).map(|name| format!("`{name}`")).collect();
    let more = names.len().saturating_sub(8);
    shown.join(", ") + &if more > 0 { format!(" and {more} more") } else { String::new() }
}

/// Reason why a program has no gates.
pub(super) fn no_gates(subject: &Subject<'_>, no_gates: NoGates) -> String {
    let line = no_gates.line() + 1;
    let name = &subject.program.name;
    match no_gates {
        NoGates::Back(_) => format!("control of `{name}` goes back in line {line} of its flat code"),
        NoGates::Instruction(_) => format!("line {line} of the flat code of `{name}` cannot be made into gates"),
        NoGates::TooMany(_) => format!("`{name}` takes too many gates by line {line} of its flat code"),
    }
}

//! Restrictions that contradict each other, are implied, or concern nothing.

use fixedbitset::FixedBitSet;

use super::super::cone::{Cone, inputs_of};
use super::super::formula::SignalId;
use super::super::solver::{Answer, Literal, Stop};
use super::super::specification::{Restriction, Scope, Specification};
use super::closed;
use super::finding::{Doubt, Finding};
use super::model::Model;

/// Consistency of restrictions, by scope.
pub struct Consistency {
    /// Whether the restrictions of the whole system are contradictory, or this is open.
    pub is_broken_everywhere: bool,
    zones: Vec<bool>,
    functions: Vec<bool>,
}

impl Consistency {
    /// Whether a function has allowed valuations.
    pub fn is_sound(&self, function: usize) -> bool {
        !self.functions[function]
    }

    /// Whether a scope has allowed valuations.
    fn is_sound_for(&self, scope: Scope) -> bool {
        match scope {
            Scope::System => !self.is_broken_everywhere,
            Scope::Zone(zone) => !self.zones[zone],
            Scope::Function(function) => !self.functions[function],
        }
    }
}

/// Model of all restrictions, with the signals they mention.
pub fn all<'s>(specification: &'s Specification, roots: Vec<SignalId>, stop: &Stop) -> Model<'s> {
    let mut signals = roots;
    let mut seen = specification.valuation(signals.iter().copied());
    for restriction in &specification.restrictions {
        restriction.allowed.each_signal(&mut |signal| {
            if !seen.put(signal.0) {
                signals.push(signal);
            }
        });
    }
    let restrictions: Vec<&Restriction> = specification.restrictions.iter().collect();
    let cone: Cone<'s> = closed(specification, signals, &restrictions);
    Model::new(specification, cone, stop)
}

/// Whether a restriction of scope `outer` applies to everything in scope `inner`.
pub fn covers(specification: &Specification, outer: Scope, inner: Scope) -> bool {
    match (outer, inner) {
        (Scope::System, _) => true,
        (Scope::Zone(zone), Scope::Function(function)) => specification.functions[function].zone == Some(zone),
        _ => outer == inner,
    }
}

/// Restrictions that apply to everything in a scope.
pub fn kept(specification: &Specification, of: &[(usize, Literal)], scope: Scope) -> Vec<(usize, Literal)> {
    of.iter().copied().filter(|(at, _)| covers(specification, specification.restrictions[*at].scope, scope)).collect()
}

/// Contradictory restrictions: of the system, of a zone, of a function.
pub fn contradictions(specification: &Specification, stop: &Stop) -> (Vec<Finding>, Consistency) {
    let mut model = all(specification, Vec::new(), stop);
    let mut findings = Vec::new();
    let mut state = Consistency {
        is_broken_everywhere: false,
        zones: vec![false; specification.zones.len()],
        functions: vec![false; specification.functions.len()],
    };
    let mut broken = |scope: Scope, has_own: bool| {
        if !has_own {
            return false;
        }
        let kept = kept(specification, &model.restrictions, scope);
        let answer = model.ask_keeping(&[], &kept);
        let mut finding = match answer {
            Answer::Satisfiable => return false,
            Answer::Unsatisfiable => {
                let core = model.blame(&[], &kept);
                let place = core.first().map(|at| specification.restrictions[*at].place).unwrap_or_default();
                // All restrictions of the core but the last.
                let rest: Vec<_> = kept
                    .iter()
                    .copied()
                    .filter(|(at, _)| core.split_last().is_some_and(|c| c.1.contains(at)))
                    .collect();
                let is_found = !rest.is_empty() && model.ask_keeping(&[], &rest) == Answer::Satisfiable;
                let example = is_found.then(|| model.told(&[], &core, true));
                Finding::new(Doubt::Contradiction, place).because(core, example)
            }
            Answer::Stopped => {
                let own = specification.restrictions.iter().find(|restriction| restriction.scope == scope);
                let place = own.map(|restriction| restriction.place).unwrap_or_default();
                let whose = match scope {
                    Scope::System => "of the system".to_owned(),
                    Scope::Zone(zone) => format!("of the zone `{}`", specification.zones[zone].name),
                    Scope::Function(function) => {
                        format!("of the function `{}`", specification.functions[function].name)
                    }
                };
                Finding::open(place, format!("the restrictions {whose} can all be kept"))
            }
        };
        if let Scope::Function(function) = scope {
            finding = finding.of(function);
        }
        findings.push(finding);
        true
    };
    let has = |scope: Scope| specification.restrictions.iter().any(|restriction| restriction.scope == scope);
    state.is_broken_everywhere = broken(Scope::System, has(Scope::System));
    if !state.is_broken_everywhere {
        for zone in 0..specification.zones.len() {
            state.zones[zone] = broken(Scope::Zone(zone), has(Scope::Zone(zone)));
        }
        for (at, function) in specification.functions.iter().enumerate() {
            let is_zone_broken = function.zone.is_some_and(|zone| state.zones[zone]);
            state.functions[at] = is_zone_broken || broken(Scope::Function(at), has(Scope::Function(at)));
        }
    }
    (findings, state)
}

/// Implied restrictions, from the last to the first, so that all reported ones can be removed at once.
pub fn implied(specification: &Specification, state: &Consistency, stop: &Stop) -> Vec<Finding> {
    let mut model = all(specification, Vec::new(), stop);
    let mut left = model.restrictions.clone();
    let mut findings = Vec::new();
    for (at, literal) in model.restrictions.clone().into_iter().rev() {
        let restriction = &specification.restrictions[at];
        if !state.is_sound_for(restriction.scope) {
            continue;
        }
        let others: Vec<_> = kept(specification, &left, restriction.scope).into_iter().filter(|o| o.0 != at).collect();
        match model.ask_keeping(&[!literal], &others) {
            Answer::Satisfiable => {}
            Answer::Unsatisfiable => {
                let core = model.blame(&[!literal], &others);
                let is_found = !core.is_empty() && model.ask(&[!literal]) == Answer::Satisfiable;
                let about = inputs_of(specification, &restriction.allowed);
                let example = is_found.then(|| model.told(&about, &core, true));
                let restrictions = std::iter::once(at).chain(core).collect();
                let finding = Finding::new(Doubt::Implied, restriction.place).formula(restriction.allowed.clone());
                findings.push(finding.because(restrictions, example));
                left.retain(|other| other.0 != at);
            }
            Answer::Stopped => {
                let question = format!("others imply the restriction `{}`", restriction.name);
                findings.push(Finding::open(restriction.place, question));
            }
        }
    }
    findings
}

/// Restrictions that concern no function; `touched` are those that do.
pub fn apart(specification: &Specification, touched: &FixedBitSet) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (at, restriction) in specification.restrictions.iter().enumerate() {
        if !touched.contains(at) && !inputs_of(specification, &restriction.allowed).is_empty() {
            let mut finding = Finding::new(Doubt::Apart, restriction.place).formula(restriction.allowed.clone());
            if let Scope::Function(function) = restriction.scope {
                finding = finding.of(function);
            }
            findings.push(finding.because(vec![at], None));
        }
    }
    findings
}

//! Outputs that are equivalent, or complementary.
//!
//! Most pairs are refuted by valuations: each model found for one pair is kept for all others, with neighbours of it
//! (Kuehlmann, "Dynamic transition relation simplification for bounded property checking", 2004).

use super::super::formula::SignalId;
use super::super::solver::{Answer, Stop};
use super::super::specification::{Kind, Scope, Specification};
use super::finding::{Doubt, Finding};
use super::model::Model;
use super::outputs::equation;
use super::restrictions::{all, kept};

/// Pairs of outputs that are always equal or always opposite under all restrictions that apply to both. Latched,
/// delayed or constant outputs are skipped, and so are functions with open questions or contradictory restrictions.
pub fn outputs(
    specification: &Specification,
    is_left: impl Fn(usize) -> bool,
    constant: &[SignalId],
    stop: &Stop,
) -> Vec<Finding> {
    let mut findings = Vec::new();
    let mut outputs: Vec<(SignalId, usize)> = Vec::new();
    for (function, of) in specification.functions.iter().enumerate().filter(|(at, _)| is_left(*at)) {
        let is_plain = |id: &SignalId| {
            matches!(specification.signal(*id).kind, Kind::Defined { latched: None, delayed: None, .. })
                && !constant.contains(id)
        };
        outputs.extend(of.outputs.iter().copied().filter(is_plain).map(|output| (output, function)));
    }
    let mut model = all(specification, outputs.iter().map(|output| output.0).collect(), stop);
    let mut samples = Samples::new(specification);
    for &(output, function) in &outputs {
        let kept = kept(specification, &model.restrictions, Scope::Function(function));
        for literal in [model.values.formula[output.0], !model.values.formula[output.0]] {
            if model.ask_keeping(&[literal], &kept) == Answer::Satisfiable {
                samples.take(&model);
            }
        }
    }
    let mut is_told = vec![false; outputs.len()];
    for (first, &(a, of_a)) in outputs.iter().enumerate() {
        if is_told[first] {
            continue;
        }
        for (second, &(b, of_b)) in outputs.iter().enumerate().skip(first + 1) {
            let scope = common(specification, of_a, of_b);
            for value in [true, false] {
                if is_told[second] || samples.refute(a, b, value, scope) {
                    continue;
                }
                if stop() {
                    let question = "some outputs are always the same".to_owned();
                    findings.push(Finding::open(equation(specification, a), question));
                    return findings;
                }
                let kept = kept(specification, &model.restrictions, scope);
                let differ = model.solver.xor(model.values.formula[a.0], model.values.formula[b.0]);
                let wanted = [if value { differ } else { !differ }];
                let place = equation(specification, b);
                match model.ask_keeping(&wanted, &kept) {
                    Answer::Satisfiable => samples.take(&model),
                    Answer::Unsatisfiable => {
                        let core = model.blame(&wanted, &kept);
                        let formulas = [a, b].into_iter().filter_map(|id| specification.definition(id));
                        let mut about = Vec::new();
                        for input in formulas.flat_map(|f| super::super::cone::inputs_of(specification, f)) {
                            if !about.contains(&input) {
                                about.push(input);
                            }
                        }
                        let example = model.example(&wanted, &core, &kept, &about);
                        let finding = Finding { value, ..Finding::new(Doubt::Same, place).of(of_b).signals([a, b]) };
                        findings.push(finding.because(core, example));
                        is_told[second] = true;
                    }
                    Answer::Stopped => {
                        let question =
                            format!("`{}` and `{}` are always the same", specification.name(a), specification.name(b));
                        findings.push(Finding::open(place, question).of(of_b));
                    }
                }
            }
        }
    }
    findings
}

/// Smallest scope that contains two functions.
pub fn common(specification: &Specification, a: usize, b: usize) -> Scope {
    let zone = specification.functions[a].zone.filter(|zone| specification.functions[b].zone == Some(*zone));
    match zone {
        _ if a == b => Scope::Function(a),
        Some(zone) => Scope::Zone(zone),
        None => Scope::System,
    }
}

/// Sample of valuations, in words of 64.
struct Samples<'s> {
    specification: &'s Specification,
    /// Words of the signals for each 64 valuations.
    words: Vec<Vec<u64>>,
    /// Valuations allowed by the restrictions of the system, of each zone, and of each function.
    allowed: Vec<(u64, Vec<u64>, Vec<u64>)>,
    inputs: Vec<SignalId>,
    /// State of the random number generator; the seed is fixed.
    lot: u64,
}

impl<'s> Samples<'s> {
    fn new(specification: &'s Specification) -> Self {
        let inputs = specification.inputs().collect();
        Self { specification, words: Vec::new(), allowed: Vec::new(), inputs, lot: 0x9E37_79B9_7F4A_7C15 }
    }

    /// Random number (Marsaglia, "Xorshift RNGs", 2003).
    fn draw(&mut self) -> u64 {
        self.lot ^= self.lot << 13;
        self.lot ^= self.lot >> 7;
        self.lot ^= self.lot << 17;
        self.lot
    }

    /// Adds the model found last, and 63 valuations that differ from it in some inputs.
    fn take(&mut self, model: &Model<'_>) {
        let specification = self.specification;
        let mut words = vec![0_u64; specification.signals.len()];
        for input in model.cone.all_inputs() {
            words[input.0] = if model.is_true(input) { u64::MAX } else { 0 };
        }
        for lane in 1..64 {
            for _ in 0..=lane % 4 {
                let chosen = self.draw() as usize % self.inputs.len().max(1);
                if let Some(input) = self.inputs.get(chosen) {
                    words[input.0] ^= 1 << lane;
                }
            }
        }
        specification.settle(&mut words);
        let functions = &specification.functions;
        let mut allowed = (u64::MAX, vec![u64::MAX; specification.zones.len()], vec![u64::MAX; functions.len()]);
        for restriction in &specification.restrictions {
            let word = restriction.allowed.evaluate(&|signal| words[signal.0]);
            match restriction.scope {
                Scope::System => allowed.0 &= word,
                Scope::Zone(zone) => allowed.1[zone] &= word,
                Scope::Function(function) => allowed.2[function] &= word,
            }
        }
        self.words.push(words);
        self.allowed.push(allowed);
    }

    /// Whether an allowed valuation refutes that two outputs are always equal, or always opposite.
    fn refute(&self, a: SignalId, b: SignalId, same: bool, scope: Scope) -> bool {
        let mut of = self.words.iter().zip(&self.allowed);
        of.any(|(words, (system, zones, functions))| {
            let allowed = system
                & match scope {
                    Scope::System => u64::MAX,
                    Scope::Zone(zone) => zones[zone],
                    Scope::Function(function) => {
                        functions[function]
                            & self.specification.functions[function].zone.map_or(u64::MAX, |zone| zones[zone])
                    }
                };
            let differ = words[a.0] ^ words[b.0];
            allowed & if same { differ } else { !differ } != 0
        })
    }
}

//! Reachable markings of a device, and the checks on them: whether it is safe, and whether every input it drives has
//! exactly one value in each of them.

use std::collections::{BTreeMap, BTreeSet};

use super::component::{Component, LocalMarking, Move};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_lang::flat::FlatProgram;
use petril_lang::semantics::VarId;
use petril_net::net::{Located, PlaceId};

/// Maximum number of markings of a device. Real ones have tens; the limit is for nets that are not devices.
const MAX_MARKINGS: usize = 1 << 16;

/// Maximum number of marked places in all markings of a device together, which bounds their memory.
const MAX_MARKED: usize = 1 << 22;

/// Explores the markings of a component for any values of the outputs. Whatever holds of all these markings holds of
/// those that occur with the program.
pub fn explore(
    component: &mut Component,
    places: &[PlaceId],
    file: &Located,
    program: &FlatProgram,
) -> Result<(), Box<Diagnostic>> {
    let initial: Vec<usize> = (0..component.places.len()).filter(|&place| component.places[place].marked).collect();
    let mut ids = BTreeMap::from([(initial.clone(), 0)]);
    let mut queue = vec![initial];
    let mut parents: Vec<Option<(usize, usize)>> = vec![None];
    let mut markings = Vec::new();
    let mut marked_in_all = queue[0].len();
    let candidates = Candidates::of(component);
    let driven: BTreeSet<VarId> =
        component.places.iter().flat_map(|place| &place.drives).map(|&(input, _)| input).collect();
    let span = |place: usize| file.place_span(places[place]);
    while let Some(marked) = queue.get(markings.len()).cloned() {
        let id = markings.len();
        let history = |parents: &[Option<(usize, usize)>]| history(component, parents, id);
        let inputs = external_values(component, &driven, &marked)
            .map_err(|problem| ambiguous(component, problem, program, &span, &history(&parents)))?;
        let mut moves = Vec::new();
        for position in candidates.at(&marked) {
            let transition = &component.transitions[position];
            let is_marked = |place: &usize| marked.binary_search(place).is_ok();
            if !transition.consume.iter().chain(&transition.read).all(is_marked) {
                continue;
            }
            if let Some(&twice) = transition.produce.iter().find(|place| is_marked(place)) {
                let message =
                    format!("the plant is not safe: `{}` can get a second token", component.places[twice].name);
                let help = format!("`{}` puts it there, {}", transition.name, history(&parents));
                return Err(Box::new(Diagnostic::new(Code::PlantNotSafe, span(twice), message).help(help)));
            }
            let mut next: Vec<usize> = marked.iter().copied().filter(|p| !transition.consume.contains(p)).collect();
            next.extend(&transition.produce);
            next.sort_unstable();
            let target = *ids.entry(next).or_insert_with_key(|next| {
                marked_in_all += next.len();
                queue.push(next.clone());
                parents.push(Some((id, position)));
                queue.len() - 1
            });
            moves.push(Move { transition: position, target });
            if queue.len() > MAX_MARKINGS || marked_in_all > MAX_MARKED {
                let message = format!("the device `{}` has more than {} markings", component.name, queue.len() - 1);
                let at = places.first().map_or(file.transitions[0], |&place| file.place_span(place));
                let help = "that is too many for a device, which is one connected net; split it into independent ones";
                return Err(Box::new(Diagnostic::new(Code::PlantTooLarge, at, message).help(help)));
            }
        }
        markings.push(LocalMarking { marked, inputs, moves });
    }
    component.markings = markings;
    Ok(())
}

/// Index of the transitions that can be enabled in a marking: those whose first place is marked.
struct Candidates {
    /// Transitions by the first place that they consume from or read.
    by_place: Vec<Vec<usize>>,
    /// Transitions with an empty preset.
    always: Vec<usize>,
}

impl Candidates {
    fn of(component: &Component) -> Self {
        let mut candidates = Self { by_place: vec![Vec::new(); component.places.len()], always: Vec::new() };
        for (position, transition) in component.transitions.iter().enumerate() {
            match transition.consume.iter().chain(&transition.read).next() {
                Some(&place) => candidates.by_place[place].push(position),
                None => candidates.always.push(position),
            }
        }
        candidates
    }

    /// Candidates in a marking, ascending.
    fn at(&self, marked: &[usize]) -> Vec<usize> {
        let by_place = marked.iter().flat_map(|&place| &self.by_place[place]);
        let mut positions: Vec<usize> = by_place.chain(&self.always).copied().collect();
        positions.sort_unstable();
        positions
    }
}

/// Input without a value, or with two marked places that give it one.
#[derive(Clone, Copy)]
enum Ambiguity {
    None { input: VarId },
    Several { input: VarId, places: (usize, usize) },
}

/// Value of each driven input, if the marking gives exactly one.
fn external_values(
    component: &Component,
    driven: &BTreeSet<VarId>,
    marked: &[usize],
) -> Result<Vec<(VarId, u64)>, Ambiguity> {
    let mut given: BTreeMap<VarId, (u64, usize)> = BTreeMap::new();
    for &place in marked {
        for &(input, value) in &component.places[place].drives {
            if let Some((_, earlier)) = given.insert(input, (value, place)) {
                return Err(Ambiguity::Several { input, places: (earlier, place) });
            }
        }
    }
    match driven.iter().find(|input| !given.contains_key(input)) {
        Some(&input) => Err(Ambiguity::None { input }),
        None => Ok(given.into_iter().map(|(input, (value, _))| (input, value)).collect()),
    }
}

fn ambiguous(
    component: &Component,
    problem: Ambiguity,
    program: &FlatProgram,
    span: &dyn Fn(usize) -> petril_base::source::Span,
    history: &str,
) -> Box<Diagnostic> {
    let name = |input: VarId| &program.variable(input).name;
    let diagnostic = match problem {
        Ambiguity::Several { input, places: (first, second) } => {
            let message = format!("the input `{}` has two marked places that give it a value", name(input));
            Diagnostic::new(Code::PlantInputAmbiguous, span(second), message).also(span(first), "the other is this one")
        }
        Ambiguity::None { input } => {
            let message = format!("the input `{}` has no value: no place that gives it one is marked", name(input));
            let giving = (0..component.places.len())
                .find(|&place| component.places[place].drives.iter().any(|&(driven, _)| driven == input));
            Diagnostic::new(Code::PlantInputAmbiguous, span(giving.unwrap_or(0)), message)
        }
    };
    Box::new(diagnostic.help(format!("this is so {history}; exactly one such place must be marked, always")))
}

/// Sentence on how a marking is reached.
fn history(component: &Component, parents: &[Option<(usize, usize)>], mut marking: usize) -> String {
    let mut fired = Vec::new();
    while let Some((earlier, transition)) = parents[marking] {
        fired.push(component.transitions[transition].name.as_str());
        marking = earlier;
    }
    fired.reverse();
    match fired.len() {
        0 => "at the beginning".to_owned(),
        1 => format!("after `{}` has fired", fired[0]),
        2..=8 => format!("after `{}` have fired", fired.join("`, `")),
        n => format!("after {n} firings, the last of them `{}`", fired[n - 3..].join("`, `")),
    }
}

//! The runs that count in a check.

use fixedbitset::FixedBitSet;

use super::views::SystemView;
use petril_logic::{Bound, Constraint, Constraints, Dag, Fairness, FairnessAssumption, label};
use petril_search::Graph;

/// Fairness assumptions on the graph of a view.
pub struct Fair<'a> {
    /// The paths that count.
    pub paths: Fairness,
    /// The assumptions.
    pub assumptions: &'a [FairnessAssumption],
    /// Why no run counts from some initial state, if so.
    pub vain: Option<String>,
}

impl<'a> Fair<'a> {
    /// Nothing if nothing is assumed, so that all runs count.
    pub fn on(view: &dyn SystemView, assumptions: &'a [FairnessAssumption]) -> Option<Self> {
        let constraints: Vec<&Constraint> = assumptions.iter().flat_map(|assumed| &assumed.constraints).collect();
        if constraints.is_empty() {
            return None;
        }
        let graph = view.graph();
        let paths = paths(view, &constraints);
        let vain = (!from_all(graph, &paths)).then(|| vain(view, assumptions, &paths));
        Some(Self { paths, assumptions, vain })
    }

    /// How many states no run that counts goes through, if there are any, in words.
    pub fn left_out(&self) -> Option<String> {
        let (states, left) = (self.paths.possibly().len(), self.paths.possibly().zeroes().count());
        (left > 0).then(|| {
            format!("runs through {left} of the {states} states are left out: from there no run meets the fairness assumptions")
        })
    }
}

/// The states of a view in which a formula about one state holds.
pub fn states_where(view: &dyn SystemView, formula: &Bound) -> FixedBitSet {
    let graph = view.graph();
    let mut dag = Dag::default();
    let node = dag.add(formula, false);
    let holds = |formula: &Bound, state: u32| view.holds(formula, graph.state(state));
    label(graph, &dag, &holds, None).of(node).clone()
}

fn paths(view: &dyn SystemView, constraints: &[&Constraint]) -> Fairness {
    let (mut weak, mut strong) = (Vec::new(), Vec::new());
    for Constraint { premise, goal, .. } in constraints {
        let goal = states_where(view, goal);
        match premise {
            Some(premise) => strong.push((states_where(view, premise), goal)),
            None => weak.push(goal),
        }
    }
    Fairness::on(view.graph(), Constraints { weak, strong })
}

/// Whether a run may count from each initial state.
fn from_all(graph: &Graph, paths: &Fairness) -> bool {
    graph.initial().iter().all(|&state| paths.possibly().contains(state as usize))
}

/// What keeps runs from an initial state from counting.
fn vain(view: &dyn SystemView, assumptions: &[FairnessAssumption], paths: &Fairness) -> String {
    let graph = view.graph();
    let none = graph.initial().iter().all(|&state| !paths.possibly().contains(state as usize));
    let begins = if none { "" } else { " that begins with some of the first scans" };
    let constraints = || assumptions.iter().flat_map(|assumed| &assumed.constraints);
    let alone = |constraints: &[&Constraint]| !from_all(graph, &self::paths(view, constraints));
    if let Some(one) = constraints().find(|constraint| alone(&[constraint])) {
        return format!("no run{begins} meets the fairness assumption that {}", one.words);
    }
    let several = assumptions.iter().filter(|assumed| assumed.constraints.len() > 1);
    match several.into_iter().find(|assumed| alone(&assumed.constraints.iter().collect::<Vec<_>>())) {
        Some(one) => format!("no run{begins} meets the fairness assumption that {}", one.words),
        None => format!("no run{begins} meets the fairness assumptions"),
    }
}

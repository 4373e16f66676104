//! Fairness assumptions on a state graph: which runs count.

use fixedbitset::FixedBitSet;

use super::views::SystemView;
use petril_logic::{Bound, Constraint, Constraints, Dag, Fairness, FairnessAssumption, label};
use petril_search::Graph;

/// Fairness assumptions on the graph of a view.
pub struct Fair<'a> {
    /// Fair paths.
    pub paths: Fairness,
    /// Assumptions the paths have to meet.
    pub assumptions: &'a [FairnessAssumption],
    /// Reason why some initial state has no fair run, if so.
    pub vain: Option<String>,
}

impl<'a> Fair<'a> {
    /// Evaluates the assumptions on the graph of a view; `None` if there are none.
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

    /// Number of states on no fair run, in words, if not 0.
    pub fn left_out(&self) -> Option<String> {
        let (states, left) = (self.paths.possibly().len(), self.paths.possibly().zeroes().count());
        (left > 0).then(|| {
            format!("runs through {left} of the {states} states are left out: from there no run meets the fairness assumptions")
        })
    }
}

/// States of a view that satisfy a state formula.
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

/// Whether a fair run possibly begins in each initial state.
fn from_all(graph: &Graph, paths: &Fairness) -> bool {
    graph.initial().iter().all(|&state| paths.possibly().contains(state as usize))
}

/// Names the assumption that leaves an initial state without fair runs.
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

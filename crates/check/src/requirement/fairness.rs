//! Binding of fairness assumptions to state formulas.

use super::bind;
use crate::translate::{PlaceRole, System};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;
use petril_lang::semantics::{Role, VarId};
use petril_logic::{Bound, Constraint, FairnessAssumption, FairnessText, Formula, Recurrence, View};
use petril_net::net::TransitionId;

/// Binds the names of a fairness assumption. Constraints on the plant refer to the net of this system.
///
/// # Errors
/// Every name that is unknown in this view, formulas about more than one state, `released` and `pressed` of variables
/// that are not inputs of type `BOOL`, and `plant` without a plant that moves.
pub fn bind_fairness(text: &FairnessText, system: &System, view: View) -> Result<FairnessAssumption, Vec<Diagnostic>> {
    let state = |formula: &Formula| of_one_state(formula, system, view);
    let (constraints, words) = match &text.recurrence {
        Recurrence::Weak(goal) => {
            let goal = state(goal)?;
            let words = format!("`{}` is true again and again", goal.text(system));
            (vec![Constraint { premise: None, goal, words: words.clone() }], words)
        }
        Recurrence::Strong { premise, goal } => {
            let (premise, goal) = (state(premise)?, state(goal)?);
            let words = format!("if `{}` is true again and again, so is `{}`", premise.text(system), goal.text(system));
            (vec![Constraint { premise: Some(premise), goal, words: words.clone() }], words)
        }
        Recurrence::Inputs { value, names } => inputs(*value, names, system, view)?,
        Recurrence::Plant => plant(text.span, system, view)?,
    };
    let words = text.sentence.as_ref().map_or(words.clone(), |sentence| format!("{sentence} ({words})"));
    let words = text.name.as_ref().map_or(words.clone(), |name| format!("{name}: {words}"));
    let speaks_of_time = match &text.recurrence {
        Recurrence::Weak(goal) => goal.speaks_of_time(),
        Recurrence::Strong { premise, goal } => premise.speaks_of_time() || goal.speaks_of_time(),
        Recurrence::Inputs { .. } | Recurrence::Plant => false,
    };
    Ok(FairnessAssumption { words, constraints, speaks_of_time })
}

/// Fairness of the PLC in the transition view: it always scans again, that is, it is infinitely often not idle. In an
/// idle state `block` is always enabled, so this excludes the runs on which `block` stays enabled and never fires.
#[must_use]
pub fn always_scanning(system: &System) -> FairnessAssumption {
    let goal = not(Bound::Marked(system.place(PlaceRole::Idle)));
    let words = "the PLC always scans again".to_owned();
    let constraints = vec![Constraint { premise: None, goal, words: words.clone() }];
    FairnessAssumption { words, constraints, speaks_of_time: false }
}

fn of_one_state(formula: &Formula, system: &System, view: View) -> Result<Bound, Vec<Diagnostic>> {
    let bound = bind(formula, system, view)?;
    if bound.is_state_formula() {
        return Ok(bound);
    }
    let message = "what comes again and again must be a formula about one state, without AG, AF and their like";
    let help = "write what is to come again and again, like `again and again !Start`; `AG (a -> AF b)` is `if again and again \
                a then again and again b`, if a and b are about one state";
    Err(vec![Diagnostic::new(Code::FairnessUnfit, formula.span, message).help(help)])
}

/// Weak constraints that each of these inputs has a value infinitely often.
fn inputs(
    value: bool,
    names: &[(String, Span)],
    system: &System,
    view: View,
) -> Result<(Vec<Constraint>, String), Vec<Diagnostic>> {
    let found: Vec<Result<VarId, Diagnostic>> = names.iter().map(|(name, span)| input(name, *span, system)).collect();
    if found.iter().any(Result::is_err) {
        return Err(found.into_iter().filter_map(Result::err).collect());
    }
    let value_text = if value { "TRUE" } else { "FALSE" };
    let constraint = |variable: VarId| {
        let is_true = match view {
            View::Scan => Bound::Variable(variable),
            View::Transition => Bound::Marked(system.place(PlaceRole::Bit { variable, bit: 0, value: true })),
        };
        let words = format!("{} is {value_text} again and again", system.program.variable(variable).name);
        Constraint { premise: None, goal: if value { is_true } else { not(is_true) }, words }
    };
    let constraints: Vec<Constraint> = found.into_iter().flatten().map(constraint).collect();
    let words = match constraints.as_slice() {
        [only] => only.words.clone(),
        _ => {
            let names: Vec<&str> = names.iter().map(|(name, _)| name.as_str()).collect();
            format!("each of {} is {value_text} again and again", names.join(", "))
        }
    };
    Ok((constraints, words))
}

/// Finds an input of type `BOOL` by name.
fn input(name: &str, span: Span, system: &System) -> Result<VarId, Diagnostic> {
    let program = &system.program;
    let Some(input) = program.named(name) else {
        let names = program.with_role(Role::Input).map(|id| program.variable(id).name.as_str());
        let message = format!("the program `{}` has no input `{name}`", program.name);
        return Err(Diagnostic::new(Code::RequirementNameUnknown, span, message).suggest(name, names));
    };
    let variable = program.variable(input);
    if variable.role == Role::Input && variable.ty.is_bool() {
        return Ok(input);
    }
    let message = format!("`{name}` is no input of type `BOOL`, so it is neither released nor pressed");
    let help = match variable.ty.is_bool() {
        true => format!("write what it is again and again, like `again and again !{name}`"),
        false => format!("write what it is again and again, like `again and again {name} = 0`"),
    };
    Err(Diagnostic::new(Code::FairnessUnfit, span, message).help(help))
}

/// Weak constraints that each transition of the plant that changes its marking is infinitely often disabled at the end
/// of a scan, apart from being blocked during the scan.
fn plant(span: Span, system: &System, view: View) -> Result<(Vec<Constraint>, String), Vec<Diagnostic>> {
    let moving = system.plant_moves().iter().filter(|&&id| !system.net.arcs(id).consume.is_empty());
    let end = system.place(PlaceRole::Line(system.program.end()));
    let standing = |&id: &TransitionId| {
        let needed = system.net.arcs(id).preset();
        let needed = needed.filter(|place| !matches!(system.places[place.index()], PlaceRole::Blocking(_)));
        let missing = needed.map(|place| not(Bound::Marked(place)));
        let missing = missing.reduce(|f, g| Bound::Or(Box::new(f), Box::new(g)))?;
        let goal = match view {
            View::Scan => missing,
            // Moves between two scans and back are invisible to the program.
            View::Transition => Bound::And(Box::new(Bound::Marked(end)), Box::new(missing)),
        };
        let words =
            format!("`{}` is unable to fire at the end of a scan again and again", system.net.transition(id).name);
        Some(Constraint { premise: None, goal, words })
    };
    let constraints: Vec<Constraint> = moving.filter_map(standing).collect();
    if constraints.is_empty() {
        let message = "there is no plant that moves";
        let help = "free inputs have any value in any scan; say what they are again and again, like `released(Start)`";
        return Err(vec![Diagnostic::new(Code::FairnessUnfit, span, message).help(help)]);
    }
    let words = match constraints.as_slice() {
        [only] => only.words.clone(),
        _ => format!(
            "the plant does not stand still: each of its {} transitions is unable to fire at the end of a scan \
             again and again",
            constraints.len()
        ),
    };
    Ok((constraints, words))
}

fn not(formula: Bound) -> Bound {
    Bound::Not(Box::new(formula))
}

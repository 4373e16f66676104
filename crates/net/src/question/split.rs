//! A question as a Boolean combination of parts that are answered one by one.

use super::hunt::Hunt;
use super::replay::Played;
use super::{Branch, Means, Question, Reply, Run};
use crate::net::Net;
use petril_logic::Bound;

/// A question whose parts have been taken out.
pub(super) enum Split<'q> {
    /// A part, by its number among the hunts; a formula, if it stands in one.
    Part(usize, Option<&'q Bound>),
    /// What the initial marking says.
    Known(bool),
    Not(Box<Self>),
    And(Box<Self>, Box<Self>),
    Or(Box<Self>, Box<Self>),
    Iff(Box<Self>, Box<Self>),
}

impl<'q> Split<'q> {
    /// Takes a question apart, and puts its parts behind `hunts`.
    pub(super) fn of(question: &'q Question, net: &Net, hunts: &mut Vec<Hunt<'q>>) -> Self {
        if let Question::Holds(formula) = question {
            Self::of_formula(formula, net, hunts)
        } else {
            Self::part(Hunt::of(question), None, hunts)
        }
    }

    fn part(hunt: Hunt<'q>, formula: Option<&'q Bound>, hunts: &mut Vec<Hunt<'q>>) -> Self {
        hunts.push(hunt);
        Self::Part(hunts.len() - 1, formula)
    }

    fn of_formula(formula: &'q Bound, net: &Net, hunts: &mut Vec<Hunt<'q>>) -> Self {
        if let Some(known) = formula.holds_in(&Played(net, &net.initial_tokens())) {
            return Self::Known(known);
        }
        let mut of = |f: &'q Bound| Box::new(Self::of_formula(f, net, hunts));
        match formula {
            Bound::Not(f) => Self::Not(of(f)),
            Bound::And(f, g) => Self::And(of(f), of(g)),
            Bound::Or(f, g) => Self::Or(of(f), of(g)),
            Bound::Implies(f, g) => Self::Or(Box::new(Self::Not(of(f))), of(g)),
            Bound::Iff(f, g) => Self::Iff(of(f), of(g)),
            _ => Self::part(Hunt::of_formula(formula), Some(formula), hunts),
        }
    }

    /// Whether it holds, as far as the replies to the parts tell.
    fn value(&self, replies: &[Option<Reply>]) -> Option<bool> {
        let of = |split: &Self| split.value(replies);
        match self {
            Self::Known(known) => Some(*known),
            Self::Part(part, _) => match replies[*part] {
                Some(Reply::Holds(_)) => Some(true),
                Some(Reply::Violated(_)) => Some(false),
                _ => None,
            },
            Self::Not(f) => of(f).map(|f| !f),
            Self::And(f, g) => match (of(f), of(g)) {
                (Some(false), _) | (_, Some(false)) => Some(false),
                (f, g) => f.and(g),
            },
            Self::Or(f, g) => match (of(f), of(g)) {
                (Some(true), _) | (_, Some(true)) => Some(true),
                (f, g) => f.and(g),
            },
            Self::Iff(f, g) => Some(of(f)? == of(g)?),
        }
    }

    /// The reply, if those to the parts are enough.
    pub(super) fn reply(&self, replies: &[Option<Reply>]) -> Option<Reply> {
        if let Self::Part(part, _) = self {
            return replies[*part].clone();
        }
        let value = self.value(replies)?;
        let mut run = Run::default();
        self.show(value, replies, &mut run.branches);
        let run = run.branches.iter().any(|branch| branch.run.is_some()).then_some(run);
        Some(if value { Reply::Holds(run) } else { Reply::Violated(run) })
    }

    /// Why not, where a part is not known and the replies to the others are not enough.
    pub(super) fn reason<'r>(&self, replies: &'r [Option<Reply>]) -> Option<&'r str> {
        match self {
            Self::Known(_) => None,
            Self::Part(part, _) => match &replies[*part] {
                Some(Reply::Unknown(reason)) => Some(reason),
                _ => None,
            },
            Self::Not(f) => f.reason(replies),
            Self::And(f, g) | Self::Or(f, g) | Self::Iff(f, g) => f.reason(replies).or_else(|| g.reason(replies)),
        }
    }

    /// What the replies to its parts rest on.
    pub(super) fn means(&self, replies: &[Option<Reply>], means: &[Means]) -> Vec<Means> {
        let mut all = Vec::new();
        self.for_each_part(&mut |part| all.extend(replies[part].is_some().then_some(means[part])));
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The numbers of the parts that it needs.
    pub(super) fn for_each_part(&self, visit: &mut dyn FnMut(usize)) {
        match self {
            Self::Known(_) => {}
            Self::Part(part, _) => visit(*part),
            Self::Not(f) => f.for_each_part(visit),
            Self::And(f, g) | Self::Or(f, g) | Self::Iff(f, g) => {
                f.for_each_part(visit);
                g.for_each_part(visit);
            }
        }
    }

    /// The parts that make it true, or false, and the runs that show them.
    fn show(&self, value: bool, replies: &[Option<Reply>], branches: &mut Vec<Branch>) {
        match self {
            Self::Known(_) => {}
            Self::Part(part, formula) => {
                if let (Some(formula), Some(Reply::Holds(run) | Reply::Violated(run))) = (formula, &replies[*part]) {
                    let formula = (*formula).clone();
                    let formula = if value { formula } else { Bound::Not(Box::new(formula)) };
                    branches.push(Branch { at: 0, formula, run: run.clone() });
                }
            }
            Self::Not(f) => f.show(!value, replies, branches),
            Self::And(f, g) | Self::Or(f, g) => {
                // Both parts are needed for a true conjunction; for a false one, one that is false.
                let is_and = matches!(self, Self::And(..));
                if is_and == value {
                    f.show(value, replies, branches);
                    g.show(value, replies, branches);
                } else if f.value(replies) == Some(value) {
                    f.show(value, replies, branches);
                } else {
                    g.show(value, replies, branches);
                }
            }
            Self::Iff(f, g) => {
                for part in [f, g] {
                    part.value(replies).iter().for_each(|&value| part.show(value, replies, branches));
                }
            }
        }
    }
}

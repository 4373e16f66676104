//! Decomposition of a question into parts that are answered one by one, and their Boolean combination.

use super::hunt::Hunt;
use super::replay::Played;
use super::{Branch, Means, Question, Reply, Run};
use crate::net::Net;
use petril_logic::Bound;

/// A question with its parts taken out.
pub(super) enum Split<'q> {
    /// Part, by its number among the properties, with its formula if the question is one.
    Part(usize, Option<&'q Bound>),
    /// Value at the initial marking.
    Known(bool),
    Not(Box<Self>),
    And(Box<Self>, Box<Self>),
    Or(Box<Self>, Box<Self>),
    Iff(Box<Self>, Box<Self>),
}

impl<'q> Split<'q> {
    /// Decomposes a question and appends its parts to `hunts`.
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

    /// Value under the answers so far, if they decide it.
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

    /// Answer to the question, if the answers to the parts decide it.
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

    /// Reason of an undecided part.
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

    /// Techniques that the answers to the parts rest on.
    pub(super) fn means(&self, replies: &[Option<Reply>], means: &[Means]) -> Vec<Means> {
        let mut all = Vec::new();
        self.for_each_part(&mut |part| all.extend(replies[part].is_some().then_some(means[part])));
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Visits the numbers of all parts.
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

    /// Collects the parts that make the formula have this value, with their runs.
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
                // A true conjunction needs both parts; a false one, one false part.
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

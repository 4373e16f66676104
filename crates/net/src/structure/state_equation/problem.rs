//! The state equation as a linear program.

use std::sync::atomic::AtomicBool;

use super::{Bound, Certificate, Constraint, Relation};
use crate::net::{Net, PlaceId};
use crate::structure::incidence::Incidence;
use crate::structure::rounding::{proportions, whole};
use crate::structure::simplex::{Program, Solved, minimise, scattered};

/// Result of checking constraints against the state equation.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// No reachable marking satisfies all constraints; the certificate has been verified.
    Infeasible(Certificate),
    /// Numbers of firings that satisfy the equation and the constraints in floating point. Proves nothing.
    Feasible(Vec<f64>),
    /// No answer: the steps were used up, or no exact certificate was found.
    Unknown,
}

/// The state equation of a net.
#[derive(Clone, Debug)]
pub struct Problem<'n> {
    net: &'n Net,
    incidence: Incidence,
}

impl<'n> Problem<'n> {
    /// Sets up the state equation of a net.
    #[must_use]
    pub fn new(net: &'n Net) -> Self {
        Self { net, incidence: Incidence::of(net) }
    }

    /// Checks whether constraints together contradict the equation; numbers of firings may be fractions. Takes at most
    /// about `steps` elementary steps, some nanoseconds each.
    #[must_use]
    pub fn solve(&self, constraints: &[Constraint], steps: u64) -> Outcome {
        self.solve_until(constraints, steps, &AtomicBool::new(false))
    }

    /// Checks constraints as [`Self::solve`] does. Unknown if `stopping` is set meanwhile.
    #[must_use]
    pub fn solve_until(&self, constraints: &[Constraint], steps: u64, stopping: &AtomicBool) -> Outcome {
        let mut program = self.program();
        // For each row after those of the places, its constraint and sign.
        let mut origins: Vec<(usize, i128)> = Vec::new();
        for (position, constraint) in constraints.iter().enumerate() {
            let signs: &[i128] = match constraint.relation {
                Relation::AtLeast => &[1],
                Relation::AtMost => &[-1],
                Relation::Equal => &[1, -1],
            };
            let (row, least) = self.row(constraint);
            for &sign in signs {
                program.rows.push(row.iter().map(|&(transition, entry)| (transition, sign as f64 * entry)).collect());
                program.least.push(sign as f64 * least);
                origins.push((position, sign));
            }
        }
        match minimise(&program, steps, stopping) {
            Solved::Optimal(firings) => Outcome::Feasible(firings),
            Solved::GaveUp => Outcome::Unknown,
            Solved::Infeasible(times) => {
                let certificates = proportions(&times).map(|times| self.certificate(&times, constraints, &origins));
                let mut verified = certificates.filter(|certificate| certificate.verify(self.net, constraints));
                verified.next().map_or(Outcome::Unknown, Outcome::Infeasible)
            }
        }
    }

    /// Upper bound on the total number of tokens of places, each counted as often as it is listed, if the equation
    /// implies one. Takes at most about `steps` elementary steps.
    #[must_use]
    pub fn bound(&self, places: &[PlaceId], steps: u64) -> Option<Bound> {
        // The unknowns are weights in addition to 1 for each place listed, as cheap as the initial marking allows, such
        // that no firing increases the weighted sum.
        let mut least = vec![0.0; self.net.transitions().len()];
        for &place in places {
            self.incidence.of_place(place).iter().for_each(|&(id, change)| least[id as usize] += change as f64);
        }
        let row = |id| {
            let changes = self.incidence.of_transition(id).iter();
            changes.map(|&(place, change)| (place, -(change as f64))).collect()
        };
        let cost = |(position, tokens): (usize, u64)| tokens as f64 + 1e-5 * scattered(position);
        let program = Program {
            rows: self.net.transition_ids().map(row).collect(),
            least,
            costs: self.net.places().map(|place| place.tokens).enumerate().map(cost).collect(),
        };
        let Solved::Optimal(more) = minimise(&program, steps, &AtomicBool::new(false)) else { return None };
        let (mut weights, unit) = whole(&more)?;
        places.iter().for_each(|place| weights[place.index()] += unit);
        let weights = self.net.place_ids().zip(weights).filter(|&(_, weight)| weight != 0).collect();
        let mut bound = Bound { most: 0, weights, unit };
        bound.most = bound.value(self.net, places)?;
        bound.verify(self.net, places).then_some(bound)
    }

    /// The equation as a program: no place has a negative number of tokens, and the number of firings is minimised.
    fn program(&self) -> Program {
        let row = |id| self.incidence.of_place(id).iter().map(|&(id, change)| (id, change as f64)).collect();
        Program {
            rows: self.net.place_ids().map(row).collect(),
            least: self.net.places().map(|place| -(place.tokens as f64)).collect(),
            costs: (0..self.net.transitions().len()).map(|position| 1.0 + 0.5 * scattered(position)).collect(),
        }
    }

    /// Change of a constraint's sum by each firing, and the difference between its value and the initial sum.
    fn row(&self, constraint: &Constraint) -> (Vec<(u32, f64)>, f64) {
        let mut changes: Vec<(u32, f64)> = Vec::new();
        let mut least = constraint.value as f64;
        for &(place, times) in &constraint.terms {
            let of_place = self.incidence.of_place(place).iter();
            changes.extend(of_place.map(|&(id, change)| (id, times as f64 * change as f64)));
            least -= times as f64 * self.net.place(place).tokens as f64;
        }
        changes.sort_unstable_by_key(|&(id, _)| id);
        changes.dedup_by(|(later, more), (id, change)| {
            let is_same = later == id;
            *change += if is_same { *more } else { 0.0 };
            is_same
        });
        changes.retain(|&(_, change)| change != 0.0);
        (changes, least)
    }

    fn certificate(&self, times: &[i128], constraints: &[Constraint], origins: &[(usize, i128)]) -> Certificate {
        let (places, rows) = times.split_at(self.net.places().len());
        let mut of_constraints = vec![0; constraints.len()];
        rows.iter().zip(origins).for_each(|(&times, &(position, sign))| of_constraints[position] += sign * times);
        let places = self.net.place_ids().zip(places.iter().copied()).filter(|&(_, times)| times != 0).collect();
        Certificate { constraints: of_constraints, places }
    }
}

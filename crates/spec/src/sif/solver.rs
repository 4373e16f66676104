//! Satisfiability: the only file that uses the SAT solver.
//!
//! Gates over [`Literal`]s are literals again, defined by clauses (Tseitin, "On the complexity of derivation in
//! propositional calculus", 1968); equal gates are shared.

use std::collections::HashMap;
use std::ops::Not;
use std::sync::Arc;

use batsat::{BasicCallbacks, Lit, SolverInterface, lbool};
use rustc_hash::FxBuildHasher;

use super::formula::{Formula, Operator, SignalId};

/// Literal: a Boolean variable or its negation, `!literal`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Literal(Lit);

impl Not for Literal {
    type Output = Self;

    fn not(self) -> Self {
        Self(!self.0)
    }
}

/// Answer of the solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// A model exists; read it by [`Solver::value`].
    Satisfiable,
    /// No model exists; [`Solver::core`] returns the assumptions responsible.
    Unsatisfiable,
    /// The solver was stopped.
    Stopped,
}

/// Callback that returns whether to stop.
pub type Stop = Arc<dyn Fn() -> bool + Send + Sync>;

/// SAT solver with incremental clauses.
pub struct Solver {
    inner: batsat::Solver<BasicCallbacks>,
    truth: Literal,
    gates: HashMap<(bool, Literal, Literal), Literal, FxBuildHasher>,
}

impl Default for Solver {
    fn default() -> Self {
        Self::new(&(Arc::new(|| false) as Stop))
    }
}

impl Solver {
    /// Creates a solver without clauses that polls `stop`.
    #[must_use]
    pub fn new(stop: &Stop) -> Self {
        let mut callbacks = BasicCallbacks::new();
        let stop = Arc::clone(stop);
        callbacks.set_stop(move || stop());
        let mut inner = batsat::Solver::new(batsat::SolverOpts::default(), callbacks);
        let truth = Literal(Lit::new(inner.new_var_default(), true));
        inner.add_clause_reuse(&mut vec![truth.0]);
        Self { inner, truth, gates: HashMap::default() }
    }

    /// New unconstrained variable.
    pub fn fresh(&mut self) -> Literal {
        Literal(Lit::new(self.inner.new_var_default(), true))
    }

    /// Constant literal.
    #[must_use]
    pub fn constant(&self, value: bool) -> Literal {
        if value { self.truth } else { !self.truth }
    }

    /// Adds a clause: at least one of these is true.
    pub fn require(&mut self, any: impl IntoIterator<Item = Literal>) {
        let mut clause: Vec<Lit> = any.into_iter().map(|literal| literal.0).collect();
        self.inner.add_clause_reuse(&mut clause);
    }

    /// Conjunction.
    pub fn and(&mut self, all: impl IntoIterator<Item = Literal>) -> Literal {
        let mut all: Vec<Literal> = all.into_iter().filter(|literal| *literal != self.truth).collect();
        all.sort_unstable();
        all.dedup();
        // A literal and its negation are adjacent after sorting.
        if all.contains(&!self.truth) || all.windows(2).any(|pair| pair[0] == !pair[1]) {
            return !self.truth;
        }
        match *all.as_slice() {
            [] => self.truth,
            [only] => only,
            [a, b] => self.gate(true, a, b),
            _ => {
                let gate = self.fresh();
                all.iter().for_each(|&literal| self.require([!gate, literal]));
                self.require(all.iter().map(|&literal| !literal).chain([gate]));
                gate
            }
        }
    }

    /// Disjunction.
    pub fn or(&mut self, any: impl IntoIterator<Item = Literal>) -> Literal {
        !self.and(any.into_iter().map(|literal| !literal))
    }

    /// Exclusive or.
    pub fn xor(&mut self, a: Literal, b: Literal) -> Literal {
        if a == self.constant(false) || b == self.constant(false) {
            return if a == self.constant(false) { b } else { a };
        }
        if a == self.truth || b == self.truth {
            return if a == self.truth { !b } else { !a };
        }
        if a == b || a == !b {
            return self.constant(a != b);
        }
        // The gate is built over positive literals, and negated for an odd number of negations.
        let (plain_a, plain_b) = (Literal(Lit::new(a.0.var(), true)), Literal(Lit::new(b.0.var(), true)));
        let is_turned = (a != plain_a) != (b != plain_b);
        let gate = self.gate(false, plain_a.min(plain_b), plain_a.max(plain_b));
        if is_turned { !gate } else { gate }
    }

    /// Shared binary gate: conjunction or exclusive or.
    fn gate(&mut self, is_and: bool, a: Literal, b: Literal) -> Literal {
        if let Some(&gate) = self.gates.get(&(is_and, a, b)) {
            return gate;
        }
        let gate = self.fresh();
        if is_and {
            self.require([!gate, a]);
            self.require([!gate, b]);
            self.require([gate, !a, !b]);
        } else {
            self.require([!gate, a, b]);
            self.require([!gate, !a, !b]);
            self.require([gate, !a, b]);
            self.require([gate, a, !b]);
        }
        self.gates.insert((is_and, a, b), gate);
        gate
    }

    /// Encodes a formula over these literals.
    pub fn formula(&mut self, formula: &Formula, value: &impl Fn(SignalId) -> Literal) -> Literal {
        match formula {
            Formula::Constant(truth) => self.constant(*truth),
            Formula::Signal(signal) => value(*signal),
            Formula::Not(inner) => !self.formula(inner, value),
            Formula::Gate(operator, operands) => {
                let operands: Vec<Literal> = operands.iter().map(|operand| self.formula(operand, value)).collect();
                self.operator(*operator, &operands)
            }
        }
    }

    /// Encodes an operator.
    pub fn operator(&mut self, operator: Operator, operands: &[Literal]) -> Literal {
        let odd = |solver: &mut Self| operands.iter().fold(!solver.truth, |odd, &operand| solver.xor(odd, operand));
        match operator {
            Operator::And => self.and(operands.iter().copied()),
            Operator::Or => self.or(operands.iter().copied()),
            Operator::Xor => odd(self),
            Operator::Iff => !odd(self),
            Operator::Implies => self.or(operands
                .iter()
                .enumerate()
                .map(|(position, &operand)| if position == 0 { !operand } else { operand })),
            Operator::AtMostOne => {
                let (_, two) = self.ones(operands);
                !two
            }
            Operator::ExactlyOne => {
                let (one, two) = self.ones(operands);
                self.and([one, !two])
            }
        }
    }

    /// Whether at least one operand is true, and whether at least two are.
    fn ones(&mut self, operands: &[Literal]) -> (Literal, Literal) {
        let (mut one, mut two) = (!self.truth, !self.truth);
        for &operand in operands {
            let both = self.and([one, operand]);
            two = self.or([two, both]);
            one = self.or([one, operand]);
        }
        (one, two)
    }

    /// Searches for a model under assumptions.
    pub fn solve(&mut self, assumed: &[Literal]) -> Answer {
        let assumed: Vec<Lit> = assumed.iter().map(|literal| literal.0).collect();
        let answer = self.inner.solve_limited(&assumed);
        if answer == lbool::TRUE {
            Answer::Satisfiable
        } else if answer == lbool::FALSE {
            Answer::Unsatisfiable
        } else {
            Answer::Stopped
        }
    }

    /// Value in the model found last; unassigned variables are FALSE.
    #[must_use]
    pub fn value(&self, literal: Literal) -> bool {
        self.inner.value_lit(literal.0) == lbool::TRUE
    }

    /// Unsatisfiable core of the assumptions, after [`Answer::Unsatisfiable`]; not always minimal.
    #[must_use]
    pub fn core(&self, assumed: &[Literal]) -> Vec<Literal> {
        let core = self.inner.unsat_core();
        assumed.iter().copied().filter(|literal| core.contains(&literal.0) || core.contains(&!literal.0)).collect()
    }
}

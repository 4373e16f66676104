//! Terms about the past, and the memory needed to evaluate them.
//!
//! A *memory* has one number for each term about the past. The memory of a state follows from a *message*, made of the
//! previous state and its memory, and from the state itself. Before the first scan there is power-on, with the initial
//! values of the variables.

use std::sync::Arc;

use super::bound::{Bound, Term, Valuation};

/// Term about the scans so far, without temporal operators.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Past {
    /// 1 in the first scan, else 0.
    First,
    /// Value of the term at the end of the previous scan; in the first scan, its value at power-on.
    Before(Term),
    /// 1 if the second formula is or was true and the first has been true ever since, else 0.
    Since(Bound, Bound),
    /// Number of consecutive scans for which the formula has been true, including this one; at most `most`.
    Run {
        /// Formula counted.
        of: Bound,
        /// Upper bound of the count.
        most: u32,
    },
}

impl Past {
    /// Upper bound on the absolute value.
    #[must_use]
    pub fn magnitude(&self) -> u128 {
        match self {
            Self::First | Self::Since(..) => 1,
            // Binding ensures that it is known, and fits in a memory.
            Self::Before(term) => term.magnitude().unwrap_or(u128::from(u64::MAX)),
            Self::Run { most, .. } => u128::from(*most),
        }
    }

    /// Whether the term is a truth value.
    #[must_use]
    pub fn is_truth(&self) -> bool {
        matches!(self, Self::First | Self::Since(..) | Self::Before(Term::Truth(_)))
    }
}

/// Terms about the past of some formulas, inner ones first.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct History {
    pasts: Vec<Arc<Past>>,
}

impl History {
    /// Collects the terms about the past of formulas.
    #[must_use]
    pub fn of<'f>(formulas: impl IntoIterator<Item = &'f Bound>) -> Self {
        let mut history = Self::default();
        formulas.into_iter().for_each(|formula| history.add_formula(formula));
        history
    }

    /// Whether there are no terms about the past.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pasts.is_empty()
    }

    /// Length of a memory, in words.
    #[must_use]
    pub fn len(&self) -> usize {
        self.pasts.len()
    }

    /// All terms about the past.
    pub fn pasts(&self) -> impl Iterator<Item = &Past> {
        self.pasts.iter().map(|past| &**past)
    }

    /// Position of a term in a memory.
    #[must_use]
    pub fn position(&self, past: &Past) -> Option<usize> {
        self.pasts.iter().position(|known| std::ptr::eq(&**known, past) || **known == *past)
    }

    fn add_formula(&mut self, formula: &Bound) {
        match formula {
            Bound::Truth(_)
            | Bound::Variable(_)
            | Bound::Bit(..)
            | Bound::Marked(_)
            | Bound::Enabled(_)
            | Bound::Deadlock => {}
            Bound::Compare(_, a, b) => {
                self.add_term(a);
                self.add_term(b);
            }
            Bound::Not(f) | Bound::Next(_, f) => self.add_formula(f),
            Bound::And(f, g)
            | Bound::Or(f, g)
            | Bound::Implies(f, g)
            | Bound::Iff(f, g)
            | Bound::Until { hold: f, release: g, .. } => {
                self.add_formula(f);
                self.add_formula(g);
            }
            Bound::Ltl(path) => path.atoms().into_iter().for_each(|atom| self.add_formula(atom)),
        }
    }

    fn add_term(&mut self, term: &Term) {
        match term {
            Term::Number(_) | Term::Variable(..) | Term::Bits { .. } | Term::Tokens(_) => {}
            Term::Truth(f) => self.add_formula(f),
            Term::Sum(a, b) | Term::Difference(a, b) | Term::Product(a, b) => {
                self.add_term(a);
                self.add_term(b);
            }
            Term::Past(past) => {
                match &**past {
                    Past::First => {}
                    Past::Before(term) => self.add_term(term),
                    Past::Since(f, g) => {
                        self.add_formula(f);
                        self.add_formula(g);
                    }
                    Past::Run { of, .. } => self.add_formula(of),
                }
                if self.position(past).is_none() {
                    self.pasts.push(Arc::clone(past));
                }
            }
        }
    }

    /// Message of power-on to the first scan.
    pub fn beginning(&self, power_on: &dyn Fn(&Term, &[u64]) -> i128) -> Vec<u64> {
        let mut memory = vec![0; self.len()];
        for (position, past) in self.pasts().enumerate() {
            if let Past::Before(term) = past {
                memory[position] = number(power_on(term, &memory));
            }
        }
        let mut message = vec![0; self.len()];
        for (position, past) in self.pasts().enumerate() {
            message[position] = match past {
                Past::First => 1,
                Past::Before(term) => number(power_on(term, &memory)),
                Past::Since(..) | Past::Run { .. } => 0,
            };
        }
        message
    }

    /// Computes the message of a state with its memory to the next state.
    pub fn message(&self, state: &impl Valuation, memory: &[u64], message: &mut Vec<u64>) {
        message.clear();
        message.extend(self.pasts().zip(memory).map(|(past, &remembered)| match past {
            Past::First => 0,
            Past::Before(term) => number(term.value_in(state).unwrap_or_default()),
            Past::Since(..) | Past::Run { .. } => remembered,
        }));
    }

    /// Computes one number of the memory of a state that receives a message. `state` includes the earlier numbers of
    /// the memory.
    pub fn remember(&self, position: usize, message: &[u64], state: &impl Valuation) -> u64 {
        let told = message[position];
        let holds = |formula: &Bound| formula.holds_in(state).unwrap_or(false);
        match &*self.pasts[position] {
            Past::First | Past::Before(_) => told,
            Past::Since(f, g) => u64::from(holds(g) || told == 1 && holds(f)),
            Past::Run { of, most } => {
                if holds(of) {
                    (told + 1).min(u64::from(*most))
                } else {
                    0
                }
            }
        }
    }
}

/// Encodes a number as a word of a memory.
fn number(number: i128) -> u64 {
    number as i64 as u64
}

/// Decodes a word of a memory.
#[must_use]
pub fn remembered(word: u64) -> i128 {
    i128::from(word as i64)
}

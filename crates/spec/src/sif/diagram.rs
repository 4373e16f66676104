//! Binary decision diagrams: sets of valuations, counted and listed. The only file that uses the BDD library.
//!
//! After Bryant, "Graph-based algorithms for Boolean function manipulation" (1986). Diagrams have a node limit;
//! operations that exceed it return `None`, and callers do without.

use biodivine_lib_bdd::{Bdd, BddVariable, BddVariableSet, op_function};
use fixedbitset::FixedBitSet;

use super::formula::{Formula, Operator, SignalId};

/// Manager of diagrams over a list of signals.
pub struct Diagrams {
    variables: BddVariableSet,
    /// Signal of each variable.
    order: Vec<SignalId>,
    /// Variable of each signal.
    of: Vec<Option<BddVariable>>,
    limit: usize,
}

/// A set of valuations of the signals of its [`Diagrams`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagram(Bdd);

/// Cube: partial valuation with `ones` TRUE and `zeros` FALSE; signals in neither list are free.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cube {
    /// Signals that are TRUE.
    pub ones: Vec<SignalId>,
    /// Signals that are FALSE.
    pub zeros: Vec<SignalId>,
}

/// Upper bound on signals, set by the library.
const MAX_SIGNALS: usize = u16::MAX as usize - 2;

impl Diagrams {
    /// Creates diagrams of up to `limit` nodes over some of `signals` signals, in this variable order; `None` if they
    /// are too many.
    #[must_use]
    pub fn over(order: Vec<SignalId>, signals: usize, limit: usize) -> Option<Self> {
        let count = u16::try_from(order.len().min(MAX_SIGNALS + 1)).ok().filter(|_| order.len() <= MAX_SIGNALS)?;
        let variables = BddVariableSet::new_anonymous(count);
        let mut of = vec![None; signals];
        order.iter().zip(variables.variables()).for_each(|(signal, variable)| of[signal.0] = Some(variable));
        Some(Self { variables, order, of, limit })
    }

    /// The set of all valuations, or the empty set.
    #[must_use]
    pub fn constant(&self, value: bool) -> Diagram {
        Diagram(if value { self.variables.mk_true() } else { self.variables.mk_false() })
    }

    /// Valuations in which a signal is TRUE; `None` if it is not in the variable order.
    #[must_use]
    pub fn signal(&self, signal: SignalId) -> Option<Diagram> {
        let variable = self.of.get(signal.0).copied().flatten()?;
        Some(Diagram(self.variables.mk_var(variable)))
    }

    /// Intersection.
    #[must_use]
    pub fn and(&self, a: &Diagram, b: &Diagram) -> Option<Diagram> {
        Bdd::binary_op_with_limit(self.limit, &a.0, &b.0, op_function::and).map(Diagram)
    }

    /// Union.
    #[must_use]
    pub fn or(&self, a: &Diagram, b: &Diagram) -> Option<Diagram> {
        Bdd::binary_op_with_limit(self.limit, &a.0, &b.0, op_function::or).map(Diagram)
    }

    /// Symmetric difference.
    #[must_use]
    pub fn xor(&self, a: &Diagram, b: &Diagram) -> Option<Diagram> {
        Bdd::binary_op_with_limit(self.limit, &a.0, &b.0, op_function::xor).map(Diagram)
    }

    /// Models of a formula, with `value` for its signals; `None` if a subformula exceeds the node limit.
    #[must_use]
    pub fn formula(&self, formula: &Formula, value: &impl Fn(SignalId) -> Option<Diagram>) -> Option<Diagram> {
        match formula {
            Formula::Constant(truth) => Some(self.constant(*truth)),
            Formula::Signal(signal) => value(*signal),
            Formula::Not(inner) => self.formula(inner, value).map(|inner| inner.complement()),
            Formula::Gate(operator, operands) => {
                let operands: Option<Vec<Diagram>> =
                    operands.iter().map(|operand| self.formula(operand, value)).collect();
                self.operator(*operator, &operands?)
            }
        }
    }

    fn operator(&self, operator: Operator, operands: &[Diagram]) -> Option<Diagram> {
        let mut all = operands.iter();
        let first = all.next().cloned().unwrap_or_else(|| self.constant(false));
        match operator {
            Operator::And => all.try_fold(first, |and, operand| self.and(&and, operand)),
            Operator::Or => all.try_fold(first, |or, operand| self.or(&or, operand)),
            Operator::Xor => all.try_fold(first, |odd, operand| self.xor(&odd, operand)),
            Operator::Iff => all.try_fold(first, |odd, operand| self.xor(&odd, operand)).map(|odd| odd.complement()),
            Operator::Implies => all.try_fold(first.complement(), |or, operand| self.or(&or, operand)),
            Operator::AtMostOne | Operator::ExactlyOne => {
                let (mut one, mut two) = (self.constant(false), self.constant(false));
                for operand in operands {
                    two = self.or(&two, &self.and(&one, operand)?)?;
                    one = self.or(&one, operand)?;
                }
                let at_most = two.complement();
                if operator == Operator::AtMostOne { Some(at_most) } else { self.and(&one, &at_most) }
            }
        }
    }

    /// Existential quantification: valuations that are in the set for some values of these signals.
    #[must_use]
    pub fn whatever(&self, diagram: &Diagram, signals: &[SignalId]) -> Option<Diagram> {
        let mut found = diagram.0.clone();
        for signal in signals {
            let variable = self.of.get(signal.0).copied().flatten()?;
            if found.support_set().contains(&variable) {
                let (without, with) = (found.var_restrict(variable, false), found.var_restrict(variable, true));
                found = Bdd::binary_op_with_limit(self.limit, &without, &with, op_function::or)?;
            }
        }
        Some(Diagram(found))
    }

    /// Number of valuations of all signals in a set, in decimal.
    #[must_use]
    pub fn count(&self, diagram: &Diagram) -> String {
        diagram.0.exact_cardinality().to_string()
    }

    /// Number of valuations of all but these signals, on which the set must not depend, in decimal.
    #[must_use]
    pub fn count_without(&self, diagram: &Diagram, signals: &[SignalId]) -> String {
        (diagram.0.exact_cardinality() >> signals.len()).to_string()
    }

    /// Number of valuations, if it fits 64 bits.
    #[must_use]
    pub fn count_if_few(&self, diagram: &Diagram) -> Option<u64> {
        u64::try_from(diagram.0.exact_cardinality()).ok()
    }

    /// Valuations in a set, as the signals that are TRUE, in a deterministic order.
    pub fn valuations<'d>(&'d self, diagram: &'d Diagram) -> impl Iterator<Item = FixedBitSet> + 'd {
        diagram.0.sat_valuations().map(|valuation| {
            let ones =
                self.order.iter().zip(self.variables.variables()).filter(|(_, variable)| valuation.value(*variable));
            let mut set = FixedBitSet::with_capacity(self.of.len());
            ones.for_each(|(signal, _)| set.insert(signal.0));
            set
        })
    }

    /// Disjoint cubes whose union is the set.
    pub fn cubes<'d>(&'d self, diagram: &'d Diagram) -> impl Iterator<Item = Cube> + 'd {
        diagram.0.sat_clauses().map(|clause| {
            let mut cube = Cube { ones: Vec::new(), zeros: Vec::new() };
            for (&signal, variable) in self.order.iter().zip(self.variables.variables()) {
                match clause.get_value(variable) {
                    Some(true) => cube.ones.push(signal),
                    Some(false) => cube.zeros.push(signal),
                    None => {}
                }
            }
            cube
        })
    }
}

impl Diagram {
    /// Complement.
    #[must_use]
    pub fn complement(&self) -> Self {
        Self(self.0.not())
    }

    /// Whether the set is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_false()
    }

    /// Whether the set contains every valuation.
    #[must_use]
    pub fn is_all(&self) -> bool {
        self.0.is_true()
    }

    /// Number of nodes.
    #[must_use]
    pub fn size(&self) -> usize {
        self.0.size()
    }
}

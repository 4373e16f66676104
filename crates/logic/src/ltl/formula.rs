//! LTL formulas: formulas about one path.

/// An LTL formula. Its atoms are state formulas, as written or bound.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Path<A> {
    /// State formula about the first state.
    State(A),
    /// Negation.
    Not(Box<Self>),
    /// Conjunction.
    And(Box<Self>, Box<Self>),
    /// Disjunction.
    Or(Box<Self>, Box<Self>),
    /// Implication.
    Implies(Box<Self>, Box<Self>),
    /// Equivalence.
    Iff(Box<Self>, Box<Self>),
    /// X f: true in the next state, if there is one (weak next).
    Next(Box<Self>),
    /// F f: true now or later.
    Finally(Box<Self>),
    /// G f: true from now on.
    Globally(Box<Self>),
    /// f U g: g becomes true, and f is true until then.
    Until(Box<Self>, Box<Self>),
    /// f W g: weak until: f U g, or f is true for ever.
    WeakUntil(Box<Self>, Box<Self>),
    /// f R g: release: g is true until f and g are true together, or for ever.
    Release(Box<Self>, Box<Self>),
}

impl<A> Path<A> {
    /// Returns the formula with mapped atoms.
    pub fn map<B>(&self, atom: &mut impl FnMut(&A) -> B) -> Path<B> {
        let mut of = |f: &Self| Box::new(f.map(atom));
        match self {
            Self::State(f) => Path::State(atom(f)),
            Self::Not(f) => Path::Not(of(f)),
            Self::And(f, g) => Path::And(of(f), of(g)),
            Self::Or(f, g) => Path::Or(of(f), of(g)),
            Self::Implies(f, g) => Path::Implies(of(f), of(g)),
            Self::Iff(f, g) => Path::Iff(of(f), of(g)),
            Self::Next(f) => Path::Next(of(f)),
            Self::Finally(f) => Path::Finally(of(f)),
            Self::Globally(f) => Path::Globally(of(f)),
            Self::Until(f, g) => Path::Until(of(f), of(g)),
            Self::WeakUntil(f, g) => Path::WeakUntil(of(f), of(g)),
            Self::Release(f, g) => Path::Release(of(f), of(g)),
        }
    }

    /// Atoms of the formula, once for each occurrence.
    pub fn atoms(&self) -> Vec<&A> {
        match self {
            Self::State(f) => vec![f],
            Self::Not(f) | Self::Next(f) | Self::Finally(f) | Self::Globally(f) => f.atoms(),
            Self::And(f, g)
            | Self::Or(f, g)
            | Self::Implies(f, g)
            | Self::Iff(f, g)
            | Self::Until(f, g)
            | Self::WeakUntil(f, g)
            | Self::Release(f, g) => f.atoms().into_iter().chain(g.atoms()).collect(),
        }
    }

    /// Finds a premise of an implication that makes the formula vacuously true: one for which `never` says that it
    /// holds in no state.
    pub fn vacuous_premise<'f>(&'f self, never: &mut dyn FnMut(&A) -> bool) -> Option<&'f A> {
        match self {
            Self::Implies(premise, conclusion) => match &**premise {
                Self::State(premise) if never(premise) => Some(premise),
                _ => conclusion.vacuous_premise(never),
            },
            Self::Next(f) | Self::Finally(f) | Self::Globally(f) => f.vacuous_premise(never),
            Self::And(f, g) | Self::Until(f, g) | Self::WeakUntil(f, g) | Self::Release(f, g) => {
                f.vacuous_premise(never).or_else(|| g.vacuous_premise(never))
            }
            _ => None,
        }
    }
}

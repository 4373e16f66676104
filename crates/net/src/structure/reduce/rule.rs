//! The catalogue of reduction rules, by name.

/// A reduction rule. Its file says when it applies, and why it keeps what it keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Rule {
    /// Removes transitions that can never fire.
    Dead,
    /// Removes places that never disable a transition; of kept ones, only the arcs that test them.
    Unrestricting,
    /// Divides the weights and tokens of a place by the greatest common divisor of the weights.
    Scaled,
    /// Removes places that have enough tokens whenever another one has (implicit places).
    Implied,
    /// Removes transitions if another one has the same effect and needs no more tokens.
    Dominated,
    /// Removes transitions without effect.
    Idle,
    /// Removes transitions if two others, one after the other, have the same effect and need no more tokens.
    Composed,
    /// Removes transitions on which the kept places do not depend (slicing).
    Irrelevant,
    /// Records that a transition can always fire, so that there are no deadlocks.
    Alive,
    /// Fuses transitions that only need tokens of one place with those that put them there.
    PostAgglomeration,
    /// Fuses transitions that only put tokens on one place, and are alone in needing their inputs, with those that take
    /// the tokens.
    PreAgglomeration,
    /// Fuses transitions that only put tokens on one place with those that take the tokens.
    FreeAgglomeration,
    /// Fuses places that are strongly connected by transitions that only move a token.
    Fusion,
    /// Removes places that can initially be filled with any number of tokens.
    Supply,
}

impl Rule {
    /// All rules.
    pub const ALL: [Self; 14] = [
        Self::Dead,
        Self::Unrestricting,
        Self::Scaled,
        Self::Implied,
        Self::Dominated,
        Self::Idle,
        Self::Composed,
        Self::Irrelevant,
        Self::Alive,
        Self::PostAgglomeration,
        Self::PreAgglomeration,
        Self::FreeAgglomeration,
        Self::Fusion,
        Self::Supply,
    ];

    /// Name of the rule in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Dead => "dead transitions",
            Self::Unrestricting => "places that hold nothing back",
            Self::Scaled => "common factors of weights",
            Self::Implied => "implied places",
            Self::Dominated => "dominated transitions",
            Self::Idle => "transitions without effect",
            Self::Composed => "transitions that two others replace",
            Self::Irrelevant => "irrelevant transitions",
            Self::Alive => "transitions that can always fire",
            Self::PostAgglomeration => "post-agglomerations",
            Self::PreAgglomeration => "pre-agglomerations",
            Self::FreeAgglomeration => "free agglomerations",
            Self::Fusion => "fused places",
            Self::Supply => "places filled at will",
        }
    }
}

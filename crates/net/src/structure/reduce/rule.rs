//! The catalogue of rules, by name.

/// A rule of the catalogue. The file that has the rule says when it applies, and why it keeps what it keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Rule {
    /// A transition that can never fire goes.
    Dead,
    /// A place that never holds a transition back goes; if it is kept, the arcs that only test it go.
    Unrestricting,
    /// Weights and tokens of a place are divided by what divides all of them.
    Scaled,
    /// A place goes that has enough tokens whenever another one has.
    Implied,
    /// A transition goes if another does the same and needs no more.
    Dominated,
    /// A transition goes that changes nothing.
    Idle,
    /// A transition goes if two others, one after the other, do the same and need no more.
    Composed,
    /// All goes on which what is kept does not depend.
    Irrelevant,
    /// A transition that can always fire is noted, so that deadlocks need no further thought.
    Alive,
    /// What follows at once is fired together with what comes before it.
    PostAgglomeration,
    /// What prepares one place, undisturbed, is fired together with what comes after it.
    PreAgglomeration,
    /// What prepares one place is fired together with what comes after it.
    FreeAgglomeration,
    /// Places between which tokens move freely, round in a circle, become one.
    Fusion,
    /// Places that can be filled at the beginning as much as one likes go.
    Supply,
}

impl Rule {
    /// Every rule.
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

    /// Its name, for figures.
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

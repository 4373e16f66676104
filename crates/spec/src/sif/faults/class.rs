//! Classes of faults.

/// Class of single faults: see the table in the module.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[expect(missing_docs, reason = "the table says what they are")]
pub enum Class {
    LiteralNegation,
    TermNegation,
    ExpressionNegation,
    Operator,
    LiteralOmission,
    TermOmission,
    LiteralInsertion,
    LiteralReference,
    StuckAtFalse,
    StuckAtTrue,
}

impl Class {
    /// All classes, in the order of the table.
    pub const ALL: [Self; 10] = [
        Self::LiteralNegation,
        Self::TermNegation,
        Self::ExpressionNegation,
        Self::Operator,
        Self::LiteralOmission,
        Self::TermOmission,
        Self::LiteralInsertion,
        Self::LiteralReference,
        Self::StuckAtFalse,
        Self::StuckAtTrue,
    ];

    /// Name of the class.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::LiteralNegation => "literal negation",
            Self::TermNegation => "term negation",
            Self::ExpressionNegation => "expression negation",
            Self::Operator => "operator",
            Self::LiteralOmission => "literal omission",
            Self::TermOmission => "term omission",
            Self::LiteralInsertion => "literal insertion",
            Self::LiteralReference => "literal reference",
            Self::StuckAtFalse => "stuck at FALSE",
            Self::StuckAtTrue => "stuck at TRUE",
        }
    }
}

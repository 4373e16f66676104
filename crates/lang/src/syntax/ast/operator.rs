//! Operators of IL (edition 2, table 52).

use std::fmt;

/// Operator with its modifier N.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Operator {
    /// Operator without modifier.
    pub verb: Verb,
    /// Modifier N: whether the operand, the value of the parenthesis, or the stored value is complemented.
    pub negated: bool,
}

macro_rules! verbs {
    ($($name:ident = $word:literal,)+) => {
        /// The operators of edition 2, table 52 (without jump, call and return).
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(missing_docs, reason = "each is named by its word")]
        pub enum Verb { $($name,)+ }

        impl Verb {
            /// Every operator with its word.
            pub const ALL: &'static [(Verb, &'static str)] = &[$((Verb::$name, $word)),+];
        }
    };
}

verbs! {
    Ld = "LD", St = "ST", Not = "NOT", S = "S", R = "R", S1 = "S1", R1 = "R1", Clk = "CLK", Cu = "CU", Cd = "CD",
    Pv = "PV", In = "IN", Pt = "PT", And = "AND", Or = "OR", Xor = "XOR", Add = "ADD", Sub = "SUB", Mul = "MUL",
    Div = "DIV", Mod = "MOD", Gt = "GT", Ge = "GE", Eq = "EQ", Lt = "LT", Le = "LE", Ne = "NE",
}

impl Verb {
    /// Word of the operator, without modifier.
    #[must_use]
    pub fn word(self) -> &'static str {
        Self::ALL[self as usize].1
    }

    /// Whether the operator combines the current result with an operand, so that a parenthesis may follow it.
    #[must_use]
    pub fn combines(self) -> bool {
        self as usize >= Self::And as usize
    }

    /// Whether the operator may be the name of a function block's input, which it stores the current result in.
    #[must_use]
    pub fn is_block_input(self) -> bool {
        use Verb::{Cd, Clk, Cu, In, Pt, Pv, R, R1, S, S1};
        matches!(self, S | R | S1 | R1 | Clk | Cu | Cd | Pv | In | Pt)
    }
}

impl fmt::Display for Operator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.verb.word(), if self.negated { "N" } else { "" })
    }
}

//! Functions of two operands, whether written as operators or called by their names.

/// Function of the current result (CR) and an operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// Conjunction, bit by bit.
    And,
    /// Disjunction, bit by bit.
    Or,
    /// Exclusive disjunction, bit by bit.
    Xor,
    /// Sum.
    Add,
    /// Difference.
    Sub,
    /// Product.
    Mul,
    /// Quotient, truncated toward zero; 0 if the divisor is 0.
    Div,
    /// Remainder with the sign of the dividend; 0 if the divisor is 0.
    Mod,
    /// Whether CR is greater.
    Gt,
    /// Whether CR is greater or equal.
    Ge,
    /// Whether CR is equal.
    Eq,
    /// Whether CR is not equal.
    Ne,
    /// Whether CR is less or equal.
    Le,
    /// Whether CR is less.
    Lt,
    /// CR shifted left, zeros from the right.
    Shl,
    /// CR shifted right, zeros from the left.
    Shr,
    /// CR rotated left.
    Rol,
    /// CR rotated right.
    Ror,
}

impl Function {
    /// Every function.
    pub const ALL: [Self; 18] = [
        Self::And,
        Self::Or,
        Self::Xor,
        Self::Add,
        Self::Sub,
        Self::Gt,
        Self::Ge,
        Self::Eq,
        Self::Ne,
        Self::Le,
        Self::Lt,
        Self::Shl,
        Self::Shr,
        Self::Rol,
        Self::Ror,
        Self::Mul,
        Self::Div,
        Self::Mod,
    ];

    /// Word of the operator.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::And => "AND",
            Self::Or => "OR",
            Self::Xor => "XOR",
            Self::Add => "ADD",
            Self::Sub => "SUB",
            Self::Mul => "MUL",
            Self::Div => "DIV",
            Self::Mod => "MOD",
            Self::Gt => "GT",
            Self::Ge => "GE",
            Self::Eq => "EQ",
            Self::Ne => "NE",
            Self::Le => "LE",
            Self::Lt => "LT",
            Self::Shl => "SHL",
            Self::Shr => "SHR",
            Self::Rol => "ROL",
            Self::Ror => "ROR",
        }
    }

    /// Whether the function is a comparison, which gives a `BOOL` whatever the type of its operands.
    #[must_use]
    pub fn compares(self) -> bool {
        matches!(self, Self::Gt | Self::Ge | Self::Eq | Self::Ne | Self::Le | Self::Lt)
    }

    /// Whether the function is a shift or rotation, whose operand is the distance.
    #[must_use]
    pub fn shifts(self) -> bool {
        matches!(self, Self::Shl | Self::Shr | Self::Rol | Self::Ror)
    }
}

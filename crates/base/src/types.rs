//! Elementary data types (IEC 61131-3, B.1.3.1), and the meaning of their bits.

use std::fmt;

/// Elementary data type. Its values are patterns of [`Type::width`] bits in the low end of a `u64`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Type {
    /// Meaning of the bits.
    pub kind: Kind,
    /// Number of bits: 1, 8, 16, 32 or 64.
    pub width: u32,
}

/// Meaning of the bits of a type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// `BOOL`, `BYTE`, `WORD`, `DWORD`, `LWORD`: bit strings without a meaning as a number; compared as unsigned
    /// numbers.
    Bits,
    /// `USINT`, `UINT`, `UDINT`, `ULINT`.
    Unsigned,
    /// `SINT`, `INT`, `DINT`, `LINT`: two's complement.
    Signed,
    /// `TIME`: milliseconds, two's complement.
    Time,
}

impl Type {
    /// `BOOL`
    pub const BOOL: Self = Self::new(Kind::Bits, 1);
    /// `TIME`
    pub const TIME: Self = Self::new(Kind::Time, 32);

    /// Every type with its name.
    pub const ALL: [(&'static str, Self); 14] = [
        ("BOOL", Self::BOOL),
        ("BYTE", Self::new(Kind::Bits, 8)),
        ("WORD", Self::new(Kind::Bits, 16)),
        ("DWORD", Self::new(Kind::Bits, 32)),
        ("LWORD", Self::new(Kind::Bits, 64)),
        ("SINT", Self::new(Kind::Signed, 8)),
        ("INT", Self::new(Kind::Signed, 16)),
        ("DINT", Self::new(Kind::Signed, 32)),
        ("LINT", Self::new(Kind::Signed, 64)),
        ("USINT", Self::new(Kind::Unsigned, 8)),
        ("UINT", Self::new(Kind::Unsigned, 16)),
        ("UDINT", Self::new(Kind::Unsigned, 32)),
        ("ULINT", Self::new(Kind::Unsigned, 64)),
        ("TIME", Self::TIME),
    ];

    /// Type of a kind and width.
    #[must_use]
    pub const fn new(kind: Kind, width: u32) -> Self {
        Self { kind, width }
    }

    /// Type with a name, in any case.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|&(_, own)| own)
    }

    /// Whether the type is `BOOL`.
    #[must_use]
    pub fn is_bool(self) -> bool {
        self == Self::BOOL
    }

    /// Whether the type has negative numbers.
    #[must_use]
    pub fn is_signed(self) -> bool {
        matches!(self.kind, Kind::Signed | Kind::Time)
    }

    /// Mask of the bits that a value can have.
    #[must_use]
    pub fn mask(self) -> u64 {
        u64::MAX >> (64 - self.width)
    }

    /// Least number of the type.
    #[must_use]
    pub fn least(self) -> i128 {
        if self.is_signed() { -(1 << (self.width - 1)) } else { 0 }
    }

    /// Greatest number of the type.
    #[must_use]
    pub fn greatest(self) -> i128 {
        if self.is_signed() { (1 << (self.width - 1)) - 1 } else { i128::from(self.mask()) }
    }

    /// Whether the type has a number.
    #[must_use]
    pub fn holds(self, number: i128) -> bool {
        (self.least()..=self.greatest()).contains(&number)
    }

    /// Whether a value of the other type may be a number that this one does not have. Bit strings are not numbers.
    #[must_use]
    pub fn overflows_from(self, other: Self) -> bool {
        let numbers = self.kind != Kind::Bits && other.kind != Kind::Bits;
        numbers && !(self.holds(other.least()) && self.holds(other.greatest()))
    }

    /// Number that a pattern stands for.
    #[must_use]
    pub fn number(self, pattern: u64) -> i128 {
        let pattern = pattern & self.mask();
        let negative = self.is_signed() && pattern >> (self.width - 1) == 1;
        i128::from(pattern) - if negative { 1 << self.width } else { 0 }
    }

    /// Pattern of a number, modulo 2^width.
    #[must_use]
    pub fn pattern(self, number: i128) -> u64 {
        number as u64 & self.mask()
    }
}

impl fmt::Display for Type {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = Self::ALL.iter().find(|(_, own)| own == self).map_or("?", |&(name, _)| name);
        f.write_str(name)
    }
}

#[cfg(test)]
mod tests {
    use super::{Kind, Type};

    #[test]
    fn patterns_are_twos_complement() {
        let sint = Type::new(Kind::Signed, 8);
        assert_eq!((sint.least(), sint.greatest()), (-128, 127));
        assert_eq!((sint.number(0xFF), sint.number(0x80), sint.number(0x7F)), (-1, -128, 127));
        assert_eq!((sint.pattern(-1), sint.pattern(128), sint.pattern(-129)), (0xFF, 0x80, 0x7F));
        let ulint = Type::new(Kind::Unsigned, 64);
        assert_eq!(ulint.greatest(), i128::from(u64::MAX));
        assert_eq!(ulint.number(ulint.pattern(-1)), i128::from(u64::MAX));
        let lint = Type::new(Kind::Signed, 64);
        assert_eq!(lint.number(lint.pattern(-5)), -5);
        assert_eq!((Type::BOOL.number(1), Type::BOOL.greatest()), (1, 1));
    }

    #[test]
    fn every_type_has_its_name() {
        for (name, own) in Type::ALL {
            assert_eq!(own.to_string(), name);
            assert_eq!(Type::named(&name.to_lowercase()), Some(own));
        }
    }
}

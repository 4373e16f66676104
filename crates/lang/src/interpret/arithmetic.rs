//! Functions of two operands, on the bit patterns of a type.

use crate::flat::{Function, Hazard};
use crate::semantics::{Kind, Type};

/// Applies a function to the current result and an operand; returns the value and the hazard it meets.
pub fn combine(function: Function, ty: Type, result: u64, operand: u64) -> (u64, Option<Hazard>) {
    let (a, b) = (ty.number(result), ty.number(operand));
    let truth = |value| (u64::from(value), None);
    match function {
        Function::And => (result & operand, None),
        Function::Or => (result | operand, None),
        Function::Xor => (result ^ operand, None),
        Function::Add => number(ty, a + b),
        Function::Sub => number(ty, a - b),
        Function::Mul => number(ty, a.wrapping_mul(b)),
        Function::Div | Function::Mod if b == 0 => (0, Some(Hazard::DivisionByZero)),
        Function::Div => number(ty, a / b),
        Function::Mod => number(ty, a % b),
        Function::Gt => truth(a > b),
        Function::Ge => truth(a >= b),
        Function::Eq => truth(a == b),
        Function::Ne => truth(a != b),
        Function::Le => truth(a <= b),
        Function::Lt => truth(a < b),
        Function::Shl | Function::Shr | Function::Rol | Function::Ror => (shift(function, ty, result, operand), None),
    }
}

/// Bit pattern of a number, modulo 2^width. Bit strings are not numbers, and cannot overflow.
fn number(ty: Type, number: i128) -> (u64, Option<Hazard>) {
    let fits = ty.kind == Kind::Bits || ty.holds(number);
    (ty.pattern(number), (!fits).then_some(Hazard::Overflow))
}

/// Shifts or rotates a bit pattern, by any distance.
fn shift(function: Function, ty: Type, pattern: u64, distance: u64) -> u64 {
    let width = u64::from(ty.width);
    let around = distance % width;
    let left = |by: u64| pattern.checked_shl(by as u32).unwrap_or(0) & ty.mask();
    let right = |by: u64| pattern.checked_shr(by as u32).unwrap_or(0);
    match function {
        Function::Shl if distance < width => left(distance),
        Function::Shr if distance < width => right(distance),
        Function::Rol => left(around) | right(width - around),
        Function::Ror => right(around) | left(width - around),
        _ => 0,
    }
}

/// Converts a bit pattern of one type to another.
pub fn convert(from: Type, to: Type, pattern: u64) -> (u64, Option<Hazard>) {
    let number = from.number(pattern);
    if to.is_bool() {
        return (u64::from(number != 0), None);
    }
    let overflows = to.overflows_from(from) && !to.holds(number);
    (to.pattern(number), overflows.then_some(Hazard::Overflow))
}

#[cfg(test)]
mod tests {
    use super::{combine, convert};
    use crate::flat::{Function, Hazard};
    use crate::semantics::Type;

    fn ty(name: &str) -> Type {
        Type::named(name).unwrap_or_else(|| panic!("{name}"))
    }

    /// Value and hazard of a function of two numbers of a type.
    fn of(function: Function, name: &str, a: i128, b: i128) -> (i128, Option<Hazard>) {
        let ty = ty(name);
        let (pattern, hazard) = combine(function, ty, ty.pattern(a), ty.pattern(b));
        (ty.number(pattern), hazard)
    }

    #[test]
    fn numbers_wrap_and_say_so() {
        let overflow = Some(Hazard::Overflow);
        assert_eq!(of(Function::Add, "SINT", 127, 1), (-128, overflow));
        assert_eq!(of(Function::Mul, "SINT", 100, 2), (-56, overflow));
        assert_eq!(of(Function::Div, "SINT", -56, 2), (-28, None));
        assert_eq!(of(Function::Sub, "USINT", 0, 1), (255, overflow));
        assert_eq!(of(Function::Mul, "ULINT", u64::MAX.into(), u64::MAX.into()), (1, overflow));
        assert_eq!(of(Function::Mul, "LINT", i64::MIN.into(), -1), (i64::MIN.into(), overflow));
        assert_eq!(of(Function::Div, "SINT", -128, -1), (-128, overflow));
        assert_eq!(of(Function::Mod, "SINT", -128, -1), (0, None));
    }

    #[test]
    fn division_truncates_toward_zero() {
        let pairs = [(-7, 2, -3, -1), (7, -2, -3, 1), (-7, -2, 3, -1), (7, 2, 3, 1)];
        for (a, b, quotient, remainder) in pairs {
            assert_eq!(of(Function::Div, "INT", a, b), (quotient, None));
            assert_eq!(of(Function::Mod, "INT", a, b), (remainder, None));
        }
        let by_zero = Some(Hazard::DivisionByZero);
        assert_eq!(of(Function::Div, "INT", 5, 0), (0, by_zero));
        assert_eq!(of(Function::Mod, "INT", 5, 0), (0, by_zero));
    }

    #[test]
    fn comparisons_know_signs() {
        let truth = |function, name, a, b| combine(function, ty(name), a, b).0;
        assert_eq!(truth(Function::Lt, "SINT", 0xFF, 0), 1, "-1 < 0");
        assert_eq!(truth(Function::Lt, "BYTE", 0xFF, 0), 0);
        assert_eq!(truth(Function::Ge, "USINT", 0xFF, 0x7F), 1);
    }

    #[test]
    fn shifts_go_any_distance() {
        assert_eq!(of(Function::Shl, "BYTE", 0x81, 1), (0x02, None));
        assert_eq!(of(Function::Shr, "BYTE", 0x81, 1), (0x40, None));
        assert_eq!(of(Function::Shl, "LWORD", 1, 64), (0, None));
        assert_eq!(of(Function::Shr, "BYTE", 0x81, 200), (0, None));
        assert_eq!(of(Function::Rol, "BYTE", 0x81, 1), (0x03, None));
        assert_eq!(of(Function::Ror, "BYTE", 0x81, 9), (0xC0, None));
        assert_eq!(of(Function::Rol, "LWORD", 1, 64), (1, None));
    }

    #[test]
    fn conversions_keep_numbers_where_they_can() {
        let of = |from: &str, to: &str, number: i128| {
            let (pattern, hazard) = convert(ty(from), ty(to), ty(from).pattern(number));
            (ty(to).number(pattern), hazard)
        };
        assert_eq!(of("SINT", "INT", -5), (-5, None));
        assert_eq!(of("INT", "SINT", 200), (-56, Some(Hazard::Overflow)));
        assert_eq!(of("INT", "SINT", -128), (-128, None));
        assert_eq!(of("INT", "UINT", -1), (65535, Some(Hazard::Overflow)));
        assert_eq!(of("INT", "WORD", -1), (0xFFFF, None));
        assert_eq!(of("INT", "BYTE", 0x1FF), (0xFF, None));
        assert_eq!(of("BYTE", "INT", 0xFF), (255, None));
        assert_eq!(of("WORD", "INT", 0xFFFF), (-1, None));
        assert_eq!(of("INT", "BOOL", 256), (1, None));
        assert_eq!(of("BOOL", "DINT", 1), (1, None));
    }
}

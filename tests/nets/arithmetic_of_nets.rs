//! Arithmetic, comparisons, logic and shifts as nets compute them, against the integers of Rust.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::flat::{Function, Hazard, Instruction, Operand};
use petril::semantics::{Kind, Type};
use proptest::prelude::*;
use support::token_game::Bench;

fn is_arithmetic(function: Function) -> bool {
    use Function::{Add, Div, Mod, Mul, Sub};
    matches!(function, Add | Sub | Mul | Div | Mod)
}

/// The functions that the standard has for a type.
fn of(ty: Type) -> impl Iterator<Item = Function> {
    let bits =
        |function| matches!(function, Function::And | Function::Or | Function::Xor) || Function::shifts(function);
    let fits = move |&function: &Function| match ty.kind {
        Kind::Bits => !is_arithmetic(function),
        _ => !bits(function),
    };
    Function::ALL.into_iter().filter(fits)
}

/// What comes of a function, by the operations of Rust on a wider type.
fn expected(function: Function, ty: Type, a: u64, b: u64) -> (u64, Option<Hazard>) {
    let sign = |pattern: u64| match (ty.is_signed(), ty.width) {
        (false, _) => i128::from(pattern),
        (true, 8) => i128::from(pattern as u8 as i8),
        (true, 16) => i128::from(pattern as u16 as i16),
        (true, 32) => i128::from(pattern as u32 as i32),
        (true, _) => i128::from(pattern as i64),
    };
    let mask = if ty.width == 64 { u64::MAX } else { (1 << ty.width) - 1 };
    let (x, y) = (sign(a), sign(b));
    let number = |number: i128| {
        let pattern = number as u64 & mask;
        (pattern, (sign(pattern) != number).then_some(Hazard::Overflow))
    };
    let truth = |truth: bool| (u64::from(truth), None);
    let distance = (b % u64::from(ty.width)) as u32;
    let (left, right) = ((u128::from(a) << distance) as u64 & mask, a >> distance);
    let around = |by: u32| if by.is_multiple_of(ty.width) { a } else { (a << by) & mask | a >> (ty.width - by) };
    match function {
        Function::And => (a & b, None),
        Function::Or => (a | b, None),
        Function::Xor => (a ^ b, None),
        Function::Add => number(x + y),
        Function::Sub => number(x - y),
        Function::Mul => match x.checked_mul(y) {
            Some(product) => number(product),
            None => (a.wrapping_mul(b), Some(Hazard::Overflow)),
        },
        Function::Div | Function::Mod if y == 0 => (0, Some(Hazard::DivisionByZero)),
        Function::Div => number(x / y),
        Function::Mod => number(x % y),
        Function::Gt => truth(x > y),
        Function::Ge => truth(x >= y),
        Function::Eq => truth(x == y),
        Function::Ne => truth(x != y),
        Function::Le => truth(x <= y),
        Function::Lt => truth(x < y),
        Function::Shl | Function::Shr if b >= u64::from(ty.width) => (0, None),
        Function::Shl => (left, None),
        Function::Shr => (right, None),
        Function::Rol => (around(distance), None),
        Function::Ror => (around(ty.width - distance), None),
    }
}

fn width(function: Function, ty: Type) -> u32 {
    if function.compares() { 1 } else { ty.width }
}

fn ty(name: &str) -> Type {
    Type::named(name).unwrap()
}

fn check(bench: &mut Bench, function: Function, ty: Type, a: u64, b: u64) {
    let found = bench.run(a, b, width(function, ty));
    assert_eq!(found, expected(function, ty, a, b), "{ty}: {a:#X} {} {b:#X}", function.word());
}

fn variable(function: Function, ty: Type) -> Bench {
    Bench::new(ty, |operand| Instruction::Combine { function, ty, negated: false, operand })
}

fn all_pairs_of(name: &str) {
    let ty = ty(name);
    for function in of(ty) {
        let mut bench = variable(function, ty);
        for a in 0..256 {
            for b in 0..256 {
                check(&mut bench, function, ty, a, b);
            }
        }
    }
}

#[test]
fn all_pairs_of_sint() {
    all_pairs_of("SINT");
}

#[test]
fn all_pairs_of_usint() {
    all_pairs_of("USINT");
}

#[test]
fn all_pairs_of_byte() {
    all_pairs_of("BYTE");
}

/// Constants make nets of their own.
#[test]
fn all_pairs_with_constants() {
    for name in ["SINT", "USINT", "BYTE"] {
        let ty = ty(name);
        for function in of(ty) {
            for b in 0..256 {
                let operand = Operand::Constant(b);
                let mut bench = Bench::new(ty, |_| Instruction::Combine { function, ty, negated: false, operand });
                for a in 0..256 {
                    let found = bench.run(a, 0, width(function, ty));
                    assert_eq!(found, expected(function, ty, a, b), "{ty}: {a:#X} {} {b:#X}", function.word());
                }
            }
        }
    }
}

/// The modifier N complements the operand, as the standard has it for the functions of bits.
#[test]
fn operands_are_complemented() {
    let ty = ty("BYTE");
    for function in of(ty) {
        let mut bench = Bench::new(ty, |operand| Instruction::Combine { function, ty, negated: true, operand });
        for (a, b) in (0..=255).flat_map(|a| (0..256).step_by(5).map(move |b| (a, b))) {
            let found = bench.run(a, b, width(function, ty));
            assert_eq!(found, expected(function, ty, a, !b & 0xFF), "{a:#X} {}N {b:#X}", function.word());
        }
    }
}

/// Numbers near the ends of types, with few bits, and any.
fn interesting() -> impl Strategy<Value = u64> {
    prop_oneof![
        any::<u64>(),
        (any::<u64>(), 0..64_u32).prop_map(|(pattern, by)| pattern >> by),
        (0..64_u32, 0..5_u64).prop_map(|(bit, off)| (1_u64 << bit).wrapping_add(off).wrapping_sub(2)),
        (0..64_u32, 0..5_u64).prop_map(|(bit, off)| (u64::MAX << bit).wrapping_add(off).wrapping_sub(2)),
    ]
}

/// Pairs in which a product or quotient is near the end of the type come up by themselves seldom.
fn pairs() -> impl Strategy<Value = Vec<(u64, u64)>> {
    proptest::collection::vec((interesting(), interesting()), 400)
}

fn wide_pairs(names: &[&str], pairs: &[(u64, u64)]) {
    for ty in names.iter().map(|name| ty(name)) {
        for function in of(ty) {
            let mut bench = variable(function, ty);
            let near = |a: u64, b: u64| {
                let (product, b) = (ty.greatest(), ty.number(b));
                ty.pattern(if b == 0 { i128::from(a) } else { product / b + i128::from(a % 3) - 1 })
            };
            for &(a, b) in pairs {
                check(&mut bench, function, ty, a & ty.mask(), b & ty.mask());
                check(&mut bench, function, ty, near(a, b), b & ty.mask());
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4))]

    #[test]
    fn pairs_of_16_bits(pairs in pairs()) {
        wide_pairs(&["INT", "UINT", "WORD"], &pairs);
    }

    #[test]
    fn pairs_of_32_bits(pairs in pairs()) {
        wide_pairs(&["DINT", "UDINT", "DWORD", "TIME"], &pairs);
    }

    #[test]
    fn pairs_of_64_bits(pairs in pairs()) {
        wide_pairs(&["LINT", "ULINT", "LWORD"], &pairs);
    }

    #[test]
    fn wide_constants(pairs in proptest::collection::vec((interesting(), interesting()), 30)) {
        for (name, ty) in Type::ALL {
            for (&(_, constant), function) in pairs.iter().flat_map(|pair| of(ty).map(move |function| (pair, function))) {
                let operand = Operand::Constant(constant & ty.mask());
                let mut bench = Bench::new(ty, |_| Instruction::Combine { function, ty, negated: false, operand });
                for &(a, _) in pairs.iter().take(8) {
                    let found = bench.run(a & ty.mask(), 0, width(function, ty));
                    let expected = expected(function, ty, a & ty.mask(), constant & ty.mask());
                    prop_assert_eq!(found, expected, "{}: {:#X} {} {:#X}", name, a, function.word(), constant);
                }
            }
        }
    }
}

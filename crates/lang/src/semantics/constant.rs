//! Values of literals in a type.

use super::shape::Scalar;
use crate::syntax::ast::{Constant, Literal};
use petril_base::{Kind, Type};

/// Reason why a literal is not a value of a type, as the end of a sentence that begins with the literal.
pub type Unfit = String;

/// Number that a literal stands for in a type.
///
/// # Errors
/// The reason, if the literal is not a value of the type.
pub fn number(constant: &Constant, scalar: &Scalar) -> Result<i128, Unfit> {
    let ty = scalar.ty;
    let none = || format!("is no value of type `{scalar}`");
    let number = match (constant.literal.as_ref(), &scalar.enumeration) {
        (None, _) => return Err("is no literal that can be read".to_owned()),
        (Some(Literal::Other(what)), _) => return Err(format!("is {what}, which is not modelled")),
        (Some(Literal::Enumerated(prefix, name)), Some(enumeration))
            if enumeration.name.eq_ignore_ascii_case(prefix) =>
        {
            enumeration.find(name).ok_or_else(|| format!("is none of the values of `{}`", enumeration.name))? as i128
        }
        (Some(Literal::Boolean(value)), None) if ty.is_bool() => i128::from(*value),
        (Some(Literal::Time(micros)), None) if ty.kind == Kind::Time => milliseconds(*micros)?,
        (Some(Literal::Typed(name, value)), None) if Type::named(name) == Some(ty) => *value,
        (Some(Literal::Integer(value)), None) if ty.kind != Kind::Time => *value,
        _ => return Err(none()),
    };
    if !ty.holds(number) && ty.is_bool() {
        return Err(none());
    }
    if !ty.holds(number) {
        let (least, greatest) = (ty.least(), ty.greatest());
        return Err(format!("is no value of type `{ty}`, which goes from {least} to {greatest}"));
    }
    match scalar.range {
        Some((lower, upper)) if !(lower..=upper).contains(&number) => Err(format!("is outside {lower}..{upper}")),
        _ => Ok(number),
    }
}

/// Next wider type of the same kind that has the literal's number.
pub fn wider(constant: &Constant, scalar: &Scalar) -> Option<Type> {
    let Some(Literal::Integer(number)) = constant.literal else { return None };
    let ty = scalar.ty;
    let mut types = Type::ALL.iter().map(|&(_, ty)| ty).filter(|other| other.kind == ty.kind && other.width > ty.width);
    if ty.holds(number) || ty.kind == Kind::Time {
        return None;
    }
    types.find(|ty| scalar.enumeration.is_none() && ty.holds(number))
}

/// Converts microseconds to milliseconds, if these are whole.
pub fn milliseconds(micros: i128) -> Result<i128, Unfit> {
    let whole = micros % 1000 == 0;
    whole.then_some(micros / 1000).ok_or_else(|| "is no whole number of milliseconds".to_owned())
}

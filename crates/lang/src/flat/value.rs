//! Text of values in tables.

use crate::semantics::{Kind, Type};

/// Text of a value in a table: `0` and `1` for truth values, `16#8001` for bit strings, `T#1s500ms` for times, decimal
/// numbers for everything else.
#[must_use]
pub fn value_text(ty: Type, pattern: u64) -> String {
    let number = ty.number(pattern);
    match ty.kind {
        Kind::Time => duration(number),
        Kind::Bits if !ty.is_bool() => format!("16#{number:0width$X}", width = ty.width as usize / 4),
        _ => number.to_string(),
    }
}

/// Milliseconds as a literal of type `TIME`: `T#1m30s`, `T#0ms`, `T#-5ms`.
fn duration(milliseconds: i128) -> String {
    let mut rest = milliseconds.unsigned_abs();
    let mut text = if milliseconds < 0 { "T#-".to_owned() } else { "T#".to_owned() };
    if rest == 0 {
        return text + "0ms";
    }
    for (unit, length) in [("d", 86_400_000), ("h", 3_600_000), ("m", 60_000), ("s", 1000), ("ms", 1)] {
        if rest >= length {
            text += &format!("{}{unit}", rest / length);
            rest %= length;
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::value_text;
    use crate::semantics::Type;

    #[test]
    fn values_are_numbers_and_bits_and_times_are_literals() {
        let text = |name: &str, pattern| value_text(Type::named(name).unwrap_or(Type::BOOL), pattern);
        assert_eq!([text("BOOL", 1), text("BYTE", 0xC1), text("SINT", 0xFF)], ["1", "16#C1", "-1"]);
        assert_eq!([text("WORD", 0x8001), text("DWORD", 0xA), text("USINT", 0xFF)], ["16#8001", "16#0000000A", "255"]);
        let times = [0, 20, 1500, 90_000, 86_400_000 + 1];
        assert_eq!(times.map(|ms| text("TIME", ms)), ["T#0ms", "T#20ms", "T#1s500ms", "T#1m30s", "T#1d1ms"]);
        assert_eq!(text("TIME", Type::TIME.pattern(-61_005)), "T#-1m1s5ms");
    }
}

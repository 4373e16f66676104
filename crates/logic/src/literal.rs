//! IEC 61131-3 literals in formulas and domains: `-5`, `1_000`, `16#FF`, `INT#-5`, `BYTE#16#0F`, `T#1s500ms`.

use petril_base::{Kind, Type};

/// Value of a literal; a time in milliseconds.
///
/// # Errors
/// Message that says what is wrong with the literal.
pub fn number(text: &str) -> Result<i128, String> {
    let no_number = || format!("`{text}` is no number");
    let too_large = || "this number is too large".to_owned();
    let typed = text.split_once('#').filter(|(head, _)| head.starts_with(|c: char| c.is_ascii_alphabetic()));
    let number = match typed {
        None => plain(text).ok_or_else(|| if is_digits(text) { too_large() } else { no_number() })?,
        Some((head, rest)) if ["T", "TIME"].iter().any(|word| head.eq_ignore_ascii_case(word)) => {
            duration(rest).ok_or_else(|| format!("`{text}` is no time in whole milliseconds"))?
        }
        Some((head, rest)) => {
            let ty = Type::named(head).ok_or_else(|| format!("`{head}` is no elementary type"))?;
            let number = match rest {
                _ if ty.is_bool() && rest.eq_ignore_ascii_case("TRUE") => 1,
                _ if ty.is_bool() && rest.eq_ignore_ascii_case("FALSE") => 0,
                _ => plain(rest).filter(|_| ty.kind != Kind::Time).ok_or_else(no_number)?,
            };
            if !ty.holds(number) {
                return Err(format!("`{text}` is no value of type `{ty}`"));
            }
            number
        }
    };
    let fits = (i128::from(i64::MIN)..=i128::from(u64::MAX)).contains(&number);
    if fits { Ok(number) } else { Err(too_large()) }
}

/// Time literal with its `T#`, which may have been left out.
#[must_use]
pub fn time(text: &str) -> String {
    if text.contains('#') { text.to_owned() } else { format!("T#{text}") }
}

fn is_digits(text: &str) -> bool {
    text.trim_start_matches('-').bytes().all(|byte| byte.is_ascii_digit())
}

/// Value of an untyped literal: `-5`, `1_000`, `16#FF`.
fn plain(text: &str) -> Option<i128> {
    let (negative, digits) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let (radix, digits) = match digits.split_once('#') {
        None => (10, digits),
        Some(("2", digits)) => (2, digits),
        Some(("8", digits)) => (8, digits),
        Some(("16", digits)) => (16, digits),
        Some(_) => return None,
    };
    if !digits.starts_with(|c: char| c.is_ascii_alphanumeric()) {
        return None;
    }
    let number = i128::from_str_radix(&digits.replace('_', ""), radix).ok()?;
    Some(if negative { -number } else { number })
}

/// Milliseconds of a duration: `1s500ms`, `-5ms`, `1.5s`, `1h_30m`. Units come from the largest to the smallest, and
/// only the last may have a fraction.
fn duration(text: &str) -> Option<i128> {
    let (negative, mut rest) = text.strip_prefix('-').map_or((false, text), |rest| (true, rest));
    let units: [(&str, i128); 5] = [("d", 86_400_000), ("h", 3_600_000), ("ms", 1), ("m", 60_000), ("s", 1000)];
    let mut total = 0_i128;
    let mut largest = i128::MAX;
    loop {
        let end = rest.find(|c: char| c.is_ascii_alphabetic())?;
        let (count, tail) = rest.split_at(end);
        let lower = tail.get(..2.min(tail.len()))?.to_ascii_lowercase();
        let &(unit, length) = units.iter().find(|(unit, _)| lower.starts_with(unit))?;
        rest = &tail[unit.len()..];
        let (whole, fraction) = count.split_once('.').map_or((count, ""), |(whole, fraction)| (whole, fraction));
        let digits = |text: &str| text.replace('_', "").parse::<u64>().ok().map(i128::from);
        if length >= largest || (!fraction.is_empty() && !rest.is_empty()) || fraction.len() > 9 {
            return None;
        }
        total += digits(whole)?.checked_mul(length)?;
        if !fraction.is_empty() {
            let (parts, of) = (digits(fraction)? * length, 10_i128.pow(fraction.len() as u32));
            total += (parts % of == 0).then_some(parts / of)?;
        }
        largest = length;
        rest = rest.strip_prefix('_').unwrap_or(rest);
        if rest.is_empty() {
            return Some(if negative { -total } else { total });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn literals_are_numbers() {
        let cases = [
            ("0", 0),
            ("-17", -17),
            ("1_000", 1000),
            ("16#FF", 255),
            ("2#1010_0101", 0xA5),
            ("8#17", 15),
            ("INT#-5", -5),
            ("byte#16#0F", 15),
            ("BOOL#TRUE", 1),
            ("T#1s500ms", 1500),
            ("time#-5ms", -5),
            ("T#1.5s", 1500),
            ("t#1h_30m", 5_400_000),
            ("T#1d2h3m4s5ms", 93_784_005),
            ("18446744073709551615", u64::MAX.into()),
        ];
        for (text, expected) in cases {
            assert_eq!(number(text), Ok(expected), "{text}");
        }
    }

    #[test]
    fn what_is_none_is_refused() {
        for text in
            ["", "-", "x", "3#12", "16#", "16#_", "INT#40000", "USINT#-1", "REAL#1", "T#5", "T#", "T#1ms1s", "T#1.5ms"]
        {
            assert!(number(text).is_err(), "{text}");
        }
        assert_eq!(number("99999999999999999999"), Err("this number is too large".to_owned()));
        assert_eq!(number("99999999999999999999999999999999999999999999"), Err("this number is too large".to_owned()));
    }
}

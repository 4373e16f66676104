//! Literals (B.1.2): their text and their value.

use petril_base::source::Span;

/// A literal as it was written.
#[derive(Clone, Debug)]
pub struct Constant {
    /// Text as written.
    pub text: String,
    /// Value; `None` if the text has none, like `16#FG` or `T#5x`.
    pub literal: Option<Literal>,
    /// Span in the text.
    pub span: Span,
}

/// The value of a literal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Literal {
    /// `TRUE`, `FALSE`
    Boolean(bool),
    /// `5`, `16#FF`: a number whose type follows from its use.
    Integer(i128),
    /// `INT#5`, `BYTE#16#0F`, `BOOL#1`: the type's name as written.
    Typed(String, i128),
    /// `T#1s500ms`, in microseconds.
    Time(i128),
    /// `Colour#Red`: the type's name and the value's.
    Enumerated(String, String),
    /// Literal of a kind that is not modelled, with the name of the kind.
    Other(&'static str),
}

impl Literal {
    /// Reads the text of a literal; `None` if it has no value.
    #[must_use]
    pub fn read(text: &str) -> Option<Self> {
        if text.starts_with(['\'', '"']) {
            return Some(Self::Other("a character string"));
        }
        let upper = text.to_ascii_uppercase();
        match upper.as_str() {
            "TRUE" => return Some(Self::Boolean(true)),
            "FALSE" => return Some(Self::Boolean(false)),
            _ => {}
        }
        let Some((prefix, rest)) = upper.split_once('#').filter(|(prefix, _)| !is_number(prefix)) else {
            return number(&upper);
        };
        match prefix {
            "T" | "TIME" => time(rest).map(Self::Time),
            "LT" | "LTIME" => Some(Self::Other("a time of 64 bits")),
            "D" | "DATE" | "TOD" | "TIME_OF_DAY" | "DT" | "DATE_AND_TIME" => Some(Self::Other("a date or time of day")),
            "REAL" | "LREAL" => Some(Self::Other("a floating-point number")),
            "BOOL" if rest == "TRUE" => Some(Self::Boolean(true)),
            "BOOL" if rest == "FALSE" => Some(Self::Boolean(false)),
            _ if is_number(rest) => match number(rest)? {
                Self::Integer(value) => Some(Self::Typed(prefix.to_owned(), value)),
                other => Some(other),
            },
            _ => {
                let (prefix, name) = text.split_once('#')?;
                let is_name = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
                    && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
                is_name.then(|| Self::Enumerated(prefix.to_owned(), name.to_owned()))
            }
        }
    }
}

fn is_number(text: &str) -> bool {
    text.trim_start_matches(['+', '-']).starts_with(|c: char| c.is_ascii_digit())
}

/// Reads a number in upper case, with a sign or a base but no type.
fn number(text: &str) -> Option<Literal> {
    let (negative, digits) = match text.strip_prefix('-') {
        Some(digits) => (true, digits),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let signed = |value: i128| Some(Literal::Integer(if negative { -value } else { value }));
    match digits.split_once('#') {
        Some((base @ ("2" | "8" | "16"), digits)) => signed(whole(digits, base.parse().ok()?)?),
        Some(_) => None,
        None if digits.contains(['.', 'E']) && digits.chars().all(|c| c.is_ascii_digit() || "._E+-".contains(c)) => {
            Some(Literal::Other("a floating-point number"))
        }
        None => signed(whole(digits, 10)?),
    }
}

/// Reads digits, where single `_` may stand between them. A number larger than any type holds is still a number.
fn whole(digits: &str, base: u32) -> Option<i128> {
    let separated = digits.split('_').all(|group| !group.is_empty());
    let plain: String = digits.chars().filter(|&c| c != '_').collect();
    let in_base = separated && plain.chars().all(|c| c.is_digit(base));
    in_base.then(|| i128::from_str_radix(&plain, base).unwrap_or(i128::MAX >> 1))
}

/// Reads a duration in upper case, like `1S500MS`, as microseconds.
fn time(text: &str) -> Option<i128> {
    const UNITS: [(&str, i128); 6] =
        [("D", 86_400_000_000), ("H", 3_600_000_000), ("M", 60_000_000), ("S", 1_000_000), ("MS", 1000), ("US", 1)];
    let (negative, mut rest) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text),
    };
    let mut total: i128 = 0;
    let mut next_unit = 0;
    if rest.is_empty() {
        return None;
    }
    while !rest.is_empty() {
        let digits = rest.find(|c: char| c.is_ascii_alphabetic())?;
        let (number, behind) = rest.split_at(digits);
        let letters = behind.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(behind.len());
        let (unit, behind) = behind.split_at(letters);
        let position = UNITS.iter().position(|(name, _)| *name == unit).filter(|&position| position >= next_unit)?;
        next_unit = position + 1;
        let scale = UNITS[position].1;
        let (whole_part, fraction) = number.split_once('.').unwrap_or((number, ""));
        total = total.checked_add(whole(whole_part, 10)?.checked_mul(scale)?)?;
        if number.contains('.') {
            // Only the last part may have a fraction.
            let fraction: String = fraction.chars().filter(|&c| c != '_').collect();
            let power = 10_i128.checked_pow(u32::try_from(fraction.len()).ok().filter(|&n| n > 0 && n < 20)?)?;
            total += whole(&fraction, 10)?.checked_mul(scale)? / power;
            if !behind.is_empty() {
                return None;
            }
        }
        rest = behind.strip_prefix('_').filter(|rest| !rest.is_empty()).unwrap_or(behind);
    }
    Some(if negative { -total } else { total })
}

#[cfg(test)]
mod tests {
    use super::Literal;

    #[test]
    fn literals_have_the_values_of_the_standards_examples() {
        let integer = |value| Some(Literal::Integer(value));
        let typed = |name: &str, value| Some(Literal::Typed(name.to_owned(), value));
        let cases = [
            ("-12", integer(-12)),
            ("123_456", integer(123_456)),
            ("+986", integer(986)),
            ("2#1111_1111", integer(255)),
            ("8#377", integer(255)),
            ("16#Ff", integer(255)),
            ("16#e0", integer(224)),
            ("DINT#5", typed("DINT", 5)),
            ("sint#-5", typed("SINT", -5)),
            ("UINT#16#9AF", typed("UINT", 0x9AF)),
            ("BOOL#0", typed("BOOL", 0)),
            ("BOOL#true", Some(Literal::Boolean(true))),
            ("true", Some(Literal::Boolean(true))),
            ("Colour#Red", Some(Literal::Enumerated("Colour".to_owned(), "Red".to_owned()))),
            ("-1.34E-12", Some(Literal::Other("a floating-point number"))),
            ("REAL#1", Some(Literal::Other("a floating-point number"))),
            ("'it'", Some(Literal::Other("a character string"))),
            ("D#1984-06-25", Some(Literal::Other("a date or time of day"))),
            ("16#FG", None),
            ("2#12", None),
            ("3#12", None),
            ("1__0", None),
            ("5a", None),
        ];
        for (text, value) in cases {
            assert_eq!(Literal::read(text), value, "{text}");
        }
    }

    #[test]
    fn durations_have_the_values_of_the_standards_examples() {
        let ms = |milliseconds: i128| Some(Literal::Time(milliseconds * 1000));
        let cases = [
            ("T#14ms", ms(14)),
            ("T#-14ms", ms(-14)),
            ("T#14.7s", ms(14_700)),
            ("T#14.7m", ms(882_000)),
            ("t#14.7h", ms(52_920_000)),
            ("T#25h_15m", ms(90_900_000)),
            ("TIME#5d14h12m18s3.5ms", Some(Literal::Time(483_138_003_500))),
            ("time#25h_15m", ms(90_900_000)),
            ("T#1s500ms", ms(1500)),
            ("T#500ms1s", None),
            ("T#1.5s3ms", None),
            ("T#5", None),
            ("T#", None),
            ("T#5x", None),
        ];
        for (text, value) in cases {
            assert_eq!(Literal::read(text), value, "{text}");
        }
    }
}

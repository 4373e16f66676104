//! Options about what a program means on the PLC it runs on.

use clap::ValueEnum;
use petril::flat::Tolerated;
use petril::logic;

/// What the PLC does where the standard leaves it open.
#[derive(Clone, Debug, clap::Args)]
pub struct Meaning {
    /// What a number is that does not fit its type: an error, or what remains modulo 2^width.
    #[arg(long, value_name = "HOW", value_enum, default_value_t = Overflow::Error)]
    pub overflow: Overflow,
    /// What a division by zero is: an error, or 0.
    #[arg(long, value_name = "HOW", value_enum, default_value_t = DivisionByZero::Error)]
    pub div0: DivisionByZero,
    /// The time from one scan to the next, as timers measure it.
    #[arg(long, value_name = "TIME", default_value = "20ms", value_parser = milliseconds)]
    pub scan_time: u32,
}

/// What a number is that does not fit its type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Overflow {
    /// An error, with a run that shows it.
    Error,
    /// The number modulo 2^width.
    Wrap,
}

/// What a division by zero is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum DivisionByZero {
    /// An error, with a run that shows it.
    Error,
    /// 0.
    Zero,
}

impl Meaning {
    /// The hazards that are no errors.
    pub fn tolerated(&self) -> Tolerated {
        Tolerated { overflow: self.overflow == Overflow::Wrap, division_by_zero: self.div0 == DivisionByZero::Zero }
    }
}

/// A time above 0 as `20ms` or `T#20ms`.
fn milliseconds(text: &str) -> Result<u32, String> {
    let literal = if text.contains('#') { text.to_owned() } else { format!("T#{text}") };
    let number = logic::number(&literal)?;
    u32::try_from(number).ok().filter(|&ms| ms > 0).ok_or_else(|| format!("`{text}` is no time above 0, like `20ms`"))
}

//! Options on the semantics of a program on its PLC.

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
    /// Which unit, and how it is read.
    #[command(flatten)]
    pub reading: Reading,
}

/// Which unit of a file is taken, and how it is read.
#[derive(Clone, Debug, clap::Args)]
pub struct Reading {
    /// The PROGRAM, FUNCTION_BLOCK or FUNCTION of the file to take, if not its one PROGRAM.
    #[arg(long, value_name = "NAME")]
    pub pou: Option<String>,
    /// The time from one scan to the next, as timers measure it; if not given, the interval of the program's task, or 20ms.
    #[arg(long, value_name = "TIME", value_parser = milliseconds)]
    pub scan_time: Option<u64>,
    /// Refuses what the letter of IEC 61131-3, edition 2, does not allow, like `//` comments. Without it, what real programs
    /// have is read.
    #[arg(long)]
    pub strict: bool,
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
    /// Hazards that are not errors.
    pub fn tolerated(&self) -> Tolerated {
        Tolerated { overflow: self.overflow == Overflow::Wrap, division_by_zero: self.div0 == DivisionByZero::Zero }
    }
}

/// Parses a time above 0, as `20ms` or `T#20ms`.
fn milliseconds(text: &str) -> Result<u64, String> {
    let literal = if text.contains('#') { text.to_owned() } else { format!("T#{text}") };
    let number = logic::number(&literal)?;
    u32::try_from(number)
        .ok()
        .filter(|&ms| ms > 0)
        .map(u64::from)
        .ok_or_else(|| format!("`{text}` is no time above 0, like `20ms`"))
}

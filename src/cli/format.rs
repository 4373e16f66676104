//! Output formats of nets, chosen by file extension.

use std::ffi::OsStr;
use std::path::Path;

use super::{Failure, shown};

/// Output format of a net.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Pnml,
    Tina,
    Lola,
    Andl,
    Ina,
    Dot,
    Svg,
}

/// Extensions of the formats, with the tools that the extension does not name.
const ENDINGS: [(&str, Format, &str); 7] = [
    ("pnml", Format::Pnml, ""),
    ("net", Format::Tina, " (TINA)"),
    ("lola", Format::Lola, ""),
    ("andl", Format::Andl, " (Snoopy, MARCIE, Charlie)"),
    ("pnt", Format::Ina, " (INA)"),
    ("dot", Format::Dot, ""),
    ("svg", Format::Svg, ""),
];

impl Format {
    /// Chooses the format of a file.
    pub fn of(path: &Path) -> Result<Self, Failure> {
        let ending = path.extension().and_then(OsStr::to_str).unwrap_or_default();
        let found = ENDINGS.iter().find(|(known, ..)| *known == ending);
        found.map(|&(_, format, _)| format).ok_or_else(|| {
            let known: Vec<String> = ENDINGS.iter().map(|(ending, _, tools)| format!(".{ending}{tools}")).collect();
            let (last, others) = known.split_last().map_or(("", &[][..]), |(last, others)| (last.as_str(), others));
            let known = format!("{} or {last}", others.join(", "));
            Failure::Message(format!("`{}` says no format: its name must end with {known}", shown(path)))
        })
    }
}

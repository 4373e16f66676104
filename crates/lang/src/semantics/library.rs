//! Standard function blocks (IEC 61131-3, 2.5.2.3), written in IL like everything else.

use std::sync::OnceLock;

use crate::syntax::ast::Unit;
use crate::syntax::parse;
use petril_base::source::Source;

const BISTABLES: &str = include_str!("library/bistables.il");
const EDGES: &str = include_str!("library/edges.il");
const COUNTERS: &str = include_str!("library/counters.il");
const TIMERS: &str = include_str!("library/timers.il");

/// Types that counters exist for, besides INT.
const COUNTED: [&str; 4] = ["DINT", "LINT", "UDINT", "ULINT"];

/// Text of the library.
#[must_use]
pub fn text() -> String {
    let typed = |ty: &str| {
        let greatest = crate::semantics::Type::named(ty).map_or(0, petril_base::Type::greatest);
        let least = crate::semantics::Type::named(ty).map_or(0, petril_base::Type::least);
        COUNTERS
            .replace(" INT", &format!(" {ty}"))
            .replace("32767", &greatest.to_string())
            .replace("-32768", &least.to_string())
            .lines()
            .map(|line| match line.strip_prefix("FUNCTION_BLOCK ") {
                Some(name) => format!("FUNCTION_BLOCK {name}_{ty}\n"),
                None => format!("{line}\n"),
            })
            .collect::<String>()
    };
    [BISTABLES, EDGES, COUNTERS, TIMERS].concat() + &COUNTED.map(typed).concat()
}

/// Function blocks of the library.
pub fn unit() -> &'static Unit {
    static UNIT: OnceLock<Unit> = OnceLock::new();
    UNIT.get_or_init(|| parse(&Source::new("library", text())).0)
}

/// Variable of a timer that counts milliseconds from scan to scan while [`RUNNING`] is TRUE and it is less than `PT`.
pub const CLOCK: &str = "CLOCK";
/// Variable of a timer that is TRUE while its clock runs.
pub const RUNNING: &str = "RUNNING";

#[cfg(test)]
mod tests {
    use super::text;
    use crate::semantics::check;
    use crate::syntax::parse;
    use petril_base::source::Source;

    #[test]
    fn the_library_is_right() {
        for (unit, name) in text().split_inclusive("END_FUNCTION_BLOCK").map(|unit| (unit, &unit[..unit.len().min(40)]))
        {
            if unit.trim().is_empty() {
                continue;
            }
            let (unit, errors) = parse(&Source::new("library", unit));
            let (program, more) = check(&unit, errors.is_empty());
            let more: Vec<_> = more.iter().filter(|d| !d.code.id().ends_with("221")).collect();
            assert!(program.is_some() && more.is_empty(), "{name} {errors:?} {more:?}");
        }
    }
}

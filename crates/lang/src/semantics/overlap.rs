//! Variables whose addresses overlap: they would change together, which is not modelled.
//!
//! The layout of addresses of different sizes is up to the controller (IEC 61131-3, 2.4.1.1). On most, `%QX1.3` is a
//! bit of the byte `%QB1`; a word `%QW1` begins there or, where numbers count words, two bytes from the beginning.

use std::collections::BTreeSet;

use super::address::{self, Area, Location};
use super::project::Project;
use super::shape::{PouId, Shape, elements};
use super::symbols::{Symbol, Symbols};
use petril_base::diagnostic::{Code, Diagnostic};

/// Memory at an address: an area, the leading numbers of a hierarchical address, and bits.
struct Place<'a> {
    symbol: &'a Symbol,
    location: &'a Location,
    memory: (Area, Vec<u64>),
    /// Number of bits by the size letter, if the variable has no more.
    plain: Option<u64>,
    /// Range of bits, the end exclusive, if numbers count bytes.
    by_bytes: (u64, u64),
    /// Range of bits, the end exclusive, if numbers count units of the size.
    by_size: (u64, u64),
}

/// Reports global variables, and variables of the needed units, whose memory overlaps.
pub fn check(project: &Project<'_>, needed: &[PouId], found: &mut Vec<Diagnostic>) {
    let symbols = needed.iter().map(|&id| project.symbols(id)).chain([&project.globals]);
    let mut places: Vec<Place<'_>> = symbols.flat_map(Symbols::list).filter_map(place).collect();
    places.sort_by_key(|place| place.location.span);
    let mut pairs: Vec<(usize, usize)> = overlaps(&places, |place| place.by_bytes);
    pairs.extend(overlaps(&places, |place| place.by_size));
    pairs.sort_unstable();
    pairs.dedup();
    let meet = |(a, b): (u64, u64), (c, d): (u64, u64)| a < d && c < b;
    let mut doubtful = BTreeSet::new();
    for (first, second) in pairs {
        let (first, second) = (&places[first], &places[second]);
        // Words are not meant to begin in the middle of one another: numbers 1, 2, 3 count words.
        let alike = first.plain.is_some() && first.plain == second.plain;
        let [by_bytes, by_size] = [meet(first.by_bytes, second.by_bytes), meet(first.by_size, second.by_size)];
        let (name, other) = (&second.symbol.name, &first.symbol.name);
        let report = |code, message: String, help: &str| {
            Diagnostic::new(code, second.location.span, message).also(first.symbol.span, "declared here").help(help)
        };
        if by_bytes && by_size {
            let same = address::spelling(&first.location.text) == address::spelling(&second.location.text);
            found.push(match same {
                true => report(
                    Code::AddressShared,
                    format!("`{name}` has the address of `{other}`"),
                    "use one variable; two names for one place are not modelled",
                ),
                false => report(
                    Code::AddressShared,
                    format!("`{name}` lies in the same place as `{other}`"),
                    "use one variable; if the controller keeps them apart, give one of them an address farther away",
                ),
            });
        } else if (by_size || !alike) && doubtful.insert(&first.memory) {
            let (one, another) = (&second.location.text, &first.location.text);
            found.push(report(
                Code::AddressesMayOverlap,
                format!("on some controllers, `{one}` lies in the same place as `{another}`"),
                "all addresses like these are taken for places of their own; if they are not, use one variable for each place",
            ));
        }
    }
}

/// Pairs of places that share a bit, the earlier in the text first.
fn overlaps(places: &[Place<'_>], bits: impl Fn(&Place<'_>) -> (u64, u64)) -> Vec<(usize, usize)> {
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by_key(|&i| (&places[i].memory, bits(&places[i])));
    let mut pairs = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    for next in order {
        let is_open =
            |&i: &usize| places[i].memory == places[next].memory && bits(&places[i]).1 > bits(&places[next]).0;
        open.retain(is_open);
        // Of many variables that share one place, each is paired with few others.
        pairs.extend(open.iter().take(8).map(|&i| (i.min(next), i.max(next))));
        open.push(next);
    }
    pairs
}

fn place(symbol: &Symbol) -> Option<Place<'_>> {
    let location = symbol.location.as_ref()?;
    let (area, size) = address::read(&location.text)?;
    let numbers = location.text.trim_start_matches(|c: char| !c.is_ascii_digit()).split('.');
    let mut numbers: Vec<u64> = numbers.map(|number| number.parse().unwrap_or(u64::MAX)).collect();
    let unit = size.map_or(1, |ty| u64::from(ty.width));
    let bits = symbol.shape.as_ref().map_or(unit, bits).max(unit);
    let last = numbers.pop()?;
    let (by_bytes, by_size) = match unit {
        1 => {
            let byte = numbers.pop().unwrap_or(0);
            let bit = byte.saturating_mul(8).saturating_add(last);
            (bit, bit)
        }
        _ => (last.saturating_mul(8), last.saturating_mul(unit)),
    };
    let to = |from: u64| (from, from.saturating_add(bits));
    let plain = (bits == unit).then_some(unit);
    Some(Place { symbol, location, memory: (area, numbers), plain, by_bytes: to(by_bytes), by_size: to(by_size) })
}

/// Number of bits of a variable.
fn bits(shape: &Shape) -> u64 {
    match shape {
        Shape::Scalar(scalar) => u64::from(scalar.ty.width),
        Shape::Array { ranges, of } => (elements(ranges) as u64).saturating_mul(bits(of)),
        Shape::Structure(structure) => {
            structure.members.iter().fold(0, |sum: u64, member| sum.saturating_add(bits(&member.shape)))
        }
        Shape::Instance(_) => 0,
    }
}

#[cfg(test)]
mod tests {
    use crate::semantics::testing::findings;
    use petril_base::diagnostic::Code::{self, AddressShared, AddressesMayOverlap};

    fn found(declarations: &str) -> Vec<(Code, usize)> {
        let text =
            format!("PROGRAM p VAR_OUTPUT q : BOOL; END_VAR VAR\n{declarations}\nEND_VAR\nLD TRUE\nST q\nEND_PROGRAM");
        let found = findings(&text).into_iter();
        found.filter(|(code, _)| matches!(code, AddressShared | AddressesMayOverlap)).collect()
    }

    #[test]
    fn one_place_has_one_name() {
        assert_eq!(found("a AT %MX0.0 : BOOL;\nb AT %MX0.1 : BOOL;\nc AT %M0.0 : BOOL;"), [(AddressShared, 4)]);
        assert_eq!(found("a AT %MW0 : WORD;\nb AT %MX1.7 : BOOL;\nc AT %QX1.7 : BOOL;"), [(AddressShared, 3)]);
        assert_eq!(found("a AT %MX0.0 : ARRAY [0..9] OF BOOL;\nb AT %MX1.1 : BOOL;"), [(AddressShared, 3)]);
        assert_eq!(found("a AT %MX1.0.0 : BOOL;\nb AT %MX2.0.0 : BOOL;\nc AT %MX02.0.0 : BOOL;"), [(AddressShared, 4)]);
    }

    /// `%MW1` begins at byte 1 or 2, `%MW2` at 2 or 4, `%MD1` at 1 or 4.
    #[test]
    fn what_depends_on_the_controller_is_a_warning() {
        assert_eq!(
            found("a AT %MW1 : WORD;\nb AT %MX1.0 : BOOL;\nc AT %MX2.0 : BOOL;"),
            [(AddressesMayOverlap, 3), (AddressShared, 4)]
        );
        assert_eq!(found("a AT %MW1 : WORD;\nb AT %MW2 : WORD;"), []);
        assert_eq!(found("a AT %MW2 : WORD;\nb AT %MW4 : WORD;\nc AT %MD0 : DWORD;"), [(AddressesMayOverlap, 4)]);
    }

    #[test]
    fn global_variables_and_those_of_the_program_share_a_memory() {
        let text = "VAR_GLOBAL g AT %MX0.0 : BOOL; END_VAR\nPROGRAM p VAR a AT %MX0.0 : BOOL; END_VAR\n\
                    LD g\nST a\nEND_PROGRAM";
        assert_eq!(findings(text), [(AddressShared, 2)]);
        let text = "FUNCTION_BLOCK f VAR_OUTPUT o : BOOL; END_VAR\nLD %MX0.0\nST o\nEND_FUNCTION_BLOCK\n\
                    PROGRAM p VAR a AT %MX0.0 : BOOL; k : f; END_VAR\nLD k.o\nST a\nCAL k\nEND_PROGRAM";
        assert_eq!(findings(text), [(AddressShared, 5)]);
    }
}

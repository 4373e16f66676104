//! Steps that lead nowhere, in the terms of programs and their nets.

use petril_base::PlaceId;
use petril_lang::flat::Hazard;
use petril_lang::interpret::Fault;
use petril_net::SECOND_TOKEN;
use petril_search::DeadEnd;

/// Why a step leads to no state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Failure {
    /// A scan does not end.
    Scan(Fault),
    /// A scan meets a hazard that is an error, in this line (from 0).
    Hazard(usize, Hazard),
    /// A firing puts a second token on a place.
    NotSafe(PlaceId),
}

const ENDLESS: &str = "endless";
const TOO_LONG: &str = "too long";

impl Failure {
    /// The failure that a dead end of one of the two views stands for.
    #[must_use]
    pub fn of(dead_end: DeadEnd) -> Option<Self> {
        let hazard = |hazard: &Hazard| hazard.name() == dead_end.kind;
        Some(match dead_end.kind {
            ENDLESS => Self::Scan(Fault::Endless),
            TOO_LONG => Self::Scan(Fault::TooLong),
            SECOND_TOKEN => Self::NotSafe(PlaceId::at(dead_end.at)),
            _ => Self::Hazard(dead_end.at, Hazard::ALL.into_iter().find(hazard)?),
        })
    }
}

impl From<Failure> for DeadEnd {
    fn from(failure: Failure) -> Self {
        match failure {
            Failure::Scan(Fault::Endless) => Self { kind: ENDLESS, at: 0 },
            Failure::Scan(Fault::TooLong) => Self { kind: TOO_LONG, at: 0 },
            Failure::Hazard(line, hazard) => Self { kind: hazard.name(), at: line },
            Failure::NotSafe(place) => Self { kind: SECOND_TOKEN, at: place.index() },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_survives_its_dead_end() {
        let hazards = Hazard::ALL.map(|hazard| Failure::Hazard(7, hazard));
        let faults = [Fault::Endless, Fault::TooLong].map(Failure::Scan);
        for failure in hazards.into_iter().chain(faults).chain([Failure::NotSafe(PlaceId::at(3))]) {
            assert_eq!(Failure::of(failure.into()), Some(failure));
        }
        assert_eq!(Failure::of(DeadEnd { kind: "of another space", at: 0 }), None);
    }
}

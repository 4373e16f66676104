//! What a replayed run says of the past, by the definitions: every question goes back through the scans again.

use crate::logic::{Bound, Past, Valuation};
use crate::net::{Marking, PlaceId};
use petril_lang::semantics::VarId;

/// The values of the variables at power-on and at the ends of the scans so far, as the net had them.
#[derive(Clone, Debug)]
pub struct Recalled {
    power_on: Vec<u64>,
    ends: Vec<Vec<u64>>,
    /// The marking of the net at the end of the last scan, if it is known.
    marking: Option<Marking>,
}

impl Recalled {
    /// No scan yet.
    #[must_use]
    pub fn new(power_on: Vec<u64>) -> Self {
        Self { power_on, ends: Vec::new(), marking: None }
    }

    /// A scan has ended with these values.
    pub fn push(&mut self, memory: Vec<u64>) {
        self.ends.push(memory);
        self.marking = None;
    }

    /// The net has this marking at the end of the last scan.
    pub fn mark(&mut self, marking: Marking) {
        self.marking = Some(marking);
    }

    /// Whether a formula about this scan and those before it holds at the end of the last scan; `None` for a temporal formula.
    #[must_use]
    pub fn holds(&self, formula: &Bound) -> Option<bool> {
        formula.holds_in(&self.at(self.ends.len().checked_sub(1)))
    }

    /// The value of a variable at the end of the last scan; at power-on if there was none.
    #[must_use]
    pub fn value(&self, variable: VarId) -> u64 {
        self.at(self.ends.len().checked_sub(1)).value(variable)
    }

    /// The value of a term about the past at the end of the last scan.
    #[must_use]
    pub fn past(&self, past: &Past) -> i128 {
        self.at(self.ends.len().checked_sub(1)).past(past)
    }

    /// The end of a scan, from 0; `None` is power-on.
    fn at(&self, scan: Option<usize>) -> At<'_> {
        At { recalled: self, scan }
    }
}

/// A moment of a run.
struct At<'r> {
    recalled: &'r Recalled,
    scan: Option<usize>,
}

impl At<'_> {
    fn holds(&self, formula: &Bound) -> bool {
        formula.holds_in(self).unwrap_or(false)
    }
}

impl Valuation for At<'_> {
    fn value(&self, variable: VarId) -> u64 {
        let memory = self.scan.map_or(&self.recalled.power_on, |scan| &self.recalled.ends[scan]);
        memory[variable.0]
    }

    fn past(&self, past: &Past) -> i128 {
        let at = |scan: usize| self.recalled.at(Some(scan));
        match past {
            Past::First => i128::from(self.scan == Some(0)),
            Past::Before(term) => {
                // Before power-on, everything was as it is then.
                let before = self.recalled.at(self.scan.and_then(|scan| scan.checked_sub(1)));
                term.value_in(&before).unwrap_or_default()
            }
            Past::Since(f, g) => {
                let Some(now) = self.scan else { return 0 };
                // The last scan with g, or without f in the scan itself, decides.
                let decisive = (0..=now).rev().find(|&then| at(then).holds(g) || !at(then).holds(f));
                i128::from(decisive.is_some_and(|then| at(then).holds(g)))
            }
            Past::Run { of, most } => {
                let Some(now) = self.scan else { return 0 };
                let most_scans = usize::try_from(*most).unwrap_or(usize::MAX);
                let run = (0..=now).rev().take(most_scans).take_while(|&scan| at(scan).holds(of)).count();
                (run as i128).min(i128::from(*most))
            }
        }
    }

    fn is_marked(&self, place: PlaceId) -> bool {
        let is_last = self.scan.is_some_and(|scan| scan + 1 == self.recalled.ends.len());
        is_last && self.recalled.marking.as_ref().is_some_and(|marking| marking.is_marked(place))
    }
}

//! Past-time formulas on a replayed run, evaluated by their definitions: each evaluation goes back through the scans.

use petril_lang::semantics::VarId;
use petril_logic::{Bound, Past, Valuation};
use petril_net::net::{Marking, PlaceId};

/// Values of the variables at power-on and at the ends of the scans so far, as read from the net.
#[derive(Clone, Debug)]
pub struct Recalled {
    power_on: Vec<u64>,
    ends: Vec<Vec<u64>>,
    /// Marking of the net at the end of the last scan, if known.
    marking: Option<Marking>,
}

impl Recalled {
    /// Starts at power-on, without scans.
    #[must_use]
    pub fn new(power_on: Vec<u64>) -> Self {
        Self { power_on, ends: Vec::new(), marking: None }
    }

    /// Appends the values at the end of a scan.
    pub fn push(&mut self, memory: Vec<u64>) {
        self.ends.push(memory);
        self.marking = None;
    }

    /// Sets the marking of the net at the end of the last scan.
    pub fn mark(&mut self, marking: Marking) {
        self.marking = Some(marking);
    }

    /// Whether a formula about this scan and earlier ones holds at the end of the last scan; `None` for a temporal
    /// formula.
    #[must_use]
    pub fn holds(&self, formula: &Bound) -> Option<bool> {
        formula.holds_in(&self.at(self.ends.len().checked_sub(1)))
    }

    /// Value of a variable at the end of the last scan, or at power-on if there was none.
    #[must_use]
    pub fn value(&self, variable: VarId) -> u64 {
        self.at(self.ends.len().checked_sub(1)).value(variable)
    }

    /// Value of a past-time term at the end of the last scan.
    #[must_use]
    pub fn past(&self, past: &Past) -> i128 {
        self.at(self.ends.len().checked_sub(1)).past(past)
    }

    /// Valuation at the end of a scan, from 0; `None` is power-on.
    fn at(&self, scan: Option<usize>) -> At<'_> {
        At { recalled: self, scan }
    }
}

/// Position in a run, as a valuation.
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
                // Power-on is its own predecessor.
                let before = self.recalled.at(self.scan.and_then(|scan| scan.checked_sub(1)));
                term.value_in(&before).unwrap_or_default()
            }
            Past::Since(f, g) => {
                let Some(now) = self.scan else { return 0 };
                // The last scan that satisfies g, or violates f, decides.
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

//! Linear terms over token counts.

use petril_logic::Term;

/// Linear sum: token counts times factors, plus a number. Places ascend, and no factor is 0.
pub(super) struct Linear {
    pub(super) terms: Vec<(u32, i64)>,
    pub(super) number: i128,
}

impl Linear {
    /// Difference of two terms; `None` if not linear, or if a number overflows.
    pub(super) fn difference(a: &Term, b: &Term) -> Option<Self> {
        let mut sum = Self { terms: Vec::new(), number: 0 };
        sum.add(a, 1)?;
        sum.add(b, -1)?;
        sum.terms.sort_unstable_by_key(|&(place, _)| place);
        let mut merged: Vec<(u32, i64)> = Vec::with_capacity(sum.terms.len());
        for (place, factor) in sum.terms {
            match merged.last_mut() {
                Some((last, sum)) if *last == place => *sum = sum.checked_add(factor)?,
                _ => merged.push((place, factor)),
            }
        }
        merged.retain(|&(_, factor)| factor != 0);
        Some(Self { terms: merged, number: sum.number })
    }

    fn add(&mut self, term: &Term, factor: i64) -> Option<()> {
        match term {
            Term::Number(number) => {
                self.number = self.number.checked_add(number.checked_mul(factor.into())?)?;
            }
            Term::Tokens(place) => self.terms.push((place.index() as u32, factor)),
            Term::Sum(a, b) => {
                self.add(a, factor)?;
                self.add(b, factor)?;
            }
            Term::Difference(a, b) => {
                self.add(a, factor)?;
                self.add(b, factor.checked_neg()?)?;
            }
            Term::Product(a, b) => {
                let (constant, other) = constant(a).map(|a| (a, b)).or_else(|| Some((constant(b)?, a)))?;
                self.add(other, factor.checked_mul(i64::try_from(constant).ok()?)?)?;
            }
            Term::Variable(..) | Term::Bits { .. } | Term::Truth(_) | Term::Past(_) => return None,
        }
        Some(())
    }
}

/// Value of a constant term; `None` if it mentions a place.
fn constant(term: &Term) -> Option<i128> {
    let mut sum = Linear { terms: Vec::new(), number: 0 };
    sum.add(term, 1)?;
    sum.terms.is_empty().then_some(sum.number)
}

//! Domains: the values a free input can have.

use std::collections::BTreeMap;

use petril_lang::semantics::{Type, VarId};

/// Set of values of a type, as patterns in ascending order of their numbers. Never empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Domain {
    /// Type of the values.
    pub ty: Type,
    /// Disjoint ranges of numbers, ascending, both ends included, with a gap between neighbours.
    ranges: Vec<(i128, i128)>,
    /// Whether the values represent all values of the type: the program cannot distinguish any other value from all of
    /// them.
    for_all: bool,
}

/// Domains of free inputs. An input that is not listed has every value of its type.
pub type Domains = BTreeMap<VarId, Domain>;

impl Domain {
    /// Domain of every value of a type.
    #[must_use]
    pub fn all(ty: Type) -> Self {
        Self { ty, ranges: vec![(ty.least(), ty.greatest())], for_all: false }
    }

    /// Domain of the numbers in any of these ranges (both ends included). `None` if there are none, or one is outside
    /// the type.
    #[must_use]
    pub fn new(ty: Type, mut ranges: Vec<(i128, i128)>) -> Option<Self> {
        ranges.sort_unstable();
        let mut joined: Vec<(i128, i128)> = Vec::with_capacity(ranges.len());
        for (from, to) in ranges {
            if from > to || !ty.holds(from) || !ty.holds(to) {
                return None;
            }
            match joined.last_mut() {
                Some(last) if from <= last.1 + 1 => last.1 = last.1.max(to),
                _ => joined.push((from, to)),
            }
        }
        (!joined.is_empty()).then_some(Self { ty, ranges: joined, for_all: false })
    }

    /// Marks the values as representatives of all values of the type.
    #[must_use]
    pub fn standing_for_all(self) -> Self {
        Self { for_all: true, ..self }
    }

    /// Whether the values represent all values of the type: the program cannot distinguish any other value from all of
    /// them.
    #[must_use]
    pub fn stands_for_all(&self) -> bool {
        self.for_all
    }

    /// Ranges of numbers, ascending, both ends included.
    #[must_use]
    pub fn ranges(&self) -> &[(i128, i128)] {
        &self.ranges
    }

    /// Number of values.
    #[must_use]
    pub fn size(&self) -> u128 {
        self.ranges.iter().map(|(from, to)| (to - from + 1) as u128).sum()
    }

    /// Whether a number is in the domain.
    #[must_use]
    pub fn contains(&self, number: i128) -> bool {
        self.ranges.iter().any(|&(from, to)| (from..=to).contains(&number))
    }

    /// Iterator over the values as patterns.
    pub fn patterns(&self) -> impl Iterator<Item = u64> + Clone {
        let ty = self.ty;
        self.ranges.iter().flat_map(move |&(from, to)| (from..=to).map(move |number| ty.pattern(number)))
    }
}

#[cfg(test)]
mod tests {
    use super::Domain;
    use petril_lang::semantics::Type;

    #[test]
    fn ranges_are_joined_and_must_fit() {
        let sint = Type::named("SINT").unwrap_or(Type::BOOL);
        let domain = Domain::new(sint, vec![(3, 5), (-1, 0), (4, 7), (8, 8)]).unwrap_or(Domain::all(sint));
        assert_eq!(domain.ranges(), [(-1, 0), (3, 8)]);
        assert_eq!(domain.size(), 8);
        assert_eq!(domain.patterns().collect::<Vec<_>>(), [0xFF, 0, 3, 4, 5, 6, 7, 8]);
        assert_eq!(Domain::new(sint, vec![(0, 128)]), None);
        assert_eq!(Domain::new(sint, vec![]), None);
        assert_eq!(Domain::all(sint).size(), 256);
    }
}

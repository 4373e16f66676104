//! Simplification of formulas by equivalences that hold in every graph.
//!
//! Paths end only in states without steps, and every state has a fair path; under fairness this is a precondition. Then
//! `EG TRUE` holds, f implies `EF f`, and `AG f` implies `EG f`.

use super::bound::{Bound, Term};
use super::formula::{Comparison, Quantifier};
use super::ltl::Path;

impl Bound {
    /// Returns an equivalent simpler formula: it holds in the same states of every graph.
    #[must_use]
    pub fn simplified(self) -> Self {
        match self {
            Self::Truth(_)
            | Self::Variable(_)
            | Self::Bit(..)
            | Self::Marked(_)
            | Self::Enabled(_)
            | Self::Deadlock => self,
            Self::Compare(comparison, left, right) => compare(comparison, left.simplified(), right.simplified()),
            Self::Not(f) => not(f.simplified()),
            Self::And(f, g) => match (f.simplified(), g.simplified()) {
                (Self::Truth(false), _) | (_, Self::Truth(false)) => Self::Truth(false),
                (Self::Truth(true), f) | (f, Self::Truth(true)) => f,
                (f, g) if f == g => f,
                (f, g) => Self::And(Box::new(f), Box::new(g)),
            },
            Self::Or(f, g) => match (f.simplified(), g.simplified()) {
                (Self::Truth(true), _) | (_, Self::Truth(true)) => Self::Truth(true),
                (Self::Truth(false), f) | (f, Self::Truth(false)) => f,
                (f, g) if f == g => f,
                (f, g) => Self::Or(Box::new(f), Box::new(g)),
            },
            Self::Implies(f, g) => match (f.simplified(), g.simplified()) {
                (Self::Truth(false), _) | (_, Self::Truth(true)) => Self::Truth(true),
                (Self::Truth(true), g) => g,
                (f, Self::Truth(false)) => not(f),
                (f, g) if f == g => Self::Truth(true),
                (f, g) => Self::Implies(Box::new(f), Box::new(g)),
            },
            Self::Iff(f, g) => match (f.simplified(), g.simplified()) {
                (Self::Truth(true), f) | (f, Self::Truth(true)) => f,
                (Self::Truth(false), f) | (f, Self::Truth(false)) => not(f),
                (f, g) if f == g => Self::Truth(true),
                (f, g) => Self::Iff(Box::new(f), Box::new(g)),
            },
            Self::Next(quantifier, f) => match (quantifier, f.simplified()) {
                (Quantifier::All, Self::Truth(true)) => Self::Truth(true),
                (Quantifier::Some, Self::Truth(false)) => Self::Truth(false),
                // The formula does not determine whether there is a next state.
                (quantifier, f) => Self::Next(quantifier, Box::new(f)),
            },
            Self::Until { quantifier, weak, hold, release } => {
                until(quantifier, weak, hold.simplified(), release.simplified())
            }
            Self::Ltl(path) => on_paths(&path),
        }
    }
}

/// Simplifies the atoms of an LTL formula.
fn on_paths(path: &Path<Bound>) -> Bound {
    Bound::Ltl(Box::new(path.map(&mut |f| f.clone().simplified())))
}

fn not(f: Bound) -> Bound {
    match f {
        Bound::Truth(value) => Bound::Truth(!value),
        Bound::Not(f) => *f,
        f => Bound::Not(Box::new(f)),
    }
}

fn until(quantifier: Quantifier, weak: bool, hold: Bound, release: Bound) -> Bound {
    use Quantifier::{All, Some};
    match (weak, hold, release) {
        (_, _, Bound::Truth(true)) | (true, Bound::Truth(true), _) => Bound::Truth(true),
        (false, _, Bound::Truth(false)) => Bound::Truth(false),
        (_, Bound::Truth(false), g) => g,
        (_, f, g) if f == g => f,
        // EF E[f U g] = EF A[f U g] = EF g, AF A[f U g] = AF g, AF EF g = EF g
        (false, Bound::Truth(true), Bound::Until { quantifier: inner, weak: false, hold, release })
            if quantifier == Some || inner == All || *hold == Bound::Truth(true) =>
        {
            let quantifier = if quantifier == All && inner == All { All } else { Some };
            until(quantifier, false, Bound::Truth(true), *release)
        }
        // AG AG f = AG EG f = EG AG f = AG f, EG EG f = EG f
        (true, Bound::Until { quantifier: inner, weak: true, hold, release }, Bound::Truth(false))
            if *release == Bound::Truth(false) =>
        {
            let quantifier = if quantifier == Some && inner == Some { Some } else { All };
            until(quantifier, true, *hold, *release)
        }
        (weak, hold, release) => Bound::Until { quantifier, weak, hold: Box::new(hold), release: Box::new(release) },
    }
}

/// Makes a comparison, or a constant if the ranges of its sides decide it.
fn compare(comparison: Comparison, left: Term, right: Term) -> Bound {
    let difference = if left == right { Some((0, 0)) } else { left.less(&right) };
    let decided = difference.and_then(|(least, greatest)| {
        // The difference below 0, at 0 and above 0, as far as its range goes.
        let [least, middle, greatest] = [least, 0.clamp(least, greatest), greatest].map(|d| comparison.holds(d, 0));
        (least == middle && middle == greatest).then_some(middle)
    });
    decided.map_or(Bound::Compare(comparison, left, right), Bound::Truth)
}

impl Term {
    fn simplified(self) -> Self {
        let two = |a: Box<Self>, b: Box<Self>| (Box::new(a.simplified()), Box::new(b.simplified()));
        let term = match self {
            Self::Number(_) | Self::Variable(..) | Self::Bits { .. } | Self::Tokens(_) | Self::Past(_) => self,
            Self::Truth(f) => Self::Truth(Box::new(f.simplified())),
            Self::Sum(a, b) => {
                let (a, b) = two(a, b);
                Self::Sum(a, b)
            }
            Self::Difference(a, b) => {
                let (a, b) = two(a, b);
                Self::Difference(a, b)
            }
            Self::Product(a, b) => {
                let (a, b) = two(a, b);
                Self::Product(a, b)
            }
        };
        match term.range() {
            Some((least, greatest)) if least == greatest => Self::Number(least),
            _ => term,
        }
    }

    /// Range of the difference between this term and another.
    fn less(&self, other: &Self) -> Option<(i128, i128)> {
        let ((a, b), (c, d)) = (self.range()?, other.range()?);
        Some((a.checked_sub(d)?, b.checked_sub(c)?))
    }

    /// Range of the term over all states; `None` if the numbers are too large.
    fn range(&self) -> Option<(i128, i128)> {
        Some(match self {
            Self::Number(number) => (*number, *number),
            Self::Variable(_, ty) => (ty.least(), ty.greatest()),
            Self::Bits { places, .. } => {
                let weights = || places.iter().map(|&(_, weight)| weight);
                (weights().filter(|&weight| weight < 0).sum(), weights().filter(|&weight| weight > 0).sum())
            }
            Self::Tokens(_) => (0, u64::MAX.into()),
            Self::Past(past) => {
                let magnitude = i128::try_from(past.magnitude()).ok()?;
                (-magnitude, magnitude)
            }
            Self::Truth(f) => match **f {
                Bound::Truth(value) => (value.into(), value.into()),
                _ => (0, 1),
            },
            Self::Sum(a, b) => {
                let ((a, b), (c, d)) = (a.range()?, b.range()?);
                (a.checked_add(c)?, b.checked_add(d)?)
            }
            Self::Difference(a, b) => a.less(b)?,
            Self::Product(a, b) => {
                let ((a, b), (c, d)) = (a.range()?, b.range()?);
                let products = [a.checked_mul(c)?, a.checked_mul(d)?, b.checked_mul(c)?, b.checked_mul(d)?];
                products.into_iter().fold((products[0], products[0]), |(x, y), p| (x.min(p), y.max(p)))
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::{Names, Nodes, bind_in_net, parse_formula};
    use petril_base::source::Source;
    use petril_base::{PlaceId, TransitionId, VarId};

    /// A net with the places `p` and `q`.
    struct Net;

    impl Net {
        fn name(place: PlaceId) -> &'static str {
            ["p", "q"][place.index()]
        }
    }

    impl Names for Net {
        fn variable(&self, variable: VarId) -> String {
            format!("variable {}", variable.0)
        }

        fn literal(&self, _: VarId, _: i128) -> Option<String> {
            None
        }

        fn marked(&self, place: PlaceId) -> String {
            format!("marked(\"{}\")", Self::name(place))
        }

        fn tokens(&self, place: PlaceId) -> String {
            format!("tokens(\"{}\")", Self::name(place))
        }

        fn enabled(&self, transition: TransitionId) -> String {
            format!("enabled(\"t{}\")", transition.index())
        }
    }

    /// Simplified form of a formula about a net with the places `p` and `q`, where `P` stands for
    /// `marked("p")`, `#p` for `tokens("p")` and `D` for `at deadlock`.
    fn simplified(text: &str) -> String {
        let places = [0, 1].map(|index| (Net::name(PlaceId::at(index)), PlaceId::at(index)));
        let letters = [
            ("#p", "tokens(\"p\")"),
            ("#q", "tokens(\"q\")"),
            ("P", "marked(\"p\")"),
            ("Q", "marked(\"q\")"),
            ("D", "at deadlock"),
        ];
        let long = letters.iter().fold(text.to_owned(), |text, (short, long)| text.replace(short, long));
        let requirement = parse_formula(&Source::new("formula", long)).unwrap();
        let bound = bind_in_net(&requirement, &Nodes::by_name(places, [])).unwrap();
        let text = bound.simplified().text(&Net);
        letters.iter().fold(text, |text, (short, long)| text.replace(long, short))
    }

    #[test]
    fn what_decides_itself_goes() {
        let cases = [
            ("!!P", "P"),
            ("!!!P", "!P"),
            ("P & true", "P"),
            ("false & P", "FALSE"),
            ("P | !false", "TRUE"),
            ("P | false", "P"),
            ("P -> false", "!P"),
            ("!P -> false", "P"),
            ("false -> P", "TRUE"),
            ("true -> P", "P"),
            ("P <-> false", "!P"),
            ("true <-> P", "P"),
            ("P & P | P", "P"),
            ("P -> P", "TRUE"),
            ("EF P <-> EF P", "TRUE"),
            ("P & Q | D", "P & Q | D"),
            ("P -> Q", "P -> Q"),
            ("P <-> Q", "P <-> Q"),
        ];
        for (text, expected) in cases {
            assert_eq!(simplified(text), expected, "{text}");
        }
    }

    #[test]
    fn comparisons_are_decided_by_what_numbers_can_be() {
        let cases = [
            ("1 + 1 = 2", "TRUE"),
            ("2 * 3 - 7 >= 0", "FALSE"),
            ("0 <= #p", "TRUE"),
            ("#p < 0", "FALSE"),
            ("#p = -1", "FALSE"),
            ("#p + #q != -1", "TRUE"),
            ("#p <= 0", "#p <= 0"),
            ("#p > 0", "#p > 0"),
            ("#p = 0", "#p = 0"),
            ("#p < #q", "#p < #q"),
            ("#p < #p", "FALSE"),
            ("#p + #q <= #p + #q", "TRUE"),
            ("P + Q <= 2", "TRUE"),
            ("P + Q <= 1", "P + Q <= 1"),
            ("P - Q < 2", "TRUE"),
            ("(P - Q) * -3 >= -3", "TRUE"),
            ("(P - Q) * -3 > -3", "(P - Q) * -3 > -3"),
            ("(P & false) + 3 < 4", "TRUE"),
            ("(P & false) + #p < 1 + 1", "0 + #p < 2"),
            ("#p * (1 - 1) = 0", "TRUE"),
        ];
        for (text, expected) in cases {
            assert_eq!(simplified(text), expected, "{text}");
        }
    }

    #[test]
    fn temporal_operators_are_decided_by_their_operands() {
        let cases = [
            ("AG true", "TRUE"),
            ("EG true", "TRUE"),
            ("AF false", "FALSE"),
            ("EG false", "FALSE"),
            ("AX true", "TRUE"),
            ("EX false", "FALSE"),
            // These differ in a state without steps.
            ("EX true", "EX TRUE"),
            ("AX false", "AX FALSE"),
            ("A [P U true]", "TRUE"),
            ("E [P U P]", "P"),
            ("A [false U P]", "P"),
            ("E [false W P]", "P"),
            ("A [true W P]", "TRUE"),
            ("A [P U false]", "FALSE"),
            ("AG AG P", "AG P"),
            ("AG EG P", "AG P"),
            ("EG AG P", "AG P"),
            ("EG EG EG P", "EG P"),
            ("EF EF P", "EF P"),
            ("EF AF P", "EF P"),
            ("AF EF P", "EF P"),
            ("AF AF P", "AF P"),
            ("EF E [Q U P]", "EF P"),
            ("EF A [Q U EF P]", "EF P"),
            ("AF A [Q U P]", "AF P"),
            ("AF E [Q U P]", "AF E [Q U P]"),
            ("AG EF P", "AG EF P"),
            ("EF AG P", "EF AG P"),
            ("AF AG P", "AF AG P"),
            ("AG A [P W Q]", "AG A [P W Q]"),
            ("EF E [P W Q]", "EF E [P W Q]"),
            ("AG (EF (#p >= 0) | Q)", "TRUE"),
        ];
        for (text, expected) in cases {
            assert_eq!(simplified(text), expected, "{text}");
        }
    }
}

//! Rounding of floating-point vectors to integer vectors in the same proportions, if these are simple.

/// Largest denominator of a single number.
const DENOMINATOR: i128 = 10_000;

/// Largest common denominator of all numbers.
const COMMON: i128 = 1 << 50;

/// Maximum relative difference between a number and its rounding.
const ERROR: f64 = 1e-6;

/// Integer vectors nearly proportional to a vector, the likeliest first. Each divides the numbers by a unit that occurs
/// among them; the caller must verify which of them will do.
pub fn proportions(numbers: &[f64]) -> impl Iterator<Item = Vec<i128>> + '_ {
    let most = numbers.iter().fold(0.0_f64, |most, &number| most.max(number.abs()));
    let large = move |number: &f64| number.abs() > most * 1e-9;
    let least = numbers.iter().copied().filter(large).fold(most, |least, number| least.min(number.abs()));
    let first = numbers.iter().copied().find(large).map_or(most, f64::abs);
    [1.0, least, most, first].into_iter().filter(|unit| *unit > 0.0 && unit.is_finite()).filter_map(move |unit| {
        let scaled: Vec<f64> = numbers.iter().map(|number| if large(number) { number / unit } else { 0.0 }).collect();
        whole(&scaled).map(|(numbers, _)| numbers)
    })
}

/// Returns the numbers times their common denominator, and that denominator.
pub fn whole(numbers: &[f64]) -> Option<(Vec<i128>, i128)> {
    let mut common: i128 = 1;
    for number in numbers {
        common = common.checked_mul(denominator(number * common as f64)?).filter(|&common| common <= COMMON)?;
    }
    let round = |number: &f64| {
        let scaled = (number * common as f64).round();
        (scaled.abs() < 1e30).then_some(scaled as i128)
    };
    Some((numbers.iter().map(round).collect::<Option<_>>()?, common))
}

/// Finds the smallest denominator of a fraction near a number, by its continued fraction.
fn denominator(number: f64) -> Option<i128> {
    let error = ERROR * number.abs().clamp(1.0, 1e3);
    let (mut before, mut denominator) = (0_i128, 1_i128);
    let mut rest = number;
    while ((number * denominator as f64).round() / denominator as f64 - number).abs() > error / denominator as f64 {
        rest = 1.0 / (rest - rest.floor());
        if !rest.is_finite() || rest > 1e9 {
            return None;
        }
        (before, denominator) = (denominator, rest.floor() as i128 * denominator + before);
        if denominator > DENOMINATOR {
            return None;
        }
    }
    Some(denominator)
}

#[cfg(test)]
mod tests {
    use super::{proportions, whole};

    #[test]
    fn simple_fractions_are_found() {
        assert_eq!(whole(&[0.5, 1.0 / 3.0 + 1e-12, 0.0, 2.0]), Some((vec![3, 2, 0, 12], 6)));
        assert_eq!(whole(&[std::f64::consts::PI]), None);
        assert_eq!(proportions(&[0.3 * 0.7, 0.6 * 0.7]).nth(1), Some(vec![1, 2]));
    }
}

//! Transposition of 64 × 64 bits, between lanes (words of bits) and planes (one bit of 64 lanes).

/// Transposes a 64 × 64 bit matrix (Warren, Hacker's Delight, section 7-3).
pub(super) fn transpose(words: &mut [u64; 64]) {
    let mut distance = 32;
    let mut mask = 0xFFFF_FFFF_u64;
    while distance > 0 {
        let mut at = 0;
        while at < 64 {
            let swapped = (words[at] >> distance ^ words[at + distance]) & mask;
            words[at] ^= swapped << distance;
            words[at + distance] ^= swapped;
            at = (at + distance + 1) & !distance;
        }
        distance /= 2;
        mask ^= mask << distance;
    }
}

#[cfg(test)]
mod tests {
    use super::transpose;

    #[test]
    fn rows_become_columns() {
        let words: [u64; 64] = std::array::from_fn(|i| (i as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
        let mut turned = words;
        transpose(&mut turned);
        for (i, row) in turned.iter().enumerate() {
            for (j, word) in words.iter().enumerate() {
                assert_eq!(row >> j & 1, word >> i & 1, "{i} {j}");
            }
        }
    }
}

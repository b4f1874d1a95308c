//! Reciprocal square roots.

use super::high;

/// First approximations of `2^23 / sqrt(m)` for `m` in `[2^30, 2^32)`, by the seven highest bits, from 32 on:
/// `round(2^11 / sqrt(2 i + 65))`, which is off by at most 1 part in 2^6.
const SEED: [u8; 96] = seed();

#[expect(clippy::indexing_slicing, reason = "i is below the length; evaluated at compile time")]
const fn seed() -> [u8; 96] {
    let mut table = [0; 96];
    let mut i = 0;
    while i < 96 {
        // 2^11 / sqrt(2 i + 65), of which half a unit less is not above.
        let mut root = 0;
        while (2 * root as u64 + 1) * (2 * root as u64 + 1) * (2 * i as u64 + 65) <= 1 << 24 {
            root += 1;
        }
        table[i] = root;
        i += 1;
    }
    table
}

/// `2^46 / sqrt(m)` for `m` in `[2^30, 2^32)`: a seed of 8 bits, then two Newton steps, `y (3 - m y^2) / 2`.
///
/// The result is in `[2^30, 2^31]`, never above, and below by less than one part in 2^24
/// (`inverse_roots_are_close` in this file). No division. Other `m` have no meaning.
pub(crate) fn inverse_root(m: u32) -> u32 {
    let at = (m >> 25).saturating_sub(32) as usize;
    // Q7 of a number in [1, 2].
    let y = SEED.get(at).copied().map_or(0, u32::from);
    // m y^2 in Q30, and what is left of 3 in Q16; y in Q15.
    let square = (m >> 16).wrapping_mul(y * y);
    let y = (y * ((3u32 << 30).wrapping_sub(square) >> 14)) >> 9;
    // m y^2 in Q62; y in Q30.
    let y = u64::from(y);
    let square = u64::from(m).wrapping_mul(y * y);
    let rest = (3u64 << 62).wrapping_sub(square);
    let y = (y * u64::from(high(rest))) >> 16;
    u32::try_from(y).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seeds_are_the_nearest() {
        for (i, seed) in SEED.into_iter().enumerate() {
            let exact = 2048.0 / (i as f64 * 2.0 + 65.0).sqrt();
            assert!((f64::from(seed) - exact).abs() <= 0.5, "{i}: {seed}, not {exact}");
        }
    }

    #[test]
    fn inverse_roots_are_close() {
        let spread =
            (0..1_000_000u32).map(|i| i.wrapping_mul(2_654_435_769)).filter(|m| *m >> 30 != 0);
        let ends = (32..128u32).flat_map(|i| [i << 25, (i << 25) + 1, (i << 25) + ((1 << 25) - 1)]);
        let mut worst = 0.0f64;
        for m in spread.chain(ends) {
            let exact = 2f64.powi(46) / f64::from(m).sqrt();
            let y = f64::from(inverse_root(m));
            assert!(y <= exact && y >= 2f64.powi(30) - 512.0, "{m}: {y}, not {exact}");
            worst = worst.max((exact - y) / exact);
        }
        assert!(worst * 2f64.powi(24) < 1.0, "a part in 2^{}", -worst.log2());
        assert!(worst * 2f64.powi(26) > 1.0, "the bound is far off: 2^{}", -worst.log2());
    }
}

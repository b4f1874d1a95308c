//! A transform of 16 bits: what products of 32 bits hold, for chips where wider ones are slow.
//!
//! | value | format | range |
//! | --- | --- | --- |
//! | an entry of the left three columns | Q16.16 cut by `cut` bits, rounded | a row's are at most `2^15` together, and 1 1/2 by rounding |
//! | a coordinate | as it is stored | 16 bits and no more: `[-2^15, 2^15)` |
//! | a row's products | | `2^30 + 2^15.6` |
//! | translation | raw Q16.16 | below `2^29` |
//! | their sum | raw Q16.16 | below `2^31` |
//!
//! An entry is off by up to `2^(cut - 1)` raw steps, so a clip coordinate of a position `p` by `2^(cut - 1) (|x| + |y| + |z|)`
//! of those, and 1/2 by rounding. `cut` is 15 less than the bits of the largest row: where entries of it are about 2 it is 3, and
//! a coordinate of a model that is 1 unit large is within 12 raw steps, 2^-12.4. Beside a `w` of 4 on 240 pixels that is 1/180 of one.

use super::{Mat4, ModelPosition, WIDE};
use crate::math::signed;
use crate::vertex::ClipVertex;

/// A [`Mat4`] for positions of 16 bits, in 16 bits an entry: a vertex stage that takes fewer instructions, and is less exact.
///
/// Positions of more than 16 bits, as a mesh of `[i32; 3]` may have, and matrices that do not fit, are transformed as by the
/// [`Mat4`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShortMat4 {
    /// Entries, Q16.16 without their last `cut` bits; and the translation.
    rows: [[i32; 4]; 4],
    /// Bits of fraction that positions have at least, for all to fit; 32 where the matrix does not.
    cut: u32,
    whole: Mat4,
}

impl From<&Mat4> for ShortMat4 {
    fn from(whole: &Mat4) -> Self {
        let moved = whole.rows.iter().map(|[_, _, _, t]| t.unsigned_abs()).max().unwrap_or(0);
        let fits = whole.size != WIDE && moved < 1 << 29;
        let cut = u32::from(whole.size) - 15;
        let rounded = |v: i32| if cut > 0 { ((v >> (cut - 1)) + 1) >> 1 } else { v };
        let rows = whole.rows.map(|[a, b, c, t]| [rounded(a), rounded(b), rounded(c), t]);
        Self { rows, cut: if fits { cut } else { 32 }, whole: *whole }
    }
}

impl ShortMat4 {
    /// A position to clip space: three products of 32 bits a coordinate.
    #[inline(always)]
    #[must_use]
    pub fn transform(&self, position: ModelPosition) -> ClipVertex {
        let [x, y, z] = position.raw;
        let above = |v: i32| (v.wrapping_add(1 << 15)) >> 16;
        let shift = position.fraction_bits.min(31).wrapping_sub(self.cut);
        if shift > 31 || above(x) | above(y) | above(z) != 0 {
            return self.transform_whole(x, y, z, position.fraction_bits);
        }
        let half = signed((1u32 << shift) >> 1);
        let row = |[a, b, c, t]: [i32; 4]| ((a * x + b * y + c * z + half) >> shift) + t;
        // Four calls: an array's `map` of this length is not inlined.
        let [r0, r1, r2, r3] = self.rows;
        ClipVertex { raw: [row(r0), row(r1), row(r2), row(r3)], shift: 0 }
    }

    /// What does not fit. Not inlined, so that the usual path has all in registers.
    #[inline(never)]
    fn transform_whole(&self, x: i32, y: i32, z: i32, fraction_bits: u32) -> ClipVertex {
        self.whole.transform(ModelPosition { raw: [x, y, z], fraction_bits })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Any matrix in range and any position, at their ends too, against the matrix in exact numbers.
    #[test]
    fn coordinates_are_as_close_as_promised() {
        let mut state = 7u64;
        let mut random = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 32) as u32 as i32
        };
        let mut short = 0;
        for i in 0..60_000u32 {
            let (size, moved) = (i % 30, i / 30 % 31);
            let rows = [[0; 4]; 4].map(|row: [i32; 4]| {
                let mut row = row.map(|_| (random() >> (31 - size)).clamp(-(1 << 29), 1 << 29));
                row[3] = random() >> (31 - moved);
                row
            });
            let matrix = Mat4::of(rows);
            let shortened = ShortMat4::from(&matrix);
            let raw = [0; 3].map(|_| match i % 7 {
                0 => -(1 << 15),
                1 => (1 << 15) - 1,
                2 => random(),
                _ => random() >> 16,
            });
            let fraction_bits = random().unsigned_abs() % 33;
            let position = ModelPosition { raw, fraction_bits };
            let got = shortened.transform(position);
            let fits = raw.iter().all(|&v| i16::try_from(v).is_ok());
            if !fits || shortened.cut > fraction_bits.min(31) {
                assert_eq!(got, matrix.transform(position));
                continue;
            }
            short += 1;
            let unit = 2f64.powi(-(fraction_bits.min(31) as i32));
            let reach: f64 = raw.iter().map(|&v| f64::from(v).abs() * unit).sum();
            let bound = 0.5 + 0.5 * f64::from(shortened.cut).exp2() * reach;
            for (row, got) in rows.iter().zip(got.raw) {
                let sum: f64 = (0..3).map(|i| f64::from(row[i]) * f64::from(raw[i])).sum();
                let exact = sum * unit + f64::from(row[3]);
                let off = (f64::from(got) - exact).abs();
                assert!(off <= bound, "{rows:?} {raw:?} / 2^{fraction_bits}: {off}, {bound}");
            }
        }
        assert!(short > 10_000, "{short} were short");
    }
}

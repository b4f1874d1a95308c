//! The depth of a line between two projected vertices that keep their depths, for words of 16 bits.
//!
//! Error budget, in running units, 2^16 to a stored one:
//! - a vertex's depth is within 2^-28 of itself, and of a range of `2^16 - 1` units within 2^-31: 2^4 + 2;
//! - the slope is within a part in 2^28: 2^4 over the line;
//! - a step is cut to 2^-22, and to 2^-14 for each subpixel of half a pixel: less than 1 in all;
//! - rounding to 16 bits adds 2^15.
//!
//! So a stored depth is within 0.501 units.

use super::DepthBias;
use crate::math::{low, normalized, product, shared_reciprocal, signed, unsigned};
use crate::setup::ProjectedLine;

/// The depths of a line, with the rounding in them. Where a step is the whole range a subpixel, that of a pixel still fits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ProjectedDepths {
    /// The value at the line's first step, Q54 of the range.
    first: i64,
    step: i64,
    /// What no value is beyond, Q22: those of the ends.
    least: i32,
    most: i32,
}

/// Fraction bits of a depth that a vertex keeps, of a value, and of a value's high word.
const KEPT: u32 = 31;
const VALUE: u32 = 54;
const HIGH: u32 = VALUE - 32;

/// Half a stored unit, in fractions of that many bits.
const fn half(bits: u32) -> i64 {
    1 << (bits - 17)
}

impl ProjectedDepths {
    /// Of vertices in the line's order, Q31, and with that many subpixel bits.
    #[inline(always)]
    pub(crate) fn new(
        line: &ProjectedLine,
        [a, b]: [i32; 2],
        bits: u32,
        DepthBias(bias): DepthBias,
    ) -> Self {
        let bias = i32::from(bias) << (KEPT - 16);
        // The range is `2^16 - 1` units.
        let [a, b] = [a, b].map(|z| z - (z >> 16) - bias);
        let (divisor, zeros) = normalized(unsigned(line.span));
        // 2^62 / divisor.
        let inverse = signed(shared_reciprocal(divisor) >> 1);
        // A pixel is 2^bits subpixels.
        let step = product(b - a, inverse) >> (62 + KEPT - VALUE - bits - zeros);
        let first = (i64::from(a) << (VALUE - KEPT)) + half(VALUE);
        // Nothing is in front of the hither plane.
        let limit = |z: i32| (z.max(0) + low(half(KEPT))) >> (KEPT - HIGH);
        let (a, b) = (limit(a), limit(b));
        Self {
            first: first + (step >> bits) * i64::from(line.offset),
            step,
            least: a.min(b),
            most: a.max(b),
        }
    }

    /// The value a number of steps from the line's first, to go on from by [`step`](Self::step).
    #[inline(always)]
    pub(crate) fn value(&self, steps: i32) -> i64 {
        if steps == 0 { self.first } else { self.first + self.step * i64::from(steps) }
    }

    /// The value a step on. Beyond the line it may wrap.
    #[inline(always)]
    pub(crate) const fn step(&self, value: i64) -> i64 {
        value.wrapping_add(self.step)
    }

    /// The running value, of 32 bits.
    #[inline(always)]
    pub(crate) fn running(&self, value: i64) -> u32 {
        unsigned(low(value >> 32).max(self.least).min(self.most)) << (32 - HIGH)
    }
}

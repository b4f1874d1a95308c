//! What divides where varyings are corrected for perspective: a reciprocal, as a type.
//!
//! All take a divisor that is normalised, `m` in `[2^31, 2^32)`, and give `2^63 / m`. Off by at most, in parts of it:
//!
//! | | |
//! | --- | --- |
//! | [`Table`] | 2^-7.6 |
//! | [`Newton<1>`](Newton) | 2^-15 |
//! | [`Newton<2>`](Newton) | 2^-29 |
//! | [`Division`] | 2^-29 |
//! | [`Float`] | 2^-23 |
//!
//! `reciprocals_are_as_close_as_promised` in this file asserts it. A quotient is off by the same part of its distance from
//! vertex 0's value.

use crate::math::{
    reciprocal, reciprocal_below, reciprocal_by_division, reciprocal_estimate, reciprocal_seed,
    signed, unsigned,
};

/// A reciprocal: [`Table`], [`Newton`], [`Division`] or [`Float`].
pub trait Reciprocal: Copy + Default + core::fmt::Debug {
    /// `2^63 / m` for `m` in `[2^31, 2^32)`; at most `2^32 - 1`.
    fn of(m: u32) -> u32;

    /// Whether a quotient may be off by more than 1/32 of a step of RGB565.
    #[doc(hidden)]
    const IS_SHORT: bool = false;

    /// `2^47 / m`, 16 bits, never above it.
    #[doc(hidden)]
    fn below(m: u32) -> i32;
}

/// A table of 128 bytes and nothing else, or a division of 9 bits where there is an instruction for it: 9 bits. A texture of a
/// side of 64 may be a quarter of a texel off.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Table;

/// [`Table`] and `STEPS` steps of Newton's iteration, 1 or 2: 15 or 29 bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Newton<const STEPS: u32>;

/// A division of 32 by 16 bits, and a step of Newton's iteration: 29 bits. One instruction of up to 12 cycles on an ARMv7-M
/// and 32 on a small RISC-V; a call on an ARMv6-M.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Division;

/// A division in `f32`: 23 bits. For chips with an FPU; elsewhere it is a call.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Float;

impl Reciprocal for Table {
    const IS_SHORT: bool = true;

    #[inline]
    fn of(m: u32) -> u32 {
        let seed = reciprocal_seed(m);
        // 2^9 has no place in 32 bits.
        (seed << 23).wrapping_sub(seed >> 9)
    }

    #[inline]
    fn below(m: u32) -> i32 {
        // A part in 2^7 less, of which it is off by about a half.
        signed(reciprocal_seed(m) * 127)
    }
}

impl<const STEPS: u32> Newton<STEPS> {
    const CHECK: () = assert!(STEPS == 1 || STEPS == 2, "Newton<STEPS>: STEPS is 1 or 2");
}

impl<const STEPS: u32> Reciprocal for Newton<STEPS> {
    #[inline]
    fn of(m: u32) -> u32 {
        const { Self::CHECK }
        if STEPS == 2 { reciprocal(m) } else { reciprocal_estimate(m) << 15 }
    }

    #[inline]
    fn below(m: u32) -> i32 {
        const { Self::CHECK }
        // One step gives 17 bits, of which the last is off by less than 4.
        if STEPS == 2 { reciprocal_below(m) } else { signed((reciprocal_estimate(m) - 4) >> 1) }
    }
}

impl Reciprocal for Division {
    #[inline]
    fn of(m: u32) -> u32 {
        reciprocal_by_division(m)
    }

    #[inline]
    fn below(m: u32) -> i32 {
        signed(unsigned(i32::MAX) / ((m >> 16) + 1))
    }
}

impl Reciprocal for Float {
    #[inline]
    #[expect(clippy::float_arithmetic, reason = "what this type is for")]
    #[expect(clippy::cast_possible_truncation, reason = "2^31 to 2^32, saturating")]
    #[expect(clippy::cast_sign_loss, reason = "positive")]
    #[expect(clippy::cast_precision_loss, reason = "within the 2^-23 promised")]
    fn of(m: u32) -> u32 {
        /// `2^63`.
        const WHOLE: f32 = 9_223_372_036_854_775_808.0;
        (WHOLE / m as f32) as u32
    }

    #[inline]
    fn below(m: u32) -> i32 {
        signed((Self::of(m) >> 16) - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check<R: Reciprocal>(bits: f64) {
        let ends = (0..1 << 12).flat_map(|i: u32| {
            let first = (1 << 31) + (i << 19);
            [first, first + 1, first + ((1 << 19) - 1)]
        });
        let spread = (0..400_000u32).map(|i| 1 << 31 | i.wrapping_mul(2_654_435_769) >> 1);
        for m in ends.chain(spread) {
            let exact = 2f64.powi(63) / f64::from(m);
            let off = (f64::from(R::of(m)) - exact).abs() / exact;
            assert!(off <= (-bits).exp2(), "{m:x}: {off}");
            let below = f64::from(R::below(m));
            let exact = exact / 65_536.0;
            assert!(below <= exact && below < 65_536.0, "{m:x}: {below} for {exact}");
            let part = (1.6 - bits).exp2().max(2f64.powi(-13));
            assert!(exact - below <= part * exact, "{m:x}: {below} for {exact}");
        }
    }

    #[test]
    fn reciprocals_are_as_close_as_promised() {
        check::<Table>(7.6);
        check::<Newton<1>>(15.0);
        check::<Newton<2>>(29.0);
        check::<Division>(29.0);
        check::<Float>(23.0);
    }
}

//! Angles in turns, and their sine and cosine without floating point.

use crate::math::{low, shr_round};
use fixed::types::I16F16;

/// An angle as a fraction of a turn: `2^16` steps make a turn, and it wraps there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Angle(pub u16);

/// The sine and cosine of an angle, each in `[-1, 1]`: what a rotation is made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SinCos {
    /// Sine.
    pub sin: I16F16,
    /// Cosine.
    pub cos: I16F16,
}

impl SinCos {
    /// Sine and cosine, raw Q16.16, clamped to `[-1, 1]`.
    pub(super) fn raw(self) -> (i32, i32) {
        let raw = |v: I16F16| v.to_bits().clamp(-(1 << 16), 1 << 16);
        (raw(self.sin), raw(self.cos))
    }
}

impl Angle {
    /// From turns, of which only the fraction counts; negative ones turn back.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "whole turns are dropped by intent")]
    #[expect(clippy::cast_sign_loss, reason = "wraps by intent")]
    pub const fn from_turns(turns: I16F16) -> Self {
        Self(turns.to_bits() as u16)
    }

    /// From degrees, to the nearest step.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "whole turns are dropped by intent")]
    #[expect(clippy::cast_sign_loss, reason = "wraps by intent")]
    pub const fn from_degrees(degrees: I16F16) -> Self {
        Self((degrees.to_bits() as i64 + 180).div_euclid(360) as u16)
    }

    /// Sine and cosine, within one step of 2^-16.
    #[must_use]
    pub fn sin_cos(self) -> SinCos {
        SinCos { sin: sine(self.0), cos: sine(self.0.wrapping_add(1 << 14)) }
    }
}

/// The sine of `angle / 2^16` turns: the Taylor polynomial of `sin(pi/2 x)` to x^9 on a quarter
/// turn, in Q30. What is left out is below 2^-18; every step truncates below 2^-28.
fn sine(angle: u16) -> I16F16 {
    /// Coefficients of x, x^3, .. x^9: `(pi/2)^n / n!`, alternating in sign, Q30.
    const TERMS: [i64; 5] = [1_686_629_713, -693_598_668, 85_569_305, -5_026_995, 172_272];
    let quarter = angle >> 14;
    let within = i64::from(angle & 0x3fff);
    // x in Q30, mirrored in the second and fourth quarter.
    let x = if quarter & 1 == 0 { within } else { (1 << 14) - within } << 16;
    let square = (x * x) >> 30;
    let sum = TERMS.iter().rev().fold(0, |sum, term| ((sum * square) >> 30) + term);
    let sine = shr_round((sum * x) >> 30, 14);
    I16F16::from_bits(low(if quarter < 2 { sine } else { -sine }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_are_within_a_step() {
        for angle in 0..=u16::MAX {
            let exact = (f64::from(angle) / 65536.0 * core::f64::consts::TAU).sin_cos();
            let SinCos { sin, cos } = Angle(angle).sin_cos();
            for (got, exact) in [(sin, exact.0), (cos, exact.1)] {
                let error = (f64::from(got.to_bits()) - exact * 65536.0).abs();
                assert!(error <= 1.0, "{angle}: {got} is not {exact}");
            }
        }
        assert_eq!(Angle(1 << 14).sin_cos().sin, I16F16::ONE);
    }

    #[test]
    fn units_agree() {
        assert_eq!(Angle::from_turns(I16F16::from_num(-0.25)), Angle(3 << 14));
        assert_eq!(Angle::from_degrees(I16F16::from_num(90)), Angle(1 << 14));
        assert_eq!(Angle::from_degrees(I16F16::from_num(-450)), Angle(3 << 14));
    }
}

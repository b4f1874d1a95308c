//! Sines for tables and constants that the compiler computes (`f64::sin` is not `const`).

use core::f64::consts::PI;

use hither::{I16F16, SinCos};

/// Terms of the Taylor series: what is left out is below `pi^31 / 31!`, 4e-19.
const TERMS: u32 = 15;

/// Sine and cosine of an angle in radians, within 1e-14 for angles of `-pi` to `pi`.
pub(crate) const fn sin_cos(angle: f64) -> (f64, f64) {
    assert!(angle >= -PI && angle <= PI, "an angle of more than half a turn");
    let (mut sine, mut cosine) = (0.0, 0.0);
    // angle^n / n!, alternating in sign every second n.
    let mut term = 1.0;
    let mut n = 0;
    while n < 2 * TERMS {
        let signed = if n % 4 < 2 { term } else { -term };
        if n % 2 == 0 {
            cosine += signed;
        } else {
            sine += signed;
        }
        n += 1;
        term *= angle / n as f64;
    }
    (sine, cosine)
}

/// The sine and cosine of `step / steps` of a turn.
pub(crate) const fn of_turn(step: usize, steps: usize) -> (f64, f64) {
    let turns = (step % steps) as f64 / steps as f64;
    sin_cos(2.0 * PI * if turns > 0.5 { turns - 1.0 } else { turns })
}

/// What a rotation by `angle` radians is made from.
pub(crate) const fn rotation(angle: f64) -> SinCos {
    let (sin, cos) = sin_cos(angle);
    SinCos { sin: q16(sin), cos: q16(cos) }
}

/// The nearest Q16.16.
pub(crate) const fn q16(value: f64) -> I16F16 {
    I16F16::from_bits(round(value * 65536.0))
}

/// The nearest integer, halves away from zero, saturating (`f64::round` is not `const` in the oldest supported Rust).
pub(crate) const fn round(value: f64) -> i32 {
    if value < 0.0 { (value - 0.5) as i32 } else { (value + 0.5) as i32 }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;

    #[test]
    fn sines_are_those_of_the_standard_library() {
        for step in 0..360 {
            let exact = (f64::from(step) / 180.0 * PI).sin_cos();
            let got = of_turn(step as usize, 360);
            assert!((got.0 - exact.0).abs() < 1e-14, "{step}");
            assert!((got.1 - exact.1).abs() < 1e-14, "{step}");
        }
        assert_eq!(rotation(PI / 2.0).sin, I16F16::ONE);
    }

    #[test]
    fn halves_round_away_from_zero() {
        assert_eq!([-1.5, -0.4, 0.5, 1.4].map(round), [-2, 0, 1, 1]);
    }
}

//! The exact tier's snap: homogeneous, on an integer grid of 2^20, each vertex scaled by a power of
//! two.
//!
//! Coordinates `x`, `y`, `w` are integers from `-2^20` to `2^20` inclusive. A vertex whose largest
//! coordinate is smaller is scaled up, exactly; one beyond is scaled down and rounded to nearest,
//! at most half a grid step off. So near and far vertices keep the same relative precision, and
//! the largest coordinate is always in `(2^19, 2^20]`, unless all are 0.

use super::{ClipVertex, Position, ScaleOf, Snap, Snapped, Viewport, shift_round, shift_to_fit};
use crate::math::{Scale, reciprocal};

/// The exact tier: homogeneous snap, coverage equal to exact rational arithmetic for every input on
/// the grid, slivers, `w <= 0` and external triangles included.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Exact;

impl Exact {
    /// Coordinates are `-2^20 ..= 2^20`.
    pub(crate) const COORDINATE_BITS: u32 = 20;
}

/// A vertex on the exact tier's grid: 20 bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ExactPosition {
    /// Clip space, `-2^20 ..= 2^20`.
    pub(crate) x: i32,
    pub(crate) y: i32,
    pub(crate) w: i32,
    /// The first column and row whose centre is not left of or above the vertex (of its mirror
    /// image through the eye where `w < 0`), clamped to the viewport's size; meaningless where
    /// `w = 0`.
    pub(crate) column: u16,
    pub(crate) row: u16,
    /// The position is `2^shift` times the true vertex: -44 to 20.
    pub(crate) shift: i8,
}

impl Snap for Exact {
    type Position = ExactPosition;

    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "the shift is -11 - 34 to 20")]
    fn snap(vertex: &ClipVertex, _hither: i64, viewport: &Viewport) -> ExactPosition {
        let [x, y, _, w] = vertex.raw;
        let largest = [x, y, w].map(i32::unsigned_abs);
        let shift = shift_to_fit(largest, Self::COORDINATE_BITS);
        let [x, y, w] = [x, y, w].map(|v| shift_round(v, shift));
        let (width, height) = (viewport.width, viewport.height);
        // The same point of the screen with w >= 0.
        let (sx, sy, sw) = if w < 0 { (-x, -y, -w) } else { (x, y, w) };
        ExactPosition {
            x,
            y,
            w,
            column: first_centre(width * (sx + sw), 2 * sw, width),
            row: first_centre(height * (sw - sy), 2 * sw, height),
            shift: (shift - i32::from(vertex.shift)) as i8,
        }
    }
}

/// The first pixel whose centre is at or beyond `n / d`, in `0 ..= limit`: `ceil(n / d - 1/2)`
/// clamped. 0 where `d` is 0.
///
/// `|n| <= 2^30`, `0 <= d <= 2^21`, `limit <= 512`. No division: the quotient in range is at most
/// 512, and `2^63 / d` from the reciprocal is off by one part in 2^29 at most, so a floor of the
/// product is off by at most one, and the ceiling is at most two above; exact comparisons mend
/// that.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "0 to 512")]
#[expect(clippy::cast_sign_loss, reason = "0 to 512")]
pub(crate) fn first_centre(n: i32, d: i32, limit: i32) -> u16 {
    // The first X with (2 X + 1) d >= 2 n.
    let doubled = 2 * i64::from(n) - i64::from(d);
    if d <= 0 || doubled <= 0 {
        return 0;
    }
    let zeros = d.leading_zeros();
    let inverse = i64::from(reciprocal(d.unsigned_abs() << zeros));
    let d = i64::from(d);
    if doubled > 2 * d * i64::from(limit - 1) {
        return limit as u16;
    }
    // doubled / (2 d): below 2^31 times below 2^32, shifted down by 63 - zeros + 1.
    let mut first = (doubled * inverse) >> (64 - zeros);
    if first * 2 * d >= doubled + 2 * d {
        first -= 1;
    }
    while first * 2 * d < doubled {
        first += 1;
    }
    first as u16
}

impl Position for ExactPosition {
    const EMPTY: Self = Self { x: 0, y: 0, w: 0, column: 0, row: 0, shift: 0 };

    #[inline]
    fn homogeneous(&self) -> Snapped {
        Snapped::Homogeneous { point: [self.x, self.y, self.w], shift: i32::from(self.shift) }
    }

    #[inline]
    fn scale(&self) -> ScaleOf {
        ScaleOf(Scale::power_of_two(i32::from(self.shift)))
    }

    #[inline]
    fn scaled_w(&self) -> i32 {
        self.w
    }
}

const _: () = assert!(size_of::<ExactPosition>() == 20, "the size its documentation states");
const _: () = assert!(
    (2 * (Viewport::MAX_SIDE as i64)) << Exact::COORDINATE_BITS <= 1 << 30,
    "W (x + w) fits 31 bits, as first_centre assumes"
);

#[cfg(test)]
mod tests {
    use super::*;

    fn snap(raw: [i32; 4]) -> ExactPosition {
        let vertex = ClipVertex { raw, shift: 0 };
        Exact::snap(&vertex, 1, &Viewport::new(240, 240).unwrap())
    }

    #[test]
    fn what_is_on_the_grid_is_only_scaled() {
        for raw in [[1 << 20, 1, 5, -(1 << 20)], [3, -7, 0, 11], [0, 0, 0, 1], [-1, 0, 0, 0]] {
            let p = snap(raw);
            assert!(p.shift >= 0);
            assert_eq!([p.x, p.y, p.w], [raw[0], raw[1], raw[3]].map(|v| v << p.shift));
        }
    }

    #[test]
    fn beyond_the_grid_is_within_half_a_step() {
        for i in 0..10_000i64 {
            let raw = [i * 7_919 + 99, -i * 104_729, 0, i * 214_013 + (1 << 20)];
            let p = snap(raw.map(|v| v as i32));
            let unit = 1i64 << -p.shift.min(0);
            for (v, s) in [(raw[0], p.x), (raw[1], p.y), (raw[3], p.w)] {
                assert!(2 * (v - i64::from(s) * unit).abs() <= unit);
                assert!(s.abs() <= 1 << 20);
            }
        }
        let p = snap([i32::MIN, i32::MAX, 0, i32::MIN]);
        assert_eq!([p.x, p.y, p.w], [-(1 << 20), 1 << 20, -(1 << 20)]);
    }

    #[test]
    fn first_centre_equals_division() {
        let check = |n: i32, d: i32, limit: i32| {
            let exact = (2 * i64::from(n) - i64::from(d) + 2 * i64::from(d) - 1)
                .div_euclid(2 * i64::from(d))
                .clamp(0, i64::from(limit));
            assert_eq!(i64::from(first_centre(n, d, limit)), exact, "{n} / {d} up to {limit}");
        };
        for d in (1..2000).chain((0..2000).map(|i| (1 << 21) - i)) {
            for x in [0, 1, 2, 17, 239, 240, 511, 512] {
                for off in [-1, 0, 1] {
                    // On, just before and just after a centre.
                    let n = i64::from(d) * (2 * x + 1) / 2 + off;
                    if n.abs() <= 1 << 30 {
                        check(n as i32, d, 240);
                        check(n as i32, d, 512);
                        check(n as i32, d, 1);
                    }
                }
            }
        }
        check(-(1 << 30), 1, 512);
        check(1 << 30, 1 << 21, 512);
        assert_eq!(first_centre(1 << 30, 0, 512), 0);
    }
}

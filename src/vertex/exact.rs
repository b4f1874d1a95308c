//! The exact tier's snap: homogeneous, on an integer grid of 2^20, each vertex scaled by a power of
//! two.
//!
//! Coordinates `x`, `y`, `w` are integers from `-2^20` to `2^20` inclusive. A vertex whose largest
//! coordinate is smaller is scaled up, exactly; one beyond is scaled down and rounded to nearest,
//! at most half a grid step off. So near and far vertices keep the same relative precision, and
//! the largest coordinate is always in `(2^19, 2^20]`, unless all are 0.

use super::{
    ClipVertex, Position, ScaleOf, Snap, Snapped, Viewport, depth_from, shift_round, shift_to_fit,
};
use crate::math::{Scale, bits, normalized, reciprocal, reciprocal_estimate, unsigned};

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

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "the shift is -11 - 34 to 20")]
    #[expect(clippy::cast_sign_loss, reason = "columns and rows are 0 to 512")]
    fn snap(vertex: &ClipVertex, _hither: i64, viewport: &Viewport) -> ExactPosition {
        let [x, y, _, w] = vertex.raw;
        let shift = shift_to_fit([x, y, w], Self::COORDINATE_BITS);
        let [x, y, w] = [x, y, w].map(|v| shift_round(v, shift));
        let [column, row] = first_pixel([x, y, w], viewport);
        let shift = (shift - i32::from(vertex.shift)) as i8;
        ExactPosition { x, y, w, column: column as u16, row: row as u16, shift }
    }
}

/// The first column and row whose centre is not left of or above a homogeneous point of at most
/// `2^20` in magnitude (its mirror image through the eye where `w < 0`), clamped to the viewport's
/// size; 0 where `w` is 0.
#[inline]
pub(crate) fn first_pixel([x, y, w]: [i32; 3], viewport: &Viewport) -> [i32; 2] {
    // The same point of the screen with w > 0.
    let (x, y, w) = if w < 0 { (-x, -y, -w) } else { (x, y, w) };
    if w == 0 {
        return [0, 0];
    }
    let (divisor, zeros) = normalized(unsigned(w));
    let inverse = reciprocal_estimate(divisor);
    let first = |u: i32, side: i32| first_centre(u, w, [zeros, inverse], side);
    [first(x + w, viewport.width), first(w - y, viewport.height)]
}

/// [`first_pixel`] in less code.
#[inline]
pub(crate) fn any_first_pixel([x, y, w]: [i32; 3], viewport: &Viewport) -> [i32; 2] {
    let (x, y, w) = if w < 0 { (-x, -y, -w) } else { (x, y, w) };
    if w == 0 {
        return [0, 0];
    }
    [any_first_centre(x + w, w, viewport.width), any_first_centre(w - y, w, viewport.height)]
}

/// [`first_centre`] with a reciprocal of its own.
#[inline(never)]
fn any_first_centre(u: i32, w: i32, side: i32) -> i32 {
    let (divisor, zeros) = normalized(unsigned(w));
    first_centre(u, w, [zeros, reciprocal_estimate(divisor)], side)
}

/// The first pixel whose centre is at or beyond `side u / (2 w)`: `ceil(side u / (2 w) - 1/2)`, in
/// `0 ..= side`.
///
/// `0 < w <= 2^20`, `|u| <= 2^21`, `side <= 512`, and [`reciprocal_estimate`] of `w 2^zeros`. No
/// division and no 64-bit product: `u / w` is below 2 inside, and its estimate in Q30 is at most
/// 2^-14 (the reciprocal) above and 2^-14 + 2^-13 (`u` cut to 15 bits) + 2^-20 below: 2^-6 and 2^-4.4
/// of a pixel. Less 2^-6 it is never above, so the ceiling is right or one too small, and an exact
/// comparison says which.
#[inline]
fn first_centre(u: i32, w: i32, [zeros, inverse]: [u32; 2], side: i32) -> i32 {
    if u <= 0 {
        return 0;
    }
    if u >= 2 * w {
        return side;
    }
    // u 2^zeros / 2 is below 2^32, since w 2^zeros is; zeros is 11 or more.
    let ratio = ((unsigned(u) << (zeros - 1)) >> 17) * inverse;
    // Pixels in Q21: below 2^30 + 2^16.
    let estimate = bits(ratio >> 10) * side - (1 << 20) - (1 << 15);
    let first = (estimate + ((1 << 21) - 1)) >> 21;
    first + i32::from(2 * w * first < side * u - w)
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
    fn is_projected(&self) -> bool {
        false
    }

    #[inline]
    fn scaled_w(&self) -> i32 {
        self.w
    }

    #[inline]
    fn depth(&self, vertex: &ClipVertex) -> Option<i32> {
        let [_, _, z, w] = vertex.raw;
        if z < 0 || z > w || self.w <= 0 {
            return None;
        }
        // z in the units of the snapped w, whose top bit then is 31; to the left, as w is below that.
        let (divisor, zeros) = normalized(unsigned(self.w));
        let up = i32::from(self.shift) + i32::from(vertex.shift) + bits(zeros);
        let z = unsigned(z) << (unsigned(up) & 31);
        (z <= divisor).then(|| depth_from(z, reciprocal(divisor)))
    }
}

const _: () = assert!(size_of::<ExactPosition>() == 20, "the size its documentation states");
const _: () = assert!(
    (2 * (Viewport::MAX_SIDE as i64)) << Exact::COORDINATE_BITS <= 1 << 30,
    "W (x + w) fits 31 bits, as first_centre has it"
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

    /// Every column is the first whose centre is at or beyond the point, by division.
    fn check([x, y, w]: [i32; 3], side: u32) {
        let vp = Viewport::new(side, side).unwrap();
        let sign = i64::from(w.signum());
        let exact = |u: i64| {
            let (n, d) = (i64::from(side) * u * sign, 2 * i64::from(w) * sign);
            if d == 0 {
                return 0;
            }
            (2 * n - d + 2 * d - 1).div_euclid(2 * d).clamp(0, i64::from(side))
        };
        let want = [i64::from(x) + i64::from(w), i64::from(w) - i64::from(y)].map(exact);
        let got = first_pixel([x, y, w], &vp).map(i64::from);
        assert_eq!(got, want, "{x} {y} {w} on {side}");
    }

    #[test]
    fn first_pixels_equal_division_at_centres() {
        for w in (1..600).chain((0..600).map(|i| (1 << 20) - i)).chain((10..20).map(|i| 1 << i)) {
            for column in [0, 1, 2, 17, 239, 240, 511, 512] {
                for side in [1, 240, 511, 512] {
                    // On, just before and just after a centre: side (x + w) = (column + 1/2) 2 w.
                    let on = i64::from(w) * (2 * column + 1) / i64::from(side) - i64::from(w);
                    for x in [on - 1, on, on + 1].map(|v| v.clamp(-(1 << 20), 1 << 20) as i32) {
                        check([x, -x, w], side);
                        check([x, x, -w], side);
                    }
                }
            }
        }
    }

    #[test]
    fn first_pixels_equal_division_anywhere() {
        const TOP: i32 = 1 << 20;
        let mut seed = 3u64;
        for i in 0..300_000u32 {
            let mut draw = |size: u32| {
                seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695);
                ((seed >> 32) as i32) >> size
            };
            let v = [draw(12 + i % 13), draw(12 + i % 7), draw(11 + i % 19)];
            check(v.map(|v| v.clamp(-TOP, TOP)), 1 + draw(0).unsigned_abs() % 512);
        }
        for x in [-TOP, 1 - TOP, -1, 0, 1, TOP - 1, TOP] {
            for w in [-TOP, 1 - TOP, -1, 0, 1, TOP - 1, TOP] {
                check([x, x, w], 512);
                check([x, -x, w], 1);
            }
        }
    }
}

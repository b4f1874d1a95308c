//! The quick tiers' snap: projected to 4 or 8 subpixel bits, homogeneous where it cannot be.
//!
//! A vertex with `w` at or beyond the hither distance (`w > 0` where there is none) and within the
//! guard band of 1024 px around the viewport's corner is projected: one reciprocal, rounded to the
//! nearest subpixel. Any other is kept homogeneous, 14 bits and a sign, in pixel space
//! `(W (x + w), H (w - y), 2 w)`. The vertex decides, from its unsnapped values, never the
//! triangle, so the edge that two triangles share is the same edge to the bit.

use super::exact;
use super::{
    ClipVertex, PixelVertex, Position, ScaleOf, Snap, Snapped, Viewport, depth_from, shift_round,
    shift_to_fit,
};
use crate::math::{
    SMALL_CORE, Scale, bits, low, normalized, reciprocal, shared_reciprocal, unsigned,
};

/// A quick tier with `BITS` subpixel bits: 4 or 8. Coverage is exact on the snapped vertices.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Quick<const BITS: u32>;

/// A projected vertex is at most this far from the viewport's top left corner, in pixels an axis.
pub(crate) const GUARD_BAND: i64 = 1024;

/// Homogeneous coordinates are below `2^14` in magnitude.
pub(crate) const HOMOGENEOUS_BITS: u32 = 14;

/// A vertex on a quick tier's grid: 20 bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct QuickPosition<const BITS: u32> {
    /// Projected: subpixels, y down. Otherwise clip space, below 2^14 in magnitude.
    pub(crate) x: i32,
    pub(crate) y: i32,
    /// Projected: `2^BITS`. Otherwise clip space, below 2^14 in magnitude.
    pub(crate) w: i32,
    /// The position is `mantissa * 2^exponent` times the true vertex (in clip space or, projected,
    /// in pixel space divided by 2).
    pub(crate) mantissa: u32,
    pub(crate) exponent: i8,
    pub(crate) projected: bool,
}

impl<const BITS: u32> Quick<BITS> {
    /// One pixel in subpixels.
    pub(crate) const PIXEL: i32 = 1 << BITS;

    const CHECK: () = assert!(BITS == 4 || BITS == 8, "quick tiers have 4 or 8 subpixel bits");
}

impl<const BITS: u32> Snap for Quick<BITS> {
    type Position = QuickPosition<BITS>;

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "the exponent is that of a position")]
    fn snap(vertex: &ClipVertex, hither: i64, viewport: &Viewport) -> QuickPosition<BITS> {
        const { Self::CHECK }
        let [x, y, _, w] = vertex.raw;
        // Around the screen: x + w and w - y within 4 w, so that even 512 pixels are in the guard band.
        let five = w.wrapping_mul(5);
        let [right, down] = [unsigned(five.wrapping_add(x)), unsigned(five.wrapping_sub(y))];
        let near = 0 < w && w < NEAR;
        let width = unsigned(w) << 3;
        if near && right <= width && down <= width && vertex.reaches(hither) {
            project_near(vertex, viewport)
        } else {
            // By fields, so that the usual path has all in registers.
            let ClipVertex { raw: [x, y, z, w], shift } = *vertex;
            let any = ClipVertex { raw: [x, y, z, w], shift };
            let ([x, y, w], Scale { mantissa, exponent }, projected) =
                snap_any::<BITS>(&any, hither, viewport);
            QuickPosition { x, y, w, mantissa, exponent: exponent as i8, projected }
        }
    }
}

/// Raw `w` below this, 4096, leave eight times `w` in 31 bits: see [`project_near`].
const NEAR: i32 = 1 << 28;

const _: () = assert!(
    4 * Viewport::MAX_SIDE as i64 <= 2 * GUARD_BAND,
    "a vertex with x + w <= 4 w is in the guard band"
);

/// Projects a vertex around the screen, which nearly all are: `0 < w < 2^28`, `|x + w|` and `|w -
/// y|` at most `4 w`. The same numbers as [`project`], in 32 bits.
#[inline]
fn project_near<const BITS: u32>(v: &ClipVertex, viewport: &Viewport) -> QuickPosition<BITS> {
    let [x, y, _, w] = v.raw;
    let (divisor, zeros) = normalized(unsigned(w));
    let inverse = reciprocal(divisor);
    let quotient = |u: i32, side: i32| {
        // |u 2^zeros / 16| is at most a quarter of the divisor: below 2^30. zeros is 4 or more.
        let ratio = ratio(u << (zeros - 4), inverse);
        quotient_near::<BITS>(u, w, ratio, side)
    };
    let [x, y] = [quotient(x + w, viewport.width), quotient(w - y, viewport.height)];
    projected([x, y], inverse, zeros, v.shift)
}

/// `u inverse / 2^40` for `|u| < 2^30`: never above the one with the true reciprocal, and less than
/// 1 + 2^-5 below.
///
/// The reciprocal is off by one part in 2^29 at most, 2^-10 of a unit of the result.
#[inline]
fn ratio(u: i32, inverse: u32) -> i32 {
    if SMALL_CORE {
        ratio_split(u, inverse)
    } else {
        // 2^-7 of a unit; the reciprocal is 0.6 of these off at most.
        (low((i64::from(u) * i64::from(inverse >> 1)) >> 32) - 1) >> 7
    }
}

/// [`ratio`] from three 32-bit products; `u` is `high 2^15 + low`, of 15 bits each.
#[inline]
fn ratio_split(u: i32, inverse: u32) -> i32 {
    let (high, low) = (u >> 15, u & 0x7fff);
    let [top, rest] = [inverse >> 16, inverse & 0xffff].map(bits);
    // 2^-9 of a unit, at most 3 below by what is cut; the reciprocal is 2 of these off at most.
    (high * top + ((high * rest) >> 16) + ((low * top) >> 15) - 2) >> 9
}

/// `side u 2^BITS / (2 w)`, rounded to nearest (halves up), from `u / w` in Q19 as [`ratio`] has it.
///
/// The ratio is at most 2^-18.9 too small and never too large: `2^(BITS - 10.9)` of a subpixel at 512
/// pixels, so the estimate is right or one too small. The remainder says which: it is in `[0, 4 w)`,
/// below 2^30, so its low 32 bits are all of it, whatever its terms are.
#[inline]
fn quotient_near<const BITS: u32>(u: i32, w: i32, ratio: i32, side: i32) -> i32 {
    // At most (2^21 + 1) 2^9 + 2^15.
    let estimate = (ratio * side + (1 << (19 - BITS))) >> (20 - BITS);
    let two_w = 2 * w;
    // u side 2^BITS / two_w + 1/2 = (u side 2^BITS + w) / two_w, floored.
    let across = u.wrapping_mul(side) << BITS;
    let remainder = across.wrapping_add(w).wrapping_sub(estimate.wrapping_mul(two_w));
    estimate + i32::from(remainder >= two_w)
}

/// Snaps any vertex: its point, its scale and whether it was projected. Not inlined: the rest is one
/// path then, and short.
#[inline(never)]
fn snap_any<const BITS: u32>(
    vertex: &ClipVertex,
    hither: i64,
    viewport: &Viewport,
) -> ([i32; 3], Scale, bool) {
    let [x, y, _, w] = vertex.raw.map(i64::from);
    // Pixel space, times 2 w: 42 bits.
    let across = i64::from(viewport.width) * (x + w);
    let down = i64::from(viewport.height) * (w - y);
    let limit = 2 * GUARD_BAND * w;
    let inside = across.abs() <= limit && down.abs() <= limit;
    let p: QuickPosition<BITS> = if inside && w > 0 && vertex.reaches(hither) {
        project(vertex, across, down)
    } else {
        homogeneous(vertex)
    };
    ([p.x, p.y, p.w], p.scale().0, p.projected)
}

/// Projects a vertex: `w > 0`, `|across|` and `|down|` at most `2048 w`.
#[inline]
fn project<const BITS: u32>(v: &ClipVertex, across: i64, down: i64) -> QuickPosition<BITS> {
    let (divisor, zeros) = normalized(v.raw[3].unsigned_abs());
    let inverse = shared_reciprocal(divisor);
    let quotient = |n: i64| quotient::<BITS>(n << zeros, divisor, inverse);
    projected([quotient(across), quotient(down)], inverse, zeros, v.shift)
}

/// A projected vertex, from its subpixels and what its `w` was divided by.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "the exponent is -61 - 34 to 8")]
fn projected<const BITS: u32>(
    [x, y]: [i32; 2],
    inverse: u32,
    zeros: u32,
    shift: u8,
) -> QuickPosition<BITS> {
    // k = 2^(BITS - 1) / w, and 1 / (w 2^zeros) = inverse / 2^63.
    let exponent = bits(BITS) - 1 + bits(zeros) - 63 - i32::from(shift);
    let (w, exponent) = (1 << BITS, exponent as i8);
    QuickPosition { x, y, w, mantissa: inverse, exponent, projected: true }
}

/// `n 2^BITS / (2 d)`, rounded to nearest (halves up), for `d` in `[2^31, 2^32)` and
/// `|n| <= 2048 d`, given `2^63 / d` to one part in 2^29.
///
/// `n` fits 44 bits; cut to 31 bits it is `2^-19` of a pixel off, the reciprocal at most 2^-11 of a
/// subpixel: the estimate is off by one at most, and the exact remainder (52 bits) says so.
#[inline(never)]
fn quotient<const BITS: u32>(n: i64, d: u32, inverse: u32) -> i32 {
    let estimate = ((n >> 12) * i64::from(inverse >> 1)) >> (63 - 12 - BITS);
    let two_d = 2 * i64::from(d);
    // n 2^BITS / two_d + 1/2 = (n 2^BITS + d) / two_d, floored.
    let remainder = (n << BITS) + i64::from(d) - estimate * two_d;
    let correction = if remainder < 0 { -1 } else { i64::from(remainder >= two_d) };
    low(estimate + correction)
}

/// Keeps a vertex homogeneous, in clip space: each coordinate within half a grid step of the scaled
/// vertex, below `2^14` in magnitude.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "the exponent is -31 - 18 - 34 to -17")]
fn homogeneous<const BITS: u32>(v: &ClipVertex) -> QuickPosition<BITS> {
    let [x, y, _, w] = v.raw;
    let largest = x.unsigned_abs().max(y.unsigned_abs()).max(w.unsigned_abs());
    let mut shift = shift_to_fit([x, y, w], HOMOGENEOUS_BITS);
    let limit = (1 << HOMOGENEOUS_BITS) - 1;
    if rounded(largest, shift) > limit {
        shift -= 1;
    }
    let scale = Scale::power_of_two(shift - i32::from(v.shift));
    QuickPosition {
        x: shifted(x, shift),
        y: shifted(y, shift),
        w: shifted(w, shift),
        mantissa: scale.mantissa,
        exponent: scale.exponent as i8,
        projected: false,
    }
}

/// [`shift_round`], not inlined: few vertices need it.
#[inline(never)]
fn shifted(v: i32, shift: i32) -> i32 {
    shift_round(v, shift)
}

/// A magnitude after [`shift_round`], rounded up on a half.
#[inline]
#[expect(clippy::cast_sign_loss, reason = "a shift that was tested for its sign")]
fn rounded(v: u32, shift: i32) -> u32 {
    if shift >= 0 {
        v << shift
    } else {
        let shift = -shift as u32;
        (v >> shift) + ((v >> (shift - 1)) & 1)
    }
}

impl<const BITS: u32> QuickPosition<BITS> {
    /// In pixel space: 24 bits and a sign for homogeneous ones, `BITS + 10` for projected ones. Not inlined: few
    /// triangles need it.
    #[inline(never)]
    pub(crate) fn in_pixels(&self, viewport: &Viewport) -> PixelVertex {
        let Self { x, y, w, .. } = *self;
        let [width, height] = [viewport.width, viewport.height];
        if self.projected {
            let first = |v: i32| (v + (Quick::<BITS>::PIXEL / 2 - 1)) >> BITS;
            // Sides are positive; `clamp` would keep a panic for negative ones in the binary.
            let first = [first(x).min(width).max(0), first(y).min(height).max(0)];
            PixelVertex { point: [x, y, w], first }
        } else {
            PixelVertex::of_clip([x, y, w], exact::any_first_pixel([x, y, w], viewport), viewport)
        }
    }
}

impl<const BITS: u32> Position for QuickPosition<BITS> {
    const EMPTY: Self = Self { x: 0, y: 0, w: 0, mantissa: 0, exponent: 0, projected: false };

    #[inline]
    fn homogeneous(&self) -> Snapped {
        if self.projected {
            Snapped::Projected { point: [self.x, self.y], subpixel_bits: BITS }
        } else {
            let shift = i32::from(self.exponent) + 31;
            Snapped::Homogeneous { point: [self.x, self.y, self.w], shift }
        }
    }

    #[inline]
    fn scale(&self) -> ScaleOf {
        ScaleOf(Scale { mantissa: self.mantissa, exponent: i32::from(self.exponent) })
    }

    #[inline]
    fn is_projected(&self) -> bool {
        self.projected
    }

    #[inline]
    fn scaled_w(&self) -> i32 {
        if self.projected { self.w / 2 } else { self.w }
    }

    #[inline]
    fn depth(&self, vertex: &ClipVertex) -> Option<i32> {
        let [_, _, z, w] = vertex.raw;
        if z < 0 || z > w || !self.projected {
            return None;
        }
        // See `projected`.
        let zeros = i32::from(self.exponent) + i32::from(vertex.shift) + 64 - bits(BITS);
        Some(depth_from(unsigned(z) << (unsigned(zeros) & 31), self.mantissa))
    }
}

const _: () = assert!(size_of::<QuickPosition<4>>() == 20, "the size its documentation states");

#[cfg(test)]
mod tests {
    use super::*;

    fn snap<const BITS: u32>(raw: [i32; 4], hither: i64) -> QuickPosition<BITS> {
        let vertex = ClipVertex { raw, shift: 0 };
        Quick::<BITS>::snap(&vertex, hither, &Viewport::new(240, 320).unwrap())
    }

    /// Projected coordinates are the nearest subpixel of the exact rational, over all sizes of w.
    fn projects_to_nearest<const BITS: u32>() {
        let mut seed = 1u64;
        let mut projected = 0;
        for i in 0..200_000u32 {
            let mut draw = || {
                seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695);
                (seed >> 33) as i64
            };
            let w = (draw() >> (i % 31)).max(1);
            let raw = [draw() % (8 * w), draw() % (8 * w), 0].map(|v| v - 4 * w);
            if raw.iter().any(|v| i32::try_from(*v).is_err()) {
                continue;
            }
            let p = snap::<BITS>([raw[0] as i32, raw[1] as i32, 0, w as i32], 1);
            let exact = [240 * (raw[0] + w), 320 * (w - raw[1])];
            let in_band = exact.iter().all(|n| n.abs() <= 2048 * w);
            assert_eq!(p.projected, in_band, "{raw:?} {w}");
            if p.projected {
                projected += 1;
                for (n, s) in exact.into_iter().zip([p.x, p.y]) {
                    let twice = (i128::from(n) << BITS) - i128::from(s) * 2 * i128::from(w);
                    assert!(-i128::from(w) <= twice && twice <= i128::from(w), "{n} / {w}: {s}");
                }
            }
        }
        assert!(projected > 10_000);
    }

    fn fields<const BITS: u32>(p: &QuickPosition<BITS>) -> ([i32; 3], Scale, bool) {
        ([p.x, p.y, p.w], p.scale().0, p.projected)
    }

    /// Vertices around the screen are as any vertex is.
    fn near_is_as_any<const BITS: u32>() {
        let mut seed = 11u64;
        let mut near = 0;
        for i in 0..400_000u32 {
            let mut draw = || {
                seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695);
                (seed >> 32) as u32
            };
            let side = |v: u32| if v & 7 == 0 { 512 } else { 1 + (v >> 3) % 512 };
            let vp = Viewport::new(side(draw()), side(draw())).unwrap();
            let w = match draw() & 7 {
                0 => NEAR - 1 - (draw() & 3) as i32,
                1 => 1 << (i % 28),
                2 => (1 << (i % 28)) - 1,
                _ => ((draw() >> 1) >> (3 + i % 28)) as i32,
            };
            let w = w.max(1);
            let hither = if draw() & 1 == 0 { 1 } else { i64::from(w) };
            let [a, b, last] = [draw(), draw(), draw()];
            let other = |u: u32| match u & 15 {
                // At the ends of the band, and of halves of a subpixel.
                0 => -5 * i64::from(w) + i64::from(u >> 30) - 1,
                1 => 3 * i64::from(w) + i64::from(u >> 30) - 1,
                2..7 => {
                    let step = i64::from((u >> 8) % (8 << 9));
                    let half = i64::from(w) * (2 * step + 1) / (i64::from(vp.width) << BITS);
                    half - i64::from(w) + i64::from(u >> 30) - 1
                }
                _ => i64::from(u ^ last) % (10 * i64::from(w)) - 6 * i64::from(w),
            };
            let (x, y) = (other(a), other(b));
            let (Ok(x), Ok(y)) = (i32::try_from(x), i32::try_from(-y)) else { continue };
            let vertex = ClipVertex { raw: [x, y, 0, w], shift: (i % 9) as u8 };
            let got = Quick::<BITS>::snap(&vertex, hither, &vp);
            assert_eq!(
                fields(&got),
                snap_any::<BITS>(&vertex, hither, &vp),
                "{vertex:?} in {vp:?}"
            );
            let inside = |u: i64| u.abs() <= 4 * i64::from(w);
            if inside(i64::from(x) + i64::from(w)) && inside(i64::from(w) - i64::from(y)) {
                assert_eq!(got, project_near(&vertex, &vp), "{vertex:?} in {vp:?}");
                near += 1;
            }
        }
        assert!(near > 200_000);
    }

    #[test]
    fn vertices_around_the_screen_are_as_any() {
        near_is_as_any::<4>();
        near_is_as_any::<8>();
    }

    #[test]
    fn extreme_vertices_are_as_any() {
        let vp = Viewport::new(512, 1).unwrap();
        let ends = [i32::MIN, i32::MIN + 1, -NEAR, -1, 0, 1, NEAR, i32::MAX - 1, i32::MAX];
        let steps = [-5, -4, -3, -1, 0, 1, 3, 4, 5, 8];
        for w in ends.into_iter().chain([NEAR - 1, NEAR + 1, 1 << 29, 1 << 30]) {
            let near = steps.map(|n| w.wrapping_mul(n)).into_iter();
            let all = ends.into_iter().chain(near).flat_map(|v| [v, v.wrapping_add(1)]);
            for (x, y) in all.clone().flat_map(|x| all.clone().map(move |y| (x, y))) {
                let vertex = ClipVertex { raw: [x, y, 0, w], shift: 0 };
                let got = Quick::<8>::snap(&vertex, 1, &vp);
                assert_eq!(fields(&got), snap_any::<8>(&vertex, 1, &vp), "{vertex:?}");
            }
        }
    }

    #[test]
    fn ratios_are_close() {
        let mut seed = 7u64;
        for i in 0..200_000u32 {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695);
            let divisor = (1 << 31) | (seed >> 20) as u32;
            let u = ((seed >> 32) as i32 >> (2 + i % 20))
                .clamp(-bits(divisor >> 2), bits(divisor >> 2));
            // u 2^63 / divisor, in 2^-40.
            let exact = (i128::from(u) << (23 + 32)) / i128::from(divisor);
            let inverse = reciprocal(divisor);
            let long = (low((i64::from(u) * i64::from(inverse >> 1)) >> 32) - 1) >> 7;
            for got in [long, ratio_split(u, inverse)] {
                let below = exact - (i128::from(got) << 32);
                assert!((0..=(1 << 32) + (1 << 27)).contains(&below), "{u} / {divisor}: {got}");
            }
        }
    }

    #[test]
    fn quick4_projects_to_nearest() {
        projects_to_nearest::<4>();
    }

    #[test]
    fn quick8_projects_to_nearest() {
        projects_to_nearest::<8>();
    }

    #[test]
    fn the_hither_plane_and_the_guard_band_decide() {
        assert!(snap::<8>([0, 0, 0, 100], 100).projected);
        assert!(!snap::<8>([0, 0, 0, 99], 100).projected);
        assert!(!snap::<8>([0, 0, 0, 0], 1).projected);
        assert!(!snap::<8>([0, 0, 0, i32::MIN], 1).projected);
        // 1024 px from the corner is inside, a step further is not: 240 (x + w) = 2048 w.
        assert!(snap::<4>([(2048 - 240) * 10, 0, 0, 2400], 1).projected);
        assert!(!snap::<4>([(2048 - 240) * 10 + 1, 0, 0, 2400], 1).projected);
    }

    #[test]
    fn homogeneous_vertices_stay_below_the_limit() {
        for v in [1, 2, 16_383, 16_384, 16_385, 32_767, 32_768, i32::MAX, i32::MIN, -16_384] {
            let p = snap::<4>([v, v / 2, 0, -1], 1);
            assert!(p.x.abs() < 1 << 14 && p.x.abs() >= 1 << 12, "{v}: {p:?}");
            let shift = i32::from(p.exponent) + 31;
            let unit = f64::from(shift).exp2();
            assert!((f64::from(p.x) - f64::from(v) * unit).abs() <= 0.5);
            assert!((f64::from(p.y) - f64::from(v / 2) * unit).abs() <= 0.5);
        }
    }

    #[test]
    fn first_pixels_follow_the_centres() {
        let vp = Viewport::new(240, 320).unwrap();
        let at = |x: i32| {
            let p = QuickPosition::<4> { x, y: x, w: 16, projected: true, ..Default::default() };
            p.in_pixels(&vp).first[0]
        };
        assert_eq!([at(-99), at(8), at(9), at(24), at(25), at(99_999)], [0, 0, 1, 1, 2, 240]);
    }
}

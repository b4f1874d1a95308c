//! Vertices: clip space in, snapped to a grid once, and what the stages after need of each.
//!
//! A vertex is snapped by itself, never as part of a triangle, so that every triangle that shares
//! it sees the same numbers and a mesh stays closed (Olano & Greer 1997, section 5.2). A snapped
//! vertex is a homogeneous point: it may be scaled by any positive `k` without moving on the
//! screen, and all that is linear over the triangle is scaled with it.

mod exact;
mod quick;
mod viewport;

pub use exact::{Exact, ExactPosition};
pub(crate) use quick::{GUARD_BAND, HOMOGENEOUS_BITS};
pub use quick::{Quick, QuickPosition};
pub use viewport::{Rect, Viewport, ViewportSize};

use crate::math::{Scale, bits, high, low, shr_round, signed, unsigned};
use fixed::types::I16F16;

/// A point in clip space: `x / w` and `y / w` in `[-1, 1]` are on the screen, y up, and `z / w` is
/// 0 on the hither plane and 1 at far.
///
/// The four share one scale, which needs no meaning of its own: `(x, y, z, w)` and `(k x, k y, k z,
/// k w)` are the same pixel for any positive `k`. The hither distance is in the units of `w`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ClipVertex {
    /// Raw Q16.16 coordinates, shifted right together by `shift`.
    pub(crate) raw: [i32; 4],
    /// 0 to 32: larger than 0 only where a transform left the range of Q16.16.
    pub(crate) shift: u8,
}

impl ClipVertex {
    /// From clip-space coordinates, any values.
    #[inline]
    #[must_use]
    pub const fn new(x: I16F16, y: I16F16, z: I16F16, w: I16F16) -> Self {
        Self { raw: [x.to_bits(), y.to_bits(), z.to_bits(), w.to_bits()], shift: 0 }
    }

    /// At a place on the screen, in pixels from the viewport's top left corner, y down, with a depth of 0: for 2D. Its `w` is
    /// the product of the sides, in pixels; the place is exact where it is in whole 256ths within 4096 pixels of the corner.
    ///
    /// ```
    /// use hither::{ClipVertex, Frame, Framebuffer, Gray8, I16F16, Quick, Snapped};
    ///
    /// # let mut words = [0; 12 * 7];
    /// let frame = Frame::new(Framebuffer::<Gray8>::try_new(&mut words, 12, 7)?)?.with_tier(Quick::<8>);
    /// let place = [I16F16::from_num(3.5), I16F16::from_num(-2)];
    /// let vertex = frame.snap(&ClipVertex::on_screen(place, frame.viewport()), []);
    /// assert_eq!(vertex.snapped(), Snapped::Projected { point: [896, -512], subpixel_bits: 8 });
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    #[must_use]
    pub fn on_screen([x, y]: [I16F16; 2], viewport: &Viewport) -> Self {
        let (width, height) = (i64::from(viewport.width), i64::from(viewport.height));
        // x / w = 2 X / W - 1 and y / w = 1 - 2 Y / H, with w = W H.
        let across = (2 * i64::from(x.to_bits()) - (width << 16)) * height;
        let up = ((height << 16) - 2 * i64::from(y.to_bits())) * width;
        Self::from_wide([across, up, 0, (width * height) << 16])
    }

    /// From raw Q16.16 coordinates of up to 63 bits. Where one does not fit 32 bits, all four are
    /// shifted right together, rounded to nearest, so the point stays where it is.
    #[inline]
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "at most 33")]
    pub fn from_wide(raw: [i64; 4]) -> Self {
        let magnitude = raw.map(i64::unsigned_abs);
        let all = magnitude[0] | magnitude[1] | magnitude[2] | magnitude[3];
        if high(all) == 0 && all >> 31 == 0 {
            return Self { raw: raw.map(low), shift: 0 };
        }
        // One bit to spare: rounding up may carry.
        let shift = (64 - all.leading_zeros()).saturating_sub(30);
        Self { raw: raw.map(|v| low(shr_round(v, shift))), shift: shift as u8 }
    }

    /// Whether `w` is at least a raw distance of 1 to `2^31`.
    #[inline]
    pub(crate) fn reaches(&self, distance: i64) -> bool {
        let [_, _, _, w] = self.raw;
        let shift = self.shift;
        if shift == 0 { i64::from(w) >= distance } else { reaches_shifted(w, shift, distance) }
    }
}

/// [`ClipVertex::reaches`] of any vertex.
///
/// A shifted `w` of 1 or more is at least `2^shift`, so no more than 32 bits need be undone; `raw` is
/// at most 2^30 where it was shifted.
#[cold]
fn reaches_shifted(w: i32, shift: u8, distance: i64) -> bool {
    i64::from(w) << shift.min(32) >= distance
}

/// A snap of vertices to a grid: the part of a tier that looks at one vertex alone.
pub trait Snap: Copy + Send + core::fmt::Debug + Default + 'static {
    /// The snapped position.
    type Position: Position;

    /// Snaps a vertex. `hither` is the least raw `w` that may be projected: the hither distance, or
    /// 1.
    fn snap(vertex: &ClipVertex, hither: i64, viewport: &Viewport) -> Self::Position;
}

/// A snapped position: a homogeneous point on the tier's grid.
pub trait Position: Copy + Send + core::fmt::Debug + PartialEq {
    /// The point that is no point: all zero.
    const EMPTY: Self;

    /// The snapped point, exactly what coverage is decided from.
    fn homogeneous(&self) -> Snapped;

    /// `k`, by which the true vertex was scaled, to one part in 2^29; relative to raw Q16.16.
    #[doc(hidden)]
    fn scale(&self) -> ScaleOf;

    /// Whether a tier that projects has projected it; false in any other.
    #[doc(hidden)]
    fn is_projected(&self) -> bool;

    /// `k w` in the units of `scale`, rounded as the grid rounds it.
    #[doc(hidden)]
    fn scaled_w(&self) -> i32;

    /// The depth `z / w` of the vertex this position is of, by the snapped `w`: Q31 below 1, within 2^-28, where
    /// `0 <= z <= w`.
    #[doc(hidden)]
    fn depth(&self, vertex: &ClipVertex) -> Option<i32>;
}

/// `z / w`, Q31, from both in one scale with `w` in `[2^31, 2^32)`, and `2^63 / w`; below 1.
#[inline]
fn depth_from(z: u32, inverse: u32) -> i32 {
    // The reciprocal is a unit or more below; with that unit, a depth that is a short fraction is exact.
    let depth = high(u64::from(z) * u64::from(inverse) + u64::from(z));
    signed(depth.min(unsigned(i32::MAX)))
}

/// An opaque positive real, for [`Position`].
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct ScaleOf(pub(crate) Scale);

/// A vertex as setup sees it.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, Default)]
pub struct PixelVertex {
    /// Pixel space `(x, y, w)`, y down, in any positive scale; `w` is even.
    pub(crate) point: [i32; 3],
    /// The first column and row whose centre is not left of or above the vertex (of its mirror image
    /// where `w < 0`), clamped to the viewport's size; meaningless where `w = 0`.
    pub(crate) first: [i32; 2],
}

impl PixelVertex {
    /// From clip space, below or at 2^20 in magnitude: `(W (x + w), H (w - y), 2 w)`, at most 2^30.
    #[inline]
    pub(crate) const fn of_clip([x, y, w]: [i32; 3], first: [i32; 2], viewport: &Viewport) -> Self {
        Self { point: [viewport.width * (x + w), viewport.height * (w - y), 2 * w], first }
    }
}

/// A snapped point, exactly what coverage is decided from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Snapped {
    /// `(x, y, w)` in clip space: `x / w` and `y / w` are normalized device coordinates, y up. The
    /// grid step is 1; `2^shift` of these make one unit of the raw coordinates that went in.
    Homogeneous {
        /// Integer coordinates `[x, y, w]`.
        point: [i32; 3],
        /// `point` is the raw vertex times `2^shift`.
        shift: i32,
    },
    /// A position on the screen, `w > 0`.
    Projected {
        /// Pixels from the top left corner times `2^subpixel_bits`, y down.
        point: [i32; 2],
        /// Fraction bits of `point`.
        subpixel_bits: u32,
    },
}

/// What the rest of the pipeline keeps of a vertex: the snapped position, its depth, where it lies,
/// its `N` varyings and its distances from `P` clip planes. This is what a vertex cache holds:
/// `size_of::<Vertex<..>>()` bytes each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex<T: Snap, const N: usize = 0, const P: usize = 0> {
    pub(crate) position: T::Position,
    /// With [`Outside::RANGED`] the depth `z / w`, Q31; otherwise clip-space z, raw Q16.16 shifted right by `shift`.
    pub(crate) z: i32,
    pub(crate) shift: u8,
    pub(crate) outside: Outside,
    pub(crate) varyings: [I16F16; N],
    /// One each clip plane.
    pub(crate) distances: [Distance; P],
}

impl<T: Snap, const N: usize, const P: usize> Vertex<T, N, P> {
    /// A vertex that draws nothing: what a cache is filled with before its first use. All zero bits, so
    /// that a static cache takes no flash.
    pub const EMPTY: Self = Self {
        position: T::Position::EMPTY,
        z: 0,
        shift: 0,
        outside: Outside(0),
        varyings: [I16F16::ZERO; N],
        distances: [Distance::of(0); P],
    };

    /// The snapped position, as coverage sees it.
    #[inline]
    #[must_use]
    pub fn snapped(&self) -> Snapped {
        self.position.homogeneous()
    }

    /// The varyings that came with the vertex.
    #[inline]
    #[must_use]
    pub const fn varyings(&self) -> &[I16F16; N] {
        &self.varyings
    }
}

/// The raw distance `n . p` of a vertex from a clip plane, positive inside: 64 bits as two words, so
/// that a vertex without planes is not aligned for them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Distance {
    high: i32,
    low: u32,
}

impl Distance {
    /// From a whole number.
    #[inline]
    #[expect(clippy::cast_sign_loss, reason = "the low word as it is")]
    pub(crate) const fn of(v: i64) -> Self {
        Self { high: low(v >> 32), low: low(v) as u32 }
    }

    /// To a whole number.
    #[inline]
    pub(crate) const fn get(self) -> i64 {
        (self.high as i64) << 32 | self.low as i64
    }
}

/// Which bounds a vertex lies beyond, a bit each. A triangle whose three vertices share a bit shows
/// nothing in front of the eye: each bound is linear over the triangle, whatever the signs of `w`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Outside(pub(crate) u16);

impl Outside {
    /// `w` below the hither distance, or not positive where there is no plane.
    pub(crate) const HITHER: u16 = 1;
    /// The four sides of the viewport.
    pub(crate) const SIDES: u16 = 0b1_1110;
    /// The first clip plane; the others follow.
    pub(crate) const FIRST_PLANE: u16 = 1 << 5;
    /// All bounds.
    pub(crate) const BOUNDS: u16 = Self::CLIPS | Self::SIDES;
    /// All planes that clip: hither and up to eight more.
    pub(crate) const CLIPS: u16 = 0b1_1111_1110_0001;
    /// Not a bound: `z / w` is not within ±4, so depths of the triangle may cancel.
    pub(crate) const STEEP: u16 = 1 << 15;
    /// Not a bound: the vertex is projected.
    pub(crate) const PROJECTED: u16 = 1 << 13;
    /// Not a bound: `z / w` is in `[0, 1]`, and is what the vertex keeps. Only where a frame has depth.
    pub(crate) const RANGED: u16 = 1 << 14;

    /// The outcodes of a vertex against the eye or hither plane, and the viewport's sides.
    #[inline]
    pub(crate) fn of(vertex: &ClipVertex, hither: i64) -> Self {
        let [x, y, z, w] = vertex.raw;
        // Where w is below 2^28, a sum that wraps is above 8 w too.
        let within =
            |v: i32, shift: u32| unsigned(v.wrapping_add(w << shift)) <= unsigned(w) << (shift + 1);
        let small = unsigned(w) < 1 << 28;
        let rest = if small && within(x, 0) && within(y, 0) && within(z, 2) {
            0
        } else {
            Self::beyond(x, y, z, w)
        };
        Self(rest | u16::from(!vertex.reaches(hither)))
    }

    /// The outcodes but for `w`, of any coordinates: `-w` does not always fit, `!w` = `-w - 1` does.
    #[inline(never)]
    fn beyond(x: i32, y: i32, z: i32, w: i32) -> u16 {
        let bit = |outside: bool, n: u16| u16::from(outside) << n;
        // |z| - 1, or -1 for 0; |z| > 4 w where this is at least 4 w.
        let depth = if z > 0 { z - 1 } else { !z };
        bit(x <= !w, 1) | bit(x > w, 2) | bit(y <= !w, 3) | bit(y > w, 4) | bit(depth >> 2 >= w, 15)
    }
}

/// By how much to shift so that the largest magnitude of `values` fits `limit_bits` bits: positive to
/// the left, negative to the right. `2^limit_bits` itself fits.
#[inline]
pub(crate) fn shift_to_fit([x, y, z]: [i32; 3], limit_bits: u32) -> i32 {
    // The magnitude less 1, or 0 for 0. (One less again for -2^31, which has the same length.)
    let below = |v: i32| unsigned(v ^ v >> 31) - (unsigned(v.wrapping_neg()) >> 31);
    let length = 32 - (below(x) | below(y) | below(z)).leading_zeros();
    bits(limit_bits) - bits(length)
}

/// `v * 2^shift`, rounded to nearest on the right. The caller's shift keeps the result in 32 bits.
#[inline]
#[expect(clippy::cast_sign_loss, reason = "both casts are of what was tested to be positive")]
pub(crate) fn shift_round(v: i32, shift: i32) -> i32 {
    if shift >= 0 {
        v << shift
    } else {
        let shift = -shift as u32;
        (v >> shift) + ((v >> (shift - 1)) & 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wide_coordinates_shift_together() {
        let v = ClipVertex::from_wide([1 << 40, -(1 << 39), 3, i64::from(i32::MAX)]);
        assert_eq!(v.shift, 11);
        assert_eq!(v.raw, [1 << 29, -(1 << 28), 0, 1 << 20]);
        let near = ClipVertex::from_wide([i64::from(i32::MAX), i64::from(-i32::MAX), 0, 1]);
        assert_eq!((near.shift, near.raw), (0, [i32::MAX, -i32::MAX, 0, 1]));
        let far = ClipVertex::from_wide([0, 0, 0, i64::MAX]);
        let behind = ClipVertex::from_wide([0, 0, 0, i64::MIN]);
        assert!(far.reaches(1 << 31) && !behind.reaches(1) && near.reaches(1) && !near.reaches(2));
        let extreme = ClipVertex::from_wide([i64::MIN, i64::MAX, 0, 1]);
        assert_eq!(extreme.shift, 34);
        assert_eq!(extreme.raw, [-(1 << 29), 1 << 29, 0, 0]);
    }

    #[test]
    fn outcodes_equal_wide_comparisons() {
        let small = [0, 1, 2, 3, 4, 5, 7, 8, 9, 1000].into_iter();
        let powers = (26..32).flat_map(|n| [-1, 0, 1].map(|d| (1i64 << n) + d));
        let ends: std::vec::Vec<i32> =
            small.chain(powers).flat_map(|v| [v, -v]).filter_map(|v| v.try_into().ok()).collect();
        let wide = |raw: [i32; 4]| {
            let [x, y, z, w] = raw.map(i64::from);
            let outside = [w < 1, x + w < 0, w - x < 0, y + w < 0, w - y < 0];
            let bits = outside.into_iter().enumerate().map(|(n, outside)| u16::from(outside) << n);
            bits.sum::<u16>() | u16::from(z.abs() > 4 * w) << 15
        };
        for &w in &ends {
            for &v in &ends {
                for raw in [[v, 0, 0, w], [0, v, 0, w], [0, 0, v, w], [v, v, v, w]] {
                    let got = Outside::of(&ClipVertex { raw, shift: 0 }, 1).0;
                    assert_eq!(got, wide(raw), "{raw:?}");
                }
            }
        }
    }

    #[test]
    fn shift_round_rounds_as_wide_numbers() {
        for v in [0, 1, -1, 5, -5, 6, -6, i32::MAX, i32::MIN, i32::MAX - 1, 1 << 30, -1 << 29] {
            for n in 1..31 {
                assert_eq!(shift_round(v, -n), low(shr_round(i64::from(v), n as u32)), "{v} {n}");
            }
        }
    }

    #[test]
    fn distances_keep_64_bits() {
        for v in [0, 1, -1, 1 << 31, -(1 << 31), 1 << 61, i64::MIN, i64::MAX, 0xffff_ffff] {
            assert_eq!(Distance::of(v).get(), v);
        }
    }

    #[test]
    fn shift_to_fit_keeps_the_limit_itself() {
        assert_eq!(shift_to_fit([1 << 20, 0, 0], 20), 0);
        assert_eq!(shift_to_fit([(1 << 20) + 1, 0, 0], 20), -1);
        assert_eq!(shift_to_fit([0, 1, 0], 20), 20);
        assert_eq!(shift_to_fit([0, 0, i32::MIN], 20), -11);
        assert_eq!(shift_to_fit([0, 0, 0], 20), 20);
        for v in (0..31).flat_map(|n| [-1, 0, 1].map(|d| (1i64 << n) + d)) {
            let length = 64 - (v - 1).max(0).leading_zeros() as i32;
            for v in [v, -v].map(|v| v as i32) {
                for other in [0, v / 2, -v / 2, v, -v] {
                    assert_eq!(shift_to_fit([v, other, 0], 14), 14 - length, "{v}");
                    assert_eq!(shift_to_fit([other, 0, v], 14), 14 - length, "{v}");
                }
            }
        }
    }
}

//! Clip planes as edge functions: a plane is one more linear function over the triangle, never a
//! new vertex (Olano & Greer 1997, section 5.3).
//!
//! At a covered pixel the surface point is `sum(k_i p_i E_i) / sum(k_i E_i)`, with `E_i >= 0` the
//! edge functions and `k_i > 0` the vertices' scales. So `sum(k_i n(p_i) E_i)` has the sign of the
//! plane function `n` there, and it is linear on the screen: the pseudo-parameter vector of the
//! paper.
//!
//! Bit budget: each `k_i n(p_i)` is cut to 32 significant bits, one part in 2^29 off at most, and
//! all three are integers of at most 62 bits on one scale; times an edge function of 61 bits (one
//! pixel outside of the viewport: 62), summed, that is below 2^126: `i128`. Bits that the common
//! scale drops are 2^-61 of the largest. So a pixel may be decided wrongly only where the exact
//! `n . p` is within 2^-28 of the largest `|n . p_i|` of the triangle's vertices; the contract asks
//! for 2^-12. Only triangles that cross a plane pay.
//!
//! `p_i` is the vertex that came in, before it was snapped; but the hither plane looks at the snapped
//! `w`, which is what `1 / w` is interpolated from. On the exact tier's grid both are the same.

use crate::math::{Scale, Signed, align, combine};
use crate::setup::{Segment, Setup};
use crate::vertex::{ClipVertex, Outside, Position, ScaleOf, Snap, Snapped, Vertex};
use fixed::types::I16F16;

/// What is kept along `w`: a type, so that a scene without a hither plane has no code for one.
///
/// Implemented by [`NoHither`], [`BothSides`] and [`Hither`].
pub trait WRange: Copy + core::fmt::Debug {
    /// Whether there is a plane.
    const CLIPS: bool;
    /// Whether the part behind the eye is drawn too.
    const BEHIND: bool;
    /// The least `w` that is in front, raw Q16.16: the hither distance, or 1.
    fn least_w(&self) -> i64;
}

/// No hither plane: the part in front of the eye, down to the eye itself. For flat colour without
/// depth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NoHither;

/// No hither plane, and both parts of an external triangle: the one in front of the eye and its
/// mirror image behind (the footnote in section 5.1 of the paper).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BothSides;

/// The hither plane `w >= distance`: the one clip plane that perspective and depth need, since it
/// bounds `1 / w`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hither {
    raw: i32,
}

impl Hither {
    /// A plane at `distance`, in the units of `w`.
    ///
    /// # Errors
    ///
    /// [`HitherDistance`] where `distance` is not positive.
    #[inline]
    pub const fn new(distance: I16F16) -> Result<Self, HitherDistance> {
        let raw = distance.to_bits();
        if raw > 0 { Ok(Self { raw }) } else { Err(HitherDistance { distance }) }
    }

    /// The distance, raw Q16.16; positive.
    #[inline]
    pub(crate) const fn raw(self) -> i32 {
        self.raw
    }
}

impl WRange for NoHither {
    const CLIPS: bool = false;
    const BEHIND: bool = false;

    #[inline]
    fn least_w(&self) -> i64 {
        1
    }
}

impl WRange for BothSides {
    const CLIPS: bool = false;
    const BEHIND: bool = true;

    #[inline]
    fn least_w(&self) -> i64 {
        1
    }
}

impl WRange for Hither {
    const CLIPS: bool = true;
    const BEHIND: bool = false;

    #[inline]
    fn least_w(&self) -> i64 {
        i64::from(self.raw)
    }
}

/// A hither distance is 0 or negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HitherDistance {
    /// The distance asked for.
    pub distance: I16F16,
}

impl core::fmt::Display for HitherDistance {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "a hither plane at w = {}: it must be above 0", self.distance)
    }
}

impl core::error::Error for HitherDistance {}

/// A clip plane: what has `a x + b y + c z + d w >= 0` in clip space is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plane {
    /// At most 2^28 in magnitude, so that a distance fits `i64`.
    normal: [i32; 4],
}

impl Plane {
    /// A plane from its four coefficients. Only their ratios matter; those beyond ±4096 are scaled
    /// down together, to one part in 2^28.
    #[must_use]
    pub fn new(coefficients: [I16F16; 4]) -> Self {
        let raw = coefficients.map(I16F16::to_bits);
        let all = raw.iter().fold(0, |all, v| all | v.unsigned_abs());
        let shift = 4u32.saturating_sub(all.leading_zeros());
        Self { normal: raw.map(|v| v >> shift) }
    }

    /// `n . p` of the raw coordinates: at most 2^61.
    #[inline]
    pub(crate) fn distance(&self, vertex: &ClipVertex) -> i64 {
        let ([a, b, c, d], [x, y, z, w]) = (self.normal, vertex.raw);
        let product = |n: i32, v: i32| i64::from(n) * i64::from(v);
        product(a, x) + product(b, y) + product(c, z) + product(d, w)
    }
}

/// A linear function of the pixel, as rows follow it down: what it leaves of a row begins at the first column where it is
/// 0 or more, or ends before it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HalfPlane<I> {
    /// What a pixel to the right adds: not negative.
    pub(crate) a: I,
    /// What a pixel down adds.
    pub(crate) b: I,
    pub(crate) value: I,
    pub(crate) begins: bool,
}

/// The edge function of a plane with values `values[i] = k_i n(p_i)`, over an oriented setup, at a pixel.
///
/// Where it decreases along a row it is that of `-n`, less 1.
#[inline(never)]
fn half_plane(setup: &Setup, values: &[Signed; 3], x: i32, y: i32) -> HalfPlane<i128> {
    let (mut values, _) = align(values);
    let mut a = combine(&values, &setup.across());
    let begins = a >= 0;
    if !begins {
        a = -a;
        let [u, v, w] = values;
        values = [-u, -v, -w];
    }
    let b = combine(&values, &setup.down());
    let value = combine(&values, &setup.edges_at(x, y)) - i128::from(!begins);
    HalfPlane { a, b, value, begins }
}

/// Leaves what is inside of a plane of a line with values `[k_i n(p_i)]` at its ends. The pixel of an end whose centre is beyond
/// it is left where the end is inside.
#[inline(never)]
fn cut(segment: &mut Segment, [u, v]: [Signed; 2]) {
    let [uw, vw] = segment.w();
    let (values, _) = align(&[u, v, Signed::of(0)]);
    let step = combine(&values, &segment.weight_steps());
    let value = combine(&values, &segment.weights(segment.from));
    let begins = step >= 0;
    let [(low, low_w), (high, high_w)] =
        if begins { [(u, uw), (v, vw)] } else { [(v, vw), (u, uw)] };
    // At an end in front the function is of the end's own sign: all is inside if that is the lower one, nothing if it is
    // outside at the higher one.
    let all = low_w > 0 && !low.negative;
    let nothing = high_w > 0 && high.negative;
    if nothing {
        segment.to = segment.from;
    } else if !all {
        // `!v` is `-v - 1`: 0 or more where `v` is negative.
        let (value, step) = if begins { (value, step) } else { (!value, -step) };
        segment.cut(value, step, begins);
    }
}

/// Leaves what is inside of the planes that a bit of `outside` names of a line between two vertices in the segment's order:
/// the steps at whose centres it is, decided as well as a pixel of a triangle is.
#[inline(never)]
pub(crate) fn cut_line<T: Snap, const N: usize, const P: usize>(
    segment: &mut Segment,
    [a, b]: [&Vertex<T, N, P>; 2],
    hither: Option<Hither>,
    outside: Outside,
) {
    if let Some(hither) = hither.filter(|_| outside.0 & Outside::HITHER != 0) {
        let value = |vertex: &Vertex<T, N, P>| above_hither(&vertex.position, hither);
        cut(segment, [value(a), value(b)]);
    }
    for i in 0..P {
        if outside.0 & (Outside::FIRST_PLANE << i) != 0 {
            cut(segment, [above_plane(a, i), above_plane(b, i)]);
        }
    }
}

/// `k n(p)` of a vertex, for clip plane `i`.
#[inline(never)]
fn above_plane<T: Snap, const N: usize, const P: usize>(
    vertex: &Vertex<T, N, P>,
    i: usize,
) -> Signed {
    let ScaleOf(k) = vertex.position.scale();
    let distance = vertex.distances.get(i).map_or(0, |distance| distance.get());
    let raw = Scale::power_of_two(i32::from(vertex.shift));
    Signed::of(distance).times(k).times(raw)
}

/// `k (w - h)` of a snapped vertex.
#[inline(never)]
fn above_hither<P: Position>(position: &P, hither: Hither) -> Signed {
    let h = i64::from(hither.raw());
    match position.homogeneous() {
        // k w is exactly half a pixel's subpixels, k h at most that: Q40.
        Snapped::Projected { .. } => {
            let ScaleOf(k) = position.scale();
            let value = (i64::from(position.scaled_w()) << 40) - k.apply(h, 40);
            Signed::of(value).times(Scale::power_of_two(-40))
        }
        // w 2^-shift - h, without rounding: 52 bits, or 61.
        Snapped::Homogeneous { point: [_, _, w], shift } => {
            let (value, exponent) = if shift >= 0 {
                (i64::from(w) - (h << shift), 0)
            } else if shift >= -40 {
                ((i64::from(w) << -shift) - h, shift)
            } else {
                // h is below 2^-9 of the grid's step.
                ((i64::from(w) << 10) - 1, -10)
            };
            Signed::of(value).times(Scale::power_of_two(exponent))
        }
    }
}

/// The edge function of the hither plane, at a pixel.
#[inline(never)]
pub(crate) fn hither_edge<T: Snap, const N: usize, const P: usize>(
    setup: &Setup,
    vertices: [&Vertex<T, N, P>; 3],
    hither: Hither,
    (x, y): (i32, i32),
) -> HalfPlane<i128> {
    let [a, b, c] = vertices;
    let value = |vertex: &Vertex<T, N, P>| above_hither(&vertex.position, hither);
    let values = [value(a), value(b), value(c)];
    half_plane(setup, &values, x, y)
}

/// The edge function of clip plane `i`, at a pixel.
#[inline(never)]
pub(crate) fn plane_edge<T: Snap, const N: usize, const P: usize>(
    setup: &Setup,
    vertices: [&Vertex<T, N, P>; 3],
    i: usize,
    (x, y): (i32, i32),
) -> HalfPlane<i128> {
    let [a, b, c] = vertices;
    let values = [above_plane(a, i), above_plane(b, i), above_plane(c, i)];
    half_plane(setup, &values, x, y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plane_coefficients_keep_their_ratios() {
        let all = |v: [i32; 4]| Plane::new(v.map(I16F16::from_bits)).normal;
        assert_eq!(all([1024, -1024, 3, 0]), [1024, -1024, 3, 0]);
        assert_eq!(all([1 << 28, 0, 0, 0])[0], 1 << 27);
        assert_eq!(all([i32::MIN, i32::MAX, 16, 0]), [-(1 << 27), (1 << 27) - 1, 1, 0]);
        let far = ClipVertex { raw: [i32::MIN; 4], shift: 0 };
        assert_eq!(Plane::new([I16F16::MIN; 4]).distance(&far), 1 << 60);
    }
}

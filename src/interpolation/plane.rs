//! Varyings that are linear on the screen, stepped from the first of three projected vertices.
//!
//! With `d_i = u_i - u_0`, `u = u_0 + (d_1 E_1 + d_2 E_2) / D`: two gradients a varying, and no division after
//! setup. That is what affine asks for, and what perspective is where all `w` are the same. Where they
//! differ a little, by at most a factor `r`, a straight line is off by up to `(sqrt r - 1) / (sqrt r + 1) <
//! (r - 1) / 4` of a varying's range.
//!
//! Bit budget and error, with differences below `2^e` raw steps, `e <= 20`:
//! - a weight's gradient is at most a quarter a pixel, Q32, within 2^-28 of itself; steeper ones are left to
//!   the edge functions;
//! - a gradient is rounded to 2^-31 of `2^e`; a covered pixel is up to 1536 pixels away from the vertex each
//!   way (the guard band and the viewport), so a value is off by 2 1536 (2^-30 + 2^-31) < 2^-18 of `2^e`, less
//!   than 4 raw steps;
//! - in raw steps times 2^32 a gradient is below 2^50, and a vertex's distance from a pixel's centre 2^8
//!   subpixels and 2^11 pixels: products below 2^61. Their sums are taken modulo 2^64; at covered pixels
//!   they are values, which fit.

use super::{Ramp, Varying, weight_step};
use crate::clip::Hither;
use crate::math::{Scale, bits, low};
use crate::setup::Setup;
use crate::span::Span;
use crate::vertex::{Position, ScaleOf, Snap, Snapped, Vertex};
use fixed::types::I16F16;

/// Varyings that are linear on the screen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Planes<const N: usize> {
    each: [Plane; N],
}

/// A linear function on the screen: of a varying in raw steps times 2^32, with half a step in it; of a
/// numerator or of `q` in Q[`NUMERATOR_BITS`].
#[derive(Clone, Copy, Debug, Default)]
struct Plane {
    /// At the centre of pixel (0, 0).
    at_origin: i64,
    /// A pixel to the right.
    x: i64,
    /// A pixel down.
    y: i64,
}

/// The largest gradient of a weight, Q32 a pixel: a quarter.
const GENTLE: i64 = 1 << 30;

/// Differences are below `2^WIDEST` raw steps: 16.
const WIDEST: u32 = 20;

/// How far off a straight line may be, as a power of two of raw steps: 2^-9.
const STRAIGHT_BITS: u32 = 7;

/// Where a vertex is from the centre of pixel (0, 0), along one axis.
#[derive(Clone, Copy, Debug)]
struct Back {
    /// Whole pixels, floored.
    pixels: i64,
    /// The rest, in subpixels.
    rest: i64,
    subpixel_bits: u32,
}

impl Back {
    #[inline]
    fn new(vertex: i32, subpixel_bits: u32) -> Self {
        let back = (1 << (subpixel_bits - 1)) - vertex;
        let pixels = back >> subpixel_bits;
        let rest = back - (pixels << subpixel_bits);
        Self { pixels: i64::from(pixels), rest: i64::from(rest), subpixel_bits }
    }

    /// A gradient over the distance.
    #[inline]
    fn times(self, gradient: i64) -> i64 {
        let rest = (gradient * self.rest) >> self.subpixel_bits;
        gradient.wrapping_mul(self.pixels).wrapping_add(rest)
    }
}

impl Plane {
    /// The function that has a value at a vertex, and these gradients.
    #[inline]
    fn through(value: i64, [x, y]: [i64; 2], [back_x, back_y]: [Back; 2]) -> Self {
        let at_origin = value.wrapping_add(back_x.times(x)).wrapping_add(back_y.times(y));
        Self { at_origin, x, y }
    }

    /// Its value at the centre of a pixel.
    #[inline]
    fn at(&self, x: i32, y: i32) -> i64 {
        let (x, y) = (self.x.wrapping_mul(i64::from(x)), self.y.wrapping_mul(i64::from(y)));
        self.at_origin.wrapping_add(x).wrapping_add(y)
    }
}

/// Where a projected vertex is, for both axes.
#[inline]
fn back_from<T: Snap, const N: usize, const P: usize>(
    vertex: &Vertex<T, N, P>,
) -> Option<[Back; 2]> {
    match vertex.snapped() {
        Snapped::Projected { point: [x, y], subpixel_bits } => {
            Some([Back::new(x, subpixel_bits), Back::new(y, subpixel_bits)])
        }
        Snapped::Homogeneous { .. } => None,
    }
}

/// Numerators and `q` of a triangle in perspective, for pieces: `1 / w` and `u / w` are linear on the screen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Numerators<const N: usize> {
    n: [Plane; N],
    q: Plane,
}

/// Fraction bits of numerators and `q`: 16 more than are divided, for the steps that add up. A value is off
/// by up to 2 1536 2^-33 < 2^-21, the rounding of the weights' gradients.
const NUMERATOR_BITS: u32 = 46;

impl<const N: usize> Numerators<N> {
    /// The planes through three projected vertices, whose weights are `scale[i] E_i`, where they are exact
    /// enough.
    #[inline]
    pub(super) fn new<T: Snap, const P: usize>(
        setup: &Setup,
        vertex: &Vertex<T, N, P>,
        hither: Hither,
        scale: [Scale; 3],
        each: &[Varying; N],
    ) -> Option<Self> {
        if !setup.projected {
            return None;
        }
        let back = back_from(vertex)?;
        let gradients = |edges: [i64; 3]| {
            let ([s0, s1, s2], [e0, e1, e2]) = (scale, edges.map(|e| e << setup.step));
            let all = [weight_step(s0, e0), weight_step(s1, e1), weight_step(s2, e2)];
            all.iter().all(|g| g.abs() <= GENTLE).then_some(all)
        };
        let (across, down) = (gradients(setup.a)?, gradients(setup.b)?);
        // At the vertex every numerator is 0, and q is h k / (k w).
        let ScaleOf(k) = vertex.position.scale();
        let halves = vertex.position.scaled_w().trailing_zeros();
        let q = k.apply(i64::from(hither.raw()), bits(NUMERATOR_BITS) - bits(halves));
        let sum = |g: [i64; 3]| (g[0] + g[1] + g[2]) << (NUMERATOR_BITS - 32);
        let mut planes =
            Self { n: [Plane::default(); N], q: Plane::through(q, [sum(across), sum(down)], back) };
        for (plane, varying) in planes.n.iter_mut().zip(each) {
            let gradient = |[_, g1, g2]: [i64; 3]| {
                let [d1, d2] = varying.differences.map(i64::from);
                (d1 * g1 + d2 * g2) >> (62 - NUMERATOR_BITS)
            };
            *plane = Plane::through(0, [gradient(across), gradient(down)], back);
        }
        Some(planes)
    }

    /// Numerators and `q` at a covered pixel, Q30.
    #[inline]
    pub(super) fn at(&self, x: i32, y: i32) -> ([i32; N], i32) {
        let at = |plane: &Plane| low(plane.at(x, y) >> (NUMERATOR_BITS - 30));
        let mut n = [0; N];
        for (n, plane) in n.iter_mut().zip(&self.n) {
            *n = at(plane);
        }
        (n, at(&self.q))
    }
}

impl<const N: usize> Planes<N> {
    /// The planes through three projected vertices, where they are exact enough; of varyings that are not
    /// `linear` where straight lines are.
    #[inline]
    pub(super) fn new<T: Snap, const P: usize>(
        setup: &Setup,
        vertices: [&Vertex<T, N, P>; 3],
        linear: bool,
    ) -> Option<Self> {
        let back = back_from(vertices[0])?;
        // All three have the same k w.
        let w = Scale::of(u64::from(vertices[0].position.scaled_w().unsigned_abs()));
        let scale = w.times(setup.inverse);
        let gradients = |[_, e1, e2]: [i64; 3]| {
            let each = [e1, e2].map(|e| weight_step(scale, e << setup.step));
            each.iter().all(|g| g.abs() <= GENTLE).then_some([0, each[0], each[1]])
        };
        let (across, down) = (gradients(setup.a)?, gradients(setup.b)?);
        let mut planes = Self { each: [Plane::default(); N] };
        let mut widest = 0;
        let [v0, v1, v2] = vertices.map(|v| v.varyings.map(I16F16::to_bits));
        for (((plane, u0), u1), u2) in planes.each.iter_mut().zip(v0).zip(v1).zip(v2) {
            let varying = Varying::new([u0, u1, u2], across);
            if varying.exponent > WIDEST || u0.unsigned_abs() >= 1 << 30 {
                return None;
            }
            widest = widest.max(varying.exponent);
            let gradient = [varying.fixed(varying.step), varying.fixed(varying.numerator(down))];
            *plane = Plane::through(varying.start(), gradient, back);
        }
        (linear || is_straight(vertices, widest)).then_some(planes)
    }

    /// The values along a block.
    #[inline]
    pub(super) fn ramp(&self, block: Span) -> Ramp<N> {
        let mut ramp = Ramp { at: [0; N], step: [0; N] };
        for ((at, step), plane) in ramp.at.iter_mut().zip(&mut ramp.step).zip(&self.each) {
            (*at, *step) = (plane.at(block.x0, block.y), plane.x);
        }
        ramp
    }
}

/// Whether a straight line is off by less than `2^STRAIGHT_BITS` raw steps where differences are below
/// `2^widest`: `(k_max / k_min - 1) / 4 2^widest`, as `k` is as `1 / w`.
#[inline]
fn is_straight<T: Snap, const N: usize, const P: usize>(
    vertices: [&Vertex<T, N, P>; 3],
    widest: u32,
) -> bool {
    let scales = vertices.map(|v| {
        let ScaleOf(k) = v.position.scale();
        k
    });
    let least = scales.iter().map(|k| k.exponent).min().unwrap_or(0);
    // All within a factor of 2^8: below 2^40.
    let mut values = [0; 3];
    for (value, k) in values.iter_mut().zip(scales) {
        let up = (k.exponent - least).unsigned_abs();
        if up > 8 {
            return false;
        }
        *value = u64::from(k.mantissa) << up;
    }
    let [a, b, c] = values;
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    (high - low) << widest <= low << (STRAIGHT_BITS + 2)
}

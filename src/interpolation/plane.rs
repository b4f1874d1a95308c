//! Varyings of a projected triangle, by planes: linear on the screen, or divided at the ends of straight pieces.
//!
//! Linear is what affine asks for, and what perspective is where all `w` are the same. Where they differ a little, by
//! at most a factor `r`, a straight line is off by up to `(sqrt r - 1) / (sqrt r + 1) < (r - 1) / 4` of a varying's
//! range.
//!
//! Values are in raw steps times 2^8, modulo 2^32: varyings beyond 127 have no planes. A plane is off by less than
//! 2^13 of those in boxes below 512 px: 2^-11 of one, where its gradient takes all bits; in practice a part of
//! that, as gradients of `[0, 1]` over a box of `2^n` pixels are `2^(24 - n)`, far from the 2^32 that are there.
//!
//! Pieces have planes for `q = h / w` and the numerators `n = (u - u_0) q`, Q30, both at most 1 in magnitude: off by
//! less than 2^13 2^-30 = 2^-17, divided by `q` at the ends of a piece. A value between is on the line through
//! both ends, to a 2^-8 of a raw step a pixel.

use super::{Inverse, ONE, Run, Varying, per_pixel};
use crate::clip::Hither;
use crate::math::{bits, low, signed, unsigned};
use crate::setup::{Plane, Slopes};
use crate::vertex::{Position, ScaleOf, Snap, Vertex};
use fixed::types::I16F16;

/// Varyings have planes below this, raw: 2^-8 less than 128.
const LIMIT: i32 = (1 << 23) - (1 << 8);

/// Varyings that are linear on the screen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Linear<const N: usize> {
    each: [Plane; N],
}

/// Varyings along a straight line, in raw steps times 2^8.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line<const N: usize> {
    at: [u32; N],
    step: [u32; N],
}

/// Perspective, divided at the ends of pieces of `every` pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pieces<const N: usize> {
    n: [Plane; N],
    q: Plane,
    each: [Varying; N],
}

/// `h / w` at the three vertices, Q30.
pub(crate) type Nearness = [u32; 3];

/// `h / w` of a projected vertex, Q30: at most 1.
#[inline]
fn nearness<T: Snap, const N: usize, const P: usize>(v: &Vertex<T, N, P>, hither: Hither) -> u32 {
    let ScaleOf(k) = v.position.scale();
    // k w is a power of two; h k below 2^63.
    let shift = bits(v.position.scaled_w().trailing_zeros()) - 30 - k.exponent;
    let product = u64::from(unsigned(hither.raw())) * u64::from(k.mantissa);
    let q = product.checked_shr(unsigned(shift)).unwrap_or(0);
    u32::try_from(q).map_or(unsigned(ONE), |q| q.min(unsigned(ONE)))
}

/// [`Nearness`] of a triangle, all three in front of the hither plane.
#[inline]
pub(crate) fn nearness_of<T: Snap, const N: usize, const P: usize>(
    vertices: [&Vertex<T, N, P>; 3],
    hither: Hither,
) -> Nearness {
    vertices.map(|v| nearness(v, hither))
}

/// The varyings of three vertices as raw numbers, one after the other, where all have planes.
#[inline]
fn raw<T: Snap, const N: usize, const P: usize>(
    vertices: [&Vertex<T, N, P>; 3],
) -> Option<[[i32; 3]; N]> {
    let [a, b, c] = vertices.map(|v| &v.varyings);
    let mut all = [[0; 3]; N];
    let mut within = true;
    for (((raw, a), b), c) in all.iter_mut().zip(a).zip(b).zip(c) {
        *raw = [a.to_bits(), b.to_bits(), c.to_bits()];
        within &= raw.iter().all(|u| unsigned(u.wrapping_add(LIMIT)) <= unsigned(2 * LIMIT));
    }
    within.then_some(all)
}

/// Whether straight lines on the screen are off by at most `tolerance` raw steps.
#[inline]
pub(crate) fn is_straight<T: Snap, const N: usize, const P: usize>(
    vertices: [&Vertex<T, N, P>; 3],
    q: Nearness,
    tolerance: u32,
) -> bool {
    let least = q[0].min(q[1]).min(q[2]);
    let most = q[0].max(q[1]).max(q[2]);
    if most == least {
        return true;
    }
    let Some(all) = raw(vertices) else {
        return false;
    };
    let mut widest = 0;
    for [u, v, w] in all {
        widest = widest.max(u.max(v).max(w) - u.min(v).min(w));
    }
    u64::from(most - least) * u64::from(unsigned(widest))
        <= u64::from(least) * 4 * u64::from(tolerance)
}

impl<const N: usize> Linear<N> {
    /// The planes through three vertices, where they have some.
    #[inline]
    pub(crate) fn new<T: Snap, const P: usize>(
        slopes: &Slopes,
        vertices: [&Vertex<T, N, P>; 3],
    ) -> Option<Self> {
        let mut each = [Plane::default(); N];
        for (plane, [u, v, w]) in each.iter_mut().zip(raw(vertices)?) {
            // Half a step, for rounding to nearest.
            let value = unsigned((u << 8) + (1 << 7));
            *plane = slopes.plane(value, [(v - u) << 7, (w - u) << 7])?;
        }
        Some(Self { each })
    }

    /// The same, some pixels further to the right and down.
    #[inline]
    pub(crate) fn moved(self, columns: i32, rows: i32) -> Self {
        Self { each: self.each.map(|plane| plane.moved(columns, rows)) }
    }

    /// The values from a pixel on.
    #[inline]
    pub(crate) fn line(&self, x: i32, y: i32) -> Line<N> {
        Line { at: self.each.map(|plane| plane.at(x, y)), step: self.each.map(|plane| plane.x) }
    }
}

impl<const N: usize> Pieces<N> {
    /// The planes through three vertices, where they have some.
    #[inline]
    pub(crate) fn new<T: Snap, const P: usize>(
        slopes: &Slopes,
        vertices: [&Vertex<T, N, P>; 3],
        q: Nearness,
    ) -> Option<Self> {
        let [q0, q1, q2] = q.map(signed);
        let q = slopes.plane(unsigned(q0), [(q1 - q0) >> 1, (q2 - q0) >> 1])?;
        let mut pieces = Self { n: [Plane::default(); N], q, each: [Varying::default(); N] };
        let planes = pieces.n.iter_mut().zip(&mut pieces.each);
        for ((plane, varying), values) in planes.zip(raw(vertices)?) {
            *varying = Varying::new(values, [0; 3]);
            let [d1, d2] = varying.differences;
            let half = |d: i32, q: i32| low((i64::from(d) * i64::from(q)) >> 31);
            *plane = slopes.plane(0, [half(d1, q1), half(d2, q2)])?;
        }
        Some(pieces)
    }

    /// The values at a covered pixel, raw.
    #[inline]
    pub(crate) fn at(&self, x: i32, y: i32) -> [i32; N] {
        let inverse = Inverse::new(self.q.signed_at(x, y));
        let mut values = [0; N];
        for ((value, plane), varying) in values.iter_mut().zip(&self.n).zip(&self.each) {
            let quotient = varying.limited(inverse.quotient(plane.signed_at(x, y)));
            *value = varying.value(quotient).to_bits();
        }
        values
    }
}

impl<const N: usize> Line<N> {
    /// From raw values `first` to those `steps` pixels on, 0 to 64.
    #[inline]
    pub(crate) fn through(first: [i32; N], last: [i32; N], steps: i32) -> Self {
        let mut line = Self { at: [0; N], step: [0; N] };
        for (((at, step), first), last) in
            line.at.iter_mut().zip(&mut line.step).zip(first).zip(last)
        {
            let (first, last) = (first << 8, last << 8);
            *at = unsigned(first + (1 << 7));
            *step = unsigned(per_pixel(last, first, steps));
        }
        line
    }
}

impl<const N: usize> Run<N> for Line<N> {
    #[inline]
    fn varyings(&self) -> [I16F16; N] {
        self.at.map(|at| I16F16::from_bits(signed(at) >> 8))
    }

    #[inline]
    fn step(&mut self) {
        for (at, step) in self.at.iter_mut().zip(self.step) {
            *at = at.wrapping_add(step);
        }
    }
}

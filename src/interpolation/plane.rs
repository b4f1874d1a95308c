//! Varyings of a projected triangle, by planes: linear on the screen, or divided at the ends of straight pieces.
//!
//! Linear is what affine asks for, and what perspective is where all `w` are the same. Where they differ a little, by
//! at most a factor `r`, a straight line is off by up to `(sqrt r - 1) / (sqrt r + 1) < (r - 1) / 4` of a varying's
//! range.
//!
//! Values are in raw steps times 2^8, modulo 2^32: varyings beyond 127 have no planes. A plane is off by less than
//! 2^13 of those in boxes below 512 px (2^14 where they are very thin): 2^-11 of one, where its gradient takes all bits; in practice a part of
//! that, as gradients of `[0, 1]` over a box of `2^n` pixels are `2^(24 - n)`, far from the 2^32 that are there.
//!
//! Pieces have planes for `q = h / w` and the numerators `n = (u - u_0) q`, Q30, both at most 1 in magnitude: off by
//! less than 2^13 2^-30 = 2^-17, divided by `q` at the ends of a piece, and kept between the vertices' values. A
//! value between is on the line through both ends, to a 2^-8 of a raw step a pixel.

use super::{ONE, Reciprocal, Run, per_pixel};
use crate::clip::Hither;
use crate::math::{bits, high, high_product, low, normalized, product, signed, unsigned};
use crate::setup::{Plane, Slopes, Tier};
use crate::vertex::{Position, ScaleOf, Snap, Vertex};
use core::marker::PhantomData;
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

/// Perspective, divided at the ends of pieces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pieces<R, const N: usize> {
    q: Plane,
    each: [Numerator; N],
    reciprocal: PhantomData<R>,
}

/// One varying of [`Pieces`].
#[derive(Clone, Copy, Debug, Default)]
struct Numerator {
    /// `(u - u_0) q`, Q30 in units of `2^exponent` raw steps.
    n: Plane,
    /// `u_0`, raw.
    base: i32,
    /// 1 to 24: no difference is larger.
    exponent: u32,
    /// What quotients are between: the least and the largest difference, or 0. Q29 in the same units.
    limits: [i32; 2],
}

impl Numerator {
    /// Of a varying's raw values, and `q` at vertices 1 and 2.
    #[inline]
    fn new(slopes: &Slopes, [u, v, w]: [i32; 3], q: [i32; 2]) -> Self {
        let differences = [v - u, w - u];
        let [d1, d2] = differences.map(|d| unsigned(d ^ d >> 31));
        // Below 2^24.
        let (_, zeros) = normalized(d1 | d2 | 1);
        let exponent = 32 - zeros;
        let [d1, d2] = differences.map(|d| d << (30 - exponent));
        let half = |d: i32, q: i32| low(product(d, q) >> 31);
        let n = slopes.plane(0, [half(d1, q[0]), half(d2, q[1])]);
        let limits = [d1.min(d2).min(0) >> 1, (d1.max(d2).max(0) + 1) >> 1];
        Self { n, base: u, exponent, limits }
    }

    /// The value for a quotient, Q29: raw.
    #[inline]
    fn value(&self, quotient: i32) -> i32 {
        let [low, high] = self.limits;
        let quotient = quotient.max(low).min(high);
        self.base + (((quotient >> (28 - self.exponent)) + 1) >> 1)
    }
}

/// `h / w` at the three vertices, Q30.
pub(crate) type Nearness = [u32; 3];

/// [`Nearness`] of a triangle of projected vertices, all three in front of the hither plane.
#[inline]
pub(crate) fn nearness_of<T: Tier, const N: usize, const P: usize>(
    vertices: [&Vertex<T, N, P>; 3],
    hither: Hither,
) -> Nearness {
    let (h, zeros) = normalized(unsigned(hither.raw()));
    vertices.map(|v| {
        let ScaleOf(k) = v.position.scale();
        // k w is 2^(S - 1). Both factors are at least 2^31, and h / w at most 1: what is left to shift is not negative.
        let shift = bits(T::SUBPIXEL_BITS + zeros) - 63 - k.exponent;
        let product = high(u64::from(h) * u64::from(k.mantissa));
        (product >> unsigned(shift).min(31)).min(unsigned(ONE))
    })
}

/// The varyings of three vertices as raw numbers, one after the other, where all have planes.
#[inline]
pub(super) fn raw<T: Snap, const N: usize, const P: usize>(
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
    let [a, b, c] = vertices.map(|v| &v.varyings);
    let mut widest = 0;
    for ((a, b), c) in a.iter().zip(b).zip(c) {
        let [u, v, w] = [a, b, c].map(|u| u.to_bits());
        // Below 2^32, whatever they are.
        widest = widest.max(unsigned(u.max(v).max(w).wrapping_sub(u.min(v).min(w))));
    }
    u64::from(most - least) * u64::from(widest) <= u64::from(least) * 4 * u64::from(tolerance)
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
            *plane = slopes.plane(value, [(v - u) << 7, (w - u) << 7]);
        }
        Some(Self { each })
    }

    /// The values at a pixel and their steps, modulo 1, in one word: see [`word`].
    #[inline]
    pub(crate) fn wrapped(&self, x: i32, y: i32) -> [u32; 2] {
        let at = self.each.map(|plane| plane.signed_at(x, y) >> 8);
        let step = self.each.map(|plane| signed(plane.x.wrapping_add(1 << 7)) >> 8);
        [word(at), word(step)]
    }

    /// The values from a pixel on.
    #[inline]
    pub(crate) fn line(&self, x: i32, y: i32) -> Line<N> {
        Line { at: self.each.map(|plane| plane.at(x, y)), step: self.each.map(|plane| plane.x) }
    }
}

impl<R: Reciprocal, const N: usize> Pieces<R, N> {
    /// The planes through three vertices, where they have some.
    #[inline]
    pub(crate) fn new<T: Snap, const P: usize>(
        slopes: &Slopes,
        vertices: [&Vertex<T, N, P>; 3],
        q: Nearness,
    ) -> Option<Self> {
        let [q0, q1, q2] = q.map(signed);
        let q = slopes.plane(unsigned(q0), [(q1 - q0) >> 1, (q2 - q0) >> 1]);
        let mut pieces = Self { q, each: [Numerator::default(); N], reciprocal: PhantomData };
        for (numerator, values) in pieces.each.iter_mut().zip(raw(vertices)?) {
            *numerator = Numerator::new(slopes, values, [q1, q2]);
        }
        Some(pieces)
    }

    /// The values at a covered pixel, raw. Where `q` is within what its plane is off, they are any between the
    /// vertices'.
    #[inline(never)]
    pub(crate) fn at(&self, x: i32, y: i32) -> [i32; N] {
        let q = unsigned(self.q.signed_at(x, y).max(1));
        let (normal, zeros) = normalized(q);
        // 2^62 / (q 2^zeros), 31 bits.
        let inverse = signed(R::of(normal) >> 1);
        let mut values = [0; N];
        for (value, numerator) in values.iter_mut().zip(&self.each) {
            // |n| <= q.
            let n = numerator.n.signed_at(x, y).wrapping_shl(zeros.wrapping_sub(1));
            *value = numerator.value(high_product(n, inverse));
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

/// Raw values modulo 1, 16 bits each, the first lowest. Sums of such words are words of sums, but for a carry from one
/// to the next: 2^-16.
#[inline]
pub(super) fn word<const N: usize>(values: [i32; N]) -> u32 {
    values.iter().rev().fold(0, |word: u32, &value| (word << 16).wrapping_add_signed(value))
}

/// The word of a pixel's values, and its step to those `steps` pixels on, 0 to 64.
#[inline]
pub(crate) fn wrapped<const N: usize>(first: [i32; N], last: [i32; N], steps: i32) -> [u32; 2] {
    let mut step = [0; N];
    for ((step, first), last) in step.iter_mut().zip(first).zip(last) {
        *step = per_pixel(last, first, steps);
    }
    [word(first), word(step)]
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::doubled_area;
    use crate::vertex::{ClipVertex, Quick, Viewport};

    /// Steps of a word are rounded from gradients modulo 2^32, of which any may be next to the end of the range.
    #[test]
    fn the_last_gradient_is_rounded() {
        let corners = [[300, 300], [1955, 1836], [1352, 1068]];
        let viewport = Viewport::new(16, 16).unwrap();
        let vertices = [0, -3_319_162, 5_696_835].map(|u| {
            let clip = ClipVertex { raw: [0, 0, 0, 2048], shift: 0 };
            let position = Quick::<8>::snap(&clip, 1, &viewport);
            let (outside, varyings) = (crate::vertex::Outside(0), [I16F16::from_bits(u)]);
            Vertex::<Quick<8>, 1> { position, z: 0, shift: 0, outside, varyings, distances: [] }
        });
        let area = doubled_area(&corners);
        let slopes = Slopes::new(&corners, area, 8).unwrap();
        let [a, b, c] = &vertices;
        let linear = Linear::new(&slopes, [a, b, c]).unwrap();
        let [_, step] = linear.wrapped(3, 3);
        assert_eq!(step & 0xffff, (linear.each[0].x.wrapping_add(128) >> 8) & 0xffff);
    }

    #[test]
    fn pieces_pass_neither_end() {
        for difference in [-100_000, -17, -16, -1, 0, 1, 5, 16, 99_999] {
            for steps in 1..=64 {
                let [first, step] = wrapped([1000, 0], [1000 + difference, 1000], steps);
                assert_eq!(first, word([1000, 0]));
                let low = signed(step << 16) >> 16;
                let per = |d: i32| d / steps;
                assert_eq!(low, (per(difference) << 16) >> 16, "{difference} in {steps}");
            }
        }
    }
}

//! Perspective on the fractions of varyings, along lines that bend: what a repeating texture is read with.
//!
//! Along a row `u = n / q` with `n` and `q` linear, so its slope goes with `1 / q^2`. A straight line between two exact
//! values is off by `e = (u_1 - u_0)(q_1 - q_0) / (2 (q_0 + q_1))` in its middle. An arc is one of [`LONG`] pixels that
//! bends every [`SHORT`] by what the slope changes by there: a parabola's chords, a division each [`LONG`]. Its step is
//! then such that it ends where it should. Where `q` changes by more than half of itself along an arc, straight pieces of
//! [`SHORT`] pixels take its place.
//!
//! | value | format |
//! | --- | --- |
//! | `q`, a part of the largest at a vertex | Q31, unsigned: that one is in `[2^30, 2^31]` |
//! | `n`, of `2 (u - u_0) + 1` in raw steps, below `8/9 2^b` | Q30 in units of `2^b`: below `q / 2` |
//! | `1 / q` | 16 bits, from 17 of `q`: never above |
//! | `u - u_0` | raw steps, floored: the 1 is what rounds them |
//! | a word | both fractions, 16 bits each |
//!
//! Error, in raw steps of 2^-16, where a varying is within `R` of vertex 0's and `q` is a part `p` of the largest:
//! - a reciprocal is at most a part in 2^14 too small: `R 2^-14`, towards vertex 0's value;
//! - planes are off by up to 2^13 units, of `n` and of `q`: `R 2^-14 / p`;
//! - a step is rounded to a raw one, 16 at the end of an arc, or towards its first value, 31, where a row ends: no sum
//!   leaves what is between there; half of a bend is rounded too, 16 in the middle;
//! - the parts of an arc are off as straight lines of their length are; the curve that they follow, by a quarter of what
//!   one straight line would be where `q` changes to its half, and by the cube of that change where it does so by less. The
//!   bend is a sixteenth more than the parabola's, which puts the corners outside of it and halves what the parts are off.
//!
//! `values_are_as_near_as_promised` in this file asserts all of it. Varyings that change by more than two a pixel bend by
//! anything.

use super::Reciprocal;
use super::plane::{Nearness, raw, word};
use crate::math::{high_product_16, index, low, normalized, product, signed, unsigned};
use crate::setup::{Plane, Slopes};
use crate::vertex::{Snap, Vertex};
use core::marker::PhantomData;

/// Pixels of an arc.
const LONG: i32 = 32;

/// Pixels between two bends.
const SHORT: i32 = 8;

/// `floor((2^16 - 1) / n)`, 0 for 0.
const INVERSE: [i32; 32] = inverses();

#[expect(clippy::indexing_slicing, reason = "n is below the length; evaluated at compile time")]
const fn inverses() -> [i32; 32] {
    let mut table = [0; 32];
    let (mut n, mut steps) = (1, 1);
    while n < 32 {
        table[n] = 0xffff / steps;
        (n, steps) = (n + 1, steps + 1);
    }
    table
}

/// Varyings of a triangle in perspective, modulo 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arcs<R, const N: usize> {
    q: Plane,
    each: [Plane; N],
    /// Quotients of 30 bits are raw steps times this power of two.
    shift: u32,
    /// The word of the values at vertex 0.
    base: u32,
    /// What `q` is where an arc can be long, at least: twice what it changes by along one.
    least: u32,
    reciprocal: PhantomData<R>,
}

/// Where an arc ends and the next begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bend<const N: usize> {
    q: u32,
    n: [u32; N],
    /// `u - u_0`, raw.
    values: [i32; N],
}

/// A word, its step a pixel, and what the step bends by.
type Arc = [u32; 3];

impl<R: Reciprocal, const N: usize> Arcs<R, N> {
    /// The planes through three vertices, where they have some.
    #[inline]
    pub(crate) fn new<T: Snap, const P: usize>(
        slopes: &Slopes,
        vertices: [&Vertex<T, N, P>; 3],
        q: Nearness,
    ) -> Option<Self> {
        let all = raw(vertices)?;
        let mut widest = 1;
        for [u, v, w] in all {
            for d in [v - u, w - u] {
                let d = 2 * d + 1;
                widest |= unsigned(d ^ d >> 31);
            }
        }
        // To spare for what planes are off. 2^b is 2^(32 - room).
        let (_, room) = normalized(widest + (widest >> 3));
        let (_, zeros) = normalized(q[0] | q[1] | q[2]);
        let q = q.map(|q| q << zeros.saturating_sub(1));
        let half = q.map(|q| signed(q >> 1));
        let plane = |value: u32, [a, b, c]: [i32; 3]| slopes.plane(value, [b - a, c - a]);
        let mut arcs = Self {
            q: plane(q[0], half),
            each: [Plane::default(); N],
            shift: room - 2,
            base: word(all.map(|[u, _, _]| u)),
            least: 0,
            reciprocal: PhantomData,
        };
        for (each, [u, v, w]) in arcs.each.iter_mut().zip(all) {
            let n = |d: i32, half: i32| low(product((2 * d + 1) << (room - 2), half) >> 31);
            let n = [n(0, half[0]), n(v - u, half[1]), n(w - u, half[2])];
            *each = plane(unsigned(n[0]) << 1, n);
        }
        let across = signed(arcs.q.x);
        arcs.least = unsigned(across ^ across >> 31).saturating_mul(unsigned(2 * LONG));
        Some(arcs)
    }

    /// At a covered pixel.
    #[inline(always)]
    pub(crate) fn bend(&self, x: i32, y: i32) -> Bend<N> {
        let n = self.each.map(|n| n.at(x, y));
        let mut bend = Bend { q: self.q.at(x, y), n, values: [0; N] };
        bend.divide::<R>(self.shift);
        bend
    }

    /// The arc at the start of what is left of a row, and how long it is; `bend` is there, and then where it ends: at
    /// the first pixel of the next, or the row's last.
    #[inline(always)]
    pub(crate) fn arc(&self, bend: &mut Bend<N>, left: i32) -> (Arc, i32) {
        let long = bend.q >= self.least;
        let at = word(bend.values).wrapping_add(self.base);
        if long && left > LONG {
            let [step, by] = self.whole(bend);
            return ([at, step, by], LONG);
        }
        let length = left.min(if long { LONG } else { SHORT });
        let steps = if left > length { length } else { length - 1 };
        if steps == 0 {
            return ([at, 0, 0], length);
        }
        let [step, by] = self.part(bend, steps);
        ([at, step, by], length)
    }

    /// The step of an arc of [`LONG`] pixels, and what it bends by.
    #[inline(always)]
    fn whole(&self, bend: &mut Bend<N>) -> [u32; 2] {
        let first = bend.values;
        let curve = self.follow(bend, LONG);
        let (mut steps, mut bends) = ([0; N], [0; N]);
        let pairs = first.iter().zip(bend.values);
        for ((step, bend), (first, last)) in steps.iter_mut().zip(&mut bends).zip(pairs) {
            *step = (last - first + LONG / 2) >> 5;
            *bend = half_of_bend(*step, curve);
        }
        // Eight pixels each of 0, 1, 2 and 3 bends: 48 in 32, half of it for a bend's half.
        let bends = word(bends);
        let step = word(steps).wrapping_sub(bends.wrapping_mul(3));
        [step, bends << 1]
    }

    /// The same of an arc to `steps` pixels on, 1 or more and fewer than [`LONG`].
    #[inline(always)]
    fn part(&self, bend: &mut Bend<N>, steps: i32) -> [u32; 2] {
        let first = bend.values;
        let curve = self.follow(bend, steps);
        let inverse = INVERSE.get(index(steps)).copied().unwrap_or(0);
        // Towards 0, so that no sum passes the last value.
        let per_pixel = |d: i32| high_product_16(d << 1, inverse) - (d >> 31);
        // The bends there are up to each of the steps.
        let whole = steps >> 3;
        let bent = whole * (steps - 4 * whole - 4);
        let (mut each, mut bends) = ([0; N], [0; N]);
        let pairs = first.iter().zip(bend.values);
        for ((step, bend), (first, last)) in each.iter_mut().zip(&mut bends).zip(pairs) {
            let d = last - first;
            if steps > SHORT {
                *bend = half_of_bend(per_pixel(d), curve);
            }
            *step = per_pixel(d - 2 * *bend * bent);
        }
        [word(each), word(bends) << 1]
    }

    /// To `steps` pixels on; by what part of itself a slope changes along [`LONG`] pixels there, Q12.
    #[inline(always)]
    fn follow(&self, bend: &mut Bend<N>, steps: i32) -> i32 {
        let along = unsigned(steps);
        bend.q = bend.q.wrapping_add(self.q.x.wrapping_mul(along));
        for (n, plane) in bend.n.iter_mut().zip(&self.each) {
            *n = n.wrapping_add(plane.x.wrapping_mul(along));
        }
        let (inverse, zeros) = bend.divide::<R>(self.shift);
        // What q changes by, a part of it at the end: at most 1 where an arc can be long.
        let change = signed(self.q.x.wrapping_mul(unsigned(LONG / 2)) << zeros) >> 16;
        let change = change.wrapping_mul(inverse) >> 18;
        // A part of it in the middle, and a sixteenth.
        -(change + (change >> 4) + (change.wrapping_mul(change) >> 13))
    }
}

/// Half of what a step bends by after [`SHORT`] pixels: a slope changes twice as `q` does.
#[inline]
fn half_of_bend(step: i32, curve: i32) -> i32 {
    (step.wrapping_mul(curve).wrapping_add(1 << 13)) >> 14
}

impl<const N: usize> Bend<N> {
    /// Sets the values, the quotients `n / q` of 30 bits by `2^shift`; `2^47 / (q 2^zeros)`, and zeros.
    #[inline(always)]
    fn divide<R: Reciprocal>(&mut self, shift: u32) -> (i32, u32) {
        let (normal, zeros) = normalized(self.q | 1);
        let inverse = R::below(normal);
        for (value, n) in self.values.iter_mut().zip(self.n) {
            *value = high_product_16(signed(n << zeros), inverse) >> shift;
        }
        (inverse, zeros)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interpolation::Newton;
    use crate::setup::{Outline, doubled_area};
    use crate::vertex::{ClipVertex, Outside, Quick, Viewport};
    use fixed::types::I16F16;
    use std::vec::Vec;

    fn random() -> impl FnMut(i32) -> i32 {
        let mut state = 5u64;
        move |n| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((state >> 33) % u64::from(n.unsigned_abs())) as i32
        }
    }

    /// A covered pixel: the values its word has and the exact ones, raw; what the exact ones change by along its arc,
    /// the smallest `q` along it and the largest, in parts of the largest at a vertex.
    struct Pixel {
        got: [i32; 2],
        exact: [f64; 2],
        change: [f64; 2],
        q: [f64; 2],
        length: i32,
    }

    fn drawn(corners: [[i32; 2]; 3], q: [u32; 3], uv: [[i32; 2]; 3]) -> Option<Vec<Pixel>> {
        let viewport = Viewport::new(16, 16).unwrap();
        let vertices = uv.map(|uv| {
            let clip = ClipVertex { raw: [0, 0, 0, 2048], shift: 0 };
            let position = Quick::<8>::snap(&clip, 1, &viewport);
            let (outside, varyings) = (Outside(0), uv.map(I16F16::from_bits));
            Vertex::<Quick<8>, 2> { position, z: 0, shift: 0, outside, varyings, distances: [] }
        });
        let area = doubled_area(&corners);
        let bounds = Outline::new(&corners, area > 0).bounds(8);
        if area == 0 || bounds.is_empty() {
            return None;
        }
        let slopes = Slopes::new(&corners, area, 8)?;
        let [a, b, c] = &vertices;
        let arcs = Arcs::<Newton<2>, 2>::new(&slopes, [a, b, c], q)?;
        let points = corners.map(|p| p.map(|p| f64::from(p) / 256.0));
        let cross = |o: [f64; 2], a: [f64; 2], b: [f64; 2]| {
            (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
        };
        let weights = |x: i32, y: i32| {
            let (at, [p, q, r]) = ([f64::from(x) + 0.5, f64::from(y) + 0.5], points);
            [cross(at, q, r), cross(at, r, p), cross(at, p, q)].map(|w| w / cross(p, q, r))
        };
        let most = f64::from(q[0].max(q[1]).max(q[2]));
        let near = |x: i32, y: i32| {
            let w = weights(x, y);
            (0..3).map(|i| w[i] * f64::from(q[i])).sum::<f64>() / most
        };
        let value = |x: i32, y: i32| {
            let w = weights(x, y);
            let of = |k: usize| {
                (0..3).map(|i| w[i] * f64::from(q[i]) * f64::from(uv[i][k])).sum::<f64>()
            };
            [of(0), of(1)].map(|n| n / near(x, y) / most)
        };
        let mut pixels = Vec::new();
        for y in bounds.y0..bounds.y1 {
            let covered = |x: &i32| weights(*x, y).iter().all(|&w| w > 1e-4);
            let Some(mut x) = (bounds.x0..bounds.x1).find(covered) else { continue };
            let end = (x..bounds.x1).find(|x| !covered(x)).unwrap_or(bounds.x1);
            let mut bend = arcs.bend(x, y);
            while x < end {
                let ([mut at, mut step, by], length) = arcs.arc(&mut bend, end - x);
                let last = (x + length).min(end - 1);
                let ends = [value(x, y), value(last, y)];
                let ([a, b], mut q) = (ends, [near(x, y), near(last, y)]);
                q.sort_by(f64::total_cmp);
                for i in 0..length {
                    let got = [at << 16, at].map(|v| signed(v) >> 16);
                    let change = [0, 1].map(|k| (b[k] - a[k]).abs());
                    pixels.push(Pixel { got, exact: value(x + i, y), change, q, length });
                    at = at.wrapping_add(step);
                    if i % SHORT == SHORT - 1 {
                        step = step.wrapping_add(by);
                    }
                }
                x += length;
            }
        }
        Some(pixels)
    }

    /// From a value modulo 1 to an exact one, raw.
    fn off(got: i32, exact: f64) -> f64 {
        let off = (f64::from(got) - exact).rem_euclid(65_536.0);
        off.min(65_536.0 - off)
    }

    fn corners(i: usize, mut below: impl FnMut(i32) -> i32) -> [[i32; 2]; 3] {
        let reach = 256 * (8 << (i % 6));
        let mut p = [[0; 2]; 3].map(|_| [0; 2].map(|_| below(2 * reach) - reach));
        if i % 5 == 0 {
            p[2] = [p[1][0] + below(512) - 256, p[1][1] + 300];
        }
        p
    }

    /// Over random triangles, `w` over ratios of up to 4096, coordinates of both signs and far outside of `[0, 1]`.
    #[test]
    fn values_are_as_near_as_promised() {
        let (mut below, mut count, mut worst) = (random(), 0, [0.0f64; 2]);
        for i in 0..1500 {
            let points = corners(i, &mut below);
            let ratio = 1 << (i % 13);
            let q = [0; 3].map(|_| (1 << 30) / (1 + below(ratio)) as u32);
            let repeats = 1 << (10 + i % 11);
            let far = if i % 3 == 0 { 1 << 20 } else { 0 };
            let uv = [0; 3].map(|_| [0; 2].map(|_| far + below(2 * repeats) - repeats));
            let Some(pixels) = drawn(points, q, uv) else { continue };
            for Pixel { got, exact, change, q: [least, most], length } in pixels {
                for k in 0..2 {
                    let values = uv.map(|uv| f64::from(uv[k]));
                    let range = values.iter().map(|v| (v - values[0]).abs()).fold(0.0, f64::max);
                    let planes = range * (2f64.powi(-13) + 2f64.powi(-14) / least);
                    let root = (most / least).sqrt();
                    // What straight lines are off: over the arc, and over its parts.
                    let whole = (root - 1.0) / (root + 1.0) * change[k];
                    let bent = length > SHORT;
                    let parts = whole * (f64::from(SHORT) / f64::from(length)).min(1.0).powi(2);
                    let line = parts + if bent { whole / 4.0 } else { 0.0 };
                    let error = off(got[k], exact[k]) - planes - 64.0;
                    assert!(
                        error < line || (bent && change[k] > 262_144.0),
                        "{error} off, not {line}: {points:?} {q:?} {uv:?} {length}"
                    );
                    let part = &mut worst[usize::from(bent)];
                    *part = part.max(error / line.max(8.0));
                }
                count += 1;
            }
        }
        assert!(count > 100_000, "{count} pixels");
        assert!(
            worst.iter().all(|&part| part > 0.8),
            "the promise is far from what happens: {worst:?}"
        );
    }
}

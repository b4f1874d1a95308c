//! Perspective of a triangle on the screen, divided at each pixel, by planes.
//!
//! `q`, in a unit of the triangle's own, is `1 / w`: the largest of the three is in `[2^30, 2^31)`, at most 2^31 - 2^16 so
//! that what the plane is off has room, and none is below 2^26: a triangle of which one vertex is 16 times as far as another is drawn by its edge functions. A numerator is
//! `n = (u - u_0) q / 2^e`, at most `q` in magnitude.
//!
//! The reciprocal `r = 2^56 / q` is followed along a row: a step of third order makes `1 + x^3` of one that is off by a part
//! `x`, which is the change of `q` from pixel to pixel; where that is more than 5/128, there are no planes.
//!
//! Error budget of a value, in parts of 2^e:
//! - both planes are off by less than 2^14.91 (`setup/slopes.rs`): 2 2^14.91 / 2^26 = 2^-10.1 at the farthest vertex, if it is
//!   16 times as far as the nearest; a mesh's triangle, whose vertices are about as far as each other, has 2^-14;
//! - the reciprocal's 2^-14, 2^-15 of a difference of 1, and 2^-23 of what is cut.
//!
//! `2^e` is up to twice the range of `u` over the triangle, or 2^11 raw steps where that is less: an error is then below a
//! step. All of it at its worst at once would pass 2^-10 of the range; the tests' largest is far from that.

use super::{Reciprocal, Run, Varying};
use crate::color::Lane;
use crate::math::{bits, high_product, normalized, reciprocal, signed, unsigned};
use crate::setup::{Plane, Slopes, Tier};
use crate::vertex::{Position, ScaleOf, Snap, Vertex};
use core::marker::PhantomData;
use fixed::types::I16F16;

/// `q` of no covered pixel is below this, but for a plane's error.
const LEAST: u32 = 1 << 26;

/// Numerators and `q` of varyings that are divided at each pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quotients<R, const N: usize> {
    q: Plane,
    n: [Plane; N],
    /// `u_0` with half a step, in `2^(e - 24)` raw steps; and `24 - e`.
    each: [(i32, u32); N],
    reciprocal: PhantomData<R>,
}

/// Such varyings along a row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Followed<'a, R, const N: usize> {
    of: &'a Quotients<R, N>,
    /// `2^56 / q`.
    r: i32,
    q: i32,
    n: [i32; N],
}

/// `1 / w` of three vertices in front of the eye, in a unit of their own; `None` where they are too different.
fn nearness<T: Tier, const N: usize, const P: usize>(
    vertices: [&Vertex<T, N, P>; 3],
) -> Option<[u32; 3]> {
    let inverse = vertices.map(inverse_w);
    let [(_, a), (_, b), (_, c)] = inverse;
    let top = a.max(b).max(c);
    let q = inverse.map(|(mantissa, exponent)| {
        (mantissa >> (unsigned(top - exponent).min(30) + 1)).min((1 << 31) - (1 << 16))
    });
    let [a, b, c] = q;
    (a.min(b).min(c) >= LEAST).then_some(q)
}

/// The mantissa of `1 / w`, and its exponent but for a constant. In the exact tier `k` is a power of two; where vertices are
/// projected, which all are that come here, `k w` is the same of all.
#[inline(never)]
fn inverse_w<T: Tier, const N: usize, const P: usize>(v: &Vertex<T, N, P>) -> (u32, i32) {
    let ScaleOf(k) = v.position.scale();
    if T::PROJECTS {
        return (k.mantissa, k.exponent);
    }
    let (divisor, zeros) = normalized(unsigned(v.position.scaled_w()));
    (reciprocal(divisor), k.exponent + bits(zeros))
}

/// A varying's differences in Q31 of `2^e`, and `u_0` with half a step in `2^(e - 24)` raw steps, and `24 - e`; `None`
/// where `u_0` is too far from 0 for its fraction.
///
/// Q31 has no 1, and what a plane is off needs room: a difference is at most `1 - 2^-15`, which is within 2^-15.
#[inline(never)]
fn in_own_units(values: [i32; 3]) -> Option<([i32; 2], (i32, u32))> {
    const MOST: i32 = (1 << 30) - (1 << 15);
    let varying = Varying::new(values, &[0; 3]);
    // So that u_0 has room beside its fraction.
    let length = 32 - normalized(varying.base.unsigned_abs() | 1).1;
    let e = varying.exponent.max(length.saturating_sub(6));
    if e > 23 || (e > 11 && e > varying.exponent) {
        return None;
    }
    let cut = e - varying.exponent;
    let fraction = 24 - e;
    let base = (varying.base << fraction) + (1 << fraction >> 1);
    let differences = varying.differences.map(|d| (d >> cut).clamp(-MOST, MOST) << 1);
    Some((differences, (base, fraction)))
}

/// Varyings that are linear on the screen, each in a unit of its own: numerators where `q` is 1. They are off by 2^14.8
/// 2^-31 of `2^e`, and by 2^-15 of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Level<const N: usize> {
    n: [Plane; N],
    each: [(i32, u32); N],
}

/// Such varyings along a row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slope<'a, const N: usize> {
    of: &'a Level<N>,
    n: [i32; N],
}

impl<const N: usize> Level<N> {
    /// The planes through three vertices on the screen, where they have some.
    #[inline(never)]
    pub(crate) fn new<T: Snap, const P: usize>(
        slopes: &Slopes,
        vertices: [&Vertex<T, N, P>; 3],
    ) -> Option<Self> {
        let mut all = Self { n: [Plane::default(); N], each: [(0, 0); N] };
        let [a, b, c] = vertices.map(|v| &v.varyings);
        let varyings = a.iter().zip(b).zip(c);
        for ((n, start), ((a, b), c)) in all.n.iter_mut().zip(&mut all.each).zip(varyings) {
            let (differences, first) = in_own_units([a.to_bits(), b.to_bits(), c.to_bits()])?;
            *start = first;
            *n = slopes.plane(0, differences.map(|d| d >> 1));
        }
        Some(all)
    }

    /// The values from a covered pixel on.
    #[inline]
    pub(crate) fn from(&self, x: i32, y: i32) -> Slope<'_, N> {
        Slope { of: self, n: self.n.map(|n| n.signed_at(x, y)) }
    }
}

impl<const N: usize> Run<N> for Slope<'_, N> {
    #[inline]
    fn varyings(&self) -> [I16F16; N] {
        let mut values = [I16F16::ZERO; N];
        for ((value, n), (base, fraction)) in values.iter_mut().zip(self.n).zip(self.of.each) {
            *value = I16F16::from_bits(base.wrapping_add(n >> 7) >> (fraction & 31));
        }
        values
    }

    #[inline]
    fn step(&mut self) {
        for (n, plane) in self.n.iter_mut().zip(&self.of.n) {
            *n = n.wrapping_add(signed(plane.x));
        }
    }
}

impl<R: Reciprocal, const N: usize> Quotients<R, N> {
    /// The planes through three vertices on the screen, where they have some.
    #[inline(never)]
    pub(crate) fn new<T: Tier, const P: usize>(
        slopes: &Slopes,
        vertices: [&Vertex<T, N, P>; 3],
    ) -> Option<Self> {
        Self::of(slopes, vertices, |_, values| in_own_units(values))
    }

    /// The same of colour channels, each in parts of `2^bits` of its own steps: 24 bits of fraction, with half a step.
    #[inline(never)]
    pub(crate) fn channels<T: Tier, const P: usize>(
        slopes: &Slopes,
        vertices: [&Vertex<T, N, P>; 3],
        lanes: [Lane; N],
    ) -> Option<Self> {
        Self::of(slopes, vertices, |i, values| {
            let lane = lanes.get(i)?;
            if values.iter().any(|&u| unsigned(u) > 1 << 16) {
                return None;
            }
            // u max 2^(31 - bits): below 2^31.
            let scale = ((1 << lane.bits) - 1) << (15 - lane.bits);
            let [u, v, w] = values;
            let base = ((unsigned(u) * unsigned(scale)) >> 7) + (1 << (23 - lane.bits));
            Some(([(v - u) * scale, (w - u) * scale], (signed(base), 24)))
        })
    }

    /// The planes of numerators whose differences in Q31, and first value and its fraction, are `each` of a varying's.
    #[inline(always)]
    fn of<T: Tier, const P: usize>(
        slopes: &Slopes,
        vertices: [&Vertex<T, N, P>; 3],
        each: impl Fn(usize, [i32; 3]) -> Option<([i32; 2], (i32, u32))>,
    ) -> Option<Self> {
        let q = nearness(vertices)?;
        let least = q[0].min(q[1]).min(q[2]);
        let [q0, q1, q2] = q.map(signed);
        let plane = slopes.plane(unsigned(q0), [(q1 - q0) >> 1, (q2 - q0) >> 1]);
        if signed(plane.x).unsigned_abs() > (least >> 5) + (least >> 7) {
            return None;
        }
        let n = [Plane::default(); N];
        let mut all = Self { q: plane, n, each: [(0, 0); N], reciprocal: PhantomData };
        let [a, b, c] = vertices.map(|v| &v.varyings);
        let varyings = a.iter().zip(b).zip(c).enumerate();
        for ((n, start), (i, ((a, b), c))) in all.n.iter_mut().zip(&mut all.each).zip(varyings) {
            let ([d1, d2], first) = each(i, [a.to_bits(), b.to_bits(), c.to_bits()])?;
            *start = first;
            // The high word is in units of 2.
            let differences = [high_product(d1, q1), high_product(d2, q2)];
            *n = slopes.plane(0, differences);
        }
        Some(all)
    }

    /// The values from a covered pixel on.
    #[inline]
    pub(crate) fn from(&self, x: i32, y: i32) -> Followed<'_, R, N> {
        let q = self.q.signed_at(x, y).max(1 << 25);
        let (divisor, zeros) = normalized(unsigned(q));
        // 2^(63 + zeros) / (q 2^zeros) is in [2^31, 2^32); zeros is 1 to 6.
        let r = signed(R::of(divisor) >> (7 - zeros));
        Followed { of: self, r, q, n: self.n.map(|n| n.signed_at(x, y)) }
    }
}

impl<R, const N: usize> Followed<'_, R, N> {
    /// Colour channels with 24 bits of fraction.
    #[inline]
    pub(crate) fn fractions(&self) -> [u32; N] {
        let mut fractions = [0; N];
        for ((fraction, n), (base, _)) in fractions.iter_mut().zip(self.n).zip(self.of.each) {
            *fraction = unsigned(base.wrapping_add(high_product(n, self.r)));
        }
        fractions
    }
}

impl<R, const N: usize> Run<N> for Followed<'_, R, N> {
    #[inline]
    fn varyings(&self) -> [I16F16; N] {
        let mut values = [I16F16::ZERO; N];
        for ((value, n), (base, fraction)) in values.iter_mut().zip(self.n).zip(self.of.each) {
            let value_up = base.wrapping_add(high_product(n, self.r));
            *value = I16F16::from_bits(value_up >> (fraction & 31));
        }
        values
    }

    #[inline]
    fn step(&mut self) {
        for (n, plane) in self.n.iter_mut().zip(&self.of.n) {
            *n = n.wrapping_add(signed(plane.x));
        }
        self.q = self.q.wrapping_add(signed(self.of.q.x));
        // x = q r / 2^56 - 1 in Q32, the 1 in the bits above; then 1 / (1 + x) is 1 - x + x^2 and x^3.
        let x = high_product(self.q, self.r) << 8;
        let correction = x.wrapping_sub(high_product(x, x));
        self.r = self.r.wrapping_sub(high_product(self.r, correction));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interpolation::Newton;
    use crate::setup::determinant;
    use crate::vertex::{ClipVertex, Exact, Outside, Viewport};

    fn vertex([x, y, w]: [i32; 3], u: i32, viewport: &Viewport) -> Vertex<Exact, 1> {
        let clip = ClipVertex { raw: [x, y, 0, w], shift: 0 };
        let position = Exact::snap(&clip, 1, viewport);
        let (outside, varyings) = (Outside(0), [I16F16::from_bits(u)]);
        Vertex { position, z: 0, shift: 0, outside, varyings, distances: [] }
    }

    /// The largest errors over the covered pixels of a triangle, along whole rows: of a varying in parts of its range beside
    /// a raw step, and of a 6-bit channel in its steps.
    fn errors(p: [[i32; 3]; 3], u: [i32; 3], viewport: &Viewport) -> Option<[f64; 2]> {
        let v = [0, 1, 2].map(|i| vertex(p[i], u[i], viewport));
        let v = [&v[0], &v[1], &v[2]];
        let positions = v.map(|v| &v.position);
        let setup = Exact::set_up(positions, viewport)?;
        let bounds = setup.bounds[0];
        if bounds.is_empty() {
            return None;
        }
        let slopes = Slopes::homogeneous(positions, determinant(positions), &bounds, viewport)?;
        let quotients = Quotients::<Newton<2>, 1>::new(&slopes, v)?;
        let lane = Lane { bits: 6, width: 11, place: 0 };
        let channels = Quotients::<Newton<2>, 1>::channels(&slopes, v, [lane]);
        let range = f64::from(u.iter().max().unwrap() - u.iter().min().unwrap());
        let mut largest = [0.0f64; 2];
        for y in bounds.y0..bounds.y1 {
            let mut run = None;
            for x in bounds.x0..bounds.x1 {
                let edges = setup.edges_at(x, y);
                if edges.iter().any(|&e| e < 0) {
                    continue;
                }
                let (values, colours) = run.get_or_insert_with(|| {
                    (quotients.from(x, y), channels.as_ref().map(|c| c.from(x, y)))
                });
                // The snapped vertex is 2^shift times the true one.
                let weight = |i: usize| edges[i] as f64 * f64::from(positions[i].shift).exp2();
                let sum = weight(0) + weight(1) + weight(2);
                let at = |i: usize| f64::from(u[i]) * weight(i);
                let exact = (at(0) + at(1) + at(2)) / sum;
                let got = f64::from(values.varyings()[0].to_bits());
                largest[0] = largest[0].max(((got - exact).abs() - 1.0) / range.max(1.0));
                values.step();
                if let Some(colours) = colours {
                    let got = f64::from(colours.fractions()[0]) / 262_144.0 - 0.5;
                    largest[1] = largest[1].max((got - exact * 63.0 / 65_536.0).abs());
                    colours.step();
                }
            }
        }
        Some(largest)
    }

    /// Random triangles of all sizes and depths, and ranges from a few steps to many times one.
    #[test]
    fn values_at_covered_pixels_are_as_close_as_promised() {
        let mut state = 5u64;
        let mut below = move |n: i32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((state >> 33) % u64::from(n.unsigned_abs())) as i32
        };
        let (mut planes, mut worst) = (0, [0.0f64; 2]);
        for i in 0..8000 {
            let side = [240, 512, 64][i % 3];
            let viewport = Viewport::new(side, side).unwrap();
            let depths = 1 + below(20);
            let at = [0, 1].map(|_| below(2001) - 1000);
            let reach = 2 << below(11);
            let p = [[0; 3]; 3].map(|_| {
                let w = 1000 + below(1000 * depths);
                let mut to = |at: i32| {
                    let ndc = (at + below(2 * reach + 1) - reach).clamp(-1000, 1000);
                    (i64::from(ndc) * i64::from(w) * 64 / 1000) as i32
                };
                [to(at[0]), to(at[1]), w * 64]
            });
            let size = 1 << (1 + below(20));
            let first = if i % 4 == 0 { 0 } else { below(1 << 16) };
            let u = [0; 3].map(|_| first + below(size));
            let u = if i % 2 == 0 { u.map(|u| u.min(1 << 16)) } else { u.map(|u| u - size / 2) };
            if let Some(errors) = errors(p, u, &viewport) {
                assert!(errors[0] < 1.0 / 1024.0, "{p:?}, {u:?}: {errors:?}");
                assert!(errors[1] < 0.02, "{p:?}, {u:?}: {errors:?}");
                planes += 1;
                worst = [0, 1].map(|n| worst[n].max(errors[n]));
            }
        }
        assert!(planes > 1500, "{planes} triangles had planes; worst {worst:?}");
    }

    /// All at the same depth, so that nothing is divided: ranges down to a step, against exact weights.
    #[test]
    fn level_values_are_within_a_part_in_1024_of_any_range() {
        let mut state = 9u64;
        let mut below = move |n: i32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((state >> 33) % u64::from(n.unsigned_abs())) as i32
        };
        let viewport = Viewport::new(512, 512).unwrap();
        let mut pixels = 0;
        for i in 0..200 {
            let p =
                [[0; 3]; 3].map(|_| [below(131_073) - 65_536, below(131_073) - 65_536, 1 << 16]);
            let size = 1 << (i % 22);
            let u = [0; 3].map(|_| below(size + 1) - size / 3);
            let v = [0, 1, 2].map(|k| vertex(p[k], u[k], &viewport));
            let v = [&v[0], &v[1], &v[2]];
            let positions = v.map(|v| &v.position);
            let Some(setup) = Exact::set_up(positions, &viewport) else { continue };
            let (bounds, determinant) = (setup.bounds[0], determinant(positions));
            let Some(slopes) = Slopes::homogeneous(positions, determinant, &bounds, &viewport)
            else {
                continue;
            };
            let Some(level) = Level::new(&slopes, v) else { continue };
            let range = f64::from(u.iter().max().unwrap() - u.iter().min().unwrap());
            for y in (bounds.y0..bounds.y1).step_by(7) {
                for x in bounds.x0..bounds.x1 {
                    let edges = setup.edges_at(x, y).map(|e| e as f64);
                    if edges.iter().all(|&e| e > 0.0) {
                        let sum = edges[0] + edges[1] + edges[2];
                        let at = |k: usize| f64::from(u[k]) * edges[k];
                        let exact = (at(0) + at(1) + at(2)) / sum;
                        let got = f64::from(level.from(x, y).varyings()[0].to_bits());
                        assert!((got - exact).abs() < 0.51 + range / 1024.0, "{p:?} {u:?} {x} {y}");
                        pixels += 1;
                    }
                }
            }
        }
        assert!(pixels > 100_000, "{pixels} pixels");
    }

    /// A vertex on a pixel's centre, with the nearest `w` a power of two and the largest difference one: both `q` and the
    /// numerator are at their ends there.
    #[test]
    fn the_ends_of_both_planes_do_not_wrap() {
        let viewport = Viewport::new(8, 8).unwrap();
        for flip in [1, -1] {
            // Pixel (3, 3)'s centre is at -1/8, 1/8.
            let p = [
                [-1 << 16, -1 << 16, 1 << 17],
                [-1 << 13, 1 << 13, 1 << 16],
                [1 << 16, -1 << 16, 1 << 17],
            ];
            let u = [0, flip << 16, 0];
            let v = [0, 1, 2].map(|k| vertex(p[k], u[k], &viewport));
            let v = [&v[0], &v[1], &v[2]];
            let positions = v.map(|v| &v.position);
            let bounds = Exact::set_up(positions, &viewport).unwrap().bounds[0];
            let slopes =
                Slopes::homogeneous(positions, determinant(positions), &bounds, &viewport).unwrap();
            let at = Quotients::<Newton<2>, 1>::new(&slopes, v).unwrap().from(3, 3).varyings()[0]
                .to_bits();
            assert!((at - (flip << 16)).abs() < 64, "{at}");
        }
    }

    /// Reciprocals followed for 100,000 pixels, nearer, farther and at rest: at the last they are as near as at the first.
    #[test]
    fn reciprocals_do_not_drift() {
        const STEPS: i32 = 100_000;
        const MOST: i32 = i32::MAX - (1 << 16);
        let ends = [(MOST, 1 << 26), (1 << 26, MOST), (1 << 30, 1 << 30), (77_777_777, 99_999_999)];
        for (first, last) in ends {
            let step = (last - first) / STEPS;
            let q = Plane::default();
            let mut of = Quotients::<Newton<2>, 0> { q, n: [], each: [], reciprocal: PhantomData };
            of.q.x = unsigned(step);
            let (divisor, zeros) = normalized(unsigned(first));
            let r = signed(reciprocal(divisor) >> (7 - zeros));
            let mut run = Followed { of: &of, r, q: first, n: [] };
            for i in 0..=STEPS {
                let exact = 2f64.powi(56) / f64::from(first + step * i);
                let off = (f64::from(run.r) / exact - 1.0).abs();
                assert!(off < 2f64.powi(-22), "{off:e} off at {i} from {first} to {last}");
                run.step();
            }
        }
    }
}

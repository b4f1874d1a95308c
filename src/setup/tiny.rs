//! Setup of tiny triangles: three edge functions and a plane at the first pixel of their box, all in 32 bits.
//!
//! Corners are less than 8 px from each other on each axis, and the doubled area `D` is more than 1/4 and less than 16
//! square pixels. Everything is in 1/256 px, whatever the tier's subpixels, and counted from the first corner, so that
//! nothing depends on where the triangle is:
//!
//! | value | bits |
//! | --- | --- |
//! | ways from corner to corner, and to a pixel's centre in the box | 11 and a sign |
//! | `D` | above 2^14, below 2^20 |
//! | an edge function at a centre in the box | 22 and a sign |
//! | the same in steps of a pixel, floored | 14 and a sign |
//! | differences over the triangle, rounded to 2^13 of a plane's units | 19 and a sign |
//! | `v = d_1 e_1 + d_2 e_2` | 31 and a sign |
//! | `R = floor(2^41 / D)` | 27 |
//! | `g = floor(v 2^4 R / 2^32)`, units in 1/256 px | 30 and a sign |
//!
//! A step of a pixel changes an edge function by a multiple of 256, so that its sign is that of the floored quotient by
//! 256: 16 bits are enough to tell inside from outside.
//!
//! Error of the plane at a covered pixel, in its units: half of 2^13 by the rounded differences; a part in 2^21 of at
//! most 2^32 by `R`; less than 1 for each of twice 2^11 steps by `g`. All in all less than 2^12 + 2^11 + 2^12 = 10240.

use crate::math::{high_product, inverse_area, low, signed, unsigned};
use crate::vertex::Rect;
use core::num::NonZeroU32;

/// Bits of a side, in 1/256 px.
const SIDE_BITS: u32 = 11;

/// A tiny triangle, in 1/256 px.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tiny {
    /// From the first corner to the second and to the third, both turned around where those go counter-clockwise.
    ways: [[i32; 2]; 2],
    /// The doubled area.
    area: NonZeroU32,
    /// From the first corner to the centre of the box's first pixel.
    to: [i32; 2],
}

/// Three edge functions in steps of a pixel, negative outside: at the box's first pixel, and what they gain from there to
/// the right and down.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeSteps {
    pub(crate) at: [i32; 3],
    pub(crate) across: [i32; 3],
    pub(crate) down: [i32; 3],
}

/// A linear function modulo 2^32: at the box's first pixel, and what it gains from there to the right and down.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlaneSteps {
    pub(crate) at: u32,
    pub(crate) across: u32,
    pub(crate) down: u32,
}

impl Tiny {
    /// Whether a triangle of that doubled area may be tiny. Few that pass have long sides.
    #[inline]
    pub(crate) fn may_have(doubled_area: i64, bits: u32) -> bool {
        let pixel = 1 << (2 * bits);
        let (least, most) = (pixel / 4 + 1, 16 * pixel);
        low(doubled_area).unsigned_abs().wrapping_sub(least) < most - least
    }

    /// Whether a triangle with that box has no side that is too long: one is less than a pixel longer than the box.
    #[inline]
    pub(crate) const fn is_within(bounds: Rect) -> bool {
        let most = (1 << (SIDE_BITS - 8)) - 1;
        bounds.x1 - bounds.x0 <= most && bounds.y1 - bounds.y0 <= most
    }

    /// Of corners in subpixels, with that area and that box, which is not empty.
    #[inline]
    pub(crate) fn new([p, q, r]: &[[i32; 2]; 3], bounds: Rect, bits: u32) -> Option<Self> {
        let mut ways = [[q[0] - p[0], q[1] - p[1]], [r[0] - p[0], r[1] - p[1]]];
        let [[ax, ay], [bx, by]] = ways;
        let mut area = ax * by - ay * bx;
        if area < 0 {
            (ways, area) = (ways.map(|way| way.map(|v| -v)), -area);
        }
        let finer = 8 - bits;
        let half = 1 << (bits - 1);
        let to = |first: i32, v: i32| ((first << bits) + half - v) << finer;
        Some(Self {
            ways: ways.map(|way| way.map(|v| v << finer)),
            area: NonZeroU32::new(unsigned(area << (2 * finer)))?,
            to: [to(bounds.x0, p[0]), to(bounds.y0, p[1])],
        })
    }

    /// The edge functions, with the fill rule made part of them: on an edge that is not a top or a left one is outside.
    #[inline]
    pub(crate) fn edges(&self) -> EdgeSteps {
        let Self { ways: [[ax, ay], [bx, by]], area, to: [x, y] } = *self;
        let (first, third) = (ax * y - ay * x, by * x - bx * y);
        // The three add up to the area anywhere.
        let second = signed(area.get()) - first - third;
        let across = [-ay, ay - by, by];
        let down = [ax, bx - ax, -bx];
        let in_pixels = |e: i32, across: i32, down: i32| {
            // -1 where the edge is right, or horizontal and below; no edge is a point.
            let right = ((across << (SIDE_BITS + 1)) + down) >> 31;
            (e + right) >> 8
        };
        let at = [
            in_pixels(first, across[0], down[0]),
            in_pixels(second, across[1], down[1]),
            in_pixels(third, across[2], down[2]),
        ];
        EdgeSteps { at, across, down }
    }

    /// The function that is `value` at the first corner, and twice the differences more at the other two.
    #[inline]
    pub(crate) fn plane(&self, value: u32, differences: [i32; 2]) -> PlaneSteps {
        let Self { ways: [[ax, ay], [bx, by]], area, to: [x, y] } = *self;
        let [d1, d2] = differences.map(|d| (d + (1 << 11)) >> 12);
        let inverse = signed(inverse_area(area) << 4);
        let across = unsigned(high_product(d1 * by - d2 * ay, inverse));
        let down = unsigned(high_product(d2 * ax - d1 * bx, inverse));
        let along = across.wrapping_mul(unsigned(x));
        let at = value.wrapping_add(along).wrapping_add(down.wrapping_mul(unsigned(y)));
        PlaneSteps { at, across: across << 8, down: down << 8 }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::super::outline::bounds_of;
    use super::*;
    use crate::setup::doubled_area;

    /// Random numbers below a bound.
    pub(crate) fn random(seed: u64) -> impl FnMut(i32) -> i32 {
        let mut state = seed;
        move |n: i32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((state >> 33) % u64::from(n.unsigned_abs())) as i32
        }
    }

    /// Random corners of tiny triangles, some with centres on their edges, and their boxes.
    pub(crate) fn triangles(seed: u64, mut each: impl FnMut([[i32; 2]; 3], Rect, u32)) {
        let mut below = random(seed);
        for i in 0..400_000 {
            let bits = if i % 2 == 0 { 4 } else { 8 };
            let side = (1 + below(8)) << bits;
            let at = [0, 1].map(|_| below(2000 << bits) - (1000 << bits));
            let mut p = [[0; 2]; 3].map(|_| at.map(|at: i32| at + below(side)));
            match i % 5 {
                0 => p = p.map(|c| c.map(|v| v & !((1 << (bits - 1)) - 1))),
                1 => p[2][1] = p[1][1],
                2 => p[2][0] = p[1][0],
                _ => {}
            }
            let area = doubled_area(&p);
            let bounds = bounds_of(&p, bits);
            if Tiny::may_have(area, bits) && Tiny::is_within(bounds) && !bounds.is_empty() {
                each(p, bounds, bits);
            }
        }
    }

    /// How far the plane is off at the farthest covered pixel.
    fn error(p: [[i32; 2]; 3], bounds: Rect, bits: u32, v: [u32; 3]) -> f64 {
        let tiny = Tiny::new(&p, bounds, bits).unwrap();
        let differences = [1, 2].map(|i| ((i64::from(v[i]) - i64::from(v[0])) / 2) as i32);
        let plane = tiny.plane(v[0], differences);
        let mut largest = 0.0f64;
        for (row, y) in (bounds.y0..bounds.y1).enumerate() {
            for (column, x) in (bounds.x0..bounds.x1).enumerate() {
                let half = 1 << (bits - 1);
                let here = [[(x << bits) + half, (y << bits) + half]];
                let area = |i: usize, j: usize| doubled_area(&[here[0], p[i], p[j]]);
                let area = [area(1, 2), area(2, 0), area(0, 1)];
                let sum: i64 = area.iter().sum();
                if area.iter().any(|a| a.signum() == -sum.signum()) {
                    continue;
                }
                let [_, q, r] = area.map(|a| a as f64 / sum as f64);
                let [d1, d2] = differences.map(|d| 2.0 * f64::from(d));
                let exact = f64::from(v[0]) + d1 * q + d2 * r;
                let across = plane.across.wrapping_mul(column as u32);
                let down = plane.down.wrapping_mul(row as u32);
                let value = plane.at.wrapping_add(across).wrapping_add(down);
                largest = largest.max((f64::from(value) - exact).abs());
            }
        }
        largest
    }

    #[test]
    fn values_at_covered_pixels_are_as_close_as_promised() {
        let mut below = random(3);
        let (mut planes, mut worst) = (0, 0.0f64);
        triangles(5, |p, bounds, bits| {
            let value = |n: i32| match n {
                0..4 => 1 << 15,
                4..8 => u32::MAX - (1 << 15),
                n => (n as u32).wrapping_mul(2_654_435_769).clamp(1 << 15, u32::MAX - (1 << 15)),
            };
            let v = [0; 3].map(|_| value(below(40)));
            let error = error(p, bounds, bits, v);
            assert!(error < 10240.0, "{p:?}, {bits} bits, {v:?}: {error}");
            planes += 1;
            worst = worst.max(error);
        });
        assert!(planes > 50_000, "{planes} triangles were tiny");
        assert!(worst > 4096.0, "the promise is far from what happens: {worst}");
    }

    /// The longest sides and the steepest planes, at the ends of the area: no step overflows.
    #[test]
    fn ends_do_not_overflow() {
        let mut tiny = 0;
        for bits in [4, 8] {
            let end = (8 << bits) - 1;
            for shift in
                [(1 << bits) / 2 + 1, (1 << bits) - 1, (1 << bits) / 2 + 1 - (1000 << bits)]
            {
                for near in 0..2 << bits {
                    for [q, r] in [
                        [[end, end], [end - near, end]],
                        [[0, end], [near, 0]],
                        [[near, 0], [0, end]],
                        [[end, 0], [0, near]],
                    ] {
                        let p = [[0, 0], q, r].map(|c: [i32; 2]| c.map(|v| v + shift));
                        let bounds = bounds_of(&p, bits);
                        if !Tiny::may_have(doubled_area(&p), bits)
                            || !Tiny::is_within(bounds)
                            || bounds.is_empty()
                        {
                            continue;
                        }
                        tiny += 1;
                        for ends in 0..8 {
                            let end = |i: i32| {
                                if ends >> i & 1 == 0 { 1 << 15 } else { u32::MAX - (1 << 15) }
                            };
                            let v = [0, 1, 2].map(end);
                            assert!(error(p, bounds, bits, v) < 10240.0, "{p:?} {bits} {v:?}");
                        }
                    }
                }
            }
        }
        assert!(tiny > 100, "{tiny} triangles were tiny");
    }
}

//! Linear functions over a triangle on the screen, in 32 bits: depth, varyings, colours.
//!
//! With `d_i = v_i - v_0` and `D` the doubled area, `v = v_0 + (d_1 E_1 + d_2 E_2) / D`. All that is divided is
//! `D`, once a triangle ([`Slopes`]); each function then takes two gradients ([`Plane`]).
//!
//! A value is a number modulo 2^32, in units that its owner chooses so that no covered pixel's value leaves the
//! range: then sums of any multiples of the gradients are right, however large they are on the way.
//!
//! Bit budget and error, with `S` subpixel bits, `2^lz D` in `[2^31, 2^32)` and `R` half its reciprocal, 31 bits:
//!
//! | value | bits |
//! | --- | --- |
//! | `d_i`, in units of 2, and `e_i 2^k`, a gradient of `E_i` | 31 and a sign |
//! | `v = floor((d_1 e_1 2^k + d_2 e_2 2^k) / 2^32)` | 31 and a sign |
//! | `G = floor(v R / 2^32)`, the function's gradient is `G 2^t` a pixel, `t = S + 3 + lz - k` | 30 and a sign |
//! | `b`, a subpixel's part of both gradients | 30 and a sign |
//!
//! `v`'s floor is half a unit of `G`, `G`'s floor is one, the reciprocal is a part in 2^29.5 of at most 2^30 units: 3
//! units of `2^t` in all. In a box below `2^(n + 1)` pixels `t` is at most `10 - n`, so a covered pixel is off by less than
//! `2 2^(n + 1) 3 2^(10 - n)`, and `b`'s floor, a unit of `2^(t + 1)`: 2^14 units for boxes below 512 px. For others `t` is at
//! most 2, which is 2^15.2 to the guard band's ends; what the reciprocal is off is in proportion
//! to `v - v_0`, 2^3 units in all. `t` is the least that `e_i 2^k` fits with, but not below 0: usually far less. Where it is
//! more, in a triangle whose length is some hundred times its width, there is no plane.

use super::doubled_area;
use crate::math::{
    bits, high, high_product, low, normalized, product, reciprocal, signed, unsigned,
};

/// What turns differences over a triangle into gradients.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slopes {
    /// Of `E_1` and `E_2`, to the right, times `2^k`.
    pub(super) across: [i32; 2],
    /// Down.
    pub(super) down: [i32; 2],
    /// `R`, with the sign of the area.
    pub(super) inverse: i32,
    /// `t`: gradients are multiples of `2^steep`.
    pub(super) steep: u32,
    /// From vertex 0 to the centre of its pixel, times `2^31`.
    pub(super) back: [i32; 2],
    /// Vertex 0's pixel.
    pub(super) pixel: [i32; 2],
}

/// A linear function on the screen, modulo 2^32.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Plane {
    /// At the centre of pixel (0, 0).
    origin: u32,
    /// A pixel to the right.
    pub(crate) x: u32,
    /// A pixel down.
    pub(crate) y: u32,
}

impl Slopes {
    /// Of a triangle with these corners in subpixels, and its doubled area; `None` where that is too small for its length.
    #[inline(always)]
    pub(crate) fn new(corners: &[[i32; 2]; 3], area: i64, subpixel_bits: u32) -> Option<Self> {
        debug_assert_eq!(area, doubled_area(corners), "the area is not the corners'");
        let [p, q, r] = corners;
        // The top 32 bits, and lz, which is below 0 for areas of more: up to 38.
        let (normal, zeros) = if i64::from(low(area)) == area {
            let (normal, zeros) = normalized(low(area).unsigned_abs());
            (normal, bits(zeros))
        } else {
            let magnitude = area.unsigned_abs();
            let zeros = magnitude.leading_zeros();
            (high(magnitude << zeros), bits(zeros) - 32)
        };
        let (across, down) = ([r[1] - p[1], p[1] - q[1]], [p[0] - r[0], q[0] - p[0]]);
        let length = |v: i32| unsigned(v ^ v >> 31);
        let longest = length(across[0]) | length(across[1]) | length(down[0]) | length(down[1]);
        let (_, room) = normalized(longest | 1);
        // k with which the longest is below 2^31; t is not below 0.
        let all = bits(subpixel_bits) + 3 + zeros;
        let up = all.min(bits(room) - 1);
        let steep = all - up;
        // Of two sides each is below 2^(32 - room) subpixels, so the box is below twice that: 2^(n + 1) pixels.
        if steep > (bits(room + subpixel_bits) - 22).max(2) {
            return None;
        }
        let inverse = signed(reciprocal(normal) >> 1);
        let half = 1 << (subpixel_bits - 1);
        let fraction = |v: i32| v & ((1 << subpixel_bits) - 1);
        Some(Self {
            across: across.map(|e| e << up),
            down: down.map(|e| e << up),
            inverse: if area < 0 { -inverse } else { inverse },
            steep: unsigned(steep),
            back: [p[0], p[1]].map(|v| (half - fraction(v)) << (31 - subpixel_bits)),
            pixel: [p[0] >> subpixel_bits, p[1] >> subpixel_bits],
        })
    }

    /// `G` of a gradient a pixel, where a difference's unit is 2 of the function's.
    #[inline]
    fn gradient(&self, [d1, d2]: [i32; 2], [e1, e2]: [i32; 2]) -> i32 {
        let v = low((product(d1, e1) + product(d2, e2)) >> 32);
        high_product(v, self.inverse)
    }

    /// The function that is `value` at vertex 0, and twice the differences more at the other two.
    #[inline(always)]
    pub(crate) fn plane(&self, value: u32, differences: [i32; 2]) -> Plane {
        let x = self.gradient(differences, self.across);
        let y = self.gradient(differences, self.down);
        let back = low((product(x, self.back[0]) + product(y, self.back[1])) >> 32);
        let [x, y] = [x, y].map(|gradient| unsigned(gradient) << self.steep);
        let at_pixel = value.wrapping_add(unsigned(back) << (self.steep + 1));
        let [column, row] = self.pixel.map(unsigned);
        let across = x.wrapping_mul(column);
        let origin = at_pixel.wrapping_sub(across).wrapping_sub(y.wrapping_mul(row));
        Plane { origin, x, y }
    }
}

impl Plane {
    /// The value at the centre of a pixel.
    #[inline]
    pub(crate) const fn at(&self, x: i32, y: i32) -> u32 {
        let across = self.x.wrapping_mul(unsigned(x));
        self.origin.wrapping_add(across).wrapping_add(self.y.wrapping_mul(unsigned(y)))
    }

    /// The value at a covered pixel, of a function of both signs.
    #[inline]
    pub(crate) const fn signed_at(&self, x: i32, y: i32) -> i32 {
        signed(self.at(x, y))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::Outline;

    /// The largest error over the pixel centres of a triangle, in parts of the promised.
    fn error(p: [[i32; 2]; 3], bits: u32, v: [u32; 3]) -> Option<f64> {
        let area = doubled_area(&p);
        if area == 0 {
            return None;
        }
        let bounds = Outline::new(&p, area > 0).bounds(bits);
        if bounds.is_empty() {
            return None;
        }
        let difference = |v: u32, u: u32| ((i64::from(v) - i64::from(u)) / 2) as i32;
        let differences = [difference(v[1], v[0]), difference(v[2], v[0])];
        let plane = Slopes::new(&p, area, bits)?.plane(v[0], differences);
        let unit = f64::from(1 << bits);
        let at = |n: i32| (f64::from(n) + 0.5) * unit;
        let point = p.map(|p| p.map(f64::from));
        let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
        let to = |a: [f64; 2], b: [f64; 2]| [b[0] - a[0], b[1] - a[1]];
        let sides = [to(point[0], point[1]), to(point[0], point[2])];
        let size = (bounds.x1 - bounds.x0) | (bounds.y1 - bounds.y0);
        let (width, height) = (bounds.x1 - bounds.x0, bounds.y1 - bounds.y0);
        let promised = if size < 512 { 8192.0 } else { 32768.0 };
        let mut largest = 0.0f64;
        for y in (bounds.y0..bounds.y1).step_by(1 + height as usize / 40) {
            for x in (bounds.x0..bounds.x1).step_by(1 + width as usize / 40) {
                let here = to(point[0], [at(x), at(y)]);
                let d = differences.map(|d| 2.0 * f64::from(d));
                let sum = d[0] * cross(here, sides[1]) + d[1] * cross(sides[0], here);
                let weight = |n: f64| n / area as f64;
                let inside = [cross(here, sides[1]), cross(sides[0], here)].map(weight);
                if inside[0] < 0.0 || inside[1] < 0.0 || inside[0] + inside[1] > 1.0 {
                    continue;
                }
                let exact = f64::from(v[0]) + sum / area as f64;
                let off = f64::from(plane.at(x, y)) - exact;
                largest = largest.max(off.abs() / promised);
            }
        }
        Some(largest)
    }

    /// Random triangles of all sizes and values over the range, slivers among them.
    #[test]
    fn values_at_covered_pixels_are_as_close_as_promised() {
        let mut state = 7u64;
        let mut below = move |n: i32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((state >> 33) % u64::from(n.unsigned_abs())) as i32
        };
        let (mut planes, mut worst) = (0, 0.0f64);
        for i in 0..20_000 {
            let bits = if i % 2 == 0 { 4 } else { 8 };
            let end = 1024 << bits;
            let reach = 2 << below(10 + bits);
            let at = [0, 1].map(|_| below(end) - end / 2);
            let mut p = [[0; 2]; 3]
                .map(|_| at.map(|at: i32| (at + below(2 * reach + 1) - reach).clamp(-end, end)));
            if i % 3 == 0 {
                let t = below(1000);
                let along =
                    |a: i32, b: i32| (i64::from(a) + i64::from(b - a) * i64::from(t) / 1000) as i32;
                p[2] = [
                    along(p[0][0], p[1][0]) + below(5) - 2,
                    along(p[0][1], p[1][1]) + below(5) - 2,
                ];
            }
            let value = |n: i32| match n {
                0 => 1 << 15,
                1 => u32::MAX - (1 << 15),
                n => (n as u32).wrapping_mul(2_654_435_769).clamp(1 << 15, u32::MAX - (1 << 15)),
            };
            let v = [0; 3].map(|_| value(below(1000)));
            if let Some(error) = error(p, bits as u32, v) {
                assert!(error < 1.0, "{p:?}, {bits} bits, {v:?}: {error} of what is promised");
                planes += 1;
                worst = worst.max(error);
            }
        }
        assert!(planes > 8000, "{planes} triangles had a plane");
        assert!(worst > 0.05, "the promise is far from what happens: {worst}");
    }

    /// Sums wrap, so a walk has the same bits as the plane it follows, however long it is.
    #[test]
    fn walks_of_100_000_pixels_end_where_the_plane_is() {
        for (x, y) in [(0x7fff_ffff, 0x8000_0001), (u32::MAX, 1), (12_345_678, 987_654_321)] {
            let plane = Plane { origin: 0xdead_beef, x, y };
            let mut at = plane.at(0, 0);
            for column in 1..=100_000 {
                at = at.wrapping_add(plane.x);
                assert_eq!(at, plane.at(column, 0));
            }
            for row in 1..=100_000 {
                at = at.wrapping_add(plane.y);
                assert_eq!(at, plane.at(100_000, row));
            }
        }
    }
}

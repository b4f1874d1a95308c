//! Gradients over a triangle of the exact tier that is on the screen.
//!
//! What is linear on the screen is `v = v_0 + d_1 b_1 + d_2 b_2` with `b_i = w_i E_i / (W H det)`. So the gradients of
//! `w_i E_i` are those of a projected triangle's edges, and the reciprocal is that of `W H det`; all the rest is
//! [`Slopes`]', whose letters these are.
//!
//! | value | bits | why |
//! | --- | --- | --- |
//! | a minor, cut | 30 | all four on one scale |
//! | `w` times a side | 29 | 20 and 9 |
//! | a gradient `e` of `w_i E_i` | 30 | their product, cut: off by 2 units |
//! | `2 e`, cut further where the function is so gentle that `t` would be negative | 31 | |
//!
//! Error of a value at a covered pixel, where gradients are `G 2^t` and the box is below `2^(n + 1)` pixels:
//! - the reciprocal is off by 3 parts in 2^29, and so is `v - v_0`: by 2^5 units of 2^32;
//! - `2 e` is off by 5 units, which are `5 (d_1 + d_2) / 2^33 < 2.5` of `G`; the floors of `v` and `G` are 1.5;
//! - a covered pixel is less than `2^(n + 2)` columns and rows from vertex 0, and `t` is at most `10 - n`, or 2: `3.5 2^12` units
//!   for both, `3.5 2^13` in a box of 512 pixels;
//! - the floor of `b` is a unit of `2^(t + 1)`: 2^11, or 2^3.
//!
//! In all less than 2^14.9 of 2^32 units: a stored 16-bit depth has 2^15 for it beside the half that rounding takes.

use super::Slopes;
use super::exact::{column_minor, row_minor};
use crate::math::{Scale, bits, low, normalized, product, reciprocal, signed, unsigned};
use crate::vertex::{ExactPosition, Rect, Viewport};

impl Slopes {
    /// Of a triangle whose vertices are on the screen, its determinant and its box, in the viewport's pixels; `None` where
    /// it is too thin.
    #[inline(never)]
    pub(crate) fn homogeneous(
        [p, q, r]: [&ExactPosition; 3],
        determinant: i64,
        bounds: &Rect,
        viewport: &Viewport,
    ) -> Option<Self> {
        let across = [row_minor(r, p), row_minor(p, q)];
        let down = [column_minor(p, r), column_minor(q, p)];
        let magnitude = |v: i64| (v ^ (v >> 63)).unsigned_abs();
        let largest =
            magnitude(across[0]) | magnitude(across[1]) | magnitude(down[0]) | magnitude(down[1]);
        let cut = 34u32.saturating_sub(largest.leading_zeros());
        let (width, height) = (viewport.width, viewport.height);
        let side_bits = 32 - normalized(unsigned(width | height)).1;
        let backwards = determinant < 0;
        let gradient = |minor: i64, w: i32, side: i32| {
            let minor = low(minor >> cut);
            let minor = if backwards { -minor } else { minor };
            low(product(minor, w * side) >> (20 + side_bits))
        };
        let Scale { mantissa, exponent } =
            Scale::reciprocal_of(determinant.unsigned_abs()).times(viewport.inverse_area);
        let size = unsigned(bounds.x1 - bounds.x0) | unsigned(bounds.y1 - bounds.y0);
        // 8 - n.
        let to_spare = (8 + normalized(size).1).saturating_sub(31);
        // Of the sum of differences and gradients, which is 2^32 times what is kept of it.
        let shift = bits(cut + 20 + side_bits) + exponent + 66;
        let finer = (-shift).max(0);
        if shift > bits(to_spare) + 2 || finer > 30 {
            return None;
        }
        let scaled = |e: i32| (e << 1) >> finer;
        let inverse = signed(mantissa >> 1);
        Some(Self {
            across: [gradient(across[0], q.w, height), gradient(across[1], r.w, height)]
                .map(scaled),
            down: [gradient(down[0], q.w, width), gradient(down[1], r.w, width)].map(scaled),
            inverse,
            steep: unsigned(shift + finer),
            back: back(p, viewport),
            pixel: [i32::from(p.column), i32::from(p.row)],
        })
    }
}

/// From a vertex on the screen to the centre of its pixel, times 2^31: below 1.
#[inline]
fn back(p: &ExactPosition, viewport: &Viewport) -> [i32; 2] {
    let (divisor, zeros) = normalized(unsigned(p.w));
    // 2^(62 - zeros) / w in 31 bits.
    let inverse = signed(reciprocal(divisor) >> 1);
    p.past_centre(viewport).map(|v| low(product(-v, inverse) >> (32 - zeros)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::{Tier, determinant};
    use crate::vertex::{ClipVertex, Exact, Snap};

    /// The largest error over the covered pixels of a triangle, in stored units of 2^16.
    fn error(p: [[i32; 3]; 3], v: [u32; 3], viewport: &Viewport) -> Option<f64> {
        let p = p
            .map(|[x, y, w]| Exact::snap(&ClipVertex { raw: [x, y, 0, w], shift: 0 }, 1, viewport));
        let p = [&p[0], &p[1], &p[2]];
        let setup = Exact::set_up(p, viewport)?;
        let bounds = setup.bounds[0];
        if bounds.is_empty() {
            return None;
        }
        let slopes = Slopes::homogeneous(p, determinant(p), &bounds, viewport)?;
        let difference = |v: u32, u: u32| ((i64::from(v) - i64::from(u)) / 2) as i32;
        let differences = [difference(v[1], v[0]), difference(v[2], v[0])];
        let plane = slopes.plane(v[0], differences);
        let (width, height) = (bounds.x1 - bounds.x0, bounds.y1 - bounds.y0);
        let mut largest = 0.0f64;
        for y in (bounds.y0..bounds.y1).step_by(1 + height as usize / 40) {
            for x in (bounds.x0..bounds.x1).step_by(1 + width as usize / 40) {
                let edges = setup.edges_at(x, y);
                if edges.iter().any(|&e| e < 0) {
                    continue;
                }
                let weight = |i: usize| edges[i] as f64 * f64::from(p[i].w);
                let sum = weight(0) + weight(1) + weight(2);
                let d = differences.map(|d| 2.0 * f64::from(d));
                let exact = f64::from(v[0]) + (d[0] * weight(1) + d[1] * weight(2)) / sum;
                largest = largest.max((f64::from(plane.at(x, y)) - exact).abs() / 65_536.0);
            }
        }
        Some(largest)
    }

    /// Random triangles of all sizes, slivers among them, and values over the range.
    #[test]
    fn values_at_covered_pixels_are_as_close_as_promised() {
        let mut state = 7u64;
        let mut below = move |n: i32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((state >> 33) % u64::from(n.unsigned_abs())) as i32
        };
        let (mut planes, mut tried, mut worst) = (0, 0, 0.0f64);
        for i in 0..20_000 {
            let viewport =
                Viewport::new([512, 240, 320, 7][i % 4], [512, 240, 64, 5][i / 4 % 4]).unwrap();
            let near = 1 << below(20);
            let at = [0, 1].map(|_| below(1 << 21) - (1 << 20));
            let reach = 2 << (8 + below(13));
            let mut p = [[0; 3]; 3].map(|_| {
                let w = (1 << 20) - if i % 2 == 0 { below(near) } else { 0 };
                let mut to = |at: i32| (at + below(2 * reach + 1) - reach).clamp(-w, w);
                [to(at[0]), to(at[1]), w]
            });
            if i % 3 == 0 {
                let t = below(1000);
                let along =
                    |a: i32, b: i32| (i64::from(a) + i64::from(b - a) * i64::from(t) / 1000) as i32;
                let wide = 1 << below(14);
                let off = [below(wide) - wide / 2, below(wide) - wide / 2, 0];
                p[2] = [0, 1, 2].map(|n| along(p[0][n], p[1][n]) + off[n]);
            }
            let value = |n: i32| match n {
                0 => 1 << 15,
                1 => u32::MAX - (1 << 15),
                n => (n as u32).wrapping_mul(2_654_435_769).clamp(1 << 15, u32::MAX - (1 << 15)),
            };
            let v = [0; 3].map(|_| value(below(1000)));
            tried += 1;
            if let Some(error) = error(p, v, &viewport) {
                assert!(error < 0.45, "{p:?}, {v:?}: off by {error}");
                planes += 1;
                worst = worst.max(error);
            }
        }
        assert!(planes > 4000, "{planes} triangles of {tried} had a plane");
        assert!(worst > 0.05, "the promise is far from what happens: {worst}");
    }
}

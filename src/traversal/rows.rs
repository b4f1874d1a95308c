//! The rows of a projected triangle: two edges at a time, each by an exact division once.
//!
//! An edge is taken from its upper to its lower corner, whatever side of the triangle it is on: a
//! left edge begins its spans at the first pixel whose centre is at or right of it, a right edge
//! ends them there, so that a centre on an edge belongs to the triangle on its right: the top-left
//! rule, ties included. Rows whose centre is on the upper corner's height belong to the edge, those
//! on the lower one's do not.
//!
//! With `(x, y)` the upper corner in subpixels, `dx`, `dy` the way to the lower one and `h` half a pixel, the
//! first such pixel of a row whose centre is `f` below the corner is
//!
//! ```text
//! ceil((x + dx f / dy - h) / 2^S) = X - floor(floor(((h - fx) dy - dx f) / 2^S) / dy),  x = 2^S X + fx
//! ```
//!
//! for the first row `f < 2^S`. The remainder of that division is how far the edge is left of the
//! centre, in units of a pixel / `dy`; a row further adds `dx` of those. A corner is at most 1024 px
//! from the viewport's, so (`S = 8`):
//!
//! | value | bits |
//! | --- | --- |
//! | `dx`, `dy`, a remainder | 19 |
//! | `(h - fx) dy - dx f` | 28 |
//! | a remainder times the rows above a box, at most 1,536 | 30 |
//!
//! Did not pay on a Cortex-M4: leaving out the slope's division for an edge of one row (W3 684 to 729 a
//! triangle, a Cortex-M0 1035 to 1020), and the two halves as two calls instead of a loop (W3 754).

use crate::setup::{Corner, Outline};
use crate::vertex::Rect;

/// An edge on one row.
#[derive(Clone, Copy, Debug)]
struct Side {
    /// The first column whose centre is not left of the edge.
    x: i32,
    /// How far left of that centre the edge is, in pixels / `height`: `0 <= ahead < height`.
    ahead: i32,
    /// The edge's way in a row: whole pixels, floored, and the rest in pixels / `height`.
    whole: i32,
    rest: i32,
    height: i32,
}

impl Side {
    /// The edge from `upper` to `lower` on row `row`, which it has; also on no row, where both are
    /// of one.
    #[inline]
    fn new(upper: Corner, lower: Corner, row: i32, bits: u32) -> Self {
        let (dx, dy) = (lower.x - upper.x, lower.y - upper.y);
        let half = (1 << bits) / 2;
        let f = (upper.row << bits) + half - upper.y;
        let fx = upper.x & ((1 << bits) - 1);
        let (back, ahead) = divide(((half - fx) * dy - dx * f) >> bits, dy);
        let (whole, rest) = divide(dx, dy);
        let mut side = Self { x: (upper.x >> bits) - back, ahead, whole, rest, height: dy };
        if row > upper.row {
            side.skip(row - upper.row);
        }
        side
    }

    /// Goes `rows` further, 1,536 at most.
    #[cold]
    fn skip(&mut self, rows: i32) {
        let (back, ahead) = divide(self.ahead - self.rest * rows, self.height);
        self.x += self.whole * rows - back;
        self.ahead = ahead;
    }

    /// The next row.
    #[inline]
    fn step(&mut self) {
        self.x += self.whole;
        self.ahead -= self.rest;
        // -1 where the edge has passed the centre.
        let passed = self.ahead >> 31;
        self.x -= passed;
        self.ahead += self.height & passed;
    }
}

/// `n / d` floored, and the remainder; `d > 0`, or both results are meaningless.
#[inline]
fn divide(n: i32, d: i32) -> (i32, i32) {
    if cfg!(all(target_arch = "arm", not(target_has_atomic = "32"))) {
        // A division is a call of some 200 instructions there; most quotients are small.
        if n >= -8 * d && n < 8 * d {
            return walk(n, d);
        }
    }
    let q = n.checked_div(d).unwrap_or(0);
    let r = n - q * d;
    // The processor's division rounds towards 0.
    let below = r >> 31;
    (q + below, r + (d & below))
}

/// [`divide`] by additions, for quotients of -8 to 7.
#[inline]
fn walk(n: i32, d: i32) -> (i32, i32) {
    let (mut q, mut r) = (0, n);
    while r < 0 {
        r += d;
        q -= 1;
    }
    while r >= d {
        r -= d;
        q += 1;
    }
    (q, r)
}

/// A run of rows between the same two edges: its spans from the top, some of them empty.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Half {
    left: Side,
    right: Side,
    rows: i32,
}

impl Iterator for Half {
    type Item = (i32, i32);

    #[inline(always)]
    fn next(&mut self) -> Option<(i32, i32)> {
        if self.rows <= 0 {
            return None;
        }
        self.rows -= 1;
        let span = (self.left.x, self.right.x);
        self.left.step();
        self.right.step();
        Some(span)
    }
}

/// The rows `bounds.y0 .. bounds.y1` of a triangle, which has them all: `each` is given a first row and
/// the rows from there between the same two edges, to take them all, twice at most. Columns are the
/// triangle's own, moved right by `columns`.
#[inline]
pub(crate) fn halves(
    outline: &Outline,
    bounds: Rect,
    columns: i32,
    bits: u32,
    mut each: impl FnMut(i32, &mut Half),
) {
    let Outline { corners: [top, middle, bottom], turns_right } = *outline;
    let side = |upper: Corner, lower: Corner, row: i32| {
        let mut side = Side::new(upper, lower, row, bits);
        side.x += columns;
        side
    };
    let mut y = bounds.y0;
    let mut long = side(top, bottom, y);
    for (upper, lower) in [(top, middle), (middle, bottom)] {
        let end = lower.row.min(bounds.y1);
        if y < end {
            let short = side(upper, lower, y);
            let (left, right) = if turns_right { (long, short) } else { (short, long) };
            let mut half = Half { left, right, rows: end - y };
            each(y, &mut half);
            long = if turns_right { half.left } else { half.right };
            y = end;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::doubled_area;
    use std::vec::Vec;

    /// What edge functions in 64 bits cover of a row, from column -1300 to 1300.
    fn covered(p: &[[i32; 2]; 3], sign: i64, row: i32, bits: u32) -> Vec<i32> {
        let p = p.map(|p| p.map(i64::from));
        let half = (1i64 << bits) / 2;
        let y = (i64::from(row) << bits) + half;
        let inside = |x: i64| {
            [(0, 1), (1, 2), (2, 0)].iter().all(|&(i, j): &(usize, usize)| {
                let (a, b) = (sign * (p[i][1] - p[j][1]), sign * (p[j][0] - p[i][0]));
                let e = a * (x - p[i][0]) + b * (y - p[i][1]);
                e > 0 || (e == 0 && (a > 0 || (a == 0 && b > 0)))
            })
        };
        (-1300..1300).filter(|&x| inside((i64::from(x) << bits) + half)).collect()
    }

    /// All rows of a triangle from `y0` to `y1` against [`covered`].
    fn follows(p: [[i32; 2]; 3], bits: u32, y0: i32, y1: i32) {
        let area = doubled_area(&p);
        if area == 0 {
            return;
        }
        let outline = Outline::new(&p, area > 0, bits);
        let whole = outline.bounds(bits);
        let bounds = Rect { y0: whole.y0.max(y0), y1: whole.y1.min(y1), ..whole };
        let mut seen = bounds.y0;
        let check = |row: i32, span: Vec<i32>| {
            let exact = covered(&p, area.signum(), row, bits);
            assert_eq!(span, exact, "{p:?}, {bits} bits, row {row} of {bounds:?}");
            assert!(span.iter().all(|x| (whole.x0..whole.x1).contains(x)));
        };
        if !bounds.is_empty() {
            halves(&outline, bounds, 7, bits, |y, half| {
                assert_eq!(y, seen);
                for (x0, x1) in half {
                    check(seen, (x0 - 7..x1 - 7).collect());
                    seen += 1;
                }
            });
            assert_eq!(seen, bounds.y1);
        }
        if y0 <= whole.y0 && y1 >= whole.y1 {
            assert!(covered(&p, area.signum(), whole.y0 - 1, bits).is_empty());
            assert!(covered(&p, area.signum(), whole.y1.max(whole.y0), bits).is_empty());
        }
    }

    /// Random triangles, small, thin, and up to the guard band's ends, whole and cut.
    #[test]
    fn rows_equal_edge_functions() {
        let mut state = 1u64;
        let mut below = move |n: i32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((state >> 33) % u64::from(n.unsigned_abs())) as i32
        };
        for i in 0..3000 {
            let bits = if i % 2 == 0 { 4 } else { 8 };
            // Sides of 2 subpixels to the whole guard band.
            let reach = 1 << (1 + below(10 + bits));
            let end = 1024 << bits;
            let at = [0, 1].map(|_| below(end) - end / 2);
            let mut p = [[0; 2]; 3]
                .map(|_| at.map(|at| (at + below(2 * reach + 1) - reach).clamp(-end, end)));
            match i % 5 {
                0 => p = p.map(|c| c.map(|v| v & !((1 << (bits - 1)) - 1))),
                1 => p[2][1] = p[1][1],
                2 => p[2] = [p[1][0] + below(3) - 1, (p[1][1] + 1).min(end)],
                _ => {}
            }
            let y0 = below(600) - 100;
            let (y0, y1) = [(-2000, 2000), (y0, y0 + 1), (y0, y0 + 40)][i as usize % 3];
            follows(p, bits as u32, y0, y1);
        }
    }

    #[test]
    fn the_guard_bands_ends_do_not_overflow() {
        for bits in [4, 8] {
            let ends = [-(1024 << bits), 0, 1, 1024 << bits];
            for i in 0..4usize.pow(6) {
                let p = [0, 2, 4].map(|n| [ends[i >> (2 * n) & 3], ends[i >> (2 * n + 2) & 3]]);
                for (y0, y1) in [(0, 1), (511, 512), (-1024, -1023)] {
                    follows(p, bits, y0, y1);
                }
            }
        }
    }

    #[test]
    fn quotients_by_additions_are_quotients() {
        for d in 1..40 {
            for n in -8 * d..8 * d {
                assert_eq!(walk(n, d), (n.div_euclid(d), n.rem_euclid(d)));
                assert_eq!(walk(n, d), divide(n, d));
            }
        }
    }
}

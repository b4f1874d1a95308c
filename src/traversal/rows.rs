//! The rows of a triangle whose corners are all in the guard band: two edges at a time.
//!
//! An edge is taken from its upper to its lower corner, whatever side of the triangle it is on: a
//! left edge begins its spans at the first pixel whose centre is at or right of it, a right edge
//! ends them there, so that a centre on an edge belongs to the triangle on its right: the top-left
//! rule, ties included. Rows whose centre is on the upper corner's height belong to the edge, those
//! on the lower one's do not.

use super::side::Side;
use crate::setup::{Outline, Place};
use crate::vertex::Rect;

/// A run of rows between the same two edges: its spans from the top, some of them empty.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Half<S> {
    left: S,
    right: S,
    rows: i32,
}

impl<S: Side> Iterator for Half<S> {
    type Item = (i32, i32);

    #[inline(always)]
    fn next(&mut self) -> Option<(i32, i32)> {
        if self.rows <= 0 {
            return None;
        }
        self.rows -= 1;
        let span = (self.left.x(), self.right.x());
        self.left.step();
        self.right.step();
        Some(span)
    }
}

/// The halves of a triangle, above and below its middle corner: [`next`](Self::next) hands out one, and
/// [`resume`](Self::resume) takes it back when all its rows are drawn.
///
/// A loop over them rather than a call for each, so that what is done with the rows stands once in the code, and
/// the edges stay in registers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Halves<'a, S: Side> {
    outline: &'a Outline<S::Corner>,
    bits: u32,
    long: S,
    y: i32,
    end: i32,
}

impl<'a, S: Side> Halves<'a, S> {
    /// The rows `bounds.y0 .. bounds.y1` of a triangle, which has them all, and at least one.
    #[inline(always)]
    pub(crate) fn new(outline: &'a Outline<S::Corner>, bounds: Rect, bits: u32) -> Self {
        let [top, _, bottom] = outline.corners;
        let long = S::new(top, bottom, bounds.y0, bits);
        Self { outline, bits, long, y: bounds.y0, end: bounds.y1 }
    }

    /// The next half, and its first row.
    #[inline(always)]
    pub(crate) fn next(&mut self) -> Option<(i32, Half<S>)> {
        let y = self.y;
        if y >= self.end {
            return None;
        }
        let Outline { corners: [top, middle, bottom], turns_right } = *self.outline;
        let (upper, lower) =
            if y < middle.row(self.bits) { (top, middle) } else { (middle, bottom) };
        self.y = lower.row(self.bits).min(self.end);
        let short = S::new(upper, lower, y, self.bits);
        let (left, right) = if turns_right { (self.long, short) } else { (short, self.long) };
        Some((y, Half { left, right, rows: self.y - y }))
    }

    /// Takes a half back.
    #[inline(always)]
    pub(crate) fn resume(&mut self, half: Half<S>) {
        self.long = if self.outline.turns_right { half.left } else { half.right };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::{Corner, doubled_area};
    use crate::traversal::side::{Digital, Line, Short};
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
        follows_by::<Line>(p, bits, y0, y1);
        let bounds = Outline::new(&p, true).bounds(bits);
        if Short::fits(bounds) {
            // Its columns are counted from the box's.
            let left = bounds.x0 << bits;
            follows_by::<Short>(p.map(|[x, y]| [x - left, y]), bits, y0, y1);
        }
        follows_by::<Digital>(p, bits, y0, y1);
    }

    fn follows_by<S: Side<Corner = Corner>>(p: [[i32; 2]; 3], bits: u32, y0: i32, y1: i32) {
        let area = doubled_area(&p);
        if area == 0 {
            return;
        }
        let outline = Outline::new(&p, area > 0);
        let whole = outline.bounds(bits);
        let bounds = Rect { y0: whole.y0.max(y0), y1: whole.y1.min(y1), ..whole };
        let mut seen = bounds.y0;
        let check = |row: i32, span: Vec<i32>| {
            let exact = covered(&p, area.signum(), row, bits);
            assert_eq!(span, exact, "{p:?}, {bits} bits, row {row} of {bounds:?}");
            assert!(span.iter().all(|x| (whole.x0..whole.x1).contains(x)));
        };
        if !bounds.is_empty() {
            let mut halves = Halves::<S>::new(&outline, bounds, bits);
            while let Some((y, mut half)) = halves.next() {
                assert_eq!(y, seen);
                for (x0, x1) in &mut half {
                    check(seen, (x0..x1).collect());
                    seen += 1;
                }
                halves.resume(half);
            }
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
}

//! The rows of a triangle whose corners are all in the guard band: two edges at a time.
//!
//! An edge is taken from its upper to its lower corner, whatever side of the triangle it is on: a
//! left edge begins its spans at the first pixel whose centre is at or right of it, a right edge
//! ends them there, so that a centre on an edge belongs to the triangle on its right: the top-left
//! rule, ties included. Rows whose centre is on the upper corner's height belong to the edge, those
//! on the lower one's do not.

use super::side::{Side, SmallSide};
use crate::setup::{Outline, Place};
use crate::vertex::Rect;

/// The rows of a triangle from the top: their spans, some of them empty.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rows<'a, S: Side> {
    outline: &'a Outline<S::Corner>,
    bits: u32,
    left: S,
    right: S,
    /// Rows that are left until the row `next`.
    rows: i32,
    /// Where the next corner is, or the end.
    next: i32,
    end: i32,
}

impl<'a, S: Side> Rows<'a, S> {
    /// The rows `bounds.y0 .. bounds.y1` of a triangle, which has them all.
    #[inline(always)]
    pub(crate) fn new(outline: &'a Outline<S::Corner>, bounds: Rect, bits: u32) -> Self {
        let Outline { top, left, right } = *outline;
        let middle = left.row(bits).min(right.row(bits)).max(bounds.y0).min(bounds.y1);
        Self {
            outline,
            bits,
            left: S::new(top, left, bounds.y0, bits),
            right: S::new(top, right, bounds.y0, bits),
            rows: middle - bounds.y0,
            next: middle,
            end: bounds.y1,
        }
    }

    /// At the corner that is not the lowest: from there an edge goes to the one that is. `None` where there are no rows
    /// below.
    #[inline(always)]
    fn turn(&mut self) -> Option<()> {
        let row = self.next;
        if row >= self.end {
            return None;
        }
        (self.rows, self.next) = (self.end - row, self.end);
        let Outline { left, right, .. } = *self.outline;
        if left.row(self.bits) < right.row(self.bits) {
            self.left = S::new(left, right, row, self.bits);
        } else {
            self.right = S::new(right, left, row, self.bits);
        }
        Some(())
    }
}

impl<S: Side> Iterator for Rows<'_, S> {
    type Item = (i32, i32);

    #[inline(always)]
    fn next(&mut self) -> Option<(i32, i32)> {
        if self.rows <= 0 {
            self.turn()?;
        }
        self.rows -= 1;
        let span = (self.left.x(), self.right.x());
        self.left.step();
        self.right.step();
        Some(span)
    }
}

/// The rows of a small triangle, with all three edges from the start: in registers, or made while there are some.
///
/// Its spans are runs of pixels in a target of rows of some width, counted from the box's first one on: from a row to the next
/// an edge goes that width further, and no row needs a place of its own.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShortRows<S> {
    left: S,
    right: S,
    /// The edge between the two lower corners.
    lower: S,
    lower_is_left: bool,
    /// Rows above those corners, and below, until they are there.
    rows: i32,
    below: i32,
}

impl<S: SmallSide> ShortRows<S> {
    /// All rows of a triangle, of which this is the box, in a target of at most [`WIDEST`](super::WIDEST).
    #[inline(always)]
    pub(crate) fn new(outline: &Outline, bounds: Rect, bits: u32, width: i32) -> Self {
        let Outline { top, left, right } = *outline;
        let lower_is_left = left.row(bits) < right.row(bits);
        let (upper, lower) = if lower_is_left { (left, right) } else { (right, left) };
        let rows = upper.row(bits) - bounds.y0;
        Self {
            left: S::new(top, left, bits, width),
            right: S::new(top, right, bits, width),
            lower: S::new(upper, lower, bits, width).further(rows * width),
            lower_is_left,
            rows,
            below: bounds.y1 - bounds.y0 - rows,
        }
    }
}

impl<S: SmallSide> Iterator for ShortRows<S> {
    type Item = (i32, i32);

    #[inline(always)]
    fn next(&mut self) -> Option<(i32, i32)> {
        if self.rows <= 0 {
            if self.below <= 0 {
                return None;
            }
            (self.rows, self.below) = (self.below, 0);
            *(if self.lower_is_left { &mut self.left } else { &mut self.right }) = self.lower;
        }
        self.rows -= 1;
        let run = (self.left.pixel(), self.right.pixel());
        self.left.step();
        self.right.step();
        Some(run)
    }
}

/// What edge functions in 64 bits cover of a row of a triangle whose doubled area has that sign, of those columns.
#[cfg(test)]
pub(super) fn covered(
    p: &[[i32; 2]; 3],
    sign: i64,
    row: i32,
    bits: u32,
    columns: core::ops::Range<i32>,
) -> std::vec::Vec<i32> {
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
    columns.filter(|&x| inside((i64::from(x) << bits) + half)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::doubled_area;
    use crate::traversal::side::{Digital, Line, Short, WIDEST, Walked, is_small};
    use std::vec::Vec;

    /// All rows of a triangle from `y0` to `y1` against [`covered`].
    fn follows(p: [[i32; 2]; 3], bits: u32, y0: i32, y1: i32) {
        let area = doubled_area(&p);
        if area == 0 {
            return;
        }
        let outline = Outline::new(&p, area > 0);
        let whole = outline.bounds(bits);
        let bounds = Rect { y0: whole.y0.max(y0), y1: whole.y1.min(y1), ..whole };
        let check = |rows: &mut dyn Iterator<Item = (i32, i32)>, bounds: Rect| {
            let mut seen = bounds.y0;
            for (x0, x1) in rows {
                let span: Vec<i32> = (x0..x1).collect();
                let exact = covered(&p, area.signum(), seen, bits, -1300..1300);
                assert_eq!(span, exact, "{p:?}, {bits} bits, row {seen} of {bounds:?}");
                assert!(span.iter().all(|x| (whole.x0..whole.x1).contains(x)));
                seen += 1;
            }
            assert_eq!(seen, bounds.y1);
        };
        if !bounds.is_empty() {
            check(&mut Rows::<Line>::new(&outline, bounds, bits), bounds);
            check(&mut Rows::<Digital>::new(&outline, bounds, bits), bounds);
        }
        if !whole.is_empty() && is_small(whole) {
            let moved = outline.moved(-whole.x0, bits);
            let mut first = 0;
            let mut columns = |(i0, i1)| {
                let at = whole.x0 - first;
                first += WIDEST;
                (i0 + at, i1 + at)
            };
            let rows = ShortRows::<Short>::new(&moved, whole, bits, WIDEST);
            check(&mut rows.map(&mut columns), whole);
            first = 0;
            let mut columns = |(i0, i1)| {
                let at = whole.x0 - first;
                first += WIDEST;
                (i0 + at, i1 + at)
            };
            let rows = ShortRows::<Walked>::new(&moved, whole, bits, WIDEST);
            check(&mut rows.map(&mut columns), whole);
        }
        if y0 <= whole.y0 && y1 >= whole.y1 {
            assert!(covered(&p, area.signum(), whole.y0 - 1, bits, -1300..1300).is_empty());
            assert!(
                covered(&p, area.signum(), whole.y1.max(whole.y0), bits, -1300..1300).is_empty()
            );
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

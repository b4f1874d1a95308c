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
    let q = n.checked_div_euclid(d).unwrap_or(0);
    (q, n - q * d)
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

/// The spans of a projected triangle's rows from the top, some of them empty.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rows {
    left: Side,
    right: Side,
    row: i32,
    /// The first row of the lower half, and the first below the triangle.
    turn: i32,
    end: i32,
    /// What comes in at the turn.
    middle: Corner,
    bottom: Corner,
    turns_right: bool,
    bits: u32,
}

impl Rows {
    /// Rows `bounds.y0 .. bounds.y1`, which are rows of the triangle. Columns are the triangle's own.
    #[inline]
    pub(crate) fn new(outline: &Outline, bounds: Rect, bits: u32) -> Self {
        let Outline { corners: [top, middle, bottom], turns_right } = *outline;
        let row = bounds.y0;
        let long = Side::new(top, bottom, row, bits);
        let (short, turn) = if middle.row > row {
            (Side::new(top, middle, row, bits), middle.row.min(bounds.y1))
        } else {
            (Side::new(middle, bottom, row, bits), bounds.y1)
        };
        let (left, right) = if turns_right { (long, short) } else { (short, long) };
        Self { left, right, row, turn, end: bounds.y1, middle, bottom, turns_right, bits }
    }
}

impl Iterator for Rows {
    type Item = (i32, i32);

    #[inline]
    fn next(&mut self) -> Option<(i32, i32)> {
        if self.row == self.turn {
            if self.row == self.end {
                return None;
            }
            let short = Side::new(self.middle, self.bottom, self.row, self.bits);
            if self.turns_right {
                self.right = short;
            } else {
                self.left = short;
            }
            self.turn = self.end;
        }
        let span = (self.left.x, self.right.x);
        self.left.step();
        self.right.step();
        self.row += 1;
        Some(span)
    }
}

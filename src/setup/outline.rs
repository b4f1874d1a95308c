//! Setup of three projected vertices: what coverage alone needs, in 32 bits.
//!
//! Corners are in subpixels, at most `2^(10 + S)` from the viewport's corner, `S` 4 or 8. Their
//! differences take 20 bits, the doubled area 38: it is the only value here of more than 32 bits.
//! No edge function is made, no box is needed but to clip, and nothing is divided.

use super::Facing;
use crate::vertex::Rect;

/// A corner on the subpixel grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Corner {
    pub(crate) x: i32,
    pub(crate) y: i32,
}

/// A corner that a triangle's rows begin or end at.
pub(crate) trait Place: Copy + core::fmt::Debug {
    /// The first row whose centre is not above it, where its coordinates have `bits` subpixel bits.
    fn row(self, bits: u32) -> i32;

    /// The same, whole pixels further to the right.
    fn moved(self, columns: i32, bits: u32) -> Self;
}

impl Place for Corner {
    #[inline]
    fn row(self, bits: u32) -> i32 {
        first_centre(self.y, bits)
    }

    #[inline]
    fn moved(self, columns: i32, bits: u32) -> Self {
        Self { x: self.x + (columns << bits), ..self }
    }
}

/// The corners of a triangle: the highest, and those that its left and its right side go to from there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outline<C = Corner> {
    pub(crate) top: C,
    pub(crate) left: C,
    pub(crate) right: C,
}

/// The doubled area of the triangle `p q r` in square subpixels, positive where it is clockwise on the
/// screen.
///
/// Differences of less than `2^15` make an area below `2^31`.
#[inline]
pub(crate) fn doubled_area([p, q, r]: &[[i32; 2]; 3]) -> i64 {
    let (ax, ay, bx, by) = (q[0] - p[0], q[1] - p[1], r[0] - p[0], r[1] - p[1]);
    if cfg!(all(target_arch = "arm", not(target_has_atomic = "32"))) {
        // A 64-bit product is a call of 37 instructions there.
        let short = |v: i32| (v + (1 << 15)) & !0xffff;
        if short(ax) | short(ay) | short(bx) | short(by) == 0 {
            return i64::from(ax * by - ay * bx);
        }
    }
    i64::from(ax) * i64::from(by) - i64::from(ay) * i64::from(bx)
}

/// Which way a projected triangle of some doubled area faces; `None` where it has none.
#[inline]
pub(crate) fn facing(doubled_area: i64) -> Option<Facing> {
    // y is down: a front face is counter-clockwise, which is negative here.
    match doubled_area {
        0 => None,
        ..0 => Some(Facing::Front),
        _ => Some(Facing::Back),
    }
}

/// The first column or row whose centre is at or beyond a coordinate.
#[inline]
pub(crate) const fn first_centre(v: i32, bits: u32) -> i32 {
    (v + ((1 << bits) / 2 - 1)) >> bits
}

/// The box of the pixel centres that a triangle of corners in subpixels may cover.
#[inline]
pub(crate) fn bounds_of([p, q, r]: &[[i32; 2]; 3], bits: u32) -> Rect {
    let ((x0, x1), (y0, y1)) = (extent([p[0], q[0], r[0]], bits), extent([p[1], q[1], r[1]], bits));
    Rect { x0, y0, x1, y1 }
}

/// The rows of that box.
#[cfg(feature = "heapless")]
#[inline]
pub(crate) fn rows_of([p, q, r]: &[[i32; 2]; 3], bits: u32) -> (i32, i32) {
    extent([p[1], q[1], r[1]], bits)
}

/// The first centre at or beyond the least of three coordinates, and beyond the largest.
#[inline]
fn extent([p, q, r]: [i32; 3], bits: u32) -> (i32, i32) {
    (first_centre(p.min(q).min(r), bits), first_centre(p.max(q).max(r), bits))
}

impl<C: Place> Outline<C> {
    /// The same, whole pixels further to the right.
    #[inline]
    pub(crate) fn moved(&self, columns: i32, bits: u32) -> Self {
        let Self { top, left, right } = self;
        Self {
            top: top.moved(columns, bits),
            left: left.moved(columns, bits),
            right: right.moved(columns, bits),
        }
    }
}

impl<C: Copy> Outline<C> {
    /// Of a triangle that is clockwise on the screen or not, from corners of some height, down.
    #[inline(always)]
    pub(crate) fn from_top(corners: [C; 3], clockwise: bool, height: impl Fn(&C) -> i32) -> Self {
        let [p, q, r] = corners;
        let (q, r) = if clockwise { (q, r) } else { (r, q) };
        // Turned, not sorted: the order around the triangle says what is left and right.
        let [of_p, of_q, of_r] = [height(&p), height(&q), height(&r)];
        if of_q < of_p && of_q <= of_r {
            Self { top: q, right: r, left: p }
        } else if of_r < of_p {
            Self { top: r, right: p, left: q }
        } else {
            Self { top: p, right: q, left: r }
        }
    }
}

impl Outline {
    /// From corners in subpixels, and the sign of their doubled area.
    #[inline]
    pub(crate) fn new(points: &[[i32; 2]; 3], clockwise: bool) -> Self {
        Self::from_top(points.map(|[x, y]| Corner { x, y }), clockwise, |corner| corner.y)
    }

    /// The box of the pixel centres it may cover.
    #[inline]
    pub(crate) fn bounds(&self, bits: u32) -> Rect {
        let Self { top, left, right } = *self;
        Rect {
            x0: first_centre(top.x.min(left.x).min(right.x), bits),
            y0: top.row(bits),
            x1: first_centre(top.x.max(left.x).max(right.x), bits),
            y1: left.row(bits).max(right.row(bits)),
        }
    }
}

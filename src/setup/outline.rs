//! Setup of three projected vertices: what coverage alone needs, in 32 bits.
//!
//! Corners are in subpixels, at most `2^(10 + S)` from the viewport's corner, `S` 4 or 8. Their
//! differences take 20 bits, the doubled area 38: it is the only value here of more than 32 bits.
//! No edge function is made, no box is needed but to clip, and nothing is divided.

use super::Facing;
use crate::vertex::Rect;
use core::mem::swap;

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
}

impl Place for Corner {
    #[inline]
    fn row(self, bits: u32) -> i32 {
        first_centre(self.y, bits)
    }
}

/// The corners of a triangle from the top down.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outline<C = Corner> {
    pub(crate) corners: [C; 3],
    /// The middle corner is right of the line between the other two.
    pub(crate) turns_right: bool,
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

impl<C: Copy> Outline<C> {
    /// Corners in the order of their heights, of a triangle that is clockwise on the screen or not.
    #[inline]
    pub(crate) fn sorted(corners: [C; 3], clockwise: bool, height: impl Fn(&C) -> i32) -> Self {
        let [mut top, mut middle, mut bottom] = corners;
        let mut turns_right = clockwise;
        if height(&middle) < height(&top) {
            swap(&mut top, &mut middle);
            turns_right = !turns_right;
        }
        if height(&bottom) < height(&middle) {
            swap(&mut middle, &mut bottom);
            turns_right = !turns_right;
            if height(&middle) < height(&top) {
                swap(&mut top, &mut middle);
                turns_right = !turns_right;
            }
        }
        Self { corners: [top, middle, bottom], turns_right }
    }
}

impl Outline {
    /// From corners in subpixels, and the sign of their doubled area.
    #[inline]
    pub(crate) fn new(points: &[[i32; 2]; 3], clockwise: bool) -> Self {
        Self::sorted(points.map(|[x, y]| Corner { x, y }), clockwise, |corner| corner.y)
    }

    /// The same, whole pixels further to the right.
    #[inline]
    pub(crate) fn moved(mut self, columns: i32, bits: u32) -> Self {
        for corner in &mut self.corners {
            corner.x += columns << bits;
        }
        self
    }

    /// The box of the pixel centres it may cover.
    #[inline]
    pub(crate) fn bounds(&self, bits: u32) -> Rect {
        let [p, q, r] = self.corners;
        Rect {
            x0: first_centre(p.x.min(q.x).min(r.x), bits),
            y0: p.row(bits),
            x1: first_centre(p.x.max(q.x).max(r.x), bits),
            y1: r.row(bits),
        }
    }
}

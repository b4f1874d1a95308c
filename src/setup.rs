//! Triangle setup: three snapped vertices in, three edge functions and a box out.
//!
//! With `M` the 3 x 3 matrix whose rows are the vertices `(x, y, w)`, the edge functions are the
//! rows of `adj(M)`: each is zero on an edge and has the sign of `det M` at the vertex opposite
//! (Olano & Greer 1997, sections 4 and 5.1, equation 4). No vertex is divided by its `w`. The
//! determinant's sign is the facing (section 5.2). Where all three, oriented by that sign, are
//! positive, the triangle is in front of the eye; where all are negative it is behind (the footnote
//! in 5.1).
//!
//! The edges come out as integers over the screen, the same form for every tier:
//! `E_i(X, Y) = ((a_i X + b_i Y) << step) + c_i` at the centre of pixel `(X, Y)`, positive inside.
//! From them everything else follows: coverage is their signs, clip planes and attributes are their
//! linear combinations.

mod exact;
mod outline;
mod plane;
mod quick;
mod slopes;

pub(crate) use exact::{Anchored, determinant, outline};
pub(crate) use outline::{Corner, Outline, Place, doubled_area, facing};
pub(crate) use plane::{Plane, Slopes};

use crate::math::Scale;
use crate::vertex::{ExactPosition, Rect, Snap, Viewport};

/// A tier: how vertices are snapped, and how triangles are set up from them.
///
/// A type parameter, so that all of them fit one binary: [`Exact`](crate::Exact),
/// [`Quick<4>`](crate::Quick) and [`Quick<8>`](crate::Quick).
pub trait Tier: Snap {
    /// Fraction bits of projected vertices.
    #[doc(hidden)]
    const SUBPIXEL_BITS: u32;

    /// Whether vertices are projected where they can be; otherwise all are on the exact tier's grid.
    #[doc(hidden)]
    const PROJECTS: bool = false;

    /// The corners in subpixels, y down, of three projected vertices.
    #[doc(hidden)]
    fn corners(vertices: [&Self::Position; 3]) -> [[i32; 2]; 3];

    /// The vertices on the exact tier's grid, where that is the tier's.
    #[doc(hidden)]
    #[inline]
    #[must_use]
    fn homogeneous(_: [&Self::Position; 3]) -> Option<[&ExactPosition; 3]> {
        None
    }

    /// The determinant, adjugate and box of a triangle.
    #[doc(hidden)]
    fn set_up(vertices: [&Self::Position; 3], viewport: &Viewport) -> Option<Setup>;
}

/// Which way a triangle faces: counter-clockwise in normalized device coordinates is the front.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Facing {
    /// Counter-clockwise, y up: a positive determinant.
    Front,
    /// Clockwise.
    Back,
}

/// Which facing is not drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Cull {
    /// Both are drawn.
    #[default]
    Neither,
    /// Front faces are not drawn.
    Front,
    /// Back faces are not drawn: right for closed meshes seen from outside.
    Back,
}

impl Facing {
    /// Of the determinant of three vertices in clip space; `None` where it is 0.
    #[inline]
    pub(crate) const fn of(determinant: i64) -> Option<Self> {
        match determinant {
            0 => None,
            1.. => Some(Self::Front),
            _ => Some(Self::Back),
        }
    }
}

impl Cull {
    /// Whether a facing is left out.
    #[inline]
    pub(crate) fn hides(self, facing: Facing) -> bool {
        matches!((self, facing), (Self::Front, Facing::Front) | (Self::Back, Facing::Back))
    }
}

/// Which part of a triangle: the one in front of the eye, or its mirror behind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    Front,
    Behind,
}

/// A triangle that has been set up: oriented edge functions, and what turns them into weights.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Setup {
    /// `dE / dX`, `dE / dY` of a pixel, divided by `2^step`; positive inside the front part.
    pub(crate) a: [i64; 3],
    pub(crate) b: [i64; 3],
    /// `E` at the centre of pixel (0, 0).
    pub(crate) c: [i64; 3],
    pub(crate) step: u32,
    pub(crate) facing: Facing,
    /// `1 / w` at a pixel is the sum of `k_i E_i` times this, with `k_i` the vertices' scales.
    pub(crate) inverse: Scale,
    /// For each part, the pixels it may cover: `[front, behind]`.
    pub(crate) bounds: [Rect; 2],
}

impl Setup {
    /// The pixels that a part may cover.
    #[inline]
    pub(crate) const fn bounds(&self, part: Part) -> Rect {
        match part {
            Part::Front => self.bounds[0],
            Part::Behind => self.bounds[1],
        }
    }

    /// The same triangle with the part behind the eye made positive.
    #[inline]
    pub(crate) fn mirrored(&self) -> Self {
        let negate = |v: [i64; 3]| v.map(|v| -v);
        Self { a: negate(self.a), b: negate(self.b), c: negate(self.c), ..*self }
    }

    /// The edge functions at the centre of a pixel; all are positive or zero where it is covered.
    #[inline]
    pub(crate) fn edges_at(&self, x: i32, y: i32) -> [i64; 3] {
        let (x, y) = (i64::from(x), i64::from(y));
        let at = |a: i64, b: i64, c: i64| ((a * x + b * y) << self.step) + c;
        let ([a0, a1, a2], [b0, b1, b2], [c0, c1, c2]) = (self.a, self.b, self.c);
        [at(a0, b0, c0), at(a1, b1, c1), at(a2, b2, c2)]
    }
}

/// A vertex as the bounding box sees it: pixel space `(x, y, w)`, y down, in any positive scale,
/// and the first column and row at or beyond it.
#[derive(Clone, Copy)]
pub(crate) struct Extent {
    pub(crate) point: [i64; 3],
    pub(crate) first: [i32; 2],
}

/// The pixels that the front and the behind part of a triangle may cover, without a division
/// (Zwicker 2008, section 4, after Blinn 1996).
///
/// The least column among the vertices with `w > 0` bounds the front part on the left if the linear
/// function that is zero on the column before it is positive at the other vertices too: then it is
/// positive over the whole triangle. Where it is not, the triangle wraps through infinity there,
/// and the viewport's side is the bound. The other three sides are the same, and the part behind is
/// the front part of the mirrored vertices. With all `w > 0` this is the box of the projected
/// triangle, exact at both ends: a covered centre is never on the rightmost or lowest vertex, by
/// the top-left rule.
pub(crate) fn bounds(vertices: &[Extent; 3], viewport: &Viewport) -> [Rect; 2] {
    let side = |axis: usize, sign: i64, size: i32| span(vertices, axis, sign, size);
    [1, -1].map(|sign| {
        let [x0, x1] = side(0, sign, viewport.width);
        let [y0, y1] = side(1, sign, viewport.height);
        Rect { x0, y0, x1, y1 }
    })
}

/// One axis of [`bounds`], for the part whose `sign w` is positive.
fn span(vertices: &[Extent; 3], axis: usize, sign: i64, size: i32) -> [i32; 2] {
    let position = |v: &Extent| if axis == 0 { v.point[0] } else { v.point[1] };
    let first = |v: &Extent| if axis == 0 { v.first[0] } else { v.first[1] };
    let ahead = |v: &&Extent| sign * v.point[2] > 0;
    let least = vertices.iter().filter(ahead).map(first).min();
    let most = vertices.iter().filter(ahead).map(first).max();
    let (Some(least), Some(most)) = (least, most) else {
        return [0, 0];
    };
    if vertices.iter().all(|v| ahead(&v)) {
        return [least, most];
    }
    // Twice the distance beyond a pixel's centre, in units of the vertex's w.
    let beyond =
        |v: &Extent, pixel: i32| sign * (2 * position(v) - i64::from(2 * pixel + 1) * v.point[2]);
    let others = || vertices.iter().filter(|v| !ahead(v));
    let low = if others().all(|v| beyond(v, least - 1) >= 0) { least } else { 0 };
    let high = if others().all(|v| beyond(v, most + 1) <= 0) { most + 1 } else { size };
    [low, high.min(size)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn extent(x: i64, y: i64, w: i64) -> Extent {
        let first = |v: i64| {
            if w == 0 {
                return 0;
            }
            let (v, w) = (v * w.signum(), w.abs());
            ((2 * v - w) + 2 * w - 1).div_euclid(2 * w).clamp(0, 16) as i32
        };
        Extent { point: [x, y, w], first: [first(x), first(y)] }
    }

    fn boxes(v: [[i64; 3]; 3]) -> [Rect; 2] {
        let v = v.map(|[x, y, w]| extent(x, y, w));
        bounds(&v, &Viewport::new(16, 16).unwrap())
    }

    #[test]
    fn with_positive_w_it_is_the_box_of_the_centres() {
        // Corners (2, 3), (9.5, 4), (5, 12): the centre at 9.5 is not covered.
        let [front, behind] = boxes([[2, 3, 1], [19, 8, 2], [15, 36, 3]]);
        assert_eq!(front, Rect { x0: 2, y0: 3, x1: 9, y1: 12 });
        assert!(behind.is_empty());
    }

    #[test]
    fn a_vertex_behind_the_eye_opens_the_side_it_wraps_through() {
        // (4, 4) and (6, 4) in front, (5, 20) behind: the front part runs up and off the screen.
        let [front, behind] = boxes([[4, 4, 1], [6, 4, 1], [-5, -20, -1]]);
        assert_eq!(front, Rect { x0: 0, y0: 0, x1: 16, y1: 5 });
        assert_eq!(behind, Rect { x0: 0, y0: 16, x1: 16, y1: 16 });
    }

    #[test]
    fn a_vertex_at_infinity_bounds_the_other_side() {
        // A strip from x = 4 to 6 that runs down without end.
        let [front, _] = boxes([[4, 4, 1], [6, 4, 1], [0, 1, 0]]);
        assert_eq!(front, Rect { x0: 4, y0: 4, x1: 7, y1: 16 });
    }
}

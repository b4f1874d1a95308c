//! Triangle setup: three snapped vertices in, three edge functions and a box out.
//!
//! With `M` the 3 x 3 matrix whose rows are the vertices `(x, y, w)`, the edge functions are the
//! rows of `adj(M)`: each is zero on an edge and has the sign of `det M` at the vertex opposite
//! (Olano & Greer 1997, sections 4 and 5.1, equation 4). No vertex is divided by its `w`. The
//! determinant's sign is the facing (section 5.2). Where all three, oriented by that sign, are
//! positive, the triangle is in front of the eye; where all are negative it is behind (the footnote
//! in 5.1).
//!
//! The edges come out as integers over the screen, the same form for every tier: `E_i(X, Y) = a_i X + b_i Y + c_i` at the
//! centre of pixel `(X, Y)`, positive inside. From them everything else follows: coverage is their signs, clip planes
//! and attributes are their linear combinations.
//!
//! They are made from vertices in pixel space, `(x, y, w)` with `x / w` and `y / w` in pixels, y down, in any positive
//! scale that makes `w` even: then the line through two of them has even `a` and `b`, and its value at a pixel's centre
//! is whole. Budgets are in the tiers' modules.
//!
//! What few triangles go through is loops, and functions that are not inlined: flash counts there.

mod exact;
mod line;
mod outline;
mod plane;
mod quick;
mod slopes;
mod tiny;

#[cfg(feature = "heapless")]
pub(crate) use exact::first_centres;
pub(crate) use exact::{Anchored, determinant, outline};
pub(crate) use line::{ProjectedLine, Segment};
#[cfg(feature = "heapless")]
pub(crate) use outline::rows_of;
pub(crate) use outline::{Corner, Outline, Place, bounds_of, doubled_area, facing};
pub(crate) use plane::{Plane, Slopes};
#[cfg(test)]
pub(crate) use tiny::tests::triangles as tiny_triangles;
pub(crate) use tiny::{EdgeSteps, PlaneSteps, Tiny};

use crate::math::{Scale, product, rolled};
use crate::vertex::{ExactPosition, PixelVertex, Rect, ScaleOf, Snap, Viewport};

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

    /// A vertex in pixel space.
    #[doc(hidden)]
    fn in_pixels(vertex: &Self::Position, viewport: &Viewport) -> PixelVertex;

    /// The facing of three vertices, which are also there in pixel space, and [`Setup::inverse`]; `None` where their
    /// determinant is 0.
    #[doc(hidden)]
    fn orient(
        vertices: [&Self::Position; 3],
        in_pixels: &[PixelVertex; 3],
        viewport: &Viewport,
    ) -> Option<(Facing, ScaleOf)>;

    /// The edge functions and boxes of a triangle; `None` where its determinant is 0.
    #[doc(hidden)]
    #[inline(never)]
    #[must_use]
    fn set_up(vertices: [&Self::Position; 3], viewport: &Viewport) -> Option<Setup> {
        let [p, q, r] = vertices;
        let in_pixels = |vertex| Self::in_pixels(vertex, viewport);
        let in_pixels = [in_pixels(p), in_pixels(q), in_pixels(r)];
        let (facing, ScaleOf(inverse)) = Self::orient(vertices, &in_pixels, viewport)?;
        Some(Setup::new(&in_pixels, facing, inverse, viewport))
    }
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

/// A linear function of the pixel: `a X + b Y + c` at the centre of `(X, Y)`.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct EdgeFunction {
    pub(crate) a: i64,
    pub(crate) b: i64,
    pub(crate) c: i64,
}

impl EdgeFunction {
    /// The line through two vertices of a triangle, positive inside where all have a positive `w`.
    #[inline(never)]
    fn between(p: &PixelVertex, q: &PixelVertex, facing: Facing) -> Self {
        // y is down: a front face is counter-clockwise here.
        let [a, b, c] = if facing == Facing::Front {
            line(&q.point, &p.point)
        } else {
            line(&p.point, &q.point)
        };
        Self { a, b, c: (a + b) / 2 + c }
    }

    /// Whether centres that are exactly on it are covered: it is a left edge, or a top edge.
    #[inline]
    pub(crate) const fn is_top_or_left(&self) -> bool {
        self.a > 0 || (self.a == 0 && self.b > 0)
    }

    /// The value at the centre of a pixel.
    #[inline(never)]
    pub(crate) fn at(&self, x: i32, y: i32) -> i64 {
        self.a * i64::from(x) + self.b * i64::from(y) + self.c
    }
}

/// The cross product of two vertices in pixel space.
#[inline(never)]
fn line(p: &[i32; 3], q: &[i32; 3]) -> [i64; 3] {
    [
        product(p[1], q[2]) - product(p[2], q[1]),
        product(p[2], q[0]) - product(p[0], q[2]),
        product(p[0], q[1]) - product(p[1], q[0]),
    ]
}

/// A triangle that has been set up: oriented edge functions, and what turns them into weights.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Setup {
    /// Positive inside the front part; each is 0 on the edge opposite of its vertex.
    pub(crate) edges: [EdgeFunction; 3],
    pub(crate) facing: Facing,
    /// `1 / w` at a pixel is the sum of `k_i E_i` times this, with `k_i` the vertices' scales.
    pub(crate) inverse: Scale,
    /// For each part, the pixels it may cover: `[front, behind]`.
    pub(crate) bounds: [Rect; 2],
}

impl Setup {
    /// From vertices in pixel space.
    #[inline(never)]
    fn new(
        vertices: &[PixelVertex; 3],
        facing: Facing,
        inverse: Scale,
        viewport: &Viewport,
    ) -> Self {
        let [p, q, r] = vertices;
        let edge = |from, to| EdgeFunction::between(from, to, facing);
        let bounds = bounds(vertices, viewport);
        let mut setup = Self { edges: [edge(q, r); 3], facing, inverse, bounds };
        let [_, second, third] = &mut setup.edges;
        // One by one: an array of its own would be copied.
        *second = edge(r, p);
        *third = edge(p, q);
        setup
    }

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
        let edges = self.edges.map(|EdgeFunction { a, b, c }| EdgeFunction { a: -a, b: -b, c: -c });
        Self { edges, ..*self }
    }

    /// What a pixel to the right adds to each edge function.
    #[inline(never)]
    pub(crate) fn across(&self) -> [i64; 3] {
        let [first, second, third] = &self.edges;
        [first.a, second.a, third.a]
    }

    /// What a pixel down adds to each edge function.
    #[inline(never)]
    pub(crate) fn down(&self) -> [i64; 3] {
        let [first, second, third] = &self.edges;
        [first.b, second.b, third.b]
    }

    /// The edge functions at the centre of a pixel; all are positive or zero where it is covered.
    #[inline(never)]
    pub(crate) fn edges_at(&self, x: i32, y: i32) -> [i64; 3] {
        let [first, second, third] = &self.edges;
        [first.at(x, y), second.at(x, y), third.at(x, y)]
    }
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
fn bounds(vertices: &[PixelVertex; 3], viewport: &Viewport) -> [Rect; 2] {
    [1, -1].map(|sign| {
        let [x0, x1] = span(vertices, 0, sign, viewport.width);
        let [y0, y1] = span(vertices, 1, sign, viewport.height);
        Rect { x0, y0, x1, y1 }
    })
}

/// One axis of [`bounds`], for the part whose `sign w` is positive.
#[inline(never)]
fn span(vertices: &[PixelVertex; 3], axis: usize, sign: i32, size: i32) -> [i32; 2] {
    let (mut least, mut most) = (size, -1);
    for v in rolled(vertices) {
        if sign * v.point[2] > 0 {
            let first = if axis == 0 { v.first[0] } else { v.first[1] };
            least = least.min(first);
            most = most.max(first);
        }
    }
    if most < 0 {
        return [0, 0];
    }
    let (mut low, mut high) = (least, most);
    for v in rolled(vertices) {
        let w = sign * v.point[2];
        if w <= 0 {
            let position = i64::from(sign * if axis == 0 { v.point[0] } else { v.point[1] });
            // The distance beyond a pixel's centre, in units of the vertex's w, which is even.
            let beyond = |pixel: i32| position - product(2 * pixel + 1, w / 2);
            if beyond(least - 1) < 0 {
                low = 0;
            }
            high = high.max(if beyond(most + 1) > 0 { size } else { size.min(most + 1) });
        }
    }
    [low, high]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vertex([x, y, w]: [i32; 3]) -> PixelVertex {
        let first = |v: i32| {
            if w == 0 {
                return 0;
            }
            let (v, w) = (v * w.signum(), w.abs());
            ((2 * v - w) + 2 * w - 1).div_euclid(2 * w).clamp(0, 16)
        };
        PixelVertex { point: [2 * x, 2 * y, 2 * w], first: [first(x), first(y)] }
    }

    fn boxes(v: [[i32; 3]; 3]) -> [Rect; 2] {
        bounds(&v.map(vertex), &Viewport::new(16, 16).unwrap())
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

//! Scanline traversal: from edge functions to spans, by additions; of projected triangles from their corners
//! ([`Rows`]), and of tiny ones from edge functions of 16 bits ([`Scan`]).
//!
//! Each edge keeps the end of its interval on the current row and its exact value there. A row adds
//! the edge's `b`; then the end moves a pixel at a time, one addition each, until the value changes
//! sign (Pineda 1988's incremental edge functions, looked at only along the boundary). There is no
//! test in the pixels between. An edge's end moves one way only, down the rows, so a triangle costs
//! its rows plus at most its width an edge: the loops are bounded by the box.
//!
//! A left and a right end are the same walk. With `a > 0` the interval begins at the first `x` with
//! `E >= 0`; with `a < 0` it ends before the first `x` with `-E - 1 >= 0`, which grows with `x`. An
//! edge on a pixel centre (`E = 0`) belongs to the triangle if it is a top or a left edge;
//! subtracting 1 from any other beforehand makes all of them `E >= 0`.

mod exact;
mod line;
mod rows;
mod scan;
#[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
mod shared;
mod side;
mod smooth;

pub(crate) use exact::Stepped;
pub(crate) use line::{LineRuns, LineWalk};
pub(crate) use rows::Rows;
use rows::ShortRows;
pub(crate) use scan::Scan;
pub(crate) use smooth::SmoothSpans;

/// How the edges of projected triangles are followed. On ARMv6-M a division is a call of 200 instructions, and
/// a 64-bit shift or product one of 15 to 40.
#[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
pub(crate) use side::Digital as ProjectedSide;
#[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
pub(crate) use side::Line as ProjectedSide;
pub(crate) use side::{SMALL, Side, WIDEST, is_small};

/// The rows of a small triangle, by the same choice.
#[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
pub(crate) type SmallRows = ShortRows<side::Walked>;
#[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
pub(crate) type SmallRows = ShortRows<side::Short>;

/// [`ProjectedSide`] for rows that are filled: not for those that are shaded, whose loop over pixels then has fewer
/// registers.
#[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
pub(crate) use side::Digital as FilledSide;
#[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
pub(crate) type FilledSide = shared::Shared<side::Line>;

use crate::clip::{HalfPlane, Hither, hither_edge, plane_edge};
use crate::setup::{EdgeFunction, Setup};
use crate::span::Span;
use crate::vertex::{Outside, Rect, Snap, Vertex};
use core::hint::black_box;
use core::ops::{AddAssign, SubAssign};

/// An integer wide enough for an edge function over the screen.
pub(crate) trait EdgeInt: Copy + Ord + Default + AddAssign + SubAssign {}

impl EdgeInt for i64 {}
impl EdgeInt for i128 {}

/// One edge on one row: `x` is the first column of the box with `value + (column - x) a >= 0`, or
/// the box's end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge<I> {
    plane: HalfPlane<I>,
    x: i32,
}

impl<I: EdgeInt> Edge<I> {
    /// Goes `rows` further, and takes what the edge leaves of a span on that row. Not inlined: few triangles need it.
    #[inline(never)]
    fn follow(&mut self, rows: i32, bounds: &Rect, span: &mut Span) {
        let zero = I::default();
        let Self { plane: HalfPlane { a, b, mut value, begins }, mut x } = *self;
        for _ in 0..rows {
            value += b;
            black_box(());
        }
        while value < zero && x < bounds.x1 {
            value += a;
            x += 1;
            black_box(());
        }
        while value >= a && x > bounds.x0 {
            value -= a;
            x -= 1;
            black_box(());
        }
        (self.plane.value, self.x) = (value, x);
        if begins {
            span.x0 = span.x0.max(x);
        } else {
            span.x1 = span.x1.min(x);
        }
    }
}

/// Three edges before the first row of a box.
pub(crate) type Edges = [Edge<i64>; 3];

/// The edges of `setup` (already mirrored for the part behind).
#[inline]
pub(crate) fn edges(setup: &Setup, bounds: &Rect) -> Edges {
    let [a, b, c] = &setup.edges;
    [biased(a, bounds), biased(b, bounds), biased(c, bounds)]
}

/// Three edges, row by row.
#[derive(Debug)]
struct Walk<'a> {
    /// Lent, as a move would be a copy.
    edges: &'a mut Edges,
    bounds: Rect,
    y: i32,
}

impl Walk<'_> {
    /// The next row that is covered.
    #[inline(never)]
    fn next(&mut self) -> Option<Span> {
        while self.y < self.bounds.y1 {
            let mut span = Span { y: self.y, x0: self.bounds.x0, x1: self.bounds.x1 };
            self.y += 1;
            let [first, second, third] = &mut *self.edges;
            first.follow(1, &self.bounds, &mut span);
            second.follow(1, &self.bounds, &mut span);
            third.follow(1, &self.bounds, &mut span);
            if span.x0 < span.x1 {
                return Some(span);
            }
        }
        None
    }
}

/// The planes that cut a triangle, on the row they have come to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ClipWalk<const P: usize> {
    hither: Option<Edge<i128>>,
    planes: [Option<Edge<i128>>; P],
    bounds: Rect,
    y: i32,
}

impl<const P: usize> ClipWalk<P> {
    /// The planes before the first row of a box: of each that some vertex is outside of (a bit of `outside`), its edge
    /// function.
    #[inline]
    pub(crate) fn new<T: Snap, const N: usize>(
        setup: &Setup,
        bounds: Rect,
        vertices: [&Vertex<T, N, P>; 3],
        hither: Option<Hither>,
        outside: Outside,
    ) -> Self {
        let mut walk = Self { hither: None, planes: [None; P], bounds, y: bounds.y0 - 1 };
        let at = (bounds.x0, walk.y);
        if let Some(hither) = hither.filter(|_| outside.0 & Outside::HITHER != 0) {
            let plane = hither_edge(setup, vertices, hither, at);
            walk.hither = Some(Edge { plane, x: bounds.x0 });
        }
        for (i, edge) in walk.planes.iter_mut().enumerate() {
            if outside.0 & (Outside::FIRST_PLANE << i) != 0 {
                let plane = plane_edge(setup, vertices, i, at);
                *edge = Some(Edge { plane, x: bounds.x0 });
            }
        }
        walk
    }

    /// What the planes leave of a span; spans come in row order.
    #[inline(never)]
    fn cut(&mut self, span: &mut Span) {
        let rows = span.y - self.y;
        self.y = span.y;
        for edge in self.hither.iter_mut().chain(self.planes.iter_mut().flatten()) {
            edge.follow(rows, &self.bounds, span);
        }
    }
}

/// The spans of a triangle inside a box, from the top: of any triangle, cut or not.
#[derive(Debug)]
pub(crate) struct Spans<'a, const P: usize> {
    edges: Walk<'a>,
    /// Lent: it is large, and few triangles are cut.
    clip: Option<&'a mut ClipWalk<P>>,
}

impl<'a, const P: usize> Spans<'a, P> {
    /// Spans in `bounds`, cut by `clip`.
    #[inline]
    pub(crate) fn new(
        edges: &'a mut Edges,
        bounds: Rect,
        clip: Option<&'a mut ClipWalk<P>>,
    ) -> Self {
        Self { edges: Walk { edges, bounds, y: bounds.y0 }, clip }
    }
}

/// An edge before the first row of a box, with the fill rule made part of it: covered is `>= 0`.
#[inline(never)]
fn biased(edge: &EdgeFunction, bounds: &Rect) -> Edge<i64> {
    half_plane(edge, bounds, i64::from(!edge.is_top_or_left()))
}

/// Where an edge function is at least `least`, before the first row of a box.
#[inline(always)]
fn half_plane(edge: &EdgeFunction, bounds: &Rect, least: i64) -> Edge<i64> {
    let EdgeFunction { a, b, .. } = *edge;
    let begins = a >= 0;
    let value = edge.at(bounds.x0, bounds.y0 - 1) - least;
    // `!v` is `-v - 1`.
    let (a, b, value) = if begins { (a, b, value) } else { (-a, -b, !value) };
    Edge { plane: HalfPlane { a, b, value, begins }, x: bounds.x0 }
}

impl<const P: usize> Iterator for Spans<'_, P> {
    type Item = Span;

    #[inline]
    fn next(&mut self) -> Option<Span> {
        loop {
            let mut span = self.edges.next()?;
            if let Some(clip) = &mut self.clip {
                clip.cut(&mut span);
            }
            if span.x0 < span.x1 {
                return Some(span);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    const BOX: Rect = Rect { x0: 2, y0: 1, x1: 14, y1: 12 };

    /// The walk of an edge against its value at every column.
    fn follows(a: i64, b: i64, c: i64) {
        let edge = EdgeFunction { a, b, c };
        let mut walk = biased(&edge, &BOX);
        for y in BOX.y0..BOX.y1 {
            let mut span = Span { y, x0: BOX.x0, x1: BOX.x1 };
            walk.follow(1, &BOX, &mut span);
            let top_or_left = a > 0 || (a == 0 && b > 0);
            let covers = |x: i32| edge.at(x, y) > 0 || (top_or_left && edge.at(x, y) == 0);
            let inside: Vec<i32> = (BOX.x0..BOX.x1).filter(|&x| covers(x)).collect();
            assert_eq!((span.x0..span.x1).collect::<Vec<_>>(), inside, "{a} {b} {c} row {y}");
        }
    }

    #[test]
    fn an_edge_is_where_its_value_changes_sign() {
        for a in -7..=7 {
            for b in -9..=9 {
                for c in -80..=80 {
                    follows(a, b, c);
                }
            }
        }
    }

    #[test]
    fn planes_skip_rows_with_the_triangle() {
        let at = |x: i32, y: i32| i128::from(3 * x - 5 * y + 1);
        let (x, y) = (BOX.x0, BOX.y0 - 1);
        let begins = HalfPlane { a: 3, b: -5, value: at(x, y), begins: true };
        // Up to column 9.
        let ends = HalfPlane { a: 1, b: 0, value: i128::from(x) - 10, begins: false };
        let [hither, plane] = [begins, ends].map(|plane| Some(Edge { plane, x }));
        let mut walk = ClipWalk { hither, planes: [plane], bounds: BOX, y };
        for y in [1, 2, 6, 11] {
            let mut span = Span { y, x0: 2, x1: 14 };
            walk.cut(&mut span);
            let inside = (2..14).filter(|&x| at(x, y) >= 0 && x <= 9).count();
            assert_eq!((span.x1 - span.x0).max(0) as usize, inside);
        }
    }
}

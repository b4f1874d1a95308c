//! Scanline traversal: from edge functions to spans, by additions; of projected triangles from their corners
//! ([`Rows`]).
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
mod rows;
mod side;

pub(crate) use exact::Stepped;
pub(crate) use rows::Rows;
use rows::ShortRows;

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

use crate::clip::{HalfPlane, Hither, hither_edge, plane_edge};
use crate::setup::{EdgeFunction, Setup};
use crate::span::Span;
use crate::vertex::{Outside, Rect, Snap, Vertex};
use core::hint::black_box;
use core::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

/// An integer wide enough for an edge function over the screen.
pub(crate) trait EdgeInt:
    Copy
    + Ord
    + From<i32>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
{
}

impl EdgeInt for i64 {}
impl EdgeInt for i128 {}

/// One edge on one row: `x` is the first column of the box with `value + (column - x) a >= 0`, or
/// the box's end.
#[derive(Clone, Copy, Debug)]
struct Edge<I> {
    a: I,
    b: I,
    value: I,
    x: i32,
    /// Whether the interval begins at `x`, or ends before it.
    begins: bool,
}

impl<I: EdgeInt> Edge<I> {
    /// The edge on the row before the first of `bounds`, not looked at yet, from the value at the first pixel.
    #[inline]
    fn new(edge: HalfPlane<I>, bounds: &Rect) -> Self {
        let zero = I::from(0);
        let HalfPlane { a, b, value } = edge;
        let (begins, x) = (a >= zero, bounds.x0);
        // Of an end this is of `-E - 1`.
        let (a, b, value) = if begins { (a, b, value) } else { (-a, -b, -value - I::from(1)) };
        Self { a, b, value: value - b, x, begins }
    }

    /// Goes `rows` further, and takes what the edge leaves of a span on that row. Not inlined: few triangles need it.
    #[inline(never)]
    fn follow(&mut self, rows: i32, bounds: &Rect, span: &mut Span) {
        let zero = I::from(0);
        let Self { a, b, mut value, mut x, begins } = *self;
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
        (self.value, self.x) = (value, x);
        if begins {
            span.x0 = span.x0.max(x);
        } else {
            span.x1 = span.x1.min(x);
        }
    }
}

/// Three edges, row by row.
#[derive(Clone, Copy, Debug)]
struct Walk {
    edges: [Edge<i64>; 3],
    bounds: Rect,
    y: i32,
}

impl Walk {
    #[inline(never)]
    fn new(setup: &Setup, bounds: Rect) -> Self {
        let none = Edge { a: 0, b: 0, value: 0, x: 0, begins: true };
        let mut walk = Self { edges: [none; 3], bounds, y: bounds.y0 };
        for (edge, function) in walk.edges.iter_mut().zip(&setup.edges) {
            *edge = Edge::new(biased(function, bounds.x0, bounds.y0), &bounds);
            black_box(());
        }
        walk
    }

    /// The next row that is covered.
    #[inline(never)]
    fn next(&mut self) -> Option<Span> {
        while self.y < self.bounds.y1 {
            let mut span = Span { y: self.y, x0: self.bounds.x0, x1: self.bounds.x1 };
            self.y += 1;
            for edge in &mut self.edges {
                edge.follow(1, &self.bounds, &mut span);
                black_box(());
            }
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
    /// The planes before the first row of a box: of each plane that some vertex is outside of (a bit of `outside`), its edge function.
    #[inline]
    pub(crate) fn new<T: Snap, const N: usize>(
        setup: &Setup,
        bounds: Rect,
        vertices: [&Vertex<T, N, P>; 3],
        hither: Option<Hither>,
        outside: Outside,
    ) -> Self {
        let mut walk = Self { hither: None, planes: [None; P], bounds, y: bounds.y0 - 1 };
        let at = (bounds.x0, bounds.y0);
        if let Some(hither) = hither.filter(|_| outside.0 & Outside::HITHER != 0) {
            walk.hither = Some(Edge::new(hither_edge(setup, vertices, hither, at), &bounds));
        }
        for (i, edge) in walk.planes.iter_mut().enumerate() {
            if outside.0 & (Outside::FIRST_PLANE << i) != 0 {
                *edge = Some(Edge::new(plane_edge(setup, vertices, i, at), &bounds));
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
    edges: Walk,
    /// Lent: it is large, and few triangles are cut.
    clip: Option<&'a mut ClipWalk<P>>,
}

impl<'a, const P: usize> Spans<'a, P> {
    /// Spans of `setup` (already mirrored for the part behind) in `bounds`, cut by `clip`.
    #[inline]
    pub(crate) fn new(setup: &Setup, bounds: Rect, clip: Option<&'a mut ClipWalk<P>>) -> Self {
        Self { edges: Walk::new(setup, bounds), clip }
    }
}

/// An edge from a pixel on, with the fill rule made part of it: covered is `>= 0`.
#[inline]
fn biased(edge: &EdgeFunction, x: i32, y: i32) -> HalfPlane<i64> {
    let EdgeFunction { a, b, .. } = *edge;
    let top_or_left = a > 0 || (a == 0 && b > 0);
    HalfPlane { a, b, value: edge.at(x, y) - i64::from(!top_or_left) }
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
        let at = |x: i32, y: i32| a * i64::from(x) + b * i64::from(y) + c;
        let mut walk = Edge::new(HalfPlane { a, b, value: at(BOX.x0, BOX.y0) }, &BOX);
        for y in BOX.y0..BOX.y1 {
            let mut span = Span { y, x0: BOX.x0, x1: BOX.x1 };
            walk.follow(1, &BOX, &mut span);
            let inside: Vec<i32> = (BOX.x0..BOX.x1).filter(|&x| at(x, y) >= 0).collect();
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
        let first = at(BOX.x0, BOX.y0);
        let hither = Edge::new(HalfPlane { a: 3, b: -5, value: first }, &BOX);
        let plane = Edge::new(HalfPlane { a: -1, b: 0, value: 9 - i128::from(BOX.x0) }, &BOX);
        let mut walk =
            ClipWalk { hither: Some(hither), planes: [Some(plane)], bounds: BOX, y: BOX.y0 - 1 };
        for y in [1, 2, 6, 11] {
            let mut span = Span { y, x0: 2, x1: 14 };
            walk.cut(&mut span);
            let inside = (2..14).filter(|&x| at(x, y) >= 0 && x <= 9).count();
            assert_eq!((span.x1 - span.x0).max(0) as usize, inside);
        }
    }
}

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

use crate::clip::{ClipEdges, HalfPlane};
use crate::setup::Setup;
use crate::span::Span;
use crate::vertex::Rect;
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
    /// Whether `x` is where the interval begins, or where it ends.
    begins: bool,
}

impl<I: EdgeInt> Edge<I> {
    /// The edge on the first row of a box.
    #[inline]
    fn new(edge: HalfPlane<I>, bounds: &Rect) -> Self {
        let zero = I::from(0);
        let HalfPlane { a, b, c } = edge;
        let value = a * I::from(bounds.x0) + b * I::from(bounds.y0) + c;
        let begins = a >= zero;
        let mut walk = if begins {
            Self { a, b, value, x: bounds.x0, begins }
        } else {
            Self { a: -a, b: -b, value: -value - I::from(1), x: bounds.x0, begins }
        };
        walk.settle(bounds);
        walk
    }

    /// Moves `x` to where the value changes sign, inside the box.
    #[inline]
    fn settle(&mut self, bounds: &Rect) {
        let zero = I::from(0);
        while self.value < zero && self.x < bounds.x1 {
            self.value += self.a;
            self.x += 1;
        }
        while self.value >= self.a && self.x > bounds.x0 {
            self.value -= self.a;
            self.x -= 1;
        }
    }

    /// The next row.
    #[inline]
    fn step(&mut self, bounds: &Rect) {
        self.value += self.b;
        self.settle(bounds);
    }

    /// What the edge leaves of a span on its row.
    #[inline]
    fn cut(&self, span: &mut Span) {
        if self.begins {
            span.x0 = span.x0.max(self.x);
        } else {
            span.x1 = span.x1.min(self.x);
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
    #[inline]
    fn new(edges: [HalfPlane<i64>; 3], bounds: Rect) -> Self {
        Self { edges: edges.map(|e| Edge::new(e, &bounds)), bounds, y: bounds.y0 }
    }

    /// The next row that is covered.
    #[inline]
    fn next(&mut self) -> Option<Span> {
        while self.y < self.bounds.y1 {
            let mut span = Span { y: self.y, x0: self.bounds.x0, x1: self.bounds.x1 };
            self.y += 1;
            let last = self.y == self.bounds.y1;
            for edge in &mut self.edges {
                edge.cut(&mut span);
                if !last {
                    edge.step(&self.bounds);
                }
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
    /// The planes on the first row of a box.
    pub(crate) fn new(edges: &ClipEdges<P>, bounds: Rect) -> Self {
        let walk = |e: HalfPlane<i128>| Edge::new(e, &bounds);
        Self {
            hither: edges.hither.map(walk),
            planes: edges.planes.map(|e| e.map(walk)),
            bounds,
            y: bounds.y0,
        }
    }

    /// What the planes leave of a span; spans come in row order.
    fn cut(&mut self, mut span: Span) -> Span {
        let rows = span.y - self.y;
        self.y = span.y;
        for edge in self.hither.iter_mut().chain(self.planes.iter_mut().flatten()) {
            for _ in 0..rows {
                edge.step(&self.bounds);
            }
            edge.cut(&mut span);
        }
        span
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
        Self { edges: Walk::new([0, 1, 2].map(|i| biased(setup, i)), bounds), clip }
    }
}

/// Edge `i` with the fill rule made part of it: covered is `>= 0`.
///
/// A pixel's steps are multiples of `2^step`, so flooring `c` by it changes no sign.
#[inline]
fn biased(setup: &Setup, i: usize) -> HalfPlane<i64> {
    let at = |v: &[i64; 3]| v.get(i).copied().unwrap_or(0);
    let (a, b, c) = (at(&setup.a), at(&setup.b), at(&setup.c));
    let top_or_left = a > 0 || (a == 0 && b > 0);
    HalfPlane { a, b, c: (c - i64::from(!top_or_left)) >> setup.step }
}

impl<const P: usize> Iterator for Spans<'_, P> {
    type Item = Span;

    #[inline]
    fn next(&mut self) -> Option<Span> {
        loop {
            let span = self.edges.next()?;
            match &mut self.clip {
                None => return Some(span),
                Some(clip) => {
                    let span = clip.cut(span);
                    if span.x0 < span.x1 {
                        return Some(span);
                    }
                }
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
    fn follows(edge: HalfPlane<i64>) {
        let mut walk = Edge::new(edge, &BOX);
        for y in BOX.y0..BOX.y1 {
            let at = |x: i32| edge.a * i64::from(x) + edge.b * i64::from(y) + edge.c;
            let mut span = Span { y, x0: BOX.x0, x1: BOX.x1 };
            walk.cut(&mut span);
            let inside: Vec<i32> = (BOX.x0..BOX.x1).filter(|&x| at(x) >= 0).collect();
            assert_eq!((span.x0..span.x1).collect::<Vec<_>>(), inside, "{edge:?} row {y}");
            walk.step(&BOX);
        }
    }

    #[test]
    fn an_edge_is_where_its_value_changes_sign() {
        for a in -7..=7 {
            for b in -9..=9 {
                for c in -80..=80 {
                    follows(HalfPlane { a, b, c });
                }
            }
        }
    }

    #[test]
    fn planes_skip_rows_with_the_triangle() {
        let plane = HalfPlane { a: 3i128, b: -5, c: 1 };
        let mut edges = ClipEdges { hither: Some(plane), planes: [None; 1] };
        edges.planes[0] = Some(HalfPlane { a: -1, b: 0, c: 9 });
        let mut walk = ClipWalk::new(&edges, BOX);
        for y in [1, 2, 6, 11] {
            let span = walk.cut(Span { y, x0: 2, x1: 14 });
            let inside = (2..14).filter(|&x| 3 * x - 5 * y + 1 >= 0 && x <= 9).count();
            assert_eq!((span.x1 - span.x0).max(0) as usize, inside);
        }
    }
}

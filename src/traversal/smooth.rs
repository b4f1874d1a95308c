//! The rows of a triangle some of whose edges are smooth: pixels that it touches, and among them those that are wholly inside
//! of the smooth edges.
//!
//! A pixel's square is cut by a line where its edge function is within `(|a| + |b|) / 2` of 0 at the centre: so both are
//! intervals, between edges that are moved out or in by that, exactly. Hard edges are where they are.

use super::{ClipWalk, Edge, Edges, biased, half_plane};
use crate::coverage::{Cut, Ramp};
use crate::setup::EdgeFunction;
use crate::span::Span;
use crate::vertex::Rect;

/// Spans of touched pixels, each with the span that is wholly inside; from the top.
#[derive(Debug)]
pub(crate) struct SmoothSpans<'a, const P: usize, const M: usize> {
    touched: Edges,
    inside: Edges,
    beside: [Option<(Edge<i64>, bool)>; M],
    clip: Option<&'a mut ClipWalk<P>>,
    bounds: Rect,
    y: i32,
}

impl<'a, const P: usize, const M: usize> SmoothSpans<'a, P, M> {
    /// Spans in `bounds`, cut by `clip`; edges with a ramp are smooth. Lines `beside` the triangle cut pixels of it too.
    #[inline(never)]
    pub(crate) fn new(
        (edges, ramps): (&[EdgeFunction; 3], &[Option<Ramp>; 3]),
        beside: &[Option<Cut>; M],
        bounds: Rect,
        clip: Option<&'a mut ClipWalk<P>>,
    ) -> Self {
        let walk = |edge: &EdgeFunction, ramp: &Option<Ramp>, inside: bool| match ramp {
            None => biased(edge, &bounds),
            Some(ramp) if inside || ramp.is_bare() => half_plane(edge, &bounds, ramp.reach()),
            Some(ramp) => half_plane(edge, &bounds, 1 - ramp.reach()),
        };
        let ([e, f, g], [r, s, t]) = (edges, ramps);
        let line =
            |Cut { edge, ramp }: &Cut| (half_plane(edge, &bounds, ramp.reach()), ramp.is_bare());
        Self {
            touched: [walk(e, r, false), walk(f, s, false), walk(g, t, false)],
            inside: [walk(e, r, true), walk(f, s, true), walk(g, t, true)],
            beside: beside.each_ref().map(|cut| cut.as_ref().map(line)),
            clip,
            bounds,
            y: bounds.y0,
        }
    }

    /// What edges leave of the next row.
    #[inline(never)]
    fn row(edges: &mut Edges, mut span: Span, bounds: &Rect) -> Span {
        let [first, second, third]: &mut [Edge<i64>; 3] = edges;
        first.follow(1, bounds, &mut span);
        second.follow(1, bounds, &mut span);
        third.follow(1, bounds, &mut span);
        span
    }
}

impl<const P: usize, const M: usize> Iterator for SmoothSpans<'_, P, M> {
    /// Touched, and inside of that; where nothing is inside, an empty span at its end.
    type Item = (Span, Span);

    fn next(&mut self) -> Option<(Span, Span)> {
        while self.y < self.bounds.y1 {
            let whole = Span { y: self.y, x0: self.bounds.x0, x1: self.bounds.x1 };
            self.y += 1;
            let mut touched = Self::row(&mut self.touched, whole, &self.bounds);
            let mut inside = Self::row(&mut self.inside, whole, &self.bounds);
            for (line, bare) in self.beside.iter_mut().flatten() {
                let mut span = whole;
                line.follow(1, &self.bounds, &mut span);
                (inside.x0, inside.x1) = (inside.x0.max(span.x0), inside.x1.min(span.x1));
                if *bare {
                    (touched.x0, touched.x1) = (touched.x0.max(span.x0), touched.x1.min(span.x1));
                }
            }
            if touched.x0 >= touched.x1 {
                continue;
            }
            if let Some(clip) = &mut self.clip {
                clip.cut(&mut touched);
                if touched.x0 >= touched.x1 {
                    continue;
                }
            }
            let (x0, x1) = (inside.x0.max(touched.x0), inside.x1.min(touched.x1));
            let end = touched.x1;
            let (x0, x1) = if x0 < x1 { (x0, x1) } else { (end, end) };
            return Some((touched, Span { x0, x1, ..touched }));
        }
        None
    }
}

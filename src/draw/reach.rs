//! Which rows of the picture a triangle reaches: what is asked before it is drawn, to draw only the bands that have some.

use super::{Frame, Outcome, rejected};
use crate::depth::DepthTest;
use crate::framebuffer::Target;
use crate::interpolation::{Correction, Interpolates};
use crate::setup::{Facing, Outline, Part, Setup, Tier, determinant, outline};
use crate::traversal::{ClipWalk, Spans, edges};
use crate::vertex::{Outside, Rect, Vertex};

/// Rows, from the first to before the second; none where it is not smaller.
pub(crate) type RowRange = (i32, i32);

/// No rows.
const NONE: RowRange = (0, 0);

impl<C, D, W, T, I, const P: usize> Frame<C, D, W, T, I, P>
where
    C: Target,
    D: DepthTest,
    T: Tier,
    I: Correction,
{
    /// The rows of the scissor that the part of a triangle in front of the eye reaches, and the part behind; or why it shows
    /// nothing of them. What the target holds of the picture makes no difference.
    ///
    /// A triangle reaches a row if the line through the row's pixel centres has a point of it between the scissor's sides. What
    /// it covers of a row is one interval and what has it is convex, so that its rows are one range.
    pub(crate) fn reach<const N: usize>(
        &self,
        vertices: [&Vertex<T, N, P>; 3],
    ) -> Result<[RowRange; 2], Outcome>
    where
        W: Interpolates<N>,
    {
        let [a, b, c] = vertices.map(|v| v.outside.0);
        let (any, all) = (Outside(a | b | c), a & b & c);
        if let Some(outcome) = rejected::<W, N>(all) {
            return Err(outcome);
        }
        let scissor = self.viewport.scissor;
        match self.whole_box(vertices, any, Outside(all))? {
            // Away from the sides: each of the box's rows has a part of it.
            Some(whole) if scissor.x0 < whole.x0 && whole.x1 < scissor.x1 => {
                let shown = whole.intersect(scissor);
                if shown.is_empty() {
                    Err(Outcome::OffScreen)
                } else {
                    Ok([(shown.y0, shown.y1), NONE])
                }
            }
            _ => self.reach_by_spans(vertices, any),
        }
    }

    /// The box of the pixel centres that a triangle reaches, the scissor left aside, where no plane cuts it and all of it is
    /// in front; or why it is not drawn.
    #[inline]
    fn whole_box<const N: usize>(
        &self,
        vertices: [&Vertex<T, N, P>; 3],
        any: Outside,
        all: Outside,
    ) -> Result<Option<Rect>, Outcome>
    where
        W: Interpolates<N>,
    {
        if self.cuts::<N>(any) {
            return Ok(None);
        }
        if T::PROJECTS && all.0 & Outside::PROJECTED != 0 {
            let (corners, area) = self.oriented(vertices)?;
            let outline = Outline::new(&corners, area > 0);
            return Ok(Some(outline.bounds(T::SUBPIXEL_BITS)));
        }
        let Some(positions) = T::homogeneous(vertices.map(|v| &v.position)) else {
            return Ok(None);
        };
        if any.0 & (Outside::HITHER | Outside::SIDES) != 0 {
            return Ok(None);
        }
        let facing = Facing::of(determinant(positions));
        if let Some(outcome) = self.turned_away(facing) {
            return Err(outcome);
        }
        let outline = facing.and_then(|facing| outline(positions, facing, &self.viewport));
        Ok(outline.map(|outline| outline.bounds()))
    }

    /// The rows of any triangle: the first and the last that it covers a pixel of, found by following its edges and the planes
    /// that cut it.
    #[inline(never)]
    fn reach_by_spans<const N: usize>(
        &self,
        vertices: [&Vertex<T, N, P>; 3],
        outside: Outside,
    ) -> Result<[RowRange; 2], Outcome>
    where
        W: Interpolates<N>,
    {
        let setup = T::set_up(vertices.map(|v| &v.position), &self.viewport);
        let setup = setup.as_ref().ok_or(Outcome::ZeroArea)?;
        if self.cull.hides(setup.facing) {
            return Err(Outcome::Culled);
        }
        let rows = |setup: &Setup, part: Part| {
            let bounds = setup.bounds(part).intersect(self.viewport.scissor);
            let mut clip = None;
            if self.cuts::<N>(outside) {
                clip = Some(ClipWalk::new(setup, bounds, vertices, self.hither(), outside));
            }
            let mut edges = edges(setup, &bounds);
            let mut spans = Spans::new(&mut edges, bounds, clip.as_mut()).map(|span| span.y);
            let first = spans.next();
            first.map_or(NONE, |first| (first, spans.last().unwrap_or(first) + 1))
        };
        let front = rows(setup, Part::Front);
        let behind = if W::BEHIND { rows(&setup.mirrored(), Part::Behind) } else { NONE };
        if front == NONE && behind == NONE { Err(Outcome::OffScreen) } else { Ok([front, behind]) }
    }
}

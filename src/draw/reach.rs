//! Which rows of the picture a triangle reaches: what is asked before it is drawn, to draw only the bands that have some.

use super::{Frame, Outcome, rejected};
use crate::depth::DepthTest;
use crate::framebuffer::Target;
use crate::interpolation::{Correction, Interpolates};
use crate::setup::{Facing, Part, Setup, Tier, bounds_of, determinant, first_centres, rows_of};
use crate::traversal::{ClipWalk, Spans, edges};
use crate::vertex::{Outside, Vertex};

/// Rows, from the first to before the second; none where it is not smaller.
pub(crate) type RowRange = (i32, i32);

/// No rows.
const NONE: RowRange = (0, 0);

/// What is known of a triangle's rows from its box.
enum Reach {
    /// It reaches these, some.
    Rows(RowRange),
    /// It shows nothing of any.
    Nothing(Outcome),
    /// Its edges have to be followed.
    Unknown,
}

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
    #[inline(always)]
    pub(crate) fn reach<const N: usize>(
        &self,
        vertices: [&Vertex<T, N, P>; 3],
    ) -> Result<[RowRange; 2], Outcome>
    where
        W: Interpolates<N>,
    {
        match self.reach_of_box(vertices) {
            Reach::Rows(rows) => Ok([rows, NONE]),
            Reach::Nothing(outcome) => Err(outcome),
            Reach::Unknown => self.reach_by_spans(vertices),
        }
    }

    /// The rows of a triangle's box, where no plane cuts it, all of it is in front and it is away from the scissor's sides: then
    /// each of them has a part of it.
    #[inline(always)]
    fn reach_of_box<const N: usize>(&self, vertices: [&Vertex<T, N, P>; 3]) -> Reach
    where
        W: Interpolates<N>,
    {
        let [a, b, c] = vertices.map(|v| v.outside.0);
        let (any, all) = (Outside(a | b | c), a & b & c);
        if any.0 & Outside::BOUNDS != 0 {
            if let Some(outcome) = rejected::<W, N>(all) {
                return Reach::Nothing(outcome);
            }
            if self.cuts::<N>(any) {
                return Reach::Unknown;
            }
        }
        let scissor = self.viewport.scissor;
        // No vertex is beyond a side, and the scissor has all columns.
        let between =
            any.0 & Outside::SIDES == 0 && scissor.x0 == 0 && scissor.x1 == self.viewport.width;
        let whole = if T::PROJECTS && all & Outside::PROJECTED != 0 {
            match self.oriented(vertices) {
                Ok((corners, _)) if between => {
                    return self.within(rows_of(&corners, T::SUBPIXEL_BITS));
                }
                Ok((corners, _)) => bounds_of(&corners, T::SUBPIXEL_BITS),
                Err(outcome) => return Reach::Nothing(outcome),
            }
        } else {
            let positions = T::homogeneous(vertices.map(|v| &v.position));
            let Some(positions) = positions.filter(|_| any.0 & Outside::BOUNDS == 0) else {
                return Reach::Unknown;
            };
            if let Some(outcome) = self.turned_away(Facing::of(determinant(positions))) {
                return Reach::Nothing(outcome);
            }
            first_centres(positions)
        };
        if between || (scissor.x0 < whole.x0 && whole.x1 < scissor.x1) {
            self.within((whole.y0, whole.y1))
        } else {
            Reach::Unknown
        }
    }

    /// What the scissor has of rows that a triangle reaches.
    #[inline(always)]
    fn within(&self, (first, end): RowRange) -> Reach {
        let scissor = self.viewport.scissor;
        let (first, end) = (first.max(scissor.y0), end.min(scissor.y1));
        if first < end { Reach::Rows((first, end)) } else { Reach::Nothing(Outcome::OffScreen) }
    }

    /// The rows of any triangle: the first and the last that it covers a pixel of, found by following its edges and the planes
    /// that cut it.
    #[inline(never)]
    fn reach_by_spans<const N: usize>(
        &self,
        vertices: [&Vertex<T, N, P>; 3],
    ) -> Result<[RowRange; 2], Outcome>
    where
        W: Interpolates<N>,
    {
        let [a, b, c] = vertices.map(|v| v.outside.0);
        let outside = Outside(a | b | c);
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

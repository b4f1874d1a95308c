//! Lines between snapped vertices, and the edges of a mesh.

use super::shade::{shaded, tested};
use super::{Counts, Frame, Outcome};
use crate::clip::cut_line;
use crate::depth::{DepthBias, DepthLine, DepthTest, ProjectedDepths};
use crate::fragment::{Fragment, Sample};
use crate::framebuffer::{Target, run};
use crate::interpolation::{Correction, Interpolates};
use crate::mesh::{Mesh, StoredPosition, VertexStage};
use crate::setup::{Cull, ProjectedLine, Segment, Tier, doubled_area, facing};
use crate::span::Span;
use crate::traversal::{LineRuns, LineWalk};
use crate::vertex::{Outside, Vertex};

impl<C, D, W, T, I, const P: usize> Frame<C, D, W, T, I, P>
where
    C: Target,
    D: DepthTest,
    T: Tier,
    I: Correction,
{
    /// Draws a line between two vertices that this frame has snapped, one pixel wide, in a fragment without varyings.
    ///
    /// It has one pixel a column, or a row if it is steeper than 45 degrees: the one whose centre is nearest to the exact line
    /// through the snapped vertices at the column's centre; on a tie the lower one, or the one to the right. It goes from the
    /// pixel that one vertex is in to that of the other, both included, so that lines which share a vertex never gap,
    /// and both may draw its pixel. (No rule that does not look at the order of the ends draws it once: of three lines at a
    /// vertex, each two are a polyline.) A line of no length is a pixel.
    ///
    /// It is the same pixels, colours and depths, to the bit, whichever vertex comes first, and in bands and under a scissor. What
    /// is behind the hither plane or outside of a clip plane at a column's centre is left out, as exactly as of a triangle.
    /// Without a plane the part in front of the eye is drawn (with [`BothSides`](crate::BothSides) the other as well).
    ///
    /// Depth is linear between the vertices, less `bias`, within 1 unit of 16 bits; see [`DepthBias`]. The vertices may have
    /// varyings, which are not looked at, so that a cache serves triangles too.
    ///
    /// ```
    /// use hither::{ClipVertex, DepthBias, Flat, Frame, Framebuffer, Gray8, I16F16};
    ///
    /// let mut words = [b' '; 64];
    /// let mut frame = Frame::new(Framebuffer::<Gray8>::try_new(&mut words, 8, 8)?)?;
    /// let [a, b, c] = [(-0.9, 0.9), (0.9, 0.4), (-0.2, -0.9)].map(|(x, y): (f32, f32)| {
    ///     let [x, y] = [x, y].map(I16F16::from_num);
    ///     frame.snap(&ClipVertex::new(x, y, I16F16::ZERO, I16F16::ONE), [])
    /// });
    /// for ends in [[&a, &b], [&b, &c], [&c, &a]] {
    ///     frame.draw_line(ends, DepthBias::NONE, &Flat(Gray8(b'#')));
    /// }
    /// let rows: Vec<_> = words.chunks(8).map(|row| core::str::from_utf8(row).unwrap()).collect();
    /// assert_eq!(rows, [
    ///     "###     ",
    ///     "#  ###  ",
    ///     " #    ##",
    ///     " #    # ",
    ///     " #   #  ",
    ///     "  # #   ",
    ///     "  # #   ",
    ///     "   #    ",
    /// ]);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    pub fn draw_line<F, const N: usize>(
        &mut self,
        vertices: [&Vertex<T, N, P>; 2],
        bias: DepthBias,
        fragment: &F,
    ) -> Outcome
    where
        F: Fragment<C::Color, 0>,
        W: Interpolates<N>,
    {
        let [a, b] = vertices.map(|v| v.outside.0);
        // The sides of the viewport are looked at by pixels: an end just outside may share one with it.
        if let Some(outcome) = super::rejected::<W, N>(a & b & !Outside::SIDES) {
            return outcome;
        }
        if T::PROJECTS
            && a & b & Outside::PROJECTED != 0
            && (D::BITS == 0 || (D::BITS <= 16 && a & b & Outside::RANGED != 0))
            && !self.cuts::<N>(Outside(a | b))
        {
            let [a, b] = vertices;
            let corners = T::corners([&a.position, &b.position, &b.position]);
            let drawn = self.draw_projected_line(corners, [a.z, b.z], bias, fragment);
            if let Some(outcome) = drawn {
                return outcome;
            }
        }
        let points = vertices.map(|v| T::in_pixels(&v.position, &self.viewport).point);
        let mut outcome = self.draw_part_of_line(vertices, points, bias, fragment);
        if W::BEHIND {
            // Seen through the eye, the part behind is in front.
            let points = points.map(|point| point.map(|v| -v));
            let behind = self.draw_part_of_line(vertices, points, bias, fragment);
            if behind == Outcome::Drawn {
                outcome = behind;
            }
        }
        outcome
    }

    /// Draws a line between two projected vertices, with their depths, that no plane cuts; `None` where it has no length.
    ///
    /// Only the line's own ends lead here, and never a window: depths are not those of any other line to the bit.
    #[inline(never)]
    fn draw_projected_line<F>(
        &mut self,
        [a, b, _]: [[i32; 2]; 3],
        [za, zb]: [i32; 2],
        bias: DepthBias,
        fragment: &F,
    ) -> Option<Outcome>
    where
        F: Fragment<C::Color, 0>,
    {
        let line = ProjectedLine::new([a, b], T::SUBPIXEL_BITS)?;
        let window = self.known_window();
        let (width, _) = self.target.size();
        let (left, top) = self.viewport.origin;
        let Some((mut walk, from)) = LineWalk::new(&line, window, (left, top), width) else {
            return Some(Outcome::OffScreen);
        };
        let target = &mut self.target;
        let shade = |passes: bool, x: i32, y: i32| {
            shaded(fragment, passes, || Sample { x: x - left, y: y - top, varyings: [] })
        };
        if D::BITS == 0 {
            loop {
                let (x, y) = walk.place();
                let (end, more) = walk.run();
                let ((first, length), (row, _)) = (run(x, end), run(y, y));
                if F::UNIFORM && !F::DISCARDS {
                    if let Some(color) = shade(true, x, y) {
                        target.fill(first, row, length, color);
                    }
                } else {
                    target.write(first, row, (x..end).map(|x| shade(true, x, y)));
                }
                if !more {
                    return Some(Outcome::Drawn);
                }
            }
        }
        let ends = if line.exchanged { [zb, za] } else { [za, zb] };
        let depth = ProjectedDepths::new(&line, ends, T::SUBPIXEL_BITS, bias);
        let mut value = depth.value(from - line.from);
        self.depth.all(|depths| {
            target.write_line(depths, walk, |stored, walk| {
                let running = depth.running(value);
                value = depth.step(value);
                let (x, y) = walk.place();
                tested::<D, F, _, 0>(running, stored, |passes| shade(passes, x, y))
            });
        });
        Some(Outcome::Drawn)
    }

    /// Draws the part in front of the eye of a line between points of pixel space.
    #[inline(never)]
    pub(super) fn draw_part_of_line<F, const N: usize>(
        &mut self,
        vertices: [&Vertex<T, N, P>; 2],
        points: [[i32; 3]; 2],
        bias: DepthBias,
        fragment: &F,
    ) -> Outcome
    where
        F: Fragment<C::Color, 0>,
        W: Interpolates<N>,
    {
        let [a, b] = points;
        let Some(mut segment) = Segment::new(a, b, &self.viewport) else {
            return self.draw_dot(vertices, points, bias, fragment);
        };
        let [a, b] = vertices;
        let vertices = if segment.exchanged { [b, a] } else { [a, b] };
        let outside = Outside(a.outside.0 | b.outside.0);
        if self.cuts::<N>(outside) {
            cut_line(&mut segment, vertices, self.hither(), outside);
        }
        if segment.from >= segment.to {
            return Outcome::OffScreen;
        }
        let depth = (D::BITS > 0).then(|| DepthLine::new(&segment, vertices, D::BITS, bias));
        self.draw_runs_of_line(&segment, depth, fragment)
    }

    /// Draws the pixel of a line that is a point on the screen, at the lesser depth of its ends that are not cut off.
    #[inline(never)]
    fn draw_dot<F, const N: usize>(
        &mut self,
        vertices: [&Vertex<T, N, P>; 2],
        points: [[i32; 3]; 2],
        bias: DepthBias,
        fragment: &F,
    ) -> Outcome
    where
        F: Fragment<C::Color, 0>,
        W: Interpolates<N>,
    {
        let eye = if W::CLIPS { 0 } else { Outside::HITHER };
        let mut dot: Option<(Segment, Option<DepthLine>)> = None;
        for (vertex, point) in vertices.into_iter().zip(points) {
            let [_, _, w] = point;
            if w <= 0 || self.cuts::<N>(Outside(vertex.outside.0 & !eye)) {
                continue;
            }
            let segment = Segment::dot(point, &self.viewport);
            let depth = (D::BITS > 0).then(|| DepthLine::new(&segment, [vertex; 2], D::BITS, bias));
            let depth = match (depth, dot) {
                (Some(depth), Some((_, Some(other)))) => Some(other.nearer(depth)),
                _ => depth,
            };
            dot = Some((segment, depth));
        }
        match dot {
            Some((segment, depth)) => self.draw_runs_of_line(&segment, depth, fragment),
            None => Outcome::Behind,
        }
    }

    /// Draws what the window has of a line.
    #[inline(never)]
    fn draw_runs_of_line<F>(
        &mut self,
        segment: &Segment,
        depth: Option<DepthLine>,
        fragment: &F,
    ) -> Outcome
    where
        F: Fragment<C::Color, 0>,
    {
        let Some(runs) = LineRuns::new(segment, self.known_window()) else {
            return Outcome::OffScreen;
        };
        let (width, _) = self.target.size();
        let (left, top) = self.viewport.origin;
        let target = &mut self.target;
        for Span { y, x0, x1 } in runs {
            let shade =
                |passes: bool, x: i32| shaded(fragment, passes, || Sample { x, y, varyings: [] });
            let (x, length) = run(x0 + left, x1 + left);
            let (row, _) = run(y + top, y + top);
            let Some(depth) = &depth else {
                if F::UNIFORM && !F::DISCARDS {
                    if let Some(color) = shade(true, x0) {
                        target.fill(x, row, length, color);
                    }
                } else {
                    target.write(x, row, (x0..x1).map(|x| shade(true, x)));
                }
                continue;
            };
            let at = row.wrapping_mul(width as usize).wrapping_add(x);
            let mut value = depth.value(if segment.steep { y } else { x0 });
            let mut column = x0;
            self.depth.run(at, length, |depths| {
                target.write_each::<_, 1>((x, row, at), depths, |stored, _| {
                    let running = depth.running(value);
                    value = depth.step(value);
                    column += 1;
                    tested::<D, F, _, 0>(running, stored, |passes| shade(passes, column - 1))
                });
            });
        }
        Outcome::Drawn
    }

    /// Draws the edges of a mesh's faces that are not culled, each as [`draw_line`](Self::draw_line) does, through `stage` and
    /// the cache as [`draw`](Self::draw) has them.
    ///
    /// An edge that two such faces share is drawn twice, which are the same pixels: whether there is another face is not known, and
    /// in one colour it does not show, unless the target merges. The edges of a face seen edge-on, or of no area, are drawn
    /// whatever is culled.
    ///
    /// Over the filled faces give it a bias, such as [`DepthBias::WIREFRAME`]. Counted are lines; of faces that are culled one
    /// each.
    pub fn draw_wireframe<Q, A, S, F, const N: usize>(
        &mut self,
        mesh: &Mesh<'_, Q, A>,
        stage: &S,
        bias: DepthBias,
        fragment: &F,
        cache: &mut [Vertex<T, N, P>],
    ) -> Counts
    where
        Q: StoredPosition,
        S: VertexStage<A, N>,
        F: Fragment<C::Color, 0>,
        W: Interpolates<N>,
    {
        self.transform(mesh, stage, 0, cache);
        let mut counts = Counts::default();
        for (face, indices) in mesh.triangles().iter().enumerate() {
            let fragment = fragment.for_face(face);
            let cached = indices.map(|index| cache.get(usize::from(index)));
            if let [Some(a), Some(b), Some(c)] = cached {
                self.draw_edges_of_face([a, b, c], bias, &fragment, &mut counts);
                continue;
            }
            let [a, b, c] = &self.corners(mesh, stage, *indices, cached);
            self.draw_edges_of_face([a, b, c], bias, &fragment, &mut counts);
        }
        counts
    }

    /// Draws the edges of a face that is not culled.
    #[inline(never)]
    fn draw_edges_of_face<F, const N: usize>(
        &mut self,
        [a, b, c]: [&Vertex<T, N, P>; 3],
        bias: DepthBias,
        fragment: &F,
        counts: &mut Counts,
    ) where
        F: Fragment<C::Color, 0>,
        W: Interpolates<N>,
    {
        if self.hides([a, b, c]) {
            counts.add(Outcome::Culled);
            return;
        }
        for ends in [[a, b], [b, c], [c, a]] {
            counts.add(self.draw_line(ends, bias, fragment));
        }
    }

    /// Whether a face is culled.
    #[inline]
    fn hides<const N: usize>(&self, vertices: [&Vertex<T, N, P>; 3]) -> bool {
        if self.cull == Cull::Neither {
            return false;
        }
        let positions = vertices.map(|v| &v.position);
        let [a, b, c] = vertices.map(|v| v.outside.0);
        if T::PROJECTS && a & b & c & Outside::PROJECTED != 0 {
            let facing = facing(doubled_area(&T::corners(positions)));
            return facing.is_some_and(|facing| self.cull.hides(facing));
        }
        let in_pixels = positions.map(|position| T::in_pixels(position, &self.viewport));
        let oriented = T::orient(positions, &in_pixels, &self.viewport);
        oriented.is_some_and(|(facing, _)| self.cull.hides(facing))
    }
}

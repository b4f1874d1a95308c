//! Smooth edges: pixels that an edge cuts are drawn with the share of them that the triangle covers, as alpha.
//!
//! Any triangle is drawn by its edge functions in 64 bits here, whatever its vertices: pixels wholly inside in spans, those that
//! a smooth edge cuts one by one.

use super::shade::Shading;
use super::{Counts, Frame, Outcome, rejected};
use crate::blend::Alpha;
use crate::clip::Hither;
use crate::coverage::{Edges, Ramp, covered};
use crate::depth::{DepthPlane, DepthTest, limits};
use crate::fragment::{Fragment, Sample};
use crate::framebuffer::{Target, run};
use crate::interpolation::{Correction, Interpolates, Mode, Run, Varyings};
use crate::mesh::{Mesh, StoredPosition, VertexStage};
use crate::setup::{Facing, Part, Setup, Tier, doubled_area, facing};
use crate::span::Span;
use crate::traversal::{ClipWalk, SmoothSpans};
use crate::vertex::{Outside, Position, Rect, Vertex};
use core::slice::from_mut;
use fixed::types::I16F16;

/// Which pixels of a triangle with smooth edges are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pixels {
    All,
    /// Those that no smooth edge cuts.
    Inside,
    /// Those that one cuts.
    Cut,
}

/// What pixels that an edge cuts are made from.
struct Fringe<'a, F, const N: usize> {
    setup: &'a Setup,
    ramps: [Option<Ramp>; 3],
    /// Whether a vertex is not in front of the eye.
    external: bool,
    shading: &'a Shading<'a, F, N>,
    /// The vertices' depths, least and largest.
    depths: [u32; 2],
}

impl<F, const N: usize> Fringe<'_, F, N> {
    /// The varyings at a pixel; outside of the triangle between the vertices' too.
    #[inline]
    fn varyings<I: Correction>(&self, pixel: Span) -> [I16F16; N] {
        match self.shading.varyings {
            None => [I16F16::ZERO; N],
            Some(v) if v.mode() == Mode::Divided && I::EVERY == 1 => {
                v.divided::<I::Reciprocal>(self.setup, pixel).varyings()
            }
            Some(v) => v.ramp::<I>(self.setup, pixel, false, &mut None).varyings(),
        }
    }

    /// The running depth at a pixel; outside of the triangle between the vertices' too.
    #[inline]
    fn depth(&self, pixel: Span) -> u32 {
        let [least, most] = self.depths;
        let depth = self.shading.depth.map(|plane| plane.beyond(self.setup, pixel.x0, pixel.y));
        depth.unwrap_or(least).max(least).min(most)
    }

    /// Whether a pixel's centre is covered, by the edge functions there.
    #[inline]
    fn covers_centre(&self, values: &[i64; 3]) -> bool {
        let mut edges = self.setup.edges.iter().zip(values);
        edges.all(|(edge, value)| *value > 0 || (*value == 0 && edge.is_top_or_left()))
    }

    /// The colour of a pixel of which so much is covered, Q16, if any is.
    #[inline]
    fn color<I: Correction, K: Copy>(&self, pixel: Span, covered: i32) -> Option<Alpha<K>>
    where
        F: Fragment<Alpha<K>, N>,
    {
        if covered == 0 {
            return None;
        }
        let sample = Sample { x: pixel.x0, y: pixel.y, varyings: self.varyings::<I>(pixel) };
        self.shading.fragment.shade_or_discard(sample)?.part(covered)
    }
}

impl<C, D, W, T, I, K, const P: usize> Frame<C, D, W, T, I, P>
where
    C: Target<Color = Alpha<K>>,
    D: DepthTest,
    T: Tier,
    I: Correction,
    K: Copy,
{
    /// Draws one triangle whose `edges` are smooth, from vertices that this frame has snapped: a pixel that such an edge cuts is
    /// drawn with the share of it that the triangle covers, as alpha. The target merges: see [`Frame::blended`] and
    /// [`Over`](crate::Over).
    ///
    /// The share is off by 0.2 % of a pixel on average, by 1 % where triangles are of a few pixels or less, and by 9 % at the most (host
    /// test `smooth`). The other edges are as exact as ever: where two triangles share one, and it is smooth in neither, no seam
    /// shows. Only in the pixel of a corner that such an edge ends in, what is smooth in the other triangle is not seen.
    ///
    /// Depth is tested for all pixels, and stored where the centre is covered; varyings and depth outside of the triangle stay
    /// between the vertices'. What is behind has to be drawn before.
    ///
    /// By the edge functions in 64 bits, whatever the vertices: more for a triangle than
    /// [`draw_snapped`](Self::draw_snapped), which this is where no edge is smooth.
    ///
    /// ```
    /// use hither::{Alpha, ClipVertex, Edges, Flat, Frame, Framebuffer, Gray8, I16F16, Translucent};
    ///
    /// let mut words = [0; 64];
    /// let mut frame = Frame::new(Framebuffer::<Gray8>::try_new(&mut words, 8, 8)?)?;
    /// let mut smooth = frame.blended::<Alpha<Gray8>>();
    /// let corners = [(-1.0, -0.9), (1.0, -0.9), (0.1, 1.0)].map(|(x, y)| {
    ///     let [x, y] = [x, y].map(I16F16::from_num);
    ///     smooth.snap(&ClipVertex::new(x, y, I16F16::ZERO, I16F16::ONE), [])
    /// });
    /// let white = Translucent(Flat(Gray8(255)), 255);
    /// smooth.draw_smooth(corners.each_ref(), Edges::ALL, &white);
    /// let shown = |word: &u8| b" .:-=+*#%@"[usize::from(*word) * 9 / 255] as char;
    /// let rows: Vec<String> = words.chunks(8).map(|row| row.iter().map(shown).collect()).collect();
    /// assert_eq!(rows, [
    ///     "    =   ",
    ///     "   =%.  ",
    ///     "   %@+  ",
    ///     "  +@@%  ",
    ///     " .%@@@= ",
    ///     " #@@@@% ",
    ///     "-@@@@@@=",
    ///     "=++++++=",
    /// ]);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    pub fn draw_smooth<F, const N: usize>(
        &mut self,
        vertices: [&Vertex<T, N, P>; 3],
        edges: Edges,
        fragment: &F,
    ) -> Outcome
    where
        F: Fragment<Alpha<K>, N>,
        W: Interpolates<N>,
    {
        if edges == Edges::NONE {
            return self.draw_snapped(vertices, fragment);
        }
        self.draw_some(vertices, edges, Pixels::All, fragment)
    }

    /// Draws some pixels of a triangle.
    #[inline(never)]
    fn draw_some<F, const N: usize>(
        &mut self,
        vertices: [&Vertex<T, N, P>; 3],
        edges: Edges,
        pixels: Pixels,
        fragment: &F,
    ) -> Outcome
    where
        F: Fragment<Alpha<K>, N>,
        W: Interpolates<N>,
    {
        let [a, b, c] = vertices.map(|v| v.outside.0);
        let outside = Outside(a | b | c);
        if let Some(outcome) = rejected::<W, N>(a & b & c) {
            return outcome;
        }
        let setup = T::set_up(vertices.map(|v| &v.position), &self.viewport);
        let Some(setup) = &setup else {
            return Outcome::ZeroArea;
        };
        if self.cull.hides(setup.facing) {
            return Outcome::Culled;
        }
        let hither: Option<Hither> = self.hither::<N>();
        let varyings = hither
            .filter(|_| N > 0)
            .map(|hither| Varyings::new::<T, I, P>(setup, vertices, hither, outside));
        let depth = (D::BITS > 0).then(|| DepthPlane::new(setup, vertices, D::BITS, outside));
        let shading = Shading { fragment, varyings: varyings.as_ref(), depth: depth.as_ref() };
        let visible = self.known_window();
        let mut outcome = Outcome::OffScreen;
        for part in [Part::Front, Part::Behind] {
            // A part without a vertex is none, but its edges may be close to each other.
            let signs = vertices.map(|v| v.position.scaled_w().signum());
            let exists = signs.contains(&if part == Part::Front { 1 } else { -1 });
            let bounds = setup.bounds(part).grown().intersect(visible);
            if !exists || bounds.is_empty() || (part == Part::Behind && !W::BEHIND) {
                continue;
            }
            let setup = &if part == Part::Front { *setup } else { setup.mirrored() };
            let fringe = Fringe {
                setup,
                ramps: ramps(setup, edges),
                external: signs.iter().any(|sign| *sign < 1),
                shading: &shading,
                depths: limits(vertices),
            };
            let mut clip = self
                .cuts::<N>(outside)
                .then(|| ClipWalk::new(setup, bounds, vertices, hither, outside));
            self.draw_touched(&fringe, bounds, clip.as_mut(), pixels);
            let fallback = varyings.as_ref().is_some_and(Varyings::fallback);
            outcome = if fallback { Outcome::DrawnByFallback } else { Outcome::Drawn };
        }
        outcome
    }

    /// Draws what pixels a part has of a box.
    #[inline(never)]
    fn draw_touched<F, const N: usize>(
        &mut self,
        fringe: &Fringe<'_, F, N>,
        bounds: Rect,
        clip: Option<&mut ClipWalk<P>>,
        pixels: Pixels,
    ) where
        F: Fragment<Alpha<K>, N>,
    {
        for (touched, inside) in SmoothSpans::new(fringe.setup, &fringe.ramps, bounds, clip) {
            if pixels != Pixels::Cut && inside.x0 < inside.x1 {
                self.draw_span(fringe.setup, inside, fringe.shading);
            }
            if pixels != Pixels::Inside {
                self.draw_fringe(fringe, Span { x1: inside.x0, ..touched });
                self.draw_fringe(fringe, Span { x0: inside.x1, ..touched });
            }
        }
    }

    /// Draws pixels of a row that smooth edges may cut.
    #[inline(never)]
    fn draw_fringe<F, const N: usize>(&mut self, fringe: &Fringe<'_, F, N>, span: Span)
    where
        F: Fragment<Alpha<K>, N>,
    {
        let Span { y, x0, x1 } = span;
        if x0 >= x1 {
            return;
        }
        let (left, top) = self.viewport.origin;
        let (first, length) = run(x0 + left, x1 + left);
        let (row, _) = run(y + top, y + top);
        let mut next = x0;
        let mut pixel = || {
            let x = next;
            next += 1;
            let values = fringe.setup.edges_at(x, y);
            (Span { y, x0: x, x1: x + 1 }, values, covered(&fringe.ramps, &values, fringe.external))
        };
        if D::BITS == 0 {
            let colors = (0..length).map(|_| {
                let (place, _, covered) = pixel();
                fringe.color::<I, K>(place, covered)
            });
            self.target.write(first, row, colors);
            return;
        }
        let (width, _) = self.target.size();
        let at = row.wrapping_mul(width as usize).wrapping_add(first);
        let target = &mut self.target;
        self.depth.run(at, length, |depths| {
            target.write_each::<_, 1>((first, row, at), depths, |stored, _| {
                let (place, values, covered) = pixel();
                let color = fringe.color::<I, K>(place, covered)?;
                let mut kept = *stored;
                let stored = if fringe.covers_centre(&values) { stored } else { &mut kept };
                D::passes(fringe.depth(place), stored).then_some(color)
            });
        });
    }

    /// Draws an indexed mesh as [`draw`](Self::draw) does, with smooth silhouettes: an edge is smooth where the face across it is
    /// missing, or faces the other way. `neighbours` says which it is: see [`Mesh::neighbours`]; faces beyond its end have no
    /// smooth edges.
    ///
    /// Pixels that no silhouette cuts come first, and those that one cuts over them, so the order of a mesh's faces does not
    /// matter, if depth is stored ([`with_depth_stored`](Frame::with_depth_stored)). What is behind the mesh has to be drawn before
    /// it. Each face is looked at with its neighbours, and those with a smooth edge are drawn twice.
    ///
    /// A face without such an edge covers whole pixels, though the silhouette of the next one may cut them: where faces at the
    /// silhouette are seen so obliquely that they are thinner than a pixel, it is as hard as ever there.
    ///
    /// ```
    /// # use hither::{Alpha, ClipVertex, Cull, DepthBuffer, Flat, Frame, Framebuffer, Gray8, Hither, I16F16, Mat4, Mesh};
    /// # use hither::{Translucent, Vertex};
    /// # let square = [[-6i16, -7, 0], [7, -6, 0], [6, 7, 0], [-7, 6, 0]];
    /// # let mesh = Mesh::try_new(&square, 3, &[(); 4], &[[0, 1, 2], [0, 2, 3]])?;
    /// # let (mut words, mut depth_words) = ([0; 64], [u16::MAX; 64]);
    /// # let mut frame = Frame::new(Framebuffer::<Gray8>::try_new(&mut words, 8, 8)?)?
    /// #     .with_hither(Hither::new(I16F16::ONE)?)
    /// #     .with_depth(DepthBuffer::try_new(&mut depth_words, 8, 8)?)?;
    /// let mut neighbours = [[0; 3]; 2];
    /// mesh.neighbours(&mut neighbours)?;
    /// let mut cache = [Vertex::EMPTY; 4];
    /// let mut smooth = frame.blended::<Alpha<Gray8>>().with_depth_stored();
    /// let white = Translucent(Flat(Gray8::WHITE), 255);
    /// smooth.draw_smooth_mesh(&mesh, &neighbours, &Mat4::IDENTITY, &white, &mut cache);
    /// # assert_eq!((words[0] < 255, words[27], words[36]), (true, 255, 255));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    pub fn draw_smooth_mesh<Q, A, S, F, const N: usize>(
        &mut self,
        mesh: &Mesh<'_, Q, A>,
        neighbours: &[[u16; 3]],
        stage: &S,
        fragment: &F,
        cache: &mut [Vertex<T, N, P>],
    ) -> Counts
    where
        Q: StoredPosition,
        S: VertexStage<A, N>,
        F: Fragment<Alpha<K>, N>,
        W: Interpolates<N>,
    {
        self.transform(mesh, stage, 0, cache);
        let corners = |frame: &Self, indices: [u16; 3]| {
            indices.map(|index| frame.vertex(mesh, stage, index, cache))
        };
        let mut counts = Counts::default();
        for pixels in [Pixels::Inside, Pixels::Cut] {
            for (face, indices) in mesh.triangles().iter().enumerate() {
                let vertices = corners(self, *indices);
                let mut edges = Edges::NONE;
                let own = self.facing_of(vertices.each_ref());
                for (i, across) in neighbours.get(face).into_iter().flatten().enumerate() {
                    let across = mesh.triangles().get(usize::from(*across));
                    let other =
                        across.map(|indices| self.facing_of(corners(self, *indices).each_ref()));
                    // One that is seen edge-on is too thin to tell.
                    if other.is_none_or(|other| other.is_some() && other != own) {
                        edges = edges.with(i);
                    }
                }
                let fragment = fragment.for_face(face);
                if pixels == Pixels::Inside {
                    counts.add(if edges == Edges::NONE {
                        self.draw_snapped(vertices.each_ref(), &fragment)
                    } else {
                        self.draw_some(vertices.each_ref(), edges, pixels, &fragment)
                    });
                } else if edges != Edges::NONE {
                    self.draw_some(vertices.each_ref(), edges, pixels, &fragment);
                }
            }
        }
        counts
    }

    /// A vertex of a mesh, from the cache or transformed anew.
    fn vertex<Q, A, S, const N: usize>(
        &self,
        mesh: &Mesh<'_, Q, A>,
        stage: &S,
        index: u16,
        cache: &[Vertex<T, N, P>],
    ) -> Vertex<T, N, P>
    where
        Q: StoredPosition,
        S: VertexStage<A, N>,
        W: Interpolates<N>,
    {
        let index = usize::from(index);
        cache.get(index).copied().unwrap_or_else(|| {
            let mut vertex = Vertex::EMPTY;
            self.transform(mesh, stage, index, from_mut(&mut vertex));
            vertex
        })
    }

    /// Which way a triangle faces, if it has an area.
    fn facing_of<const N: usize>(&self, vertices: [&Vertex<T, N, P>; 3]) -> Option<Facing> {
        let positions = vertices.map(|v| &v.position);
        if positions.iter().all(|position| position.is_projected()) {
            return facing(doubled_area(&T::corners(positions)));
        }
        let in_pixels = positions.map(|position| T::in_pixels(position, &self.viewport));
        T::orient(positions, &in_pixels, &self.viewport).map(|(facing, _)| facing)
    }
}

/// The ramps of a triangle's smooth edges. An edge function belongs to the vertex opposite.
fn ramps(setup: &Setup, edges: Edges) -> [Option<Ramp>; 3] {
    let [first, second, third] = &setup.edges;
    let ramp = |i, edge| if edges.contains(i) { Ramp::new(edge) } else { None };
    [ramp(1, first), ramp(2, second), ramp(0, third)]
}

//! The front door: a frame that triangles and meshes are drawn into, and what became of each.

mod bent;
mod blended;
mod divided;
mod filled;
mod flat;
mod frame;
mod homogeneous;
mod lanes;
mod line;
mod projected;
#[cfg(feature = "heapless")]
mod reach;
mod shade;
mod shape;
mod silhouette;
mod small;
mod smooth;
mod tiny;

pub use frame::{DepthFrame, DepthSize, DisplayFrame, Frame};
#[cfg(feature = "heapless")]
pub(crate) use reach::RowRange;

use crate::clip::Hither;
use crate::depth::{DepthPlane, DepthTest};
use crate::fragment::Fragment;
use crate::framebuffer::Target;
use crate::interpolation::{Correction, Interpolates, Varyings, Width};
use crate::mesh::{Mesh, StoredPosition, VertexStage};
use crate::setup::{Facing, Outline, Part, Setup, Slopes, Tier, Tiny, doubled_area, facing};
use crate::traversal::{ClipWalk, ProjectedSide, is_small};
use crate::vertex::{ClipVertex, Distance, Outside, Position, Rect, Vertex};
use core::slice::from_mut;
use fixed::types::I16F16;
use projected::Deep;
use shade::{NoVaryings, Shading};
use shape::Shape;

/// What became of a triangle, or of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Outcome {
    /// It was rasterized.
    Drawn,
    /// It was rasterized, divided at each pixel though affine was asked for, since it reaches
    /// behind the hither plane.
    DrawnByFallback,
    /// Its facing is culled.
    Culled,
    /// All of it is behind the hither plane, or behind the eye.
    Behind,
    /// All of it is outside of a clip plane.
    Clipped,
    /// It covers no pixel centre of the scissor: beyond a side, or between centres.
    OffScreen,
    /// It is a line or a point, or seen edge-on: the determinant is 0.
    ZeroArea,
}

/// What became of a mesh's triangles, or of their lines: how many each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Counts {
    /// Rasterized, `fallbacks` included.
    pub drawn: u32,
    /// Rasterized, divided at each pixel though affine was asked for.
    pub fallbacks: u32,
    /// Facing away.
    pub culled: u32,
    /// Behind the hither plane, or behind the eye.
    pub behind: u32,
    /// Outside of a clip plane.
    pub clipped: u32,
    /// No pixel centre of the scissor covered.
    pub off_screen: u32,
    /// A determinant of 0.
    pub zero_area: u32,
}

impl core::ops::AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        let add = |a: &mut u32, b: u32| *a = a.saturating_add(b);
        add(&mut self.drawn, other.drawn);
        add(&mut self.fallbacks, other.fallbacks);
        add(&mut self.culled, other.culled);
        add(&mut self.behind, other.behind);
        add(&mut self.clipped, other.clipped);
        add(&mut self.off_screen, other.off_screen);
        add(&mut self.zero_area, other.zero_area);
    }
}

impl Counts {
    /// All triangles that were counted.
    #[must_use]
    pub const fn total(&self) -> u32 {
        let gone = self.culled.saturating_add(self.behind).saturating_add(self.clipped);
        let none = self.off_screen.saturating_add(self.zero_area);
        self.drawn.saturating_add(gone).saturating_add(none)
    }

    /// Counts one more.
    pub fn add(&mut self, outcome: Outcome) {
        let count = match outcome {
            Outcome::Drawn => &mut self.drawn,
            Outcome::DrawnByFallback => {
                self.fallbacks = self.fallbacks.saturating_add(1);
                &mut self.drawn
            }
            Outcome::Culled => &mut self.culled,
            Outcome::Behind => &mut self.behind,
            Outcome::Clipped => &mut self.clipped,
            Outcome::OffScreen => &mut self.off_screen,
            Outcome::ZeroArea => &mut self.zero_area,
        };
        *count = count.saturating_add(1);
    }
}

impl<C, D, W, T, I, const P: usize> Frame<C, D, W, T, I, P>
where
    C: Target,
    D: DepthTest,
    T: Tier,
    I: Correction,
{
    /// Snaps a vertex to the tier's grid for this frame's viewport and planes.
    ///
    /// Snapped vertices may be kept as long as the viewport's size, the hither plane and the planes
    /// stay the same. Those that a frame without depth has snapped are slower in one with depth.
    #[inline(always)]
    pub fn snap<const N: usize>(
        &self,
        vertex: &ClipVertex,
        varyings: [I16F16; N],
    ) -> Vertex<T, N, P>
    where
        W: Interpolates<N>,
    {
        let least_w = self.range.least_w();
        let mut outside = Outside::of(vertex, least_w);
        let mut distances = [Distance::of(0); P];
        let mut bit = Outside::FIRST_PLANE;
        for (distance, plane) in distances.iter_mut().zip(&self.planes) {
            let value = plane.distance(vertex);
            *distance = Distance::of(value);
            outside.0 |= if value < 0 { bit } else { 0 };
            bit <<= 1;
        }
        let position = T::snap(vertex, least_w, &self.viewport);
        if position.is_projected() {
            outside.0 |= Outside::PROJECTED;
        }
        let depth = if D::BITS > 0 { position.depth(vertex) } else { None };
        if depth.is_some() {
            outside.0 |= Outside::RANGED;
        }
        Vertex {
            position,
            z: depth.unwrap_or(vertex.raw[2]),
            shift: vertex.shift,
            outside,
            varyings,
            distances,
        }
    }

    /// Draws one triangle from clip space: three vertices with their varyings.
    pub fn draw_triangle<F, const N: usize>(
        &mut self,
        vertices: [(ClipVertex, [I16F16; N]); 3],
        fragment: &F,
    ) -> Outcome
    where
        F: Fragment<C::Color, N>,
        W: Interpolates<N>,
    {
        let [a, b, c] = vertices.map(|(vertex, varyings)| self.snap(&vertex, varyings));
        self.draw_snapped([&a, &b, &c], fragment)
    }

    /// Draws one triangle from vertices that this frame has snapped.
    #[inline(always)]
    pub fn draw_snapped<F, const N: usize>(
        &mut self,
        [a, b, c]: [&Vertex<T, N, P>; 3],
        fragment: &F,
    ) -> Outcome
    where
        F: Fragment<C::Color, N>,
        W: Interpolates<N>,
    {
        self.draw_vertices(a, b, c, fragment)
    }

    /// [`draw_snapped`](Self::draw_snapped), by references in registers.
    #[inline(never)]
    fn draw_vertices<F, const N: usize>(
        &mut self,
        a: &Vertex<T, N, P>,
        b: &Vertex<T, N, P>,
        c: &Vertex<T, N, P>,
        fragment: &F,
    ) -> Outcome
    where
        F: Fragment<C::Color, N>,
        W: Interpolates<N>,
    {
        let vertices = [a, b, c];
        let [a, b, c] = vertices.map(|v| v.outside.0);
        let (any, all) = (Outside(a | b | c), a & b & c);
        if any.0 & Outside::BOUNDS != 0 || (T::PROJECTS && all & Outside::PROJECTED == 0) {
            if let Some(outcome) = self.draw_outside(vertices, fragment) {
                return outcome;
            }
        }
        let outcome = if !T::PROJECTS {
            self.draw_homogeneous(vertices, any, fragment)
        } else if D::BITS > 16
            || (D::BITS > 0 && all & Outside::RANGED == 0)
            || (N > 0 && I::WIDTH == Width::Long)
        {
            None
        } else if N == 0 {
            self.draw_plain(vertices, fragment)
        } else {
            self.draw_varied(vertices, fragment)
        };
        match outcome {
            Some(outcome) => outcome,
            None => self.draw_any(vertices, any, fragment),
        }
    }

    /// Draws a triangle that some bound concerns, or that is not projected; `None` where it is as any other after all.
    #[inline(never)]
    fn draw_outside<F, const N: usize>(
        &mut self,
        vertices: [&Vertex<T, N, P>; 3],
        fragment: &F,
    ) -> Option<Outcome>
    where
        F: Fragment<C::Color, N>,
        W: Interpolates<N>,
    {
        let [a, b, c] = vertices.map(|v| v.outside.0);
        if let Some(outcome) = rejected::<W, N>(a & b & c) {
            return Some(outcome);
        }
        let outside = Outside(a | b | c);
        let projected = a & b & c & Outside::PROJECTED != 0 && !self.cuts::<N>(outside);
        (T::PROJECTS && !projected).then(|| self.draw_any(vertices, outside, fragment))
    }

    /// Draws a triangle by its edge functions in 64 bits: external ones, those that planes cut, and what has no planes.
    /// Not inlined, so that the others have no stack for it.
    #[inline(never)]
    fn draw_any<F, const N: usize>(
        &mut self,
        vertices: [&Vertex<T, N, P>; 3],
        outside: Outside,
        fragment: &F,
    ) -> Outcome
    where
        F: Fragment<C::Color, N>,
        W: Interpolates<N>,
    {
        // By reference: it is large.
        let setup = T::set_up(vertices.map(|v| &v.position), &self.viewport);
        let Some(setup) = &setup else {
            return Outcome::ZeroArea;
        };
        if self.cull.hides(setup.facing) {
            return Outcome::Culled;
        }
        let visible = self.known_window();
        let boxes = [Part::Front, Part::Behind].map(|part| setup.bounds(part).intersect(visible));
        let [front, behind] = boxes;
        if front.is_empty() && (!W::BEHIND || behind.is_empty()) {
            return Outcome::OffScreen;
        }
        let varyings = self
            .hither()
            .filter(|_| N > 0)
            .map(|hither| Varyings::new::<T, I, P>(setup, vertices, hither, outside));
        let depth = (D::BITS > 0).then(|| DepthPlane::new(setup, vertices, D::BITS, outside));
        let shading = Shading { fragment, varyings: varyings.as_ref(), depth: depth.as_ref() };
        let mut part = |setup: &Setup, bounds: Rect| {
            if self.cuts::<N>(outside) {
                self.draw_cut(setup, bounds, vertices, outside, &shading);
            } else {
                self.draw_part(setup, bounds, None, &shading);
            }
        };
        if !front.is_empty() {
            part(setup, front);
        }
        if W::BEHIND && !behind.is_empty() {
            part(&setup.mirrored(), behind);
        }
        if shading.varyings.is_some_and(Varyings::fallback) {
            Outcome::DrawnByFallback
        } else {
            Outcome::Drawn
        }
    }

    /// The corners of three projected vertices and their doubled area; or what became of the triangle, if it is not drawn.
    #[inline(always)]
    fn oriented<const N: usize>(
        &self,
        vertices: [&Vertex<T, N, P>; 3],
    ) -> Result<([[i32; 2]; 3], i64), Outcome> {
        let corners = T::corners(vertices.map(|v| &v.position));
        // Before anything is made of them: half of a mesh's triangles look away.
        let area = doubled_area(&corners);
        self.turned_away(facing(area)).map_or(Ok((corners, area)), Err)
    }

    /// Draws a triangle of projected vertices, without varyings, that no plane cuts; `None` where it has to be drawn as any
    /// other.
    #[inline(always)]
    fn draw_plain<F, const N: usize>(
        &mut self,
        vertices: [&Vertex<T, N, P>; 3],
        fragment: &F,
    ) -> Option<Outcome>
    where
        F: Fragment<C::Color, N>,
        W: Interpolates<N>,
    {
        let (corners, area) = match self.oriented(vertices) {
            Ok(oriented) => oriented,
            Err(outcome) => return Some(outcome),
        };
        if F::UNIFORM && !F::DISCARDS && D::BITS == 0 {
            return Some(self.fill_projected(&Outline::new(&corners, area > 0), fragment));
        }
        if D::BITS > 0 && Tiny::may_have(area, T::SUBPIXEL_BITS) {
            let [a, b, c] = vertices;
            if let Some(outcome) = self.draw_tiny(a, b, c, fragment) {
                return Some(outcome);
            }
        }
        // Before the outline is made: both together take more registers than there are.
        let slopes = Slopes::new(&corners, area, T::SUBPIXEL_BITS)?;
        let depth = self.depth_plane(&slopes, vertices);
        let outline = Outline::new(&corners, area > 0);
        let whole = outline.bounds(T::SUBPIXEL_BITS);
        if D::BITS > 0 && self.is_small_inside(whole) {
            if whole.is_empty() {
                return Some(Outcome::OffScreen);
            }
            let edges = self.small_rows(&outline, whole);
            self.draw_small(edges, whole, depth, fragment);
            return Some(Outcome::Drawn);
        }
        let Some(shape) = self.shape(outline) else {
            return Some(Outcome::OffScreen);
        };
        let shape = Deep { shape, depth };
        self.draw_edges::<ProjectedSide, _, _, N>(&shape, &NoVaryings, fragment);
        Some(Outcome::Drawn)
    }

    /// [`draw_plain`](Self::draw_plain) with varyings. Not inlined, so that any other triangle has no stack for it.
    #[inline(never)]
    fn draw_varied<F, const N: usize>(
        &mut self,
        vertices: [&Vertex<T, N, P>; 3],
        fragment: &F,
    ) -> Option<Outcome>
    where
        F: Fragment<C::Color, N>,
        W: Interpolates<N>,
    {
        let (corners, area) = match self.oriented(vertices) {
            Ok(oriented) => oriented,
            Err(outcome) => return Some(outcome),
        };
        let Some(shape) = self.shape(Outline::new(&corners, area > 0)) else {
            return Some(Outcome::OffScreen);
        };
        let slopes = Slopes::new(&corners, area, T::SUBPIXEL_BITS)?;
        let depth = self.depth_plane(&slopes, vertices);
        self.draw_varying(&Deep { shape, depth }, &slopes, vertices, fragment)?;
        Some(Outcome::Drawn)
    }

    /// What the window has of an outline, if anything.
    #[inline(always)]
    fn shape(&mut self, outline: Outline) -> Option<Shape> {
        let whole = outline.bounds(T::SUBPIXEL_BITS);
        // Looked at, whatever the outcodes say: the vertices may be another viewport's.
        let window = self.known_window();
        let bounds = whole.intersect(window);
        let short = window.holds(whole) && is_small(whole);
        (!bounds.is_empty()).then_some(Shape { outline, bounds, short })
    }

    /// Why a triangle that faces this way, or none, is not drawn, if it is not.
    #[inline]
    fn turned_away(&self, facing: Option<Facing>) -> Option<Outcome> {
        match facing {
            None => Some(Outcome::ZeroArea),
            Some(facing) => self.cull.hides(facing).then_some(Outcome::Culled),
        }
    }

    /// Whether planes may cut a triangle of which some vertex is outside of these bounds.
    #[inline]
    fn cuts<const N: usize>(&self, outside: Outside) -> bool
    where
        W: Interpolates<N>,
    {
        (W::CLIPS || P > 0) && outside.0 & Outside::CLIPS != 0
    }

    /// Draws a part that planes cut: not inlined, so that a triangle that is not cut has no stack for
    /// the planes.
    #[inline(never)]
    fn draw_cut<F, const N: usize>(
        &mut self,
        setup: &Setup,
        bounds: Rect,
        vertices: [&Vertex<T, N, P>; 3],
        outside: Outside,
        shading: &Shading<'_, F, N>,
    ) where
        F: Fragment<C::Color, N>,
        W: Interpolates<N>,
    {
        let mut clip = ClipWalk::new(setup, bounds, vertices, self.hither(), outside);
        self.draw_part(setup, bounds, Some(&mut clip), shading);
    }

    /// The hither plane, where the range has one.
    #[inline]
    fn hither<const N: usize>(&self) -> Option<Hither>
    where
        W: Interpolates<N>,
    {
        self.range.hither()
    }

    /// Draws an indexed mesh: each vertex through `stage`, each pixel through `fragment`.
    ///
    /// The first `cache.len()` vertices are transformed once each, into the cache the caller lends;
    /// with an entry for each of [`Mesh::vertex_count`] vertices that is all of them. Vertices
    /// beyond are transformed again for every triangle that uses them: an empty cache draws the
    /// same picture, slower. An entry is `size_of::<Vertex<T, N, P>>()` bytes: 28 and 4 a varying
    /// in the exact tier, and 8 a clip plane.
    pub fn draw<Q, A, S, F, const N: usize>(
        &mut self,
        mesh: &Mesh<'_, Q, A>,
        stage: &S,
        fragment: &F,
        cache: &mut [Vertex<T, N, P>],
    ) -> Counts
    where
        Q: StoredPosition,
        S: VertexStage<A, N>,
        F: Fragment<C::Color, N>,
        W: Interpolates<N>,
    {
        self.transform(mesh, stage, 0, cache);
        let mut counts = Counts::default();
        for face in mesh.triangles().iter().enumerate() {
            counts.add(self.draw_face(mesh, stage, face, fragment, cache));
        }
        counts
    }

    /// Draws a face of a mesh, from its number and indices.
    #[inline(always)]
    pub(crate) fn draw_face<Q, A, S, F, const N: usize>(
        &mut self,
        mesh: &Mesh<'_, Q, A>,
        stage: &S,
        (face, indices): (usize, &[u16; 3]),
        fragment: &F,
        cache: &[Vertex<T, N, P>],
    ) -> Outcome
    where
        Q: StoredPosition,
        S: VertexStage<A, N>,
        F: Fragment<C::Color, N>,
        W: Interpolates<N>,
    {
        let [i, j, k] = indices.map(|index| cache.get(usize::from(index)));
        let fragment = fragment.for_face(face);
        match (i, j, k) {
            (Some(a), Some(b), Some(c)) => self.draw_snapped([a, b, c], &fragment),
            corners => self.draw_uncached(mesh, stage, *indices, corners.into(), &fragment),
        }
    }

    /// A mesh's vertices from `first` on, transformed and snapped, as many as there are entries for.
    ///
    /// Not inlined, so that there is one copy of the vertex stage in a firmware.
    #[inline(never)]
    pub(crate) fn transform<Q, A, S, const N: usize>(
        &self,
        mesh: &Mesh<'_, Q, A>,
        stage: &S,
        first: usize,
        entries: &mut [Vertex<T, N, P>],
    ) where
        Q: StoredPosition,
        S: VertexStage<A, N>,
        W: Interpolates<N>,
    {
        for (entry, (position, attribute)) in entries.iter_mut().zip(mesh.vertices(first)) {
            let (clip, varyings) = stage.vertex(position, attribute);
            *entry = self.snap(&clip, varyings);
        }
    }

    /// Draws a triangle of a mesh of which some corners are not in the cache. Not inlined, so that
    /// one that is has no stack for them.
    #[inline(never)]
    fn draw_uncached<Q, A, S, F, const N: usize>(
        &mut self,
        mesh: &Mesh<'_, Q, A>,
        stage: &S,
        indices: [u16; 3],
        cached: [Option<&Vertex<T, N, P>>; 3],
        fragment: &F,
    ) -> Outcome
    where
        Q: StoredPosition,
        S: VertexStage<A, N>,
        F: Fragment<C::Color, N>,
        W: Interpolates<N>,
    {
        let [a, b, c] = &self.corners(mesh, stage, indices, cached);
        self.draw_snapped([a, b, c], fragment)
    }

    /// The corners of a triangle of a mesh: those that are in the cache, and the others transformed.
    #[inline]
    pub(crate) fn corners<Q, A, S, const N: usize>(
        &self,
        mesh: &Mesh<'_, Q, A>,
        stage: &S,
        indices: [u16; 3],
        cached: [Option<&Vertex<T, N, P>>; 3],
    ) -> [Vertex<T, N, P>; 3]
    where
        Q: StoredPosition,
        S: VertexStage<A, N>,
        W: Interpolates<N>,
    {
        let mut corners = [Vertex::EMPTY; 3];
        for ((corner, index), cached) in corners.iter_mut().zip(indices).zip(cached) {
            match cached {
                Some(cached) => *corner = *cached,
                None => self.transform(mesh, stage, usize::from(index), from_mut(corner)),
            }
        }
        corners
    }
}

/// Why a triangle whose vertices are all outside of the bounds in `all` shows nothing, if so.
///
/// Each bound is linear over the triangle, so what holds at three vertices holds everywhere on the
/// part in front; a clip plane also on the part behind.
#[inline]
fn rejected<W: Interpolates<N>, const N: usize>(all: u16) -> Option<Outcome> {
    if !W::BEHIND && all & Outside::HITHER != 0 {
        Some(Outcome::Behind)
    } else if !W::BEHIND && all & Outside::SIDES != 0 {
        Some(Outcome::OffScreen)
    } else if all & Outside::CLIPS & !Outside::HITHER != 0 {
        Some(Outcome::Clipped)
    } else {
        None
    }
}

#[cfg(test)]
mod tests;

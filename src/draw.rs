//! The front door: a frame that triangles and meshes are drawn into, and what became of each.

mod flat;
mod frame;
mod homogeneous;
mod lanes;
mod projected;
mod shade;
mod shape;

pub use frame::{DepthFrame, DepthSize, DisplayFrame, Frame};

use crate::clip::{ClipEdges, Hither};
use crate::depth::{DepthPlane, DepthTest};
use crate::fragment::Fragment;
use crate::framebuffer::Target;
use crate::interpolation::{Correction, Interpolates, Varyings};
use crate::mesh::{Mesh, StoredPosition, VertexStage};
use crate::setup::{Facing, Outline, Part, Setup, Slopes, Tier, doubled_area, facing};
use crate::traversal::ClipWalk;
use crate::vertex::{ClipVertex, Distance, Outside, Position, Rect, Vertex};
use core::slice::from_mut;
use fixed::types::I16F16;
use shade::Shading;
use shape::Shape;

/// What became of a triangle.
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

/// What became of a mesh's triangles: how many each.
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
    #[inline(never)]
    pub fn draw_snapped<F, const N: usize>(
        &mut self,
        vertices: [&Vertex<T, N, P>; 3],
        fragment: &F,
    ) -> Outcome
    where
        F: Fragment<C::Color, N>,
        W: Interpolates<N>,
    {
        let [a, b, c] = vertices.map(|v| v.outside.0);
        if let Some(outcome) = rejected::<W, N>(a & b & c) {
            return outcome;
        }
        let outside = Outside(a | b | c);
        if let Some(outcome) = self.draw_projected(vertices, outside, fragment) {
            return outcome;
        }
        if let Some(outcome) = self.draw_homogeneous(vertices, outside, fragment) {
            return outcome;
        }
        self.draw_any(vertices, outside, fragment)
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
        let (left, top) = self.viewport.origin;
        let visible = self.window().moved(-left, -top);
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

    /// Draws a triangle of three projected vertices; `None` where it is not one, or has to be drawn as any other.
    #[inline(never)]
    fn draw_projected<F, const N: usize>(
        &mut self,
        vertices: [&Vertex<T, N, P>; 3],
        outside: Outside,
        fragment: &F,
    ) -> Option<Outcome>
    where
        F: Fragment<C::Color, N>,
        W: Interpolates<N>,
    {
        let corners = T::projected(vertices.map(|v| &v.position))?;
        // Before anything is made of them: half of a mesh's triangles look away.
        let area = doubled_area(&corners);
        if let Some(outcome) = self.turned_away(facing(area)) {
            return Some(outcome);
        }
        if self.cuts::<N>(outside) {
            return None;
        }
        let corners = self.in_target(corners);
        let outline = Outline::new(&corners, area > 0);
        let whole = outline.bounds(T::SUBPIXEL_BITS);
        // Looked at, whatever the outcodes say: the vertices may be another viewport's.
        let window = self.window();
        let inside = window.holds(whole);
        if F::UNIFORM && D::BITS == 0 && N == 0 {
            return Some(if inside {
                self.fill_inside(&outline, whole, fragment)
            } else {
                self.fill_windowed(&outline, whole, fragment)
            });
        }
        let bounds = whole.intersect(window);
        if bounds.is_empty() {
            return Some(Outcome::OffScreen);
        }
        let shape = Shape::new(outline, bounds, inside, T::SUBPIXEL_BITS);
        let slopes = Slopes::new(&corners, area, whole, T::SUBPIXEL_BITS)?;
        self.shade_shape(shape, &slopes, vertices, fragment)
    }

    /// Why a triangle that faces this way, or none, is not drawn, if it is not.
    #[inline]
    fn turned_away(&self, facing: Option<Facing>) -> Option<Outcome> {
        match facing {
            None => Some(Outcome::ZeroArea),
            Some(facing) => self.cull.hides(facing).then_some(Outcome::Culled),
        }
    }

    /// Corners in the target's subpixels, of those in the viewport's.
    #[inline]
    fn in_target(&self, corners: [[i32; 2]; 3]) -> [[i32; 2]; 3] {
        let (left, top) = self.viewport.origin;
        let (left, top) = (left << T::SUBPIXEL_BITS, top << T::SUBPIXEL_BITS);
        corners.map(|[x, y]| [x + left, y + top])
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
        let edges = ClipEdges::new(setup, vertices, self.hither(), outside);
        let mut clip = ClipWalk::new(&edges, bounds);
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
        for (face, indices) in mesh.triangles().iter().enumerate() {
            let [i, j, k] = indices.map(|index| cache.get(usize::from(index)));
            let fragment = fragment.for_face(face);
            counts.add(match (i, j, k) {
                (Some(a), Some(b), Some(c)) => self.draw_snapped([a, b, c], &fragment),
                corners => self.draw_uncached(mesh, stage, *indices, corners.into(), &fragment),
            });
        }
        counts
    }

    /// A mesh's vertices from `first` on, transformed and snapped, as many as there are entries for.
    ///
    /// Not inlined, so that there is one copy of the vertex stage in a firmware.
    #[inline(never)]
    fn transform<Q, A, S, const N: usize>(
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
        let mut corners = [Vertex::EMPTY; 3];
        for ((corner, index), cached) in corners.iter_mut().zip(indices).zip(cached) {
            match cached {
                Some(cached) => *corner = *cached,
                None => self.transform(mesh, stage, usize::from(index), from_mut(corner)),
            }
        }
        let [a, b, c] = &corners;
        self.draw_snapped([a, b, c], fragment)
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
mod tests {
    use super::*;

    #[test]
    fn counts_add_up() {
        let all = [
            Outcome::Drawn,
            Outcome::DrawnByFallback,
            Outcome::Culled,
            Outcome::Behind,
            Outcome::Clipped,
            Outcome::OffScreen,
            Outcome::ZeroArea,
        ];
        let mut counts = Counts::default();
        for outcome in all {
            counts.add(outcome);
        }
        assert_eq!((counts.drawn, counts.fallbacks, counts.total()), (2, 1, 7));
        counts += counts;
        assert_eq!((counts.drawn, counts.fallbacks, counts.total()), (4, 2, 14));
        counts += Counts { drawn: u32::MAX, ..Counts::default() };
        assert_eq!(counts.drawn, u32::MAX);
    }
}

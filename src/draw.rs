//! The front door: a frame that triangles and meshes are drawn into, and what became of each.

mod bent;
mod flat;
mod frame;
mod homogeneous;
mod lanes;
mod projected;
mod shade;
mod shape;

pub use frame::{DepthFrame, DepthSize, DisplayFrame, Frame};

use crate::clip::Hither;
use crate::depth::{DepthPlane, DepthTest};
use crate::fragment::Fragment;
use crate::framebuffer::Target;
use crate::interpolation::{Correction, Interpolates, Varyings};
use crate::math::signed;
use crate::mesh::{Mesh, StoredPosition, VertexStage};
use crate::setup::{Facing, Outline, Part, Setup, Slopes, Tier, doubled_area, facing};
use crate::traversal::{ClipWalk, ProjectedSide, SmallRows, is_small};
use crate::vertex::{ClipVertex, Distance, Outside, Position, Rect, Vertex};
use core::slice::from_mut;
use fixed::types::I16F16;
use projected::Deep;
use shade::{NoVaryings, Shading};
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
        } else if D::BITS > 16 || (D::BITS > 0 && all & Outside::RANGED == 0) {
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
        if F::UNIFORM && D::BITS == 0 {
            return Some(self.fill_projected(&Outline::new(&corners, area > 0), fragment));
        }
        // Before the outline is made: both together take more registers than there are.
        let slopes = Slopes::new(&corners, area, T::SUBPIXEL_BITS)?;
        let depth = self.depth_plane(&slopes, vertices);
        let outline = Outline::new(&corners, area > 0);
        let whole = outline.bounds(T::SUBPIXEL_BITS);
        if D::BITS > 0 && self.is_small(whole) {
            if whole.is_empty() {
                return Some(Outcome::OffScreen);
            }
            let edges = self.short_rows(&outline, whole);
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

    /// Whether the whole of a triangle is in the window, and small. Looked at, whatever the outcodes say: the vertices may be
    /// another viewport's.
    #[inline]
    fn is_small(&self, whole: Rect) -> bool {
        self.small_window.holds(whole) && is_small(whole)
    }

    /// The rows of a small triangle in this target.
    #[inline(always)]
    fn short_rows(&self, outline: &Outline, whole: Rect) -> SmallRows {
        let (width, _) = self.target.size();
        let outline = outline.moved(-whole.x0, T::SUBPIXEL_BITS);
        SmallRows::new(&outline, whole, T::SUBPIXEL_BITS, signed(width))
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
    use crate::{
        DepthBuffer, FaceColors, Flat, Framebuffer, PackedEvery, Quick, Rgb565, Vertex, Viewport,
    };
    use std::vec;
    use std::vec::Vec;

    /// A target that can no more than it must, of rows of any width.
    struct Plain {
        words: Vec<u16>,
        width: usize,
    }

    impl Plain {
        fn new(width: usize, height: usize) -> Self {
            Self { words: vec![0; width * height], width }
        }
    }

    impl Target for Plain {
        type Color = Rgb565;

        fn size(&self) -> (u32, u32) {
            (self.width as u32, (self.words.len() / self.width) as u32)
        }

        fn write(&mut self, x: usize, y: usize, colors: impl Iterator<Item = Option<Rgb565>>) {
            let row = self.words.chunks_mut(self.width).nth(y).unwrap();
            let mut left = row[x..].iter_mut();
            for color in colors {
                let word = left.next().expect("a run is inside of its row");
                *word = color.map_or(*word, |color| color.0);
            }
        }
    }

    /// A colour that is not the same everywhere.
    #[derive(Clone, Copy)]
    struct Checkers(u16);

    impl Fragment<Rgb565, 0> for Checkers {
        const UNIFORM: bool = false;

        fn shade(&self, sample: crate::Sample<0>) -> Rgb565 {
            Rgb565(self.0 + 600 * ((sample.x ^ sample.y) & 1) as u16)
        }
    }

    /// Triangles of all sizes in and around a frame, each in its colour or two, without depth and with it: the words of both.
    fn draw_all<C: Target<Color = Rgb565>>(
        targets: [C; 2],
        (width, height): (u32, u32),
        origin: (i16, i16),
    ) -> [C; 2] {
        let hither = Hither::new(I16F16::ONE).unwrap();
        let viewport = Viewport::new(64, 48).unwrap().with_origin(origin.0, origin.1);
        let mut depths = vec![u16::MAX; (width * height) as usize];
        let [flat, deep] = targets;
        let mut flat = Frame::with_viewport(flat, viewport).with_tier(Quick::<8>);
        let deep = Frame::with_viewport(deep, viewport).with_tier(Quick::<8>).with_hither(hither);
        let depth = DepthBuffer::try_new(&mut depths, width, height).unwrap();
        let mut deep = deep.with_depth(depth).unwrap().with_correction(PackedEvery::<8>);
        let mut state = 1u64;
        let mut below = move |n: i32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((state >> 33) % u64::from(n.unsigned_abs())) as i32
        };
        for n in 1..600u16 {
            let reach = 2 << below(16);
            let at = [0, 1].map(|_| below(1 << 17) - (1 << 16));
            let corners = [(); 3].map(|()| {
                let [x, y] = at.map(|at| at + below(2 * reach) - reach);
                let [x, y, z] = [x, y, below(1 << 16)].map(I16F16::from_bits);
                ClipVertex::new(x, y, z, I16F16::ONE)
            });
            let corners = corners.map(|corner| (corner, []));
            if n % 4 == 0 {
                flat.draw_triangle(corners, &Checkers(n));
                deep.draw_triangle(corners, &Checkers(n));
            } else {
                flat.draw_triangle(corners, &Flat(Rgb565(n)));
                deep.draw_triangle(corners, &Flat(Rgb565(n)));
            }
        }
        [flat.into_parts().0, deep.into_parts().0]
    }

    /// Runs of small triangles are counted in the target's rows: where those are too wide for it, and in targets that take
    /// rows one by one, the picture is the same.
    #[test]
    fn targets_of_any_width_and_kind_have_the_same_picture() {
        let (width, height) = (64, 48);
        let mut words = [vec![0; 64 * 48], vec![0; 64 * 48]];
        let [a, b] = &mut words;
        let buffers =
            [a, b].map(|words| Framebuffer::<Rgb565>::try_new(words, width, height).unwrap());
        draw_all(buffers, (width, height), (0, 0));
        assert!(words.iter().all(|words| words.iter().filter(|&&word| word > 0).count() > 2500));
        let plain = draw_all([(); 2].map(|()| Plain::new(64, 48)), (width, height), (0, 0));
        assert!(words[0] == plain[0].words && words[1] == plain[1].words);
        for (wide, origin) in [(800, (730, 3)), (816, (752, 0)), (817, (0, 2)), (2000, (1900, 1))] {
            let plains = [(); 2].map(|()| Plain::new(wide, 52));
            for (words, target) in words.iter().zip(draw_all(plains, (wide as u32, 52), origin)) {
                for (y, row) in words.chunks(64).enumerate() {
                    let start = (y + origin.1 as usize) * wide + origin.0 as usize;
                    assert_eq!(row, &target.words[start..start + 64], "row {y} of {wide} wide");
                }
            }
        }
    }

    /// A colour of many is drawn where one is: small triangles too, without depth.
    #[test]
    fn colours_of_any_kind_are_drawn_without_depth() {
        let frame = || Frame::new(Plain::new(16, 16)).unwrap().with_tier(Quick::<8>);
        let (mut flat, mut checkers) = (frame(), frame());
        let corner = |x: i32, y: i32| {
            let [x, y] = [x, y].map(|v| I16F16::from_bits(v << 12));
            (ClipVertex::new(x, y, I16F16::ZERO, I16F16::ONE), [])
        };
        let corners = [corner(-9, -8), corner(7, -5), corner(2, 11)];
        flat.draw_triangle(corners, &Flat(Rgb565(1)));
        checkers.draw_triangle(corners, &Checkers(1));
        let (flat, checkers) = (flat.into_parts().0.words, checkers.into_parts().0.words);
        assert!(flat.iter().filter(|&&word| word > 0).count() > 30);
        for (n, (flat, checkers)) in flat.iter().zip(checkers).enumerate() {
            let odd = ((n % 16) ^ (n / 16)) & 1 == 1;
            assert_eq!(checkers, flat * if odd { 601 } else { 1 }, "pixel {n}");
        }
    }

    #[test]
    fn a_target_of_another_size_than_the_depth_buffer_shows_nothing() {
        let (mut words, mut others, mut depths) = ([0; 64], [0; 64], [u16::MAX; 64]);
        let buffer = Framebuffer::<Rgb565>::try_new(&mut words, 8, 8).unwrap();
        let hither = Hither::new(I16F16::ONE).unwrap();
        let frame = Frame::new(buffer).unwrap().with_tier(Quick::<8>).with_hither(hither);
        let depth = DepthBuffer::try_new(&mut depths, 8, 8).unwrap();
        let mut frame = frame.with_depth(depth).unwrap();
        let corner = |x: i32, y: i32| {
            let [x, y] = [x, y].map(I16F16::from_num);
            (ClipVertex::new(x, y, I16F16::ZERO, I16F16::ONE), [])
        };
        let corners = [corner(-1, -1), corner(1, -1), corner(0, 1)];
        assert_eq!(frame.draw_triangle(corners, &Flat(Rgb565(7))), Outcome::Drawn);
        *frame.target_mut() = Framebuffer::<Rgb565>::try_new(&mut others, 4, 4).unwrap();
        assert_eq!(frame.draw_triangle(corners, &Flat(Rgb565(7))), Outcome::OffScreen);
        assert!(words.contains(&7) && !others.contains(&7));
    }

    #[test]
    fn an_empty_vertex_draws_nothing() {
        let mut words = [0; 64];
        let buffer = Framebuffer::<Rgb565>::try_new(&mut words, 8, 8).unwrap();
        let mut frame = Frame::new(buffer).unwrap().with_tier(Quick::<8>);
        let corner = |x: i32, y: i32| {
            let [x, y] = [x, y].map(I16F16::from_num);
            frame.snap(&ClipVertex::new(x, y, I16F16::ZERO, I16F16::ONE), [])
        };
        let [a, b] = [corner(1, 1), corner(1, -1)];
        let colors = [Rgb565(7)];
        let fragment = FaceColors::new(&colors).unwrap();
        let outcome = frame.draw_snapped([&a, &Vertex::EMPTY, &b], &fragment);
        assert_eq!(outcome, Outcome::ZeroArea);
        assert_eq!(words, [0; 64]);
    }

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

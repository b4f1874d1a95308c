//! The front door: a frame that triangles and meshes are drawn into, and what became of each.

mod frame;

pub use frame::{DepthFrame, DepthSize, DisplayFrame, Frame};

use crate::clip::{ClipEdges, Hither};
use crate::depth::{DepthPlane, DepthRun, DepthTest};
use crate::fragment::{Fragment, Sample};
use crate::framebuffer::{Target, run};
use crate::interpolation::{BLOCK, Correction, Interpolates, Mode, Run, Varyings};
use crate::mesh::{Mesh, StoredPosition, VertexStage};
use crate::setup::{Part, Setup, Tier};
use crate::span::Span;
use crate::traversal::Spans;
use crate::vertex::{ClipVertex, Distance, Outside, Rect, Vertex};
use fixed::types::I16F16;

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

impl Counts {
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

/// What a triangle's pixels are made from, once it is set up.
struct Shading<'a, F, const N: usize> {
    fragment: &'a F,
    /// There unless `N` is 0.
    varyings: Option<Varyings<N>>,
    /// There where depth is kept.
    depth: Option<DepthPlane>,
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
    /// stay the same.
    #[inline]
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
        Vertex {
            position: T::snap(vertex, least_w, &self.viewport),
            z: vertex.raw[2],
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
        let Some(setup) = T::set_up(vertices.map(|v| &v.position), &self.viewport) else {
            return Outcome::ZeroArea;
        };
        if self.cull.hides(setup.facing) {
            return Outcome::Culled;
        }
        let (width, height) = self.target.size();
        let visible = self.viewport.visible(width, height);
        let boxes = [Part::Front, Part::Behind].map(|part| setup.bounds(part).intersect(visible));
        let [front, behind] = boxes;
        if front.is_empty() && (!W::BEHIND || behind.is_empty()) {
            return Outcome::OffScreen;
        }
        let outside = Outside(a | b | c);
        let shading = Shading {
            fragment,
            varyings: self
                .hither()
                .filter(|_| N > 0)
                .map(|hither| Varyings::new::<T, I, P>(&setup, vertices, hither, outside)),
            depth: (D::BITS > 0).then(|| DepthPlane::new(&setup, vertices, D::BITS)),
        };
        let cut = (W::CLIPS || P > 0) && outside.0 & Outside::CLIPS != 0;
        let hither = self.hither();
        let mut part = |setup: &Setup, bounds: Rect| {
            let clip = cut.then(|| ClipEdges::new(setup, vertices, hither, outside));
            self.draw_part(setup, bounds, clip.as_ref(), &shading);
        };
        if !front.is_empty() {
            part(&setup, front);
        }
        if W::BEHIND && !behind.is_empty() {
            part(&setup.mirrored(), behind);
        }
        if shading.varyings.is_some_and(|v| v.fallback) {
            Outcome::DrawnByFallback
        } else {
            Outcome::Drawn
        }
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
        let vertex = |frame: &Self, index: usize| {
            mesh.vertex(index).map_or(Vertex::EMPTY, |(position, attribute)| {
                let (clip, varyings) = stage.vertex(position, attribute);
                frame.snap(&clip, varyings)
            })
        };
        for (index, entry) in cache.iter_mut().take(mesh.vertex_count()).enumerate() {
            *entry = vertex(self, index);
        }
        let mut counts = Counts::default();
        let mut spare = [Vertex::EMPTY; 3];
        for (face, indices) in mesh.triangles().iter().enumerate() {
            let indices = indices.map(usize::from);
            for (spare, &index) in spare.iter_mut().zip(&indices) {
                if index >= cache.len() {
                    *spare = vertex(self, index);
                }
            }
            let ([i, j, k], [a, b, c]) = (indices, &spare);
            let corner = |index: usize, spare| cache.get(index).unwrap_or(spare);
            let corners = [corner(i, a), corner(j, b), corner(k, c)];
            counts.add(self.draw_snapped(corners, &fragment.for_face(face)));
        }
        counts
    }

    /// Draws what a part covers of a box.
    #[inline]
    fn draw_part<F, const N: usize>(
        &mut self,
        setup: &Setup,
        bounds: Rect,
        clip: Option<&ClipEdges<P>>,
        shading: &Shading<'_, F, N>,
    ) where
        F: Fragment<C::Color, N>,
    {
        let length = match &shading.varyings {
            Some(varyings) if varyings.mode == Mode::Pieces => I::EVERY,
            Some(varyings) if varyings.mode == Mode::Divided => BLOCK,
            _ => i32::MAX,
        };
        for span in Spans::new(setup, bounds, clip, T::NARROW) {
            if F::UNIFORM && shading.depth.is_none() && N == 0 {
                self.fill(span, shading);
            } else {
                for block in span.blocks(length) {
                    self.draw_block(setup, block, shading);
                }
            }
        }
    }

    /// Fills a span with the shader's one colour.
    #[inline]
    fn fill<F, const N: usize>(&mut self, span: Span, shading: &Shading<'_, F, N>)
    where
        F: Fragment<C::Color, N>,
    {
        let Span { y, x0, x1 } = span;
        let varyings = [I16F16::ZERO; N];
        let color = shading.fragment.shade(Sample { x: x0, y, varyings });
        let (left, top) = self.viewport.origin;
        let (x, length) = run(x0 + left, x1 + left);
        let (y, _) = run(y + top, y + top);
        self.target.fill(x, y, length, color);
    }

    /// Draws a block: depth and varyings start from the exact edge functions at its first pixel.
    #[inline]
    fn draw_block<F, const N: usize>(
        &mut self,
        setup: &Setup,
        block: Span,
        shading: &Shading<'_, F, N>,
    ) where
        F: Fragment<C::Color, N>,
    {
        let edges = setup.edges_at(block.x0, block.y);
        let depth = shading.depth.map_or(DepthRun::NONE, |plane| plane.run(block, edges));
        if !depth.inside && block.x1 - block.x0 > 1 {
            // Some depth of the row saturates: each pixel by itself.
            for pixel in block.blocks(1) {
                self.draw_block_inside(setup, pixel, shading);
            }
        } else {
            self.draw_run_of(setup, block, edges, depth, shading);
        }
    }

    /// A single pixel, whose depth saturates by itself.
    fn draw_block_inside<F, const N: usize>(
        &mut self,
        setup: &Setup,
        pixel: Span,
        shading: &Shading<'_, F, N>,
    ) where
        F: Fragment<C::Color, N>,
    {
        let edges = setup.edges_at(pixel.x0, pixel.y);
        let depth = shading.depth.map_or(DepthRun::NONE, |plane| plane.run(pixel, edges));
        self.draw_run_of(setup, pixel, edges, depth, shading);
    }

    /// Draws a block by the way its varyings run.
    #[inline]
    fn draw_run_of<F, const N: usize>(
        &mut self,
        setup: &Setup,
        block: Span,
        edges: [i64; 3],
        depth: DepthRun,
        shading: &Shading<'_, F, N>,
    ) where
        F: Fragment<C::Color, N>,
    {
        match &shading.varyings {
            None => self.draw_run(block, NoVaryings, depth, shading.fragment),
            Some(v) if v.mode == Mode::Divided && I::EVERY == 1 => {
                self.draw_run(block, v.divided(edges), depth, shading.fragment);
            }
            Some(v) => self.draw_run(block, v.ramp(setup, block, edges), depth, shading.fragment),
        }
    }

    /// The pixel loop: test, shade what passes, write.
    #[inline]
    fn draw_run<F, R, const N: usize>(
        &mut self,
        block: Span,
        mut varyings: R,
        depth: DepthRun,
        fragment: &F,
    ) where
        F: Fragment<C::Color, N>,
        R: Run<N>,
    {
        let Span { y, x0, x1 } = block;
        let (left, top) = self.viewport.origin;
        let (first, length) = run(x0 + left, x1 + left);
        let (row, _) = run(y + top, y + top);
        let (running, step) = depth.running();
        let tests = self.depth.test(x0 + left, y + top, x1 - x0, running, step);
        let mut x = x0;
        let colors = tests.take(length).map(|passes| {
            let color =
                passes.then(|| fragment.shade(Sample { x, y, varyings: varyings.varyings() }));
            varyings.step();
            x += 1;
            color
        });
        self.target.write(first, row, colors);
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

/// No varyings to step along.
struct NoVaryings;

impl<const N: usize> Run<N> for NoVaryings {
    #[inline]
    fn varyings(&self) -> [I16F16; N] {
        [I16F16::ZERO; N]
    }

    #[inline]
    fn step(&mut self) {}
}

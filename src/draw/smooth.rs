//! Smooth edges: pixels that an edge cuts are drawn with the share of them that the triangle covers, as alpha.
//!
//! Any triangle is drawn by its edge functions in 64 bits here, whatever its vertices: pixels wholly inside in spans, those that
//! a smooth edge cuts one by one.

use super::shade::Shading;
use super::{Frame, Outcome, rejected};
use crate::blend::Alpha;
use crate::clip::Hither;
use crate::coverage::{Cut, Edges, Ramp, covered, left};
use crate::depth::{DepthPlane, DepthTest, limits};
use crate::fragment::{Fragment, Sample};
use crate::framebuffer::{Target, run};
use crate::interpolation::{Correction, Interpolates, Mode, Run, Varyings};
use crate::setup::{Part, Setup, Tier};
use crate::span::Span;
use crate::traversal::{ClipWalk, SmoothSpans};
use crate::vertex::{Outside, Position, Rect, Vertex};
use fixed::types::I16F16;

/// Which pixels of a triangle with smooth edges are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pixels {
    All,
    /// Those that no smooth edge cuts.
    Inside,
    /// Those that one cuts.
    Cut,
}

/// What cuts the pixels of a triangle.
pub(super) struct Cuts<const M: usize> {
    /// Its smooth edges.
    pub(super) smooth: Edges,
    /// Those of them whose pixels are left out.
    pub(super) bare: Edges,
    /// Lines beside it that are its neighbours' smooth edges, on whose inner side it is.
    pub(super) beside: [Option<Cut>; M],
}

impl<const M: usize> Cuts<M> {
    /// Whether anything cuts.
    pub(super) fn any(&self) -> bool {
        self.smooth != Edges::NONE || self.beside.iter().any(Option::is_some)
    }

    /// Whether something cuts pixels that are not left out.
    pub(super) fn shows_any(&self) -> bool {
        self.smooth != self.bare || self.beside.iter().flatten().any(|cut| !cut.ramp.is_bare())
    }
}

/// What pixels that an edge cuts are made from.
struct Fringe<'a, F, const N: usize, const M: usize> {
    setup: &'a Setup,
    ramps: [Option<Ramp>; 3],
    beside: &'a [Option<Cut>; M],
    /// Whether a vertex is not in front of the eye.
    external: bool,
    shading: &'a Shading<'a, F, N>,
    /// The vertices' depths, least and largest.
    depths: [u32; 2],
}

impl<F, const N: usize, const M: usize> Fringe<'_, F, N, M> {
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

    /// How much of a pixel is covered, Q16, by the edge functions there.
    #[inline]
    fn covered(&self, x: i32, y: i32, values: &[i64; 3]) -> i32 {
        let own = covered(&self.ramps, values, self.external);
        if M == 0 { own } else { own.min(left(&self.ramps, values, self.beside, (x, y))) }
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
    /// The share is off by 0.5 % of a pixel on average, by 1.2 % where triangles are of a few pixels or less, and by 10 % at the most
    /// (host test `smooth`). The other edges are as exact as ever: where two triangles share one, and it is smooth in neither, no seam
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
        let cuts = Cuts { smooth: edges, bare: Edges::NONE, beside: [] };
        self.draw_some(vertices, &cuts, Pixels::All, fragment)
    }

    /// Draws some pixels of a triangle.
    #[inline(never)]
    pub(super) fn draw_some<F, const N: usize, const M: usize>(
        &mut self,
        vertices: [&Vertex<T, N, P>; 3],
        cuts: &Cuts<M>,
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
                ramps: ramps(setup, cuts),
                beside: &cuts.beside,
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
    fn draw_touched<F, const N: usize, const M: usize>(
        &mut self,
        fringe: &Fringe<'_, F, N, M>,
        bounds: Rect,
        clip: Option<&mut ClipWalk<P>>,
        pixels: Pixels,
    ) where
        F: Fragment<Alpha<K>, N>,
    {
        let edges = (&fringe.setup.edges, &fringe.ramps);
        for (touched, inside) in SmoothSpans::new(edges, fringe.beside, bounds, clip) {
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
    fn draw_fringe<F, const N: usize, const M: usize>(
        &mut self,
        fringe: &Fringe<'_, F, N, M>,
        span: Span,
    ) where
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
            (Span { y, x0: x, x1: x + 1 }, values, fringe.covered(x, y, &values))
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
}

/// The ramps of a triangle's smooth edges. An edge function belongs to the vertex opposite.
fn ramps<const M: usize>(setup: &Setup, cuts: &Cuts<M>) -> [Option<Ramp>; 3] {
    let [first, second, third] = &setup.edges;
    let ramp = |i, edge| {
        let ramp = if cuts.smooth.contains(i) { Ramp::new(edge) } else { None };
        ramp.map(|ramp| if cuts.bare.contains(i) { ramp.bare() } else { ramp })
    };
    [ramp(1, first), ramp(2, second), ramp(0, third)]
}

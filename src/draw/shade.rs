//! From a triangle that is set up to pixels: spans, blocks of them, and the pixel loop.

use super::Frame;
use crate::depth::{DepthPlane, DepthRun, DepthTest};
use crate::fragment::{Fragment, Sample};
use crate::framebuffer::{Target, run};
use crate::interpolation::{BLOCK, Correction, Joint, Mode, Run, Varyings};
use crate::math::SMALL_CORE;
use crate::setup::{Setup, Tier};
use crate::span::Span;
use crate::traversal::{ClipWalk, Spans, edges};
use crate::vertex::Rect;
use fixed::types::I16F16;

/// What a triangle's pixels are made from, once it is set up.
pub(super) struct Shading<'a, F, const N: usize> {
    pub(super) fragment: &'a F,
    /// There unless `N` is 0.
    pub(super) varyings: Option<&'a Varyings<N>>,
    /// There where depth is kept.
    pub(super) depth: Option<&'a DepthPlane>,
}

impl<F, const N: usize> Shading<'_, F, N> {
    /// The depths of a run, where `D` keeps any.
    #[inline]
    fn depths<D: DepthTest>(&self, setup: &Setup, run: Span) -> DepthRun {
        match self.depth {
            Some(plane) if D::BITS > 0 => plane.run(setup, run),
            _ => DepthRun::NONE,
        }
    }
}

impl<C, D, W, T, I, const P: usize> Frame<C, D, W, T, I, P>
where
    C: Target,
    D: DepthTest,
    T: Tier,
    I: Correction,
{
    /// Draws what a part covers of a box.
    #[inline(never)]
    pub(super) fn draw_part<F, const N: usize>(
        &mut self,
        setup: &Setup,
        bounds: Rect,
        clip: Option<&mut ClipWalk<P>>,
        shading: &Shading<'_, F, N>,
    ) where
        F: Fragment<C::Color, N>,
    {
        if (N > 0 && shading.varyings.is_none()) || (D::BITS > 0 && shading.depth.is_none()) {
            return;
        }
        let mut edges = edges(setup, &bounds);
        for span in Spans::new(&mut edges, bounds, clip) {
            self.draw_span(setup, span, shading);
        }
    }

    /// Draws a span.
    #[inline(always)]
    pub(super) fn draw_span<F, const N: usize>(
        &mut self,
        setup: &Setup,
        span: Span,
        shading: &Shading<'_, F, N>,
    ) where
        F: Fragment<C::Color, N>,
    {
        if F::UNIFORM && !F::DISCARDS && D::BITS == 0 && N == 0 {
            self.fill(span, shading);
            return;
        }
        let length = match shading.varyings {
            Some(varyings) if varyings.mode() == Mode::Pieces => I::EVERY,
            Some(varyings) if varyings.mode() == Mode::Divided => BLOCK,
            _ => i32::MAX,
        };
        let mut joint = None;
        for block in span.blocks(length) {
            let more = block.x1 < span.x1;
            self.draw_block(setup, block, more, &mut joint, shading);
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

    /// Draws a block, with `more` of its span to follow.
    #[inline]
    fn draw_block<F, const N: usize>(
        &mut self,
        setup: &Setup,
        block: Span,
        more: bool,
        joint: &mut Joint<N>,
        shading: &Shading<'_, F, N>,
    ) where
        F: Fragment<C::Color, N>,
    {
        if D::BITS == 0 {
            self.draw_from(setup, block, DepthRun::NONE, (more, joint), shading);
            return;
        }
        let mut depth = shading.depths::<D>(setup, block);
        let inside = depth.inside;
        if !inside {
            *joint = None;
        }
        // Where some depth saturates each pixel by itself.
        let length = if inside { i32::MAX } else { 1 };
        let mut rest = block;
        loop {
            let piece = Span { x1: rest.x1.min(rest.x0.saturating_add(length)), ..rest };
            self.draw_from(setup, piece, depth, (more && inside, &mut *joint), shading);
            rest.x0 = piece.x1;
            if rest.x0 >= rest.x1 {
                break;
            }
            depth = shading.depths::<D>(setup, rest);
        }
    }

    /// Draws a block whose depths are inside of the range, by the way its varyings run.
    #[inline]
    fn draw_from<F, const N: usize>(
        &mut self,
        setup: &Setup,
        block: Span,
        depth: DepthRun,
        (more, joint): (bool, &mut Joint<N>),
        shading: &Shading<'_, F, N>,
    ) where
        F: Fragment<C::Color, N>,
    {
        match shading.varyings {
            None if N == 0 => self.draw_run(block, NoVaryings, depth, shading.fragment),
            None => {}
            Some(v) if v.mode() == Mode::Divided && I::EVERY == 1 => {
                self.draw_run(
                    block,
                    v.divided::<I::Reciprocal>(setup, block),
                    depth,
                    shading.fragment,
                );
            }
            Some(v) => {
                let ramp = v.ramp::<I>(setup, block, more, joint);
                self.draw_run(block, ramp, depth, shading.fragment);
            }
        }
    }

    /// The pixel loop: test, shade what passes, write. Not inlined, so that what leads to it shares no
    /// stack with it.
    #[inline(never)]
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
        let (mut running, step) = depth.running();
        let mut x = x0;
        let mut pixel = move |passes: bool| {
            let sample = || Sample { x, y, varyings: varyings.varyings() };
            let color = shaded::<F, _, N>(fragment, passes, sample);
            varyings.step();
            x += 1;
            color
        };
        if D::BITS == 0 {
            self.target.write(first, row, (0..length).map(|_| pixel(true)));
            return;
        }
        let (width, _) = self.target.size();
        let at = row.wrapping_mul(width as usize).wrapping_add(first);
        let target = &mut self.target;
        self.depth.run(at, length, move |depths| {
            target.write_each::<_, 1>((first, row, at), depths, |stored, _| {
                let here = running;
                running = running.wrapping_add(step);
                tested::<D, F, _, N>(here, stored, &mut pixel)
            });
        });
    }
}

/// Tests a pixel's depth, and stores it where the test passes and the fragment stays: `color` is told of the first, and has
/// none where either does not.
#[inline(always)]
pub(super) fn tested<D: DepthTest, F: Fragment<C, N>, C: Copy, const N: usize>(
    running: u32,
    stored: &mut D::Word,
    color: impl FnOnce(bool) -> Option<C>,
) -> Option<C> {
    // Before shading where that does not matter: the loops over pixels are made for it.
    if !F::DISCARDS {
        let passes = D::passes(running, stored);
        return color(passes);
    }
    let mut depth = *stored;
    let passes = D::passes(running, &mut depth);
    let color = color(passes);
    if color.is_some() {
        *stored = depth;
    }
    color
}

/// The colour of a pixel that passes, if the fragment stays.
#[inline(always)]
pub(super) fn shaded<F: Fragment<C, N>, C: Copy, const N: usize>(
    fragment: &F,
    passes: bool,
    sample: impl FnOnce() -> Sample<N>,
) -> Option<C> {
    if F::DISCARDS && passes {
        return fragment.shade_or_discard(sample());
    }
    passes.then(|| fragment.shade(sample()))
}

/// How a run's pixels get their colours.
pub(super) trait Pixels<C, F, const N: usize> {
    /// How many are drawn at a time, 1, 2 or 4: as many as there are registers for.
    const AT_ONCE: usize;

    /// The colour at this pixel, column `x` of row `y`.
    fn color(&self, fragment: &F, x: i32, y: i32) -> Option<C>;

    /// To the next pixel.
    fn step(&mut self);

    /// What its step bends by after [`BEND`](crate::framebuffer::BEND) pixels.
    #[inline]
    fn bend(&self) -> u32 {
        0
    }

    /// Bends its step.
    #[inline]
    fn bend_by(&mut self, _: u32) {}
}

impl<C: Copy, F: Fragment<C, N>, R: Run<N>, const N: usize> Pixels<C, F, N> for R {
    const AT_ONCE: usize = match N {
        0 if SMALL_CORE => 4,
        // Four take the registers of three multiples of a step.
        0 => 4,
        _ => 1,
    };

    #[inline]
    fn color(&self, fragment: &F, x: i32, y: i32) -> Option<C> {
        let sample = Sample { x, y, varyings: self.varyings() };
        if F::DISCARDS {
            return fragment.shade_or_discard(sample);
        }
        Some(fragment.shade(sample))
    }

    #[inline]
    fn step(&mut self) {
        Run::step(self);
    }
}

/// No varyings to step along.
pub(super) struct NoVaryings;

impl<const N: usize> Run<N> for NoVaryings {
    #[inline]
    fn varyings(&self) -> [I16F16; N] {
        [I16F16::ZERO; N]
    }

    #[inline]
    fn step(&mut self) {}
}

//! One colour, no depth, nothing that cuts: from corners to rows of the target, and no more.

use super::{Frame, Outcome};
use crate::fragment::{Fragment, Sample};
use crate::framebuffer::Target;
use crate::math::{SMALL_CORE, index};
use crate::setup::{Outline, Tier};
use crate::traversal::{Halves, ProjectedSide, Short, Side};
use crate::vertex::Rect;
use fixed::types::I16F16;

impl<C, D, W, T, I, const P: usize> Frame<C, D, W, T, I, P>
where
    C: Target,
    T: Tier,
{
    /// Fills a triangle that is all inside of the window.
    #[inline]
    pub(super) fn fill_inside<F, const N: usize>(
        &mut self,
        outline: &Outline,
        whole: Rect,
        fragment: &F,
    ) -> Outcome
    where
        F: Fragment<C::Color, N>,
    {
        if whole.is_empty() {
            return Outcome::OffScreen;
        }
        let color = self.uniform(whole, fragment);
        if !SMALL_CORE && Short::fits(whole) {
            self.fill_short(&outline.moved(-whole.x0, T::SUBPIXEL_BITS), whole, color);
        } else {
            self.fill_long::<ProjectedSide>(outline, whole, color);
        }
        Outcome::Drawn
    }

    /// Fills what the window has of a triangle. Not inlined, so that one that is inside has no registers for it.
    #[inline(never)]
    pub(super) fn fill_windowed<F, const N: usize>(
        &mut self,
        outline: &Outline,
        whole: Rect,
        fragment: &F,
    ) -> Outcome
    where
        F: Fragment<C::Color, N>,
    {
        self.fill_within::<ProjectedSide, F, N>(outline, whole, fragment)
    }

    /// Fills what the window has of a triangle, whose edges are followed by `S` and whose box is `whole`.
    #[inline]
    pub(super) fn fill_within<S: Side, F, const N: usize>(
        &mut self,
        outline: &Outline<S::Corner>,
        whole: Rect,
        fragment: &F,
    ) -> Outcome
    where
        F: Fragment<C::Color, N>,
    {
        let bounds = whole.intersect(self.window());
        if bounds.is_empty() {
            return Outcome::OffScreen;
        }
        let color = self.uniform(bounds, fragment);
        if bounds.x0 == whole.x0 && bounds.x1 == whole.x1 {
            self.fill_long::<S>(outline, bounds, color);
        } else {
            self.fill_clipped::<S>(outline, bounds, color);
        }
        Outcome::Drawn
    }

    /// The one colour of a fragment that has one.
    #[inline]
    fn uniform<F, const N: usize>(&self, bounds: Rect, fragment: &F) -> C::Color
    where
        F: Fragment<C::Color, N>,
    {
        let (left, top) = self.viewport.origin;
        let (x, y) = (bounds.x0 - left, bounds.y0 - top);
        fragment.shade(Sample { x, y, varyings: [I16F16::ZERO; N] })
    }

    /// Fills a small triangle that is all inside of the target.
    #[inline(always)]
    fn fill_short(&mut self, outline: &Outline, bounds: Rect, color: C::Color) {
        let bits = T::SUBPIXEL_BITS;
        let mut halves = Halves::<Short>::new(outline, bounds, bits);
        while let Some((y, mut half)) = halves.next() {
            self.target.fill_rows(index(bounds.x0), index(y), &mut half, color);
            halves.resume(half);
        }
    }

    /// Fills the rows of `bounds`, which has all columns.
    #[inline(never)]
    fn fill_long<S: Side>(&mut self, outline: &Outline<S::Corner>, bounds: Rect, color: C::Color) {
        let bits = T::SUBPIXEL_BITS;
        let mut halves = Halves::<S>::new(outline, bounds, bits);
        while let Some((y, mut half)) = halves.next() {
            self.target.fill_rows(0, index(y), &mut half, color);
            halves.resume(half);
        }
    }

    /// Fills what is inside of `bounds`.
    #[inline(always)]
    fn fill_clipped<S: Side>(
        &mut self,
        outline: &Outline<S::Corner>,
        bounds: Rect,
        color: C::Color,
    ) {
        let bits = T::SUBPIXEL_BITS;
        let mut halves = Halves::<S>::new(outline, bounds, bits);
        while let Some((y, mut half)) = halves.next() {
            let runs = half.by_ref().map(|(x0, x1)| (x0.max(bounds.x0), x1.min(bounds.x1)));
            self.target.fill_rows(0, index(y), runs, color);
            halves.resume(half);
        }
    }
}

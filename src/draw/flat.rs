//! One colour, no depth, nothing that cuts: from corners to rows of the target, and no more.

use super::{Frame, Outcome};
use crate::depth::DepthTest;
use crate::fragment::{Fragment, Sample};
use crate::framebuffer::Target;
use crate::interpolation::Correction;
use crate::math::index;
use crate::setup::{Outline, Tier};
use crate::traversal::{FilledSide, Rows, Side};
use crate::vertex::Rect;
use fixed::types::I16F16;

impl<C, D, W, T, I, const P: usize> Frame<C, D, W, T, I, P>
where
    C: Target,
    D: DepthTest,
    T: Tier,
    I: Correction,
{
    /// Fills what the window has of a triangle of projected corners.
    #[inline(always)]
    pub(super) fn fill_projected<F, const N: usize>(
        &mut self,
        outline: &Outline,
        fragment: &F,
    ) -> Outcome
    where
        F: Fragment<C::Color, N>,
    {
        let whole = outline.bounds(T::SUBPIXEL_BITS);
        if !self.is_small_inside(whole) {
            // By value, so that a small triangle has its outline in registers.
            return self.fill_any(*outline, fragment);
        }
        if whole.is_empty() {
            return Outcome::OffScreen;
        }
        let color = self.uniform(whole, fragment);
        let rows = self.small_rows(outline, whole);
        let (left, top) = self.viewport.origin;
        let (x, y) = (index(whole.x0 + left), index(whole.y0 + top));
        self.target.fill_runs(x, y, rows, color);
        Outcome::Drawn
    }

    /// [`fill_projected`](Self::fill_projected) of a triangle of any size. Not inlined, so that a small one has no registers for it.
    #[inline(never)]
    fn fill_any<F, const N: usize>(&mut self, outline: Outline, fragment: &F) -> Outcome
    where
        F: Fragment<C::Color, N>,
    {
        let whole = outline.bounds(T::SUBPIXEL_BITS);
        self.fill_within::<FilledSide, F, N>(&outline, whole, fragment)
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
        let bounds = whole.intersect(self.known_window());
        if bounds.is_empty() {
            return Outcome::OffScreen;
        }
        let color = self.uniform(bounds, fragment);
        let (left, top) = self.viewport.origin;
        let outline = &outline.moved(left, T::SUBPIXEL_BITS);
        let (start, end) = (bounds.x0 + left, bounds.x1 + left);
        let y = index(bounds.y0 + top);
        let rows = Rows::<S>::new(outline, bounds, T::SUBPIXEL_BITS);
        if bounds.x0 == whole.x0 && bounds.x1 == whole.x1 {
            self.target.fill_rows(0, y, rows, color);
        } else {
            let runs = rows.map(|(x0, x1)| (x0.max(start), x1.min(end)));
            self.target.fill_rows(0, y, runs, color);
        }
        Outcome::Drawn
    }

    /// The one colour of a fragment that has one.
    #[inline]
    fn uniform<F, const N: usize>(&self, bounds: Rect, fragment: &F) -> C::Color
    where
        F: Fragment<C::Color, N>,
    {
        fragment.shade(Sample { x: bounds.x0, y: bounds.y0, varyings: [I16F16::ZERO; N] })
    }
}

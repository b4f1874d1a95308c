//! One colour, no depth, nothing that cuts: from corners to rows of the target, and no more.

use super::Frame;
use super::shape::{Follow, Shape};
use crate::fragment::{Fragment, Sample};
use crate::framebuffer::Target;
use crate::math::index;
use crate::setup::{Outline, Tier};
use crate::traversal::{Halves, ProjectedSide, Short};
use crate::vertex::Rect;
use fixed::types::I16F16;

impl<C, D, W, T, I, const P: usize> Frame<C, D, W, T, I, P>
where
    C: Target,
    T: Tier,
{
    /// Fills a shape.
    #[inline]
    pub(super) fn fill_shape<F, const N: usize>(&mut self, shape: &Shape, fragment: &F)
    where
        F: Fragment<C::Color, N>,
    {
        let Shape { outline, bounds, follow } = shape;
        let (left, top) = self.viewport.origin;
        let (x, y) = (bounds.x0 - left, bounds.y0 - top);
        let color = fragment.shade(Sample { x, y, varyings: [I16F16::ZERO; N] });
        match follow {
            Follow::Short => self.fill_short(outline, *bounds, color),
            Follow::Whole => self.fill_long(outline, *bounds, color),
            Follow::Clipped => self.fill_clipped(outline, *bounds, color),
        }
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
    #[inline(always)]
    fn fill_long(&mut self, outline: &Outline, bounds: Rect, color: C::Color) {
        let bits = T::SUBPIXEL_BITS;
        let mut halves = Halves::<ProjectedSide>::new(outline, bounds, bits);
        while let Some((y, mut half)) = halves.next() {
            self.target.fill_rows(0, index(y), &mut half, color);
            halves.resume(half);
        }
    }

    /// Fills what is inside of `bounds`.
    #[inline(never)]
    fn fill_clipped(&mut self, outline: &Outline, bounds: Rect, color: C::Color) {
        let bits = T::SUBPIXEL_BITS;
        let mut halves = Halves::<ProjectedSide>::new(outline, bounds, bits);
        while let Some((y, mut half)) = halves.next() {
            let runs = half.by_ref().map(|(x0, x1)| (x0.max(bounds.x0), x1.min(bounds.x1)));
            self.target.fill_rows(0, index(y), runs, color);
            halves.resume(half);
        }
    }
}

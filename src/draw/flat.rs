//! One colour, no depth, nothing that cuts: from corners to rows of the target, and no more.

use super::{Frame, Outcome};
use crate::fragment::{Fragment, Sample};
use crate::framebuffer::Target;
use crate::math::index;
use crate::setup::{Outline, Tier};
use crate::traversal::{Half, halves};
use fixed::types::I16F16;

impl<C, D, W, T, I, const P: usize> Frame<C, D, W, T, I, P>
where
    C: Target,
    T: Tier,
{
    /// Fills a triangle of three projected vertices, which are clockwise on the screen or not.
    #[inline]
    pub(super) fn fill_projected<F, const N: usize>(
        &mut self,
        corners: &[[i32; 2]; 3],
        clockwise: bool,
        fragment: &F,
    ) -> Outcome
    where
        F: Fragment<C::Color, N>,
    {
        let outline = Outline::new(corners, clockwise, T::SUBPIXEL_BITS);
        let whole = outline.bounds(T::SUBPIXEL_BITS);
        let (width, height) = self.target.size();
        let visible = self.viewport.visible(width, height);
        let bounds = whole.intersect(visible);
        if bounds.is_empty() {
            return Outcome::OffScreen;
        }
        let sample = Sample { x: bounds.x0, y: bounds.y0, varyings: [I16F16::ZERO; N] };
        let color = fragment.shade(sample);
        let (left, top) = self.viewport.origin;
        let inside = bounds == whole;
        halves(&outline, bounds, left, T::SUBPIXEL_BITS, |y, half| {
            let y = index(y + top);
            if inside {
                self.fill_half(y, half, color);
            } else {
                self.fill_clipped(y, half, [bounds.x0 + left, bounds.x1 + left], color);
            }
        });
        Outcome::Drawn
    }

    /// Fills rows of which all columns are inside of the target. The half is copied, so that it is kept
    /// in registers.
    #[inline(never)]
    fn fill_half(&mut self, y: usize, half: &mut Half, color: C::Color) {
        let mut own = *half;
        self.target.fill_rows(y, own.by_ref().map(|(x0, x1)| (column(x0), column(x1))), color);
        *half = own;
    }

    /// Fills what columns `x0 .. x1` of the target show of rows.
    #[inline(never)]
    fn fill_clipped(&mut self, y: usize, half: &mut Half, [x0, x1]: [i32; 2], color: C::Color) {
        let runs = half.by_ref().map(|(from, to)| {
            let from = from.max(x0);
            (column(from), column(to.min(x1).max(from)))
        });
        self.target.fill_rows(y, runs, color);
    }
}

/// A column of the target, which the viewport has bounded; a column left of it becomes one that no
/// row has.
#[inline]
#[expect(clippy::cast_sign_loss, reason = "positive, or beyond every row's end by intent")]
const fn column(v: i32) -> usize {
    v as usize
}

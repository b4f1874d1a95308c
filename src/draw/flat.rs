//! One colour, no depth, nothing that cuts: from corners to rows of the target, and no more.

use super::{Frame, Outcome};
use crate::fragment::{Fragment, Sample};
use crate::framebuffer::Target;
use crate::math::index;
use crate::setup::{Outline, Tier, doubled_area, shows};
use crate::traversal::Rows;
use crate::vertex::Rect;
use fixed::types::I16F16;

impl<C, D, W, T, I, const P: usize> Frame<C, D, W, T, I, P>
where
    C: Target,
    T: Tier,
{
    /// Fills a triangle of three projected vertices.
    #[inline]
    pub(super) fn fill_projected<F, const N: usize>(
        &mut self,
        corners: &[[i32; 2]; 3],
        fragment: &F,
    ) -> Outcome
    where
        F: Fragment<C::Color, N>,
    {
        let area = doubled_area(corners);
        match shows(area, self.cull) {
            None => return Outcome::ZeroArea,
            Some(false) => return Outcome::Culled,
            Some(true) => {}
        }
        let outline = Outline::new(corners, area > 0, T::SUBPIXEL_BITS);
        let whole = outline.bounds(T::SUBPIXEL_BITS);
        let (width, height) = self.target.size();
        let visible = self.viewport.visible(width, height);
        let bounds = whole.intersect(visible);
        if bounds.is_empty() {
            return Outcome::OffScreen;
        }
        let sample = Sample { x: bounds.x0, y: bounds.y0, varyings: [I16F16::ZERO; N] };
        let color = fragment.shade(sample);
        if bounds == whole {
            let (left, top) = self.viewport.origin;
            let rows = Rows::new(&outline, bounds, T::SUBPIXEL_BITS);
            let runs = rows.map(|(x0, x1)| (index_of(x0 + left), index_of(x1 + left)));
            self.target.fill_rows(index(bounds.y0 + top), runs, color);
        } else {
            self.fill_clipped(&outline, bounds, color);
        }
        Outcome::Drawn
    }

    /// Fills what a box shows of a triangle.
    #[inline(never)]
    fn fill_clipped(&mut self, outline: &Outline, bounds: Rect, color: C::Color) {
        let (left, top) = self.viewport.origin;
        let rows = Rows::new(outline, bounds, T::SUBPIXEL_BITS);
        let runs = rows.map(|(x0, x1)| {
            let x0 = x0.max(bounds.x0);
            (index_of(x0 + left), index_of(x1.min(bounds.x1).max(x0) + left))
        });
        self.target.fill_rows(index(bounds.y0 + top), runs, color);
    }
}

/// A column of the target, which the viewport has bounded; a column left of it becomes one that no
/// row has.
#[inline]
#[expect(clippy::cast_sign_loss, reason = "positive, or beyond every row's end by intent")]
const fn index_of(v: i32) -> usize {
    v as usize
}

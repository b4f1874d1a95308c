//! Small triangles that are all in the window, without varyings: runs of pixels counted in the target's rows.

use super::Frame;
use super::shade::{shaded, tested};
use crate::depth::DepthTest;
use crate::fragment::{Fragment, Sample};
use crate::framebuffer::Target;
use crate::interpolation::Correction;
use crate::math::{index, signed, unsigned};
use crate::setup::{Outline, Plane, Tier};
use crate::span::Span;
use crate::traversal::{SmallRows, is_small};
use crate::vertex::Rect;
use fixed::types::I16F16;

impl<C, D, W, T, I, const P: usize> Frame<C, D, W, T, I, P>
where
    C: Target,
    D: DepthTest,
    T: Tier,
    I: Correction,
{
    /// Whether the whole of a triangle is in the window, and small. Looked at, whatever the outcodes say: the vertices may be
    /// another viewport's.
    #[inline]
    pub(super) fn is_small_inside(&self, whole: Rect) -> bool {
        self.small_window.holds(whole) && is_small(whole)
    }

    /// The rows of a small triangle in this target.
    #[inline(always)]
    pub(super) fn small_rows(&self, outline: &Outline, whole: Rect) -> SmallRows {
        let (width, _) = self.target.size();
        let outline = outline.moved(-whole.x0, T::SUBPIXEL_BITS);
        SmallRows::new(&outline, whole, T::SUBPIXEL_BITS, signed(width))
    }

    /// Draws the pixels of a small triangle without varyings that is all in the window, of which this is the box.
    #[inline(always)]
    pub(super) fn draw_small<F, const N: usize>(
        &mut self,
        edges: SmallRows,
        whole: Rect,
        depth: Plane,
        fragment: &F,
    ) where
        F: Fragment<C::Color, N>,
    {
        let (left, top) = self.viewport.origin;
        let (width, _) = self.target.size();
        let (x, y) = (index(whole.x0 + left), index(whole.y0 + top));
        let at = y.wrapping_mul(width as usize).wrapping_add(x);
        let fragment = *fragment;
        // Of pixel 0 of the rows.
        let mut z = depth.at(whole.x0, whole.y0);
        let down = depth.y.wrapping_sub(depth.x.wrapping_mul(width));
        let (mut row, mut column) = (whole.y0, whole.x0);
        let target = &mut self.target;
        self.depth.from(at, move |depths| {
            target.write_runs((x, y, at), depths, edges, move |i0, i1| {
                let span = Span { y: row, x0: column + i0, x1: column + i1 };
                let mut z_here = z.wrapping_add(depth.x.wrapping_mul(unsigned(i0)));
                row += 1;
                column -= signed(width);
                z = z.wrapping_add(down);
                let mut x = span.x0;
                move |stored: &mut D::Word| {
                    tested::<D, F, _, N>(z_here, stored, |passes| {
                        z_here = z_here.wrapping_add(depth.x);
                        let sample = || Sample { x, y: span.y, varyings: [I16F16::ZERO; N] };
                        let color = shaded::<F, _, N>(&fragment, passes, sample);
                        x += 1;
                        color
                    })
                }
            });
        });
    }
}

//! Tiny triangles with depth that are all in the window, without varyings: pixel by pixel of their boxes.

use super::shade::{shaded, tested};
use super::{Frame, Outcome};
use crate::depth::{DepthTest, ranged};
use crate::fragment::{Fragment, Sample};
use crate::framebuffer::Target;
use crate::interpolation::Correction;
use crate::math::index;
use crate::setup::{Tier, Tiny, bounds_of};
use crate::traversal::Scan;
use crate::vertex::Vertex;
use fixed::types::I16F16;

impl<C, D, W, T, I, const P: usize> Frame<C, D, W, T, I, P>
where
    C: Target,
    D: DepthTest,
    T: Tier,
    I: Correction,
{
    /// Draws a triangle of projected vertices with a tiny triangle's area, which faces a way that is drawn; `None` where it
    /// is too long, or not all in the window.
    ///
    /// Not inlined: any other triangle has more registers without it.
    #[inline(never)]
    pub(super) fn draw_tiny<F, const N: usize>(
        &mut self,
        a: &Vertex<T, N, P>,
        b: &Vertex<T, N, P>,
        c: &Vertex<T, N, P>,
        fragment: &F,
    ) -> Option<Outcome>
    where
        F: Fragment<C::Color, N>,
    {
        let vertices = [a, b, c];
        let corners = T::corners(vertices.map(|v| &v.position));
        let whole = bounds_of(&corners, T::SUBPIXEL_BITS);
        // Looked at, whatever the outcodes say: the vertices may be another viewport's.
        if !Tiny::is_within(whole) || !self.known_window().holds(whole) {
            return None;
        }
        if whole.is_empty() {
            return Some(Outcome::OffScreen);
        }
        let (left, top) = self.viewport.origin;
        let (width, _) = self.target.size();
        let (x, y) = (index(whole.x0 + left), index(whole.y0 + top));
        let at = y.wrapping_mul(width as usize).wrapping_add(x);
        let tiny = Tiny::new(&corners, whole, T::SUBPIXEL_BITS)?;
        let (value, differences) = ranged(vertices);
        let plane = tiny.plane(value, differences);
        let size = [whole.x1 - whole.x0, whole.y1 - whole.y0];
        let scan = Scan::new(tiny.edges(), plane, size, at, width as usize);
        let fragment = *fragment;
        let target = &mut self.target;
        self.depth.all(move |depths| {
            target.write_scan((x, y), depths, scan, |stored, scan| {
                let (column, row) = scan.place();
                let (x, y) = (whole.x0 + column, whole.y0 + row);
                let sample = Sample { x, y, varyings: [I16F16::ZERO; N] };
                tested::<D, F, _, N>(scan.value(), stored, |passes| {
                    shaded::<F, _, N>(&fragment, passes, || sample)
                })
            });
        });
        Some(Outcome::Drawn)
    }
}

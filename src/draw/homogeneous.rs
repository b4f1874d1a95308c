//! Triangles on the exact tier's grid: what is decided before anything is made of them, and those that are on the screen.

use super::divided::Separate;
use super::lanes::Lanes;
use super::projected::{Begins, Deep};
use super::shade::NoVaryings;
use super::shape::Shape;
use super::{Frame, Outcome};
use crate::depth::DepthTest;
use crate::fragment::Fragment;
use crate::framebuffer::Target;
use crate::interpolation::{Correction, Interpolates, Level, Slope, Width, same_w};
use crate::setup::{Anchored, Facing, Slopes, Tier, determinant, outline};
use crate::traversal::Stepped;
use crate::vertex::{Outside, Vertex};

impl<C, D, W, T, I, const P: usize> Frame<C, D, W, T, I, P>
where
    C: Target,
    D: DepthTest,
    T: Tier,
    I: Correction,
{
    /// Draws a triangle on the exact tier's grid that is on the screen and that no plane cuts; `None` where it is not
    /// one, or has to be drawn as any other.
    #[inline(never)]
    pub(super) fn draw_homogeneous<F, const N: usize>(
        &mut self,
        vertices: [&Vertex<T, N, P>; 3],
        outside: Outside,
        fragment: &F,
    ) -> Option<Outcome>
    where
        F: Fragment<C::Color, N>,
        W: Interpolates<N>,
    {
        let positions = T::homogeneous(vertices.map(|v| &v.position))?;
        // Before anything is made of them: half of a mesh's triangles look away.
        let determinant = determinant(positions);
        let facing = Facing::of(determinant);
        if let Some(outcome) = self.turned_away(facing) {
            return Some(outcome);
        }
        if self.cuts::<N>(outside) || outside.0 & (Outside::HITHER | Outside::SIDES) != 0 {
            return None;
        }
        let [a, b, c] = vertices.map(|v| v.outside.0);
        if D::BITS > 16 || (D::BITS > 0 && a & b & c & Outside::RANGED == 0) {
            return None;
        }
        let outline = outline(positions, facing?, &self.viewport)?;
        if F::UNIFORM && !F::DISCARDS && D::BITS == 0 && N == 0 {
            let whole = outline.bounds();
            return Some(self.fill_within::<Stepped, F, N>(&outline, whole, fragment));
        }
        let level = I::AFFINE || same_w(vertices);
        if N > 0 && (I::WIDTH == Width::Long || (!level && I::EVERY > 1)) {
            return None;
        }
        let whole = outline.bounds();
        let bounds = whole.intersect(self.known_window());
        if bounds.is_empty() {
            return Some(Outcome::OffScreen);
        }
        let slopes = Slopes::homogeneous(positions, determinant, &whole, &self.viewport)?;
        let depth = self.depth_plane(&slopes, vertices);
        let shape = Deep { shape: Shape { outline, bounds, short: false }, depth };
        if N == 0 {
            self.draw_edges::<Stepped, _, _, N>(&shape, &NoVaryings, fragment);
        } else if level {
            self.draw_level(&shape, &slopes, vertices, fragment)?;
        } else {
            self.draw_divided::<Stepped, _, N>(&shape, &slopes, vertices, fragment)?;
        }
        Some(Outcome::Drawn)
    }

    /// Draws a shape whose varyings are linear on the screen.
    #[inline]
    fn draw_level<F, const N: usize>(
        &mut self,
        shape: &Deep<Anchored>,
        slopes: &Slopes,
        vertices: [&Vertex<T, N, P>; 3],
        fragment: &F,
    ) -> Option<()>
    where
        F: Fragment<C::Color, N>,
    {
        if let Some(lanes) = Lanes::<C::Color, F, N>::new(slopes, vertices) {
            self.draw_edges::<Stepped, _, _, N>(shape, &Separate(lanes), fragment);
        } else {
            let level = Level::new(slopes, vertices)?;
            self.draw_edges::<Stepped, _, _, N>(shape, &&level, fragment);
        }
        Some(())
    }
}

impl<'a, const N: usize> Begins<N> for &'a Level<N> {
    type Block = Slope<'a, N>;

    #[inline]
    fn begin(&self, x: i32, y: i32) -> Slope<'a, N> {
        self.from(x, y)
    }
}

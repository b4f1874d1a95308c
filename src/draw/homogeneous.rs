//! Triangles on the exact tier's grid: what is decided before anything is made of them, and those that are on the screen.

use super::{Frame, Outcome};
use crate::depth::DepthTest;
use crate::fragment::Fragment;
use crate::framebuffer::Target;
use crate::interpolation::{Correction, Interpolates};
use crate::setup::{Facing, Tier, determinant, outline};
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
    #[inline]
    pub(super) fn draw_homogeneous<F, const N: usize>(
        &mut self,
        vertices: [&Vertex<T, N, P>; 3],
        cut: bool,
        fragment: &F,
    ) -> Option<Outcome>
    where
        F: Fragment<C::Color, N>,
        W: Interpolates<N>,
    {
        let positions = T::homogeneous(vertices.map(|v| &v.position))?;
        // Before anything is made of them: half of a mesh's triangles look away.
        let determinant = determinant(positions);
        let Some(facing) = Facing::of(determinant) else {
            return Some(Outcome::ZeroArea);
        };
        if self.cull.hides(facing) {
            return Some(Outcome::Culled);
        }
        let [a, b, c] = vertices.map(|v| v.outside.0);
        if cut || (a | b | c) & (Outside::HITHER | Outside::SIDES) != 0 {
            return None;
        }
        if F::UNIFORM && D::BITS == 0 && N == 0 {
            let outline = outline(positions, facing, &self.viewport)?;
            return Some(self.fill_homogeneous(&outline, fragment));
        }
        None
    }
}

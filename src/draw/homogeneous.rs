//! Triangles on the exact tier's grid: what is decided before anything is made of them, and those that are on the screen.

use super::lanes::{Channels, Divided, Lanes};
use super::projected::{Deep, Rows};
use super::shade::NoVaryings;
use super::shape::Shape;
use super::{Frame, Outcome};
use crate::depth::{DepthTest, projected};
use crate::fragment::Fragment;
use crate::framebuffer::Target;
use crate::interpolation::{Correction, Followed, Interpolates, Level, Quotients, Slope, same_w};
use crate::setup::{Facing, Plane, Slopes, Tier, determinant, outline};
use crate::span::Span;
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
        let Some(facing) = Facing::of(determinant) else {
            return Some(Outcome::ZeroArea);
        };
        if self.cull.hides(facing) {
            return Some(Outcome::Culled);
        }
        let [a, b, c] = vertices.map(|v| v.outside.0);
        if self.cuts::<N>(outside) || outside.0 & (Outside::HITHER | Outside::SIDES) != 0 {
            return None;
        }
        let outline = outline(positions, facing, &self.viewport)?;
        if F::UNIFORM && D::BITS == 0 && N == 0 {
            return Some(self.fill_homogeneous(&outline, fragment));
        }
        let level = I::AFFINE || same_w(vertices);
        if N > 0 && !level && I::EVERY > 1 {
            return None;
        }
        if D::BITS > 16 || (D::BITS > 0 && a & b & c & Outside::RANGED == 0) {
            return None;
        }
        let whole = outline.bounds();
        let bounds = whole.intersect(self.window());
        if bounds.is_empty() {
            return Some(Outcome::OffScreen);
        }
        let slopes = Slopes::homogeneous(positions, determinant, &whole, &self.viewport)?;
        let depth = if D::BITS > 0 { projected(&slopes, vertices) } else { Plane::default() };
        let shape = Deep { shape: Shape { outline, bounds, short: false }, depth };
        if N == 0 {
            self.draw_halves::<Stepped, _, _, N>(&shape, &NoVaryings, fragment);
        } else if level {
            if let Some(lanes) = F::LANES.and_then(|lanes| Lanes::new(&slopes, vertices, lanes)) {
                let channels = Separate(lanes);
                self.draw_halves::<Stepped, _, _, N>(&shape, &channels, fragment);
                return Some(Outcome::Drawn);
            }
            let level = Level::new(&slopes, vertices)?;
            self.draw_halves::<Stepped, _, _, N>(&shape, &Undivided(&level), fragment);
        } else {
            if let Some(lanes) = F::LANES {
                let channels = Quotients::channels(&slopes, vertices, lanes);
                if let Some(channels) = channels {
                    self.draw_halves::<Stepped, _, _, N>(&shape, &EachChannel(&channels), fragment);
                    return Some(Outcome::Drawn);
                }
            }
            let quotients = Quotients::new(&slopes, vertices)?;
            self.draw_halves::<Stepped, _, _, N>(&shape, &Each(&quotients), fragment);
        }
        Some(Outcome::Drawn)
    }
}

/// Lanes as channels, each by itself.
struct Separate<const N: usize>(Lanes<N>);

impl<const N: usize> Rows<N> for Separate<N> {
    type Block = Channels<N>;
    type Joint = ();

    #[inline]
    fn joint(&self, _: Span) {}

    #[inline]
    fn block(&self, span: Span, (): &mut ()) -> (Channels<N>, i32) {
        (self.0.channels(span.x0, span.y), span.x1 - span.x0)
    }
}

/// Varyings that are linear on the screen.
struct Undivided<'a, const N: usize>(&'a Level<N>);

impl<'a, const N: usize> Rows<N> for Undivided<'a, N> {
    type Block = Slope<'a, N>;
    type Joint = ();

    #[inline]
    fn joint(&self, _: Span) {}

    #[inline]
    fn block(&self, span: Span, (): &mut ()) -> (Slope<'a, N>, i32) {
        (self.0.from(span.x0, span.y), span.x1 - span.x0)
    }
}

/// Varyings divided at each pixel.
struct Each<'a, const N: usize>(&'a Quotients<N>);

impl<'a, const N: usize> Rows<N> for Each<'a, N> {
    type Block = Followed<'a, N>;
    type Joint = ();

    #[inline]
    fn joint(&self, _: Span) {}

    #[inline]
    fn block(&self, span: Span, (): &mut ()) -> (Followed<'a, N>, i32) {
        (self.0.from(span.x0, span.y), span.x1 - span.x0)
    }
}

/// Channels divided at each pixel.
struct EachChannel<'a, const N: usize>(&'a Quotients<N>);

impl<'a, const N: usize> Rows<N> for EachChannel<'a, N> {
    type Block = Divided<'a, N>;
    type Joint = ();

    #[inline]
    fn joint(&self, _: Span) {}

    #[inline]
    fn block(&self, span: Span, (): &mut ()) -> (Divided<'a, N>, i32) {
        (Divided(self.0.from(span.x0, span.y)), span.x1 - span.x0)
    }
}

//! Varyings that are divided at each pixel, and channels of colours, each by itself.

use super::Frame;
use super::lanes::{Channels, Divided, Lanes};
use super::projected::{Begins, Deep};
use crate::depth::DepthTest;
use crate::fragment::Fragment;
use crate::framebuffer::Target;
use crate::interpolation::{Correction, Followed, Quotients, Reciprocal};
use crate::setup::{Slopes, Tier};
use crate::traversal::Side;
use crate::vertex::Vertex;

impl<C, D, W, T, I, const P: usize> Frame<C, D, W, T, I, P>
where
    C: Target,
    D: DepthTest,
    T: Tier,
    I: Correction,
{
    /// Draws a shape whose varyings are divided at each pixel.
    #[inline]
    pub(super) fn draw_divided<S, F, const N: usize>(
        &mut self,
        shape: &Deep<S::Corner>,
        slopes: &Slopes,
        vertices: [&Vertex<T, N, P>; 3],
        fragment: &F,
    ) -> Option<()>
    where
        S: Side,
        F: Fragment<C::Color, N>,
    {
        // A short reciprocal is off by more than dithered channels have room for.
        let channels = F::LANES
            .filter(|_| !(F::DITHERED && I::Reciprocal::IS_SHORT))
            .and_then(|lanes| Quotients::<I::Reciprocal, N>::channels(slopes, vertices, lanes));
        if let Some(channels) = channels {
            self.draw_edges::<S, _, _, N>(shape, &EachChannel(&channels), fragment);
        } else {
            let quotients = Quotients::<I::Reciprocal, N>::new(slopes, vertices)?;
            self.draw_edges::<S, _, _, N>(shape, &&quotients, fragment);
        }
        Some(())
    }
}

/// Lanes as channels, each by itself.
pub(super) struct Separate<C, F, const N: usize>(pub(super) Lanes<C, F, N>);

impl<C: Copy, F: Fragment<C, N>, const N: usize> Begins<N> for Separate<C, F, N> {
    type Block = Channels<N>;

    #[inline]
    fn begin(&self, x: i32, y: i32) -> Channels<N> {
        self.0.channels(x, y)
    }
}

impl<'a, R: Reciprocal, const N: usize> Begins<N> for &'a Quotients<R, N> {
    type Block = Followed<'a, R, N>;

    #[inline]
    fn begin(&self, x: i32, y: i32) -> Followed<'a, R, N> {
        self.from(x, y)
    }
}

/// Channels divided at each pixel.
struct EachChannel<'a, R, const N: usize>(&'a Quotients<R, N>);

impl<'a, R: Reciprocal, const N: usize> Begins<N> for EachChannel<'a, R, N> {
    type Block = Divided<'a, R, N>;

    #[inline]
    fn begin(&self, x: i32, y: i32) -> Divided<'a, R, N> {
        Divided(self.0.from(x, y))
    }
}

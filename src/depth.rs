//! Depth: `z / w`, 0 on the hither plane and 1 at far, stored in 16 or 32 bits.
//!
//! `z / w` is linear on the screen: `sum(k_i z_i E_i) / D`, set up from `[k_i z_i]` (Olano & Greer
//! 1997, section 4). The running value is 32 bits, `(z / w)(2^N - 1) 2^(32 - N)`; its top `N` bits
//! are stored, rounded.

mod line;
mod plane;
mod test_only;

pub use test_only::TestOnly;

pub use line::DepthBias;
pub(crate) use line::{DepthLine, ProjectedDepths};
pub(crate) use plane::{DepthPlane, DepthRun, limits, projected, ranged};

use crate::buffer::BufferSize;
use bytemuck::Pod;
use core::marker::PhantomData;

/// A stored depth: `u16` or `u32`, the whole range of the word from 0 (hither) to its maximum
/// (far).
pub trait DepthWord: Pod + Ord + Send + core::fmt::Debug {
    /// Bits of the word.
    #[doc(hidden)]
    const BITS: u32;
    /// The farthest depth, what a cleared buffer holds.
    const FAR: Self;
    /// The top bits of a running value.
    #[doc(hidden)]
    fn from_running(running: u32) -> Self;
}

impl DepthWord for u16 {
    const BITS: u32 = 16;
    const FAR: Self = Self::MAX;

    #[inline]
    fn from_running(running: u32) -> Self {
        (running >> 16) as Self
    }
}

impl DepthWord for u32 {
    const BITS: Self = 32;
    const FAR: Self = Self::MAX;

    #[inline]
    fn from_running(running: u32) -> Self {
        running
    }
}

/// Which fragments pass the depth test, as a type: [`Less`] or [`Always`].
pub trait Compare: Copy + Default + core::fmt::Debug {
    /// Whether a new depth replaces the stored one.
    fn passes<W: DepthWord>(new: W, stored: W) -> bool;
}

/// Nearer passes: hidden surfaces are removed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Less;

/// Everything passes: depth is only recorded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Always;

impl Compare for Less {
    #[inline]
    fn passes<W: DepthWord>(new: W, stored: W) -> bool {
        new < stored
    }
}

impl Compare for Always {
    #[inline]
    fn passes<W: DepthWord>(_new: W, _stored: W) -> bool {
        true
    }
}

/// Where depth is kept, or not: [`NoDepth`] or [`DepthBuffer`].
pub trait DepthTest: core::fmt::Debug {
    /// Bits of a stored depth; 0 where there is none.
    #[doc(hidden)]
    const BITS: u32;

    /// What is stored a pixel.
    #[doc(hidden)]
    type Word: DepthWord;

    /// Hands `draw` the stored depths of `length` pixels from the `at`th of the buffer, row by row, which has them; none
    /// where there is no depth. Not returned: whether there are some would be looked at twice.
    #[doc(hidden)]
    fn run(&mut self, at: usize, length: usize, draw: impl FnOnce(&mut [Self::Word]));

    /// The same of all depths from the `at`th on.
    #[doc(hidden)]
    fn from(&mut self, at: usize, draw: impl FnOnce(&mut [Self::Word]));

    /// The same of all depths.
    #[doc(hidden)]
    fn all(&mut self, draw: impl FnOnce(&mut [Self::Word]));

    /// Whether it serves a target of this size.
    #[doc(hidden)]
    fn fits(&self, target: (u32, u32)) -> bool;

    /// Tests a running value against a stored depth, and stores it where it passes.
    #[doc(hidden)]
    fn passes(running: u32, stored: &mut Self::Word) -> bool;

    /// Sets everything to the farthest depth.
    fn clear(&mut self);
}

/// No depth: every fragment is drawn, and nothing is spent on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NoDepth;

impl DepthTest for NoDepth {
    const BITS: u32 = 0;
    type Word = u16;

    #[inline]
    fn run(&mut self, _: usize, _: usize, _: impl FnOnce(&mut [u16])) {}

    #[inline]
    fn from(&mut self, _: usize, _: impl FnOnce(&mut [u16])) {}

    #[inline]
    fn all(&mut self, _: impl FnOnce(&mut [u16])) {}

    #[inline]
    fn fits(&self, _: (u32, u32)) -> bool {
        true
    }

    #[inline]
    fn passes(_: u32, _: &mut u16) -> bool {
        true
    }

    #[inline]
    fn clear(&mut self) {}
}

/// A depth buffer in words the caller lends.
#[derive(Debug)]
pub struct DepthBuffer<'a, W: DepthWord = u16, C: Compare = Less> {
    words: &'a mut [W],
    width: u32,
    height: u32,
    compare: PhantomData<C>,
}

impl<'a, W: DepthWord> DepthBuffer<'a, W> {
    /// A `width x height` buffer, nearer passing, over the first `width * height` words. They keep
    /// what they hold; see [`Frame::clear`](crate::Frame::clear).
    ///
    /// # Errors
    ///
    /// [`BufferSize`] where a side is 0 or there are fewer words.
    pub fn try_new(words: &'a mut [W], width: u32, height: u32) -> Result<Self, BufferSize> {
        BufferSize::check(width, height, words.len())?;
        Ok(Self { words, width, height, compare: PhantomData })
    }
}

impl<'a, W: DepthWord, C: Compare> DepthBuffer<'a, W, C> {
    /// The same with another comparison.
    #[must_use]
    pub fn with_compare<D: Compare>(self, _compare: D) -> DepthBuffer<'a, W, D> {
        let Self { words, width, height, .. } = self;
        DepthBuffer { words, width, height, compare: PhantomData }
    }

    /// Width and height in pixels.
    #[must_use]
    pub(crate) const fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// The stored words, row by row from the top.
    #[must_use]
    pub fn words(&self) -> &[W] {
        self.words
    }

    /// The buffer back.
    #[must_use]
    pub fn into_words(self) -> &'a mut [W] {
        self.words
    }
}

impl<W: DepthWord, C: Compare> DepthTest for DepthBuffer<'_, W, C> {
    const BITS: u32 = W::BITS;
    type Word = W;

    #[inline]
    fn run(&mut self, at: usize, length: usize, draw: impl FnOnce(&mut [W])) {
        if let Some(run) = self.words.get_mut(at..at.wrapping_add(length)) {
            draw(run);
        }
    }

    #[inline]
    fn from(&mut self, at: usize, draw: impl FnOnce(&mut [W])) {
        if let Some(rest) = self.words.get_mut(at..) {
            draw(rest);
        }
    }

    #[inline(always)]
    fn all(&mut self, draw: impl FnOnce(&mut [W])) {
        draw(self.words);
    }

    #[inline]
    fn fits(&self, target: (u32, u32)) -> bool {
        self.size() == target
    }

    #[inline]
    fn passes(running: u32, stored: &mut W) -> bool {
        let depth = W::from_running(running);
        let passes = C::passes(depth, *stored);
        if passes {
            *stored = depth;
        }
        passes
    }

    fn clear(&mut self) {
        self.words.fill(W::FAR);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    /// Tests a run of pixels.
    fn test<D: DepthTest>(
        buffer: &mut D,
        (x, y): (i32, i32),
        length: i32,
        running: u32,
        step: u32,
    ) -> Vec<bool> {
        let runs = (0..).map(|i: u32| running.wrapping_add(i.wrapping_mul(step)));
        let mut passed = Vec::new();
        buffer.run((2 * y + x) as usize, length as usize, |run| {
            passed = run.iter_mut().zip(runs).map(|(d, r)| D::passes(r, d)).collect();
        });
        passed
    }

    #[test]
    fn nearer_passes_and_is_stored() {
        let mut words = [100u16, 100, 100, 100, 7];
        let mut buffer = DepthBuffer::try_new(&mut words, 2, 2).unwrap();
        assert_eq!(test(&mut buffer, (0, 1), 2, 99 << 16, 1 << 16), [true, false]);
        assert_eq!(buffer.into_words(), [100, 100, 99, 100, 7]);
    }

    #[test]
    fn always_stores_the_farthest_too() {
        let mut words = [u32::FAR; 4];
        let mut buffer = DepthBuffer::try_new(&mut words, 2, 2).unwrap().with_compare(Always);
        assert_eq!(test(&mut buffer, (1, 0), 2, u32::MAX, 0), [true, true]);
    }

    #[test]
    fn outside_of_the_buffer_nothing_is_touched() {
        let mut words = [9u16; 4];
        let mut buffer = DepthBuffer::try_new(&mut words, 2, 2).unwrap();
        assert_eq!(test(&mut buffer, (0, 2), 2, 0, 0), []);
        assert_eq!(test(&mut buffer, (-1, 0), 2, 0, 0), []);
        buffer.clear();
        assert_eq!(words, [u16::MAX; 4]);
    }
}

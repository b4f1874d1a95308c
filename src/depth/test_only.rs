//! Depth that is looked at through something else: borrowed, and without being stored.

use super::DepthTest;

/// The same depth, for a while.
impl<D: DepthTest> DepthTest for &mut D {
    const BITS: u32 = D::BITS;
    type Word = D::Word;

    #[inline]
    fn run(&mut self, at: usize, length: usize, draw: impl FnOnce(&mut [D::Word])) {
        D::run(self, at, length, draw);
    }

    #[inline]
    fn from(&mut self, at: usize, draw: impl FnOnce(&mut [D::Word])) {
        D::from(self, at, draw);
    }

    #[inline(always)]
    fn all(&mut self, draw: impl FnOnce(&mut [D::Word])) {
        D::all(self, draw);
    }

    #[inline]
    fn fits(&self, target: (u32, u32)) -> bool {
        D::fits(self, target)
    }

    #[inline]
    fn passes(running: u32, stored: &mut D::Word) -> bool {
        D::passes(running, stored)
    }

    fn clear(&mut self) {
        D::clear(self);
    }
}

/// Depth that is tested and not stored, as translucent surfaces want it: what is behind an opaque one is hidden, and they
/// hide nothing themselves. See [`Frame::blended`](crate::Frame::blended).
///
/// Clearing it clears the depth below.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TestOnly<D>(pub D);

impl<D: DepthTest> DepthTest for TestOnly<D> {
    const BITS: u32 = D::BITS;
    type Word = D::Word;

    #[inline]
    fn run(&mut self, at: usize, length: usize, draw: impl FnOnce(&mut [D::Word])) {
        self.0.run(at, length, draw);
    }

    #[inline]
    fn from(&mut self, at: usize, draw: impl FnOnce(&mut [D::Word])) {
        self.0.from(at, draw);
    }

    #[inline(always)]
    fn all(&mut self, draw: impl FnOnce(&mut [D::Word])) {
        self.0.all(draw);
    }

    #[inline]
    fn fits(&self, target: (u32, u32)) -> bool {
        self.0.fits(target)
    }

    #[inline]
    fn passes(running: u32, stored: &mut D::Word) -> bool {
        // Stored where nobody looks.
        let mut depth = *stored;
        D::passes(running, &mut depth)
    }

    fn clear(&mut self) {
        self.0.clear();
    }
}

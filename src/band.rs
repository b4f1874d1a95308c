//! Bands: a picture drawn a few rows at a time, through buffers that are sent while the next is
//! drawn.
//!
//! A band is the whole viewport with its origin moved up, over a buffer of a few rows: the same
//! code and the same bits as a full frame. How high it is follows from the buffer that is lent, so
//! a band is never larger than its buffer, nor than the picture; the last one takes the rows that
//! are left.
//!
//! A buffer that is being sent belongs to the transfer, which took it by value: nothing can draw
//! into it before it comes back.

mod chain;

pub use chain::{FrameError, SwapChain, Transfer};

use crate::buffer::BufferSize;
use crate::color::PixelFormat;
use crate::framebuffer::Framebuffer;
use crate::vertex::Viewport;

/// Rows of a picture that are drawn and sent together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Band {
    viewport: Viewport,
    y: u32,
    rows: u32,
}

impl Band {
    /// The first row, in the picture's pixels.
    #[must_use]
    pub const fn y(&self) -> u32 {
        self.y
    }

    /// Pixels of a row: the picture's width.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.viewport.width()
    }

    /// How many rows.
    #[must_use]
    pub const fn rows(&self) -> u32 {
        self.rows
    }

    /// Pixels, and words that they take: those that are to be sent.
    #[must_use]
    pub const fn pixels(&self) -> usize {
        self.viewport.width() as usize * self.rows as usize
    }

    /// The picture's viewport, for a target of these rows:
    /// [`Frame::with_viewport`](crate::Frame::with_viewport).
    #[must_use]
    pub const fn viewport(&self) -> Viewport {
        self.viewport
    }

    /// A framebuffer of these rows over the first [`pixels`](Self::pixels) of `words`.
    ///
    /// # Errors
    ///
    /// [`BufferSize`] where there are fewer words.
    pub fn framebuffer<'a, F: PixelFormat>(
        &self,
        words: &'a mut [F::Word],
    ) -> Result<Framebuffer<'a, F>, BufferSize> {
        Framebuffer::try_new(words, self.viewport.width(), self.rows)
    }
}

/// The bands of a picture, from the top.
#[derive(Clone, Debug)]
pub struct Bands {
    viewport: Viewport,
    /// Rows of all bands but the last; at least 1.
    rows: u32,
    y: u32,
}

impl Viewport {
    /// The bands that a buffer of `words` words cuts the picture into: as many whole rows as fit,
    /// all of them in one band if they do, and what is left over in the last. The origin becomes
    /// the band's; the scissor stays.
    ///
    /// ```
    /// # use hither::Viewport;
    /// let bands = Viewport::new(240, 100)?.bands(240 * 32 + 7)?;
    /// let rows: Vec<_> = bands.map(|band| (band.y(), band.rows())).collect();
    /// assert_eq!(rows, [(0, 32), (32, 32), (64, 32), (96, 4)]);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`BufferSize`] where the words do not hold one row.
    #[expect(clippy::cast_possible_truncation, reason = "at most the viewport's height")]
    pub fn bands(&self, words: usize) -> Result<Bands, BufferSize> {
        let width = self.width();
        BufferSize::check(width, 1, words)?;
        let rows = (words / width as usize).min(self.height() as usize);
        Ok(Bands { viewport: *self, rows: rows as u32, y: 0 })
    }
}

impl Iterator for Bands {
    type Item = Band;

    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "a row of at most Viewport::MAX_SIDE")]
    fn next(&mut self) -> Option<Band> {
        let y = self.y;
        let rows = self.rows.min(self.viewport.height() - y);
        self.y = y + rows;
        let viewport = self.viewport.with_origin(0, -(y as i16));
        (rows > 0).then_some(Band { viewport, y, rows })
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = (self.viewport.height() - self.y).div_ceil(self.rows) as usize;
        (left, Some(left))
    }
}

impl ExactSizeIterator for Bands {}
impl core::iter::FusedIterator for Bands {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bands_that_are_left_are_counted() {
        let mut bands = Viewport::new(10, 48).unwrap().bands(70).unwrap();
        for left in (0..7).rev() {
            assert!(bands.next().is_some());
            assert_eq!(bands.len(), left);
        }
        assert_eq!((bands.next(), bands.next()), (None, None));
    }
}

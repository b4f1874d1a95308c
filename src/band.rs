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

/// What sends bands to a display: a DMA engine, or a driver that blocks.
///
/// It takes a buffer by value when a transfer starts, and gives it back when that is done, so that
/// a buffer in flight cannot be drawn into. At most one is in flight.
///
/// A chain may be dropped or forgotten while one is. A DMA engine that goes on by itself needs buffers
/// that live for ever, such as `&'static mut` ones.
pub trait Transfer {
    /// A word a pixel.
    type Word;
    /// A buffer of words, such as `&'static mut [u16]`.
    type Buffer: AsMut<[Self::Word]>;
    /// The display's or the bus' own error; it is passed through.
    type Error;

    /// Starts to send the first [`Band::pixels`] words of a buffer to the rows of a band. None is
    /// in flight. What blocks returns when all is sent. Where a display is smaller than the picture, it is
    /// the transfer that leaves out what is outside, or says so by an error.
    ///
    /// # Errors
    ///
    /// The display's own. The buffer is not lost: [`finish`](Self::finish) still gives it back.
    fn start(&mut self, band: &Band, buffer: Self::Buffer) -> Result<(), Self::Error>;

    /// Waits until the last word has been taken by the display, and gives the buffer back; `None`
    /// where none was in flight.
    ///
    /// # Errors
    ///
    /// The display's own. The buffer is not lost: the next call gives it back, or fails as well.
    fn finish(&mut self) -> Result<Option<Self::Buffer>, Self::Error>;
}

/// Buffers that take turns: one is drawn into while the other is sent (double buffering). With one
/// buffer, drawing waits for the transfer.
///
/// ```
/// use hither::{Band, Flat, Frame, I16F16, Rgb565, SwapChain, Target, Transfer, Viewport};
///
/// /// A display that takes words at once.
/// struct Display(Vec<u16>, Option<Vec<u16>>);
///
/// impl Transfer for Display {
///     type Word = u16;
///     type Buffer = Vec<u16>;
///     type Error = core::convert::Infallible;
///
///     fn start(&mut self, band: &Band, buffer: Vec<u16>) -> Result<(), Self::Error> {
///         self.0.extend(&buffer[..band.pixels()]);
///         self.1 = Some(buffer);
///         Ok(())
///     }
///
///     fn finish(&mut self) -> Result<Option<Vec<u16>>, Self::Error> {
///         Ok(self.1.take())
///     }
/// }
///
/// let display = Display(Vec::new(), None);
/// let mut chain = SwapChain::new(display, vec![0; 64 * 10], Some(vec![0; 64 * 10]));
/// let picture = Viewport::new(64, 48)?;
/// chain.frame(&picture, |band, words| {
///     let target = band.framebuffer::<Rgb565>(words).expect("it holds the band");
///     let mut frame = Frame::with_viewport(target, band.viewport());
///     frame.clear(Rgb565::new(band.y() as u8 / 10, 0, 0));
/// })?;
/// assert_eq!(chain.transfer().0.len(), 64 * 48);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct SwapChain<T: Transfer> {
    transfer: T,
    idle: [Option<T::Buffer>; 2],
}

/// Why a frame was not sent whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum FrameError<E> {
    /// A buffer does not hold one row.
    Buffer(BufferSize),
    /// The transfer did not give a buffer back, and there is no other.
    Lost,
    /// The display's own error.
    Display(E),
}

impl<E: core::fmt::Display> core::fmt::Display for FrameError<E> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Buffer(size) => write!(f, "a band: {size}"),
            Self::Lost => f.write_str("the transfer did not give the buffer back"),
            Self::Display(error) => error.fmt(f),
        }
    }
}

impl<E: core::error::Error> core::error::Error for FrameError<E> {}

impl<T: Transfer> SwapChain<T> {
    /// A chain of one buffer or two, which should be the same size: the smaller one decides how
    /// high bands are.
    pub const fn new(transfer: T, first: T::Buffer, second: Option<T::Buffer>) -> Self {
        Self { transfer, idle: [Some(first), second] }
    }

    /// What sends the bands.
    #[must_use]
    pub const fn transfer(&self) -> &T {
        &self.transfer
    }

    /// The transfer, and the buffers that it did not hold at the end of the last frame: all of them,
    /// unless that frame failed.
    pub fn into_parts(self) -> (T, [Option<T::Buffer>; 2]) {
        (self.transfer, self.idle)
    }

    /// Draws a picture band by band and sends each, and waits for the last: `draw` fills the words
    /// of a band, all of them, while the one before is on its way. They hold what an earlier band left.
    ///
    /// # Errors
    ///
    /// [`FrameError`]: a buffer does not hold a row, which is found before anything is drawn; or the
    /// display's own error, after which the rest of the picture is not sent. The buffers are kept,
    /// and the next frame may be tried.
    pub fn frame(
        &mut self,
        viewport: &Viewport,
        mut draw: impl FnMut(&Band, &mut [T::Word]),
    ) -> Result<(), FrameError<T::Error>> {
        self.reclaim()?;
        let lengths = self.idle.iter_mut().flatten().map(|buffer| buffer.as_mut().len());
        let words = lengths.min().ok_or(FrameError::Lost)?;
        for band in viewport.bands(words).map_err(FrameError::Buffer)? {
            let mut buffer = self.take()?.ok_or(FrameError::Lost)?;
            // A prefix of all, as the smallest buffer decided the rows.
            draw(&band, buffer.as_mut().get_mut(..band.pixels()).unwrap_or_default());
            if let Err(error) = self.reclaim() {
                self.keep(buffer);
                return Err(error);
            }
            self.transfer.start(&band, buffer).map_err(FrameError::Display)?;
        }
        self.reclaim()
    }

    /// A buffer to draw into: one that is idle, or else the one in flight once it is sent.
    fn take(&mut self) -> Result<Option<T::Buffer>, FrameError<T::Error>> {
        if self.idle.iter().all(Option::is_none) {
            self.reclaim()?;
        }
        Ok(self.idle.iter_mut().find_map(Option::take))
    }

    /// Waits for what is in flight, and keeps its buffer.
    fn reclaim(&mut self) -> Result<(), FrameError<T::Error>> {
        if let Some(buffer) = self.transfer.finish().map_err(FrameError::Display)? {
            self.keep(buffer);
        }
        Ok(())
    }

    /// Puts a buffer among the idle ones; there are at most two.
    fn keep(&mut self, buffer: T::Buffer) {
        if let Some(place) = self.idle.iter_mut().find(|place| place.is_none()) {
            *place = Some(buffer);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec;
    use std::vec::Vec;

    /// A display that copies a buffer only when it is asked to finish: what was drawn into the
    /// buffer meanwhile would show.
    struct Late {
        rows: Vec<u16>,
        flight: Option<(Band, Vec<u16>)>,
        /// Fails at this start, counted down.
        fails_in: usize,
        /// Fails at this finish, counted down.
        fails_to_finish_in: usize,
        /// Whether a buffer is lost where a finish fails, against the trait's contract.
        loses: bool,
    }

    impl Transfer for Late {
        type Word = u16;
        type Buffer = Vec<u16>;
        type Error = u32;

        fn start(&mut self, band: &Band, buffer: Vec<u16>) -> Result<(), u32> {
            assert!(self.flight.is_none(), "two in flight");
            self.flight = Some((*band, buffer));
            self.fails_in = self.fails_in.wrapping_sub(1);
            if self.fails_in == 0 { Err(band.y()) } else { Ok(()) }
        }

        fn finish(&mut self) -> Result<Option<Vec<u16>>, u32> {
            self.fails_to_finish_in = self.fails_to_finish_in.wrapping_sub(1);
            if self.fails_to_finish_in == 0 {
                if self.loses {
                    self.flight = None;
                }
                return Err(77);
            }
            Ok(self.flight.take().map(|(band, buffer)| {
                let start = band.y() as usize * 10;
                self.rows[start..start + band.pixels()].copy_from_slice(&buffer[..band.pixels()]);
                buffer
            }))
        }
    }

    fn chain(height: u32, words: usize, second: bool, fails_in: usize) -> SwapChain<Late> {
        let rows = vec![9999; 10 * height as usize];
        let late = Late { rows, flight: None, fails_in, fails_to_finish_in: 0, loses: false };
        SwapChain::new(late, vec![0; words], second.then(|| vec![0; words]))
    }

    /// Numbers the pixels of a picture.
    fn number(band: &Band, words: &mut [u16]) {
        assert_eq!(words.len(), band.pixels());
        for (i, word) in words.iter_mut().enumerate() {
            *word = (band.y() * 10) as u16 + i as u16;
        }
    }

    #[test]
    fn no_row_is_missing_or_torn_whatever_the_band() {
        for height in [1, 2, 7, 48] {
            let picture = Viewport::new(10, height).unwrap();
            for words in [10, 19, 20, 30, 70, 480, 5000] {
                for second in [false, true] {
                    let mut chain = chain(height, words, second, 0);
                    for _ in 0..2 {
                        chain.frame(&picture, number).unwrap();
                    }
                    let expected: Vec<u16> = (0..10 * height as u16).collect();
                    assert_eq!(chain.transfer().rows, expected, "{height} {words} {second}");
                }
            }
        }
    }

    #[test]
    fn a_display_error_passes_through_and_no_buffer_is_lost() {
        let picture = Viewport::new(10, 48).unwrap();
        for second in [false, true] {
            let mut chain = chain(48, 50, second, 3);
            assert_eq!(chain.frame(&picture, number), Err(FrameError::Display(10)));
            assert_eq!(chain.frame(&picture, number), Ok(()));
            assert_eq!(chain.transfer().rows[479], 479);
            assert_eq!(chain.idle.iter().flatten().count(), 1 + usize::from(second));
        }
    }

    #[test]
    fn a_buffer_below_a_row_is_an_error_and_nothing_is_drawn() {
        let picture = Viewport::new(10, 48).unwrap();
        let error = chain(48, 9, true, 0).frame(&picture, |_, _| panic!("drawn"));
        assert_eq!(error, Err(FrameError::Buffer(BufferSize::Words { needed: 10, got: 9 })));
        let (late, _) = chain(48, 480, false, 0).into_parts();
        let mut chain = SwapChain::new(late, vec![0; 480], Some(vec![]));
        assert!(chain.frame(&picture, |_, _| panic!("drawn")).is_err());
    }

    #[test]
    fn a_failed_finish_passes_through_wherever_and_no_buffer_is_lost() {
        let picture = Viewport::new(10, 48).unwrap();
        for second in [false, true] {
            // A frame of ten bands waits 12 times or more: at its start, at each band, at its end.
            for wait in 1..=12 {
                let mut chain = chain(48, 50, second, 0);
                chain.transfer.fails_to_finish_in = wait;
                assert_eq!(chain.frame(&picture, number), Err(FrameError::Display(77)), "{wait}");
                assert_eq!(chain.frame(&picture, number), Ok(()), "{wait}");
                assert_eq!(chain.transfer().rows, (0..480).collect::<Vec<u16>>());
                let (_, idle) = chain.into_parts();
                assert_eq!(idle.iter().flatten().count(), 1 + usize::from(second), "{wait}");
            }
        }
    }

    #[test]
    fn a_transfer_that_loses_the_only_buffer_is_named() {
        let picture = Viewport::new(10, 48).unwrap();
        let mut chain = chain(48, 50, false, 0);
        (chain.transfer.fails_to_finish_in, chain.transfer.loses) = (3, true);
        assert_eq!(chain.frame(&picture, number), Err(FrameError::Display(77)));
        assert_eq!(chain.frame(&picture, number), Err(FrameError::Lost));
    }

    #[test]
    fn the_smaller_of_two_buffers_decides_the_rows() {
        let picture = Viewport::new(10, 48).unwrap();
        let (late, _) = chain(48, 480, false, 0).into_parts();
        let mut chain = SwapChain::new(late, vec![0; 70], Some(vec![0; 39]));
        let mut rows = vec![];
        let draw = |band: &Band, words: &mut [u16]| {
            rows.push(band.rows());
            number(band, words);
        };
        chain.frame(&picture, draw).unwrap();
        assert_eq!(rows, [3; 16]);
        assert_eq!(chain.transfer().rows, (0..480).collect::<Vec<u16>>());
    }

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

//! Sending bands: the transfer, and buffers that take turns.

use super::Band;
use crate::buffer::BufferSize;
use crate::vertex::Viewport;
use core::future::{Future, poll_fn};
use core::pin::pin;
use core::task::{Context, Poll, Waker};

/// What sends bands to a display: a DMA engine, or a driver that blocks.
///
/// It takes a buffer by value when a transfer starts, and gives it back when that is done, so that
/// a buffer in flight cannot be drawn into. At most one is in flight. It holds the buffer itself, not a future that
/// somebody might drop: whoever stops waiting for a transfer leaves it where it is, and whoever waits next gets its
/// buffer.
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
    /// The display's own. The buffer is not lost: [`poll_finish`](Self::poll_finish) still gives it back.
    fn start(&mut self, band: &Band, buffer: Self::Buffer) -> Result<(), Self::Error>;

    /// Gives the buffer back once the display has taken its last word; `None` where none was in flight. Until then it is
    /// [`Poll::Pending`], and the context's waker is woken when it is worth while to ask again. What has nothing to do
    /// meanwhile may wait here instead, and leave the context alone.
    ///
    /// # Errors
    ///
    /// The display's own. The buffer is not lost: the next call gives it back, or fails as well.
    fn poll_finish(
        &mut self,
        context: &mut Context<'_>,
    ) -> Poll<Result<Option<Self::Buffer>, Self::Error>>;
}

/// Buffers that take turns: one is drawn into while the other is sent (double buffering). With one
/// buffer, drawing waits for the transfer.
///
/// ```
/// use core::task::{Context, Poll};
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
///     fn poll_finish(&mut self, _: &mut Context<'_>) -> Poll<Result<Option<Vec<u16>>, Self::Error>> {
///         Poll::Ready(Ok(self.1.take()))
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
    /// unless that frame failed or was dropped.
    pub fn into_parts(self) -> (T, [Option<T::Buffer>; 2]) {
        (self.transfer, self.idle)
    }

    /// Draws a picture band by band and sends each, and waits for the last: `draw` fills the words
    /// of a band, all of them, while the one before is on its way. They hold what an earlier band left.
    ///
    /// While it waits it does nothing else: [`frame_async`](Self::frame_async) lets other tasks run.
    ///
    /// # Errors
    ///
    /// [`FrameError`]: a buffer does not hold a row, which is found before anything is drawn; or the
    /// display's own error, after which the rest of the picture is not sent. The buffers are kept,
    /// and the next frame may be tried.
    pub fn frame(
        &mut self,
        viewport: &Viewport,
        draw: impl FnMut(&Band, &mut [T::Word]),
    ) -> Result<(), FrameError<T::Error>> {
        let mut frame = pin!(self.frame_async(viewport, draw));
        let mut context = Context::from_waker(Waker::noop());
        loop {
            if let Poll::Ready(sent) = frame.as_mut().poll(&mut context) {
                return sent;
            }
            core::hint::spin_loop();
        }
    }

    /// [`frame`](Self::frame) for executors: it waits for transfers without holding up other tasks, which also run once
    /// after each start, so that one of them may be what sends. Drawing a band is one step that does not wait.
    ///
    /// It may be dropped at any point: a buffer on its way stays with the transfer, which goes on and gives it to the next
    /// frame, and the others stay here. The rest of the picture is not sent then.
    ///
    /// # Errors
    ///
    /// As of [`frame`](Self::frame).
    pub async fn frame_async(
        &mut self,
        viewport: &Viewport,
        mut draw: impl FnMut(&Band, &mut [T::Word]),
    ) -> Result<(), FrameError<T::Error>> {
        self.reclaim().await?;
        let lengths = self.idle.iter_mut().flatten().map(|buffer| buffer.as_mut().len());
        let words = lengths.min().ok_or(FrameError::Lost)?;
        for band in viewport.bands(words).map_err(FrameError::Buffer)? {
            if self.idle.iter().all(Option::is_none) {
                self.reclaim().await?;
            }
            // Where it stays until it is sent: what is dropped meanwhile loses none.
            let drawn = self.idle.iter().position(Option::is_some).ok_or(FrameError::Lost)?;
            if let Some(buffer) = self.idle.get_mut(drawn).and_then(Option::as_mut) {
                // A prefix of all, as the smallest buffer decided the rows.
                draw(&band, buffer.as_mut().get_mut(..band.pixels()).unwrap_or_default());
            }
            self.reclaim().await?;
            let buffer = self.idle.get_mut(drawn).and_then(Option::take).ok_or(FrameError::Lost)?;
            self.transfer.start(&band, buffer).map_err(FrameError::Display)?;
            let_others_run().await;
        }
        self.reclaim().await
    }

    /// Waits for what is in flight, and keeps its buffer.
    async fn reclaim(&mut self) -> Result<(), FrameError<T::Error>> {
        let finished = poll_fn(|context| self.transfer.poll_finish(context)).await;
        if let Some(buffer) = finished.map_err(FrameError::Display)? {
            // There are at most two, and this one was not among them.
            if let Some(place) = self.idle.iter_mut().find(|place| place.is_none()) {
                *place = Some(buffer);
            }
        }
        Ok(())
    }
}

/// Waits once, and is ready at once.
async fn let_others_run() {
    let mut waited = false;
    poll_fn(|context| {
        if waited {
            return Poll::Ready(());
        }
        waited = true;
        context.waker().wake_by_ref();
        Poll::Pending
    })
    .await;
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
        /// How often a transfer is asked for before it is done, and how often it was.
        slow: usize,
        polls: usize,
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

        fn poll_finish(
            &mut self,
            context: &mut Context<'_>,
        ) -> Poll<Result<Option<Vec<u16>>, u32>> {
            if self.flight.is_some() && self.polls < self.slow {
                self.polls += 1;
                context.waker().wake_by_ref();
                return Poll::Pending;
            }
            self.polls = 0;
            Poll::Ready(self.finish())
        }
    }

    impl Late {
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
        let late = Late {
            rows,
            flight: None,
            fails_in,
            fails_to_finish_in: 0,
            slow: 0,
            polls: 0,
            loses: false,
        };
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

    /// A waker that counts.
    #[derive(Default)]
    struct Woken(core::sync::atomic::AtomicUsize);

    impl std::task::Wake for Woken {
        fn wake(self: std::sync::Arc<Self>) {
            self.0.fetch_add(1, core::sync::atomic::Ordering::Relaxed);
        }
    }

    /// Polls a future as an executor does, while it has been woken; up to `polls` times.
    fn run<F: Future>(future: F, polls: usize) -> Option<F::Output> {
        let woken = std::sync::Arc::new(Woken::default());
        let waker = Waker::from(woken.clone());
        let mut future = pin!(future);
        for poll in 0..polls {
            let count = woken.0.load(core::sync::atomic::Ordering::Relaxed);
            assert!(poll == 0 || count > 0, "it waits for what never comes");
            woken.0.store(0, core::sync::atomic::Ordering::Relaxed);
            if let Poll::Ready(output) = future.as_mut().poll(&mut Context::from_waker(&waker)) {
                return Some(output);
            }
        }
        None
    }

    #[test]
    fn a_frame_that_waits_is_the_same() {
        let picture = Viewport::new(10, 48).unwrap();
        for second in [false, true] {
            for slow in 0..4 {
                let mut chain = chain(48, 50, second, 0);
                chain.transfer.slow = slow;
                assert_eq!(run(chain.frame_async(&picture, number), 1000), Some(Ok(())));
                assert_eq!(chain.transfer.rows, (0..480).collect::<Vec<u16>>());
                chain.transfer.rows.fill(0);
                assert_eq!(chain.frame(&picture, number), Ok(()));
                assert_eq!(chain.transfer.rows, (0..480).collect::<Vec<u16>>());
            }
        }
    }

    /// Wherever a frame is dropped, what was started goes on undisturbed, and the next frame has all buffers.
    #[test]
    fn a_dropped_frame_loses_nothing_and_disturbs_no_transfer() {
        let picture = Viewport::new(10, 48).unwrap();
        for second in [false, true] {
            for slow in 0..3 {
                let mut dropped = 0;
                for polls in 0..60 {
                    let mut chain = chain(48, 50, second, 0);
                    chain.transfer.slow = slow;
                    dropped +=
                        usize::from(run(chain.frame_async(&picture, number), polls).is_none());
                    // What is on its way arrives, though its frame is gone.
                    let in_flight = chain.transfer.flight.as_ref().map(|(band, _)| *band);
                    let nothing = Viewport::new(10, 1).unwrap();
                    chain.frame(&nothing, |_, words| words.fill(0)).unwrap();
                    if let Some(band) = in_flight.filter(|band| band.y() > 0) {
                        let start = band.y() as usize * 10;
                        let shown = &chain.transfer.rows[start..start + band.pixels()];
                        assert!(
                            shown.iter().copied().eq(start as u16..(start + shown.len()) as u16)
                        );
                    }
                    assert_eq!(chain.frame(&picture, number), Ok(()));
                    assert_eq!(chain.transfer.rows, (0..480).collect::<Vec<u16>>());
                    assert_eq!(chain.idle.iter().flatten().count(), 1 + usize::from(second));
                }
                assert!(dropped > 9, "{dropped}");
            }
        }
    }
}

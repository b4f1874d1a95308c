//! Targets whose colours are merged: over what a framebuffer holds, or over one colour.

use super::{Alpha, Merge, Mix};
use crate::color::PixelFormat;
use crate::framebuffer::{Framebuffer, Target};
use core::marker::PhantomData;

/// A [`Framebuffer`] in which what is drawn is merged with what is there: see
/// [`Frame::blended`](crate::Frame::blended), which makes one.
///
/// `M` is what is drawn: [`Alpha`] or [`Add`](crate::Add) of the format's colour, or any other [`Merge`] with it. Each pixel
/// is read, decoded, merged, encoded and written; each pixel of a fill too, unless it is [`opaque`](Merge::opaque). Only memory can be read: there is none of this
/// over a display that is written to as it is drawn, but [`Over`].
///
/// ```
/// use hither::{Alpha, Blended, Framebuffer, Gray8, Target};
///
/// let mut words = [100; 4];
/// let mut buffer = Framebuffer::<Gray8>::try_new(&mut words, 4, 1)?;
/// Blended::new(&mut buffer).fill(1, 0, 2, Alpha { color: Gray8(200), alpha: 51 });
/// assert_eq!(words, [100, 120, 120, 100]);
/// # Ok::<(), hither::BufferSize>(())
/// ```
#[derive(Debug)]
pub struct Blended<'a, F: PixelFormat, M = Alpha<<F as PixelFormat>::Color>> {
    buffer: Framebuffer<'a, F>,
    merge: PhantomData<M>,
}

impl<'a, F: PixelFormat, M: Merge<F::Color>> Blended<'a, F, M> {
    /// The pixels of a buffer, until this is dropped.
    #[must_use]
    pub fn new(buffer: &'a mut Framebuffer<'_, F>) -> Self {
        Self { buffer: buffer.reborrow(), merge: PhantomData }
    }

    /// What a word becomes.
    #[inline]
    fn merge(word: &mut F::Word, drawn: M) {
        *word = F::encode(drawn.over(F::decode(*word)));
    }
}

impl<F: PixelFormat, M: Merge<F::Color>> Target for Blended<'_, F, M> {
    type Color = M;
    const MERGES: bool = true;

    #[inline]
    fn size(&self) -> (u32, u32) {
        self.buffer.size()
    }

    #[inline]
    fn write(&mut self, x: usize, y: usize, colors: impl Iterator<Item = Option<M>>) {
        for (word, drawn) in self.buffer.from(x, y).iter_mut().zip(colors) {
            if let Some(drawn) = drawn {
                Self::merge(word, drawn);
            }
        }
    }

    #[inline]
    fn write_each<L, const CHUNK: usize>(
        &mut self,
        (x, y, _): (usize, usize, usize),
        lanes: &mut [L],
        mut color: impl FnMut(&mut L, bool) -> Option<M>,
    ) {
        for (word, lane) in self.buffer.from(x, y).iter_mut().zip(lanes) {
            if let Some(drawn) = color(lane, false) {
                Self::merge(word, drawn);
            }
        }
    }

    #[inline]
    fn fill(&mut self, x: usize, y: usize, length: usize, color: M) {
        if let Some(color) = color.opaque() {
            self.buffer.fill(x, y, length, color);
        } else if let Some(run) = self.buffer.from(x, y).get_mut(..length) {
            run.iter_mut().for_each(|word| Self::merge(word, color));
        }
    }
}

/// Any target, over whose pixels [`Alpha`] is mixed with one stated colour, whatever they show: for smooth edges on a display
/// that cannot be read, on a background of one colour.
///
/// One mix a pixel, or a fill; where `alpha` is 0 nothing is written. A second layer does not see the first.
///
/// ```
/// use hither::{Alpha, Framebuffer, Gray8, Over, Target};
///
/// let mut words = [7; 4];
/// let display = Framebuffer::<Gray8>::try_new(&mut words, 4, 1)?;
/// let mut over = Over::new(display, Gray8(100));
/// let drawn = |alpha| Some(Alpha { color: Gray8(200), alpha });
/// over.write(0, 0, [drawn(0), drawn(51), drawn(255), None].into_iter());
/// assert_eq!(words, [7, 120, 200, 7]);
/// # Ok::<(), hither::BufferSize>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Over<T, C> {
    target: T,
    background: C,
}

impl<T, C> Over<T, C> {
    /// `target` over `background`, which is what it shows, or will have to be taken for that: nothing is drawn here.
    #[must_use]
    pub const fn new(target: T, background: C) -> Self {
        Self { target, background }
    }

    /// The target, to flush, or to draw in plain colours.
    #[must_use]
    pub const fn target_mut(&mut self) -> &mut T {
        &mut self.target
    }

    /// The target back.
    #[must_use]
    pub fn into_target(self) -> T {
        self.target
    }
}

/// What is shown over a background, if anything.
#[inline]
fn shown<C: Mix>(drawn: Alpha<C>, background: C) -> Option<C> {
    (drawn.alpha > 0).then(|| drawn.over(background))
}

impl<T: Target, C: Mix> Target for Over<T, C>
where
    T: Target<Color = C>,
{
    type Color = Alpha<C>;

    #[inline]
    fn size(&self) -> (u32, u32) {
        self.target.size()
    }

    #[inline]
    fn write(&mut self, x: usize, y: usize, colors: impl Iterator<Item = Option<Alpha<C>>>) {
        let background = self.background;
        self.target.write(x, y, colors.map(|drawn| shown(drawn?, background)));
    }

    #[inline]
    fn write_each<L, const CHUNK: usize>(
        &mut self,
        at: (usize, usize, usize),
        lanes: &mut [L],
        mut color: impl FnMut(&mut L, bool) -> Option<Alpha<C>>,
    ) {
        let background = self.background;
        self.target.write_each::<L, 1>(at, lanes, |lane, _| shown(color(lane, false)?, background));
    }

    #[inline]
    fn fill(&mut self, x: usize, y: usize, length: usize, color: Alpha<C>) {
        if let Some(color) = shown(color, self.background) {
            self.target.fill(x, y, length, color);
        }
    }

    #[inline]
    fn fill_rows(
        &mut self,
        x: usize,
        y: usize,
        runs: impl Iterator<Item = (i32, i32)>,
        color: Alpha<C>,
    ) {
        if let Some(color) = shown(color, self.background) {
            self.target.fill_rows(x, y, runs, color);
        }
    }

    #[inline]
    fn fill_runs(
        &mut self,
        x: usize,
        y: usize,
        runs: impl Iterator<Item = (i32, i32)>,
        color: Alpha<C>,
    ) {
        if let Some(color) = shown(color, self.background) {
            self.target.fill_runs(x, y, runs, color);
        }
    }

    fn clear(&mut self, color: Alpha<C>) {
        if let Some(color) = shown(color, self.background) {
            self.target.clear(color);
        }
    }
}

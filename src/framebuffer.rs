//! Where spans go: the target trait, and a framebuffer in memory.

use crate::buffer::BufferSize;
use crate::color::PixelFormat;
use crate::math::index;
use crate::traversal::{LineWalk, Scan};
use crate::vertex::Rect;
use bytemuck::Pod;

/// What spans are drawn into.
///
/// The least an implementation needs is [`write`](Target::write): a run of pixels, some of them
/// skipped. Memory that holds rows does better by [`fill`](Target::fill), for runs of one colour.
/// Coordinates are the target's own, row 0 on top; the rasterizer never passes any outside of
/// [`size`](Target::size).
///
/// ```
/// use hither::{Flat, Frame, Rgb565, Target, Viewport};
///
/// /// Counts how often each pixel is drawn.
/// struct Overdraw([[u8; 16]; 16]);
///
/// impl Target for Overdraw {
///     type Color = ();
///
///     fn size(&self) -> (u32, u32) {
///         (16, 16)
///     }
///
///     fn write(&mut self, x: usize, y: usize, colors: impl Iterator<Item = Option<()>>) {
///         for (count, color) in self.0[y][x..].iter_mut().zip(colors) {
///             *count += color.is_some() as u8;
///         }
///     }
/// }
/// # let _ = Frame::new(Overdraw([[0; 16]; 16]));
/// ```
pub trait Target {
    /// What a pixel is drawn with.
    type Color: Copy;

    /// Whether what is drawn is merged with what is there, so that drawing it again is not the same.
    #[doc(hidden)]
    const MERGES: bool = false;

    /// Width and height in pixels, the same whenever they are asked for.
    fn size(&self) -> (u32, u32);

    /// Writes pixels of row `y` from column `x` on, as many as `colors` yields, all inside of the
    /// target; those that are `None` keep what they were.
    fn write(&mut self, x: usize, y: usize, colors: impl Iterator<Item = Option<Self::Color>>);

    /// Writes pixels of row `y` from column `x` on, which is pixel `at = y width + x`, one for each of `lanes`, all inside of
    /// the target: what `color` makes of it. One counter for both is less than an iterator's two, and one for `CHUNK` pixels less
    /// than that, while all a chunk needs is in registers.
    #[doc(hidden)]
    #[inline]
    fn write_each<L, const CHUNK: usize>(
        &mut self,
        (x, y, _): (usize, usize, usize),
        lanes: &mut [L],
        mut color: impl FnMut(&mut L, bool) -> Option<Self::Color>,
    ) {
        self.write(x, y, lanes.iter_mut().map(|lane| color(lane, false)));
    }

    /// Writes pixels of row `y` from column `x` on, one for each of `lanes`, all inside of the target: what `runs` make of
    /// them.
    #[doc(hidden)]
    #[inline]
    fn write_bent<L: Pod>(
        &mut self,
        (x, y, _): (usize, usize, usize),
        lanes: &mut [L],
        mut runs: impl Runs<L, Self::Color>,
    ) {
        let mut current = None;
        let colors = lanes.iter_mut().map(|lane| {
            let (mut run, done) = current.take().unwrap_or_else(|| (runs.begin(), 0));
            let color = run.pen.color(&run.pen.brush(), lane);
            let done = done + 1;
            if done % BEND == 0 {
                run.pen.bend(run.steps);
            }
            current = (run.last || done < run.bends * BEND).then_some((run, done));
            color
        });
        self.write(x, y, colors);
    }

    /// Fills `length` pixels of row `y` from column `x` on with one colour.
    #[inline]
    fn fill(&mut self, x: usize, y: usize, length: usize, color: Self::Color) {
        self.write(x, y, core::iter::repeat_n(Some(color), length));
    }

    /// Fills a run a row from row `y` down with one colour, all inside of the target: columns `x + x0 .. x + x1`, none
    /// where `x0 >= x1`.
    #[doc(hidden)]
    #[inline]
    fn fill_rows(
        &mut self,
        x: usize,
        y: usize,
        runs: impl Iterator<Item = (i32, i32)>,
        color: Self::Color,
    ) {
        for (row, (x0, x1)) in runs.enumerate() {
            if x0 < x1 {
                let (x0, length) = run(x0, x1);
                self.fill(x + x0, y + row, length, color);
            }
        }
    }

    /// Fills a run a row with one colour, all inside of the target, most of a few pixels: from pixel `i0` to before `i1`, counted
    /// row by row from column `x` of row `y`.
    #[doc(hidden)]
    #[inline]
    fn fill_runs(
        &mut self,
        x: usize,
        y: usize,
        runs: impl Iterator<Item = (i32, i32)>,
        color: Self::Color,
    ) {
        let (width, _) = self.size();
        for (row, (i0, i1)) in runs.enumerate() {
            if i0 < i1 {
                let (i0, length) = run(i0, i1);
                self.fill(x + i0 - row * width as usize, y + row, length, color);
            }
        }
    }

    /// Draws a run a row as [`fill_runs`](Self::fill_runs) fills them, from `(x, y)`, which is pixel `at`, with one of `lanes`
    /// a pixel from there on: what `row` hands out for a run makes the colours of its pixels.
    #[doc(hidden)]
    #[inline]
    fn write_runs<L, P>(
        &mut self,
        (x, y, at): (usize, usize, usize),
        lanes: &mut [L],
        runs: impl Iterator<Item = (i32, i32)>,
        mut row: impl FnMut(i32, i32) -> P,
    ) where
        P: FnMut(&mut L) -> Option<Self::Color>,
    {
        let (width, _) = self.size();
        for (n, (i0, i1)) in runs.enumerate() {
            let mut color = row(i0, i1);
            let (i0, i1) = (index(i0), index(i1));
            if let Some(lanes) = lanes.get_mut(i0..i1) {
                let to = (x + i0 - n * width as usize, y + n, at + i0);
                self.write_each::<_, 1>(to, lanes, |lane, _| color(lane));
            }
        }
    }

    /// Draws the covered pixels of a box whose first one is `(x, y)`, with one of `lanes` a pixel of the target: what
    /// `color` makes of it.
    #[doc(hidden)]
    #[inline]
    fn write_scan<L>(
        &mut self,
        (x, y): (usize, usize),
        lanes: &mut [L],
        mut scan: Scan,
        mut color: impl FnMut(&mut L, &Scan) -> Option<Self::Color>,
    ) {
        loop {
            if scan.enter() {
                let (column, row) = scan.place();
                let colors = core::iter::from_fn(|| {
                    let lane = lanes.get_mut(scan.at()).filter(|_| scan.is_covered())?;
                    let color = color(lane, &scan);
                    scan.step();
                    Some(color)
                });
                self.write(x + index(column), y + index(row), colors);
            }
            if !scan.turn() {
                return;
            }
        }
    }

    /// Draws the pixels of a line, with one of `lanes` a pixel of the target: what `color` makes of it.
    #[doc(hidden)]
    #[inline]
    fn write_line<L>(
        &mut self,
        lanes: &mut [L],
        mut walk: LineWalk,
        mut color: impl FnMut(&mut L, &LineWalk) -> Option<Self::Color>,
    ) {
        loop {
            let (x, y) = walk.place();
            if let Some(lane) = lanes.get_mut(walk.at()) {
                self.write(index(x), index(y), core::iter::once(color(lane, &walk)));
            }
            if !walk.step() {
                return;
            }
        }
    }

    /// Fills all of it with one colour.
    fn clear(&mut self, color: Self::Color) {
        let (width, height) = self.size();
        for y in 0..height {
            self.fill(0, y as usize, width as usize, color);
        }
    }
}

/// A run bends after so many pixels.
pub(crate) const BEND: usize = 8;

/// The runs of pixels that a row is made of, each pixel with a lane beside it. All but the last are of whole bends.
#[doc(hidden)]
pub trait Runs<L, C> {
    /// A run at one of its pixels.
    type Pen: Pen<L, C>;

    /// The next run of the row.
    fn begin(&mut self) -> RunOf<Self::Pen>;
}

/// A run of pixels.
#[doc(hidden)]
#[derive(Debug)]
pub struct RunOf<P> {
    /// At its first pixel.
    pub pen: P,
    /// How the pen's steps go on.
    pub steps: [u32; 2],
    /// How often it bends.
    pub bends: usize,
    /// Whether it ends where the row does, however many pixels that are.
    pub last: bool,
}

/// A run at one of its pixels.
#[doc(hidden)]
pub trait Pen<L, C> {
    /// What it makes colours with.
    type Brush;

    /// That, for a chunk of pixels: read then, it takes registers in no other.
    fn brush(&self) -> Self::Brush;

    /// The colour of the pixel, and on to the next.
    fn color(&mut self, brush: &Self::Brush, lane: &mut L) -> Option<C>;

    /// After [`BEND`] pixels.
    fn bend(&mut self, steps: [u32; 2]);
}

/// A framebuffer in words the caller lends, stored as `F`: rows from the top, without padding.
#[derive(Debug)]
pub struct Framebuffer<'a, F: PixelFormat> {
    words: &'a mut [F::Word],
    width: u32,
    height: u32,
}

impl<'a, F: PixelFormat> Framebuffer<'a, F> {
    /// A `width x height` buffer over the first `width * height` words, which keep what they hold.
    ///
    /// # Errors
    ///
    /// [`BufferSize`] where a side is 0 or there are fewer words.
    pub fn try_new(words: &'a mut [F::Word], width: u32, height: u32) -> Result<Self, BufferSize> {
        BufferSize::check(width, height, words.len())?;
        Ok(Self { words, width, height })
    }

    /// The pixels as they are stored, row by row from the top.
    #[must_use]
    pub fn words(&self) -> &[F::Word] {
        self.words
    }

    /// The pixels as bytes in memory order: what an SPI driver or a DMA engine sends.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        let pixels = self.width as usize * self.height as usize;
        bytemuck::cast_slice(self.words.get(..pixels).unwrap_or_default())
    }

    /// The pixels of a rectangle as they are stored, a row at a time from the top: what is sent for a part of a picture, such as what
    /// a [`Dirty`](crate::Dirty) target says. Of one that is not all in the buffer the part that is.
    pub fn rect_words(&self, rect: Rect) -> impl Iterator<Item = &[F::Word]> {
        let side = |v: i32, size: u32| usize::try_from(v).unwrap_or(0).min(size as usize);
        let (x0, x1) = (side(rect.x0, self.width), side(rect.x1, self.width));
        let (y0, y1) = (side(rect.y0, self.height), side(rect.y1, self.height));
        let rows = self.words.chunks_exact(self.width as usize).take(y1).skip(y0);
        rows.filter_map(move |row| row.get(x0..x1).filter(|row| !row.is_empty()))
    }

    /// [`rect_words`](Self::rect_words) as bytes in memory order.
    pub fn rect_bytes(&self, rect: Rect) -> impl Iterator<Item = &[u8]> {
        self.rect_words(rect).map(bytemuck::cast_slice)
    }

    /// The colour at a pixel, or `None` outside of the buffer.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<F::Color> {
        let inside = x < self.width && y < self.height;
        let at = y as usize * self.width as usize + x as usize;
        self.words.get(at).filter(|_| inside).map(|word| F::decode(*word))
    }

    /// The buffer back, for a flush or for text.
    #[must_use]
    pub fn into_words(self) -> &'a mut [F::Word] {
        self.words
    }

    /// The same buffer for a while, to be drawn into in another way.
    pub(crate) fn reborrow(&mut self) -> Framebuffer<'_, F> {
        Framebuffer { words: self.words, width: self.width, height: self.height }
    }

    /// The words of row `y` from column `x` on, to the end of the buffer.
    #[inline]
    pub(crate) fn from(&mut self, x: usize, y: usize) -> &mut [F::Word] {
        let start = y * self.width as usize + x;
        self.words.get_mut(start..).unwrap_or_default()
    }
}

impl<F: PixelFormat> Target for Framebuffer<'_, F> {
    type Color = F::Color;

    #[inline]
    fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    #[inline]
    fn write(&mut self, x: usize, y: usize, colors: impl Iterator<Item = Option<F::Color>>) {
        for (word, color) in self.from(x, y).iter_mut().zip(colors) {
            if let Some(color) = color {
                *word = F::encode(color);
            }
            // As in `write_each`.
            core::hint::black_box(());
        }
    }

    #[inline(always)]
    fn write_each<L, const CHUNK: usize>(
        &mut self,
        (_, _, at): (usize, usize, usize),
        lanes: &mut [L],
        mut color: impl FnMut(&mut L, bool) -> Option<F::Color>,
    ) {
        let Some(words) = self.words.get_mut(at..at.wrapping_add(lanes.len())) else {
            return;
        };
        let mut draw = |word: &mut F::Word, lane: &mut L, first: bool| {
            if let Some(color) = color(lane, first) {
                *word = F::encode(color);
            }
        };
        const { assert!(CHUNK == 1 || CHUNK == 2 || CHUNK == 4, "chunks are of 1, 2 or 4 pixels") }
        let (mut words, mut lanes) = (words, lanes);
        if CHUNK > 1 && lanes.len() >= UNROLLED {
            let whole = lanes.len() - lanes.len() % CHUNK;
            let (word_chunks, rest) = words.split_at_mut_checked(whole).unwrap_or_default();
            words = rest;
            let (lane_chunks, rest) = lanes.split_at_mut_checked(whole).unwrap_or_default();
            lanes = rest;
            let word_chunks = word_chunks.chunks_exact_mut(CHUNK);
            for (words, lanes) in word_chunks.zip(lane_chunks.chunks_exact_mut(CHUNK)) {
                match (words, lanes) {
                    ([w0, w1], [l0, l1]) => {
                        draw(w0, l0, false);
                        draw(w1, l1, false);
                    }
                    ([w0, w1, w2, w3], [l0, l1, l2, l3]) => {
                        draw(w0, l0, true);
                        draw(w1, l1, false);
                        draw(w2, l2, false);
                        draw(w3, l3, false);
                    }
                    _ => {}
                }
                // Nothing; but with it the loop is not unrolled further, which takes more registers than there are.
                core::hint::black_box(());
            }
        }
        for (word, lane) in words.iter_mut().zip(lanes) {
            draw(word, lane, false);
            core::hint::black_box(());
        }
    }

    #[inline(always)]
    fn write_bent<L: Pod>(
        &mut self,
        (_, _, at): (usize, usize, usize),
        lanes: &mut [L],
        mut runs: impl Runs<L, F::Color>,
    ) {
        let Some(words) = self.words.get_mut(at..at.wrapping_add(lanes.len())) else {
            return;
        };
        let draw = |pen: &mut _, brush: &_, word: &mut F::Word, lane: &mut L| {
            if let Some(color) = Pen::color(pen, brush, lane) {
                *word = F::encode(color);
            }
        };
        let whole = lanes.len() / BEND * BEND;
        let Some((words, last_words)) = words.split_at_mut_checked(whole) else {
            return;
        };
        let Some((lanes, last_lanes)) = lanes.split_at_mut_checked(whole) else {
            return;
        };
        let Ok(words) = bytemuck::try_cast_slice_mut::<F::Word, [F::Word; BEND]>(words) else {
            return;
        };
        let Ok(lanes) = bytemuck::try_cast_slice_mut::<L, [L; BEND]>(lanes) else {
            return;
        };
        let mut rest = lanes;
        let mut state = (words.iter_mut(), <&mut [[L; BEND]]>::default().iter_mut(), [0; 2]);
        // What is behind this is read anew a chunk: its pixels want the registers. Sixteen at a time took as much, and two
        // iterators zipped into one half an instruction a pixel more.
        let _ = core::hint::black_box(&mut state);
        let mut pen;
        loop {
            let run = runs.begin();
            let Some((these, others)) = rest.split_at_mut_checked(run.bends) else {
                return;
            };
            (pen, state.1, state.2, rest) = (run.pen, these.iter_mut(), run.steps, others);
            for lanes in state.1.by_ref() {
                let Some(words) = state.0.next() else { return };
                let brush = pen.brush();
                for (word, lane) in words.iter_mut().zip(lanes) {
                    draw(&mut pen, &brush, word, lane);
                }
                core::hint::black_box(());
                pen.bend(state.2);
            }
            if run.last {
                break;
            }
        }
        let brush = pen.brush();
        for (word, lane) in last_words.iter_mut().zip(last_lanes) {
            draw(&mut pen, &brush, word, lane);
            core::hint::black_box(());
        }
    }

    #[inline]
    fn fill(&mut self, x: usize, y: usize, length: usize, color: F::Color) {
        if let Some(run) = self.from(x, y).get_mut(..length) {
            fill(run, F::encode(color));
        }
    }

    #[inline(always)]
    fn fill_rows(
        &mut self,
        x: usize,
        y: usize,
        runs: impl Iterator<Item = (i32, i32)>,
        color: F::Color,
    ) {
        let word = F::encode(color);
        let stride = self.width as usize;
        let mut below = self.from(x, y);
        for (x0, x1) in runs {
            if let Some(run) = below.get_mut(index(x0)..index(x1)) {
                fill(run, word);
            }
            let Some(next) = below.get_mut(stride..) else {
                return;
            };
            below = next;
        }
    }

    #[inline(always)]
    fn fill_runs(
        &mut self,
        x: usize,
        y: usize,
        runs: impl Iterator<Item = (i32, i32)>,
        color: F::Color,
    ) {
        let word = F::encode(color);
        let words = self.from(x, y);
        for (i0, i1) in runs {
            if let Some(run) = words.get_mut(index(i0)..index(i1)) {
                fill_short(run, word, fill_long);
            }
        }
    }

    #[inline(always)]
    fn write_runs<L, P>(
        &mut self,
        (_, _, at): (usize, usize, usize),
        lanes: &mut [L],
        runs: impl Iterator<Item = (i32, i32)>,
        mut row: impl FnMut(i32, i32) -> P,
    ) where
        P: FnMut(&mut L) -> Option<F::Color>,
    {
        let words = self.words.get_mut(at..).unwrap_or_default();
        for (i0, i1) in runs {
            let mut color = row(i0, i1);
            let (i0, i1) = (index(i0), index(i1));
            if let Some(words) = words.get_mut(i0..i1) {
                if let Some(lanes) = lanes.get_mut(i0..i1) {
                    for (word, lane) in words.iter_mut().zip(lanes) {
                        if let Some(color) = color(lane) {
                            *word = F::encode(color);
                        }
                        core::hint::black_box(());
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn write_scan<L>(
        &mut self,
        _: (usize, usize),
        lanes: &mut [L],
        mut scan: Scan,
        mut color: impl FnMut(&mut L, &Scan) -> Option<F::Color>,
    ) {
        // Of one length, so that an index is compared once.
        let length = self.words.len().min(lanes.len());
        let (Some(words), Some(lanes)) = (self.words.get_mut(..length), lanes.get_mut(..length))
        else {
            return;
        };
        loop {
            if scan.enter() {
                loop {
                    let at = scan.at();
                    let (Some(word), Some(lane)) = (words.get_mut(at), lanes.get_mut(at)) else {
                        return;
                    };
                    if let Some(color) = color(lane, &scan) {
                        *word = F::encode(color);
                    }
                    scan.step();
                    if !scan.is_covered() {
                        break;
                    }
                }
            }
            if !scan.turn() {
                return;
            }
        }
    }

    #[inline(always)]
    fn write_line<L>(
        &mut self,
        lanes: &mut [L],
        mut walk: LineWalk,
        mut color: impl FnMut(&mut L, &LineWalk) -> Option<F::Color>,
    ) {
        // As in `write_scan`.
        let length = self.words.len().min(lanes.len());
        let (Some(words), Some(lanes)) = (self.words.get_mut(..length), lanes.get_mut(..length))
        else {
            return;
        };
        loop {
            let at = walk.at();
            let (Some(word), Some(lane)) = (words.get_mut(at), lanes.get_mut(at)) else {
                return;
            };
            if let Some(color) = color(lane, &walk) {
                *word = F::encode(color);
            }
            if !walk.step() {
                return;
            }
        }
    }

    fn clear(&mut self, color: F::Color) {
        self.words.fill(F::encode(color));
    }
}

/// Runs of this length are drawn by several pixels at a time, which takes less a pixel and more before and after.
const UNROLLED: usize = 8;

/// Fills a run of words, short ones without a loop.
#[inline]
fn fill<W: Pod>(run: &mut [W], word: W) {
    if run.len() > 8 {
        fill_long(run, word);
    } else {
        fill_short(run, word, |_, _| {});
    }
}

/// Fills a run of up to 8 words, or what is longer by `long`.
#[inline(always)]
fn fill_short<W: Copy>(run: &mut [W], word: W, long: impl FnOnce(&mut [W], W)) {
    match run {
        [] => {}
        [a] => *a = word,
        [a, b] => (*a, *b) = (word, word),
        [a, b, c] => (*a, *b, *c) = (word, word, word),
        [a, b, c, d] => (*a, *b, *c, *d) = (word, word, word, word),
        [a, b, c, d, e] => (*a, *b, *c, *d, *e) = (word, word, word, word, word),
        [a, b, c, d, e, f] => {
            (*a, *b, *c, *d, *e, *f) = (word, word, word, word, word, word);
        }
        [a, b, c, d, e, f, g] => {
            (*a, *b, *c, *d, *e, *f, *g) = (word, word, word, word, word, word, word);
        }
        [a, b, c, d, e, f, g, h] => {
            (*a, *b, *c, *d, *e, *f, *g, *h) = (word, word, word, word, word, word, word, word);
        }
        _ => long(run, word),
    }
}

/// Fills a run by 32 bits at a time, where words of 8, 16 or 32 bits make those.
#[inline(never)]
fn fill_long<W: Pod>(run: &mut [W], word: W) {
    let four = bytemuck::try_cast::<[W; 4], u32>([word; 4]);
    let two = bytemuck::try_cast::<[W; 2], u32>([word; 2]);
    let one = bytemuck::try_cast::<W, u32>(word);
    let Ok(block) = four.or(two).or(one) else {
        run.fill(word);
        return;
    };
    let (head, body, tail) = bytemuck::pod_align_to_mut::<W, u32>(run);
    head.iter_mut().for_each(|w| *w = word);
    let mut blocks = body.chunks_exact_mut(16);
    for sixteen in &mut blocks {
        let (first, second) = sixteen.split_at_mut(8);
        fill_short(first, block, |_, _| {});
        fill_short(second, block, |_, _| {});
        // Nothing; but with it the loop is not unrolled, which costs more before and after it.
        core::hint::black_box(());
    }
    let mut rest = blocks.into_remainder().chunks_exact_mut(8);
    if let Some(eight) = rest.next() {
        fill_short(eight, block, |_, _| {});
    }
    fill_short(rest.into_remainder(), block, |_, _| {});
    tail.iter_mut().for_each(|w| *w = word);
}

/// The run of `x0 .. x1` as an index and a length, for coordinates that the viewport has bounded.
#[inline]
pub(crate) fn run(x0: i32, x1: i32) -> (usize, usize) {
    (index(x0), index(x1 - x0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Rgb565, Rgb565Be};
    use std::string::ToString;

    #[test]
    fn sizes_are_checked() {
        let mut words = [0u16; 6];
        assert!(Framebuffer::<Rgb565>::try_new(&mut words, 3, 2).is_ok());
        let error = Framebuffer::<Rgb565>::try_new(&mut words, 3, 3).unwrap_err();
        assert_eq!(error, BufferSize::Words { needed: 9, got: 6 });
        assert_eq!(error.to_string(), "a buffer of 9 pixels in 6 words: a word a pixel is needed");
        assert!(Framebuffer::<Rgb565>::try_new(&mut words, 0, 3).is_err());
        let error = Framebuffer::<Rgb565>::try_new(&mut words, u32::MAX, u32::MAX).unwrap_err();
        assert!(matches!(error, BufferSize::Sides { .. }));
    }

    #[test]
    fn runs_are_written_where_they_belong() {
        let mut words = [0u16; 6];
        let mut buffer = Framebuffer::<Rgb565Be>::try_new(&mut words, 3, 2).unwrap();
        buffer.fill(1, 0, 2, Rgb565(0x1234));
        buffer.write(0, 1, [Some(Rgb565(1)), None, Some(Rgb565(2))].into_iter());
        assert_eq!(buffer.bytes(), [0, 0, 0x12, 0x34, 0x12, 0x34, 0, 1, 0, 0, 0, 2]);
        assert_eq!(buffer.pixel(2, 1), Some(Rgb565(2)));
        assert_eq!(buffer.pixel(3, 0), None);
        buffer.fill(2, 1, 2, Rgb565(7));
        assert_eq!(buffer.into_words()[5], 2u16.to_be());
    }
}

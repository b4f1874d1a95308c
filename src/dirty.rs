//! The dirty rectangle: what changed since the last frame, so that only that is sent.

use crate::framebuffer::{Runs, Target};
use crate::math::index;
use crate::traversal::Scan;
use crate::vertex::Rect;
use bytemuck::Pod;

/// A target around another that keeps the rectangle of what changed in it, and clears no more than was drawn.
///
/// Drawing goes on to the inner target at its speed; what is added is a few comparisons a run of pixels. At the end of a frame
/// [`changed`](Self::changed) says what is to be sent: what was drawn, and what was cleared of the frame before.
///
/// The rectangle holds every pixel that changed, in the target's own pixels (a band's first row is 0). It is as small as
/// one can be around what was drawn, where pixels of a triangle that its depth hides are taken for drawn.
///
/// In bands, whose buffers hold other bands' rows, it is [`drawn`](Self::drawn) that is kept for each band: what is to be sent of
/// a band is that of this frame and that of the last, [`united`](Rect::union).
///
/// ```
/// use hither::{ClipVertex, Dirty, Flat, Frame, Framebuffer, Gray8, I16F16};
///
/// let mut words = [0; 64 * 64];
/// let buffer = Framebuffer::<Gray8>::try_new(&mut words, 64, 64)?;
/// let mut frame = Frame::new(Dirty::new(buffer))?;
/// let corner = |x: f32, y: f32| {
///     let [x, y] = [x, y].map(I16F16::from_num);
///     (ClipVertex::new(x, y, I16F16::ZERO, I16F16::ONE), [])
/// };
/// for step in 0..3 {
///     let x = step as f32 / 4.0;
///     frame.clear(Gray8::BLACK);
///     frame.draw_triangle([corner(x, 0.0), corner(x + 0.25, 0.0), corner(x, 0.25)], &Flat(Gray8(9)));
///     let changed = frame.target_mut().changed();
///     // All of it at first; then where the triangle was and is.
///     let columns = [(0, 64), (32, 47), (40, 55)];
///     assert_eq!((changed.x0, changed.x1), columns[step]);
///     for row in frame.target().inner().rect_bytes(changed) {
///         // To the display's window of this rectangle.
///         assert_eq!(row.len(), (changed.x1 - changed.x0) as usize);
///     }
/// }
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Dirty<T: Target> {
    inner: T,
    /// What was drawn since it was last asked what changed, or cleared.
    now: Bounds,
    /// What was drawn before that, since it was last cleared.
    before: Bounds,
    /// What was cleared since it was last asked what changed.
    cleared: Bounds,
    /// What all is that was not drawn since.
    color: Option<T::Color>,
}

/// A rectangle that grows. Empty where no pixel was added.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Bounds {
    x0: usize,
    y0: usize,
    x1: usize,
    y1: usize,
}

impl Bounds {
    const EMPTY: Self = Self { x0: usize::MAX, y0: usize::MAX, x1: 0, y1: 0 };

    /// With pixels `x0 .. x1` of row `y`, of which there is one.
    #[inline]
    fn add(&mut self, x0: usize, x1: usize, y: usize) {
        self.x0 = self.x0.min(x0);
        self.x1 = self.x1.max(x1);
        self.y0 = self.y0.min(y);
        self.y1 = self.y1.max(y + 1);
    }

    #[inline]
    fn union(self, other: Self) -> Self {
        Self {
            x0: self.x0.min(other.x0),
            y0: self.y0.min(other.y0),
            x1: self.x1.max(other.x1),
            y1: self.y1.max(other.y1),
        }
    }

    fn whole((width, height): (u32, u32)) -> Self {
        Self { x0: 0, y0: 0, x1: width as usize, y1: height as usize }
    }

    /// As coordinates. Those of a target's pixels are below 2^31.
    fn rect(self) -> Rect {
        if self.x0 >= self.x1 {
            return Rect { x0: 0, y0: 0, x1: 0, y1: 0 };
        }
        let side = |v: usize| i32::try_from(v).unwrap_or(i32::MAX);
        Rect { x0: side(self.x0), y0: side(self.y0), x1: side(self.x1), y1: side(self.y1) }
    }
}

impl<T: Target> Dirty<T> {
    /// A target of which nothing is known: its first [`clear`](Target::clear) fills all of it.
    pub const fn new(inner: T) -> Self {
        let [now, before, cleared] = [Bounds::EMPTY; 3];
        Self { inner, now, before, cleared, color: None }
    }

    /// The rectangle of what changed since this was last asked, drawn or cleared; empty where nothing did. In the target's
    /// pixels.
    pub fn changed(&mut self) -> Rect {
        let changed = self.now.union(self.cleared);
        self.before = self.before.union(self.now);
        self.now = Bounds::EMPTY;
        self.cleared = Bounds::EMPTY;
        changed.rect()
    }

    /// The rectangle of what was drawn since the last [`clear`](Target::clear): all that may differ from its colour. In the
    /// target's pixels.
    #[must_use]
    pub fn drawn(&self) -> Rect {
        self.now.union(self.before).rect()
    }

    /// The target inside, to read or send.
    #[must_use]
    pub const fn inner(&self) -> &T {
        &self.inner
    }

    /// The target inside, for other drawing into it, such as text, none of it outside of a rectangle, which is taken for
    /// drawn.
    pub fn inner_within(&mut self, rect: Rect) -> &mut T {
        let (width, height) = self.inner.size();
        let side = |v: i32, size: u32| usize::try_from(v).unwrap_or(0).min(size as usize);
        let (x0, x1) = (side(rect.x0, width), side(rect.x1, width));
        let (y0, y1) = (side(rect.y0, height), side(rect.y1, height));
        if x0 < x1 && y0 < y1 {
            self.now = self.now.union(Bounds { x0, y0, x1, y1 });
        }
        &mut self.inner
    }

    /// The target inside back.
    pub fn into_inner(self) -> T {
        self.inner
    }
}

impl<T: Target<Color: PartialEq>> Target for Dirty<T> {
    type Color = T::Color;
    const MERGES: bool = T::MERGES;

    #[inline]
    fn size(&self) -> (u32, u32) {
        self.inner.size()
    }

    #[inline]
    fn write(&mut self, x: usize, y: usize, colors: impl Iterator<Item = Option<T::Color>>) {
        let now = &mut self.now;
        let mut at = x;
        let colors = colors.inspect(move |color| {
            if color.is_some() {
                now.add(at, at + 1, y);
            }
            at += 1;
        });
        self.inner.write(x, y, colors);
    }

    #[inline(always)]
    fn write_each<L, const CHUNK: usize>(
        &mut self,
        (x, y, at): (usize, usize, usize),
        lanes: &mut [L],
        color: impl FnMut(&mut L, bool) -> Option<T::Color>,
    ) {
        if !lanes.is_empty() {
            self.now.add(x, x + lanes.len(), y);
        }
        self.inner.write_each::<L, CHUNK>((x, y, at), lanes, color);
    }

    #[inline(always)]
    fn write_bent<L: Pod>(
        &mut self,
        (x, y, at): (usize, usize, usize),
        lanes: &mut [L],
        runs: impl Runs<L, T::Color>,
    ) {
        if !lanes.is_empty() {
            self.now.add(x, x + lanes.len(), y);
        }
        self.inner.write_bent((x, y, at), lanes, runs);
    }

    #[inline]
    fn fill(&mut self, x: usize, y: usize, length: usize, color: T::Color) {
        if length > 0 {
            self.now.add(x, x + length, y);
        }
        self.inner.fill(x, y, length, color);
    }

    #[inline(always)]
    fn fill_rows(
        &mut self,
        x: usize,
        y: usize,
        runs: impl Iterator<Item = (i32, i32)>,
        color: T::Color,
    ) {
        let runs = recorded(&mut self.now, (x, y), 0, runs);
        self.inner.fill_rows(x, y, runs, color);
    }

    #[inline(always)]
    fn fill_runs(
        &mut self,
        x: usize,
        y: usize,
        runs: impl Iterator<Item = (i32, i32)>,
        color: T::Color,
    ) {
        let (width, _) = self.inner.size();
        let runs = recorded(&mut self.now, (x, y), width as usize, runs);
        self.inner.fill_runs(x, y, runs, color);
    }

    #[inline(always)]
    fn write_runs<L, P>(
        &mut self,
        (x, y, at): (usize, usize, usize),
        lanes: &mut [L],
        runs: impl Iterator<Item = (i32, i32)>,
        row: impl FnMut(i32, i32) -> P,
    ) where
        P: FnMut(&mut L) -> Option<T::Color>,
    {
        let (width, _) = self.inner.size();
        let runs = recorded(&mut self.now, (x, y), width as usize, runs);
        self.inner.write_runs((x, y, at), lanes, runs, row);
    }

    #[inline(always)]
    fn write_scan<L>(
        &mut self,
        (x, y): (usize, usize),
        lanes: &mut [L],
        scan: Scan,
        mut color: impl FnMut(&mut L, &Scan) -> Option<T::Color>,
    ) {
        let now = &mut self.now;
        self.inner.write_scan((x, y), lanes, scan, |lane, scan| {
            let color = color(lane, scan);
            if color.is_some() {
                let (column, row) = scan.place();
                let (x, y) = (x + index(column), y + index(row));
                now.add(x, x + 1, y);
            }
            color
        });
    }

    /// Fills with a colour what was drawn, if all else is of that colour since the last time; otherwise all of it.
    fn clear(&mut self, color: T::Color) {
        let whole = Bounds::whole(self.inner.size());
        let same = self.color == Some(color) && !T::MERGES;
        let drawn = if same { self.now.union(self.before) } else { whole };
        if drawn == whole {
            self.inner.clear(color);
        } else {
            for y in drawn.y0..drawn.y1 {
                self.inner.fill(drawn.x0, y, drawn.x1 - drawn.x0, color);
            }
        }
        self.color = Some(color);
        self.cleared = self.cleared.union(drawn);
        self.now = Bounds::EMPTY;
        self.before = Bounds::EMPTY;
    }
}

/// Runs a row from `(x, y)` down, as they are, and within the bounds; each row `back` pixels further left.
#[inline(always)]
fn recorded(
    bounds: &mut Bounds,
    (x, y): (usize, usize),
    back: usize,
    runs: impl Iterator<Item = (i32, i32)>,
) -> impl Iterator<Item = (i32, i32)> {
    let (mut x, mut y) = (x, y);
    runs.inspect(move |&(x0, x1)| {
        if x0 < x1 {
            // Of a later row the first may be left of 0, and the run is not.
            bounds.add(x.wrapping_add(index(x0)), x.wrapping_add(index(x1)), y);
        }
        x = x.wrapping_sub(back);
        y += 1;
    })
}

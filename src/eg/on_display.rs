//! Any draw target of embedded-graphics as a target of spans.

use super::DisplayColor;
use crate::draw::Frame;
use crate::framebuffer::Target;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;

/// A display, or any other draw target of embedded-graphics, as a [`Target`]: each run of pixels is one
/// `fill_solid`, or one `fill_contiguous` where its colours differ, up to 64 pixels at a time.
///
/// Pixel (0, 0) is the top left of its bounding box, wherever that is, and what is outside of the box is not
/// drawn. Colours are those that [`DisplayColor`] tells of the display's.
///
/// Drawing cannot fail, but displays can: the first error is kept, nothing is drawn after it, and
/// [`finish`](Self::finish) hands it out. The last run waits for pixels that go on from it until it is finished or dropped.
///
/// ```
/// use embedded_graphics_core::prelude::*;
/// use embedded_graphics_core::{pixelcolor, primitives::Rectangle};
/// use hither::{ClipVertex, Flat, Frame, I16F16, OnDisplay, Rgb565};
///
/// /// Notes what a display of 8 x 4 pixels is asked to fill.
/// struct Display(Vec<(i32, i32, u32)>);
///
/// impl OriginDimensions for Display {
///     fn size(&self) -> Size {
///         Size::new(8, 4)
///     }
/// }
///
/// impl DrawTarget for Display {
///     type Color = pixelcolor::Rgb565;
///     type Error = core::convert::Infallible;
///
///     fn draw_iter<I: IntoIterator<Item = Pixel<Self::Color>>>(
///         &mut self,
///         _: I,
///     ) -> Result<(), Self::Error> {
///         unreachable!("no pixel is drawn by itself")
///     }
///
///     fn fill_solid(&mut self, area: &Rectangle, _: Self::Color) -> Result<(), Self::Error> {
///         self.0.push((area.top_left.x, area.top_left.y, area.size.width));
///         Ok(())
///     }
/// }
///
/// let mut display = Display(Vec::new());
/// let mut frame = Frame::new(OnDisplay::new(&mut display))?;
/// let corner = |x: i32, y: i32| {
///     let [x, y] = [x, y].map(I16F16::from_num);
///     (ClipVertex::new(x, y, I16F16::ZERO, I16F16::ONE), [])
/// };
/// frame.draw_triangle([corner(-1, -1), corner(1, -1), corner(-1, 1)], &Flat(Rgb565::RED));
/// frame.finish()?;
/// assert_eq!(display.0, [(0, 0, 1), (0, 1, 3), (0, 2, 5), (0, 3, 7)]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug)]
#[must_use = "`finish` tells whether the display failed"]
pub struct OnDisplay<'a, D: DrawTarget> {
    display: &'a mut D,
    /// The bounding box, which is the same while the display is borrowed.
    area: Rectangle,
    run: Option<Run<D::Color>>,
    error: Option<D::Error>,
}

/// Pixels of a row, side by side, that are not drawn yet.
#[derive(Debug)]
struct Run<C> {
    x: usize,
    y: usize,
    length: usize,
    colors: Colors<C>,
}

/// The colours of a run.
#[derive(Debug)]
enum Colors<C> {
    /// All are this one.
    One(C),
    /// A colour a pixel, as many as the run is long.
    Each([C; LONGEST]),
}

/// Pixels of a run of different colours, at the most: where a window of an SPI display is set by 11 bytes, that is 9 % of
/// what is sent.
const LONGEST: usize = 64;

impl<C: Copy + PartialEq> Run<C> {
    /// Takes the pixel, if the run goes on with it and has room.
    #[inline]
    fn takes(&mut self, x: usize, y: usize, color: C) -> bool {
        if y != self.y || x != self.x + self.length {
            return false;
        }
        match &mut self.colors {
            Colors::One(one) if *one == color => {}
            Colors::One(one) => {
                let mut colors = [*one; LONGEST];
                let Some(last) = colors.get_mut(self.length) else {
                    return false;
                };
                *last = color;
                self.colors = Colors::Each(colors);
            }
            Colors::Each(colors) => {
                let Some(last) = colors.get_mut(self.length) else {
                    return false;
                };
                *last = color;
            }
        }
        self.length += 1;
        true
    }
}

impl<'a, D: DrawTarget> OnDisplay<'a, D> {
    /// A target over all of a display's bounding box.
    pub fn new(display: &'a mut D) -> Self {
        let area = display.bounding_box();
        Self { display, area, run: None, error: None }
    }

    /// Draws what waits, and tells whether the display failed.
    ///
    /// # Errors
    ///
    /// The display's own, the first one.
    pub fn finish(mut self) -> Result<(), D::Error> {
        self.flush();
        self.error.take().map_or(Ok(()), Err)
    }

    /// Draws a pixel, or has it wait for those that go on from it.
    #[inline]
    fn draw(&mut self, x: usize, y: usize, color: D::Color) {
        if !self.run.as_mut().is_some_and(|run| run.takes(x, y, color)) {
            self.flush();
            self.run = Some(Run { x, y, length: 1, colors: Colors::One(color) });
        }
    }

    /// Draws what waits.
    #[inline(never)]
    fn flush(&mut self) {
        if let Some(Run { x, y, length, colors }) = &self.run {
            let row = self.row(*x, *y, *length);
            if self.error.is_none() {
                let drawn = match colors {
                    Colors::One(color) => self.display.fill_solid(&row, *color),
                    Colors::Each(colors) => {
                        self.display.fill_contiguous(&row, colors.iter().copied().take(*length))
                    }
                };
                self.error = drawn.err();
            }
            self.run = None;
        }
    }

    /// The place of pixels of a row on the display.
    #[inline]
    fn row(&self, x: usize, y: usize, length: usize) -> Rectangle {
        let Point { x: left, y: top } = self.area.top_left;
        let from = |start: i32, v: usize| {
            start.saturating_add_unsigned(u32::try_from(v).unwrap_or(u32::MAX))
        };
        let width = u32::try_from(length).unwrap_or(u32::MAX);
        Rectangle::new(Point::new(from(left, x), from(top, y)), Size::new(width, 1))
    }
}

impl<D> Target for OnDisplay<'_, D>
where
    D: DrawTarget,
    D::Color: DisplayColor,
{
    type Color = <D::Color as DisplayColor>::Drawn;

    #[inline]
    fn size(&self) -> (u32, u32) {
        (self.area.size.width, self.area.size.height)
    }

    #[inline]
    fn write(&mut self, x: usize, y: usize, colors: impl Iterator<Item = Option<Self::Color>>) {
        // To the end, also when the display has failed: what yields colours may count them.
        for (x, color) in (x..).zip(colors) {
            if let Some(color) = color {
                self.draw(x, y, color.into());
            }
        }
    }

    #[inline]
    fn fill(&mut self, x: usize, y: usize, length: usize, color: Self::Color) {
        self.flush();
        if self.error.is_none() {
            let row = self.row(x, y, length);
            self.error = self.display.fill_solid(&row, color.into()).err();
        }
    }

    fn clear(&mut self, color: Self::Color) {
        // What waits would be cleared.
        self.run = None;
        if self.error.is_none() {
            self.error = self.display.clear(color.into()).err();
        }
    }
}

/// What waits is drawn; whether that fails is not told.
impl<D: DrawTarget> Drop for OnDisplay<'_, D> {
    fn drop(&mut self) {
        self.flush();
    }
}

impl<D: DrawTarget, Z, W, T, I, const P: usize> Frame<OnDisplay<'_, D>, Z, W, T, I, P> {
    /// Draws what waits, and tells whether the display failed.
    ///
    /// # Errors
    ///
    /// The display's own, the first one; what came after it is not drawn.
    pub fn finish(self) -> Result<(), D::Error> {
        let (target, _) = self.into_parts();
        target.finish()
    }
}

//! What the peers draw into.

use core::convert::Infallible;
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::pixelcolor::raw::RawU16;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use hither::{Framebuffer, Target};
use hither_scenes::workloads::{PIXELS, SIDE};

/// Pixels of a row, and rows.
const COUNT: usize = SIDE as usize;

/// The picture in RAM: a word a pixel, rows as slices, runs filled as hither fills them. Neither peer calls
/// `fill_contiguous` for a triangle, so that is left as it comes.
pub struct Screen<'a> {
    rows: &'a mut [[u16; COUNT]],
}

impl<'a> Screen<'a> {
    /// A picture over these words, which keep what they hold.
    pub fn new(words: &'a mut [u16; PIXELS]) -> Self {
        Self { rows: words.as_chunks_mut().0 }
    }

    /// The columns of an area and its rows, without what is outside of the picture.
    #[inline]
    fn rows(&mut self, area: &Rectangle) -> (usize, usize, &mut [[u16; COUNT]]) {
        // Both from 0 to `COUNT`, the start not after the end.
        let range = |start: i32, length: u32| {
            let end = start.saturating_add_unsigned(length);
            let clamp = |v: i32| v.clamp(0, COUNT as i32) as usize;
            (clamp(start), clamp(end))
        };
        let (x0, x1) = range(area.top_left.x, area.size.width);
        let (y0, y1) = range(area.top_left.y, area.size.height);
        (x0, x1, self.rows.get_mut(y0..y1).unwrap_or_default())
    }
}

impl OriginDimensions for Screen<'_> {
    fn size(&self) -> Size {
        Size::new(SIDE, SIDE)
    }
}

impl DrawTarget for Screen<'_> {
    type Color = Rgb565;
    type Error = Infallible;

    #[inline]
    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        for Pixel(Point { x, y }, color) in pixels {
            // A negative coordinate is a large one.
            let row = self.rows.get_mut(y as usize);
            if let Some(word) = row.and_then(|row| row.get_mut(x as usize)) {
                *word = word_of(color);
            }
        }
        Ok(())
    }

    #[inline]
    fn fill_solid(&mut self, area: &Rectangle, color: Rgb565) -> Result<(), Infallible> {
        let (x0, x1, rows) = self.rows(area);
        let color = hither::Rgb565(word_of(color));
        for row in rows {
            if let Ok(mut row) = Framebuffer::<hither::Rgb565>::try_new(row, SIDE, 1) {
                row.fill(x0, 0, x1 - x0, color);
            }
        }
        Ok(())
    }
}

/// A colour as it is stored.
#[inline]
fn word_of(color: Rgb565) -> u16 {
    RawU16::from(color).into_inner()
}

/// The same picture, pixel by pixel, with a count of the pixels that were drawn.
pub struct Counted<'a> {
    screen: Screen<'a>,
    /// Pixels drawn, as often as they were.
    pub pixels: usize,
}

impl<'a> Counted<'a> {
    /// A picture over these words, which keep what they hold.
    pub fn new(words: &'a mut [u16; PIXELS]) -> Self {
        Self { screen: Screen::new(words), pixels: 0 }
    }
}

impl OriginDimensions for Counted<'_> {
    fn size(&self) -> Size {
        self.screen.size()
    }
}

impl DrawTarget for Counted<'_> {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        let bounds = self.bounding_box();
        let drawn = &mut self.pixels;
        let inside = pixels.into_iter().filter(|pixel| bounds.contains(pixel.0));
        self.screen.draw_iter(inside.inspect(|_| *drawn += 1))
    }
}

//! A band as a draw target in the coordinates of its picture.

use crate::band::Band;
use crate::math::signed;
use embedded_graphics_core::Pixel;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point, Size};
use embedded_graphics_core::primitives::Rectangle;

/// A band's rows in the picture's coordinates, by [`Band::draw_target`]: what is drawn on each band of a picture is
/// on all of it.
#[derive(Debug)]
pub struct OnBand<'a, D> {
    target: &'a mut D,
    /// The picture's row that is the target's row 0.
    y: i32,
}

impl Band {
    /// What is drawn into at the picture's coordinates: text and icons land in the rows that this band has of them. `target`
    /// is the band's framebuffer, or any other draw target of its rows.
    ///
    /// ```
    /// use embedded_graphics_core::{pixelcolor, prelude::*, primitives::Rectangle};
    /// use hither::{Gray8, Viewport};
    ///
    /// let area = Rectangle::new(Point::new(1, 2), Size::new(3, 3));
    /// let (mut words, mut picture) = ([b' '; 5 * 2], Vec::new());
    /// for band in Viewport::new(5, 6)?.bands(words.len())? {
    ///     let mut buffer = band.framebuffer::<Gray8>(&mut words)?;
    ///     let mut target = band.draw_target(&mut buffer);
    ///     target.clear(pixelcolor::Gray8::new(b'.'))?;
    ///     target.fill_solid(&area, pixelcolor::Gray8::new(b'#'))?;
    ///     picture.extend_from_slice(&words);
    /// }
    /// let rows: Vec<_> = picture.chunks(5).map(|row| core::str::from_utf8(row).unwrap()).collect();
    /// assert_eq!(rows, [
    ///     ".....",
    ///     ".....",
    ///     ".###.",
    ///     ".###.",
    ///     ".###.",
    ///     ".....",
    /// ]);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    #[must_use]
    pub fn draw_target<'a, D: DrawTarget>(&self, target: &'a mut D) -> OnBand<'a, D> {
        OnBand { target, y: signed(self.y()) }
    }
}

impl<D> OnBand<'_, D> {
    /// An area of the picture in the target, without the rows whose place there no coordinate can say.
    #[inline]
    fn area(&self, area: &Rectangle) -> Rectangle {
        let Rectangle { top_left: Point { x, y }, size } = *area;
        let lost = i64::from(self.y) - (i64::from(y) - i64::from(i32::MIN));
        let lost = u32::try_from(lost).unwrap_or(0).min(size.height);
        Rectangle::new(up(Point::new(x, y), self.y), Size::new(size.width, size.height - lost))
    }
}

/// The point so many rows up.
#[inline]
const fn up(point: Point, rows: i32) -> Point {
    Point::new(point.x, point.y.saturating_sub(rows))
}

impl<D: Dimensions> Dimensions for OnBand<'_, D> {
    /// The band's rows, at their place in the picture.
    fn bounding_box(&self) -> Rectangle {
        let Rectangle { top_left: Point { x, y }, size } = self.target.bounding_box();
        Rectangle::new(Point::new(x, y.saturating_add(self.y)), size)
    }
}

impl<D: DrawTarget> DrawTarget for OnBand<'_, D> {
    type Color = D::Color;
    type Error = D::Error;

    #[inline]
    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), D::Error>
    where
        I: IntoIterator<Item = Pixel<D::Color>>,
    {
        let y = self.y;
        self.target
            .draw_iter(pixels.into_iter().map(|Pixel(point, color)| Pixel(up(point, y), color)))
    }

    #[inline]
    fn fill_contiguous<I>(&mut self, area: &Rectangle, colors: I) -> Result<(), D::Error>
    where
        I: IntoIterator<Item = D::Color>,
    {
        // Rows that would be above what a coordinate can say: their colours are passed over.
        let moved = self.area(area);
        let lost = area.size.height - moved.size.height;
        let lost = u64::from(lost) * u64::from(area.size.width);
        let lost = usize::try_from(lost).unwrap_or(usize::MAX);
        self.target.fill_contiguous(&moved, colors.into_iter().skip(lost))
    }

    #[inline]
    fn fill_solid(&mut self, area: &Rectangle, color: D::Color) -> Result<(), D::Error> {
        self.target.fill_solid(&self.area(area), color)
    }

    #[inline]
    fn clear(&mut self, color: D::Color) -> Result<(), D::Error> {
        self.target.clear(color)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Gray8;
    use crate::vertex::Viewport;
    use embedded_graphics_core::pixelcolor;
    use std::vec::Vec;

    /// Colours of rows of four, without end, of which any number is passed over at once.
    struct Rows(u64);

    impl Iterator for Rows {
        type Item = pixelcolor::Gray8;

        fn next(&mut self) -> Option<pixelcolor::Gray8> {
            self.nth(0)
        }

        fn nth(&mut self, n: usize) -> Option<pixelcolor::Gray8> {
            self.0 += n as u64 + 1;
            Some(pixelcolor::Gray8::new(((self.0 - 1) / 4 % 251) as u8))
        }
    }

    /// An area that begins where coordinates do: each row of a picture has its own colour, in bands too.
    #[test]
    fn colours_stay_in_their_rows_from_the_first_coordinate_on() {
        let picture = Viewport::new(4, 8).unwrap();
        let area = Rectangle::new(Point::new(0, i32::MIN), Size::new(4, u32::MAX));
        let mut shown = Vec::new();
        let mut words = [0; 4 * 2];
        for band in picture.bands(words.len()).unwrap() {
            let mut buffer = band.framebuffer::<Gray8>(&mut words).unwrap();
            let mut target = band.draw_target(&mut buffer);
            target.fill_contiguous(&area, Rows(0)).unwrap();
            shown.extend_from_slice(&words);
        }
        // Row 0 of the picture is 2^31 below the area's first.
        let expected: Vec<u8> =
            (0..8u64).flat_map(|y| [(((1 << 31) + y) % 251) as u8; 4]).collect();
        assert_eq!(shown, expected);
    }
}

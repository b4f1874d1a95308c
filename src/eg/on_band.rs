//! A band as a draw target in the coordinates of its picture.

use crate::band::Band;
use crate::math::signed;
use embedded_graphics_core::Pixel;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point};
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
    /// An area of the picture in the target.
    #[inline]
    fn area(&self, area: &Rectangle) -> Rectangle {
        Rectangle::new(up(area.top_left, self.y), area.size)
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
        self.target.fill_contiguous(&self.area(area), colors)
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

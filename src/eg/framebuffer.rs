//! Framebuffers as draw targets of embedded-graphics: text and icons over 3D.

use super::AsPixelColor;
use crate::color::PixelFormat;
use crate::framebuffer::{Framebuffer, Target};
use core::convert::Infallible;
use core::ops::Range;
use embedded_graphics_core::Pixel;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Size};
use embedded_graphics_core::primitives::Rectangle;

impl<F: PixelFormat> OriginDimensions for Framebuffer<'_, F> {
    #[inline]
    fn size(&self) -> Size {
        let (width, height) = Target::size(self);
        Size::new(width, height)
    }
}

/// What is outside of the buffer is not drawn.
///
/// ```
/// use embedded_graphics_core::{pixelcolor, prelude::*, primitives::Rectangle};
/// use hither::{Framebuffer, Gray8};
///
/// let mut words = [b' '; 8 * 4];
/// let mut buffer = Framebuffer::<Gray8>::try_new(&mut words, 8, 4)?;
/// let area = Rectangle::new(Point::new(5, -1), Size::new(9, 3));
/// buffer.fill_solid(&area, pixelcolor::Gray8::new(b'#'))?;
/// let rows: Vec<_> = words.chunks(8).map(|row| core::str::from_utf8(row).unwrap()).collect();
/// assert_eq!(rows, [
///     "     ###",
///     "     ###",
///     "        ",
///     "        ",
/// ]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
impl<F: PixelFormat<Color: AsPixelColor>> DrawTarget for Framebuffer<'_, F> {
    type Color = <F::Color as AsPixelColor>::PixelColor;
    type Error = Infallible;

    #[inline]
    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Pixel<Self::Color>>,
    {
        let (width, height) = Target::size(self);
        for Pixel(point, color) in pixels {
            let (Ok(x), Ok(y)) = (u32::try_from(point.x), u32::try_from(point.y)) else {
                continue;
            };
            if x < width && y < height {
                if let Some(word) = self.from(x as usize, y as usize).first_mut() {
                    *word = F::encode(color.into());
                }
            }
        }
        Ok(())
    }

    fn fill_contiguous<I>(&mut self, area: &Rectangle, colors: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Self::Color>,
    {
        let Part { columns, rows, before } = Part::of(area, Target::size(self));
        if columns.is_empty() {
            return Ok(());
        }
        let mut colors = colors.into_iter().fuse();
        let mut gap = before;
        for y in rows {
            if skip(&mut colors, gap).is_none() {
                break;
            }
            let seen = colors.by_ref().take(columns.len()).map(|color| Some(color.into()));
            self.write(columns.start, y, seen);
            gap = u64::from(area.size.width) - columns.len() as u64;
        }
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, color: Self::Color) -> Result<(), Infallible> {
        let (width, height) = Target::size(self);
        let Part { columns, rows, .. } = Part::of(area, (width, height));
        let color = color.into();
        if columns.len() == width as usize {
            // One run: rows have no padding.
            self.fill(0, rows.start, columns.len() * rows.len(), color);
        } else {
            for y in rows {
                self.fill(columns.start, y, columns.len(), color);
            }
        }
        Ok(())
    }

    fn clear(&mut self, color: Self::Color) -> Result<(), Infallible> {
        Target::clear(self, color.into());
        Ok(())
    }
}

/// What a buffer holds of an area: no columns and no rows where that is nothing.
struct Part {
    columns: Range<usize>,
    rows: Range<usize>,
    /// The area's pixels before its first one, row by row.
    before: u64,
}

impl Part {
    fn of(area: &Rectangle, (width, height): (u32, u32)) -> Self {
        let (columns, left) = held(area.top_left.x, area.size.width, width);
        let (rows, above) = held(area.top_left.y, area.size.height, height);
        if columns.is_empty() || rows.is_empty() {
            return Self { columns: 0..0, rows: 0..0, before: 0 };
        }
        let before = u64::from(above) * u64::from(area.size.width) + u64::from(left);
        Self { columns, rows, before }
    }
}

/// What a side of `side` pixels holds of `length` from `start` on, and how many are before it.
fn held(start: i32, length: u32, side: u32) -> (Range<usize>, u32) {
    let (first, before) = match u32::try_from(start) {
        Ok(first) => (first, 0),
        Err(_) => (0, start.unsigned_abs()),
    };
    let end = first.saturating_add(length.saturating_sub(before)).min(side);
    (first as usize..end as usize, before)
}

/// Drops so many; `None` where there are fewer.
fn skip(colors: &mut impl Iterator, count: u64) -> Option<()> {
    let mut left = count;
    while left > 0 {
        let step = usize::try_from(left).unwrap_or(usize::MAX);
        colors.nth(step - 1)?;
        left -= step as u64;
    }
    Some(())
}

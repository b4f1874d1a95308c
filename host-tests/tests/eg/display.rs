//! Draw targets: one that checks what it is asked for, and one that does the least there is.

use embedded_graphics::pixelcolor::PixelColor;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use std::convert::Infallible;

/// What a display was asked to fill.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Call {
    pub solid: bool,
    pub area: Rectangle,
}

/// A display whose box may be anywhere. It takes whole areas that are inside of it, and as many colours as they have.
#[derive(Debug)]
pub struct Panel<C> {
    area: Rectangle,
    pixels: Vec<Option<C>>,
    pub calls: Vec<Call>,
    /// Calls before the first one that fails; it and all after it do.
    pub works: usize,
}

impl<C: PixelColor> Panel<C> {
    pub fn new(area: Rectangle) -> Self {
        let pixels = vec![None; (area.size.width * area.size.height) as usize];
        Self { area, pixels, calls: Vec::new(), works: usize::MAX }
    }

    /// The pixel in column `x` and row `y` of the box.
    pub fn pixel(&self, x: u32, y: u32) -> Option<C> {
        self.pixels[(y * self.area.size.width + x) as usize]
    }

    fn fill(
        &mut self,
        solid: bool,
        area: &Rectangle,
        mut colors: impl Iterator<Item = C>,
    ) -> Result<(), usize> {
        let Size { width, height } = area.size;
        let inside = |start: i32, length: u32, own: i32, side: u32| {
            let first = i64::from(start) - i64::from(own);
            assert!(length > 0, "an empty area: {area:?}");
            assert!(
                first >= 0 && first + i64::from(length) <= i64::from(side),
                "outside: {area:?}"
            );
            first as usize
        };
        let Rectangle { top_left, size } = self.area;
        let left = inside(area.top_left.x, width, top_left.x, size.width);
        let top = inside(area.top_left.y, height, top_left.y, size.height);
        let number = self.calls.len();
        self.calls.push(Call { solid, area: *area });
        if number >= self.works {
            return Err(number);
        }
        for row in top..top + height as usize {
            let start = row * size.width as usize + left;
            for pixel in &mut self.pixels[start..start + width as usize] {
                *pixel = Some(colors.next().expect("a colour a pixel"));
            }
        }
        assert!(solid || colors.next().is_none(), "more colours than pixels: {area:?}");
        Ok(())
    }
}

impl<C: PixelColor> Dimensions for Panel<C> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: PixelColor> DrawTarget for Panel<C> {
    type Color = C;
    /// The number of the call.
    type Error = usize;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, _: I) -> Result<(), usize> {
        panic!("pixel by pixel")
    }

    fn fill_contiguous<I>(&mut self, area: &Rectangle, colors: I) -> Result<(), usize>
    where
        I: IntoIterator<Item = C>,
    {
        self.fill(false, area, colors.into_iter())
    }

    fn fill_solid(&mut self, area: &Rectangle, color: C) -> Result<(), usize> {
        self.fill(true, area, std::iter::repeat(color))
    }
}

/// A picture that is drawn pixel by pixel, by what embedded-graphics makes of that; pixels outside are ignored.
#[derive(Clone, Debug, PartialEq)]
pub struct Plain<C> {
    size: Size,
    pub pixels: Vec<C>,
}

impl<C: PixelColor> Plain<C> {
    pub fn new(width: u32, height: u32, color: C) -> Self {
        let pixels = vec![color; (width * height) as usize];
        Self { size: Size::new(width, height), pixels }
    }
}

impl<C> OriginDimensions for Plain<C> {
    fn size(&self) -> Size {
        self.size
    }
}

impl<C: PixelColor> DrawTarget for Plain<C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(point, color) in pixels {
            if self.bounding_box().contains(point) {
                self.pixels[(point.y * self.size.width as i32 + point.x) as usize] = color;
            }
        }
        Ok(())
    }
}

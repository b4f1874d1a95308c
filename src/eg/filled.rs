//! Shapes as drawables of embedded-graphics.

use super::color::AsPixelColor;
use super::{DisplayColor, OnDisplay};
use crate::blend::{Alpha, Mix, Over};
use crate::shape::{self, Shape};
use crate::vertex::Rect;
use embedded_graphics_core::Drawable;
use embedded_graphics_core::draw_target::DrawTarget;

/// What a shape is filled with, on a draw target of embedded-graphics.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fill<C> {
    /// Pixels whose centres are inside.
    Hard {
        /// Of all pixels.
        color: C,
    },
    /// Pixels that an edge cuts take the share of them that is inside, mixed with the background: a display cannot be read.
    Smooth {
        /// Of pixels that are wholly inside.
        color: C,
        /// What is drawn on, everywhere.
        over: C,
    },
}

/// A shape and what it is filled with, drawable on any draw target of embedded-graphics.
///
/// Corners are in the draw target's coordinates. What is outside of its bounding box is not drawn; runs of one colour are one
/// `fill_solid`, others `fill_contiguous`.
///
/// ```
/// use embedded_graphics_core::pixelcolor::Rgb565;
/// use embedded_graphics_core::prelude::*;
/// use hither::{Fill, Filled, Framebuffer, I16F16, Triangle};
///
/// # let mut words = [0; 64];
/// # let mut display = Framebuffer::<hither::Rgb565>::try_new(&mut words, 8, 8).unwrap();
/// let corners = [[0.5, 7.0], [7.5, 7.0], [4.0, 0.25]].map(|p| p.map(I16F16::from_num));
/// let fill = Fill::Smooth { color: Rgb565::RED, over: Rgb565::BLACK };
/// Filled::new(Triangle(corners), fill).draw(&mut display)?;
/// assert_eq!(display.pixel(4, 4), Some(hither::Rgb565::RED));
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Filled<S, C> {
    shape: S,
    fill: Fill<C>,
}

impl<S, C> Filled<S, C> {
    /// A shape, filled.
    #[must_use]
    pub const fn new(shape: S, fill: Fill<C>) -> Self {
        Self { shape, fill }
    }
}

impl<S: Shape, C> Drawable for Filled<S, C>
where
    C: DisplayColor<Drawn: Mix + AsPixelColor>,
    <C::Drawn as AsPixelColor>::PixelColor: From<C>,
{
    type Color = C;
    type Output = ();

    fn draw<D: DrawTarget<Color = C>>(&self, target: &mut D) -> Result<(), D::Error> {
        let area = target.bounding_box();
        let (x0, y0) = (area.top_left.x, area.top_left.y);
        let end = |start: i32, length: u32| start.saturating_add_unsigned(length);
        let window = Rect { x0, y0, x1: end(x0, area.size.width), y1: end(y0, area.size.height) };
        let origin = (-i64::from(x0), -i64::from(y0));
        let drawn = |color: C| C::Drawn::from(<C::Drawn as AsPixelColor>::PixelColor::from(color));
        let polygon = self.shape.polygon();
        let mut display = OnDisplay::new(target);
        match self.fill {
            Fill::Hard { color } => {
                shape::fill(&mut display, &polygon, window, origin, drawn(color));
                display.finish()
            }
            Fill::Smooth { color, over } => {
                let mut mixed = Over::new(display, drawn(over));
                let color = Alpha { color: drawn(color), alpha: u8::MAX };
                shape::fill_smooth(&mut mixed, &polygon, window, origin, color);
                mixed.into_target().finish()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Gray8;
    use crate::shape::Triangle;
    use core::convert::Infallible;
    use embedded_graphics_core::Pixel;
    use embedded_graphics_core::geometry::{Dimensions, Point, Size};
    use embedded_graphics_core::pixelcolor;
    use embedded_graphics_core::primitives::Rectangle;
    use fixed::types::I16F16;
    use std::vec::Vec;

    /// A display that is as large as coordinates go.
    struct Endless(Vec<(i32, i32, u32)>);

    impl Dimensions for Endless {
        fn bounding_box(&self) -> Rectangle {
            Rectangle::new(Point::new(i32::MIN, i32::MIN), Size::new(u32::MAX, u32::MAX))
        }
    }

    impl DrawTarget for Endless {
        type Color = pixelcolor::Gray8;
        type Error = Infallible;

        fn draw_iter<I: IntoIterator<Item = Pixel<Self::Color>>>(
            &mut self,
            _: I,
        ) -> Result<(), Infallible> {
            panic!("pixel by pixel")
        }

        fn fill_solid(&mut self, area: &Rectangle, _: Self::Color) -> Result<(), Infallible> {
            self.0.push((area.top_left.x, area.top_left.y, area.size.width));
            Ok(())
        }
    }

    #[test]
    fn shapes_are_where_they_are_on_a_display_without_end() {
        let corners = [[0, 0], [4, 0], [0, 4]].map(|p| p.map(I16F16::from_num));
        let color = Gray8::WHITE.into();
        let mut display = Endless(Vec::new());
        Filled::new(Triangle(corners), Fill::Hard { color }).draw(&mut display).unwrap();
        assert_eq!(display.0, [(0, 0, 3), (0, 1, 2), (0, 2, 1)]);
        let over = pixelcolor::Gray8::new(0);
        display.0.clear();
        let smooth = Filled::new(Triangle(corners), Fill::Smooth { color, over });
        smooth.draw(&mut display).unwrap();
        assert!(
            display.0.iter().all(|&(x, y, width)| x + width as i32 <= 4 && (0..4).contains(&y))
        );
    }
}

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
        let origin = (x0.saturating_neg(), y0.saturating_neg());
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

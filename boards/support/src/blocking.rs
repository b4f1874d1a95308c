//! A transfer that blocks: for drivers without DMA.

use core::task::{Context, Poll};
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor;
use embedded_graphics_core::primitives::Rectangle;
use hither::{Band, Rgb565, Transfer};

/// Sends each band whole before it returns, as one rectangle of a display: one buffer is enough, a
/// second gains nothing.
///
/// Words are [`Rgb565`] in the processor's byte order; the display's driver puts them into its own.
/// What of a picture is outside of the display is left out.
#[derive(Debug)]
pub struct Blocking<D, B> {
    display: D,
    sent: Option<B>,
}

impl<D, B> Blocking<D, B> {
    /// A transfer to a display.
    pub const fn new(display: D) -> Self {
        Self { display, sent: None }
    }
}

impl<D, B> Transfer for Blocking<D, B>
where
    D: DrawTarget<Color = pixelcolor::Rgb565>,
    B: AsMut<[u16]>,
{
    type Word = u16;
    type Buffer = B;
    type Error = D::Error;

    fn start(&mut self, band: &Band, buffer: B) -> Result<(), D::Error> {
        // It is kept first, so that an error does not lose it.
        let words = self.sent.insert(buffer).as_mut();
        let corner = Point::new(0, band.y() as i32);
        let area = Rectangle::new(corner, Size::new(band.viewport().width(), band.rows()));
        self.display.fill_contiguous(&area, words.iter().map(|&word| Rgb565(word).into()))
    }

    fn poll_finish(&mut self, _: &mut Context<'_>) -> Poll<Result<Option<B>, D::Error>> {
        Poll::Ready(Ok(self.sent.take()))
    }
}

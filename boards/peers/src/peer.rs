//! The crates that are measured, each by the call that draws one flat triangle.

use core::fmt::Debug;
use embedded_3dgfx::pipeline::rasterize::draw::fill_triangle_fixed;
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::{PrimitiveStyle, Triangle};

/// A crate that draws flat triangles.
pub trait Peer {
    /// As the line that is printed has it.
    const NAME: &'static str;

    /// Draws one triangle, its corners in any order.
    fn draw<T: DrawTarget<Color = Rgb565, Error: Debug>>(
        target: &mut T,
        corners: [Point; 3],
        color: Rgb565,
    );
}

/// `Triangle` with a fill colour and no stroke, of embedded-graphics.
pub struct EmbeddedGraphics;

impl Peer for EmbeddedGraphics {
    const NAME: &'static str = "embedded-graphics";

    #[inline]
    fn draw<T: DrawTarget<Color = Rgb565, Error: Debug>>(
        target: &mut T,
        [a, b, c]: [Point; 3],
        color: Rgb565,
    ) {
        let styled = Triangle::new(a, b, c).into_styled(PrimitiveStyle::with_fill(color));
        let _ = styled.draw(target);
    }
}

/// `fill_triangle_fixed` of embedded-3dgfx: of its flat triangles without depth the one with the fewest instructions.
/// It draws pixel by pixel; the target's checks fold into its loops.
pub struct Embedded3dgfx;

impl Peer for Embedded3dgfx {
    const NAME: &'static str = "embedded-3dgfx";

    #[inline]
    fn draw<T: DrawTarget<Color = Rgb565, Error: Debug>>(
        target: &mut T,
        [a, b, c]: [Point; 3],
        color: Rgb565,
    ) {
        fill_triangle_fixed(a, b, c, color, target);
    }
}

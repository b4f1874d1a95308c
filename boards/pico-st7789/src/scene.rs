//! What the firmwares draw: the spinning teapot, in the tier for boards.

use hither::{Framebuffer, PerspectiveEvery, PixelFormat, Quick, Rgb565, Vertex, Viewport};
use hither_scenes::SceneError;
use hither_scenes::spinning_teapot::{Drawn, Moment, draw_onto};

/// Frames a turn.
pub const FRAMES: u32 = 64;

/// Coordinates to 1/256 pixel.
pub type Tier = Quick<8>;

/// A transformed vertex, as the cache holds it.
pub type Cached = Vertex<Tier, 3>;

/// Draws what a buffer shows of the scene, all of it or a band; `depth` has a word a pixel.
///
/// # Errors
///
/// [`SceneError`] where there are fewer depth words than pixels.
pub fn draw<F: PixelFormat<Color = Rgb565>>(
    buffer: Framebuffer<'_, F>,
    viewport: Viewport,
    depth: &mut [u16],
    number: u32,
    cache: &mut [Cached],
) -> Result<Drawn, SceneError> {
    let moment = Moment { number, frames: FRAMES };
    draw_onto(buffer, viewport, (Quick::<8>, PerspectiveEvery::<16>), depth, moment, cache)
}

//! The frames of the spinning teapot, through a swap chain.

use hither::{FrameError, PerspectiveEvery, Quick, Rgb565, SwapChain, Transfer, Vertex, Viewport};
use hither_scenes::SceneError;
use hither_scenes::spinning_teapot::{Moment, VERTEX_COUNT, draw_onto};

/// Vertices, each transformed once a band.
pub type Cache = [Vertex<Quick<8>, 3>; VERTEX_COUNT];

const _: () = assert!(size_of::<Cache>() <= 21 * 1024, "the boards' RAM is budgeted with it");

/// Draws the spinning teapot, `Quick<8>` with perspective every 16 pixels, and sends it in bands.
pub struct Teapot<'a, T: Transfer<Word = u16>> {
    chain: SwapChain<T>,
    picture: Viewport,
    depth: &'a mut [u16],
    cache: &'a mut Cache,
}

/// Why a frame was not shown whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TeapotError<E> {
    /// A band could not be drawn.
    Scene(SceneError),
    /// A band could not be sent.
    Frame(FrameError<E>),
}

impl<'a, T: Transfer<Word = u16>> Teapot<'a, T> {
    /// Frames of a picture's size; `depth` has a word a pixel of a band.
    pub const fn new(
        chain: SwapChain<T>,
        picture: Viewport,
        depth: &'a mut [u16],
        cache: &'a mut Cache,
    ) -> Self {
        Self { chain, picture, depth, cache }
    }

    /// Draws a moment of the turn and sends it.
    ///
    /// # Errors
    ///
    /// The display's own; or what is wrong with the buffers, whose band then shows what was in them.
    pub fn frame(&mut self, moment: Moment) -> Result<(), TeapotError<T::Error>> {
        let Self { chain, picture, depth, cache } = self;
        let knobs = (Quick::<8>, PerspectiveEvery::<16>);
        let mut drawn = Ok(());
        let sent = chain.frame(picture, |band, words| {
            let band =
                band.framebuffer::<Rgb565>(words).map_err(SceneError::from).and_then(|target| {
                    draw_onto(target, band.viewport(), knobs, depth, moment, cache.as_mut_slice())
                });
            drawn = drawn.and(band.map(drop));
        });
        sent.map_err(TeapotError::Frame).and(drawn.map_err(TeapotError::Scene))
    }
}

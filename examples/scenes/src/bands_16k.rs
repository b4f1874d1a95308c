//! The teapot at 240 x 240 for a chip with 16 kB of RAM: in bands of a few rows, from bins, through a small vertex cache.
//!
//! All that it draws with is one value, [`Memory`]. Vertices that the cache has no room for are transformed again for each
//! triangle that has one, in every band that it reaches: the picture is the same, and takes longer.

use crate::SceneError;
use crate::ground::BACKGROUND;
use crate::spinning_teapot::{HITHER, Moment, TEAPOT, camera, teapot};
use hither::{
    Band, Bins, Cull, DepthBuffer, Frame, Gouraud, I16F16, Packed, PerspectiveEvery, Quick,
    Rgb565Be, Vertex, Viewport,
};

/// Width and height of the picture, in pixels.
pub const SIDE: u32 = 240;

/// Rows of a band.
pub const ROWS: u32 = 6;

/// Words of a band.
const WORDS: usize = (SIDE * ROWS) as usize;

/// Of the teapot's 992 triangles, those that look front, at most, in any frame of the turn.
const BINNED: usize = 540;

/// Vertices that are transformed once a frame; the teapot has 530.
const CACHED: usize = 112;

/// Focal length in half picture heights.
const FOCAL: I16F16 = I16F16::lit("2.625");

/// All that the picture is drawn with.
#[derive(Debug)]
pub struct Memory {
    color: [u16; WORDS],
    depth: [u16; WORDS],
    cache: [Vertex<Quick<8>, 3>; CACHED],
    bins: Bins<BINNED>,
}

const _: () = assert!(size_of::<Memory>() <= 14 * 1024, "16 kB are for the stack as well");

impl Default for Memory {
    fn default() -> Self {
        Self::new()
    }
}

impl Memory {
    /// All zero bits, so that a static one takes no flash.
    #[must_use]
    pub const fn new() -> Self {
        let (color, depth) = ([0; WORDS], [0; WORDS]);
        Self { color, depth, cache: [Vertex::EMPTY; CACHED], bins: Bins::new() }
    }

    /// Triangles that had no room in the bins in the last frame: 0.
    #[must_use]
    pub fn unbinned(&self) -> usize {
        self.bins.unbinned()
    }
}

/// Draws the teapot at a moment of its turn, and shows each band: its words, in the byte order of panels.
///
/// # Errors
///
/// [`SceneError`]: none in practice, the numbers are constants in range.
pub fn draw(
    memory: &mut Memory,
    moment: Moment,
    mut show: impl FnMut(&Band, &[u16]),
) -> Result<(), SceneError> {
    let Memory { color, depth, cache, bins } = memory;
    let picture = Viewport::new(SIDE, SIDE)?;
    let lit = teapot(&camera(picture.aspect(), FOCAL, moment)?, moment)?;
    for band in picture.bands(WORDS)? {
        let mut frame = Frame::with_viewport(band.framebuffer::<Rgb565Be>(color)?, band.viewport())
            .with_tier(Quick::<8>)
            .with_correction(Packed::<PerspectiveEvery<32>>::default())
            .with_hither(HITHER)
            .with_depth(DepthBuffer::try_new(depth, band.width(), band.rows())?)?
            .with_cull(Cull::Back);
        frame.clear(BACKGROUND);
        if band.y() == 0 {
            frame.bin(&TEAPOT, &lit, cache, bins);
        }
        frame.draw_bin(&TEAPOT, &lit, &Gouraud, cache, bins);
        show(&band, color.get(..band.pixels()).unwrap_or_default());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use hither::Framebuffer;
    use std::vec;
    use std::vec::Vec;

    /// A frame of the turn with all of it in memory.
    fn whole(moment: Moment) -> Vec<u16> {
        let pixels = (SIDE * SIDE) as usize;
        let (mut words, mut depth) = (vec![0; pixels], vec![0_u16; pixels]);
        let target = Framebuffer::<Rgb565Be>::try_new(&mut words, SIDE, SIDE).unwrap();
        let mut frame = Frame::new(target)
            .unwrap()
            .with_correction(Packed::<PerspectiveEvery<32>>::default())
            .with_hither(HITHER)
            .with_depth(DepthBuffer::try_new(&mut depth, SIDE, SIDE).unwrap())
            .unwrap()
            .with_cull(Cull::Back);
        frame.clear(BACKGROUND);
        let aspect = frame.viewport().aspect();
        let lit = teapot(&camera(aspect, FOCAL, moment).unwrap(), moment).unwrap();
        let mut cache = vec![Vertex::EMPTY; TEAPOT.vertex_count()];
        frame.draw(&TEAPOT, &lit, &Gouraud, &mut cache);
        words
    }

    #[test]
    fn bands_are_the_frame_and_no_triangle_is_without_a_bin() {
        let mut memory = Memory::new();
        for number in 0..64 {
            let moment = Moment { number, frames: 64 };
            let mut shown = Vec::new();
            draw(&mut memory, moment, |_, words| shown.extend_from_slice(words)).unwrap();
            assert_eq!(memory.unbinned(), 0, "frame {number}");
            if number % 16 == 3 {
                assert!(shown == whole(moment), "frame {number}");
            }
        }
    }
}

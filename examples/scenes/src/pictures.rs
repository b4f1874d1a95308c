//! A checksum for each of a few pictures that together go through every tier and correction: the
//! same numbers on every machine, whatever the buffers.

use crate::checksum::Checksum;
use crate::spinning_teapot::Moment;
use crate::{SceneError, floor, spinning_teapot};
use hither::{
    Affine, Correction, DepthBuffer, Exact, Frame, Framebuffer, Hither, Perspective,
    PerspectiveEvery, Quick, Rgb565Be, Tier, Vertex, Viewport,
};

/// Width and height of the pictures, in pixels.
pub const SIDE: u32 = 64;

/// Words of a whole picture.
pub const WORDS: usize = (SIDE * SIDE) as usize;

/// Fewer than the vertices of a scene, so that both the cached and the transformed are drawn.
const CACHE: usize = 64;

/// The frame that a picture, or a band of it, is drawn into.
type Canvas<'a, T, I> = Frame<Framebuffer<'a, Rgb565Be>, DepthBuffer<'a>, Hither, T, I>;

/// The checksums of a picture's colours and depths.
type Sums = Result<(u32, u32), SceneError>;

/// Draws each picture through the buffers that are lent, in bands of as many rows as they hold, and
/// reports its name and the checksum of its colours and of its depths: the same for buffers of any
/// size.
///
/// What cannot be drawn is reported as zeros; a test sees that nothing is.
pub fn draw_all(color: &mut [u16], depth: &mut [u16], mut report: impl FnMut(&str, u32, u32)) {
    let mut picture = |name: &str, draw: fn(&mut [u16], &mut [u16]) -> Sums| {
        let (color, depth) = draw(color, depth).unwrap_or_default();
        report(name, color, depth);
    };
    picture("exact", |c, d| teapot((Exact, Perspective), c, d));
    picture("exact affine", |c, d| teapot((Exact, Affine), c, d));
    picture("exact floor", |c, d| floor((Exact, Perspective), c, d));
    picture("quick8", |c, d| teapot((Quick::<8>, PerspectiveEvery::<16>), c, d));
    picture("quick8 floor", |c, d| floor((Quick::<8>, Affine), c, d));
    picture("quick4", |c, d| teapot((Quick::<4>, PerspectiveEvery::<32>), c, d));
}

/// Draws a picture band by band.
fn sums<T: Tier, I: Correction>(
    (tier, correction): (T, I),
    hither: Hither,
    color: &mut [u16],
    depth: &mut [u16],
    mut draw: impl FnMut(&mut Canvas<'_, T, I>) -> Result<(), SceneError>,
) -> Sums {
    let (mut colors, mut depths) = (Checksum::new(), Checksum::new());
    for band in Viewport::new(SIDE, SIDE)?.bands(color.len().min(depth.len()))? {
        let target = band.framebuffer(color)?;
        let deep = DepthBuffer::try_new(depth, SIDE, band.rows())?;
        let mut frame = Frame::with_viewport(target, band.viewport())
            .with_tier(tier)
            .with_correction(correction)
            .with_hither(hither)
            .with_depth(deep)?;
        draw(&mut frame)?;
        let words = |words: &[u16], sum: Checksum| {
            sum.with_words(words.get(..band.pixels()).unwrap_or_default())
        };
        (colors, depths) = (words(color, colors), words(depth, depths));
    }
    Ok((colors.value(), depths.value()))
}

/// The turning teapot on its ground.
fn teapot<T: Tier, I: Correction>(knobs: (T, I), color: &mut [u16], depth: &mut [u16]) -> Sums {
    let mut cache = [Vertex::EMPTY; CACHE];
    sums(knobs, spinning_teapot::HITHER, color, depth, |frame| {
        frame.set_cull(spinning_teapot::CULL);
        let moment = Moment { number: 5, frames: 48 };
        spinning_teapot::draw(frame, moment, &mut cache)?;
        Ok(())
    })
}

/// The floor that the hither plane cuts.
fn floor<T: Tier, I: Correction>(knobs: (T, I), color: &mut [u16], depth: &mut [u16]) -> Sums {
    sums(knobs, floor::HITHER, color, depth, |frame| Ok(floor::draw(frame).map(drop)?))
}

#[cfg(test)]
mod tests {
    use super::*;
    extern crate std;
    use std::string::{String, ToString};
    use std::vec;
    use std::vec::Vec;

    fn drawn_with(words: usize) -> Vec<(String, u32, u32)> {
        let (mut color, mut depth) = (vec![0; words], vec![0; words]);
        let mut sums = Vec::new();
        draw_all(&mut color, &mut depth, |name, color, depth| {
            assert!(color != 0 && depth != 0, "{name} could not be drawn");
            sums.push((name.to_string(), color, depth));
        });
        // The last picture covers a good part of the frame.
        assert!(depth.iter().filter(|depth| **depth != u16::MAX).count() > words / 2);
        sums
    }

    #[test]
    fn every_picture_is_another_and_shows_something() {
        let mut sums: Vec<_> = drawn_with(WORDS).into_iter().map(|(_, color, _)| color).collect();
        let drawn = sums.len();
        sums.sort_unstable();
        sums.dedup();
        assert_eq!((sums.len(), drawn), (6, 6));
    }

    #[test]
    fn a_small_buffer_draws_the_same() {
        assert_eq!(drawn_with(WORDS), drawn_with(1024));
    }
}
